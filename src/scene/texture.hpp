// SPDX-License-Identifier: Apache-2.0
// Textures: decoding, and the one definition of a lookup that every renderer follows.
#pragma once

#include <scene/scene.hpp>

#include <memory>
#include <string>
#include <vector>

namespace brume::scene {

/// Bilinear between texel centres (at (i + 1/2) / size), repeating in both directions. uv finite.
vec4 sampleBilinear(const Texture& texture, dvec2 uv);

/// Radiance of the background in a unit direction. The environment's rows do not repeat: beyond
/// the centres of the first and last row (the poles) v is clamped to them.
dvec3 environmentRadiance(const Background& background, const dvec3& direction);

/// Where a unit direction lies in a latitude-longitude map (Background::environment).
dvec2 environmentUv(const dvec3& direction);

/// Reads a texture: .exr and .hdr are linear, all other formats sRGB. Values that are negative or
/// not finite become 0. Throws an input Error.
std::shared_ptr<const Texture> loadTexture(const std::filesystem::path& file);

/// The same from a PNG or JPEG file in memory; `keepAlpha` false sets alpha to 1.
std::shared_ptr<const Texture> decodeTexture(const std::vector<unsigned char>& bytes,
                                             const std::string& name, bool keepAlpha);

}  // namespace brume::scene
