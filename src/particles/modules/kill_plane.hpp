// SPDX-License-Identifier: Apache-2.0
// Particles die where they leave the allowed side of a plane.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::kill_plane {

Module module();

}  // namespace brume::particles::kill_plane
