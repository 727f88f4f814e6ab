// SPDX-License-Identifier: Apache-2.0
#include <volumes/vdb_check.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <set>

// The layout follows OpenVDB 10 (io/Archive.cc, io/Compression.h, tree/RootNode.h,
// tree/InternalNode.h, tree/LeafNode.h).
namespace brume::volumes {
namespace {

constexpr std::int64_t kMagic = 0x56444220;
constexpr std::uint32_t kOldestVersion = 222, kNewestVersion = 224;
constexpr std::uint32_t kUuidBytes = 36;
constexpr std::uint32_t kMaxName = 1 << 16;
constexpr char kSuffixMark = '\x1e';

constexpr std::uint32_t kZip = 1, kActiveMask = 2, kBlosc = 4;

constexpr unsigned kUpperValues = 32 * 32 * 32, kLowerValues = 16 * 16 * 16, kLeafValues = 512;
constexpr int kUpperExtent = 4096;  ///< voxels along an edge of a root child

template <unsigned N>
using Mask = std::array<std::uint64_t, N / 64>;

template <unsigned N>
unsigned countOn(const Mask<N>& mask) {
    unsigned count = 0;
    for (const std::uint64_t word : mask) count += static_cast<unsigned>(std::popcount(word));
    return count;
}

/// Child and active-value mask of an internal node; a slot cannot be both.
template <unsigned N>
struct NodeMasks {
    Mask<N> child, value;

    explicit NodeMasks(FileReader& file) {
        file.read(child.data(), sizeof(child));
        file.read(value.data(), sizeof(value));
        for (std::size_t i = 0; i < child.size(); ++i)
            if (child[i] & value[i])
                throw MalformedFile(fmt::format(
                    "the file is damaged: a node before byte {} is both a child and a value",
                    file.position()));
    }
};

/// Sizes of the metadata types of OpenVDB, which reads them without looking at the stored size.
const std::map<std::string, std::uint32_t>& metadataSizes() {
    static const std::map<std::string, std::uint32_t> kSizes = {
        {"bool", 1},   {"double", 8}, {"float", 4},  {"int32", 4},  {"int64", 8},  {"vec2i", 8},
        {"vec2s", 8},  {"vec2d", 16}, {"vec3i", 12}, {"vec3s", 12}, {"vec3d", 24}, {"vec4i", 16},
        {"vec4s", 16}, {"vec4d", 32}, {"mat4s", 64}, {"mat4d", 128}};
    return kSizes;
}

const std::map<std::string, std::uint32_t>& mapSizes() {
    static const std::map<std::string, std::uint32_t> kSizes = {
        {"AffineMap", 128},     {"ScaleMap", 120},          {"UniformScaleMap", 120},
        {"TranslationMap", 24}, {"ScaleTranslateMap", 144}, {"UniformScaleTranslateMap", 144},
        {"UnitaryMap", 128}};
    return kSizes;
}

enum class LeafKind { Values, Bool, Mask };

struct TypeSizes {
    std::uint32_t memory,
        half;  ///< bytes of a value in memory, and where reals are stored as halves
    LeafKind leaf;
};

const std::map<std::string, TypeSizes>& treeTypes() {
    static const std::map<std::string, TypeSizes> kTypes = {
        {"float", {4, 2, LeafKind::Values}},   {"double", {8, 2, LeafKind::Values}},
        {"int32", {4, 4, LeafKind::Values}},   {"int64", {8, 8, LeafKind::Values}},
        {"vec3s", {12, 6, LeafKind::Values}},  {"vec3d", {24, 6, LeafKind::Values}},
        {"vec3i", {12, 12, LeafKind::Values}}, {"bool", {1, 1, LeafKind::Bool}},
        {"mask", {1, 1, LeafKind::Mask}}};
    return kTypes;
}

/// "Tree_float_5_4_3" to "float"; other trees stay as they are.
std::string valueTypeOf(const std::string& tree) {
    const std::string prefix = "Tree_", suffix = "_5_4_3";
    if (tree.size() <= prefix.size() + suffix.size() || !tree.starts_with(prefix) ||
        !tree.ends_with(suffix))
        return tree;
    return tree.substr(prefix.size(), tree.size() - prefix.size() - suffix.size());
}

}  // namespace

/// One grid while its tree is walked.
struct VdbChecker::Walk {
    TypeSizes type;
    std::uint32_t stored;  ///< bytes of a value in a compressed array
    bool isHalf;
    std::uint32_t compression;
    std::vector<std::uint16_t> active;  ///< active values of each leaf, in file order
    struct Child {
        std::array<std::int32_t, 3> origin;
        std::size_t firstLeaf, leafCount;
    };
    std::vector<Child> children;
    std::uint64_t bytes = 0;  ///< memory that the tree will take

