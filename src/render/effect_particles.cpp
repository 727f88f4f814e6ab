// SPDX-License-Identifier: Apache-2.0
#include <particles/surfaces.hpp>
#include <render/effect_particles.hpp>
#include <scene/camera.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace brume::render {

using frame::Access;

namespace {

std::string checkpointName(int frame, std::size_t entry) {
    return fmt::format("frame_{:06}.effect_{:03}.state", frame, entry);
}

/// The last frame up to `frame` that `folder` has states of all these entries of.
std::optional<int> findCheckpoint(const std::filesystem::path& folder, int frame,
                                  const std::vector<std::size_t>& entries) {
    std::map<int, std::set<std::size_t>> found;
    std::error_code error;
    for (const auto& file : std::filesystem::directory_iterator(folder, error)) {
        int number = 0, read = 0;
        std::size_t entry = 0;
        const std::string name = file.path().filename().string();
        // Names are compared whole: half-written files end differently.
        if (std::sscanf(name.c_str(), "frame_%d.effect_%zu.state%n", &number, &entry, &read) == 2 &&
            name == checkpointName(number, entry) && number <= frame)
            found[number].insert(entry);
    }
    for (auto it = found.rbegin(); it != found.rend(); ++it)
        if (std::all_of(entries.begin(), entries.end(),
                        [&](std::size_t entry) { return it->second.count(entry) > 0; }))
            return it->first;
    return std::nullopt;
}

particles::Viewer viewerOf(const scene::CameraFrame& camera) {
    return {camera.position, camera.type == scene::CameraType::Perspective};
}

}  // namespace

std::uint32_t firstParticleId(std::size_t effect) {
    return static_cast<std::uint32_t>(effect + 1) << 24;
}

EffectParticles::EffectParticles(gpu::Device& device, const PreparedScene& prepared,
                                 EffectParticles* previous)
    : mPrepared(&prepared) {
    groupInstances();
    for (const std::vector<std::size_t>& roots : mRoots) {
        mKeys.push_back(keysOf(roots));
        if (previous) {
            mSimulations.push_back(previous->takeOver(mKeys.back()));
            if (mSimulations.back()) continue;
            mSimulations.pop_back();
        }
        std::vector<particles::EffectInstance> instances;
        for (const std::size_t i : roots)
            instances.push_back({prepared.scene.effects[i].seed, static_cast<std::uint32_t>(i),
                                 prepared.scene.effects[i].placement()});
        mSimulations.push_back(std::make_unique<particles::GpuSimulation>(
            device, prepared.scene.effects[roots[0]].effect, instances));
    }
    for (const auto& simulation : mSimulations)
        mShownSlots.emplace_back(simulation->populationCount(), 0);
}

std::vector<std::uint64_t> EffectParticles::keysOf(const std::vector<std::size_t>& roots) const {
    std::vector<std::uint64_t> keys;
    for (const std::size_t i : roots) keys.push_back(mPrepared->scene.effects[i].key);
    return keys;
}

std::unique_ptr<particles::GpuSimulation> EffectParticles::takeOver(
    const std::vector<std::uint64_t>& keys) {
    if (std::find(keys.begin(), keys.end(), 0u) != keys.end()) return nullptr;
    for (std::size_t i = 0; i < mSimulations.size(); ++i)
        if (mSimulations[i] && mKeys[i] == keys) return std::move(mSimulations[i]);
    return nullptr;
}

std::uint64_t EffectParticles::ticksBehind() const {
    std::uint64_t behind = 0;
    for (std::size_t i = 0; i < mSimulations.size(); ++i) {
        const std::uint64_t target = particles::ticksAt(
            mPrepared->scene.effects[mRoots[i][0]].simulatedSeconds(), mSimulations[i]->effect().tickRate);
        behind = std::max(behind, target - std::min(target, mSimulations[i]->tick()));
    }
    return behind;
}

