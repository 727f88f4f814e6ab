// SPDX-License-Identifier: Apache-2.0
// Particles as thin surfaces: ribbons along their strands, billboards with a film over their life.
// What they look like at an age is baked into textures of the material, so that every method and
// the reference see plain meshes. Limits: density by speed does not count; a billboard's film has at
// most 256 pictures, each a blend of the frames around it.
#pragma once

#include <particles/simulation_state.hpp>
#include <scene/camera.hpp>
#include <scene/scene.hpp>

namespace brume::particles {

/// `base` with the effect's density (as coverage, at most 1) and tint over life: its colour texture
/// has them along u for ribbons, cell by cell for billboards. A smooth profile fades towards the
/// edges as (1 - r^2)^2. The effect has a surface.
scene::Material makeSurfaceMaterial(const scene::Material& base, const scene::Effect& effect);

/// One population of an instance at a time.
struct SurfaceParticles {
    const scene::Effect& effect;  ///< has a surface
    const CompiledEffect& compiled;
    const SimulationState& state;
    std::uint32_t population = 0;
    shader::RandomStream random{};  ///< of instanceParameters()
    double sinceTick = 0;           ///< places and ages move on by that
};

/// The surface facing the camera, with uvs for makeSurfaceMaterial(); without vertices if there is
/// nothing to see. A ribbon of a trail ends at the parent while that lives.
scene::Mesh makeSurfaceMesh(const SurfaceParticles& particles, const ParticleFrame& frame,
                            const scene::CameraFrame& camera, std::uint32_t material);

}  // namespace brume::particles
