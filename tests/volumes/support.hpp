// SPDX-License-Identifier: Apache-2.0
// What the tests of volumes share.
#pragma once

#include <core/error.hpp>
#include <volumes/density_field.hpp>
#include <volumes/sparse_field.hpp>
#include <volumes/vdb_file.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

namespace brume::volumes::test {

/// A folder of its own that goes when the test does.
class TempFolder {
  public:
    TempFolder() {
        static int sCount = 0;
        mPath = std::filesystem::temp_directory_path() /
                ("brume_volumes_" + std::to_string(getpid()) + "_" + std::to_string(sCount++));
        std::filesystem::create_directories(mPath);
    }
    ~TempFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    std::filesystem::path operator/(const std::string& name) const { return mPath / name; }

  private:
    std::filesystem::path mPath;
};

/// A file of the shared data; skips the test by name where it is not there.
#define BRUME_SHARED_FILE(variable, name)                                                         \
    const std::filesystem::path variable = std::filesystem::path(BRUME_SHARED_DATA_DIR) / (name); \
    if (!std::filesystem::exists(variable)) GTEST_SKIP() << "no " << variable.string()

/// Adds a voxel to a field of blocks.
inline void setVoxel(SparseField& field, const ivec3& at, float value) {
    const ivec3 origin{at.x & ~7, at.y & ~7, at.z & ~7};
    const ivec3 local = at - origin;
    const int offset = (local.x * 8 + local.y) * 8 + local.z;
    for (VoxelBlock& block : field.blocks)
        if (block.origin == origin) {
            block.values[offset] = value;
            return;
        }
    VoxelBlock block;
    block.origin = origin;
    block.values.fill(0);
    block.values[offset] = value;
    field.blocks.push_back(block);
}

/// Random voxels in a box across the origin, about a third of them 0.
inline SparseField makeNoise(unsigned seed, int radius) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(-0.5f, 1.0f);
    SparseField field;
    for (int z = -radius; z <= radius; ++z)
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x)
                setVoxel(field, {x, y, z}, std::max(0.0f, value(random)));
    return field;
}

inline float voxelAt(const SparseField& field, const ivec3& at) {
    const ivec3 origin{at.x & ~7, at.y & ~7, at.z & ~7};
    const ivec3 local = at - origin;
    for (const VoxelBlock& block : field.blocks)
        if (block.origin == origin) return block.values[(local.x * 8 + local.y) * 8 + local.z];
    return 0;
}

/// The definition: hats of the eight voxels around a point.
inline double interpolate(const SparseField& field, const dvec3& p) {
    const dvec3 base = glm::floor(p);
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
        const ivec3 at = ivec3(base) + ivec3(c & 1, (c >> 1) & 1, c >> 2);
        const dvec3 hat = 1.0 - glm::abs(p - dvec3(at));
        sum += static_cast<double>(voxelAt(field, at)) * hat.x * hat.y * hat.z;
    }
    return sum;
}

class RandomRays {
  public:
    RandomRays(unsigned seed, const dvec3& lo, const dvec3& hi) : mRandom(seed), mLo(lo), mHi(hi) {}

    dvec3 point() {
        std::uniform_real_distribution<double> unit(0, 1);
        return mLo + (mHi - mLo) * dvec3(unit(mRandom), unit(mRandom), unit(mRandom));
    }

    /// From one random point to another, t in [0, 1].
    IndexRay next() {
        const dvec3 from = point();
        return {from, point() - from};
    }

  private:
    std::mt19937 mRandom;
    dvec3 mLo, mHi;
};

/// Message of the input error that `work` throws; empty if it throws none.
template <typename Work>
std::string inputErrorOf(const Work& work) {
    try {
        work();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::Input);
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        return e.what();
    }
    return "";
}

/// Remembers what is logged.
class LogCatcher {
  public:
    LogCatcher()
        : mLog([this](LogLevel level, const std::string& message) {
              if (level == LogLevel::Warning) warnings.push_back(message);
          }) {}
    const Log& log() const { return mLog; }

    std::vector<std::string> warnings;

  private:
    Log mLog;
};

inline scene::Volume volumeOf(const std::filesystem::path& file,
                              const std::string& density = "density") {
    scene::Volume volume;
    volume.file = file;
    volume.density = density;
    return volume;
}

}  // namespace brume::volumes::test
