// SPDX-License-Identifier: Apache-2.0
// Grids of an effect as the simulator samples them.
#pragma once

#include <shaders/particles/field_grid.h>
#include <core/math.hpp>
#include <scene/effect.hpp>

#include <vector>

namespace brume::particles {

dmat4 effectFromFile(const scene::FieldPlacement& placement);
dmat4 effectFromIndex(const scene::FieldPlacement& placement, const scene::FieldValues& field);

/// The grid, loaded and with that many components. Throws an input Error at the placement.
const scene::FieldValues& findField(const scene::Effect& effect,
                                    const scene::FieldPlacement& placement, int componentCount);

/// Lays grids one behind the other into one array.
class FieldPacker {
  public:
    explicit FieldPacker(std::vector<float>& values) : mValues(&values) {}

    /// Equal grids share their values. Throws an input Error if all together have too many.
    shader::FieldGrid add(const scene::FieldPlacement& placement, const scene::FieldValues& field,
                          double outside);

  private:
    std::vector<float>* mValues;
    std::map<const scene::FieldValues*, std::uint32_t> mFirstValue;
};

}  // namespace brume::particles
