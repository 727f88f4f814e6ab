// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bench/prepare.hpp>
#include <core/frame_path.hpp>
#include <particles/budget.hpp>
#include <particles/cpu_simulation.hpp>
#include <particles/surfaces.hpp>
#include <scene/camera.hpp>
#include <volumes/vdb_file.hpp>
#include <volumes/volume_spheres.hpp>

namespace brume::bench {
namespace {

double largestExtinction(const scene::Medium& medium) {
    return std::max({medium.extinction.x, medium.extinction.y, medium.extinction.z});
}

void addVolume(scene::Volume volume, int frame, const Log& log, render::PreparedScene& prepared) {
    if (hasFrameNumber(volume.file))
        volume.file = makeFramePath(volume.file, frame + volume.frameOffset);
    const double extinction = largestExtinction(prepared.scene.media[volume.medium]);
    volumes::VolumeGrid grid = volumes::loadVolume(volume, extinction, log);
    if (volume.representation == scene::VolumeRepresentation::Particles) {
        volumes::SphereOptions options;
        options.medium = volume.medium;
        options.firstId = static_cast<std::uint32_t>(prepared.spheres.size());
        const auto spheres = volumes::convertToSpheres(grid, options);
        prepared.spheres.insert(prepared.spheres.end(), spheres.begin(), spheres.end());
        volumes::VolumeGrid empty;
        empty.name = grid.name;
        empty.worldFromIndex = grid.worldFromIndex;
        empty.report = grid.report;
        grid = std::move(empty);
    }
    prepared.volumes.push_back(std::move(grid));
}

void prepareEffects(scene::Scene& scene) {
    for (scene::EffectInstance& instance : scene.effects) {
        volumes::loadEffectFields(instance.effect);
        // A scene that is prepared for another frame has its own materials already.
        if (!instance.effect.surface || instance.isPrepared) continue;
        instance.isPrepared = true;
        scene.materials.push_back(particles::makeSurfaceMaterial(
            scene.materials[instance.material], instance.effect));
        instance.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
    }
}

}  // namespace

render::PreparedScene prepareScene(scene::Scene scene, const Log& log, int frame) {
    render::PreparedScene prepared;
    prepared.scene = std::move(scene);
    prepared.spheres = scene::makeMediumSpheres(prepared.scene.spheres);
    particles::warnOfCut(particles::applyBudgets(prepared.scene), prepared.scene, log);
    prepareEffects(prepared.scene);
    for (const scene::Volume& volume : prepared.scene.volumes)
        addVolume(volume, frame, log, prepared);
    return prepared;
}

bool hasVolumeSequence(const scene::Scene& scene) {
    return std::any_of(scene.volumes.begin(), scene.volumes.end(),
                       [](const scene::Volume& volume) { return hasFrameNumber(volume.file); });
}

render::EffectContents simulateOnCpu(const scene::Scene& scene) {
    render::EffectContents contents;
    const scene::CameraFrame camera =
        scene::makeCameraFrame(scene.camera, scene.image.width, scene.image.height);
    // Ids above those that prepareScene() gives, so that ties are broken alike in every run.
    std::uint64_t firstId = std::uint64_t{1} << 30;
    for (std::size_t i = 0; i < scene.effects.size();) {
        const auto instance = static_cast<std::uint32_t>(i);
        const scene::EffectInstance& root = scene.effects[i];
        particles::CpuSimulation simulation(root.effect, root.seed, instance, root.placement());
        simulation.advanceTo(root.simulatedSeconds());
        const particles::SimulationState state = simulation.state();
        const particles::ParticleFrame frame = simulation.frame(root.placed());
        // Its populations are the next entries of the scene.
        for (std::uint32_t p = 0; p < simulation.populationCount(); ++p, ++i) {
            const scene::EffectInstance& effect = scene.effects[i];
            if (effect.effect.surface) {
                scene::Mesh mesh = particles::makeSurfaceMesh(
                    {.effect = effect.effect,
                     .compiled = simulation.effect(p),
                     .state = state,
                     .population = p,
                     .random = particles::instanceParameters(root.seed, instance, p).random,
                     .sinceTick = simulation.sinceTick()},
                    frame, camera, effect.material);
                if (!mesh.indices.empty()) contents.surfaces.push_back(std::move(mesh));
                continue;
            }
            const particles::Viewer viewer{camera.position,
                                           camera.type == scene::CameraType::Perspective};
            const auto added = simulation.spheres(frame, effect.medium,
                                                  static_cast<std::uint32_t>(firstId), p, viewer);
            contents.spheres.insert(contents.spheres.end(), added.begin(), added.end());
            firstId += simulation.counters(p).born + simulation.counters(p).rejected;
        }
    }
    return contents;
}

}  // namespace brume::bench
