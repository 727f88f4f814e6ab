// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <core/image_io.hpp>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>

namespace brume {
namespace {

constexpr const char* kReading = "reading image";
constexpr const char* kWriting = "writing image";

/// Larger pictures are refused before any memory is taken: headers of broken files claim anything.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 25;

constexpr const char* kToneCurveText =
    "Brume: linear radiance x, per channel x up to 0.8, above it 1 - 0.2 / (1 + (x - 0.8) / 0.2), "
    "then the sRGB transfer curve";

double srgbFromLinear(double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

std::uint32_t readBigEndian(const unsigned char* bytes) {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
           std::uint32_t{bytes[2]} << 8 | bytes[3];
}

/// CRC-32 of the PNG specification (ISO 3309).
std::uint32_t computeCrc(std::span<const unsigned char> bytes) {
    static const std::array<std::uint32_t, 256> table = [] {
        std::array<std::uint32_t, 256> values{};
        for (std::uint32_t n = 0; n < 256; ++n) {
            std::uint32_t c = n;
            for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
            values[n] = c;
        }
        return values;
    }();
    std::uint32_t c = 0xffffffffu;
    for (const unsigned char byte : bytes) c = table[(c ^ byte) & 0xff] ^ (c >> 8);
    return ~c;
}

bool isPng(std::span<const unsigned char> bytes) {
    constexpr unsigned char kMagic[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() > sizeof kMagic && std::equal(kMagic, std::end(kMagic), bytes.begin());
}

/// Finds cut off and damaged PNG files before libpng does, which would print.
void checkPng(std::span<const unsigned char> bytes, const std::string& name) {
    constexpr std::size_t kSignature = 8, kFrame = 12;  // of a chunk: length, type, CRC
    std::size_t offset = kSignature;
    while (offset + kFrame <= bytes.size()) {
        const std::size_t length = readBigEndian(&bytes[offset]);
        if (length > bytes.size() - offset - kFrame) break;
        const std::uint32_t crc = readBigEndian(&bytes[offset + 8 + length]);
        if (computeCrc(bytes.subspan(offset + 4, length + 4)) != crc)
            throw inputError(kReading, name, "the PNG file is damaged");
        if (std::memcmp(&bytes[offset + 4], "IEND", 4) == 0) return;
        offset += length + kFrame;
    }
    throw inputError(kReading, name, "the PNG file is cut off");
}

/// An image file that is open and whose header is plausible.
struct OpenImage {
    std::unique_ptr<OIIO::ImageInput> input;
    int width = 0;
    int height = 0;
    int channelCount = 0;
    bool isFloat = false;
};

OpenImage openImage(const std::string& file, OIIO::Filesystem::IOProxy* proxy,
                    const std::string& name, std::int64_t maxPixels) {
    // Alpha must not be multiplied into the colour: it means coverage, not light.
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    // The readers look for the proxy here once they are given a configuration.
    if (proxy) config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    OpenImage image;
    image.input = OIIO::ImageInput::open(file, &config, proxy);
    if (!image.input) {
        const std::string reason = OIIO::geterror();
        throw inputError(kReading, name, reason.empty() ? "unknown image format" : reason);
    }
    const OIIO::ImageSpec& spec = image.input->spec();
    image.width = spec.width;
    image.height = spec.height;
    image.channelCount = spec.nchannels;
    image.isFloat = spec.format.basetype == OIIO::TypeDesc::HALF ||
                    spec.format.basetype == OIIO::TypeDesc::FLOAT ||
                    spec.format.basetype == OIIO::TypeDesc::DOUBLE;
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1)
        throw inputError(kReading, name, "not a two-dimensional picture");
    if (std::int64_t{spec.width} * spec.height > maxPixels)
        throw inputError(kReading, name,
                         fmt::format("{} x {} pixels, at most {} are allowed", spec.width,
                                     spec.height, maxPixels));
    return image;
}

/// Fills `values`, `stride` floats apart, with the first `channelCount` channels.
void readChannels(OpenImage& image, const std::string& name, int channelCount, int stride,
                  float* values) {
    const auto pixelBytes = static_cast<OIIO::stride_t>(stride * sizeof(float));
    if (!image.input->read_image(0, 0, 0, channelCount, OIIO::TypeDesc::FLOAT, values, pixelBytes,
                                 pixelBytes * image.width))
        throw inputError(kReading, name, image.input->geterror());
}

std::vector<vec4> readTexels(OpenImage image, const std::string& name, int& width, int& height) {
    const int channelCount = std::min(image.channelCount, 4);
    std::vector<vec4> texels(static_cast<std::size_t>(image.width) * image.height, vec4(1));
    readChannels(image, name, channelCount, 4, &texels[0][0]);
    if (channelCount == 1)
        for (vec4& t : texels) t = vec4(t.x, t.x, t.x, 1);
    else if (channelCount == 2)
        for (vec4& t : texels) t = vec4(t.x, t.x, t.x, t.y);
    width = image.width;
    height = image.height;
    return texels;
}

/// OpenImageIO chooses its reader by the extension of a name.
const char* recogniseFormat(std::span<const unsigned char> bytes, const std::string& name) {
    if (isPng(bytes)) {
        checkPng(bytes, name);
        return "memory.png";
    }
    if (bytes.size() > 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff)
        return "memory.jpg";
    throw inputError(kReading, name, "unknown image format, allowed are PNG and JPEG");
}

OpenImage openFile(const std::filesystem::path& file, std::int64_t maxPixels) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored))
        throw inputError(kReading, file.string(), "no such file");
    if (file.extension() == ".png") {
        std::ifstream stream(file, std::ios::binary);
        const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream),
                                               std::istreambuf_iterator<char>()};
        if (!isPng(bytes)) throw inputError(kReading, file.string(), "not a PNG file");
        checkPng(bytes, file.string());
    }
    return openImage(file.string(), nullptr, file.string(), maxPixels);
}

