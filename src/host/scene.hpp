// SPDX-License-Identifier: Apache-2.0
// One scene of a host: from its contents to the commands of each frame.
#pragma once

#include <frame/frame_builder.hpp>
#include <host/model.hpp>
#include <render/composer.hpp>
#include <render/host_view.hpp>

#include <memory>
#include <optional>

namespace brume::host {

class Scene {
  public:
    Scene(Context& context, const BrumeSceneCreateInfo& info);

    Context& context() const { return *mContext; }
    Model& model() { return mModel; }

    void prepare(const BrumeView& view);
    void simulate(VkCommandBuffer commands, const BrumeStep& step);
    void shadow(VkCommandBuffer commands, const BrumeView& view);
    void render(VkCommandBuffer commands, const BrumeView& view);
    void beginLayers(VkCommandBuffer commands, const BrumeView& view);
    void endLayers(VkCommandBuffer commands);
    void prepareDraw(VkCommandBuffer commands, const BrumeView& view);
    void draw(VkCommandBuffer commands);
    VkDeviceAddress shadowOf(BrumeId light) const;
    BrumeCounters counters() const;

    /// The world counts from another point now; nothing moves.
    void rebase(const double* newOrigin);

    /// What was recorded in this frame will not be submitted: all memory is made anew and effects
    /// catch up.
    void forgetFrame();

  private:
    template <typename Work>
    void record(const char* call, const Work& work);
    /// What memory and pipelines are made for.
    struct Made {
        std::uint64_t structure = 0;
        VkExtent2D viewport{};
        scene::CameraType camera = scene::CameraType::Perspective;
        BrumeImage color{}, depth{};  // without handles
        bool fits(const Made& other) const;
    };
    /// Throws an input Error that names the call and what is wrong with the view.
    void readView(const char* call, const BrumeView& view);
    void build(const char* call, const BrumeView& view);
    void make(const Made& wanted);
    void declareFrames();
    void declareParticles();
    void recordContent(gpu::Commands& commands);
    void recordView(gpu::Commands& commands);
    void recordParticles(gpu::Commands& commands);
    /// False if the host's layers come next.
    bool recordRender(gpu::Commands& commands, const BrumeView& view);
    void finishRender(gpu::Commands& commands);
    bool isMade() const { return mComposer && mMade.structure == mModel.structure(); }

    Context* mContext;
    Model mModel;
    Made mMade;
    render::View mView;
    shader::BackdropPush mPush{};
    // In the order in which they refer to each other.
    gpu::Image mColor, mDepth;
    gpu::UploadRing mRing;
    frame::ResourcePool mParticlePool, mRenderPool;
    std::unique_ptr<render::Composer> mComposer;
    std::unique_ptr<render::Backdrop> mBackdrop;
    std::optional<frame::FrameBuilder> mParticleFrame, mRenderFrame;
    VkImageLayout mColorLayout = VK_IMAGE_LAYOUT_UNDEFINED;  // in which the host's images go back
    VkImageLayout mDepthLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    Box3 mStillBounds;
    std::uint64_t mValues = 0;         // of the model, that are on the device
    std::uint64_t mParticlesOf = 0;    // frame whose particles and shadows are recorded
    std::uint64_t mUploadFrame = 0;    // frame that the ring is open for
    std::uint64_t mRecordedFrame = 0;  // the last that anything was recorded in
    std::uint64_t mFrames = 0;
    bool mHasContent = false;
    bool mIsSimulationDue = true;
};

}  // namespace brume::host
