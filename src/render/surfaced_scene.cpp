// SPDX-License-Identifier: Apache-2.0
#include <render/surfaced_scene.hpp>

#include <algorithm>

namespace brume::render {

SurfacedScene::SurfacedScene(gpu::Device& device, gpu::Submitter& submitter,
                             const PreparedScene& prepared, EffectParticles* previous) {
    const auto& all = prepared.scene.effects;
    if (std::none_of(all.begin(), all.end(),
                     [](const auto& effect) { return effect.effect.surface.has_value(); }))
        return;
    scene = prepared;
    // The composer takes the simulations over by their keys.
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].key == 0) scene->scene.effects[i].key = ~static_cast<std::uint64_t>(i);
    effects = std::make_unique<EffectParticles>(device, *scene, previous);
    submitter.submitAndWait("simulate", [&](gpu::Commands& commands) {
        effects->recordSimulate(commands);
    });
    stillMeshCount = scene->scene.meshes.size();
    replaceSurfaces(effects->readSurfaces(submitter));
}

void SurfacedScene::replaceSurfaces(std::vector<scene::Mesh> now) {
    surfaces = std::move(now);
    std::vector<scene::Mesh>& meshes = scene->scene.meshes;
    meshes.resize(stillMeshCount);
    meshes.insert(meshes.end(), surfaces.begin(), surfaces.end());
}

void SurfacedScene::follow(const PreparedScene& prepared) {
    scene->scene.camera = prepared.scene.camera;
    scene->scene.image = prepared.scene.image;
    for (std::size_t i = 0; i < prepared.scene.effects.size(); ++i)
        scene->scene.effects[i].time = prepared.scene.effects[i].time;
}

}  // namespace brume::render
