// SPDX-License-Identifier: Apache-2.0
// .nvdb files. Every offset of the tree is checked before it is followed, because NanoVDB itself
// follows them blindly; so the nodes are read here and not through its accessors.
#include <volumes/file_reader.hpp>
#include <volumes/grid_reader.hpp>

#include <blosc.h>
#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <zlib.h>

#include <algorithm>
#include <map>
#include <set>

namespace brume::volumes {
namespace {

constexpr std::uint64_t kMaxGridBytes = 4ull << 30;
constexpr std::uint32_t kMaxName = 1 << 16;
constexpr std::uint64_t kBloscChunk = 1ull << 30;
/// No codec makes data smaller than this; what claims more is damaged.
constexpr std::uint64_t kGreatestRatio = 1100;
constexpr std::uint64_t kAlignment = 32;

enum class Codec : std::uint16_t { None = 0, Zip = 1, Blosc = 2 };

/// Head of a segment and of a grid in it, as in nanovdb/util/IO.h (version 32).
struct SegmentHead {
    std::uint64_t magic;
    std::uint32_t version;
    std::uint16_t gridCount;
    Codec codec;
};
static_assert(sizeof(SegmentHead) == 16);

struct GridHead {
    std::uint64_t gridSize, fileSize, nameKey, voxelCount;
    nanovdb::GridType type;
    nanovdb::GridClass gridClass;
    double worldBox[6];
    std::int32_t indexBox[6];
    double voxelSize[3];
    std::uint32_t nameSize, nodeCount[4], tileCount[3];
    Codec codec;
    std::uint16_t padding;
    std::uint32_t version;
};
static_assert(sizeof(GridHead) == 176);

struct Entry {
    GridHead head{};
    std::string name;
    Codec codec = Codec::None;
    std::uint64_t position = 0;
};

[[noreturn]] void throwDamaged(const std::string& what) {
    throw MalformedFile("the file is damaged: " + what);
}

/// Owns a grid's bytes, aligned as its nodes expect, and hands out parts of it by checked offset.
class GridBuffer {
  public:
    explicit GridBuffer(std::uint64_t bytes)
        : mBytes(bytes),
          mData(static_cast<char*>(
              std::aligned_alloc(kAlignment, (bytes + kAlignment - 1) / kAlignment * kAlignment))) {
        if (!mData) throw std::bad_alloc();
    }

    char* data() { return mData.get(); }
    std::uint64_t size() const { return mBytes; }

    /// The T at a byte offset, with `extra` bytes behind it.
    template <typename T>
    const T& at(std::uint64_t offset, std::uint64_t extra = 0) const {
        if (offset % kAlignment != 0 || sizeof(T) > mBytes || extra > mBytes - sizeof(T) ||
            offset > mBytes - sizeof(T) - extra)
            throwDamaged(fmt::format("a node at offset {} of {}", offset, mBytes));
        return *reinterpret_cast<const T*>(mData.get() + offset);
    }

