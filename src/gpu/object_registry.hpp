// SPDX-License-Identifier: Apache-2.0
// Who owns which Vulkan handles: destruction is deferred until the frames that may use them are
// retired, and whatever is left at the end is freed and named.
#pragma once

#include <gpu/device.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace brume::gpu {

/// One handle and how to destroy it.
struct OwnedHandle {
    VkObjectType type = VK_OBJECT_TYPE_UNKNOWN;
    std::uint64_t handle = 0;
};

/// Casts any Vulkan handle (a pointer or, on 32-bit targets, an integer).
template <typename Handle>
OwnedHandle owned(VkObjectType type, Handle handle) {
    return {type, (std::uint64_t)handle};
}

/// The living and the dying objects of one device.
class ObjectRegistry {
  public:
    explicit ObjectRegistry(const Device& device) : mDevice(&device) {}

    std::uint64_t add(const std::string& kind, const std::string& name);
    /// Adds a handle to an object; they are destroyed in reverse order, memory last.
    void addHandle(std::uint64_t id, OwnedHandle handle);
    void addMemory(std::uint64_t id, const Allocation& allocation, MemoryKind kind);
    /// One owner more: the object goes when all of them have released it.
    void retain(std::uint64_t id);
    void release(std::uint64_t id);
    std::uint64_t beginFrame() { return ++mBegun; }
    void retireFrame(std::uint64_t serial);
    bool isFrameOpen() const { return mBegun > mRetired; }
    std::vector<ObjectInfo> objects() const;
    std::uint64_t allocatedBytes() const;
    std::uint64_t allocatedBytes(std::uint32_t heap) const { return mHeapBytes[heap]; }
    std::uint32_t allocations() const { return mAllocations; }
    /// Frees everything; later calls do nothing. Returns the names of those that still lived.
    std::vector<std::string> close();

  private:
    struct Entry {
        ObjectInfo info;
        std::vector<OwnedHandle> handles;
        std::uint32_t ownerCount = 1;
        std::uint64_t serial = 0;  // frame after which it may go
    };
    void destroy(const Entry& entry);

    const Device* mDevice;  // alive until close()
    std::map<std::uint64_t, Entry> mLiving;
    std::vector<Entry> mDying;
    std::uint64_t mNextId = 1;
    std::uint64_t mBegun = 0;
    std::uint64_t mRetired = 0;
    std::array<std::uint64_t, VK_MAX_MEMORY_HEAPS> mHeapBytes{};
    std::uint32_t mAllocations = 0;
    bool mIsClosed = false;
};

/// Owns one entry of a registry, as a rule alone; empty by default and after a move.
class ObjectOwner {
  public:
    ObjectOwner() = default;
    ObjectOwner(Device& device, const std::string& kind, const std::string& name);
    ~ObjectOwner() { reset(); }
    ObjectOwner(ObjectOwner&& other) noexcept;
    ObjectOwner& operator=(ObjectOwner&& other) noexcept;
    explicit operator bool() const { return mRegistry != nullptr; }
    void add(OwnedHandle handle) { mRegistry->addHandle(mId, handle); }
    void add(const Allocation& allocation, MemoryKind kind) {
        mRegistry->addMemory(mId, allocation, kind);
    }
    /// Another owner of the same object.
    ObjectOwner share() const;
    void reset();

  private:
    std::shared_ptr<ObjectRegistry> mRegistry;
    std::uint64_t mId = 0;
};

}  // namespace brume::gpu
