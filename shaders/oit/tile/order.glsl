// SPDX-License-Identifier: Apache-2.0
// The order in which the ray through a tile's middle meets the ends of spheres.
#ifndef BRUME_OIT_TILE_ORDER_GLSL
#define BRUME_OIT_TILE_ORDER_GLSL
#include "media.glsl"

RealRay makeMiddleRay(uint tile) {
    RealRay ray = makeRealRay(vec2(tileCorner(tile)) + 0.5 * float(kTileSize));
    if (!kOrthographic) ray.origin = Real3(0);
    return ray;
}

// Where it enters or leaves a sphere; where it passes nearest to one that it misses.
float middleDistance(RealRay ray, SphereData sphere, bool isEnd) {
    SphereChord chord = findSphereChord(ray, sphere);
    return float(isEnd ? chord.middle + chord.reach : chord.middle - chord.reach);
}

#endif