  private:
    struct Free {
        void operator()(char* p) const { std::free(p); }
    };
    std::uint64_t mBytes;
    std::unique_ptr<char, Free> mData;
};

std::string typeName(nanovdb::GridType type) {
    using nanovdb::GridType;
    switch (type) {
        case GridType::Fp4:
            return "fp4";
        case GridType::Fp8:
            return "fp8";
        case GridType::Fp16:
            return "fp16";
        case GridType::FpN:
            return "fpN";
        case GridType::Vec3f:
            return "vec3s";
        case GridType::Vec3d:
            return "vec3d";
        case GridType::Mask:
            return "mask";
        case GridType::Half:
            return "half";
        default:
            break;
    }
    return type < GridType::End ? nanovdb::toStr(type) : "unknown";
}

std::string className(nanovdb::GridClass gridClass) {
    using nanovdb::GridClass;
    switch (gridClass) {
        case GridClass::LevelSet:
            return "level set";
        case GridClass::FogVolume:
            return "fog volume";
        case GridClass::Staggered:
            return "staggered";
        default:
            return "unknown";
    }
}

void unzip(FileReader& file, GridBuffer& buffer) {
    const auto bytes = file.read<std::uint64_t>();
    if (bytes > file.remaining() || buffer.size() / kGreatestRatio > bytes)
        throwDamaged("the size of compressed data");
    std::vector<char> compressed(bytes);
    file.read(compressed.data(), bytes);
    uLongf count = buffer.size();
    const int status = uncompress(reinterpret_cast<Bytef*>(buffer.data()), &count,
                                  reinterpret_cast<const Bytef*>(compressed.data()), bytes);
    if (status != Z_OK || count != buffer.size()) throwDamaged("compressed data");
}

void unblosc(FileReader& file, GridBuffer& buffer) {
    for (std::uint64_t done = 0; done < buffer.size();) {
        const std::uint64_t chunk = std::min(buffer.size() - done, kBloscChunk);
        const auto bytes = file.read<std::uint64_t>();
        if (bytes > file.remaining() || chunk / kGreatestRatio > bytes)
            throwDamaged("the size of compressed data");
        std::vector<char> compressed(bytes);
        file.read(compressed.data(), bytes);
        std::size_t count = 0;
        if (blosc_cbuffer_validate(compressed.data(), bytes, &count) < 0 || count != chunk ||
            blosc_decompress_ctx(compressed.data(), buffer.data() + done, chunk, 1) !=
                static_cast<int>(chunk))
            throwDamaged("compressed data");
        done += chunk;
    }
}

void skipData(FileReader& file, const Entry& entry) {
    if (entry.codec == Codec::None) return file.skip(entry.head.gridSize);
    std::uint64_t chunks = 1;
    if (entry.codec == Codec::Blosc)
        chunks = std::max<std::uint64_t>(1, (entry.head.gridSize + kBloscChunk - 1) / kBloscChunk);
    for (; chunks > 0; --chunks) file.skip(file.read<std::uint64_t>());
}

/// Walks the tree of one grid of floats of any precision.
template <typename BuildT>
class TreeWalk {
  public:
    TreeWalk(const GridBuffer& buffer, LoadedGrid& loaded) : mBuffer(buffer), mLoaded(loaded) {}

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
            if (!keys.insert(tile.key).second) throwDamaged("two nodes have one origin");
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
        if (mNodeBytes > mBuffer.size()) throwDamaged("more nodes than fit into the grid");
    }

    void finish() {
        mLoaded.info.minValue = mRange.lo();
        mLoaded.info.maxValue = mRange.hi();
        if (mLoaded.info.activeVoxels == 0) return;
        mLoaded.info.lo = mLo;
        mLoaded.info.hi = mHi;
    }

    const GridBuffer& mBuffer;
    LoadedGrid& mLoaded;
    std::uint64_t mNodeBytes = 0;
    ValueRange mRange;
    ivec3 mLo{std::numeric_limits<int>::max()}, mHi{std::numeric_limits<int>::min()};
};

class NvdbReader final : public GridReader {
  public:
    explicit NvdbReader(const std::filesystem::path& path) : mFile(path) {
        while (mFile.remaining() > 0) readSegment();
        std::map<std::string, int> seen;
        for (const Entry& entry : mEntries)
            mHeadings.push_back({entry.name, seen[entry.name]++, typeName(entry.head.type)});
    }

    const std::vector<GridHeading>& headings() const override { return mHeadings; }

    scene::FieldValues readField(std::size_t ordinal, std::uint64_t) override {
        throw MalformedFile("grid \"" + mHeadings.at(ordinal).name +
                            "\" lies in a NanoVDB file, fields are read from .vdb files");
    }

    LoadedGrid read(std::size_t ordinal) override {
        const Entry& entry = mEntries.at(ordinal);
        LoadedGrid loaded;
        loaded.info.name = entry.name;
        loaded.info.index = mHeadings[ordinal].index;
        loaded.info.type = mHeadings[ordinal].type;
        loaded.info.gridClass = className(entry.head.gridClass);
        const GridBuffer buffer = readBuffer(entry);
        const auto& data = buffer.at<nanovdb::GridData>(0);
        if (data.mMagic != NANOVDB_MAGIC_NUMBER || data.mGridType != entry.head.type)
            throwDamaged("the grid's own header disagrees with the file's");
        readTransform(data.mMap, loaded.info);
        if (entry.head.gridClass == nanovdb::GridClass::LevelSet)
            loaded.info.refusal = "it is a level set, whose values are distances and no density";
        readTree(entry, buffer, loaded);
        if (!loaded.info.refusal.empty()) loaded.field = {};
        return loaded;
    }

