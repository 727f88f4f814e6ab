// SPDX-License-Identifier: Apache-2.0
#include <bench/row.hpp>
#include <bench/shadow_measure.hpp>
#include <bench/statistics.hpp>
#include <core/error.hpp>
#include <nlohmann/json.hpp>
#include <reference/tracer.hpp>
#include <render/shadow_casters.hpp>
#include <shadows/store_info.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace brume::bench {
namespace {

constexpr const char* kDoing = "measuring shadows";
/// Nodes of the tent average, per direction.
constexpr int kFootprintNodes = 7;
/// Points before which there is nothing are left out: every store is right there.
constexpr double kLeastShadow = 1e-3;
/// Share of the casters' box that is left out at each of its sides: panes end there, and the hard
/// edge of a pane is a matter of the map's resolution, not of the store.
constexpr double kMargin = 0.06;
constexpr std::uint64_t kPointSeed = 7;

class Random {
  public:
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(mEngine() >> 11) * 0x1p-53;
    }

  private:
    std::mt19937_64 mEngine{kPointSeed};
};

/// Points in the casters' box, and the same pushed along the light behind all of them.
struct Points {
    std::vector<dvec3> inside, behind;
};

/// Exact transmittances towards a directional light.
class ExactShadows {
  public:
    ExactShadows(const render::PreparedScene& scene, const scene::Light& light, const Box3& bounds)
        : mInput{scene.scene, scene.volumes, scene.spheres},
          mTracer(mInput),
          mLight(light),
          mReach(glm::length(bounds.size())),
          mBounds(bounds) {}

    dvec3 at(const dvec3& point) const {
        // Far enough to be in front of everything, near enough to keep digits.
        const double distance = 2 * mReach + glm::length(point - mBounds.center());
        return mTracer.transmittance(point, point - distance * mLight.direction);
    }

    dvec3 average(const dvec3& point, const render::ShadowSamples& samples) const {
        if (samples.footprint == 0) return at(point);
        dvec3 sum(0);
        double weights = 0;
        for (int i = 0; i < kFootprintNodes; ++i)
            for (int j = 0; j < kFootprintNodes; ++j) {
                const double x = (2.0 * i + 1) / kFootprintNodes - 1;
                const double y = (2.0 * j + 1) / kFootprintNodes - 1;
                const double weight = (1 - std::abs(x)) * (1 - std::abs(y));
                sum +=
                    weight * at(point + samples.footprint * (x * samples.right + y * samples.up));
                weights += weight;
            }
        return sum / weights;
    }

    Points makePoints(int count) const {
        Points points;
        Random random;
        const dvec3 d = mLight.direction;
        double last = -kInfinity;
        for (int c = 0; c < 8; ++c)
            last = std::max(last, glm::dot(d, dvec3(c & 1 ? mBounds.hi.x : mBounds.lo.x,
                                                    c & 2 ? mBounds.hi.y : mBounds.lo.y,
                                                    c & 4 ? mBounds.hi.z : mBounds.lo.z)));
        const auto isEnough = [&] { return static_cast<int>(points.inside.size()) >= count; };
        for (int tries = 0; tries < 50 * count && !isEnough(); ++tries) {
            const double x = random.uniform(kMargin, 1 - kMargin),
                         y = random.uniform(kMargin, 1 - kMargin),
                         z = random.uniform(kMargin, 1 - kMargin);
            const dvec3 point = mBounds.lo + mBounds.size() * dvec3(x, y, z);
            const dvec3 behind = point + d * (last - glm::dot(d, point) + 0.01 * mReach);
            const dvec3 total = at(behind);
            if (std::min({total.x, total.y, total.z}) > 1 - kLeastShadow) continue;
            points.inside.push_back(point);
            if (2 * points.behind.size() < points.inside.size()) points.behind.push_back(behind);
        }
        return points;
    }

  private:
    reference::Input mInput;
    reference::Tracer mTracer;
    scene::Light mLight;
    double mReach;
    Box3 mBounds;
};

/// In deep shadow the shares of nearly nothing say nothing.
dvec3 shares(const dvec3& t) { return t / std::max(t.x + t.y + t.z, 1e-2); }

ShadowError summariseErrors(std::span<const vec3> values, std::span<const dvec3> exact) {
    ShadowError error;
    if (values.empty()) return error;
    std::vector<double> largest;
    double squares = 0, hues = 0, sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const dvec3 d = dvec3(values[i]) - exact[i];
        const dvec3 hue = shares(dvec3(values[i])) - shares(exact[i]);
        squares += glm::dot(d, d);
        hues += glm::dot(hue, hue);
        sum += d.x + d.y + d.z;
        largest.push_back(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
    }
    const double count = 3.0 * static_cast<double>(values.size());
    error.rms = std::sqrt(squares / count);
    error.hue = std::sqrt(hues / count);
    error.bias = sum / count;
    error.max = *std::max_element(largest.begin(), largest.end());
    error.p999 = percentile(std::move(largest), 0.999);
    return error;
}

