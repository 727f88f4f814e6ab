// SPDX-License-Identifier: Apache-2.0
// The scene's particle effects on the device: simulated to their time, shown as spheres.
#pragma once

#include <frame/frame_builder.hpp>
#include <gpu/submitter.hpp>
#include <particles/gpu_simulation.hpp>
#include <render/gpu_scene.hpp>

#include <memory>
#include <vector>

namespace brume::render {

class EffectParticles {
  public:
    /// Simulates every effect of the scene up to its time.
    EffectParticles(gpu::Submitter& submitter, const PreparedScene& scene);

    /// Pass "particles.appearance": fills the effects' slots of `spheres`. Nothing without effects.
    void declare(frame::FrameBuilder& frame, const GpuScene& scene, frame::BufferRef spheres) const;

    std::vector<scene::MediumSphere> readSpheres(gpu::Submitter& submitter) const;

    /// Ribbons and billboards at the effects' time, in the order of the scene's entries.
    const std::vector<scene::Mesh>& surfaces() const { return mSurfaces; }
    std::uint64_t bytes() const;

  private:
    /// Where an entry of the scene's effects is simulated.
    struct Place {
        std::size_t simulation = 0;
        std::uint32_t instance = 0;
        std::uint32_t population = 0;
    };
    void groupInstances();
    void simulate(gpu::Submitter& submitter);
    void readSurfaces(gpu::Submitter& submitter);

    const PreparedScene* mPrepared;
    std::vector<Place> mPlaces;  // by entry
    std::vector<std::vector<std::size_t>> mRoots;  // by simulation: the entries of its instances
    std::vector<std::unique_ptr<particles::GpuSimulation>> mSimulations;
    std::vector<scene::Mesh> mSurfaces;
};

/// Id of the first particle of an effect; ids only order what begins at equal distances.
std::uint32_t firstParticleId(std::size_t effect);

}  // namespace brume::render
