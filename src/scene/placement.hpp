// SPDX-License-Identifier: Apache-2.0
// Where something is that moves.
#pragma once

#include <core/math.hpp>

#include <utility>
#include <vector>

namespace brume::scene {

/// Offsets at times that rise: linear between them, constant outside. Empty: 0.
using Path = std::vector<std::pair<double, dvec3>>;

dvec3 offsetAt(const Path& path, double seconds);

/// A transform whose translation follows a path.
struct Placement {
    dmat4 worldFromObject{1};
    Path path;  ///< world, m
    dmat4 at(double seconds) const;
};

}  // namespace brume::scene
