// SPDX-License-Identifier: Apache-2.0
// The pass contract: passes declare what they read and write; the frame places the barriers,
// allocates the transient targets, and labels and times each pass by its name.
#pragma once

#include <frame/access.hpp>
#include <frame/resource_pool.hpp>
#include <gpu/commands.hpp>
#include <gpu/timer_pool.hpp>

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace brume::frame {

class FrameBuilder;

/// A buffer or an image of one frame; only valid for the FrameBuilder that gave it.
struct BufferRef {
    std::uint32_t index = ~0u;
    explicit operator bool() const { return index != ~0u; }
};
struct ImageRef {
    std::uint32_t index = ~0u;
    explicit operator bool() const { return index != ~0u; }
};

/// What a pass may touch while it records: just what it has declared (else AssertionError).
class PassResources {
  public:
    const gpu::Buffer& buffer(BufferRef ref) const;
    const gpu::Image& image(ImageRef ref) const;
    VkDeviceAddress address(BufferRef ref) const { return buffer(ref).deviceAddress(); }

  private:
    friend class FrameBuilder;
    PassResources(const FrameBuilder& frame, std::size_t pass) : mFrame(&frame), mPass(pass) {}
    const FrameBuilder* mFrame;
    std::size_t mPass;
};

using RecordFunction = std::function<void(gpu::Commands&, const PassResources&)>;

/// Declares one pass; each call returns the builder, so that declarations chain.
class PassBuilder {
  public:
    /// `access` must be able to read, or to write (AssertionError). Buffers used by device address
    /// are declared just like bound ones.
    PassBuilder& reads(BufferRef ref, Access access);
    PassBuilder& reads(ImageRef ref, Access access);
    PassBuilder& writes(BufferRef ref, Access access);
    PassBuilder& writes(ImageRef ref, Access access);
    /// Reads what is there and changes it (atomics, accumulation): with ComputeWrite,
    /// FragmentWrite or TransferWrite.
    PassBuilder& readsWrites(BufferRef ref, Access access);
    PassBuilder& readsWrites(ImageRef ref, Access access);

    /// Makes it a raster pass: rendering has begun when `record` is called and all of the target is
    /// its viewport. Colours in the order of their locations.
    PassBuilder& color(ImageRef ref, gpu::LoadOp load, std::array<float, 4> clear = {});
    PassBuilder& colorUint(ImageRef ref, gpu::LoadOp load, std::array<std::uint32_t, 4> clear = {});
    /// Depth that is tested and written (cleared to `clear`; reversed z, so 0 is far away).
    PassBuilder& depth(ImageRef ref, gpu::LoadOp load, float clear = 0);
    /// Depth that is only tested; it may be sampled in the same pass.
    PassBuilder& depthTest(ImageRef ref);
    /// For a raster pass without attachments, or one over part of its targets.
    PassBuilder& renderArea(VkExtent2D extent);

    /// A raster pass that others may draw into: execute() returns after record(), inside of its
    /// rendering, and resume() goes on.
    PassBuilder& handOver();
    /// A pass within rendering that the frame's caller begins and ends: execute() returns before
    /// it and resume() records it. Attachments are the caller's.
    PassBuilder& insideCallersRendering();

    /// Called by FrameBuilder::execute(), once each time. Several dispatches within one pass that depend on
    /// each other place Commands::computeBarrier() between them.
    PassBuilder& record(RecordFunction function);

  private:
    friend class FrameBuilder;
    friend class PassResources;
    struct Use {
        bool isImage = false;
        std::uint32_t index = 0;  // of the frame's resources
        Access access = Access::ComputeRead;
        bool isRead = false;
        bool isWrite = false;
    };
    struct ColorUse {
        ImageRef image;
        gpu::ColorAttachment attachment;
    };
    PassBuilder& use(bool isImage, std::uint32_t index, Access access, bool isRead, bool isWrite);

    std::string mName;
    std::vector<Use> mUses;
    std::vector<ColorUse> mColors;
    ImageRef mDepth;
    gpu::DepthAttachment mDepthAttachment;
    VkExtent2D mArea{};
    bool mIsRaster = false;
    bool mIsHandOver = false;
    bool mIsInsideCallers = false;
    RecordFunction mRecord;
};

/// What --explain prints.
struct ResourceUse {
    std::string resource;
    std::string access;  ///< e.g. "compute write"
};
struct PassDescription {
    std::string name;
    std::vector<ResourceUse> reads;
    std::vector<ResourceUse> writes;
};
struct TargetDescription {
    std::string name;
    std::string format;  ///< e.g. "r32g32b32a32_sfloat 960x540" or "buffer"
    std::uint64_t bytes = 0;
    bool isTransient = false;
};
struct FrameDescription {
    std::vector<PassDescription> passes;
    std::vector<TargetDescription> targets;
    std::string text() const;  ///< as lines
};

/// One frame: made, declared, executed, thrown away or executed again. Passes run in the order of
/// their declaration. It records into the commands given to execute() and never submits or waits.
/// Everything imported must live until the frame is retired. From the second time on, executing
/// allocates nothing, on the device or on the heap, unless passes do.
class FrameBuilder {
  public:
    explicit FrameBuilder(ResourcePool& pool) : mPool(&pool) {}
    FrameBuilder(const FrameBuilder&) = delete;
    FrameBuilder& operator=(const FrameBuilder&) = delete;

    /// A resource that outlives the frame. All earlier work on it on the same queue is waited for.
    BufferRef importBuffer(const gpu::Buffer& buffer);
    /// The same; its layout() is taken as it is and kept up to date.
    ImageRef importImage(const gpu::Image& image);
    /// A resource that lives from its first to its last pass; its content is undefined before the
    /// first write. Resources of equal description whose lives do not overlap share memory.
    BufferRef createBuffer(const std::string& name, std::uint64_t bytes);
    /// `desc.usage` may be 0: the passes' declarations add what they need.
    ImageRef createImage(const gpu::ImageDesc& desc);

    /// The name is the debug label, the timer and the row in the benchmark: "oit.tile.resolve".
    /// The reference stays valid until execute().
    PassBuilder& addPass(const std::string& name);

    /// Copies into a readback buffer whose mapped bytes are valid once the frame is retired; images
    /// with tightly packed rows.
    void addReadback(const std::string& name, BufferRef source, const gpu::Buffer& target);
    void addReadback(const std::string& name, ImageRef source, const gpu::Buffer& target);

    /// Leaves an imported image ready for `access` at the end of the frame (for a host).
    void finishAs(ImageRef ref, Access access);

    FrameDescription describe() const;
    /// By pass name: bytes of all that its passes declare to read, and of all that they declare to
    /// write: what memory moves if all of it is touched once each way.
    std::map<std::string, std::uint64_t> passBytes() const;

    /// Records everything. Throws an AssertionError if a pass reads a transient resource that none
    /// has written. `timers` (may be null) is not reset here. After a throw, the frame may be
    /// executed anew. Returns whether everything is recorded: false at a pass that is handed over
    /// or inside the caller's rendering, up to which it is; resume() then goes on.
    bool execute(gpu::Commands& commands, gpu::TimerPool* timers = nullptr);
    bool resume(gpu::Commands& commands, gpu::TimerPool* timers = nullptr);
    bool isPaused() const { return mIsPaused; }

  private:
    friend class PassResources;
    struct Visible {
        VkPipelineStageFlags2 stages = 0;
        VkAccessFlags2 access = 0;
    };
    // What has happened to a physical resource and is not yet synchronised with.
    struct State {
        VkPipelineStageFlags2 writeStages = 0;
        VkAccessFlags2 writeAccess = 0;
        VkPipelineStageFlags2 readStages = 0;
        std::vector<Visible> visible;
        void clear() {  // keeps its memory
            writeStages = readStages = 0;
            writeAccess = 0;
            visible.clear();
        }
    };
    struct Resource {
        bool isImage = false;
        bool isTransient = false;
        gpu::BufferDesc bufferDesc;
        gpu::ImageDesc imageDesc;
        const gpu::Buffer* buffer = nullptr;
        const gpu::Image* image = nullptr;
        bool* isTaken = nullptr;  // of the pool's slot
        std::size_t firstPass = ~std::size_t{0};
        std::size_t lastPass = 0;
        bool isWritten = false;
        bool isStarted = false;  // its first layout change is recorded
        const std::string& name() const { return isImage ? imageDesc.name : bufferDesc.name; }
        const void* object() const {
            return isImage ? static_cast<const void*>(image) : static_cast<const void*>(buffer);
        }
    };
    // All uses of one resource by one pass.
    struct Demand {
        std::uint32_t resource = 0;
        VkPipelineStageFlags2 stages = 0;
        VkAccessFlags2 access = 0;
        VkAccessFlags2 writeAccess = 0;
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
        bool isRead = false;
    };
    // What one pass waits for; buffers share one global barrier.
    struct Barriers {
        VkMemoryBarrier2 memory{};
        std::vector<VkImageMemoryBarrier2> images;
        void addMemory(VkPipelineStageFlags2 sourceStages, VkAccessFlags2 sourceAccess,
                       const Demand& demand);
        void record(gpu::Commands& commands);
    };

    void requireDeclared(std::size_t pass, bool isImage, std::uint32_t index) const;
    void findLives();
    void materialize(std::size_t pass);
    void giveBack(std::size_t pass);
    void checkReads(const PassBuilder& pass);
    std::vector<Demand> demandsOf(const PassBuilder& pass) const;
    void synchronize(const Demand& demand);
    void changeLayout(const Demand& demand, State& state);
    void orderMemory(const Demand& demand, State& state);
    void plan();
    void restart(gpu::Commands& commands);
    bool run(gpu::Commands& commands, gpu::TimerPool* timers);
    void beginPass(gpu::Commands& commands, std::size_t pass, gpu::TimerPool* timers);
    void endPass(gpu::Commands& commands, std::size_t pass, gpu::TimerPool* timers);
    void beginRaster(gpu::Commands& commands, const PassBuilder& pass);
    void finish(gpu::Commands& commands);

    ResourcePool* mPool;
    std::deque<PassBuilder> mPasses;
    std::vector<Resource> mResources;
    std::map<const void*, State> mStates;  // by gpu::Buffer or gpu::Image
    std::vector<std::pair<std::uint32_t, Access>> mFinal;
    std::vector<std::vector<Demand>> mDemands;  // by pass, once planned
    Barriers mBarriers;
    std::size_t mNext = 0;  // pass, while executing
    std::size_t mScope = 0;
    bool mIsPaused = false;
};

}  // namespace brume::frame
