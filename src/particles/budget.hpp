// SPDX-License-Identifier: Apache-2.0
// How many particles the effects of a scene may have. A budget is handed out as capacity, in the order
// of the scene's entries, so that what is simulated stays a function of the scene alone.
#pragma once

#include <core/log.hpp>
#include <scene/scene.hpp>

namespace brume::particles {

struct BudgetCut {
    std::size_t entries = 0;    ///< effects and sub-emitters that have less capacity than they want
    std::size_t first = 0;      ///< the first of them, index into the scene's effects
    std::uint64_t wanted = 0;   ///< particles, of the whole scene
    std::uint64_t granted = 0;
    std::vector<std::size_t> changed;  ///< roots whose entries have other capacities than before
};

/// Lowers the capacities of the scene's effects until neither the scene's budget nor that of any
/// effect is exceeded: the first in order keep theirs, the others get what is left, or 0. Doing it
/// again changes nothing; once effects are gone, it gives their share back to those that were cut.
BudgetCut applyBudgets(scene::Scene& scene);

/// One line if something was cut and that is new.
void warnOfCut(const BudgetCut& cut, const scene::Scene& scene, const Log& log);

}  // namespace brume::particles