const shadows::StoreInfo& findStore(const std::string& name) {
    shadows::storeBits(name);  // throws for an unknown name
    for (const shadows::StoreInfo& info : shadows::listStores())
        if (info.name == name) return info;
    throw inputError(kDoing, "shadow none", "has no map, allowed are stores");
}

bool knows(std::span<const scene::SettingInfo> settings, const std::string& key) {
    return std::any_of(settings.begin(), settings.end(),
                       [&](const scene::SettingInfo& info) { return info.name == key; });
}

/// "shadow.filter" as in every other command, or "filter".
std::string dropPrefix(const std::string& key) {
    const std::string prefix = "shadow.";
    return key.starts_with(prefix) ? key.substr(prefix.size()) : key;
}

scene::Settings settingsFor(const shadows::StoreInfo& store, const scene::Settings& all) {
    scene::Settings settings;
    for (const auto& [word, value] : all) {
        const std::string key = dropPrefix(word);
        if (knows(store.settings, key) || knows(shadows::listMapSettings(), key))
            settings["shadow." + key] = value;
    }
    return settings;
}

void checkSettings(const ShadowMeasureOptions& options) {
    for (const auto& [word, value] : options.settings) {
        const std::string key = dropPrefix(word);
        bool isKnown = knows(shadows::listMapSettings(), key);
        for (const std::string& store : options.stores)
            isKnown = isKnown || knows(findStore(store).settings, key);
        if (!isKnown)
            throw inputError(kDoing, "setting " + key,
                             "unknown to these stores, allowed are those of brume list shadows");
    }
}

/// The scene with the sun as its only light and a camera that costs nothing.
render::PreparedScene isolateSun(render::PreparedScene scene) {
    const auto sun = std::find_if(
        scene.scene.lights.begin(), scene.scene.lights.end(),
        [](const scene::Light& light) { return light.type == scene::LightType::Directional; });
    if (sun == scene.scene.lights.end())
        throw inputError(kDoing, scene.scene.file.string(),
                         "no directional light, allowed are scenes that have one");
    scene.scene.lights = {*sun};
    scene.scene.lights[0].shadowSettings.clear();
    scene.scene.image = {8, 8, 1};
    return scene;
}

ShadowErrors compare(std::span<const vec3> values, std::span<const dvec3> points,
                     std::span<const dvec3> exact, std::span<const dvec3> averages) {
    ShadowErrors errors;
    errors.atPoint = summariseErrors(values.first(points.size()), exact);
    errors.footprint = summariseErrors(values.first(points.size()), averages);
    return errors;
}

std::vector<dvec3> averageAll(const ExactShadows& exact, std::span<const dvec3> points,
                              const render::ShadowSamples& samples) {
    std::vector<dvec3> averages;
    for (const dvec3& point : points) averages.push_back(exact.average(point, samples));
    return averages;
}

/// One store in the race.
struct Contestant {
    ShadowRow row;
    std::unique_ptr<render::Renderer> renderer;
    render::ShadowSamples samples;
    std::vector<double> buildMs, sampleMs;

    /// Runs `step`; a failure takes the store out, with its memory.
    template <typename Step>
    void attempt(const Step& step) {
        if (!row.failure.empty()) return;
        try {
            step();
        } catch (const Error& error) {
            row.failure = error.what();
            renderer.reset();
        }
    }
};

std::string makeCommand(const ShadowRow& row, const ShadowMeasureOptions& options) {
    std::string command = fmt::format("brume bench --scenes {} --shadows {}",
                                      quoteForShell(row.scene), row.store);
    for (const auto& [key, value] : row.settings)
        command += " --set " + quoteForShell(key + "=" + value);
    return command + fmt::format(" --points {} --repeats {}", options.points, options.repeats);
}

Contestant makeContestant(gpu::Device& device, render::PreparedScene& scene,
                          const std::string& sceneName, const std::string& store,
                          const ShadowMeasureOptions& options, const Log& log) {
    Contestant contestant;
    ShadowRow& row = contestant.row;
    row.scene = sceneName;
    row.store = store;
    row.device = device.info().name;
    row.driver = device.info().driver;
    row.commit = commit();
    row.settings = settingsFor(findStore(store), options.settings);
    row.command = makeCommand(row, options);
    scene.scene.lights[0].shadow = store;
    contestant.attempt([&] {
        contestant.renderer = std::make_unique<render::Renderer>(
            device, scene, render::Options{.method = "unordered", .settings = row.settings}, log);
    });
    return contestant;
}

