// SPDX-License-Identifier: Apache-2.0
// A walk over the structure of a .vdb file before OpenVDB sees it. OpenVDB trusts the counts and
// sizes that it reads: a damaged file can make it allocate without limit, loop for hours, or write
// past a buffer. What passes here cannot.
#pragma once

#include <volumes/file_reader.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace brume::volumes {

/// What the file says about one grid before its data.
struct VdbEntry {
    std::string uniqueName;  ///< as stored: the name, or name + '\x1e' + number
    std::string name;        ///< without the number
    std::string type;  ///< "float", "vec3s", ...: the value type of a 5-4-3 tree; others: the tree
                       ///< type as stored
    bool isHalf = false;         ///< floating-point values are stored in 16 bits
    bool isKnown = false;        ///< a type that checkTree() understands; others must not be read
    std::string parent;          ///< unique name of the grid whose tree this one shares, or empty
    std::uint64_t position = 0;  ///< of its data
};

struct VdbDirectory {
    bool hasOffsets = true;  ///< false: OpenVDB reads all grids when it opens the file
    std::vector<VdbEntry> grids;
};

/// Memory that OpenVDB may take for one grid's tree.
inline constexpr std::uint64_t kMaxTreeBytes = 4ull << 30;

class VdbChecker {
  public:
    explicit VdbChecker(FileReader& file) : mFile(file) {}

    /// Checks everything that opening the file reads. Throws MalformedFile.
    VdbDirectory checkDirectory();

    /// Checks all that reading this grid reads. Throws MalformedFile.
    void checkGrid(const VdbDirectory& directory, const VdbEntry& entry);

  private:
    struct ValueType;
    struct Walk;

    bool checkHead();
    static void requireKnown(const VdbEntry& entry);
    VdbEntry checkDescriptor(std::uint64_t& end);
    void checkMetadata();
    void checkDelayedLoad(std::uint32_t bytes);
    void checkBloscHeader(std::uint64_t compressedBytes, std::uint64_t least, std::uint64_t most);
    void checkTransform(bool nested);
    void checkGridData(const VdbEntry& entry);
    void checkTopology(Walk& walk);
    void checkUpper(Walk& walk);
    void checkLower(Walk& walk);
    void checkBuffers(const Walk& walk);
    void checkLeafBuffer(const Walk& walk, unsigned activeValues);
    void checkValues(const Walk& walk, unsigned count, unsigned activeValues);

    FileReader& mFile;
};

}  // namespace brume::volumes
