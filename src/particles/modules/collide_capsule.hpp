// SPDX-License-Identifier: Apache-2.0
// A rod with round ends that particles hit; how: shaders/particles/modules/collide_capsule.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::collide_capsule {

Module module();

}  // namespace brume::particles::collide_capsule