    void take(std::uint64_t more) {
        bytes += more;
        if (bytes > kMaxTreeBytes)
            throw MalformedFile(
                fmt::format("a grid needs more than {} MiB of memory", kMaxTreeBytes >> 20));
    }
};

VdbDirectory VdbChecker::checkDirectory() {
    VdbDirectory directory;
    directory.hasOffsets = checkHead();
    const auto count = mFile.read<std::int32_t>();
    if (count < 0) throw MalformedFile(fmt::format("the file is damaged: it has {} grids", count));
    std::set<std::string> names;
    for (std::int32_t i = 0; i < count; ++i) {
        std::uint64_t end = 0;
        VdbEntry entry = checkDescriptor(end);
        if (!names.insert(entry.uniqueName).second)
            throw MalformedFile("the file is damaged: two grids have one unique name");
        if (directory.hasOffsets) {
            if (entry.position < mFile.position() || end < entry.position)
                throw MalformedFile(fmt::format(
                    "the file is damaged: grid \"{}\" points to byte {}", entry.name, end));
            mFile.seek(end);
        } else {
            entry.position = mFile.position();
            requireKnown(entry);
            checkGridData(entry);
        }
        directory.grids.push_back(std::move(entry));
    }
    return directory;
}

bool VdbChecker::checkHead() {
    if (mFile.size() < sizeof(kMagic) || mFile.read<std::int64_t>() != kMagic)
        throw MalformedFile("not an OpenVDB file (wrong first bytes)");
    const auto version = mFile.read<std::uint32_t>();
    if (version < kOldestVersion || version > kNewestVersion)
        throw MalformedFile(fmt::format("the file has format version {}, {} to {} can be read",
                                        version, kOldestVersion, kNewestVersion));
    mFile.skip(2 * sizeof(std::uint32_t));  // version of the library that wrote it
    const bool hasOffsets = mFile.read<char>() != 0;
    mFile.skip(kUuidBytes);
    checkMetadata();
    return hasOffsets;
}

void VdbChecker::requireKnown(const VdbEntry& entry) {
    if (!entry.isKnown)
        throw MalformedFile(fmt::format("grid \"{}\" has values of type {}, which cannot be read",
                                        entry.name, entry.type));
}

VdbEntry VdbChecker::checkDescriptor(std::uint64_t& end) {
    VdbEntry entry;
    entry.uniqueName = mFile.readString(kMaxName);
    entry.name = entry.uniqueName.substr(0, entry.uniqueName.find(kSuffixMark));
    std::string tree = mFile.readString(kMaxName);
    const std::string half = "_HalfFloat";
    if (tree.ends_with(half)) {
        entry.isHalf = true;
        tree.resize(tree.size() - half.size());
    }
    entry.type = valueTypeOf(tree);
    entry.isKnown = treeTypes().count(entry.type) != 0;
    entry.parent = mFile.readString(kMaxName);
    entry.position = mFile.read<std::uint64_t>();
    mFile.skip(sizeof(std::uint64_t));  // of the voxel data; implied by the topology before it
    end = mFile.read<std::uint64_t>();
    return entry;
}

void VdbChecker::checkGrid(const VdbDirectory& directory, const VdbEntry& entry) {
    requireKnown(entry);
    mFile.seek(entry.position);
    checkGridData(entry);
    if (entry.parent.empty()) return;
    // An instance has the tree of another grid, which OpenVDB reads in its place.
    for (const VdbEntry& other : directory.grids) {
        if (other.uniqueName != entry.parent) continue;
        if (other.type != entry.type || !other.parent.empty())
            throw MalformedFile("the file is damaged: an instance of an unsuitable grid");
        mFile.seek(other.position);
        return checkGridData(other);
    }
    throw MalformedFile("the file is damaged: an instance of a missing grid");
}

void VdbChecker::checkMetadata() {
    const auto count = mFile.read<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        mFile.readString(kMaxName);
        const std::string type = mFile.readString(kMaxName);
        const auto bytes = mFile.read<std::uint32_t>();
        const auto known = metadataSizes().find(type);
        if (known != metadataSizes().end() && known->second != bytes)
            throw MalformedFile(
                fmt::format("the file is damaged: metadata of {} bytes before byte {}", bytes,
                            mFile.position()));
        const std::uint64_t end = mFile.position() + bytes;
        if (type == "__delayedload") checkDelayedLoad(bytes);
        mFile.seek(end);
    }
}

