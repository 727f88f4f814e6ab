// SPDX-License-Identifier: Apache-2.0
// Media, thin surfaces and solids rastered as layers: the passes that all rastered methods share. A
// method supplies only what a fragment does with its layer.
//
// Limits: a medium is one layer and not mixed with what overlaps it, unless the method does so; the
//         solids of a pixel are one layer together, from the first face to the last.
// Cost: solids: one raster pass more and 40 bytes per pixel.
#pragma once

#include <gpu/pipeline.hpp>
#include <oit/inputs.hpp>
#include <scene/settings.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace brume::oit {

/// What the solids of a frame leave behind, for methods that draw their layer.
struct SolidTargets {
    frame::ImageRef depth, source, range;
    explicit operator bool() const { return static_cast<bool>(depth); }
};

/// Sums the faces of solids. One per method, whatever the number of its layer passes.
class Solids {
  public:
    /// `name`: of the method, e.g. "oit.weighted". Without solids nothing is made.
    Solids(gpu::Device& device, const std::string& name, const Inputs& inputs);

    /// Pass "<name>.solids"; empty references if the scene has no solids.
    SolidTargets declare(frame::FrameBuilder& frame, const Inputs& inputs) const;

  private:
    std::string mName;
    gpu::GraphicsPipeline mPipeline;
};

/// shaders/oit/<method>/{media,surface,solid}.frag.
struct LayerShaders {
    std::span<const std::uint32_t> media, surface, solid;
};

/// What layers do with an attached depth.
enum class DepthUse {
    Idle,         ///< nothing
    Test,          ///< where it is 1 none is drawn, where it is 0 all are
    TestAndWrite,  ///< the nearest stays
    Mark           ///< leave something else than 0 wherever they are
};

/// Which pixels layers have touched: a depth cleared to 0, which they mark. A resolve can then leave
/// all others alone.
inline constexpr VkFormat kTouchedFormat = VK_FORMAT_D16_UNORM;

struct LayerPassDesc {
    std::string name;  ///< e.g. "oit.weighted.store"
    LayerShaders shaders;
    std::vector<gpu::Binding> bindings;         ///< the method's own, from kBindingLayerOwn on
    std::vector<std::uint32_t> specialization;  ///< its own, from kLayerConstantOwn on
    std::vector<gpu::ColorTarget> colors;
    std::uint32_t scale = 1;  ///< pixels of the image per edge of a texel of the targets
    bool drawsSolidFaces = false;  ///< surface shaders want the faces of solids as well
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;  ///< set: a depth is attached
    DepthUse depthUse = DepthUse::TestAndWrite;
};

/// How a method uses one drawing of its layers.
struct LayerUse {
    /// Binds the method's own bindings.
    std::function<void(gpu::Commands&, const frame::PassResources&)> bind;
    std::uint32_t step = 0;    ///< shaders: push.step
    VkDeviceAddress data = 0;  ///< shaders: push.data
    frame::BufferRef order;    ///< of the media: uint[spheres + boxes]; empty: as they come
};

/// What to draw.
enum LayerKinds : std::uint32_t { kLayersMedia = 1, kLayersSurfaces = 2, kLayersAll = 3 };

/// One way of drawing layers into targets.
class LayerPass {
  public:
    LayerPass() = default;
    /// `kinds`: a set of LayerKinds; solids belong to the surfaces.
    LayerPass(gpu::Device& device, const Inputs& inputs, const LayerPassDesc& desc,
              std::uint32_t kinds = kLayersAll);

    /// Declares what the layers read; the caller adds its targets and own bindings.
    static void declareReads(frame::PassBuilder& pass, const Inputs& inputs,
                             const SolidTargets& solids, frame::BufferRef order = {});

    /// Draws everything, media first.
    void record(gpu::Commands& commands, const frame::PassResources& resources,
                const Inputs& inputs, const SolidTargets& solids, const LayerUse& use = {}) const;

  private:
    void recordMedia(gpu::Commands& commands, const frame::PassResources& resources,
                     const Inputs& inputs, const LayerUse& use) const;
    void recordSurfaces(gpu::Commands& commands, const frame::PassResources& resources,
                        const Inputs& inputs, const LayerUse& use) const;
    void recordSolids(gpu::Commands& commands, const frame::PassResources& resources,
                      const Inputs& inputs, const SolidTargets& solids, const LayerUse& use) const;

    bool mDrawsSolidFaces = false;
    bool mMarks = false;
    gpu::GraphicsPipeline mMedia, mSurfaces, mSolids;
};

/// The setting of methods that can render media at a fraction of the size: pixels per edge of their
/// texels. Surfaces stay at full size.
inline constexpr scene::SettingInfo kLowResolution{"lowResolution", "1, 2, 4", "1",
                                            "pixels per edge of a texel for media"};
std::uint32_t readLowResolution(scene::SettingsReader& reader);
/// The image's size in such texels.
VkExtent2D lowExtent(const Inputs& inputs, std::uint32_t lowResolution);

/// Layers blended with "over": what `unordered` and `sorted` share.
class OverLayers {
  public:
    /// `name` of the method's prefix, e.g. "oit.sorted".
    OverLayers(gpu::Device& device, const std::string& name, const Inputs& inputs,
               std::uint32_t lowResolution);

    /// Passes "<name>.clear", "<name>.store_low" where media have a size of their own, and
    /// "<name>.store"; the last is within callers' rendering. `order`: uint[spheres + boxes] as
    /// written by an earlier pass, or empty for the order of submission.
    void declare(frame::FrameBuilder& frame, const Inputs& inputs, frame::BufferRef order) const;

  private:
    LayerPassDesc describePass(const char* suffix, const CallersRendering& callers) const;
    frame::ImageRef declareLow(frame::FrameBuilder& frame, const Inputs& inputs,
                               frame::BufferRef order) const;

    std::string mName;
    std::uint32_t mLowResolution;
    Solids mSolids;
    LayerPass mLow, mPass;
    gpu::GraphicsPipeline mUpsample;
};

/// A full-screen pass that composes what layers have left: pass `name` writes inputs.result.
/// `skipsUntouched`: only where layers have marked.
gpu::GraphicsPipeline makeResolve(gpu::Device& device, const std::string& name,
                                  std::span<const std::uint32_t> fragment,
                                  const std::vector<gpu::Binding>& bindings,
                                  const std::vector<std::uint32_t>& specialization,
                                  std::uint32_t pushConstantBytes = 0,
                                  bool skipsUntouched = false);

/// Declares and records such a pass: reads `images` (binding, image) and draws. `push` (may be
/// empty) sets the push constants. `touched`: the marks, for a pipeline that skips; the other pixels
/// show what is opaque, by a copy in a pass "<name>_untouched".
frame::PassBuilder& declareResolve(frame::FrameBuilder& frame, const Inputs& inputs, const std::string& name,
                    const gpu::GraphicsPipeline& pipeline,
                    std::vector<std::pair<std::uint32_t, frame::ImageRef>> images,
                    const std::function<void(gpu::Commands&)>& push = {},
                    frame::ImageRef touched = {});

/// Pass `name`: the result is what is opaque.
void declareCopyOfOpaque(frame::FrameBuilder& frame, const Inputs& inputs, const std::string& name);

/// A transient target as large as the image.
frame::ImageRef makeLayerTarget(frame::FrameBuilder& frame, const Inputs& inputs,
                                const std::string& name, VkFormat format);

/// Do layers differ between channels in what they let through?
bool isColoured(const Needs& needs);

}  // namespace brume::oit
