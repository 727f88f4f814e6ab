// SPDX-License-Identifier: Apache-2.0
// A solid given by signed distances: shaders/particles/modules/collide_level_set.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::collide_level_set {

Module module();

}  // namespace brume::particles::collide_level_set
