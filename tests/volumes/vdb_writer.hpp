// SPDX-License-Identifier: Apache-2.0
// Writes volume files with the real libraries, and samples them with OpenVDB's own sampler. The
// only test file that includes OpenVDB.
#pragma once

#include <core/math.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace brume::volumes::test {

struct TestVoxel {
    ivec3 at;
    double value;
    bool active = true;
};

/// `level`: 1 = 8^3, 2 = 128^3, 3 = 4096^3 voxels.
struct TestTile {
    ivec3 at;
    int level;
    double value;
    bool active = true;
};

struct TestGrid {
    std::string name = "density";
    std::string type = "float";  ///< float, half, double, int32, bool, vec3s, vec3half; empty:
                                 ///< int64, mask, vec3d, points
    std::string gridClass = "fog volume";
    double background = 0;
    dmat4 worldFromIndex{1};
    bool frustum = false;
    std::vector<TestVoxel> voxels;
    std::vector<TestTile> tiles;
    std::string instanceOf;  ///< shares the tree of the grid of that name before it
};

enum class Packing { None, Mask, ZipMask, BloscMask, BloscOnly };

/// `offsets` false: as a stream, without the table that lets a reader skip grids.
void writeVdb(const std::filesystem::path& file, const std::vector<TestGrid>& grids,
              Packing packing = Packing::BloscMask, bool offsets = true);

enum class NanoPacking { None, Zip, Blosc };

/// `type`: float, fp8, fpN (how NanoVDB stores the floats of `grid`).
void writeNvdb(const std::filesystem::path& file, const TestGrid& grid, const std::string& type,
               NanoPacking packing);

/// OpenVDB's trilinear sampler on a float grid of a file.
class VdbSampler {
  public:
    VdbSampler(const std::filesystem::path& file, const std::string& name);
    ~VdbSampler();
    double sample(const dvec3& index) const;
    bool isActiveOrZero(const ivec3& at) const;  ///< else our rule for inactive voxels differs
    dvec3 world(const dvec3& index) const;
    ivec3 lo() const;
    ivec3 hi() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

}  // namespace brume::volumes::test
