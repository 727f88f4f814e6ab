// SPDX-License-Identifier: Apache-2.0
// Recording a frame: transient memory, barriers, labels and timers.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <frame/frame_builder.hpp>

#include <algorithm>
#include <utility>

namespace brume::frame {
namespace {

// The layout in which one pass can use an image in two ways.
VkImageLayout combineLayouts(VkImageLayout a, VkImageLayout b, const std::string& pass,
                             const std::string& image) {
    constexpr VkImageLayout kSampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    constexpr VkImageLayout kTested = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    if (a == b || a == VK_IMAGE_LAYOUT_UNDEFINED) return b;
    const auto isEither = [&](VkImageLayout layout) { return a == layout || b == layout; };
    if (isEither(kSampled) && isEither(kTested)) return kTested;
    if (isEither(kSampled) && isEither(VK_IMAGE_LAYOUT_GENERAL)) return VK_IMAGE_LAYOUT_GENERAL;
    throw AssertionError(
        fmt::format("pass '{}' uses image '{}' in two ways that exclude each other", pass, image));
}

}  // namespace

void FrameBuilder::Barriers::addMemory(VkPipelineStageFlags2 sourceStages,
                                       VkAccessFlags2 sourceAccess, const Demand& demand) {
    memory.srcStageMask |= sourceStages;
    memory.srcAccessMask |= sourceAccess;
    memory.dstStageMask |= demand.stages;
    memory.dstAccessMask |= demand.access;
}

// Records what has gathered and begins anew.
void FrameBuilder::Barriers::record(gpu::Commands& commands) {
    if (memory.dstStageMask == 0 && images.empty()) return;
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = memory.dstStageMask ? 1 : 0;
    info.pMemoryBarriers = &memory;
    info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size());
    info.pImageMemoryBarriers = images.data();
    commands.pipelineBarrier(info);
    memory = {};
    images.clear();
}

void FrameBuilder::findLives() {
    for (std::size_t i = 0; i < mPasses.size(); ++i)
        for (const PassBuilder::Use& use : mPasses[i].mUses) {
            Resource& resource = mResources.at(use.index);
            if (resource.isImage != use.isImage)
                throw AssertionError(
                    fmt::format("pass '{}' uses a reference of another frame", mPasses[i].mName));
            resource.firstPass = std::min(resource.firstPass, i);
            resource.lastPass = i;
            if (resource.isImage && resource.isTransient)
                resource.imageDesc.usage |= accessInfo(use.access).usage;
        }
}

void FrameBuilder::materialize(std::size_t pass) {
    for (Resource& resource : mResources) {
        if (!resource.isTransient || resource.firstPass != pass) continue;
        if (resource.isImage) {
            ResourcePool::ImageSlot& slot = mPool->takeImage(resource.imageDesc);
            resource.image = &slot.object;
            resource.isTaken = &slot.isTaken;
        } else {
            ResourcePool::BufferSlot& slot = mPool->takeBuffer(resource.bufferDesc);
            resource.buffer = &slot.object;
            resource.isTaken = &slot.isTaken;
        }
    }
}

void FrameBuilder::giveBack(std::size_t pass) {
    for (Resource& resource : mResources)
        if (resource.isTaken && resource.lastPass == pass) *resource.isTaken = false;
}

void FrameBuilder::checkReads(const PassBuilder& pass) {
    for (const PassBuilder::Use& use : pass.mUses) {
        const Resource& resource = mResources[use.index];
        if (use.isRead && resource.isTransient && !resource.isWritten)
            throw AssertionError(fmt::format("pass '{}' reads '{}', which no pass has written",
                                             pass.mName, resource.name()));
    }
    for (const PassBuilder::Use& use : pass.mUses)
        if (use.isWrite) mResources[use.index].isWritten = true;
}

