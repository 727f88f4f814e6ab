// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bench/measure.hpp>
#include <core/error.hpp>
#include <oit/method_info.hpp>
#include <sstream>

namespace brume::bench {
namespace {

/// A word of MeasureOptions::methods, apart.
struct MethodChoice {
    std::string name;
    scene::Settings settings;
};

MethodChoice parseChoice(const std::string& word) {
    std::istringstream parts(word);
    MethodChoice choice;
    std::getline(parts, choice.name, ':');
    for (std::string part; std::getline(parts, part, ':');) {
        const std::size_t equals = part.find('=');
        if (equals == 0 || equals == std::string::npos)
            throw inputError("benchmarking", "method " + word,
                             fmt::format("\"{}\" is not of the form key=value", part));
        choice.settings[part.substr(0, equals)] = part.substr(equals + 1);
    }
    return choice;
}

const oit::MethodInfo* findMethod(const std::string& name) {
    for (const oit::MethodInfo& info : oit::listMethods())
        if (info.name == name) return &info;
    return nullptr;
}

bool knowsSetting(const oit::MethodInfo& info, const std::string& key) {
    if (key == "shuffle") return true;  // the renderer's own: in which order things are submitted
    return std::any_of(info.settings.begin(), info.settings.end(),
                       [&](const oit::SettingInfo& setting) { return setting.name == key; });
}

/// Refuses unknown methods, and settings that would silently reach nobody.
void checkOptions(const MeasureOptions& options) {
    std::vector<const oit::MethodInfo*> methods;
    for (const std::string& name : options.methods) {
        methods.push_back(findMethod(parseChoice(name).name));
        if (methods.back()) continue;
        std::vector<std::string_view> known;
        for (const oit::MethodInfo& info : oit::listMethods()) known.push_back(info.name);
        throw inputError("benchmarking", "method " + name,
                         fmt::format("unknown, allowed are {}", fmt::join(known, ", ")));
    }
    for (const auto& [key, value] : options.settings)
        if (std::none_of(methods.begin(), methods.end(),
                         [&](const oit::MethodInfo* info) { return knowsSetting(*info, key); }))
            throw inputError("benchmarking", "setting " + key,
                             "none of the methods knows it, see brume list methods");
}

/// One method in the race.
struct Contestant {
    std::string word;  // of MeasureOptions::methods
    render::Options options;
    std::unique_ptr<render::Renderer> renderer;
    FrameSamples samples;
    std::string failure;

