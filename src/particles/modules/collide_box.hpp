// SPDX-License-Identifier: Apache-2.0
// A box that particles hit; how: shaders/particles/modules/collide_box.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::collide_box {

Module module();

}  // namespace brume::particles::collide_box
