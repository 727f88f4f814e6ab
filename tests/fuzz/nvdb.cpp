// SPDX-License-Identifier: Apache-2.0
#include <fuzz/target.hpp>
#include <volumes/vdb_file.hpp>

void brume::fuzz::parse(Bytes bytes) {
    const TempFile file(bytes, ".nvdb");
    scene::Volume volume;
    volume.file = file.path();
    for (const volumes::GridInfo& grid : volumes::listGrids(file.path())) {
        volume.density = grid.name;
        volume.gridIndex = grid.index;
        if (grid.refusal.empty()) volumes::loadVolume(volume, 1, Log());
    }
}
