// SPDX-License-Identifier: Apache-2.0
// A scene with the meshes that its effects show.
#pragma once

#include <gpu/submitter.hpp>
#include <render/effect_particles.hpp>
#include <render/renderer.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace brume::render {

/// Ribbons and billboards are meshes that face the camera: where effects show such, they are
/// simulated before the scene is composed, which then has the meshes too.
struct SurfacedScene {
    std::optional<PreparedScene> scene;  ///< none: no effect shows surfaces
    std::unique_ptr<EffectParticles> effects;  ///< at their times
    std::vector<scene::Mesh> surfaces;
    std::size_t stillMeshCount = 0;  ///< of the scene, before those

    /// Goes on with the simulations of `previous`, which may be null.
    SurfacedScene(gpu::Device& device, gpu::Submitter& submitter, const PreparedScene& prepared,
                  EffectParticles* previous);

    void replaceSurfaces(std::vector<scene::Mesh> now);

    /// The caller's scene has moved on in time or is seen from elsewhere.
    void follow(const PreparedScene& prepared);
};

}  // namespace brume::render
