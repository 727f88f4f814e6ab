// SPDX-License-Identifier: Apache-2.0
// The geometry of a shadow map: from positions to texels and from texels to light rays.
#ifndef BRUME_SHADOWS_COMMON_MAP_GLSL
#define BRUME_SHADOWS_COMMON_MAP_GLSL
#include "../../common/camera.glsl"
#include "../../gpu/address.glsl"
#include "maps.h"

layout(buffer_reference, scalar) readonly buffer ShadowMapRef { ShadowMap map; };

// Where a position lies in a map.
struct MapPoint {
    vec2 texel;  // centres at + 0.5
    uint face;
    float distance;  // from the map's plane or the light
    bool isInside;   // outside there are no casters
};

// Coordinates along right, up and forward of face 0, turned so that a face looks along +z.
vec3 turnToFace(uint face, vec3 l) {
    if (face == 1u) return vec3(-l.x, l.y, -l.z);
    if (face == 2u) return vec3(-l.z, l.y, l.x);
    if (face == 3u) return vec3(l.z, l.y, -l.x);
    if (face == 4u) return vec3(l.x, -l.z, l.y);
    if (face == 5u) return vec3(l.x, l.z, -l.y);
    return l;
}

vec3 turnFromFace(uint face, vec3 f) {
    if (face == 1u) return vec3(-f.x, f.y, -f.z);
    if (face == 2u) return vec3(f.z, f.y, -f.x);
    if (face == 3u) return vec3(-f.z, f.y, f.x);
    if (face == 4u) return vec3(f.x, f.z, -f.y);
    if (face == 5u) return vec3(f.x, -f.z, f.y);
    return f;
}

vec3 mapCoordinates(ShadowMap map, vec3 position) {
    vec3 offset = position - map.origin;
    return vec3(dot(offset, map.right), dot(offset, map.up), dot(offset, map.forward));
}

uint findFace(ShadowMap map, vec3 l) {
    if (map.faceCount == 1u) return 0u;
    vec3 a = abs(l);
    if (a.z >= max(a.x, a.y)) return l.z > 0.0 ? 0u : 1u;
    if (a.x >= a.y) return l.x > 0.0 ? 2u : 3u;
    return l.y > 0.0 ? 4u : 5u;
}

MapPoint locateInMap(ShadowMap map, vec3 position) {
    vec3 l = mapCoordinates(map, position);
    MapPoint point;
    point.face = findFace(map, l);
    vec3 f = turnToFace(point.face, l);
    bool isDirectional = map.isDirectional != 0u;
    point.distance = isDirectional ? f.z : length(l);
    vec2 s = (isDirectional ? f.xy : f.xy / max(f.z, 1e-30)) / map.extent;
    point.texel = clamp((s * 0.5 + 0.5) * float(map.resolution), -1e6, 1e6);
    point.isInside = all(greaterThanEqual(point.texel, vec2(0))) &&
                     all(lessThan(point.texel, vec2(map.resolution))) &&
                     (isDirectional || f.z > 0.0) && point.distance > map.begin;
    return point;
}

// The light ray through a place of a face.
Ray mapRay(ShadowMap map, uint face, vec2 texel) {
    vec2 s = (texel / float(map.resolution) * 2.0 - 1.0) * map.extent;
    if (map.isDirectional != 0u)
        return Ray(map.origin + s.x * map.right + s.y * map.up, map.forward);
    vec3 l = turnFromFace(face, vec3(s, 1.0));
    return Ray(map.origin, normalize(l.x * map.right + l.y * map.up + l.z * map.forward));
}

uint mapTile(ShadowMap map, uint face, uvec2 texel) {
    uint tiles = map.resolution / kMapTileSize;
    uvec2 tile = min(texel / kMapTileSize, uvec2(tiles - 1u));
    return (face * tiles + tile.y) * tiles + tile.x;
}

uint texelIndex(ShadowMap map, uint face, ivec2 texel) {
    uvec2 t = uvec2(clamp(texel, ivec2(0), ivec2(map.resolution) - 1));
    return (face * map.resolution + t.y) * map.resolution + t.x;
}

// m, at a place.
float texelSize(ShadowMap map, float distance) {
    float size = 2.0 * map.extent / float(map.resolution);
    return map.isDirectional != 0u ? size : size * distance;
}

// The texel of an invocation of a build pass: groups of 64 are the map's tiles.
struct BuildTexel {
    uint tile, face, index;
    uvec2 texel;
    bool isInside;
};

BuildTexel findBuildTexel(ShadowMap map, uint group, uint local) {
    uint tiles = map.resolution / kMapTileSize;
    BuildTexel b;
    b.tile = group;
    b.isInside = group < map.faceCount * tiles * tiles;
    b.face = group / (tiles * tiles);
    uint inFace = group % (tiles * tiles);
    b.texel = uvec2(inFace % tiles, inFace / tiles) * kMapTileSize +
              uvec2(local % kMapTileSize, local / kMapTileSize);
    b.index = (b.face * map.resolution + b.texel.y) * map.resolution + b.texel.x;
    return b;
}

// Weight of the tent of radius r (2 r + 1 texels and the two that share the fraction) at an offset.
float tentWeight(float offset, float radius) { return max(radius + 1.0 - abs(offset), 0.0); }

#endif
