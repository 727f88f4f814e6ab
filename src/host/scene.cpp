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
    auto composer = std::make_unique<render::Composer>(device, mModel.prepared(), mModel.options(),
                                                       mView,
                                                       previous ? &previous->effects : nullptr);
    mStillBounds = mModel.stillBounds();
    if (composer->hasShadows()) {
        Box3 bounds = mStillBounds;
        bounds.extend(mModel.effectBounds());
        composer->addShadows(bounds);
        composer->shadows->reserve(mContext->shadowPairs());
        composer->scene.setShadows(composer->shadows->addresses());
        composer->areShadowsReady = true;
    }
    composer->addMethod();
    composer->method->prepare([](const oit::OitMethod::DeclareFunction&) {
        throw AssertionError("a method within a host's frame wants to measure");
    });
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
    mComposer->declareResult(frame, inputs);
    mComposer->method->declare(frame, inputs);
    mBackdrop->declareComposite(frame, inputs, color);
}

void Scene::prepare(const BrumeView& view) { build("brumePrepare", view); }

void Scene::simulate(VkCommandBuffer commandBuffer, const BrumeStep& step) {
    mContext->requireFrame("brumeCmdSimulate");
    mModel.step(step.seconds);
    mIsSimulationDue = true;
    if (!isMade()) return;  // with the first view
    gpu::Commands commands(mContext->device(), commandBuffer);
    mComposer->effects.recordSimulate(commands, mContext->maxTicksPerFrame());
    mIsSimulationDue = false;
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
    if (mIsSimulationDue)
        mComposer->effects.recordSimulate(commands, mContext->maxTicksPerFrame());
    mIsSimulationDue = false;
    mParticleFrame->execute(commands);
    mParticlesOf = mContext->frame();
}

void Scene::shadow(VkCommandBuffer commandBuffer, const BrumeView& view) {
    mContext->requireFrame("brumeCmdShadow");
    build("brumeCmdShadow", view);
    gpu::Commands commands(mContext->device(), commandBuffer);
    recordParticles(commands);
}

void Scene::render(VkCommandBuffer commandBuffer, const BrumeView& view) {
    constexpr const char* kCall = "brumeCmdRender";
    mContext->requireFrame(kCall);
    checkHandles(kCall, "color", view.color);
    checkHandles(kCall, "depth", view.depth);
    build(kCall, view);
    gpu::Commands commands(mContext->device(), commandBuffer);
    if (mParticlesOf != mContext->frame()) recordParticles(commands);
    mColor.rebind({view.color.image, view.color.view, view.color.layout});
    mDepth.rebind({view.depth.image, view.depth.view, view.depth.layout});
    mBackdrop->setPush(mPush);
    mRenderFrame->execute(commands);
    restoreLayout(commands, mColor, view.color.layout);
    restoreLayout(commands, mDepth, view.depth.layout);
    ++mFrames;
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
    if (mComposer->shadows) counters.shadowPairsDropped = mComposer->shadows->droppedPairs();
    counters.sceneBytes = mRing.bytes() + mParticlePool.bytes() + mRenderPool.bytes();
    for (const auto& [kind, bytes] : mComposer->bytes()) counters.sceneBytes += bytes;
    return counters;
}

}  // namespace brume::host
