// SPDX-License-Identifier: Apache-2.0
// Linear drag towards a wind: dv/dt = -rate (v - wind), in the exact step of
// shaders/particles/step.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::drag {

Module module();

}  // namespace brume::particles::drag
