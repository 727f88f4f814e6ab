// SPDX-License-Identifier: Apache-2.0
// Filling device buffers and images from host memory.
#pragma once

#include <gpu/commands.hpp>

#include <span>

namespace brume::gpu {

/// Records a copy of `bytes` to `target` through a staging buffer that lives until the frame is
/// retired (so a frame must be open: AssertionError). Ordered after everything recorded before it;
/// visible to everything recorded after it.
void uploadBytes(Commands& commands, const Buffer& target, std::span<const std::byte> bytes,
                 std::uint64_t offset = 0);

/// The same for all texels of an image, rows tightly packed; leaves it in SHADER_READ_ONLY_OPTIMAL.
void uploadBytes(Commands& commands, const Image& target, std::span<const std::byte> bytes);

/// `values` is any contiguous range of trivially copyable elements.
template <typename Range>
void upload(Commands& commands, const Buffer& target, const Range& values,
            std::uint64_t offset = 0) {
    uploadBytes(commands, target, std::as_bytes(std::span(values)), offset);
}
template <typename Range>
void upload(Commands& commands, const Image& target, const Range& values) {
    uploadBytes(commands, target, std::as_bytes(std::span(values)));
}

/// A device buffer of exactly these values.
template <typename Range>
Buffer makeBuffer(Commands& commands, const std::string& name, const Range& values) {
    const auto bytes = std::as_bytes(std::span(values));
    Buffer buffer(commands.device(), {.name = name, .bytes = bytes.size()});
    uploadBytes(commands, buffer, bytes);
    return buffer;
}

}  // namespace brume::gpu