/// What goes into a file: exactly one kind of pixels.
struct Pixels {
    int width = 0, height = 0;
    const vec3* linear = nullptr;
    const unsigned char* srgb = nullptr;
    const char* description = nullptr;
};

/// `memory`: takes the bytes instead of the file; may be null.
void writePixels(const std::filesystem::path& file, const Pixels& pixels,
                 OIIO::Filesystem::IOProxy* memory = nullptr) {
    const bool isFloat = pixels.linear;
    std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(isFloat ? "openexr" : "png");
    if (!output) throw failure(kWriting, file.string(), OIIO::geterror());
    OIIO::ImageSpec spec(pixels.width, pixels.height, 3,
                         isFloat ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    spec["oiio:ColorSpace"] = isFloat ? "Linear" : "sRGB";
    if (isFloat) {
        spec["compression"] = "zip";
        // The writer would put in the time: the same picture shall be the same bytes.
        spec["DateTime"] = "1970:01:01 00:00:00";
    }
    if (pixels.description) spec["ImageDescription"] = pixels.description;
    if (memory && !output->set_ioproxy(memory))
        throw failure(kWriting, file.string(), "cannot be written to memory");
    bool isWritten = output->open(file.string(), spec);
    if (isWritten && isFloat)
        isWritten = output->write_image(OIIO::TypeDesc::FLOAT, pixels.linear);
    else if (isWritten)
        isWritten = output->write_image(OIIO::TypeDesc::UINT8, pixels.srgb);
    if (!isWritten || !output->close()) throw failure(kWriting, file.string(), output->geterror());
}

/// Beside the file first, so that it appears whole or not at all.
void writeWhole(const std::filesystem::path& file, const Pixels& pixels) {
    std::filesystem::path part = file;
    part += ".part";
    std::error_code error;
    try {
        writePixels(part, pixels);
    } catch (const Error&) {
        std::filesystem::remove(part, error);
        throw;
    }
    std::filesystem::rename(part, file, error);
    if (error) throw failure(kWriting, file.string(), error.message());
}

}  // namespace

float toneMap(float radiance) {
    if (!(radiance > 0)) return 0;  // NaN too
    if (radiance <= 0.8f) return radiance;
    return 1.0f - 0.2f / (1.0f + (radiance - 0.8f) / 0.2f);
}

Image readImage(const std::filesystem::path& file) {
    OpenImage open = openFile(file, kMaxPixels);
    Image image(open.width, open.height);
    const int channelCount = open.channelCount < 3 ? 1 : 3;
    readChannels(open, file.string(), channelCount, 3, &image.pixels[0][0]);
    for (vec3& pixel : image.pixels) {
        if (channelCount == 1) pixel = vec3(pixel.x);
        if (!open.isFloat)
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] = static_cast<float>(linearFromSrgb(pixel[channel]));
    }
    return image;
}

std::vector<vec4> readRgba(const std::filesystem::path& file, int& width, int& height) {
    return readTexels(openFile(file, kMaxTexels), file.string(), width, height);
}

std::vector<vec4> readRgba(const std::vector<unsigned char>& bytes, const std::string& name,
                           int& width, int& height) {
    const char* memoryName = recogniseFormat(bytes, name);
    OIIO::Filesystem::IOMemReader reader(const_cast<unsigned char*>(bytes.data()), bytes.size());
    return readTexels(openImage(memoryName, &reader, name, kMaxTexels), name, width, height);
}

void writeImage(const std::filesystem::path& file, const Image& image) {
    const std::string extension = file.extension().string();
    if (extension != ".exr" && extension != ".png")
        throw inputError(kWriting, file.string(), "unknown extension, allowed are .exr and .png");
    if (image.isEmpty()) throw inputError(kWriting, file.string(), "the image has no pixels");
    if (extension == ".exr")
        return writeWhole(file, {image.width, image.height, image.pixels.data()});
    const std::vector<unsigned char> bytes = encodeSrgb8(image);
    writeWhole(file, {image.width, image.height, nullptr, bytes.data(), kToneCurveText});
}

void writeSrgb8(const std::filesystem::path& file, int width, int height,
                const std::vector<unsigned char>& pixels) {
    if (file.extension() != ".png")
        throw inputError(kWriting, file.string(), "unknown extension, allowed is .png");
    if (width < 1 || height < 1 || pixels.size() != 3 * static_cast<std::size_t>(width) * height)
        throw inputError(kWriting, file.string(), "the picture does not have three bytes per pixel");
    writeWhole(file, {width, height, nullptr, pixels.data()});
}

std::vector<unsigned char> encodePng(const Image& image) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::vector<unsigned char> pixels = encodeSrgb8(image);
    writePixels("memory.png", {image.width, image.height, nullptr, pixels.data(), kToneCurveText},
                &memory);
    return bytes;
}

std::vector<unsigned char> encodeSrgb8(const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const vec3& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel) {
            const double x = srgbFromLinear(toneMap(pixel[channel]));
            bytes.push_back(static_cast<unsigned char>(std::lround(255.0 * x)));
        }
    return bytes;
}

}  // namespace brume
