// SPDX-License-Identifier: Apache-2.0
// A picture in memory. Files: image_io.hpp.
#pragma once

#include <core/math.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace brume {

/// Linear radiance, RGB, row-major from the top left, `width * height` pixels of float.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<vec3> pixels;

    Image() = default;
    Image(int w, int h, vec3 fill = vec3(0))
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}

    bool isEmpty() const { return pixels.empty(); }
    vec3& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
    const vec3& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

/// 64-bit FNV-1a hash of the size and of every bit of the pixels: equal images, equal hashes.
std::uint64_t computeHash(const Image& image);

/// The sRGB transfer curve, decoding: [0, 1] to [0, 1] (IEC 61966-2-1).
double linearFromSrgb(double x);

/// Of n x n blocks, counted from the first pixel, the middle pixel: where block i lies along a side
/// of `size` pixels.
inline int pickMiddle(int i, int n, int size) { return std::min(i * n + n / 2, size - 1); }

/// Mean of n x n blocks (box filter in double); the size must be a multiple of n.
Image downsample(const Image& image, int n);

}  // namespace brume