void EffectParticles::groupInstances() {
    const std::vector<scene::EffectInstance>& effects = mPrepared->scene.effects;
    // What is in the same tick now must stay so: all that decides about it is alike. A budget may
    // have left instances of one effect different capacities.
    std::map<std::tuple<std::filesystem::path, std::array<double, 5>, std::vector<std::uint32_t>>,
             std::size_t>
        groups;
    Place place;
    for (std::size_t i = 0; i < effects.size(); ++i) {
        if (effects[i].isSubEmitter) {
            ++place.population;
        } else {
            // Effects made in code have no file to know them by: each stands alone.
            const bool isKnown = !effects[i].file.empty();
            std::vector<std::uint32_t> capacities;
            for (const scene::Effect* effect : particles::listPopulations(effects[i].effect))
                capacities.push_back(effect->capacity);
            const scene::EffectInstance& one = effects[i];
            const std::tuple key(
                one.file, std::array{one.time, one.start, one.timeScale, one.loop, one.prewarm},
                capacities);
            const auto found = isKnown ? groups.find(key) : groups.end();
            place.simulation = found == groups.end() ? mRoots.size() : found->second;
            if (found == groups.end()) mRoots.emplace_back();
            if (isKnown) groups[key] = place.simulation;
            place.instance = static_cast<std::uint32_t>(mRoots[place.simulation].size());
            place.population = 0;
            mRoots[place.simulation].push_back(i);
        }
        mPlaces.push_back(place);
    }
}

void EffectParticles::recordSimulate(gpu::Commands& commands, std::uint64_t maxTicks) {
    for (std::size_t i = 0; i < mSimulations.size(); ++i) {
        particles::GpuSimulation& simulation = *mSimulations[i];
        const double time = mPrepared->scene.effects[mRoots[i][0]].simulatedSeconds();
        for (std::uint32_t k = 0; k < simulation.instanceCount(); ++k)
            simulation.moveTo(k, mPrepared->scene.effects[mRoots[i][k]].worldFromEffect, time);
        recordSceneDepth(commands, i);
        simulation.recordAdvanceTo(commands, time, maxTicks);
    }
}

bool EffectParticles::wantsSceneDepth() const {
    return std::any_of(mSimulations.begin(), mSimulations.end(),
                       [](const auto& simulation) { return simulation->wantsSceneDepth(); });
}

void EffectParticles::setSceneDepth(const std::optional<particles::SceneDepth>& depth) {
    mSceneDepth = depth;
    for (const auto& simulation : mSimulations) simulation->forgetSceneDepth();
}

void EffectParticles::recordSceneDepth(gpu::Commands& commands, std::size_t simulation) {
    if (!mSceneDepth || !mSimulations[simulation]->wantsSceneDepth()) return;
    std::vector<dmat4> placed;
    for (const std::size_t root : mRoots[simulation])
        placed.push_back(mPrepared->scene.effects[root].placed());
    mSimulations[simulation]->recordSceneDepth(commands, *mSceneDepth, placed);
}

void EffectParticles::declare(frame::FrameBuilder& frame, const GpuScene& scene,
                              frame::BufferRef spheres) const {
    const auto& effects = mPrepared->scene.effects;
    if (std::all_of(effects.begin(), effects.end(),
                    [](const auto& effect) { return effect.effect.surface.has_value(); }))
        return;
    frame.addPass("particles.appearance")
        .readsWrites(spheres, Access::ComputeWrite)
        .record([this, &scene, spheres](gpu::Commands& commands,
                                        const frame::PassResources& resources) {
            recordAppearances(commands, scene, resources.buffer(spheres));
        });
}

