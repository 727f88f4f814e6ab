// SPDX-License-Identifier: Apache-2.0
// What a shadow store says about itself; the source of the command line's list and the
// benchmark's table.
#pragma once

#include <scene/settings.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace brume::shadows {

struct StoreInfo {
    std::string_view name;     ///< snake_case, as in --shadow
    std::string_view summary;  ///< one sentence
    std::string_view paper;    ///< author, title, year; or "-"
    std::string_view result;   ///< where it is exact and where not
    std::string_view bytesPerTexel;
    std::string_view limits;
    std::uint32_t bit = 0;  ///< its bit in kShadowStores (shaders/shadows/common/maps.h)
    std::vector<scene::SettingInfo> settings;
};

/// Every registered store, in the order of the folder's CMakeLists.
std::span<const StoreInfo> listStores();

/// Settings that every map has, whatever its store.
std::span<const scene::SettingInfo> listMapSettings();

/// The bits of kShadowStores for a light with that store: its own and that of the opaque map; 0
/// for "none". Throws an input Error for an unknown name.
std::uint32_t storeBits(std::string_view name);

}  // namespace brume::shadows
