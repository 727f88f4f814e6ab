// SPDX-License-Identifier: Apache-2.0
// A plane that particles hit; how: shaders/particles/modules/collide_plane.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::collide_plane {

Module module();

}  // namespace brume::particles::collide_plane
