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

using scene::SettingInfo;

struct MethodInfo {
    std::string_view name;     ///< snake_case, as in --method
    std::string_view summary;  ///< one sentence
    std::string_view paper;    ///< author, title, year; or "-"
    Exactness exactness = Exactness::Exact;
    std::string_view passes;         ///< over the transparent things, e.g. "2 + 1 resolve"
    std::string_view bytesPerPixel;  ///< formula, e.g. "16 + 8 n, n intervals"
    std::string_view limits;         ///< what it cannot do
    std::vector<SettingInfo> settings;
};

/// Every registered method, in the order of the folder's CMakeLists. The span lives as long as the
/// program.
std::span<const MethodInfo> listMethods();

}  // namespace brume::oit
