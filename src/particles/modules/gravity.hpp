// SPDX-License-Identifier: Apache-2.0
// Constant acceleration, in the exact step of shaders/particles/step.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::gravity {

Module module();

}  // namespace brume::particles::gravity
