// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <host/errors.hpp>
#include <host/scene.hpp>

#include <glm/gtc/type_ptr.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::host {
namespace {

BrumeImage withoutHandles(BrumeImage image) {
    image.image = VK_NULL_HANDLE;
    image.view = VK_NULL_HANDLE;
    image.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    return image;
}

bool isAlike(const BrumeImage& a, const BrumeImage& b) {
    return a.format == b.format && a.width == b.width && a.height == b.height;
}

void checkImage(const char* call, const char* name, const BrumeImage& image) {
    if (image.format == VK_FORMAT_UNDEFINED || image.width == 0 || image.height == 0)
        throw refuse(call, name, "it has no format or no size");
}

void checkHandles(const char* call, const char* name, const BrumeImage& image) {
    if (!image.image || !image.view) throw refuse(call, name, "its image or its view is null");
    if (image.layout == VK_IMAGE_LAYOUT_UNDEFINED)
        throw refuse(call, name, "its layout is UNDEFINED, so that its content is lost");
}

/// Records the way back to the layout in which the host gave an image.
void restoreLayout(gpu::Commands& commands, const gpu::Image& image, VkImageLayout layout) {
    if (image.layout() != layout) commands.transition(image, layout);
}

}  // namespace

bool Scene::Made::fits(const Made& other) const {
    return structure == other.structure && viewport.width == other.viewport.width &&
           viewport.height == other.viewport.height && camera == other.camera &&
           isAlike(color, other.color) && isAlike(depth, other.depth);
}

Scene::Scene(Context& context, const BrumeSceneCreateInfo& info)
    : mContext(&context),
      mModel(context, info),
      mRing(context.device(), "host.upload", context.framesInFlight()),
      mParticlePool(context.device()),
      mRenderPool(context.device()) {}

void Scene::readView(const char* call, const BrumeView& view) {
    checkImage(call, "color", view.color);
    checkImage(call, "depth", view.depth);
    render::HostView host;
    host.viewFromWorld = glm::make_mat4(view.viewFromWorld);
    host.clipFromView = glm::make_mat4(view.clipFromView);
    host.x = view.x;
    host.y = view.y;
    host.width = view.width;
    host.height = view.height;
    host.isLeftHanded = view.leftHanded != 0;
    if (view.minDepth != 0 || view.maxDepth != 0) {
        host.minDepth = view.minDepth;
        host.maxDepth = view.maxDepth;
    }
    mView = render::makeView(host, mPush);
    for (const BrumeImage* image : {&view.color, &view.depth})
        if (mPush.offsetX + static_cast<std::uint32_t>(mView.camera.width) > image->width ||
            mPush.offsetY + static_cast<std::uint32_t>(mView.camera.height) > image->height)
            throw refuse(call, "viewport",
                         fmt::format("{}x{} at {}, {} reaches beyond the image of {}x{}",
                                     mView.camera.width, mView.camera.height, mPush.offsetX,
                                     mPush.offsetY, image->width, image->height));
}

void Scene::build(const char* call, const BrumeView& view) {
    readView(call, view);
    const Made wanted{mModel.structure(),
                      {static_cast<std::uint32_t>(mView.camera.width),
                       static_cast<std::uint32_t>(mView.camera.height)},
                      mView.camera.type,
                      withoutHandles(view.color),
                      withoutHandles(view.depth)};
    if (!mComposer || !mMade.fits(wanted)) make(wanted);
}

