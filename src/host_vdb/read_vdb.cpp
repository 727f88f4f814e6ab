// SPDX-License-Identifier: Apache-2.0
// Volume files for hosts; the only part of the libraries for hosts with OpenVDB.
#include <brume/brume_vdb.h>
#include <core/error.hpp>
#include <volumes/vdb_file.hpp>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

namespace {

using namespace brume;

thread_local char tLastError[1024] = "";

void keep(const char* text) {
    std::strncpy(tLastError, text, sizeof(tLastError) - 1);
    tLastError[sizeof(tLastError) - 1] = 0;
}

/// A grid in the form of the C structure.
struct Owner {
    std::vector<std::int32_t> origins;
    std::vector<float> values;
    std::vector<BrumeTile> tiles;
};

std::unique_ptr<Owner> makeOwner(const volumes::VolumeGrid& grid) {
    auto owner = std::make_unique<Owner>();
    for (const volumes::Brick& brick : grid.bricks) {
        owner->origins.insert(owner->origins.end(),
                              {brick.origin.x, brick.origin.y, brick.origin.z});
        const auto first = grid.values.begin() + brick.valueOffset;
        owner->values.insert(owner->values.end(), first, first + volumes::kBrickValueCount);
    }
    for (const volumes::ValueBox& box : grid.boxes)
        owner->tiles.push_back(
            {{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}, box.value});
    return owner;
}

void read(const char* file, const char* name, std::int32_t gridIndex, BrumeDensity* density) {
    constexpr const char* kDoing = "brumeReadVdb";
    if (!file || !name || !density) throw inputError(kDoing, "", "an argument is null");
    if (density->structSize < sizeof(BrumeDensity))
        throw inputError(kDoing, "density", "start it with BRUME_INIT");
    scene::Volume volume;
    volume.file = file;
    volume.density = name;
    volume.gridIndex = gridIndex;
    const volumes::VolumeGrid grid = volumes::loadVolume(volume, 1, {});
    std::unique_ptr<Owner> owner = makeOwner(grid);
    density->brickCount = static_cast<std::uint32_t>(grid.bricks.size());
    density->tileCount = static_cast<std::uint32_t>(owner->tiles.size());
    std::copy_n(glm::value_ptr(grid.worldFromIndex), 16, density->worldFromIndex);
    density->origins = owner->origins.data();
    density->values = owner->values.data();
    density->tiles = owner->tiles.data();
    density->release = [](void* owned) { delete static_cast<Owner*>(owned); };
    density->owner = owner.release();
}

}  // namespace

extern "C" BRUME_API const char* brumeVdbLastError(void) { return tLastError; }

extern "C" BRUME_API BrumeResult brumeReadVdb(void*, const char* file, const char* grid,
                                              int32_t gridIndex, BrumeDensity* density) {
    try {
        read(file, grid, gridIndex, density);
        return BRUME_SUCCESS;
    } catch (const Error& e) {
        keep(e.what());
        return e.kind() == ErrorKind::Input ? BRUME_ERROR_INVALID_ARGUMENT : BRUME_ERROR_FAILED;
    } catch (const std::bad_alloc&) {
        keep("brumeReadVdb: the host is out of memory");
        return BRUME_ERROR_OUT_OF_HOST_MEMORY;
    } catch (const std::exception& e) {
        keep(e.what());
        return BRUME_ERROR_FAILED;
    }
}
