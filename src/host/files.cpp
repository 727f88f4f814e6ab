// SPDX-License-Identifier: Apache-2.0
#include <core/image_io.hpp>
#include <host/files.hpp>
#include <volumes/box_decomposition.hpp>

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace brume {
namespace {

constexpr const char* kReading = "reading image";

thread_local const host::Readers* tReaders = nullptr;

/// Frees what a reader of the host's has made.
template <typename Made>
struct Release {
    const Made& made;
    ~Release() {
        if (made.release) made.release(made.owner);
    }
};

std::vector<vec4> decode(const void* bytes, std::size_t count, const std::string& name, int& width,
                         int& height) {
    if (!tReaders || !tReaders->readImage)
        throw inputError(kReading, name,
                         "the host reads no images: give readImage to brumeCreateContext()");
    BrumePixels pixels{};
    pixels.structSize = sizeof(pixels);
    if (tReaders->readImage(tReaders->user, name.c_str(), bytes, count, &pixels) != BRUME_SUCCESS)
        throw inputError(kReading, name, "the host's readImage() has failed");
    const Release<BrumePixels> release{pixels};
    const std::uint64_t texels = std::uint64_t{pixels.width} * pixels.height;
    if (texels == 0 || texels > (1u << 25) || !pixels.rgba)
        throw inputError(kReading, name,
                         fmt::format("the host's readImage() gave {} x {} texels, allowed are 1 to "
                                     "2^25",
                                     pixels.width, pixels.height));
    width = static_cast<int>(pixels.width);
    height = static_cast<int>(pixels.height);
    std::vector<vec4> result(texels);
    std::memcpy(result.data(), pixels.rgba, texels * sizeof(vec4));
    return result;
}

}  // namespace

// The library's own image reader: see BRUME_OWN_IMAGE_READER.
std::vector<vec4> readRgba(const std::filesystem::path& file, int& width, int& height) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream || bytes.empty()) throw inputError(kReading, file.string(), "it cannot be read");
    return decode(bytes.data(), bytes.size(), file.string(), width, height);
}

std::vector<vec4> readRgba(const std::vector<unsigned char>& bytes, const std::string& name,
                           int& width, int& height) {
    return decode(bytes.data(), bytes.size(), name, width, height);
}

}  // namespace brume

namespace brume::host {

ImageReading::ImageReading(const Readers& readers) { tReaders = &readers; }
ImageReading::~ImageReading() { tReaders = nullptr; }

volumes::VolumeGrid makeGrid(const BrumeDensity& density, const std::string& doing,
                             const std::string& where) {
    const auto refuseField = [&](const std::string& problem) {
        return inputError(doing, where, problem);
    };
    volumes::VolumeGrid grid;
    grid.name = where;
    grid.worldFromIndex = glm::make_mat4(density.worldFromIndex);
    const double determinant = glm::determinant(dmat3(grid.worldFromIndex));
    if (!std::isfinite(determinant) || determinant == 0)
        throw refuseField("worldFromIndex cannot be inverted");
    if ((density.brickCount > 0 && (!density.origins || !density.values)) ||
        (density.tileCount > 0 && !density.tiles))
        throw refuseField("it counts bricks or tiles that it does not have");
    const std::size_t count = density.brickCount;
    grid.values.assign(density.values, density.values + count * volumes::kBrickValueCount);
    for (float& value : grid.values)
        if (!(std::isfinite(value) && value >= 0)) value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        volumes::Brick brick;
        brick.origin = {density.origins[3 * i], density.origins[3 * i + 1],
                        density.origins[3 * i + 2]};
        for (int axis = 0; axis < 3; ++axis)
            if (brick.origin[axis] % volumes::kBrickCells != 0)
                throw refuseField(fmt::format("brick {} begins at {}, allowed are multiples of 8",
                                              i, brick.origin[axis]));
        brick.valueOffset = static_cast<std::uint32_t>(i * volumes::kBrickValueCount);
        const auto values = grid.values.begin() + brick.valueOffset;
        brick.maxValue = *std::max_element(values, values + volumes::kBrickValueCount);
        if (brick.maxValue > 0) grid.bricks.push_back(brick);
    }
    for (std::uint32_t i = 0; i < density.tileCount; ++i) {
        const BrumeTile& tile = density.tiles[i];
        if (!(std::isfinite(tile.value) && tile.value > 0)) continue;
        grid.boxes.push_back({{tile.lo[0], tile.lo[1], tile.lo[2]},
                              {tile.hi[0], tile.hi[1], tile.hi[2]},
                              tile.value,
                              true});
    }
    return grid;
}

