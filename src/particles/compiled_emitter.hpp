// SPDX-License-Identifier: Apache-2.0
// Emitters as the step has them. Part of compileEffect().
#pragma once

#include <particles/compiled_effect.hpp>
#include <particles/fields.hpp>

namespace brume::particles {

/// Adds the emitter, with what its shape is made of and the grid of its births' velocities. Throws
/// an input Error where a mesh or a grid gives no place for births.
void addEmitter(const scene::Effect& effect, const scene::Emitter& emitter, FieldPacker& packer,
                CompiledEffect& compiled);

}  // namespace brume::particles
