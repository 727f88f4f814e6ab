// SPDX-License-Identifier: Apache-2.0
// A sphere that particles hit; how: shaders/particles/modules/collide_sphere.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::collide_sphere {

Module module();

}  // namespace brume::particles::collide_sphere
