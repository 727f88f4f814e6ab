// SPDX-License-Identifier: Apache-2.0
// The memory behind transient resources, kept from frame to frame.
#pragma once

#include <gpu/buffer.hpp>
#include <gpu/image.hpp>

#include <list>

namespace brume::frame {

/// Buffers and images that frames borrow. A steady sequence of frames allocates nothing after its
/// first frame; what three frames in a row did not use is freed. One pool serves one queue.
class ResourcePool {
  public:
    explicit ResourcePool(gpu::Device& device) : mDevice(&device) {}

    gpu::Device& device() const { return *mDevice; }
    std::uint64_t allocations() const { return mAllocations; }  ///< objects created so far
    std::uint64_t bytes() const;                                ///< held now

    // For FrameBuilder ---------------------------------------------------------------------------
    template <typename Object>
    struct Slot {
        Object object;
        bool isTaken = false;
        int idleFrames = 0;
    };
    using BufferSlot = Slot<gpu::Buffer>;
    using ImageSlot = Slot<gpu::Image>;

    void beginFrame();
    /// A free slot of just this size or description (its name aside), else a new one.
    BufferSlot& takeBuffer(const gpu::BufferDesc& desc);
    ImageSlot& takeImage(const gpu::ImageDesc& desc);
    void endFrame();

  private:
    gpu::Device* mDevice;
    std::list<BufferSlot> mBuffers;
    std::list<ImageSlot> mImages;
    std::uint64_t mAllocations = 0;
};

}  // namespace brume::frame
