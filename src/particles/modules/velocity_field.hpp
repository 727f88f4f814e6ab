// SPDX-License-Identifier: Apache-2.0
// Air that moves as a grid says: shaders/particles/modules/velocity_field.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::velocity_field {

Module module();

}  // namespace brume::particles::velocity_field
