// SPDX-License-Identifier: Apache-2.0
// Drag by the square of the speed; the step itself is
// shaders/particles/modules/quadratic_drag.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::quadratic_drag {

Module module();

}  // namespace brume::particles::quadratic_drag