void EffectParticles::recordAppearances(gpu::Commands& commands, const GpuScene& scene,
                                        const gpu::Buffer& spheres) const {
    std::vector<particles::GpuSimulation::Appearance>& appearances = mAppearances;
    for (std::size_t s = 0; s < mSimulations.size(); ++s)
        for (std::uint32_t p = 0; p < mSimulations[s]->populationCount(); ++p) {
            appearances.clear();
            for (const std::size_t root : mRoots[s]) {
                const std::size_t i = root + p;
                const scene::EffectInstance& effect = mPrepared->scene.effects[i];
                if (effect.effect.surface) break;  // as all instances of this population
                const auto instance = static_cast<std::uint32_t>(appearances.size());
                appearances.push_back({.frame = mSimulations[s]->frame(instance, effect.placed()),
                                       .medium = effect.medium,
                                       .firstId = firstParticleId(i),
                                       .firstSphere = scene.firstEffectSphere(i)});
            }
            if (appearances.empty()) continue;
            clearLeftSlots(commands, mSimulations[s]->slotCount(p), mShownSlots[s][p], appearances,
                           spheres);
            mSimulations[s]->recordAppearance(commands, p, viewerOf(scene.camera()), appearances,
                                              spheres);
        }
}

void EffectParticles::clearLeftSlots(
    gpu::Commands& commands, std::uint32_t slots, std::uint32_t& shown,
    const std::vector<particles::GpuSimulation::Appearance>& appearances,
    const gpu::Buffer& spheres) {
    if (slots < shown) {
        // Whatever has read them is done.
        commands.fullBarrier();
        for (const auto& appearance : appearances)
            commands.fillBuffer(
                spheres, 0,
                (std::uint64_t{appearance.firstSphere} + slots) * sizeof(shader::SphereData),
                std::uint64_t{shown - slots} * sizeof(shader::SphereData));
        commands.fullBarrier();
    }
    shown = slots;
}

std::vector<Box3> EffectParticles::readBounds(gpu::Submitter& submitter, const GpuScene& scene) {
    std::vector<particles::SphereRange> ranges;
    for (std::size_t i = 0; i < mPlaces.size(); ++i) {
        const Place& place = mPlaces[i];
        const bool isShown = !mPrepared->scene.effects[i].effect.surface;
        ranges.push_back({scene.firstEffectSphere(i),
                          isShown ? mSimulations[place.simulation]->slotCount(place.population) : 0});
    }
    if (ranges.empty()) return {};
    if (!mBounds) mBounds.emplace(scene.device(), ranges.size());
    submitter.submitAndWait("bound particles", [&](gpu::Commands& commands) {
        recordAppearances(commands, scene, scene.spheres());
        mBounds->record(commands, scene.spheres(), ranges);
    });
    return particles::GpuBounds::makeBoxes(
        submitter.readBuffer<std::uint32_t>(mBounds->words(), 6 * ranges.size()),
        scene.camera().position);
}

particles::Counters EffectParticles::readCounters(gpu::Submitter& submitter) const {
    particles::Counters sum{};
    for (const auto& simulation : mSimulations)
        for (std::uint32_t p = 0; p < simulation->populationCount(); ++p) {
            const particles::Counters counters = simulation->readCounters(submitter, p);
            sum.alive += counters.alive;
            sum.born += counters.born;
            sum.died += counters.died;
            sum.rejected += counters.rejected;
            sum.killed += counters.killed;
        }
    return sum;
}

particles::CheckpointKey EffectParticles::checkpointKeyOf(std::size_t simulation,
                                                          std::size_t entry) const {
    return {particles::fingerprintOf(mSimulations[simulation]->effects(),
                                     mPrepared->scene.effects[entry].placement()),
            mPrepared->scene.effects[entry].seed, static_cast<std::uint32_t>(entry)};
}

