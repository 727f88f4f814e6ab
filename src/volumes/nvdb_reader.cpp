// SPDX-License-Identifier: Apache-2.0
// .nvdb files: segments, headers and compression.
#include <volumes/file_reader.hpp>
#include <volumes/grid_reader.hpp>
#include <volumes/nvdb_tree.hpp>

#include <blosc.h>
#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <zlib.h>

#include <algorithm>
#include <map>

namespace brume::volumes {
namespace {

constexpr std::uint64_t kMaxGridBytes = 4ull << 30;
constexpr std::uint32_t kMaxName = 1 << 16;
constexpr std::uint64_t kBloscChunk = 1ull << 30;
/// No codec makes data smaller than this; what claims more is damaged.
constexpr std::uint64_t kGreatestRatio = 1100;

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

void unzip(FileReader& file, NvdbBuffer& buffer) {
    const auto bytes = file.read<std::uint64_t>();
    if (bytes > file.remaining() || buffer.size() / kGreatestRatio > bytes)
        throwDamagedNvdb("the size of compressed data");
    std::vector<char> compressed(bytes);
    file.read(compressed.data(), bytes);
    uLongf count = buffer.size();
    const int status = uncompress(reinterpret_cast<Bytef*>(buffer.data()), &count,
                                  reinterpret_cast<const Bytef*>(compressed.data()), bytes);
    if (status != Z_OK || count != buffer.size()) throwDamagedNvdb("compressed data");
}

void unblosc(FileReader& file, NvdbBuffer& buffer) {
    for (std::uint64_t done = 0; done < buffer.size();) {
        const std::uint64_t chunk = std::min(buffer.size() - done, kBloscChunk);
        const auto bytes = file.read<std::uint64_t>();
        if (bytes > file.remaining() || chunk / kGreatestRatio > bytes)
            throwDamagedNvdb("the size of compressed data");
        std::vector<char> compressed(bytes);
        file.read(compressed.data(), bytes);
        std::size_t count = 0;
        if (blosc_cbuffer_validate(compressed.data(), bytes, &count) < 0 || count != chunk ||
            blosc_decompress_ctx(compressed.data(), buffer.data() + done, chunk, 1) !=
                static_cast<int>(chunk))
            throwDamagedNvdb("compressed data");
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
        const NvdbBuffer buffer = readBuffer(entry);
        const auto& data = buffer.at<nanovdb::GridData>(0);
        if (data.mMagic != NANOVDB_MAGIC_NUMBER || data.mGridType != entry.head.type)
            throwDamagedNvdb("the grid's own header disagrees with the file's");
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
        if (head.codec > Codec::Blosc) throwDamagedNvdb("an unknown compression");
        const std::size_t first = mEntries.size();
        for (int i = 0; i < head.gridCount; ++i) {
            Entry entry;
            entry.head = mFile.read<GridHead>();
            if (entry.head.nameSize > kMaxName) throwDamagedNvdb("a name is too long");
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

    NvdbBuffer readBuffer(const Entry& entry) {
        const std::uint64_t bytes = entry.head.gridSize;
        if (bytes > kMaxGridBytes)
            throw MalformedFile(fmt::format("grid \"{}\" has {} MiB, at most {} MiB can be read",
                                            entry.name, bytes >> 20, kMaxGridBytes >> 20));
        const std::uint64_t compressed = mFile.size() - entry.position;
        if (bytes < sizeof(nanovdb::GridData) || bytes / kGreatestRatio > compressed)
            throwDamagedNvdb("the size of a grid");
        mFile.seek(entry.position);
        NvdbBuffer buffer(bytes);
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

    static void readTree(const Entry& entry, const NvdbBuffer& buffer, LoadedGrid& loaded) {
        if (readNvdbTree(entry.head.type, buffer, loaded)) return;
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
