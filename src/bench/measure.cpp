// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bench/measure.hpp>
#include <bench/method_word.hpp>
#include <core/error.hpp>
#include <numeric>
#include <oit/method_info.hpp>
#include <shadows/store_info.hpp>

namespace brume::bench {
namespace {

const oit::MethodInfo* findMethod(const std::string& name) {
    for (const oit::MethodInfo& info : oit::listMethods())
        if (info.name == name) return &info;
    return nullptr;
}

/// Settings of shadow maps go to whatever method asks them.
bool isShadowSetting(const std::string& key) {
    const auto knows = [&](std::span<const scene::SettingInfo> settings) {
        return std::any_of(settings.begin(), settings.end(),
                           [&](const auto& s) { return key == "shadow." + std::string(s.name); });
    };
    const auto stores = shadows::listStores();
    return knows(shadows::listMapSettings()) ||
           std::any_of(stores.begin(), stores.end(),
                       [&](const shadows::StoreInfo& store) { return knows(store.settings); });
}

bool knowsSetting(const oit::MethodInfo& info, const std::string& key) {
    if (isShadowSetting(key)) return true;
    if (key == "shuffle") return true;  // the renderer's own: in which order things are submitted
    return std::any_of(info.settings.begin(), info.settings.end(),
                       [&](const oit::SettingInfo& setting) { return setting.name == key; });
}

/// Refuses unknown methods, and settings that would silently reach nobody.
void checkOptions(const MeasureOptions& options) {
    std::vector<const oit::MethodInfo*> methods;
    for (const std::string& name : options.methods) {
        methods.push_back(findMethod(parseMethodWord(name).name));
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

/// So long frames are measured, where they may be repeated.
constexpr double kShortMs = 50;

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

    bool wantsFrame(const MeasureOptions& asked) const {
        if (!failure.empty()) return false;
        return samples.count() < asked.repeats ||
               (samples.count() < asked.shortRepeats && samples.totalMs() < kShortMs);
    }
};

std::vector<Contestant> makeContestants(gpu::Device& device, const render::PreparedScene& scene,
                                        const MeasureOptions& options, const Log& log) {
    std::vector<Contestant> contestants(options.methods.size());
    for (std::size_t i = 0; i < contestants.size(); ++i) {
        Contestant& contestant = contestants[i];
        const MethodWord choice = parseMethodWord(options.methods[i]);
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

/// A B C A B C ... with the yardstick before each round, until all have their frames. The first
/// warm-up counts fragments. Returns the yardstick's times.
std::vector<double> renderRounds(std::vector<std::vector<Contestant>>& races,
                                 const MeasureOptions& options) {
    std::vector<double> yardstickMs;
    for (int round = 0;; ++round) {
        const bool isWarmup = round < options.warmups;
        const auto takesPart = [&](const Contestant& contestant) {
            return isWarmup || contestant.wantsFrame(options);
        };
        if (std::none_of(races.begin(), races.end(), [&](const std::vector<Contestant>& race) {
                return std::any_of(race.begin(), race.end(), takesPart);
            }))
            break;
        if (options.yardstick && !isWarmup) yardstickMs.push_back(options.yardstick->measure());
        for (std::vector<Contestant>& contestants : races)
            for (Contestant& contestant : contestants) {
                if (!takesPart(contestant)) continue;
                contestant.attempt([&] {
                    contestant.renderer->countFragments(isWarmup && round == 0);
                    render::Result frame = contestant.renderer->renderFrame();
                    if (isWarmup && round == 0) contestant.samples.setFragments(frame);
                    if (!isWarmup) contestant.samples.add(std::move(frame));
                });
            }
        if (options.progress)
            options.progress(std::min((round + 1.0) / (options.warmups + options.repeats), 1.0));
    }
    return yardstickMs;
}

/// The generators of built-in scenes are part of their names; these are what can be chosen.
std::map<std::string, std::uint64_t> collectSeeds(const scene::Scene& scene,
                                                  const render::Options& options) {
    std::map<std::string, std::uint64_t> seeds;
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
        seeds[fmt::format("effect {}", i)] = scene.effects[i].seed;
    if (options.method == "stochastic") seeds["pattern"] = 0;
    scene::SettingsReader reader(options.settings, "naming the seeds");
    for (const char* key : {"pattern", "shuffle"})
        if (options.settings.contains(key))
            seeds[key] = static_cast<std::uint64_t>(reader.integer(key, 0, 0, 1ll << 62));
    return seeds;
}

std::string makeCommand(const Row& row, int repeats, const MeasureOptions& options) {
    std::string command = fmt::format("brume bench --scenes {} --methods {}",
                                      quoteForShell(row.scene), quoteForShell(row.method));
    if (!options.shadow.empty()) command += " --shadow " + quoteForShell(options.shadow);
    command += fmt::format(" --size {}x{}", row.width, row.height);
    const scene::Settings own = parseMethodWord(row.method).settings;
    for (const auto& [key, value] : row.settings)
        if (!own.contains(key)) command += " --set " + quoteForShell(key + "=" + value);
    if (options.truth) command += " --truth " + quoteForShell(options.truthName);
    command += fmt::format(" --repeats {}", repeats);
    if (options.errorEvery > 1) command += fmt::format(" --error-every {}", options.errorEvery);
    return command + (options.withError ? "" : " --no-error");
}

Row describeContestant(const Contestant& contestant, const std::string& sceneName,
                       const scene::Scene& scene, const MeasureOptions& options,
                       const gpu::DeviceInfo& device) {
    Row row = describeRun(sceneName, scene, contestant.options, device);
    row.method = contestant.word;
    row.suite = options.suite;
    row.failure = contestant.failure;
    // Settings of what could not be set up may be no numbers.
    if (row.failure.empty()) row.seeds = collectSeeds(scene, contestant.options);
    row.command = makeCommand(row, std::max(contestant.samples.count(), options.repeats), options);
    return row;
}

/// A value per pixel of an image, at every nth pixel.
template <typename Value>
std::vector<Value> pickPixels(const std::vector<Value>& values, ivec2 size, int every) {
    std::vector<Value> picked;
    for (int y = 0; y * every < size.y; ++y)
        for (int x = 0; x * every < size.x; ++x)
            picked.push_back(values[static_cast<std::size_t>(pickMiddle(y, every, size.y)) * size.x +
                                    pickMiddle(x, every, size.x)]);
    return picked;
}

/// All contestants simulate the same particles, so anyone's will do.
reference::Result renderCommonReference(const render::PreparedScene& scene,
                                        const std::vector<Contestant>& contestants,
                                        const MeasureOptions& options) {
    render::EffectContents effects;
    for (const Contestant& contestant : contestants)
        if (contestant.renderer) {
            effects = contestant.renderer->readEffects();
            break;
        }
    return renderReference(scene, effects, options.progress, options.errorEvery);
}

/// Rows of one scene, once its frames are rendered.
void summariseRace(gpu::Device& device, const Entrant& entrant,
                   const std::vector<Contestant>& contestants,
                   const std::vector<double>& yardstickMs, std::vector<Measurement>& measurements) {
    const MeasureOptions& options = entrant.options;
    const bool anyFrame = std::any_of(contestants.begin(), contestants.end(),
                                      [](const Contestant& c) { return !c.samples.isEmpty(); });
    reference::Result exact;
    if (options.withError && anyFrame)
        exact = renderCommonReference(options.truth ? *options.truth : entrant.scene, contestants,
                                      options);
    const auto reference = std::make_shared<const Image>(exact.image);
    for (const Contestant& contestant : contestants) {
        Measurement& m = measurements.emplace_back();
        m.row = describeContestant(contestant, entrant.sceneName, entrant.scene.scene, options,
                                   device.info());
        if (!contestant.failure.empty()) continue;
        contestant.samples.summariseInto(m.row);
        if (options.yardstick) addRoofs(options.yardstick->machine(), m.row);
        if (!yardstickMs.empty()) m.row.yardstick = summarise(yardstickMs);
        if (options.layerCount > 0)
            m.row.layerPixelsPerSecond =
                1e3 * options.layerCount * m.row.width * m.row.height / m.row.time.median;
        if (options.keepImages) m.image = contestant.samples.last().image;
        if (!options.withError) continue;
        Comparison comparison = compareWithReference(contestant.samples.last(), exact, options.errorEvery);
        m.row.error = comparison.metrics;
        if (!options.keepImages) continue;
        m.absolute = std::move(comparison.absolute);
        m.reference = reference;
    }
}

}  // namespace

double FrameSamples::totalMs() const {
    return std::accumulate(mTimesMs.begin(), mTimesMs.end(), 0.0);
}

void FrameSamples::add(render::Result frame) {
    mTimesMs.push_back(frame.timeMs);
    mWallMs.push_back(frame.wallMs);
    mPassTimesMs.resize(std::max(mPassTimesMs.size(), frame.passes.size()));
    for (std::size_t i = 0; i < frame.passes.size(); ++i)
        mPassTimesMs[i].push_back(frame.passes[i].timeMs);
    mHashes.insert(computeHash(frame.image));
    mLast = std::move(frame);
}

void FrameSamples::summariseInto(Row& row) const {
    row.time = summarise(mTimesMs);
    row.wall = summarise(mWallMs);
    for (std::size_t i = 0; i < mLast.passes.size(); ++i) {
        const render::PassTime& pass = mLast.passes[i];
        PassRow& made =
            row.passes.emplace_back(PassRow{pass.name, summarise(mPassTimesMs[i]), pass.bytes});
        const auto counted =
            std::find_if(mCounted.begin(), mCounted.end(),
                         [&](const render::PassTime& other) { return other.name == pass.name; });
        if (counted != mCounted.end()) made.fragments = counted->fragments;
    }
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

void addRoofs(const Machine& machine, Row& row) {
    for (PassRow& pass : row.passes)
        pass.roofMs = computeRoofMs(machine, pass.bytes, pass.fragments);
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
                                  const ProgressCallback& progress, int every) {
    std::vector<scene::MediumSphere> spheres = scene.spheres;
    spheres.insert(spheres.end(), effects.spheres.begin(), effects.spheres.end());
    scene::Scene all = scene.scene;
    all.meshes.insert(all.meshes.end(), effects.surfaces.begin(), effects.surfaces.end());
    reference::Options options;
    options.progress = progress;
    options.every = every;
    return reference::render({all, scene.volumes, spheres}, options);
}

Comparison compareWithReference(const render::Result& frame, const reference::Result& exact,
                                int every) {
    const ivec2 size(frame.image.width, frame.image.height);
    Image image(exact.image.width, exact.image.height);
    image.pixels = pickPixels(frame.image.pixels, size, every);
    if (frame.triangles.empty()) return compareImages(image, exact.image);
    return compareImages(
        image, exact.image,
        findDisagreement(pickPixels(frame.triangles, size, every), exact.triangles));
}

std::vector<Measurement> measureScenes(gpu::Device& device, const std::deque<Entrant>& entrants,
                                       const Log& log) {
    std::vector<std::vector<Contestant>> races;
    for (const Entrant& entrant : entrants) {
        checkOptions(entrant.options);
        races.push_back(makeContestants(device, entrant.scene, entrant.options, log));
    }
    const std::vector<double> yardstickMs = renderRounds(races, entrants.front().options);
    std::vector<Measurement> measurements;
    for (std::size_t i = 0; i < races.size(); ++i)
        summariseRace(device, entrants[i], races[i], yardstickMs, measurements);
    return measurements;
}

std::vector<Measurement> measureScene(gpu::Device& device, const std::string& sceneName,
                                      const render::PreparedScene& scene,
                                      const MeasureOptions& options, const Log& log) {
    std::deque<Entrant> entrants;
    entrants.push_back({sceneName, scene, options});
    return measureScenes(device, entrants, log);
}

}  // namespace brume::bench
