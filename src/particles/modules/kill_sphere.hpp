// SPDX-License-Identifier: Apache-2.0
// Particles die where they leave the allowed side of a sphere.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::kill_sphere {

Module module();

}  // namespace brume::particles::kill_sphere