void Scene::make(const Made& wanted) {
    gpu::Device& device = mContext->device();
    mParticleFrame.reset();
    mRenderFrame.reset();
    // Simulations go over to the new one; should it fail, they begin anew with the next.
    const std::unique_ptr<render::Composer> previous = std::move(mComposer);
    auto composer =
        std::make_unique<render::Composer>(device, mModel.prepared(), mModel.options(), mView,
                                           previous ? &previous->effects : nullptr);
    mStillBounds = mModel.stillBounds();
    if (composer->hasShadows()) {
        Box3 bounds = mStillBounds;
        bounds.extend(mModel.effectBounds());
        composer->addShadows(bounds);
        composer->shadows->reserve(mContext->shadowPairs());
        composer->scene.setShadows(composer->shadows->addresses(),
                                     composer->shadows->sharesAddress());
        composer->areShadowsReady = true;
    }
    const BrumeInside inside = mModel.inside();
    if (inside != BRUME_INSIDE_NOTHING) composer->callers.color = wanted.color.format;
    if (inside == BRUME_INSIDE_COLOR_DEPTH) composer->callers.depth = wanted.depth.format;
    composer->isHosted = true;
    composer->addMethod();
    composer->method->prepare({});
    mBackdrop = std::make_unique<render::Backdrop>(device, wanted.color.format);
    mColor = gpu::Image({.name = "host.color",
                         .format = wanted.color.format,
                         .width = wanted.color.width,
                         .height = wanted.color.height},
                        gpu::HostImage{});
    mDepth = gpu::Image({.name = "host.depth",
                         .format = wanted.depth.format,
                         .width = wanted.depth.width,
                         .height = wanted.depth.height},
                        gpu::HostImage{});
    mComposer = std::move(composer);
    mMade = wanted;
    mHasContent = false;
    mIsSimulationDue = true;
    mParticlesOf = 0;
    declareParticles();
    declareFrames();
}

void Scene::declareParticles() {
    mParticleFrame.emplace(mParticlePool);
    mComposer->declareShadows(*mParticleFrame, mComposer->declareParticles(*mParticleFrame));
}

void Scene::declareFrames() {
    frame::FrameBuilder& frame = mRenderFrame.emplace(mRenderPool);
    oit::Inputs inputs = mComposer->scene.makeInputs();
    inputs.spheres = frame.importBuffer(mComposer->scene.spheres());
    const frame::ImageRef color = frame.importImage(mColor), depth = frame.importImage(mDepth);
    const frame::ImageRef reversed = mBackdrop->declareImport(frame, inputs, color, depth);
    mComposer->opaque.declareMeshes(frame, mComposer->scene, inputs, reversed, gpu::LoadOp::Load);
    inputs.callers = mComposer->callers;
    if (!inputs.callers) mComposer->declareResult(frame, inputs);
    mComposer->method->declare(frame, inputs);
    if (inputs.callers) return;
    mBackdrop->declareComposite(frame, inputs, color);
}

// Runs what records into a command buffer. If that fails halfway, the buffer is discarded, and what
// this and other scenes believe to be on the device is not.
template <typename Work>
void Scene::record(const char* call, const Work& work) {
    mContext->requireFrame(call);
    try {
        mRecordedFrame = mContext->frame();
        work();
    } catch (const Error& error) {
        // Bad arguments are found before anything is recorded.
        if (error.kind() != ErrorKind::Input) mContext->forgetFrame();
        throw;
    } catch (...) {
        mContext->forgetFrame();
        throw;
    }
}

void Scene::forgetFrame() {
    if (mRecordedFrame != mContext->frame()) return;
    mParticleFrame.reset();
    mRenderFrame.reset();
    mComposer.reset();
    // The layouts that their images are believed to have were never reached.
    mParticlePool = frame::ResourcePool(mContext->device());
    mRenderPool = frame::ResourcePool(mContext->device());
    mMade = {};
}

void Scene::prepare(const BrumeView& view) {
    build("brumePrepare", view);
    if (!mComposer->method->lacksMemory()) return;
    mRenderFrame.reset();
    mComposer->method->prepare({});
    declareFrames();
}

void Scene::simulate(VkCommandBuffer commandBuffer, const BrumeStep& step) {
    record("brumeCmdSimulate", [&] {
        mModel.step(step.seconds);
        mIsSimulationDue = true;
        if (!isMade()) return;  // with the first view
        gpu::Commands commands(mContext->device(), commandBuffer);
        mComposer->effects.recordSimulate(commands, mContext->maxTicksPerFrame());
        mIsSimulationDue = false;
    });
}

