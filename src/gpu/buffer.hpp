// SPDX-License-Identifier: Apache-2.0
// A named buffer with its own memory.
#pragma once

#include <gpu/object_registry.hpp>

#include <cstddef>
#include <span>
#include <string>

namespace brume::gpu {

struct BufferDesc {
    std::string name;  ///< e.g. "oit.linked_list.nodes"; required
    std::uint64_t bytes = 0;
    MemoryKind memory = MemoryKind::Device;
};

/// A buffer usable as anything: storage, uniform, index, indirect, transfer, device address. It may
/// be larger than Limits::maxStorageBufferRange; it is then used by its device address only (or by
/// BufferRange bindings). Its content is undefined at first. Move-only; empty by default.
class Buffer {
  public:
    Buffer() = default;
    /// Throws a failure Error naming the buffer, its MiB and the limit that it breaks.
    Buffer(Device& device, const BufferDesc& desc);

    const std::string& name() const { return mName; }
    std::uint64_t bytes() const { return mBytes; }
    VkBuffer handle() const { return mHandle; }
    VkDeviceAddress deviceAddress() const { return mAddress; }
    explicit operator bool() const { return static_cast<bool>(mOwner); }

    /// The mapped bytes; null for MemoryKind::Device.
    void* mapped() const { return mMapped; }
    /// The mapped bytes as elements. Throws an AssertionError for MemoryKind::Device.
    template <typename T>
    std::span<T> mappedAs() const {
        return {static_cast<T*>(requireMapped()), static_cast<std::size_t>(mBytes / sizeof(T))};
    }

  private:
    void* requireMapped() const;

    std::string mName;
    std::uint64_t mBytes = 0;
    VkBuffer mHandle = VK_NULL_HANDLE;
    VkDeviceAddress mAddress = 0;
    void* mMapped = nullptr;
    ObjectOwner mOwner;
};

/// Part of a buffer for a binding; `bytes` 0: up to its end. The offset must be a multiple of 256.
struct BufferRange {
    const Buffer* buffer = nullptr;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
};

}  // namespace brume::gpu
