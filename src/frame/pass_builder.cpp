// SPDX-License-Identifier: Apache-2.0
// Declaring passes, and what they may touch.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <frame/frame_builder.hpp>

#include <algorithm>

namespace brume::frame {

PassBuilder& PassBuilder::use(bool isImage, std::uint32_t index, Access access, bool isRead,
                              bool isWrite) {
    const AccessInfo& info = accessInfo(access);
    if (isWrite && info.write == 0)
        throw AssertionError(fmt::format("pass '{}': '{}' cannot write", mName, info.name));
    if (isRead && !isWrite && info.write != 0)
        throw AssertionError(fmt::format("pass '{}': '{}' does not only read", mName, info.name));
    if (index == ~0u)
        throw AssertionError(
            fmt::format("pass '{}': '{}' of an empty reference", mName, info.name));
    mUses.push_back({isImage, index, access, isRead, isWrite});
    return *this;
}

PassBuilder& PassBuilder::reads(BufferRef ref, Access access) {
    return use(false, ref.index, access, true, false);
}
PassBuilder& PassBuilder::reads(ImageRef ref, Access access) {
    return use(true, ref.index, access, true, false);
}
PassBuilder& PassBuilder::writes(BufferRef ref, Access access) {
    return use(false, ref.index, access, false, true);
}
PassBuilder& PassBuilder::writes(ImageRef ref, Access access) {
    return use(true, ref.index, access, false, true);
}
PassBuilder& PassBuilder::readsWrites(BufferRef ref, Access access) {
    return use(false, ref.index, access, true, true);
}
PassBuilder& PassBuilder::readsWrites(ImageRef ref, Access access) {
    return use(true, ref.index, access, true, true);
}

PassBuilder& PassBuilder::color(ImageRef ref, gpu::LoadOp load, std::array<float, 4> clear) {
    mColors.push_back({ref, {nullptr, load, clear, {}}});
    mIsRaster = true;
    return use(true, ref.index, Access::ColorAttachment, load == gpu::LoadOp::Load, true);
}

PassBuilder& PassBuilder::colorUint(ImageRef ref, gpu::LoadOp load,
                                    std::array<std::uint32_t, 4> clear) {
    color(ref, load);
    mColors.back().attachment.clearUint = clear;
    return *this;
}

PassBuilder& PassBuilder::depth(ImageRef ref, gpu::LoadOp load, float clear) {
    mDepth = ref;
    mDepthAttachment = {nullptr, load, clear, false};
    mIsRaster = true;
    return use(true, ref.index, Access::DepthAttachment, load == gpu::LoadOp::Load, true);
}

PassBuilder& PassBuilder::depthTest(ImageRef ref) {
    mDepth = ref;
    mDepthAttachment = {nullptr, gpu::LoadOp::Load, 0, true};
    mIsRaster = true;
    return use(true, ref.index, Access::DepthTest, true, false);
}

PassBuilder& PassBuilder::renderArea(VkExtent2D extent) {
    mArea = extent;
    mIsRaster = true;
    return *this;
}

PassBuilder& PassBuilder::handOver() {
    mIsHandOver = true;
    return *this;
}

PassBuilder& PassBuilder::insideCallersRendering() {
    mIsInsideCallers = true;
    return *this;
}

PassBuilder& PassBuilder::record(RecordFunction function) {
    mRecord = std::move(function);
    return *this;
}

const gpu::Buffer& PassResources::buffer(BufferRef ref) const {
    mFrame->requireDeclared(mPass, false, ref.index);
    return *mFrame->mResources[ref.index].buffer;
}

const gpu::Image& PassResources::image(ImageRef ref) const {
    mFrame->requireDeclared(mPass, true, ref.index);
    return *mFrame->mResources[ref.index].image;
}

void FrameBuilder::requireDeclared(std::size_t pass, bool isImage, std::uint32_t index) const {
    const PassBuilder& builder = mPasses[pass];
    for (const PassBuilder::Use& use : builder.mUses)
        if (use.isImage == isImage && use.index == index) return;
    const bool isKnown = index < mResources.size();
    throw AssertionError(fmt::format("pass '{}' uses {} '{}' without having declared it",
                                     builder.mName, isImage ? "image" : "buffer",
                                     isKnown ? mResources[index].name() : "none"));
}

}  // namespace brume::frame
