// SPDX-License-Identifier: Apache-2.0
// What the passes of method tile share: their inputs, and a ray's way through a sphere.
#ifndef BRUME_OIT_TILE_MEDIA_GLSL
#define BRUME_OIT_TILE_MEDIA_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "../../common/bindings.glsl"
#include "../../common/chords.glsl"
#include "../../gpu/address.glsl"
#include "tile.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kOrthographic = true;
layout(constant_id = 1) const bool kSmooth = true;     // some spheres are
layout(constant_id = 2) const bool kOneSource = true;  // all media have the same source function,
                                                       // the same everywhere
layout(constant_id = 3) const bool kColoured = true;   // extinction differs between channels
layout(constant_id = 4) const uint kMediumCount = kTileMedia;
layout(constant_id = 5) const bool kOneMedium = true;  // one medium and tint; light may vary
layout(push_constant, scalar) uniform Push { TilePush push; };
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(buffer_reference, scalar) buffer CounterBlock { TileCounters counters; };

#include "../integrate/path.glsl"

vec3 perChannel(vec3 x) { return kColoured ? x : vec3(x.x); }

// The tile that a slot of this dispatch stands for.
uint tileCount() { return UintArray(push.tiles).at[kTileListCount]; }
uint tileAt(uint slot) { return UintArray(push.tiles).at[kTileListHead + slot]; }

// For passes with one workgroup per tile and one invocation per pixel: false outside the image.
bool beginPixel(out uint tile, out uvec2 pixel) {
    uint slot = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (slot >= tileCount()) return false;
    tile = tileAt(slot);
    pixel = tileCorner(tile) +
            uvec2(gl_LocalInvocationIndex % kTileSize, gl_LocalInvocationIndex / kTileSize);
    return all(lessThan(pixel, frame.size));
}

RealRay makeTileRay(uvec2 pixel) {
    RealRay ray = makeRealRay(vec2(pixel) + 0.5);
    if (!kOrthographic) ray.origin = Real3(0);
    return ray;
}

// A ray's way through a sphere in front of the opaque surface: where it enters, and how far it
// goes; 0 where it misses.
struct Chord {
    float enter, span;
    float before, behind;  // from the enter back to the sphere's begin, and on to its end
};

Chord findChord(RealRay ray, float limit, SphereData sphere) {
    SphereChord whole = findSphereChord(ray, sphere);
    precise Real begin = whole.middle - whole.reach, end = whole.middle + whole.reach;
    precise Real enter = max(begin, Real(0));
    precise Real span = max(min(end, Real(limit)) - enter, Real(0));
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

// Kahan's sum.
void addLength(inout float sum, inout float lost, float value) {
    precise float next = value - lost;
    precise float grown = sum + next;
    lost = (grown - sum) - next;
    sum = grown;
}

// -log(epsilon) as a sum of density times length, for media of one extinction.
float findEnough(vec3 extinction) {
    float least = min(extinction.x, min(extinction.y, extinction.z));
    return push.epsilon > 0.0 && least > 0.0 ? -log(push.epsilon) / least : 3e38;
}

// Loops of the whole invocation: some devices silently end them after 65 535 iterations.
const uint kMostSteps = 60000u;

void countExhausted() { atomicAdd(CounterBlock(push.counters).counters.exhausted, 1u); }

void countStop(float bound) {
    atomicAdd(CounterBlock(push.counters).counters.stopped, 1u);
    atomicMax(CounterBlock(push.counters).counters.bound, floatBitsToUint(bound));
}

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }

// What a pixel may be off that has stopped at transmittance `rest` and shows what is behind the
// media, while media of radiances up to `media` (per optical depth) may be in between.
float boundError(vec3 rest, vec3 media, vec3 behind) { return largest(rest * max(media, behind)); }

#endif