volumes::VolumeGrid readVolume(const Readers& readers, const scene::Volume& volume,
                               double largestExtinction) {
    constexpr const char* kDoing = "loading volume";
    const std::string where = volume.file.string();
    if (!readers.readVolume)
        throw inputError(kDoing, where,
                         "the host reads no volumes: give readVolume to brumeCreateContext()");
    BrumeDensity density{};
    density.structSize = sizeof(density);
    if (readers.readVolume(readers.user, where.c_str(), volume.density.c_str(), volume.gridIndex,
                           &density) != BRUME_SUCCESS)
        throw inputError(kDoing, where, "the host's readVolume() has failed");
    const Release<BrumeDensity> release{density};
    volumes::VolumeGrid grid = makeGrid(density, kDoing, where);
    grid.worldFromIndex = volume.worldFromFile * grid.worldFromIndex;
    if (volume.representation == scene::VolumeRepresentation::Boxes)
        volumes::convertToBoxes(grid, largestExtinction, volume.tolerance);
    return grid;
}

namespace {

double lengthOf(const scene::ModuleSettings& module, const char* key) {
    const auto found = module.values.find(key);
    double sum = 0;
    if (found != module.values.end())
        for (const double value : found->second) sum += value * value;
    return std::sqrt(sum);
}

double reachOf(const scene::Emitter& emitter) {
    double reach = glm::length(emitter.position) + emitter.radius + glm::length(emitter.size);
    if (emitter.shape == scene::EmitterShape::Cone) reach += emitter.height;
    double path = 0;
    for (const auto& [time, offset] : emitter.path) path = std::max(path, glm::length(offset));
    if (emitter.triangles)
        for (const scene::EmitterTriangle& triangle : *emitter.triangles)
            for (const dvec3& corner : {triangle.a, triangle.b, triangle.c})
                reach = std::max(reach, glm::length(corner + emitter.position));
    return reach + path;
}

}  // namespace

double estimateReach(const scene::Effect& effect) {
    double acceleration = 0, wind = 0, drag = 0;
    for (const scene::ModuleSettings& module : effect.modules) {
        acceleration += lengthOf(module, "acceleration");
        wind = std::max(wind, lengthOf(module, "wind"));
        if (module.type == "curl_noise") wind += lengthOf(module, "strength");
        if (module.type == "drag") drag += lengthOf(module, "rate");
    }
    double radius = 0;
    for (const auto& [age, value] : effect.radius.keys) radius = std::max(radius, value);
    double reach = 0;
    for (const scene::Emitter& emitter : effect.emitters) {
        const double life = emitter.lifetime.y;
        // With drag, speeds decay towards the wind and that of falling freely.
        const double speedTime = drag > 0 ? std::min(life, 1 / drag) : life;
        const double fall =
            drag > 0 ? acceleration / drag * life : 0.5 * acceleration * life * life;
        reach = std::max(reach, reachOf(emitter) + emitter.speed.y * speedTime +
                                    std::min(fall, 0.5 * acceleration * life * life) + wind * life);
    }
    for (const scene::SubEmitter& sub : effect.subEmitters)
        reach = std::max(reach, reach + estimateReach(*sub.effect));
    return reach + radius;
}

}  // namespace brume::host
