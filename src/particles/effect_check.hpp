// SPDX-License-Identifier: Apache-2.0
// Whether an effect can be simulated; effects made in code have met no schema.
#pragma once

#include <scene/effect.hpp>

namespace brume::particles {

/// Throws an input Error that names what is wrong and what is allowed. `isChild`: the effect of a
/// sub-emitter. Sub-emitters themselves are looked at, their effects are not.
void checkEffect(const scene::Effect& effect, bool isChild);

}  // namespace brume::particles
