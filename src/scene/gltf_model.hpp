// SPDX-License-Identifier: Apache-2.0
// What the parts of the glTF loader share: the parsed file, its errors, and what was ignored.
#pragma once

#include <core/error.hpp>
#include <scene/scene.hpp>

#include <tiny_gltf.h>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace brume::scene {

/// A limit on each file: what its vertices take in memory stays below half a gigabyte.
inline constexpr std::size_t kMaxGltfVertices = std::size_t{1} << 24;
inline constexpr std::size_t kMaxGltfIndices = 3 * kMaxGltfVertices;

/// A file as tinygltf parsed it. None of its indices and sizes can be trusted.
struct GltfModel {
    std::string name;
    tinygltf::Model model;
    mutable std::set<std::string> ignored;  ///< features met that Brume has no use for

    /// "accessors[3]: problem".
    Error error(const char* list, int index, const std::string& problem) const;
    Error error(const std::string& problem) const;
};

/// The bytes of a .glb or .gltf of at most 1 GiB. Throws an input Error.
std::vector<unsigned char> readGltfBytes(const std::filesystem::path& file);

/// Parses the bytes and reads the buffers and images they name. Throws an input Error.
GltfModel parseGltfModel(const std::vector<unsigned char>& bytes,
                         const std::filesystem::path& file);

/// An element of one of the model's lists; throws if the index is out of range.
template <typename T>
const T& pick(const GltfModel& gltf, const std::vector<T>& list, const char* name, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        throw gltf.error(name, index, "no such element, there are " + std::to_string(list.size()));
    return list[static_cast<std::size_t>(index)];
}

/// The bytes of a buffer view, within its buffer.
std::span<const unsigned char> viewBytes(const GltfModel& gltf, int view);

/// An accessor of `componentCount` finite numbers per element, element after element.
std::vector<float> readFloats(const GltfModel& gltf, int accessor, int componentCount);

/// An accessor of unsigned scalars.
std::vector<std::uint32_t> readIndices(const GltfModel& gltf, int accessor);

/// Where a material's texture takes its coordinates from.
struct UvSource {
    int set = 0;  ///< TEXCOORD_<set>
    dvec2 offset{0};
    dvec2 scale{1};
    double rotation = 0;  ///< radians

    vec2 apply(const vec2& uv) const;
};

struct GltfMaterial {
    Material material;
    UvSource uv;  ///< of the colour texture, else of the emission texture
};

/// Converts materials; each image is decoded once.
class GltfMaterialReader {
  public:
    explicit GltfMaterialReader(const GltfModel& gltf) : mGltf(gltf) {}

    GltfMaterial read(int index);

  private:
    std::shared_ptr<const Texture> readTexture(int index, bool keepAlpha);
    std::vector<unsigned char> imageBytes(int index) const;
    void readColor(const tinygltf::Material& source, int index, GltfMaterial& result);
    void readEmission(const tinygltf::Material& source, int index, GltfMaterial& result);
    void readGlass(const tinygltf::Material& source, int index, Material& material) const;

    const GltfModel& mGltf;
    std::map<std::pair<int, bool>, std::shared_ptr<const Texture>> mTextures;
};

}  // namespace brume::scene