void Scene::recordContent(gpu::Commands& commands) {
    if (mHasContent) return;
    mComposer->recordContent(commands);
    mHasContent = true;
    mValues = mModel.values();
}

// Where everything is, as seen from the view.
void Scene::recordView(gpu::Commands& commands) {
    render::Composer& composer = *mComposer;
    if (mUploadFrame != mContext->frame()) mRing.beginFrame(mContext->slot());
    mUploadFrame = mContext->frame();
    if (mValues != mModel.values()) {
        composer.scene.invalidate();
        mStillBounds = mModel.stillBounds();
        if (composer.shadows) composer.shadows->invalidate();
        mValues = mModel.values();
    }
    composer.scene.setView(mView);
    composer.scene.recordView(commands, mRing);
    if (!composer.shadows) return;
    Box3 bounds = mStillBounds;
    bounds.extend(mModel.effectBounds());
    composer.casters->recordOrigin(commands, mRing, mView.camera.position);
    composer.shadows->fit(composer.scene.lights(), mView.camera.position, bounds);
    composer.shadows->recordMaps(commands, mRing);
    commands.fullBarrier();
}

void Scene::recordParticles(gpu::Commands& commands) {
    recordContent(commands);
    recordView(commands);
    if (mIsSimulationDue) mComposer->effects.recordSimulate(commands, mContext->maxTicksPerFrame());
    mIsSimulationDue = false;
    mParticleFrame->execute(commands);
    mParticlesOf = mContext->frame();
}

void Scene::shadow(VkCommandBuffer commandBuffer, const BrumeView& view) {
    constexpr const char* kCall = "brumeCmdShadow";
    record(kCall, [&] {
        build(kCall, view);
        gpu::Commands commands(mContext->device(), commandBuffer);
        recordParticles(commands);
    });
}

void Scene::prepareDraw(VkCommandBuffer commandBuffer, const BrumeView& view) {
    constexpr const char* kCall = "brumeCmdPrepareDraw";
    if (mModel.inside() == BRUME_INSIDE_NOTHING)
        throw refuse(kCall, "scene", "it was not created with inside");
    checkHandles(kCall, "color", view.color);
    checkHandles(kCall, "depth", view.depth);
    record(kCall, [&] {
        build(kCall, view);
        if (mPush.offsetX != 0 || mPush.offsetY != 0)
            throw refuse(kCall, "viewport", "it does not begin at 0, 0");
        gpu::Commands commands(mContext->device(), commandBuffer);
        recordRender(commands, view);
        finishRender(commands);
    });
}

void Scene::draw(VkCommandBuffer commandBuffer) {
    constexpr const char* kCall = "brumeCmdDraw";
    if (!mRenderFrame || !mRenderFrame->isPaused() || mModel.inside() == BRUME_INSIDE_NOTHING)
        throw refuse(kCall, "scene", "brumeCmdPrepareDraw() was not called before");
    record(kCall, [&] {
        gpu::Commands commands(mContext->device(), commandBuffer);
        mRenderFrame->resume(commands);
    });
}

void Scene::render(VkCommandBuffer commandBuffer, const BrumeView& view) {
    constexpr const char* kCall = "brumeCmdRender";
    if (mModel.inside() != BRUME_INSIDE_NOTHING)
        throw refuse(kCall, "scene", "it was created with inside, for brumeCmdDraw()");
    checkHandles(kCall, "color", view.color);
    checkHandles(kCall, "depth", view.depth);
    record(kCall, [&] {
        build(kCall, view);
        gpu::Commands commands(mContext->device(), commandBuffer);
        if (!recordRender(commands, view)) mRenderFrame->resume(commands);
        finishRender(commands);
    });
}

