// SPDX-License-Identifier: Apache-2.0
#include <openvdb/tools/VolumeToMesh.h>
#include <fmt/format.h>
#include <volumes/file_reader.hpp>
#include <volumes/vdb_field.hpp>

#include <cmath>

namespace brume::volumes {
namespace {

constexpr float kGreatest = 1e18f;  // shaders/particles/step.h kills particles beyond

float cleaned(double value) {
    return std::abs(value) < kGreatest ? static_cast<float>(value) : 0.0f;
}

template <typename T>
void store(const T& value, float* target) {
    if constexpr (openvdb::VecTraits<T>::IsVec)
        for (int i = 0; i < 3; ++i) target[i] = cleaned(value[i]);
    else
        target[0] = cleaned(static_cast<double>(value));
}

/// Calls `visit(coord, value)` for the voxels of the box that count.
template <typename GridT, typename Visit>
void visitVoxels(const GridT& grid, const openvdb::CoordBBox& box, bool isLevelSet,
                 const Visit& visit) {
    if (isLevelSet) {
        const auto accessor = grid.getConstAccessor();
        for (auto voxel = box.begin(); voxel; ++voxel) visit(*voxel, accessor.getValue(*voxel));
        return;
    }
    for (auto value = grid.cbeginValueOn(); value; ++value) {
        openvdb::CoordBBox part;
        value.getBoundingBox(part);
        for (auto voxel = part.begin(); voxel; ++voxel) visit(*voxel, *value);
    }
}

template <typename GridT>
void copyValues(const GridT& grid, const openvdb::CoordBBox& box, scene::FieldValues& field) {
    const std::size_t count = static_cast<std::size_t>(field.componentCount);
    float background[3] = {};
    store(grid.background(), background);
    field.background = background[0];
    field.values.assign(box.volume() * count, 0.0f);
    visitVoxels(grid, box, field.isLevelSet, [&](const openvdb::Coord& coord, const auto& value) {
        const openvdb::Coord at = coord - box.min();
        const std::size_t voxel =
            (static_cast<std::size_t>(at.z()) * box.dim().y() + at.y()) * box.dim().x() + at.x();
        store(value, &field.values[voxel * count]);
    });
}

void addSurface(const openvdb::FloatGrid& grid, scene::FieldValues& field) {
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(grid, points, quads);
    const auto corner = [&](const openvdb::Vec4I& quad, int i) {
        const openvdb::Vec3s& p = points[quad[i]];
        return dvec3(p.x(), p.y(), p.z());
    };
    // Its faces are clockwise seen from outside.
    for (const openvdb::Vec4I& quad : quads) {
        field.surface.push_back({corner(quad, 0), corner(quad, 2), corner(quad, 1)});
        field.surface.push_back({corner(quad, 0), corner(quad, 3), corner(quad, 2)});
    }
}

}  // namespace

scene::FieldValues copyField(const openvdb::GridBase& grid, const std::string& name,
                             std::uint64_t maxValues) {
    if (grid.transform().mapType() == openvdb::math::NonlinearFrustumMap::mapType())
        throw MalformedFile("grid \"" + name +
                            "\" has a frustum as its transform, an affine one is allowed");
    scene::FieldValues field;
    const bool isVector = grid.isType<openvdb::Vec3SGrid>();
    field.componentCount = isVector ? 3 : 1;
    field.isStaggered = isVector && grid.getGridClass() == openvdb::GRID_STAGGERED;
    field.isLevelSet = grid.getGridClass() == openvdb::GRID_LEVEL_SET &&
                       grid.isType<openvdb::FloatGrid>();
    field.fileFromIndex = toWorldFromIndex(grid.transform());
    openvdb::CoordBBox box;
    if (!grid.constBaseTree().evalActiveVoxelBoundingBox(box)) return field;
    const openvdb::Coord dim = box.dim();
    const double count = double(dim.x()) * dim.y() * dim.z() * field.componentCount;
    if (!(count <= static_cast<double>(maxValues)))
        throw MalformedFile(fmt::format(
            "grid \"{}\" has {} x {} x {} voxels in its box, at most {} values are allowed", name,
            dim.x(), dim.y(), dim.z(), maxValues));
    field.lo = {box.min().x(), box.min().y(), box.min().z()};
    field.size = {dim.x(), dim.y(), dim.z()};
    if (isVector)
        copyValues(static_cast<const openvdb::Vec3SGrid&>(grid), box, field);
    else if (grid.isType<openvdb::DoubleGrid>())
        copyValues(static_cast<const openvdb::DoubleGrid&>(grid), box, field);
    else
        copyValues(static_cast<const openvdb::FloatGrid&>(grid), box, field);
    if (field.isLevelSet) addSurface(static_cast<const openvdb::FloatGrid&>(grid), field);
    return field;
}

}  // namespace brume::volumes
