// SPDX-License-Identifier: Apache-2.0
#include <bench/runner.hpp>
#include <core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>

namespace brume::bench {
namespace {

/// Pictures in a report are as wide as this.
constexpr int kThumbnailWidth = 240;
/// Building shadow maps takes long, and their errors do not change.
constexpr int kMostShadowRepeats = 5;

/// Every n-th pixel wide; `largest`: of each block of absolute errors.
void shrink(Measurement& m) {
    const int n = (m.image.width + kThumbnailWidth - 1) / kThumbnailWidth;
    if (m.image.isEmpty() || n <= 1) return;
    const int width = m.image.width / n, height = std::max(m.image.height / n, 1);
    Image small(width, height);
    std::vector<float> largest(m.absolute.empty() ? 0 : small.pixels.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t to = static_cast<std::size_t>(y) * width + x;
            for (int i = 0; i < n * n; ++i) {
                const std::size_t from =
                    static_cast<std::size_t>(std::min(y * n + i / n, m.image.height - 1)) *
                        m.image.width +
                    x * n + i % n;
                small.pixels[to] += m.image.pixels[from] / static_cast<float>(n * n);
                if (!largest.empty()) largest[to] = std::max(largest[to], m.absolute[from]);
            }
        }
    m.image = std::move(small);
    m.absolute = std::move(largest);
}

std::shared_ptr<const Image> shrinkReference(const std::shared_ptr<const Image>& reference) {
    if (!reference) return reference;
    Measurement m{.image = *reference};
    shrink(m);
    return std::make_shared<const Image>(std::move(m.image));
}

class Runner {
  public:
    Runner(gpu::Device& device, Yardstick& yardstick, const std::string& suite,
           const RunOptions& options, const Log& log, Results& results)
        : mDevice(device),
          mYardstick(yardstick),
          mSuite(suite),
          mOptions(options),
          mLog(log),
          mResults(results) {}

    /// The plans from `first` on that are measured in turn; returns how many.
    std::size_t run(std::span<const Plan> plans) {
        const Plan& first = plans.front();
        if (first.kind == PlanKind::Simulation) return simulate(first), 1;
        if (first.kind == PlanKind::ShadowPoints) return measureStores(first), 1;
        std::size_t count = 1;
        while (count < plans.size() && plans[count].isRival) ++count;
        // The scenes of a family are measured one after the other, rivals together.
        if (count == 1) {
            for (NamedScene& named : findScenes(first)) {
                std::deque<Entrant> entrants;
                enter(first, named, entrants);
                measureFrames(entrants);
            }
            return count;
        }
        std::deque<Entrant> entrants;
        for (const Plan& plan : plans.first(count))
            for (NamedScene& named : findScenes(plan)) enter(plan, named, entrants);
        measureFrames(entrants);
        return count;
    }

  private:
    int repeats(const Plan& plan) const {
        return plan.repeats > 0 ? plan.repeats : mOptions.repeats;
    }

    std::vector<NamedScene> findScenes(const std::string& name) const {
        std::vector<NamedScene> scenes = mOptions.findScenes(name);
        if (scenes.empty()) throw inputError("benchmarking", "scene " + name, "unknown");
        return scenes;
    }

    std::vector<NamedScene> findScenes(const Plan& plan) const {
        std::vector<NamedScene> scenes = findScenes(plan.scene);
        if (plan.size.x > 0)
            for (NamedScene& named : scenes) {
                named.scene.image.width = plan.size.x;
                named.scene.image.height = plan.size.y;
            }
        return scenes;
    }

    void simulate(const Plan& plan) {
        const auto costs =
            measureSimulation(mDevice, plan.count > 0 ? plan.count : 1'000'000, repeats(plan));
        mResults.simulation.insert(mResults.simulation.end(), costs.begin(), costs.end());
    }

    void measureStores(const Plan& plan) {
        ShadowMeasureOptions options;
        options.stores = plan.methods;
        options.settings = plan.settings;
        options.repeats = std::min(repeats(plan), kMostShadowRepeats);
        if (plan.count > 0) options.points = static_cast<int>(plan.count);
        for (const NamedScene& named : findScenes(plan)) {
            const auto rows =
                measureShadows(mDevice, named.name, prepareNamed(named, mLog), options, mLog);
            mResults.shadows.insert(mResults.shadows.end(), rows.begin(), rows.end());
        }
    }

    void enter(const Plan& plan, NamedScene& named, std::deque<Entrant>& entrants) {
        if (!plan.shadow.empty()) overrideShadows(named.scene, plan.shadow);
        Entrant& entrant = entrants.emplace_back();
        entrant.sceneName = named.name;
        entrant.scene = prepareNamed(named, mLog);
        MeasureOptions& options = entrant.options;
        options.methods = plan.methods;
        options.settings = plan.settings;
        options.repeats = repeats(plan);
        options.shortRepeats = mOptions.shortRepeats;
        options.withError = plan.withError && mOptions.withError;
        options.errorEvery = mOptions.errorEvery;
        // Pictures of the error have as many pixels as those of the result.
        options.keepImages = mOptions.keepImages && options.errorEvery == 1;
        options.suite = mSuite;
        options.shadow = plan.shadow;
        options.layerCount = named.layerCount;
        options.yardstick = &mYardstick;
        if (plan.truth.empty()) return;
        NamedScene truth = findScenes(plan.truth).front();
        truth.scene.image = named.scene.image;
        options.truth = std::make_shared<const render::PreparedScene>(prepareNamed(truth, mLog));
        options.truthName = plan.truth;
    }

    void measureFrames(const std::deque<Entrant>& entrants) {
        std::map<const Image*, std::shared_ptr<const Image>> references;  // small ones
        for (Measurement& m : measureScenes(mDevice, entrants, mLog)) {
            shrink(m);
            if (m.reference) {
                auto& small = references[m.reference.get()];
                if (!small) small = shrinkReference(m.reference);
                m.reference = small;
            }
            mResults.frames.push_back(std::move(m));
        }
    }

    gpu::Device& mDevice;
    Yardstick& mYardstick;
    const std::string& mSuite;
    const RunOptions& mOptions;
    const Log& mLog;
    Results& mResults;
};

}  // namespace

void runPlans(gpu::Device& device, Yardstick& yardstick, const std::vector<Plan>& plans,
              const std::string& suite, const RunOptions& options, const Log& log,
              Results& results) {
    Runner runner(device, yardstick, suite, options, log, results);
    for (std::size_t i = 0; i < plans.size();) {
        if (options.progress)
            options.progress(suite + " " + plans[i].scene,
                             static_cast<double>(i) / static_cast<double>(plans.size()));
        i += runner.run(std::span(plans).subspan(i));
    }
    results.machine = yardstick.machine();
}

void runSuite(gpu::Device& device, Yardstick& yardstick, const Suite& suite, Scale scale,
              const RunOptions& options, const Log& log, Results& results) {
    const std::size_t framesBefore = results.frames.size(), storesBefore = results.shadows.size();
    runPlans(device, yardstick, suite.plan(scale), std::string(suite.name), options, log, results);
    const std::span<const Measurement> frames(results.frames);
    Findings findings = suite.read(frames.subspan(framesBefore), scale);
    findings.suite = suite.name;
    findings.summary = suite.summary;
    const std::span<const ShadowRow> stores(results.shadows);
    if (stores.size() > storesBefore)
        findings.tables.push_back(makeShadowTable(stores.subspan(storesBefore)));
    if (suite.name == "simulation")
        findings.tables.push_back(makeSimulationTable(results.simulation));
    results.findings.push_back(std::move(findings));
}

}  // namespace brume::bench
