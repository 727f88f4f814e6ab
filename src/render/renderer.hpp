// SPDX-License-Identifier: Apache-2.0
// From a scene to an image on the GPU: finds out what the scene needs, chooses and specialises the
// techniques for just that, and composes a frame from them.
#pragma once

#include <core/image.hpp>
#include <core/log.hpp>
#include <scene/medium_sphere.hpp>
#include <scene/scene.hpp>
#include <scene/settings.hpp>
#include <volumes/volume_grid.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brume::gpu {
class Device;
class Image;
}  // namespace brume::gpu

namespace brume::render {

class EffectParticles;

/// A scene with its files loaded: what both the GPU renderer and the reference see.
struct PreparedScene {
    scene::Scene scene;  ///< the materials of its effects' surfaces are those that they show
    std::vector<volumes::VolumeGrid> volumes;  ///< parallel to scene.volumes
    std::vector<scene::MediumSphere> spheres;  ///< scene.spheres and the volumes converted to
                                               ///< particles; effects are simulated by the renderer
};

/// What effects show at their time.
struct EffectContents {
    std::vector<scene::MediumSphere> spheres;
    std::vector<scene::Mesh> surfaces;  ///< ribbons and billboards, facing the camera
};

struct Options {
    std::string method = "tile";
    scene::Settings settings;  ///< of the method; "shadow.<name>" of all lights' shadow maps;
                               ///< "shuffle"
    bool hostLayers = false;  ///< a host draws layers of its own: method weighted only
    bool triangleHashes = false;  ///< also return which triangles each pixel saw
};

struct PassTime {
    std::string name;  ///< e.g. "oit.linked_list.resolve"
    double timeMs = 0;
    std::uint64_t bytes = 0;      ///< of what it declares to read and to write, each once
    std::uint64_t fragments = 0;  ///< shader invocations, if Renderer::countFragments()
};

struct Result {
    Image image;  ///< scene.image.width x height
    std::vector<std::uint32_t>
        triangles;      ///< as reference::Result::triangles; empty unless asked for
    double timeMs = 0;  ///< first to last command of the frame, on the device
    double wallMs = 0;  ///< recording, submitting and waiting for it, on the host
    std::vector<PassTime> passes;
    std::map<std::string, std::uint64_t> bytes;     ///< device memory by kind; "total" among them
    std::map<std::string, std::uint64_t> counters;  ///< stored, dropped, bands, longestList, ...
    std::optional<double> errorBound;  ///< the method's, see OitMethod::errorBound()
};

struct ShadowSamples {
    std::vector<vec3> values;      ///< in [0, 1]
    double buildMs = 0;            ///< all passes that build maps, on the device
    double sampleMs = 0;           ///< asking at all positions
    double bytesPerTexel = 0;      ///< of the light's own map
    /// The value at a point is an average under a tent this wide to either side of it, along two
    /// directions across the light; 0 where the map has no texels. Directional lights only.
    double footprint = 0;
    dvec3 right{0}, up{0};
};

/// One scene on one device. Not thread-safe. Owns all its GPU objects; the device must outlive it.
/// As the first host of the library it submits and waits itself.
class Renderer {
  public:
    /// Uploads the scene and simulates its effects to their time. Throws an Error (input: unknown
    /// method, bad setting; failure: device).
    /// Goes on with the simulations of `previous` (may be null) whose instances have the same keys
    /// (scene::EffectInstance::key); it is of no use afterwards.
    Renderer(gpu::Device& device, const PreparedScene& scene, const Options& options,
             const Log& log, EffectParticles* previous = nullptr);
    ~Renderer();

    /// Renders one frame and reads it back. May be called again (benchmarks): same image, new
    /// times.
    Result renderFrame();

    /// Whether frames count their fragments, which costs time. Where the device cannot, they are 0.
    void countFragments(bool isWanted);

    /// Particles as simulated on the device, read back: for the reference.
    EffectContents readEffects() const;

    /// The same, but the image goes to `target` instead of the result: as large as the scene's
    /// (times supersample), of any float colour format; it is left to be sampled.
    Result drawFrame(const gpu::Image& target);

    /// Goes on to what the scene has become: the times of its effects, the camera, the size of the
    /// image; nothing else has changed. What is made for a size is kept for a few of them. False
    /// where that takes a new renderer, which takeEffects() helps.
    bool advance();

    /// The simulations, for the renderer of the next frame; this one is of no use afterwards.
    std::unique_ptr<EffectParticles> takeEffects();

    /// Builds the shadow maps and asks them at world positions: the share of a light (counted
    /// without the ambient ones) that arrives there, per channel.
    ShadowSamples probeShadows(std::uint32_t light, std::span<const dvec3> positions) const;

    /// Needs, passes, targets and bytes per pixel, as text for --explain.
    std::string explain() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

}  // namespace brume::render
