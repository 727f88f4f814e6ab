// SPDX-License-Identifier: Apache-2.0
// What a method of order-independent transparency says about itself; the source of the command
// line's list, the benchmark's columns and the README's table.
#pragma once

#include <scene/settings.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brume::oit {

enum class Exactness {
    Exact,       ///< equals the reference to rounding
    Bounded,     ///< differs by no more than a bound that it reports
    Approximate  ///< differs by an amount that only measurement tells
};

/// What makes a picture hard. An approximation says which of these it may get wrong; all others,
/// and every exact or bounded method all of them, it must get right (`brume bench --suite hard`).
enum class Weakness {
    Order,       ///< layers of different radiance, one behind the other
    ManyLayers,  ///< the same with more layers per pixel than it keeps apart
    LostLayers,  ///< layers beyond those it keeps, or several at one distance: they are missing
    Overlap,     ///< media of different radiance that share space
    Surfaces,    ///< the order of surfaces, among each other and among media
    Colour,      ///< transmission of another colour per channel
    Profile,     ///< density that changes along the ray, before something of another radiance
    Thick,       ///< optical depths above ten or so in one place
    Emission,    ///< light from what covers nothing
    Noise        ///< wrong in one frame, right in the mean of many
};

std::string_view describe(Weakness weakness);

using scene::SettingInfo;

struct MethodInfo {
    std::string_view name;     ///< snake_case, as in --method
    std::string_view summary;  ///< one sentence
    std::string_view paper;    ///< author, title, year; or "-"
    Exactness exactness = Exactness::Exact;
    std::string_view passes;         ///< over the transparent things, e.g. "2 + 1 resolve"
    std::string_view bytesPerPixel;  ///< formula, e.g. "16 + 8 n, n intervals"
    std::string_view limits;         ///< what it cannot do
    std::vector<Weakness> weaknesses = {};  ///< what it may get wrong; approximate methods only
    std::vector<SettingInfo> settings;
};

/// Every registered method, in the order of the folder's CMakeLists. The span lives as long as the
/// program.
std::span<const MethodInfo> listMethods();

}  // namespace brume::oit
