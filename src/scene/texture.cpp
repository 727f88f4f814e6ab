// SPDX-License-Identifier: Apache-2.0
#include <core/image_io.hpp>
#include <scene/texture.hpp>

#include <algorithm>
#include <cmath>

namespace brume::scene {
namespace {

/// Two neighbouring texels along one axis and the weight of the second.
struct Tap {
    int first = 0;
    int second = 0;
    double weight = 0;
};

Tap tapRepeated(double u, int size) {
    const double x = (u - std::floor(u)) * size - 0.5;
    const double cell = std::floor(x);
    const int first = (static_cast<int>(cell) + size) % size;
    return {first, (first + 1) % size, x - cell};
}

Tap tapClamped(double v, int size) {
    const double y = std::clamp(v * size - 0.5, 0.0, static_cast<double>(size - 1));
    const int first = std::min(static_cast<int>(y), size - 1);
    return {first, std::min(first + 1, size - 1), y - first};
}

dvec4 blend(const Texture& texture, const Tap& x, const Tap& y) {
    const auto texel = [&texture](int i, int j) {
        return dvec4(texture.texels[static_cast<std::size_t>(j) * texture.width + i]);
    };
    const dvec4 top = glm::mix(texel(x.first, y.first), texel(x.second, y.first), x.weight);
    const dvec4 low = glm::mix(texel(x.first, y.second), texel(x.second, y.second), x.weight);
    return glm::mix(top, low, y.weight);
}

void sanitise(std::vector<vec4>& texels) {
    for (vec4& texel : texels)
        for (int channel = 0; channel < 4; ++channel)
            if (!(std::isfinite(texel[channel]) && texel[channel] >= 0)) texel[channel] = 0;
}

void lineariseColor(std::vector<vec4>& texels) {
    for (vec4& texel : texels)
        for (int channel = 0; channel < 3; ++channel)
            texel[channel] = static_cast<float>(linearFromSrgb(texel[channel]));
}

}  // namespace

vec4 sampleBilinear(const Texture& texture, dvec2 uv) {
    return vec4(
        blend(texture, tapRepeated(uv.x, texture.width), tapRepeated(uv.y, texture.height)));
}

dvec2 environmentUv(const dvec3& direction) {
    return {std::atan2(direction.x, -direction.z) / (2 * kPi) + 0.5,
            std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi};
}

dvec3 environmentRadiance(const Background& background, const dvec3& direction) {
    if (!background.environment) return background.radiance;
    const Texture& map = *background.environment;
    const dvec2 uv = environmentUv(direction);
    return background.scale *
           dvec3(blend(map, tapRepeated(uv.x, map.width), tapClamped(uv.y, map.height)));
}

std::shared_ptr<const Texture> loadTexture(const std::filesystem::path& file) {
    auto texture = std::make_shared<Texture>();
    texture->name = file.filename().string();
    texture->texels = readRgba(file, texture->width, texture->height);
    const std::string extension = file.extension().string();
    if (extension != ".exr" && extension != ".hdr") lineariseColor(texture->texels);
    sanitise(texture->texels);
    return texture;
}

std::shared_ptr<const Texture> decodeTexture(const std::vector<unsigned char>& bytes,
                                             const std::string& name, bool keepAlpha) {
    auto texture = std::make_shared<Texture>();
    texture->name = name;
    texture->texels = readRgba(bytes, name, texture->width, texture->height);
    lineariseColor(texture->texels);
    if (!keepAlpha)
        for (vec4& texel : texture->texels) texel.w = 1;
    return texture;
}

}  // namespace brume::scene
