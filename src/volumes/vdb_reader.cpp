// SPDX-License-Identifier: Apache-2.0
// .vdb files through OpenVDB. Nothing is read that the checker has not walked before.
#include <volumes/grid_reader.hpp>
#include <volumes/vdb_check.hpp>
#include <volumes/vdb_field.hpp>

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <map>

namespace brume::volumes {
namespace {

ivec3 toIvec(const openvdb::Coord& c) { return {c.x(), c.y(), c.z()}; }

template <typename T>
double measure(const T& value) {
    if constexpr (openvdb::VecTraits<T>::IsVec)
        return openvdb::Vec3d(value).length();
    else
        return static_cast<double>(value);
}

template <typename LeafT>
VoxelBlock copyLeaf(const LeafT& leaf) {
    VoxelBlock block;
    block.origin = toIvec(leaf.origin());
    block.values.fill(0);
    for (auto value = leaf.cbeginValueOn(); value; ++value)
        block.values[value.pos()] = narrow(static_cast<double>(*value));
    return block;
}

template <typename TreeT>
void copyTree(const TreeT& tree, SparseField& field) {
    field.background = static_cast<double>(tree.background());
    field.blocks.reserve(tree.leafCount());
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
        if (!leaf->isEmpty()) field.blocks.push_back(copyLeaf(*leaf));
    auto tile = tree.cbeginValueOn();
    tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        field.tiles.push_back(
            {toIvec(box.min()), box.dim().x(), narrow(static_cast<double>(tile.getValue()))});
    }
}

/// What needs no knowledge of the value type.
void describeTopology(const openvdb::GridBase& grid, GridInfo& info) {
    info.activeVoxels = grid.activeVoxelCount();
    info.leafCount = grid.constBaseTree().leafCount();
    info.activeTileCount = grid.constBaseTree().activeTileCount();
    openvdb::CoordBBox box;
    if (grid.constBaseTree().evalActiveVoxelBoundingBox(box)) {
        info.lo = toIvec(box.min());
        info.hi = toIvec(box.max());
    }
}

template <typename TreeT>
void describeValues(const TreeT& tree, GridInfo& info) {
    info.background = measure(tree.background());
    ValueRange range;
    for (auto value = tree.cbeginValueOn(); value; ++value) range.add(measure(*value));
    info.minValue = range.lo();
    info.maxValue = range.hi();
}

/// Calls `visit(grid)` with the grid's own type if it is one of those listed.
template <typename First, typename... Rest, typename Visit>
void visitGrid(const openvdb::GridBase& grid, const Visit& visit) {
    if (grid.isType<First>())
        visit(static_cast<const First&>(grid));
    else if constexpr (sizeof...(Rest) > 0)
        visitGrid<Rest...>(grid, visit);
}

class VdbReader final : public GridReader {
  public:
    explicit VdbReader(const std::filesystem::path& file) : mPath(file) {
        openvdb::initialize();  // only the first call does anything
        FileReader reader(file);
        mDirectory = VdbChecker(reader).checkDirectory();
        std::map<std::string, int> seen;
        for (const VdbEntry& entry : mDirectory.grids) {
            const bool half = entry.isHalf && entry.type == "float";
            mHeadings.push_back(
                {entry.name, seen[entry.name]++, half ? std::string("half") : entry.type});
        }
    }

    const std::vector<GridHeading>& headings() const override { return mHeadings; }

    LoadedGrid read(std::size_t ordinal) override {
        const VdbEntry& entry = mDirectory.grids.at(ordinal);
        LoadedGrid loaded;
        loaded.info.name = entry.name;
        loaded.info.index = mHeadings[ordinal].index;
        loaded.info.type = mHeadings[ordinal].type;
        if (!entry.isKnown) {
            loaded.info.refusal =
                "its values are of type " + entry.type + ", which is not a scalar";
            return loaded;
        }
        const openvdb::GridBase::Ptr grid = readGrid(entry);
        describe(*grid, loaded.info);
        if (loaded.info.refusal.empty())
            visitGrid<openvdb::FloatGrid, openvdb::DoubleGrid>(
                *grid, [&](const auto& typed) { copyTree(typed.tree(), loaded.field); });
        return loaded;
    }

    scene::FieldValues readField(std::size_t ordinal, std::uint64_t maxValues) override {
        const VdbEntry& entry = mDirectory.grids.at(ordinal);
        if (!entry.isKnown)
            throw MalformedFile("grid \"" + entry.name + "\" is of type " + entry.type +
                                ", float, half, double or vec3s are allowed");
        return copyField(*readGrid(entry), entry.name, maxValues);
    }

  private:
    openvdb::GridBase::Ptr readGrid(const VdbEntry& entry) const {
        FileReader reader(mPath);
        VdbChecker(reader).checkGrid(mDirectory, entry);
        openvdb::io::File file(mPath.string());
        file.open(/*delayLoad=*/false);
        return file.readGrid(openvdb::io::GridDescriptor::nameAsString(entry.uniqueName));
    }

    static void describe(const openvdb::GridBase& grid, GridInfo& info) {
        using namespace openvdb;
        describeTopology(grid, info);
        // Each type listed here costs seconds of compile time.
        visitGrid<FloatGrid, DoubleGrid, Vec3SGrid>(
            grid, [&](const auto& typed) { describeValues(typed.tree(), info); });
        info.gridClass = GridBase::gridClassToString(grid.getGridClass());
        if (grid.transform().mapType() == math::NonlinearFrustumMap::mapType()) {
            info.transform = "frustum";
            info.refusal = "its transform is a frustum, an affine one is needed";
        } else {
            info.worldFromIndex = toWorldFromIndex(grid.transform());
        }
        if (!grid.isType<FloatGrid>() && !grid.isType<DoubleGrid>())
            info.refusal =
                "its values are of type " + info.type + ", a density is float, half or double";
        else if (grid.getGridClass() == GRID_LEVEL_SET)
            info.refusal = "it is a level set, whose values are distances and no density";
    }

    std::filesystem::path mPath;
    VdbDirectory mDirectory;
    std::vector<GridHeading> mHeadings;
};

}  // namespace

std::unique_ptr<GridReader> openVdb(const std::filesystem::path& file) {
    return std::make_unique<VdbReader>(file);
}

}  // namespace brume::volumes
