// SPDX-License-Identifier: Apache-2.0
// The scene's particle effects on the device: simulated to their time, shown as spheres.
#pragma once

#include <frame/frame_builder.hpp>
#include <gpu/submitter.hpp>
#include <particles/gpu_bounds.hpp>
#include <particles/gpu_simulation.hpp>
#include <render/gpu_scene.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace brume::render {

class EffectParticles {
  public:
    /// Nothing is simulated yet; `scene` must outlive this. Takes simulations over from `previous`
    /// (may be null) whose instances have the same keys.
    EffectParticles(gpu::Device& device, const PreparedScene& scene,
                    EffectParticles* previous = nullptr);

    /// Records the ticks of every effect up to its time in the scene: at most `maxTicks` of each, so
    /// that what lags behind catches up over several calls.
    void recordSimulate(gpu::Commands& commands, std::uint64_t maxTicks = ~std::uint64_t{0});

    /// Whether an effect collides with what the picture shows (module collide_depth).
    bool wantsSceneDepth() const;
    /// What ticks recorded from now on collide with; it must stay as long. Null: nothing.
    void setSceneDepth(const std::optional<particles::SceneDepth>& depth);

    /// Pass "particles.appearance": fills the effects' slots of `spheres`. Nothing without effects.
    void declare(frame::FrameBuilder& frame, const GpuScene& scene, frame::BufferRef spheres) const;

    /// The scene counts from another point now: its transforms have changed, and nothing moves.
    void rebase(const dvec3& newOrigin) {
        for (const auto& simulation : mSimulations) simulation->rebase(newOrigin);
    }

    /// Ticks that the effect farthest from its time is behind.
    std::uint64_t ticksBehind() const;

    /// Writes the state of each instance to a file of its own in `folder`. Submits and waits; throws
    /// a failure Error, an input Error for effects that are not replayable.
    void writeCheckpoints(gpu::Submitter& submitter, const std::filesystem::path& folder,
                          int frame) const;
    /// Goes on from the last states in `folder` that are complete and not after `frame`; from the
    /// beginning where there are none. Throws an input Error for those of other effects or seeds.
    void readCheckpoints(gpu::Submitter& submitter, const std::filesystem::path& folder, int frame);

    /// Boxes around the particles of each entry of the scene's effects, as spheres of radii that
    /// they have now; empty for ribbons and billboards. Found on the device: `scene` is filled as by
    /// declare(). Submits and waits.
    std::vector<Box3> readBounds(gpu::Submitter& submitter, const GpuScene& scene);

    /// What births have come to, of all instances and sub-emitters. Submits and waits.
    particles::Counters readCounters(gpu::Submitter& submitter) const;

    std::vector<scene::MediumSphere> readSpheres(gpu::Submitter& submitter) const;

    /// Ribbons and billboards as they are now, facing the scene's camera, in the order of its
    /// entries. Submits and waits.
    std::vector<scene::Mesh> readSurfaces(gpu::Submitter& submitter) const;
    std::uint64_t bytes() const;

  private:
    /// Where an entry of the scene's effects is simulated.
    struct Place {
        std::size_t simulation = 0;
        std::uint32_t instance = 0;
        std::uint32_t population = 0;
    };
    void groupInstances();
    std::uint32_t rootOf(const Place& place) const;  // the entry of its root
    void recordSceneDepth(gpu::Commands& commands, std::size_t simulation);
    void recordAppearances(gpu::Commands& commands, const GpuScene& scene,
                           const gpu::Buffer& spheres) const;
    /// Empties the slots that a simulation which began anew has no particles in any more.
    static void clearLeftSlots(
        gpu::Commands& commands, std::uint32_t slots, std::uint32_t& shown,
        const std::vector<particles::GpuSimulation::Appearance>& appearances,
        const gpu::Buffer& spheres);
    particles::CheckpointKey checkpointKeyOf(std::size_t simulation, std::size_t entry) const;
    std::vector<std::uint64_t> keysOf(const std::vector<std::size_t>& roots) const;
    std::unique_ptr<particles::GpuSimulation> takeOver(const std::vector<std::uint64_t>& keys);

    const PreparedScene* mPrepared;
    std::vector<Place> mPlaces;  // by entry
    std::vector<std::vector<std::size_t>> mRoots;  // by simulation: the entries of its instances
    std::vector<std::unique_ptr<particles::GpuSimulation>> mSimulations;
    std::vector<std::vector<std::uint64_t>> mKeys;  // by simulation, of its instances
    mutable std::vector<particles::GpuSimulation::Appearance> mAppearances;  // keeps its memory
    mutable std::vector<std::vector<std::uint32_t>> mShownSlots;  // by simulation, population
    std::optional<particles::SceneDepth> mSceneDepth;
    std::optional<particles::GpuBounds> mBounds;  // once it is asked for
};

/// Id of the first particle of an effect; ids only order what begins at equal distances.
std::uint32_t firstParticleId(std::size_t effect);

}  // namespace brume::render
