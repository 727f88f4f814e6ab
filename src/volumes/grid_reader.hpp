// SPDX-License-Identifier: Apache-2.0
// What the file formats have in common: a list of grids, of which one is read at a time.
#pragma once

#include <scene/effect.hpp>
#include <volumes/sparse_field.hpp>
#include <volumes/vdb_file.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace brume::volumes {

struct GridHeading {
    std::string name;
    int index = 0;  ///< among the grids of this name
    std::string type;
};

/// `info.sanitised` is left for later; `field` is empty where `info.refusal` is not.
struct LoadedGrid {
    GridInfo info;
    SparseField field;
};

class GridReader {
  public:
    virtual ~GridReader() = default;

    /// In file order.
    virtual const std::vector<GridHeading>& headings() const = 0;

    /// Reads one grid. Throws MalformedFile or another standard exception.
    virtual LoadedGrid read(std::size_t ordinal) = 0;

    /// Reads one grid of scalars or vectors as dense values; of a level set also its surface. Throws
    /// MalformedFile, also for other types and for more than `maxValues` values.
    virtual scene::FieldValues readField(std::size_t ordinal, std::uint64_t maxValues) = 0;
};

/// Both throw MalformedFile if the file is damaged or of another format.
std::unique_ptr<GridReader> openVdb(const std::filesystem::path& file);
std::unique_ptr<GridReader> openNvdb(const std::filesystem::path& file);

/// Keeps the least and the greatest finite value.
class ValueRange {
  public:
    void add(double value) {
        if (!std::isfinite(value)) return;
        mLo = std::min(mLo, value);
        mHi = std::max(mHi, value);
    }
    double lo() const { return mLo <= mHi ? mLo : 0; }
    double hi() const { return mLo <= mHi ? mHi : 0; }

  private:
    double mLo = kInfinity, mHi = -kInfinity;
};

/// A double as float; what is too large becomes infinite, so that it is counted and capped later.
inline float narrow(double value) {
    constexpr double kGreatest = std::numeric_limits<float>::max();
    if (value > kGreatest) return std::numeric_limits<float>::infinity();
    if (value < -kGreatest) return -std::numeric_limits<float>::infinity();
    return static_cast<float>(value);
}

}  // namespace brume::volumes
