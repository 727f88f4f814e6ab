// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <core/image.hpp>

#include <cmath>

#include <cstring>

namespace brume {

std::uint64_t computeHash(const Image& image) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto mix = [&hash](std::uint32_t word) {
        for (int i = 0; i < 4; ++i) hash = (hash ^ ((word >> (8 * i)) & 0xff)) * 0x100000001b3u;
    };
    mix(static_cast<std::uint32_t>(image.width));
    mix(static_cast<std::uint32_t>(image.height));
    for (const vec3& pixel : image.pixels) {
        std::uint32_t words[3];
        std::memcpy(words, &pixel, sizeof words);
        for (std::uint32_t word : words) mix(word);
    }
    return hash;
}

Image downsample(const Image& image, int n) {
    BRUME_ASSERT_EQ(image.width % n, 0);
    BRUME_ASSERT_EQ(image.height % n, 0);
    Image result(image.width / n, image.height / n);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            dvec3 sum(0);
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) sum += dvec3(image.at(x * n + i, y * n + j));
            result.at(x, y) = vec3(sum / static_cast<double>(n * n));
        }
    return result;
}

double linearFromSrgb(double x) {
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

}  // namespace brume
