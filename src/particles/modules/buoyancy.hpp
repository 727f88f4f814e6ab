// SPDX-License-Identifier: Apache-2.0
// Lift in a grid of temperatures: shaders/particles/modules/buoyancy.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::buoyancy {

Module module();

}  // namespace brume::particles::buoyancy