    /// Runs `step`; a failure of device or memory takes the contestant out, with its memory.
    template <typename Step>
    void attempt(const Step& step) {
        if (!failure.empty()) return;
        try {
            step();
        } catch (const Error& error) {
            failure = error.what();
            renderer.reset();
        }
    }
};

std::vector<Contestant> makeContestants(gpu::Device& device, const render::PreparedScene& scene,
                                        const MeasureOptions& options, const Log& log) {
    std::vector<Contestant> contestants(options.methods.size());
    for (std::size_t i = 0; i < contestants.size(); ++i) {
        Contestant& contestant = contestants[i];
        const MethodChoice choice = parseChoice(options.methods[i]);
        contestant.word = options.methods[i];
        contestant.options.method = choice.name;
        contestant.options.triangleHashes = options.withError;
        for (const auto& [key, value] : options.settings)
            if (knowsSetting(*findMethod(choice.name), key))
                contestant.options.settings[key] = value;
        for (const auto& [key, value] : choice.settings) contestant.options.settings[key] = value;
        contestant.attempt([&] {
            contestant.renderer =
                std::make_unique<render::Renderer>(device, scene, contestant.options, log);
        });
    }
    return contestants;
}

void renderRounds(std::vector<Contestant>& contestants, const MeasureOptions& options) {
    const int rounds = options.warmups + options.repeats;
    for (int round = 0; round < rounds; ++round)
        for (Contestant& contestant : contestants) {
            contestant.attempt([&] {
                render::Result frame = contestant.renderer->renderFrame();
                if (round >= options.warmups) contestant.samples.add(std::move(frame));
            });
            if (options.progress) options.progress((round + 1.0) / rounds);
        }
}

/// All contestants simulate the same particles, so anyone's will do.
reference::Result renderCommonReference(const render::PreparedScene& scene,
                                        const std::vector<Contestant>& contestants,
                                        const ProgressCallback& progress) {
    render::EffectContents effects;
    for (const Contestant& contestant : contestants)
        if (contestant.renderer) {
            effects = contestant.renderer->readEffects();
            break;
        }
    return renderReference(scene, effects, progress);
}

}  // namespace

void FrameSamples::add(render::Result frame) {
    mTimesMs.push_back(frame.timeMs);
    mPassTimesMs.resize(std::max(mPassTimesMs.size(), frame.passes.size()));
    for (std::size_t i = 0; i < frame.passes.size(); ++i)
        mPassTimesMs[i].push_back(frame.passes[i].timeMs);
    mHashes.insert(computeHash(frame.image));
    mLast = std::move(frame);
}

void FrameSamples::summariseInto(Row& row) const {
    row.time = summarise(mTimesMs);
    row.passes = mLast.passes;
    for (std::size_t i = 0; i < row.passes.size(); ++i)
        row.passes[i].timeMs = percentile(mPassTimesMs[i], 0.5);
    row.bytes = mLast.bytes;
    row.counters = mLast.counters;
    row.errorBound = mLast.errorBound;
    row.counters["distinctImages"] = mHashes.size();
    row.imageHash = computeHash(mLast.image);
}

Row describeRun(const std::string& sceneName, const scene::Scene& scene,
                const render::Options& options, const gpu::DeviceInfo& device) {
    Row row;
    row.scene = sceneName;
    row.method = options.method;
    row.shadow = describeShadows(scene);
    row.settings = options.settings;
    row.width = scene.image.width;
    row.height = scene.image.height;
    row.device = device.name;
    row.driver = device.driver;
    row.commit = commit();
    return row;
}

std::string describeShadows(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const scene::Light& light : scene.lights)
        if (light.shadow != "none" &&
            std::find(names.begin(), names.end(), light.shadow) == names.end())
            names.push_back(light.shadow);
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, "+"));
}

void overrideShadows(scene::Scene& scene, const std::string& shadow) {
    for (scene::Light& light : scene.lights)
        if (light.type != scene::LightType::Ambient) light.shadow = shadow;
}

reference::Result renderReference(const render::PreparedScene& scene,
                                  const render::EffectContents& effects,
                                  const ProgressCallback& progress) {
    std::vector<scene::MediumSphere> spheres = scene.spheres;
    spheres.insert(spheres.end(), effects.spheres.begin(), effects.spheres.end());
    scene::Scene all = scene.scene;
    all.meshes.insert(all.meshes.end(), effects.surfaces.begin(), effects.surfaces.end());
    reference::Options options;
    options.progress = progress;
    return reference::render({all, scene.volumes, spheres}, options);
}

Comparison compareWithReference(const render::Result& frame, const reference::Result& exact) {
    if (frame.triangles.empty()) return compareImages(frame.image, exact.image);
    return compareImages(frame.image, exact.image,
                         findDisagreement(frame.triangles, exact.triangles));
}

std::vector<Measurement> measureScene(gpu::Device& device, const std::string& sceneName,
                                      const render::PreparedScene& scene,
                                      const MeasureOptions& options, const Log& log) {
    checkOptions(options);
    std::vector<Contestant> contestants = makeContestants(device, scene, options, log);
    renderRounds(contestants, options);
    const bool anyFrame = std::any_of(contestants.begin(), contestants.end(),
                                      [](const Contestant& c) { return !c.samples.isEmpty(); });
    reference::Result exact;
    if (options.withError && anyFrame)
        exact = renderCommonReference(scene, contestants, options.progress);

    std::vector<Measurement> measurements;
    for (const Contestant& contestant : contestants) {
        Measurement& m = measurements.emplace_back();
        m.row = describeRun(sceneName, scene.scene, contestant.options, device.info());
        m.row.method = contestant.word;
        m.row.failure = contestant.failure;
        if (!contestant.failure.empty()) continue;
        contestant.samples.summariseInto(m.row);
        m.image = contestant.samples.last().image;
        if (!options.withError) continue;
        Comparison comparison = compareWithReference(contestant.samples.last(), exact);
        m.row.error = comparison.metrics;
        m.absolute = std::move(comparison.absolute);
    }
    return measurements;
}

}  // namespace brume::bench
