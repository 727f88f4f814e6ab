// SPDX-License-Identifier: Apache-2.0
// Collision with the opaque meshes that a picture shows: see
// shaders/particles/modules/collide_depth.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::collide_depth {

Module module();

}  // namespace brume::particles::collide_depth