std::vector<FrameBuilder::Demand> FrameBuilder::demandsOf(const PassBuilder& pass) const {
    std::vector<Demand> demands;
    for (const PassBuilder::Use& use : pass.mUses) {
        auto found = std::find_if(demands.begin(), demands.end(),
                                  [&](const Demand& d) { return d.resource == use.index; });
        if (found == demands.end()) {
            demands.push_back({.resource = use.index});
            found = demands.end() - 1;
        }
        const AccessInfo& info = accessInfo(use.access);
        // Attachments read what they blend with or test against even after a clear.
        const bool isAttachment =
            use.access == Access::ColorAttachment || use.access == Access::DepthAttachment;
        found->stages |= info.stages;
        if (use.isRead || isAttachment) found->access |= info.read;
        if (use.isWrite) found->access |= info.write, found->writeAccess |= info.write;
        found->isRead |= use.isRead;
        if (use.isImage)
            found->layout = combineLayouts(found->layout, info.layout, pass.mName,
                                           mResources[use.index].name());
    }
    return demands;
}

// A layout change is a write by the barrier itself, which the demanding stages see.
void FrameBuilder::changeLayout(const Demand& demand, State& state) {
    Resource& resource = mResources[demand.resource];
    // A transient image that takes over another's memory has no content yet.
    const bool isFirst = resource.isTransient && !demand.isRead && !resource.isStarted;
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = state.writeStages | state.readStages;
    // Nothing to wait for within the frame: chain to the barrier at its start.
    if (barrier.srcStageMask == 0) barrier.srcStageMask = demand.stages;
    barrier.srcAccessMask = state.writeAccess;
    barrier.dstStageMask = demand.stages;
    barrier.dstAccessMask = demand.access;
    barrier.oldLayout = isFirst ? VK_IMAGE_LAYOUT_UNDEFINED : resource.image->layout();
    barrier.newLayout = demand.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = resource.image->handle();
    barrier.subresourceRange = resource.image->range();
    mBarriers.images.push_back(barrier);
    resource.image->setLayout(demand.layout);
    state.clear();
    state.writeStages = demand.stages;
    state.writeAccess = demand.writeAccess;
    if (demand.writeAccess) return;
    state.readStages = demand.stages;
    state.visible.push_back({demand.stages, demand.access});
}

void FrameBuilder::synchronize(const Demand& demand) {
    Resource& resource = mResources[demand.resource];
    State& state = mStates[resource.object()];
    if (resource.isImage && resource.image->layout() != demand.layout)
        changeLayout(demand, state);
    else
        orderMemory(demand, state);
    resource.isStarted = true;
}

void FrameBuilder::orderMemory(const Demand& demand, State& state) {
    if (demand.writeAccess) {
        const VkPipelineStageFlags2 before = state.writeStages | state.readStages;
        if (before) mBarriers.addMemory(before, state.writeAccess, demand);
        state.clear();
        state.writeStages = demand.stages;
        state.writeAccess = demand.writeAccess;
        return;
    }
    const bool isVisible =
        std::any_of(state.visible.begin(), state.visible.end(), [&](const Visible& v) {
            return (v.stages & demand.stages) == demand.stages &&
                   (v.access & demand.access) == demand.access;
        });
    if (state.writeStages && !isVisible) {
        mBarriers.addMemory(state.writeStages, state.writeAccess, demand);
        state.visible.push_back({demand.stages, demand.access});
    }
    state.readStages |= demand.stages;
}

void FrameBuilder::beginRaster(gpu::Commands& commands, const PassBuilder& pass) {
    std::array<gpu::ColorAttachment, gpu::kMaxColors> colors;
    const std::size_t count = std::min(pass.mColors.size(), colors.size());
    for (std::size_t i = 0; i < count; ++i) {
        colors[i] = pass.mColors[i].attachment;
        colors[i].image = mResources[pass.mColors[i].image.index].image;
    }
    std::optional<gpu::DepthAttachment> depth;
    if (pass.mDepth) {
        depth = pass.mDepthAttachment;
        depth->image = mResources[pass.mDepth.index].image;
    }
    commands.beginRendering(std::span(colors.data(), count), depth, pass.mArea);
}

