// SPDX-License-Identifier: Apache-2.0
// Image files; the only place with OpenImageIO (target brume_image).
#pragma once

#include <core/image.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace brume {

/// Reads any format that OpenImageIO knows as linear RGB: integer formats are taken as sRGB, float
/// formats (EXR, HDR) as linear; grey becomes RGB, alpha is dropped. Throws an input Error.
Image readImage(const std::filesystem::path& file);

/// Reads an image of one to four channels as RGBA floats without any colour conversion, row-major
/// from the top left (missing: green and blue repeat red, alpha is 1), alpha not multiplied into
/// the colour. For textures of at most 2^25 texels. Throws an input Error.
std::vector<vec4> readRgba(const std::filesystem::path& file, int& width, int& height);

/// The same from a file held in memory (PNG or JPEG, e.g. embedded in a .glb); `name` is used in
/// messages.
std::vector<vec4> readRgba(const std::vector<unsigned char>& bytes, const std::string& name,
                           int& width, int& height);

/// Writes by extension: .exr linear float, .png 8-bit sRGB. The PNG's tone curve is toneMap() and
/// is stated in the file's ImageDescription. The file appears whole or not at all (written beside,
/// then renamed). Throws an Error of kind Failure, of kind Input for another extension.
void writeImage(const std::filesystem::path& file, const Image& image);

/// The same with 8-bit sRGB pixels as they are, three bytes each: pictures of a screen. PNG only.
void writeSrgb8(const std::filesystem::path& file, int width, int height,
                const std::vector<unsigned char>& pixels);

/// The bytes of the PNG file that writeImage() would write. Throws a failure Error.
std::vector<unsigned char> encodePng(const Image& image);

/// The pixels that a PNG of the image has, three bytes each.
std::vector<unsigned char> encodeSrgb8(const Image& image);

/// The tone curve of PNG output: linear up to 0.8, above it a shoulder 1 - 0.2/(1 + (x - 0.8)/0.2)
/// that reaches 1 at infinity, per channel. Continuous with its first derivative.
float toneMap(float radiance);

}  // namespace brume
