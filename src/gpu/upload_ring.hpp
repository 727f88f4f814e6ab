// SPDX-License-Identifier: Apache-2.0
// Host memory that frames in flight take turns to upload from, so that a steady frame allocates
// nothing.
#pragma once

#include <gpu/commands.hpp>

#include <span>
#include <string>
#include <vector>

namespace brume::gpu {

class UploadRing {
  public:
    /// `slots`: frames in flight. Allocates nothing before the first write().
    UploadRing(Device& device, const std::string& name, std::uint32_t slots);

    /// What was recorded with this slot before is done on the device.
    void beginFrame(std::uint32_t slot);

    /// Records a copy of `bytes` to `target`. Barriers around a group of copies are the caller's.
    void writeBytes(Commands& commands, const Buffer& target, std::span<const std::byte> bytes,
                    std::uint64_t offset = 0);
    template <typename Range>
    void write(Commands& commands, const Buffer& target, const Range& values,
               std::uint64_t offset = 0) {
        writeBytes(commands, target, std::as_bytes(std::span(values)), offset);
    }

    std::uint64_t bytes() const;

  private:
    Device* mDevice;
    std::string mName;
    std::vector<Buffer> mSlots;
    std::uint32_t mSlot = 0;
    std::uint64_t mUsed = 0;
};

}  // namespace brume::gpu