void FrameBuilder::beginPass(gpu::Commands& commands, std::size_t index, gpu::TimerPool* timers) {
    const PassBuilder& pass = mPasses[index];
    checkReads(pass);
    materialize(index);
    if (!pass.mIsInsideCallers) {
        commands.beginLabel(pass.mName);
        mScope = timers ? timers->begin(commands, pass.mName) : 0;
    }
    for (const Demand& demand : mDemands[index]) synchronize(demand);
    mBarriers.record(commands);
}

void FrameBuilder::endPass(gpu::Commands& commands, std::size_t index, gpu::TimerPool* timers) {
    const PassBuilder& pass = mPasses[index];
    if (!pass.mIsInsideCallers) {
        if (pass.mIsRaster) commands.endRendering();
        if (timers) timers->end(commands, mScope);
        commands.endLabel();
    }
    giveBack(index);
}

void FrameBuilder::finish(gpu::Commands& commands) {
    for (const auto& [index, access] : mFinal) {
        const AccessInfo& info = accessInfo(access);
        synchronize({.resource = index,
                     .stages = info.stages,
                     .access = info.read | info.write,
                     .writeAccess = info.write,
                     .layout = mResources[index].isImage ? info.layout : VK_IMAGE_LAYOUT_UNDEFINED,
                     .isRead = true});
    }
    mBarriers.record(commands);
}

// What does not change from one execution to the next.
void FrameBuilder::plan() {
    if (mDemands.size() == mPasses.size()) return;
    findLives();
    mDemands.clear();
    for (const PassBuilder& pass : mPasses) mDemands.push_back(demandsOf(pass));
}

void FrameBuilder::restart(gpu::Commands& commands) {
    plan();
    for (auto& [object, state] : mStates) state.clear();
    for (Resource& resource : mResources) resource.isWritten = resource.isStarted = false;
    mBarriers.memory = {};
    mBarriers.images.clear();
    mPool->beginFrame();
    mNext = 0;
    // One barrier orders the frame after all earlier work on the queue, whatever that was; within
    // the frame every dependency is then exact.
    constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    commands.memoryBarrier(kAll, VK_ACCESS_2_MEMORY_WRITE_BIT, kAll,
                           VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
}

// From mNext on, until the end or a pass where the caller goes on.
bool FrameBuilder::run(gpu::Commands& commands, gpu::TimerPool* timers) {
    for (; mNext < mPasses.size(); ++mNext) {
        const PassBuilder& pass = mPasses[mNext];
        beginPass(commands, mNext, timers);
        mIsPaused = pass.mIsInsideCallers || pass.mIsHandOver;
        if (pass.mIsInsideCallers) return false;
        if (pass.mIsRaster) beginRaster(commands, pass);
        if (pass.mRecord) pass.mRecord(commands, PassResources(*this, mNext));
        if (pass.mIsHandOver) return false;
        endPass(commands, mNext, timers);
    }
    finish(commands);
    mPool->endFrame();
    return true;
}

bool FrameBuilder::execute(gpu::Commands& commands, gpu::TimerPool* timers) {
    mIsPaused = false;
    restart(commands);
    return run(commands, timers);
}

bool FrameBuilder::resume(gpu::Commands& commands, gpu::TimerPool* timers) {
    if (!mIsPaused) throw AssertionError("resuming a frame that is not paused");
    mIsPaused = false;
    const PassBuilder& pass = mPasses[mNext];
    if (pass.mIsInsideCallers) {
        if (pass.mRecord) pass.mRecord(commands, PassResources(*this, mNext));
        if (mNext + 1 < mPasses.size() || !mFinal.empty())
            throw AssertionError("a pass inside the caller's rendering must be the frame's last");
    }
    endPass(commands, mNext, timers);
    ++mNext;
    return run(commands, timers);
}

}  // namespace brume::frame