void summariseStore(Contestant& contestant, const ExactShadows& exact, const Points& points) {
    ShadowRow& row = contestant.row;
    const render::ShadowSamples& samples = contestant.samples;
    row.build = summarise(contestant.buildMs);
    row.sampleNs = 1e6 * percentile(contestant.sampleMs, 0.5) /
                   static_cast<double>(points.inside.size() + points.behind.size());
    row.bytesPerTexel = samples.bytesPerTexel;
    const std::span<const vec3> values(samples.values);
    const render::ShadowSamples point{};
    row.inside = compare(values, points.inside, averageAll(exact, points.inside, point),
                         averageAll(exact, points.inside, samples));
    row.behind =
        compare(values.subspan(points.inside.size()), points.behind,
                averageAll(exact, points.behind, point), averageAll(exact, points.behind, samples));
}

/// A B C A B C ...; the first round warms up.
void probeRounds(std::vector<Contestant>& contestants, const Points& points,
                 const ShadowMeasureOptions& options) {
    std::vector<dvec3> all = points.inside;
    all.insert(all.end(), points.behind.begin(), points.behind.end());
    for (int round = 0; round <= options.repeats; ++round) {
        for (Contestant& contestant : contestants)
            contestant.attempt([&] {
                contestant.samples = contestant.renderer->probeShadows(0, all);
                if (round == 0) return;
                contestant.buildMs.push_back(contestant.samples.buildMs);
                contestant.sampleMs.push_back(contestant.samples.sampleMs);
            });
        if (options.progress) options.progress((round + 1.0) / (options.repeats + 1));
    }
}

nlohmann::json describe(const ShadowError& e) {
    return {{"rms", e.rms}, {"p999", e.p999}, {"max", e.max}, {"bias", e.bias}, {"hue", e.hue}};
}

nlohmann::json describe(const ShadowErrors& e) {
    return {{"atPoint", describe(e.atPoint)}, {"footprint", describe(e.footprint)}};
}

}  // namespace

std::vector<ShadowRow> measureShadows(gpu::Device& device, const std::string& sceneName,
                                      const render::PreparedScene& prepared,
                                      const ShadowMeasureOptions& options, const Log& log) {
    checkSettings(options);
    render::PreparedScene scene = isolateSun(prepared);
    const Box3 bounds = render::findTranslucentBounds(scene);
    if (bounds.isEmpty())
        throw inputError(kDoing, sceneName, "nothing translucent, allowed are media and glass");
    const ExactShadows exact(scene, scene.scene.lights[0], bounds);
    const Points points = exact.makePoints(options.points);
    std::vector<Contestant> contestants;
    for (const std::string& store : options.stores)
        contestants.push_back(makeContestant(device, scene, sceneName, store, options, log));
    probeRounds(contestants, points, options);
    std::vector<ShadowRow> rows;
    for (Contestant& contestant : contestants) {
        contestant.attempt([&] { summariseStore(contestant, exact, points); });
        rows.push_back(std::move(contestant.row));
    }
    return rows;
}

Table makeShadowTable(std::span<const ShadowRow> rows) {
    Table table{.title = "Shadow stores",
                .notes = {"rms of transmittance against the exact value at the point, and against its "
                          "mean over the store's filter; the rest against that mean."},
                .header = {"scene", "store", "build ms", "p05..p95", "ns / point", "bytes / texel",
                           "inside: at point", "footprint", "bias", "hue", "max",
                           "behind: at point", "footprint", "bias", "hue", "max"},
                .textColumns = 2};
    for (const ShadowRow& row : rows) {
        Cells cells = {row.scene, row.store};
        if (row.failure.empty()) {
            cells.push_back(fmt::format("{:.1f}", row.build.median));
            cells.push_back(fmt::format("{:.1f}..{:.1f}", row.build.p05, row.build.p95));
            cells.push_back(fmt::format("{:.0f}", row.sampleNs));
            cells.push_back(fmt::format("{:.1f}", row.bytesPerTexel));
            for (const ShadowErrors* e : {&row.inside, &row.behind}) {
                for (const double figure : {e->atPoint.rms, e->footprint.rms})
                    cells.push_back(fmt::format("{:.4f}", figure));
                cells.push_back(fmt::format("{:+.4f}", e->footprint.bias));
                cells.push_back(fmt::format("{:.4f}", e->footprint.hue));
                cells.push_back(fmt::format("{:.3f}", e->footprint.max));
            }
        } else {
            cells.push_back("failed");
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

nlohmann::ordered_json describe(const ShadowRow& row) {
    nlohmann::ordered_json json = {{"scene", row.scene},     {"shadow", row.store},
                                   {"settings", row.settings}, {"device", row.device},
                                   {"driver", row.driver},   {"commit", row.commit},
                                   {"command", row.command}};
    if (!row.failure.empty()) {
        json["failure"] = row.failure;
        return json;
    }
    json["buildMs"] = {{"median", row.build.median},
                       {"p05", row.build.p05},
                       {"p95", row.build.p95},
                       {"repeats", row.build.repeats}};
    json["sampleNs"] = row.sampleNs;
    json["bytesPerTexel"] = row.bytesPerTexel;
    json["seeds"] = {{"points", kPointSeed}};
    json["inside"] = describe(row.inside);
    json["behind"] = describe(row.behind);
    return json;
}

}  // namespace brume::bench
