// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 (.glb, .gltf) to meshes and materials.
#pragma once

#include <core/log.hpp>
#include <scene/scene.hpp>

#include <filesystem>
#include <vector>

namespace brume::scene {

struct GltfContent {
    std::vector<Mesh> meshes;  ///< one per node and primitive; `material` indexes `materials`
    std::vector<Material> materials;
};

/// Reads the default scene of a file with the buffers and images it names. Materials are mapped as
/// docs/formats.md says; what is ignored is named in one warning per file. Throws an input Error.
GltfContent loadGltf(const std::filesystem::path& file, const Log& log);

/// The same from the bytes of the file; `file` gives the folder of relative paths and the name in
/// messages.
GltfContent parseGltf(const std::vector<unsigned char>& bytes, const std::filesystem::path& file,
                      const Log& log);

}  // namespace brume::scene
