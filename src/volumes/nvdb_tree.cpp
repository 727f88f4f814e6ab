// SPDX-License-Identifier: Apache-2.0
#include <volumes/nvdb_tree.hpp>

#include <limits>
#include <set>
#include <type_traits>

namespace brume::volumes {
namespace {

/// Walks the tree of one grid of floats of any precision.
template <typename BuildT>
class TreeWalk {
  public:
    TreeWalk(const NvdbBuffer& buffer, LoadedGrid& loaded) : mBuffer(buffer), mLoaded(loaded) {}

    void run() {
        constexpr std::uint64_t kTree = sizeof(nanovdb::GridData);
        const auto& tree = mBuffer.template at<nanovdb::TreeData<3>>(kTree);
        const std::uint64_t rootOffset =
            offset(kTree, static_cast<std::int64_t>(tree.mNodeOffset[3]));
        std::uint64_t tableBytes = 0;
        tableBytes = mBuffer.template at<Root>(rootOffset).mTableSize * sizeof(RootTile);
        const Root& root = mBuffer.template at<Root>(rootOffset, tableBytes);
        mLoaded.info.background = static_cast<double>(root.mBackground);
        mLoaded.field.background = mLoaded.info.background;
        std::set<std::uint64_t> keys;
        for (std::uint32_t i = 0; i < root.mTableSize; ++i) {
            const RootTile& tile = *root.tile(i);
            if (!keys.insert(tile.key).second) throwDamagedNvdb("two nodes have one origin");
            const ivec3 origin = toIvec(tile.origin());
            if (tile.child != 0)
                visitInner<Upper, 5>(offset(rootOffset, tile.child), origin);
            else if (tile.state)
                addTile(origin, 4096, static_cast<double>(tile.value));
        }
        finish();
    }

  private:
    using Root = typename nanovdb::NanoRoot<BuildT>::DataType;
    using RootTile = typename Root::Tile;
    using Upper = typename nanovdb::NanoUpper<BuildT>::DataType;
    using Lower = typename nanovdb::NanoLower<BuildT>::DataType;
    using Leaf = typename nanovdb::NanoLeaf<BuildT>::DataType;

    static ivec3 toIvec(const nanovdb::Coord& c) { return {c[0], c[1], c[2]}; }

    static std::uint64_t offset(std::uint64_t base, std::int64_t relative) {
        return base + static_cast<std::uint64_t>(relative);  // out of range is found by at()
    }

    template <typename Node, int kLog2Edge>
    void visitInner(std::uint64_t at, const ivec3& origin) {
        const Node& node = mBuffer.template at<Node>(at);
        // Nodes are stored once: a damaged table that refers to one many times would never end.
        mNodeBytes += sizeof(Node);
        checkTotal();
        constexpr int kEdge = 1 << kLog2Edge, kChildEdge = kLog2Edge == 5 ? 128 : 8;
        for (std::uint32_t i = 0; i < kEdge * kEdge * kEdge; ++i) {
            const bool child = node.mChildMask.isOn(i);
            if (!child && !node.mValueMask.isOn(i)) continue;
            const int n = static_cast<int>(i);
            const ivec3 at3 =
                origin + kChildEdge * ivec3(n >> (2 * kLog2Edge), (n >> kLog2Edge) & (kEdge - 1),
                                            n & (kEdge - 1));
            if (!child)
                addTile(at3, kChildEdge, static_cast<double>(node.mTable[i].value));
            else if constexpr (kLog2Edge == 5)
                visitInner<Lower, 4>(offset(at, node.mTable[i].child), at3);
            else
                visitLeaf(offset(at, node.mTable[i].child), at3);
        }
    }

    void visitLeaf(std::uint64_t at, const ivec3& origin) {
        const Leaf* leaf = &mBuffer.template at<Leaf>(at);
        if constexpr (std::is_same_v<BuildT, nanovdb::FpN>)
            leaf = &mBuffer.template at<Leaf>(at, leaf->bitWidth() * 64u);
        mNodeBytes += sizeof(Leaf);
        checkTotal();
        ++mLoaded.info.leafCount;
        VoxelBlock block;
        block.origin = origin;
        block.values.fill(0);
        ivec3 lo(8), hi(-1);
        for (std::uint32_t i = 0; i < block.values.size(); ++i) {
            if (!leaf->mValueMask.isOn(i)) continue;
            const double value = static_cast<double>(leaf->getValue(i));
            block.values[i] = narrow(value);
            mRange.add(value);
            const int n = static_cast<int>(i);
            const ivec3 p{n >> 6, (n >> 3) & 7, n & 7};
            lo = glm::min(lo, p);
            hi = glm::max(hi, p);
            ++mLoaded.info.activeVoxels;
        }
        if (hi.x < 0) return;
        extend(origin + lo, origin + hi);
        mLoaded.field.blocks.push_back(block);
    }

    void addTile(const ivec3& lo, int edge, double value) {
        const auto voxels = static_cast<std::uint64_t>(edge);
        mLoaded.info.activeVoxels += voxels * voxels * voxels;
        ++mLoaded.info.activeTileCount;
        mRange.add(value);
        extend(lo, lo + (edge - 1));
        mLoaded.field.tiles.push_back({lo, edge, narrow(value)});
    }

    void extend(const ivec3& lo, const ivec3& hi) {
        mLo = glm::min(mLo, lo);
        mHi = glm::max(mHi, hi);
    }

    void checkTotal() const {
        if (mNodeBytes > mBuffer.size()) throwDamagedNvdb("more nodes than fit into the grid");
    }

    void finish() {
        mLoaded.info.minValue = mRange.lo();
        mLoaded.info.maxValue = mRange.hi();
        if (mLoaded.info.activeVoxels == 0) return;
        mLoaded.info.lo = mLo;
        mLoaded.info.hi = mHi;
    }

    const NvdbBuffer& mBuffer;
    LoadedGrid& mLoaded;
    std::uint64_t mNodeBytes = 0;
    ValueRange mRange;
    ivec3 mLo{std::numeric_limits<int>::max()}, mHi{std::numeric_limits<int>::min()};
};

}  // namespace

bool readNvdbTree(nanovdb::GridType type, const NvdbBuffer& buffer, LoadedGrid& loaded) {
    using nanovdb::GridType;
    switch (type) {
        case GridType::Float:
            TreeWalk<float>(buffer, loaded).run();
            return true;
        case GridType::Double:
            TreeWalk<double>(buffer, loaded).run();
            return true;
        case GridType::Fp4:
            TreeWalk<nanovdb::Fp4>(buffer, loaded).run();
            return true;
        case GridType::Fp8:
            TreeWalk<nanovdb::Fp8>(buffer, loaded).run();
            return true;
        case GridType::Fp16:
            TreeWalk<nanovdb::Fp16>(buffer, loaded).run();
            return true;
        case GridType::FpN:
            TreeWalk<nanovdb::FpN>(buffer, loaded).run();
            return true;
        default:
            return false;
    }
}

}  // namespace brume::volumes
