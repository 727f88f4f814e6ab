// SPDX-License-Identifier: Apache-2.0
// The techniques of one scene on one device, and the passes of a frame made of them: what the
// renderer of whole images and the renderer within a host's frame share.
#pragma once

#include <oit/oit_method.hpp>
#include <render/backdrop.hpp>
#include <render/effect_particles.hpp>
#include <render/opaque_pass.hpp>
#include <render/shadow_casters.hpp>
#include <shadows/shadows.hpp>

#include <optional>

namespace brume::render {

/// Set up in this order: constructor; recordContent(); simulate; addShadows(), if the scene has
/// any; addMethod(). Everything that the constructor's arguments refer to must outlive it.
class Composer {
  public:
    /// Makes what does not depend on the particles: the scene's memory and the effects, whose
    /// simulations `previous` may hand over (may be null). Throws an Error.
    Composer(gpu::Device& device, const PreparedScene& scene, const Options& options,
             const View& view, EffectParticles* previous = nullptr);

    /// Records the upload of the scene and its casters. Allocates what a frame keeps.
    void recordContent(gpu::Commands& commands);

    bool hasShadows() const { return scene.makeInputs().needs.shadowStores != 0; }
    /// Makes the shadow maps for casters within these bounds; they are ready after
    /// Shadows::prepare() or reserve().
    void addShadows(const Box3& translucentBounds);
    void addMethod();

    /// Passes that place the particles and build the shadow maps.
    frame::BufferRef declareParticles(frame::FrameBuilder& frame);
    void declareShadows(frame::FrameBuilder& frame, frame::BufferRef spheres);
    /// Room for the result.
    void declareResult(frame::FrameBuilder& frame, oit::Inputs& inputs) const;

    /// Device memory by kind, of all parts.
    std::map<std::string, std::uint64_t> bytes() const;

    gpu::Device& device;
    const PreparedScene& prepared;
    Options options;            ///< without the settings below
    std::uint64_t shuffleSeed;  ///< setting "shuffle"; 0: spheres stay as they come
    scene::Settings shadowSettings;
    oit::CallersRendering callers;  ///< set before addMethod(): it draws there
    bool isHosted = false;          ///< set before addMethod(): a host has drawn what lies behind
    GpuScene scene;
    EffectParticles effects;
    OpaquePass opaque;
    std::optional<ShadowCasters> casters;
    std::optional<shadows::Shadows> shadows;
    std::unique_ptr<oit::OitMethod> method;
    bool areSpheresFinal = false;  ///< no effect writes them any more
    bool areShadowsReady = false;  ///< declareShadows() adds their passes
};

}  // namespace brume::render
