// SPDX-License-Identifier: Apache-2.0
// Pull towards, or push from, a point or a line; the field itself is
// shaders/particles/modules/attractor.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::attractor {

Module module();

}  // namespace brume::particles::attractor