void VdbChecker::checkDelayedLoad(std::uint32_t bytes) {
    if (bytes == 0) return;
    const std::uint64_t end = mFile.position() + bytes;
    const auto leaves = mFile.read<std::uint32_t>();
    // Each leaf takes two masks of 64 bytes in the file, so more leaves than that are a lie.
    bool good = leaves <= mFile.size() / 128;
    constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();
    constexpr std::uint64_t kPaddedBytes = 128;  // short arrays are padded before compression
    for (const std::uint64_t size : {1, 8}) {    // a byte, then a compressed size, per leaf
        if (!good) break;
        const auto compressed = mFile.read<std::uint32_t>();
        if (size == 8 && compressed == kAbsent) break;
        good = mFile.position() + std::max<std::uint64_t>(compressed, 0) <= end;
        const std::uint64_t next = mFile.position() + (compressed > 0 ? compressed : leaves * size);
        if (good && compressed > 0)
            checkBloscHeader(compressed, leaves * size, std::max(leaves * size, kPaddedBytes));
        good = good && next <= end;
        if (good) mFile.seek(next);
    }
    if (!good) throw MalformedFile("the file is damaged: sizes of delayed loading disagree");
}

/// A Blosc chunk states its sizes, and its decoder believes them.
void VdbChecker::checkBloscHeader(std::uint64_t compressedBytes, std::uint64_t least,
                                  std::uint64_t most) {
    struct {
        std::uint8_t version, versionOfCodec, flags, typeSize;
        std::uint32_t bytes, blockBytes, compressedBytes;
    } header{};
    static_assert(sizeof(header) == 16);
    const bool complete = compressedBytes >= sizeof(header);
    if (complete) mFile.read(&header, sizeof(header));
    const bool sizesFit =
        header.bytes >= least && header.bytes <= most && header.compressedBytes == compressedBytes;
    const bool blocksFit = header.blockBytes > 0 && header.typeSize > 0 &&
                           header.blockBytes <= std::max<std::uint32_t>(1, header.bytes);
    if (!complete || !sizesFit || !blocksFit)
        throw MalformedFile(fmt::format("the file is damaged: a compressed chunk before byte {}",
                                        mFile.position()));
}

void VdbChecker::checkTransform(bool nested) {
    const std::string type = mFile.readString(kMaxName);
    const auto known = mapSizes().find(type);
    if (known != mapSizes().end()) return mFile.skip(known->second);
    if (type != "NonlinearFrustumMap" || nested)
        throw MalformedFile("the file is damaged or has a transform of unknown type");
    mFile.skip(8 * sizeof(double));  // box, taper, depth
    checkTransform(true);
}

void VdbChecker::checkGridData(const VdbEntry& entry) {
    Walk walk{treeTypes().at(entry.type), 0, entry.isHalf, 0, {}, {}};
    walk.stored = entry.isHalf ? walk.type.half : walk.type.memory;
    walk.compression = mFile.read<std::uint32_t>();
    checkMetadata();
    checkTransform(false);
    if (!entry.parent.empty()) return;
    checkTopology(walk);
    checkBuffers(walk);
}

void VdbChecker::checkTopology(Walk& walk) {
    if (mFile.read<std::int32_t>() != 1)
        throw MalformedFile("the file is damaged or has trees of several buffers");
    mFile.skip(walk.type.memory);  // background
    const auto tiles = mFile.read<std::uint32_t>(), children = mFile.read<std::uint32_t>();
    mFile.skip(static_cast<std::uint64_t>(tiles) * (13 + walk.type.memory));
    std::set<std::array<std::int32_t, 3>> origins;
    for (std::uint32_t i = 0; i < children; ++i) {
        const auto origin = mFile.read<std::array<std::int32_t, 3>>();
        const bool aligned = std::all_of(origin.begin(), origin.end(),
                                         [](std::int32_t x) { return x % kUpperExtent == 0; });
        if (!aligned || !origins.insert(origin).second)
            throw MalformedFile(fmt::format(
                "the file is damaged: a node before byte {} has a wrong origin", mFile.position()));
        const std::size_t first = walk.active.size();
        checkUpper(walk);
        walk.children.push_back({origin, first, walk.active.size() - first});
    }
}

