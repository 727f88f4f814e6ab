// SPDX-License-Identifier: Apache-2.0
// Pairs of scenes that differ in one optional feature: what a need costs, and that it costs nothing
// where it is not used.
#pragma once

#include <bench/scenes.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brume::bench {

struct Need {
    std::string name;     ///< "coloured"; its scenes are need_coloured and need_coloured_without
    std::string what;     ///< "coloured transmission"
    std::string method;   ///< that has it, with settings: "weighted:diffusion=true"
    std::string without;  ///< the method of the other scene
    void (*use)(scene::Scene& scene, bool isUsed);
};

std::span<const Need> listNeeds();

/// All pairs for "needs"; one scene for "need_<name>" and "need_<name>_without"; "need_unused" is the
/// plain scene with everything described and nothing used, beside "need_unused_without".
std::vector<NamedScene> makeNeedScenes(std::string_view name);

}  // namespace brume::bench
