// SPDX-License-Identifier: Apache-2.0
#include "skies.hpp"

#include "noise.hpp"

#include <core/image_io.hpp>

#include <numbers>

namespace brume::gallery {
namespace {

using Sky = vec3 (*)(vec3 direction);

void writeSky(const std::filesystem::path& file, int width, Sky sky) {
    Image image(width, width / 2);
    const float pi = std::numbers::pi_v<float>;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x) {
            const float a =
                2 * pi * ((static_cast<float>(x) + 0.5f) / static_cast<float>(width) - 0.5f);
            const float b = pi * (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height);
            image.at(x, y) =
                sky({std::sin(b) * std::sin(a), std::cos(b), -std::sin(b) * std::cos(a)});
        }
    writeImage(file, image);
}

/// A lobe around a direction: 1 there, 1/e at `degrees` from it.
float lobe(vec3 direction, vec3 center, float degrees) {
    const float angle =
        std::acos(glm::clamp(glm::dot(direction, glm::normalize(center)), -1.0f, 1.0f));
    const float s = angle * 180 / std::numbers::pi_v<float> / degrees;
    return std::exp(-s * s);
}

/// The sun has just touched the horizon; streaks of high cloud catch its light.
vec3 sunset(vec3 d) {
    const float up = std::max(d.y, 0.0f);
    const vec3 toSun(0.16f, 0.11f, -1);
    vec3 sky = glm::mix(vec3(0.62f, 0.30f, 0.20f), vec3(0.30f, 0.26f, 0.38f), rise(0, 0.16f, up));
    sky = glm::mix(sky, vec3(0.07f, 0.13f, 0.30f), rise(0.1f, 0.75f, up));
    sky += vec3(1.1f, 0.46f, 0.13f) * lobe(d, toSun, 16) +
           vec3(0.35f, 0.16f, 0.08f) * lobe(d, toSun, 42);
    const vec3 sheet = d / (up + 0.12f);
    const float streaks =
        rise(0.02f, 0.55f, fractal(vec3(sheet.x * 0.7f, 0.3f, sheet.z * 2.2f), 5, 5));
    return sky + streaks * rise(0.02f, 0.2f, up) *
                     (vec3(0.50f, 0.20f, 0.14f) * lobe(d, toSun, 60) + vec3(0.02f, 0.015f, 0.03f));
}

/// Stars over the last light of the horizon.
vec3 night(vec3 d) {
    const float up = std::max(d.y, 0.0f);
    vec3 sky =
        glm::mix(vec3(0.020f, 0.030f, 0.052f), vec3(0.0028f, 0.0045f, 0.012f), rise(0, 0.5f, up));
    const ivec3 cell(glm::floor(d * 260.0f));
    const float chance = uniformOf(cell, 3);
    if (chance > 0.996f)
        sky += vec3(0.9f, 0.95f, 1.1f) * std::pow(uniformOf(cell, 4), 5.0f) *
               rise(0.02f, 0.25f, up) * 0.8f;
    const vec3 band = glm::normalize(vec3(0.5f, 0.55f, 0.4f));
    const float across = glm::dot(d, band);
    return sky + vec3(0.012f, 0.012f, 0.018f) * std::exp(-across * across * 14) *
                     (0.5f + 0.9f * billow(d * 4.0f, 4, 8)) * rise(0, 0.3f, up);
}

/// A bright, hazy morning with the sun high behind.
vec3 morning(vec3 d) {
    const float up = std::max(d.y, 0.0f);
    vec3 sky = glm::mix(vec3(0.80f, 0.82f, 0.80f), vec3(0.30f, 0.48f, 0.72f), rise(0, 0.7f, up));
    const vec3 sheet = d / (up + 0.2f);
    sky += vec3(0.25f) * rise(0.0f, 0.5f, fractal(sheet * vec3(0.9f, 0.5f, 0.9f), 5, 2));
    return sky + vec3(0.6f, 0.5f, 0.35f) * lobe(d, {-0.5f, 0.75f, -0.6f}, 30);
}

/// A dark studio: one large window, a strip light and a bounce card, for glass to mirror.
vec3 studio(vec3 d) {
    vec3 light = glm::mix(vec3(0.17f, 0.15f, 0.14f), vec3(0.05f, 0.055f, 0.075f),
                          rise(-0.05f, 0.6f, std::abs(d.y)));
    const auto panel = [&](vec3 forward, vec2 half, vec3 radiance) {
        const vec3 f = glm::normalize(forward),
                   right = glm::normalize(glm::cross(f, vec3(0, 1, 0)));
        const vec3 up = glm::cross(right, f);
        const float ahead = glm::dot(d, f);
        if (ahead <= 0) return;
        const vec2 at = glm::abs(vec2(glm::dot(d, right), glm::dot(d, up)) / ahead);
        light += radiance * rise(1.06f, 0.94f, at.x / half.x) * rise(1.06f, 0.94f, at.y / half.y);
    };
    panel({-1, 0.75f, -0.55f}, {0.45f, 0.55f}, vec3(3.2f, 3.1f, 2.9f));
    panel({1, 0.5f, -0.8f}, {0.10f, 0.7f}, vec3(2.0f, 2.2f, 2.6f));
    panel({0.5f, 0.6f, 1}, {0.6f, 0.35f}, vec3(0.9f, 0.85f, 0.8f));
    return light;
}

}  // namespace

void writeSkies(const std::filesystem::path& folder) {
    writeSky(folder / "sunset.exr", 1024, &sunset);
    writeSky(folder / "night.exr", 2048, &night);
    writeSky(folder / "morning.exr", 1024, &morning);
    writeSky(folder / "studio.exr", 1024, &studio);
}

}  // namespace brume::gallery