void VdbChecker::checkUpper(Walk& walk) {
    const NodeMasks<kUpperValues> masks(mFile);
    walk.take(kUpperValues * std::max<std::uint64_t>(8, walk.type.memory) + sizeof(masks));
    checkValues(walk, kUpperValues, countOn<kUpperValues>(masks.value));
    for (unsigned i = countOn<kUpperValues>(masks.child); i > 0; --i) checkLower(walk);
}

void VdbChecker::checkLower(Walk& walk) {
    const NodeMasks<kLowerValues> masks(mFile);
    walk.take(kLowerValues * std::max<std::uint64_t>(8, walk.type.memory) + sizeof(masks));
    checkValues(walk, kLowerValues, countOn<kLowerValues>(masks.value));
    for (unsigned i = countOn<kLowerValues>(masks.child); i > 0; --i) {
        const auto mask = mFile.read<Mask<kLeafValues>>();
        walk.take(kLeafValues * walk.type.memory + 128);
        walk.active.push_back(static_cast<std::uint16_t>(countOn<kLeafValues>(mask)));
    }
}

void VdbChecker::checkBuffers(const Walk& walk) {
    // OpenVDB reads the leaves of its root's children in the order of their origins.
    auto children = walk.children;
    std::sort(children.begin(), children.end(),
              [](const Walk::Child& a, const Walk::Child& b) { return a.origin < b.origin; });
    for (const Walk::Child& child : children)
        for (std::size_t i = 0; i < child.leafCount; ++i)
            checkLeafBuffer(walk, walk.active[child.firstLeaf + i]);
}

void VdbChecker::checkLeafBuffer(const Walk& walk, unsigned activeValues) {
    constexpr std::uint64_t kMaskBytes = kLeafValues / 8, kOriginBytes = 12;
    mFile.skip(kMaskBytes);
    switch (walk.type.leaf) {
        case LeafKind::Values:
            return checkValues(walk, kLeafValues, activeValues);
        case LeafKind::Mask:
            return mFile.skip(kOriginBytes);
        case LeafKind::Bool: {
            // The stored origin replaces the node's own, which only this kind allows.
            const auto origin = mFile.read<std::array<std::int32_t, 3>>();
            for (const std::int32_t x : origin)
                if (x % 8 != 0) throw MalformedFile("the file is damaged: a wrong leaf origin");
            return mFile.skip(kMaskBytes);
        }
    }
}

/// An array of `count` values as io::readCompressedValues() reads it.
void VdbChecker::checkValues(const Walk& walk, unsigned count, unsigned activeValues) {
    const auto flag = mFile.read<std::int8_t>();
    if (flag < 0 || flag > 6)
        throw MalformedFile(
            fmt::format("the file is damaged: a wrong flag before byte {}", mFile.position()));
    if (flag == 2 || flag == 4 || flag == 5) mFile.skip(walk.type.memory);  // inactive value
    if (flag == 5) mFile.skip(walk.type.memory);                            // a second one
    if (flag == 3 || flag == 4 || flag == 5) mFile.skip(count / 8);         // which of them
    if ((walk.compression & kActiveMask) && flag != 6) count = activeValues;
    const std::uint64_t bytes = static_cast<std::uint64_t>(count) * walk.stored;
    // Nothing at all is stored for an empty array of halves.
    if (walk.isHalf && walk.type.half != walk.type.memory && count == 0) return;
    if (!(walk.compression & (kZip | kBlosc))) return mFile.skip(bytes);
    const auto stored = mFile.read<std::int64_t>();
    if (stored <= 0) {
        if (static_cast<std::uint64_t>(-(stored + 1)) + 1 != bytes)
            throw MalformedFile(fmt::format(
                "the file is damaged: a chunk of wrong size before byte {}", mFile.position()));
        return mFile.skip(bytes);
    }
    const std::uint64_t start = mFile.position();
    const auto compressed = static_cast<std::uint64_t>(stored);
    if (compressed > mFile.remaining()) mFile.skip(compressed);  // says what is missing
    if (walk.compression & kBlosc) checkBloscHeader(compressed, bytes, bytes);
    mFile.seek(start + compressed);
}

}  // namespace brume::volumes