  private:
    void readSegment() {
        const auto head = mFile.read<SegmentHead>();
        if (head.magic != NANOVDB_MAGIC_NUMBER)
            throw MalformedFile("not a NanoVDB file (wrong bytes at the start of a segment)");
        const std::uint32_t major = head.version >> 21;
        if (major != NANOVDB_MAJOR_VERSION_NUMBER)
            throw MalformedFile(fmt::format("the file has NanoVDB version {}, only {} can be read",
                                            major, NANOVDB_MAJOR_VERSION_NUMBER));
        if (head.codec > Codec::Blosc) throwDamaged("an unknown compression");
        const std::size_t first = mEntries.size();
        for (int i = 0; i < head.gridCount; ++i) {
            Entry entry;
            entry.head = mFile.read<GridHead>();
            if (entry.head.nameSize > kMaxName) throwDamaged("a name is too long");
            entry.name.resize(entry.head.nameSize);
            mFile.read(entry.name.data(), entry.name.size());
            entry.name.resize(std::min(entry.name.find('\0'), entry.name.size()));
            entry.codec = head.codec;
            mEntries.push_back(entry);
        }
        for (std::size_t i = first; i < mEntries.size(); ++i) {
            mEntries[i].position = mFile.position();
            skipData(mFile, mEntries[i]);
        }
    }

    GridBuffer readBuffer(const Entry& entry) {
        const std::uint64_t bytes = entry.head.gridSize;
        if (bytes > kMaxGridBytes)
            throw MalformedFile(fmt::format("grid \"{}\" has {} MiB, at most {} MiB can be read",
                                            entry.name, bytes >> 20, kMaxGridBytes >> 20));
        const std::uint64_t compressed = mFile.size() - entry.position;
        if (bytes < sizeof(nanovdb::GridData) || bytes / kGreatestRatio > compressed)
            throwDamaged("the size of a grid");
        mFile.seek(entry.position);
        GridBuffer buffer(bytes);
        switch (entry.codec) {
            case Codec::None:
                mFile.read(buffer.data(), bytes);
                break;
            case Codec::Zip:
                unzip(mFile, buffer);
                break;
            case Codec::Blosc:
                unblosc(mFile, buffer);
                break;
        }
        return buffer;
    }

    /// NanoVDB multiplies column vectors: world = matrix (by rows) * index + vector.
    static void readTransform(const nanovdb::Map& map, GridInfo& info) {
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                info.worldFromIndex[column][row] = map.mMatD[3 * row + column];
            info.worldFromIndex[3][row] = map.mVecD[row];
        }
    }

    static void readTree(const Entry& entry, const GridBuffer& buffer, LoadedGrid& loaded) {
        using nanovdb::GridType;
        switch (entry.head.type) {
            case GridType::Float:
                return TreeWalk<float>(buffer, loaded).run();
            case GridType::Double:
                return TreeWalk<double>(buffer, loaded).run();
            case GridType::Fp4:
                return TreeWalk<nanovdb::Fp4>(buffer, loaded).run();
            case GridType::Fp8:
                return TreeWalk<nanovdb::Fp8>(buffer, loaded).run();
            case GridType::Fp16:
                return TreeWalk<nanovdb::Fp16>(buffer, loaded).run();
            case GridType::FpN:
                return TreeWalk<nanovdb::FpN>(buffer, loaded).run();
            default:
                break;
        }
        loaded.info.activeVoxels = entry.head.voxelCount;
        loaded.info.leafCount = entry.head.nodeCount[0];
        for (int axis = 0; axis < 3; ++axis) {
            loaded.info.lo[axis] = entry.head.indexBox[axis];
            loaded.info.hi[axis] = entry.head.indexBox[3 + axis];
        }
        loaded.info.refusal = "its values are of type " + loaded.info.type +
                              ", a density is float, double or quantised float";
    }

    FileReader mFile;
    std::vector<Entry> mEntries;
    std::vector<GridHeading> mHeadings;
};

}  // namespace

std::unique_ptr<GridReader> openNvdb(const std::filesystem::path& file) {
    return std::make_unique<NvdbReader>(file);
}

}  // namespace brume::volumes
