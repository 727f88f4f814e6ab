// SPDX-License-Identifier: Apache-2.0
// Air that circles around a line and takes particles along; the field itself is
// shaders/particles/modules/vortex.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::vortex {

Module module();

}  // namespace brume::particles::vortex
