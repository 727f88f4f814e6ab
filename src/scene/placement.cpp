// SPDX-License-Identifier: Apache-2.0
#include <scene/placement.hpp>

#include <algorithm>

namespace brume::scene {

dvec3 offsetAt(const Path& path, double seconds) {
    if (path.empty()) return dvec3(0);
    const auto next =
        std::upper_bound(path.begin(), path.end(), seconds,
                         [](double value, const auto& key) { return value < key.first; });
    if (next == path.begin()) return path.front().second;
    if (next == path.end()) return path.back().second;
    const auto& [start, from] = *std::prev(next);
    return from + (next->second - from) * ((seconds - start) / (next->first - start));
}

dmat4 Placement::at(double seconds) const {
    dmat4 placed = worldFromObject;
    placed[3] += dvec4(offsetAt(path, seconds), 0);
    return placed;
}

}  // namespace brume::scene
