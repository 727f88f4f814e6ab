// SPDX-License-Identifier: Apache-2.0
// Submitting and waiting for programs that have no host: the command line, the benchmark, tests.
#pragma once

#include <gpu/commands.hpp>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace brume::gpu {

/// A command pool, one command buffer and a fence over one queue. Techniques never see it.
class Submitter {
  public:
    /// `queue`: of family Device::queueFamily(); null: the device's own. Throws an AssertionError
    /// if there is none.
    explicit Submitter(Device& device, VkQueue queue = VK_NULL_HANDLE);
    ~Submitter();
    Submitter(const Submitter&) = delete;
    Submitter& operator=(const Submitter&) = delete;

    Device& device() const { return *mDevice; }

    /// Begins a frame, records, submits, waits until the device is done, retires the frame.
    /// An exception from `record` discards the commands and passes through.
    void submitAndWait(const std::string& name, const std::function<void(Commands&)>& record);

    /// Copies `bytes` of a buffer to the host.
    void read(const Buffer& source, void* target, std::uint64_t bytes, std::uint64_t offset = 0);
    /// All texels of an image, rows tightly packed; keeps its layout (must not be UNDEFINED).
    std::vector<std::byte> read(const Image& source);

    template <typename T>
    std::vector<T> readBuffer(const Buffer& source, std::size_t count, std::uint64_t offset = 0) {
        std::vector<T> values(count);
        read(source, values.data(), count * sizeof(T), offset);
        return values;
    }
    template <typename T>
    std::vector<T> readImage(const Image& source) {
        const std::vector<std::byte> bytes = read(source);
        std::vector<T> values(bytes.size() / sizeof(T));
        std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
        return values;
    }

  private:
    Device* mDevice;
    VkQueue mQueue = VK_NULL_HANDLE;
    VkCommandPool mPool = VK_NULL_HANDLE;
    VkCommandBuffer mCommands = VK_NULL_HANDLE;
    VkFence mFence = VK_NULL_HANDLE;
    ObjectOwner mOwner;
};

}  // namespace brume::gpu