void EffectParticles::writeCheckpoints(gpu::Submitter& submitter,
                                       const std::filesystem::path& folder, int frame) const {
    for (const auto& simulation : mSimulations)
        particles::requireReplayable(simulation->effects(), "writing checkpoints");
    for (std::size_t s = 0; s < mSimulations.size(); ++s)
        for (std::size_t i = 0; i < mRoots[s].size(); ++i)
            particles::writeCheckpoint(
                folder / checkpointName(frame, mRoots[s][i]), checkpointKeyOf(s, mRoots[s][i]),
                mSimulations[s]->readState(submitter, static_cast<std::uint32_t>(i)));
}

void EffectParticles::readCheckpoints(gpu::Submitter& submitter,
                                      const std::filesystem::path& folder, int frame) {
    std::vector<std::size_t> entries;
    for (const std::vector<std::size_t>& roots : mRoots)
        entries.insert(entries.end(), roots.begin(), roots.end());
    const std::optional<int> last = findCheckpoint(folder, frame, entries);
    if (!last) return;
    for (std::size_t s = 0; s < mSimulations.size(); ++s) {
        std::vector<particles::SimulationState> states;
        for (const std::size_t entry : mRoots[s])
            states.push_back(particles::readCheckpoint(folder / checkpointName(*last, entry),
                                                       checkpointKeyOf(s, entry),
                                                       mSimulations[s]->effects()));
        mSimulations[s]->writeState(submitter, states);
    }
}

std::vector<scene::Mesh> EffectParticles::readSurfaces(gpu::Submitter& submitter) const {
    const scene::Scene& scene = mPrepared->scene;
    std::vector<scene::Mesh> surfaces;
    for (std::size_t i = 0; i < mPlaces.size(); ++i) {
        const scene::EffectInstance& effect = scene.effects[i];
        if (!effect.effect.surface) continue;
        const Place& place = mPlaces[i];
        const particles::GpuSimulation& simulation = *mSimulations[place.simulation];
        const auto state = simulation.readState(submitter, place.instance);
        const std::uint32_t root = rootOf(place);
        scene::Mesh mesh = particles::makeSurfaceMesh(
            {.effect = effect.effect,
             .compiled = simulation.effect(place.population),
             .state = state,
             .population = place.population,
             .random = particles::instanceParameters(effect.seed, root, place.population).random,
             .sinceTick = simulation.sinceTick()},
            simulation.frame(place.instance, effect.placed()),
            scene::makeCameraFrame(scene.camera, scene.image.width, scene.image.height),
            effect.material);
        if (!mesh.indices.empty()) surfaces.push_back(std::move(mesh));
    }
    return surfaces;
}

std::vector<scene::MediumSphere> EffectParticles::readSpheres(gpu::Submitter& submitter) const {
    std::vector<scene::MediumSphere> spheres;
    const scene::Scene& scene = mPrepared->scene;
    const particles::Viewer viewer = viewerOf(
        scene::makeCameraFrame(scene.camera, scene.image.width, scene.image.height));
    for (std::size_t i = 0; i < mPlaces.size(); ++i) {
        const scene::EffectInstance& effect = mPrepared->scene.effects[i];
        if (effect.effect.surface) continue;
        const Place& place = mPlaces[i];
        const particles::GpuSimulation& simulation = *mSimulations[place.simulation];
        const auto snapshot = simulation.readState(submitter, place.instance);
        const auto shown = particles::makeSpheres(
            simulation.effect(place.population), snapshot.populations[place.population],
            snapshot.tick, simulation.sinceTick(),
            simulation.frame(place.instance, effect.placed()), effect.medium, firstParticleId(i),
            particles::instanceParameters(effect.seed, rootOf(place), place.population).random,
            viewer);
        spheres.insert(spheres.end(), shown.begin(), shown.end());
    }
    return spheres;
}

std::uint32_t EffectParticles::rootOf(const Place& place) const {
    return static_cast<std::uint32_t>(mRoots[place.simulation][place.instance]);
}

std::uint64_t EffectParticles::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& simulation : mSimulations) sum += simulation->bytes();
    if (mBounds) sum += mBounds->bytes();
    return sum;
}

}  // namespace brume::render
