// SPDX-License-Identifier: Apache-2.0
// What a setting may be, read from what its technique says about it, so that no list is written
// twice.
#pragma once

#include <scene/settings.hpp>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace brume::view {

struct SettingRange {
    enum class Kind { Flag, Choice, Number, Text };
    Kind kind = Kind::Text;
    std::vector<std::string> choices;  ///< Choice
    double lo = -std::numeric_limits<double>::infinity();
    double hi = std::numeric_limits<double>::infinity();  ///< Number
    bool isWhole = false;    ///< Number: limits and default are whole numbers
    bool isWide = false;     ///< Number: limits lie orders of magnitude apart
    std::string unit;        ///< Number; may be empty
};

/// From "1..64", "0 .. 16 texels", "true, false", "half, single", "m".
SettingRange readRange(const scene::SettingInfo& info);

/// The number at the beginning of a text: "512 (256 per face of a cube)" is 512.
std::optional<double> leadingNumber(std::string_view text);

/// Shortest text that gives the number back within 6 digits; whole ones without a point.
std::string formatNumber(double value);

}  // namespace brume::view
