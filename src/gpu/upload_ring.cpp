// SPDX-License-Identifier: Apache-2.0
#include <gpu/upload_ring.hpp>

#include <core/assert.hpp>

#include <algorithm>
#include <cstring>

namespace brume::gpu {

UploadRing::UploadRing(Device& device, const std::string& name, std::uint32_t slots)
    : mDevice(&device), mName(name), mSlots(slots) {}

void UploadRing::beginFrame(std::uint32_t slot) {
    BRUME_ASSERT_LT(slot, mSlots.size());
    mSlot = slot;
    mUsed = 0;
}

void UploadRing::writeBytes(Commands& commands, const Buffer& target,
                            std::span<const std::byte> bytes, std::uint64_t offset) {
    if (bytes.empty()) return;
    BRUME_ASSERT_LE(offset + bytes.size(), target.bytes());
    Buffer& slot = mSlots[mSlot];
    if (mUsed + bytes.size() > slot.bytes()) {
        // Copies recorded from the old buffer keep it alive until the frame is retired.
        constexpr std::uint64_t kLeast = 1 << 16;
        slot =
            Buffer(*mDevice,
                   {.name = mName,
                    .bytes = std::max({kLeast, 2 * slot.bytes(), 2 * std::uint64_t{bytes.size()}}),
                    .memory = MemoryKind::Upload});
        mUsed = 0;
    }
    std::memcpy(static_cast<std::byte*>(slot.mapped()) + mUsed, bytes.data(), bytes.size());
    commands.copyBuffer(slot, target, bytes.size(), mUsed, offset);
    mUsed = (mUsed + bytes.size() + 15) / 16 * 16;
}

std::uint64_t UploadRing::bytes() const {
    std::uint64_t sum = 0;
    for (const Buffer& slot : mSlots) sum += slot.bytes();
    return sum;
}

}  // namespace brume::gpu