void Scene::beginLayers(VkCommandBuffer commandBuffer, const BrumeView& view) {
    constexpr const char* kCall = "brumeCmdBeginLayers";
    if (!mModel.options().hostLayers)
        throw refuse(kCall, "scene", "it was not created with hostLayers");
    checkHandles(kCall, "color", view.color);
    checkHandles(kCall, "depth", view.depth);
    record(kCall, [&] {
        build(kCall, view);
        gpu::Commands commands(mContext->device(), commandBuffer);
        recordRender(commands, view);
    });
}

void Scene::endLayers(VkCommandBuffer commandBuffer) {
    constexpr const char* kCall = "brumeCmdEndLayers";
    if (!mRenderFrame || !mRenderFrame->isPaused())
        throw refuse(kCall, "scene", "brumeCmdBeginLayers() was not called before");
    record(kCall, [&] {
        gpu::Commands commands(mContext->device(), commandBuffer);
        mRenderFrame->resume(commands);
        finishRender(commands);
    });
}

bool Scene::recordRender(gpu::Commands& commands, const BrumeView& view) {
    if (mParticlesOf != mContext->frame()) recordParticles(commands);
    mColorLayout = view.color.layout;
    mDepthLayout = view.depth.layout;
    mColor.rebind({view.color.image, view.color.view, mColorLayout});
    mDepth.rebind({view.depth.image, view.depth.view, mDepthLayout});
    mBackdrop->setPush(mPush);
    return mRenderFrame->execute(commands);
}

void Scene::finishRender(gpu::Commands& commands) {
    restoreLayout(commands, mColor, mColorLayout);
    restoreLayout(commands, mDepth, mDepthLayout);
    ++mFrames;
}

void Scene::rebase(const double* newOrigin) {
    mModel.rebase(newOrigin);
    if (!mComposer) return;
    const dvec3 origin(newOrigin[0], newOrigin[1], newOrigin[2]);
    mComposer->effects.rebase(origin);
    mComposer->scene.rebase(origin);
    if (mComposer->casters) mComposer->casters->rebase(origin);
}

VkDeviceAddress Scene::shadowOf(BrumeId light) const {
    const std::optional<std::size_t> index = mModel.shaderLight(light);
    if (!isMade())
        throw refuse("brumeGetShadow", "scene",
                     "it has no memory yet, call brumeCmdShadow() first");
    return index && mComposer->shadows ? mComposer->shadows->addresses()[*index] : 0;
}

BrumeCounters Scene::counters() const {
    BrumeCounters counters{};
    counters.structSize = sizeof(counters);
    const gpu::Device& device = mContext->device();
    counters.contextBytes = device.allocatedBytes();
    counters.deviceAllocations = device.objects().size();
    counters.frames = mFrames;
    for (const scene::EffectInstance& effect : mModel.prepared().scene.effects)
        counters.effects += effect.isSubEmitter ? 0 : 1;
    if (!isMade()) return counters;
    const oit::Inputs inputs = mComposer->scene.makeInputs();
    counters.sphereSlots = inputs.sphereCount;
    counters.boxes = inputs.boxCount;
    counters.ticksBehind = mComposer->effects.ticksBehind();
    const auto ofMethod = mComposer->method->counters();
    const auto countOf = [&](const char* name) {
        const auto found = ofMethod.find(name);
        return found == ofMethod.end() ? 0 : found->second;
    };
    counters.methodDropped = countOf("dropped") + countOf("exhausted");
    counters.methodBytesWanted = countOf("listBytesWanted") + 4 * countOf("pairs");
    if (mComposer->shadows) counters.shadowPairsDropped = mComposer->shadows->droppedPairs();
    counters.sceneBytes = mRing.bytes() + mParticlePool.bytes() + mRenderPool.bytes();
    for (const auto& [kind, bytes] : mComposer->bytes()) counters.sceneBytes += bytes;
    return counters;
}

}  // namespace brume::host
