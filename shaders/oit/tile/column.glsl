// SPDX-License-Identifier: Apache-2.0
// Eight pixels below each other per invocation: a medium is loaded once for all of them.
#ifndef BRUME_OIT_TILE_COLUMN_GLSL
#define BRUME_OIT_TILE_COLUMN_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "../../common/bindings.glsl"
#include "../../common/chords.glsl"
#include "../../gpu/address.glsl"
#include "tile.h"

layout(local_size_x = 64) in;  // eight tiles
layout(constant_id = 0) const bool kOrthographic = true;
layout(constant_id = 1) const bool kSmooth = true;     // some spheres are
layout(constant_id = 2) const bool kOneSource = true;  // all media have the same source function
layout(constant_id = 3) const bool kColoured = true;   // extinction differs between channels
layout(constant_id = 4) const uint kMediumCount = kTileMedia;
layout(push_constant, scalar) uniform Push { TilePush push; };
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;

const uint kRows = kTileSize;

uvec2 corner;  // the column's topmost pixel
RealRay rays[kRows];
float limits[kRows];  // distance of the opaque surface; < 0 outside the image

// False behind the last tile.
bool beginColumn(out uint tile) {
    uint thread = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
    uint slot = thread / kTileSize;
    if (slot >= push.tileCount) return false;
    tile = UintArray(push.tiles).at[slot];
    corner =
        uvec2(tile % frame.tiles.x, tile / frame.tiles.x) * kTileSize + uvec2(thread % kTileSize, 0u);
    [[unroll]] for (uint row = 0u; row < kRows; ++row) {
        uvec2 pixel = corner + uvec2(0u, row);
        bool inside = all(lessThan(pixel, frame.size));
        rays[row] = makeRealRay(vec2(pixel) + 0.5);
        if (!kOrthographic) rays[row].origin = Real3(0);
        limits[row] = inside ? texelFetch(opaqueT, ivec2(pixel), 0).x : -1.0;
    }
    return true;
}

// A ray's way through a sphere in front of the opaque surface: where it enters, and how far it
// goes; 0 where it misses.
struct Chord {
    float enter, span;
    float before, behind;  // from the enter back to the sphere's begin, and on to its end
};

Chord findChord(uint row, SphereData sphere) {
    SphereChord whole = findSphereChord(rays[row], sphere);
    precise Real begin = whole.middle - whole.reach, end = whole.middle + whole.reach;
    precise Real enter = max(begin, Real(0));
    precise Real span = max(min(end, Real(limits[row])) - enter, Real(0));
    return Chord(float(enter), float(span), float(enter - begin), float(end - enter));
}

// Integral of the density over the chord: the smooth profile is a polynomial of degree 4 along the
// ray, for which Gauss's rule with three points is exact.
float densityLength(SphereData sphere, Chord chord) {
    float uniformLength = sphere.density * chord.span;
    if (!kSmooth) return uniformLength;
    const vec3 kNodes = vec3(0.1127016653792583, 0.5, 0.8872983346207417);
    const vec3 kWeights = vec3(5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0);
    vec3 t = chord.span * kNodes;
    vec3 q = (chord.before + t) * (chord.behind - t) / (sphere.radius * sphere.radius);
    float mean = dot(kWeights, q * q);
    return sphere.profile == kProfileSmooth ? uniformLength * mean : uniformLength;
}

#endif
