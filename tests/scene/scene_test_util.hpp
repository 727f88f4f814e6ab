// SPDX-License-Identifier: Apache-2.0
// Helpers of the scene tests: temporary folders, messages, and glTF files made in memory.
#pragma once

#include <gtest/gtest.h>
#include <core/error.hpp>
#include <core/image_io.hpp>

#include <unistd.h>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace brume::test {

/// A folder that disappears with the object.
class TempFolder {
  public:
    TempFolder() {
        static std::atomic<int> count{0};
        mPath = std::filesystem::temp_directory_path() /
                ("brume_scene_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(mPath);
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::filesystem::path& path() const { return mPath; }
    std::filesystem::path operator/(const std::string& name) const { return mPath / name; }

    std::filesystem::path write(const std::string& name, const std::string& content) const {
        std::ofstream(mPath / name, std::ios::binary) << content;
        return mPath / name;
    }

  private:
    std::filesystem::path mPath;
};

inline std::string readBytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The message of the input Error that `call` throws; a remark if it does not.
template <typename Call>
std::string messageOf(Call call) {
    try {
        call();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Input) return "not an input error";
        return error.what();
    }
    return "no error";
}

inline std::filesystem::path sharedData() { return BRUME_SHARED_DATA_DIR; }

#define BRUME_SKIP_WITHOUT(file)        \
    if (!std::filesystem::exists(file)) \
    GTEST_SKIP() << "needs " << (file).string() << ", which is absent"

/// Collects the binary chunk of a glTF file and its views and accessors.
class GlbBuilder {
  public:
    /// Appends floats as one accessor; returns its index.
    int addFloats(const std::vector<float>& values, int componentCount) {
        const int view = addView(values.data(), values.size() * sizeof(float));
        const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        return addAccessor(view, 5126, values.size() / static_cast<std::size_t>(componentCount),
                           types[componentCount]);
    }

    int addIndices(const std::vector<std::uint16_t>& values) {
        const int view = addView(values.data(), values.size() * sizeof(std::uint16_t));
        return addAccessor(view, 5123, values.size(), "SCALAR");
    }

    int addView(const void* data, std::size_t size) {
        while (mBinary.size() % 4 != 0) mBinary.push_back('\0');
        mViews += (mViewCount > 0 ? "," : "") + std::string("{\"buffer\":0,\"byteOffset\":") +
                  std::to_string(mBinary.size()) + ",\"byteLength\":" + std::to_string(size) + "}";
        mBinary.append(static_cast<const char*>(data), size);
        return mViewCount++;
    }

    int addAccessor(int view, int componentType, std::size_t count, const std::string& type,
                    const std::string& more = "") {
        mAccessors += (mAccessorCount > 0 ? "," : "") +
                      (view >= 0 ? "{\"bufferView\":" + std::to_string(view) + "," : "{") +
                      "\"componentType\":" + std::to_string(componentType) +
                      ",\"count\":" + std::to_string(count) + ",\"type\":\"" + type + "\"" + more +
                      "}";
        return mAccessorCount++;
    }

    /// `members`: the other members of the root object, without braces.
    std::string json(const std::string& members) {
        while (mBinary.size() % 4 != 0) mBinary.push_back('\0');
        return "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" +
               std::to_string(mBinary.size()) + "}],\"bufferViews\":[" + mViews +
               "],\"accessors\":[" + mAccessors + "]," + members + "}";
    }

    const std::string& binary() const { return mBinary; }

    std::vector<unsigned char> build(const std::string& members) {
        return pack(json(members), mBinary);
    }

    static std::vector<unsigned char> pack(std::string json, std::string binary) {
        while (json.size() % 4 != 0) json += ' ';
        while (binary.size() % 4 != 0) binary += '\0';
        const auto word = [](std::size_t value) {
            const auto bits = static_cast<std::uint32_t>(value);
            return std::string(reinterpret_cast<const char*>(&bits), 4);
        };
        const std::string file = "glTF" + word(2) + word(28 + json.size() + binary.size()) +
                                 word(json.size()) + "JSON" + json + word(binary.size()) +
                                 std::string("BIN\0", 4) + binary;
        return {file.begin(), file.end()};
    }

  private:
    std::string mBinary, mViews, mAccessors;
    int mViewCount = 0, mAccessorCount = 0;
};

/// The bytes of a small PNG file.
inline std::string makePngBytes(int size) {
    const TempFolder folder;
    Image image(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            image.at(x, y) = vec3(static_cast<float>(x) / 8, static_cast<float>(y) / 8, 0.5f);
    writeImage(folder / "a.png", image);
    return readBytes(folder / "a.png");
}

}  // namespace brume::test
