// SPDX-License-Identifier: Apache-2.0
// What the hard cases have in common, and those made of voxels.
#pragma once

#include <bench/scene_builder.hpp>
#include <bench/scene_parts.hpp>
#include <bench/scenes.hpp>

namespace brume::bench {

/// Seen from z = 4 under a sky of one colour, lit from everywhere alike.
struct HardBuilder : Builder {
    explicit HardBuilder(const dvec3& eye = dvec3(0, 0, 4), const dvec3& target = dvec3(0));

    std::uint32_t addEmitter(double extinction, const dvec3& emission);
    /// Of constant density.
    void addBall(std::uint32_t medium, const dvec3& center, double radius, double density = 1);
    void addSun(const dvec3& direction, const dvec3& irradiance);
    NamedScene named(const char* name) { return {name, std::move(scene)}; }
};

NamedScene makeShearedVolume();
NamedScene makeSheetVolume();
NamedScene makeDynamicRange();
NamedScene makeEmptyVolume();
NamedScene makeHugeTile();
NamedScene makeFarVoxels();
NamedScene makeTinyVolume();

}  // namespace brume::bench
