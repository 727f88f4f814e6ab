// SPDX-License-Identifier: Apache-2.0
// Makes what the scenes of the gallery are built from: volumes, meshes and skies, all by rule.
//   brume_gallery_assets FOLDER [DETAIL]
// DETAIL (1): resolution of the volumes relative to that of the gallery's pictures.
#include "meshes.hpp"
#include "skies.hpp"
#include "volumes.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int count, char** arguments) {
    const float detail = count > 2 ? std::strtof(arguments[2], nullptr) : 1.0f;
    if (count < 2 || count > 3 || !(detail >= 0.1f && detail <= 4)) {
        std::fprintf(stderr, "usage: brume_gallery_assets FOLDER [DETAIL from 0.1 to 4]\n");
        return 2;
    }
    try {
        const std::filesystem::path folder = arguments[1];
        std::filesystem::create_directories(folder);
        brume::gallery::writeSkies(folder);
        brume::gallery::writeMeshes(folder);
        brume::gallery::writeVolumes(folder, detail);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "brume_gallery_assets: %s\n", error.what());
        return 1;
    }
    return 0;
}
