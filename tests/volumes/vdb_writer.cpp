// SPDX-License-Identifier: Apache-2.0
#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC

#include <volumes/vdb_writer.hpp>

#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include <fstream>

namespace brume::volumes::test {
namespace {

openvdb::Coord toCoord(const ivec3& c) { return {c.x, c.y, c.z}; }

template <typename T>
T makeValue(double value) {
    if constexpr (openvdb::VecTraits<T>::IsVec)
        return T(static_cast<typename openvdb::VecTraits<T>::ElementType>(value));
    else
        return static_cast<T>(value);
}

template <typename GridT>
openvdb::GridBase::Ptr makeTyped(const TestGrid& description) {
    using Value = typename GridT::ValueType;
    auto grid = GridT::create(makeValue<Value>(description.background));
    auto& tree = grid->tree();
    for (const TestTile& tile : description.tiles)
        tree.addTile(tile.level, toCoord(tile.at), makeValue<Value>(tile.value), tile.active);
    for (const TestVoxel& voxel : description.voxels) {
        if (voxel.active)
            tree.setValueOn(toCoord(voxel.at), makeValue<Value>(voxel.value));
        else
            tree.setValueOff(toCoord(voxel.at), makeValue<Value>(voxel.value));
    }
    return grid;
}

/// An empty grid of a type that this file need not instantiate.
openvdb::GridBase::Ptr makeEmpty(const std::string& valueType) {
    return openvdb::GridBase::createGrid("Tree_" + valueType + "_5_4_3");
}

openvdb::math::Transform::Ptr makeTransform(const TestGrid& description) {
    using openvdb::math::Transform;
    if (description.frustum)
        return Transform::createFrustumTransform(
            openvdb::BBoxd(openvdb::Vec3d(-10), openvdb::Vec3d(10)), 0.5, 20, 1);
    openvdb::Mat4d m;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) m(i, j) = description.worldFromIndex[i][j];
    return Transform::createLinearTransform(m);
}

openvdb::GridBase::Ptr makeUnnamed(const TestGrid& description) {
    using namespace openvdb;
    const std::string& type = description.type;
    if (type == "double") return makeTyped<DoubleGrid>(description);
    if (type == "int32") return makeTyped<Int32Grid>(description);
    if (type == "bool") return makeTyped<BoolGrid>(description);
    if (type == "vec3s" || type == "vec3half") return makeTyped<Vec3SGrid>(description);
    if (type == "points") return makeEmpty("ptdataidx32");
    if (type == "int64" || type == "mask" || type == "vec3d") return makeEmpty(type);
    return makeTyped<FloatGrid>(description);
}

openvdb::GridBase::Ptr makeGrid(const TestGrid& description) {
    openvdb::initialize();
    const openvdb::GridBase::Ptr grid = makeUnnamed(description);
    grid->setName(description.name);
    grid->setGridClass(openvdb::GridBase::stringToGridClass(description.gridClass));
    grid->setSaveFloatAsHalf(description.type == "half" || description.type == "vec3half");
    grid->setTransform(makeTransform(description));
    return grid;
}

std::uint32_t flagsOf(Packing packing) {
    switch (packing) {
        case Packing::None:
            return openvdb::io::COMPRESS_NONE;
        case Packing::Mask:
            return openvdb::io::COMPRESS_ACTIVE_MASK;
        case Packing::ZipMask:
            return openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK;
        case Packing::BloscOnly:
            return openvdb::io::COMPRESS_BLOSC;
        default:
            return openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK;
    }
}

template <typename NanoT>
nanovdb::GridHandle<> quantise(const openvdb::FloatGrid& grid) {
    nanovdb::OpenToNanoVDB<float, NanoT> converter;
    return converter(grid);
}

}  // namespace

void writeVdb(const std::filesystem::path& file, const std::vector<TestGrid>& grids,
              Packing packing, bool offsets) {
    openvdb::GridPtrVec list;
    for (const TestGrid& description : grids) {
        list.push_back(makeGrid(description));
        for (const auto& other : list)
            if (!description.instanceOf.empty() && other->getName() == description.instanceOf)
                list.back()->setTree(other->baseTreePtr());
    }
    if (offsets) {
        openvdb::io::File out(file.string());
        out.setCompression(flagsOf(packing));
        out.write(list);
    } else {
        std::ofstream stream(file, std::ios::binary);
        openvdb::io::Stream out(stream);
        out.setCompression(flagsOf(packing));
        out.write(list);
    }
}

void writeNvdb(const std::filesystem::path& file, const TestGrid& grid, const std::string& type,
               NanoPacking packing) {
    const openvdb::GridBase::Ptr source = makeGrid(grid);
    const auto& floats = static_cast<const openvdb::FloatGrid&>(*source);
    const auto handle = type == "fp8"   ? quantise<nanovdb::Fp8>(floats)
                        : type == "fpN" ? quantise<nanovdb::FpN>(floats)
                                        : quantise<float>(floats);
    const nanovdb::io::Codec codec = packing == NanoPacking::Zip     ? nanovdb::io::Codec::ZIP
                                     : packing == NanoPacking::Blosc ? nanovdb::io::Codec::BLOSC
                                                                     : nanovdb::io::Codec::NONE;
    nanovdb::io::writeGrid(file.string(), handle, codec);
}

struct VdbSampler::Impl {
    openvdb::FloatGrid::Ptr grid;
    openvdb::CoordBBox box;
};

VdbSampler::VdbSampler(const std::filesystem::path& file, const std::string& name)
    : mImpl(std::make_unique<Impl>()) {
    openvdb::initialize();
    openvdb::io::File in(file.string());
    in.open(false);
    mImpl->grid = openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid(name));
    mImpl->box = mImpl->grid->evalActiveVoxelBoundingBox();
}

VdbSampler::~VdbSampler() = default;

double VdbSampler::sample(const dvec3& p) const {
    // In double, because the sampler otherwise rounds its weights to float.
    const auto accessor = mImpl->grid->getConstAccessor();
    const openvdb::Vec3d position(p.x, p.y, p.z);
    return static_cast<double>(openvdb::tools::BoxSampler::sample(accessor, position));
}

bool VdbSampler::isActiveOrZero(const ivec3& at) const {
    const auto& tree = mImpl->grid->tree();
    return tree.isValueOn(toCoord(at)) || tree.getValue(toCoord(at)) == 0;
}

dvec3 VdbSampler::world(const dvec3& index) const {
    const openvdb::Vec3d w = mImpl->grid->indexToWorld(openvdb::Vec3d(index.x, index.y, index.z));
    return {w.x(), w.y(), w.z()};
}

ivec3 VdbSampler::lo() const {
    return {mImpl->box.min().x(), mImpl->box.min().y(), mImpl->box.min().z()};
}

ivec3 VdbSampler::hi() const {
    return {mImpl->box.max().x(), mImpl->box.max().y(), mImpl->box.max().z()};
}

}  // namespace brume::volumes::test
