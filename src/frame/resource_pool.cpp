// SPDX-License-Identifier: Apache-2.0
#include <frame/resource_pool.hpp>

namespace brume::frame {
namespace {

constexpr int kIdleFramesKept = 3;

bool fits(const gpu::Buffer& buffer, const gpu::BufferDesc& desc) {
    return buffer.bytes() == desc.bytes;
}

bool fits(const gpu::Image& image, const gpu::ImageDesc& desc) {
    const gpu::ImageDesc& own = image.desc();
    return own.format == desc.format && own.width == desc.width && own.height == desc.height &&
           own.depth == desc.depth && own.layers == desc.layers && own.usage == desc.usage;
}

// Free slots of the same name go first, so that debuggers show the name that is meant.
template <typename Slot, typename Desc>
Slot* findFree(std::list<Slot>& slots, const Desc& desc) {
    Slot* found = nullptr;
    for (Slot& slot : slots) {
        if (slot.isTaken || !fits(slot.object, desc)) continue;
        if (slot.object.name() == desc.name) return &slot;
        if (!found) found = &slot;
    }
    return found;
}

template <typename Slot>
Slot& take(Slot& slot) {
    slot.isTaken = true;
    slot.idleFrames = 0;
    return slot;
}

template <typename Slot>
void age(std::list<Slot>& slots) {
    for (Slot& slot : slots) {
        slot.isTaken = false;
        ++slot.idleFrames;
    }
}

template <typename Slot>
void freeIdle(std::list<Slot>& slots) {
    std::erase_if(slots, [](const Slot& slot) { return slot.idleFrames >= kIdleFramesKept; });
}

}  // namespace

std::uint64_t ResourcePool::bytes() const {
    std::uint64_t sum = 0;
    for (const BufferSlot& slot : mBuffers) sum += slot.object.bytes();
    for (const ImageSlot& slot : mImages) sum += slot.object.bytes();
    return sum;
}

void ResourcePool::beginFrame() {
    age(mBuffers);
    age(mImages);
}

ResourcePool::BufferSlot& ResourcePool::takeBuffer(const gpu::BufferDesc& desc) {
    if (BufferSlot* free = findFree(mBuffers, desc)) return take(*free);
    mBuffers.push_back({gpu::Buffer(*mDevice, desc)});
    ++mAllocations;
    return take(mBuffers.back());
}

ResourcePool::ImageSlot& ResourcePool::takeImage(const gpu::ImageDesc& desc) {
    if (ImageSlot* free = findFree(mImages, desc)) return take(*free);
    mImages.push_back({gpu::Image(*mDevice, desc)});
    ++mAllocations;
    return take(mImages.back());
}

void ResourcePool::endFrame() {
    freeIdle(mBuffers);
    freeIdle(mImages);
}

}  // namespace brume::frame
