// SPDX-License-Identifier: Apache-2.0
#include <particles/surfaces.hpp>
#include <render/effect_particles.hpp>
#include <scene/camera.hpp>

#include <algorithm>
#include <map>

namespace brume::render {

using frame::Access;

std::uint32_t firstParticleId(std::size_t effect) {
    return static_cast<std::uint32_t>(effect + 1) << 24;
}

EffectParticles::EffectParticles(gpu::Submitter& submitter, const PreparedScene& prepared)
    : mPrepared(&prepared) {
    groupInstances();
    simulate(submitter);
    readSurfaces(submitter);
}

void EffectParticles::groupInstances() {
    const std::vector<scene::EffectInstance>& effects = mPrepared->scene.effects;
    std::map<std::pair<std::filesystem::path, double>, std::size_t> groups;
    Place place;
    for (std::size_t i = 0; i < effects.size(); ++i) {
        if (effects[i].isSubEmitter) {
            ++place.population;
        } else {
            // Effects made in code have no file to know them by: each stands alone.
            const bool isKnown = !effects[i].file.empty();
            const std::pair key(effects[i].file, effects[i].simulatedSeconds());
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

void EffectParticles::simulate(gpu::Submitter& submitter) {
    for (const std::vector<std::size_t>& roots : mRoots) {
        std::vector<particles::EffectInstance> instances;
        for (const std::size_t i : roots)
            instances.push_back({mPrepared->scene.effects[i].seed, static_cast<std::uint32_t>(i)});
        const scene::EffectInstance& first = mPrepared->scene.effects[roots[0]];
        mSimulations.push_back(std::make_unique<particles::GpuSimulation>(
            submitter.device(), first.effect, instances));
        submitter.submitAndWait("simulate " + first.file.filename().string(),
                                [&](gpu::Commands& commands) {
                                    mSimulations.back()->recordAdvanceTo(
                                        commands, first.simulatedSeconds());
                                });
    }
}

void EffectParticles::readSurfaces(gpu::Submitter& submitter) {
    const scene::Scene& scene = mPrepared->scene;
    for (std::size_t i = 0; i < mPlaces.size(); ++i) {
        const scene::EffectInstance& effect = scene.effects[i];
        if (!effect.effect.surface) continue;
        const Place& place = mPlaces[i];
        const particles::GpuSimulation& simulation = *mSimulations[place.simulation];
        const auto state = simulation.readState(submitter, place.instance);
        const auto root =
            static_cast<std::uint32_t>(mRoots[place.simulation][place.instance]);
        scene::Mesh mesh = particles::makeSurfaceMesh(
            {.effect = effect.effect,
             .compiled = simulation.effect(place.population),
             .state = state,
             .population = place.population,
             .random = particles::instanceParameters(effect.seed, root, place.population).random,
             .sinceTick = simulation.sinceTick()},
            effect.worldFromEffect,
            scene::makeCameraFrame(scene.camera, scene.image.width, scene.image.height),
            effect.material);
        if (!mesh.indices.empty()) mSurfaces.push_back(std::move(mesh));
    }
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
            for (std::size_t i = 0; i < mPlaces.size(); ++i) {
                const scene::EffectInstance& effect = mPrepared->scene.effects[i];
                if (effect.effect.surface) continue;
                mSimulations[mPlaces[i].simulation]->recordAppearance(
                    commands, {.worldFromEffect = effect.worldFromEffect,
                               .cameraPosition = scene.camera().position,
                               .medium = effect.medium,
                               .firstId = firstParticleId(i),
                               .spheres = &resources.buffer(spheres),
                               .firstSphere = scene.firstEffectSphere(i),
                               .population = mPlaces[i].population,
                               .instance = mPlaces[i].instance});
            }
        });
}

std::vector<scene::MediumSphere> EffectParticles::readSpheres(gpu::Submitter& submitter) const {
    std::vector<scene::MediumSphere> spheres;
    for (std::size_t i = 0; i < mPlaces.size(); ++i) {
        const scene::EffectInstance& effect = mPrepared->scene.effects[i];
        if (effect.effect.surface) continue;
        const Place& place = mPlaces[i];
        const particles::GpuSimulation& simulation = *mSimulations[place.simulation];
        const auto snapshot = simulation.readState(submitter, place.instance);
        const auto shown = particles::makeSpheres(
            simulation.effect(place.population), snapshot.populations[place.population],
            snapshot.tick, simulation.sinceTick(), effect.worldFromEffect, effect.medium,
            firstParticleId(i));
        spheres.insert(spheres.end(), shown.begin(), shown.end());
    }
    return spheres;
}

std::uint64_t EffectParticles::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& simulation : mSimulations) sum += simulation->bytes();
    return sum;
}

}  // namespace brume::render
