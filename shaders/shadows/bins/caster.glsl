// SPDX-License-Identifier: Apache-2.0
// The bounds of a caster on the faces of a map.
#ifndef BRUME_SHADOWS_BINS_CASTER_GLSL
#define BRUME_SHADOWS_BINS_CASTER_GLSL
#include "../../common/bounds.glsl"
#include "../common/casters.glsl"

layout(constant_id = 0) const uint kCaster = kCasterSphere;
layout(push_constant, scalar) uniform Push { ShadowBinPush push; };

struct Caster {
    vec3 corners[8];  // in the map's coordinates; a sphere: its centre
    uint cornerCount;
    float radius;  // of a sphere
    bool isThere;
};

Caster loadCaster(ShadowMap map, uint index) {
    Caster caster;
    caster.radius = 0.0;
    caster.isThere = true;
    for (uint c = 0u; c < 8u; ++c) caster.corners[c] = vec3(0);
    if (kCaster == kCasterSphere) {
        SphereData sphere = ShadowSpheres(map.spheres).at[index];
        caster.corners[0] = mapCoordinates(map, sphere.center);
        caster.cornerCount = 1u;
        caster.radius = sphere.radius;
        caster.isThere = sphere.radius > 0.0 && sphere.density > 0.0;
    } else if (kCaster == kCasterBox) {
        BoxData box = ShadowBoxes(map.boxes).at[index];
        VolumeData volume = ShadowVolumes(map.volumes).at[box.volume];
        for (uint c = 0u; c < 8u; ++c)
            caster.corners[c] = mapCoordinates(map, boxCorner(box, volume, c));
        caster.cornerCount = 8u;
    } else {
        ShadowTriangle triangle = ShadowTriangles(map.triangles).at[index];
        caster.corners[0] = mapCoordinates(map, triangle.a);
        caster.corners[1] = mapCoordinates(map, triangle.b);
        caster.corners[2] = mapCoordinates(map, triangle.c);
        caster.cornerCount = 3u;
    }
    return caster;
}

// First and last tile of a face; first > last: none.
void findTiles(ShadowMap map, Caster caster, uint face, out uvec2 first, out uvec2 last) {
    bool isDirectional = map.isDirectional != 0u;
    CornerBounds corners = beginCorners();
    for (uint c = 0u; c < caster.cornerCount; ++c)
        addCorner(corners, turnToFace(face, caster.corners[c]), isDirectional);
    Bounds bounds =
        kCaster == kCasterSphere
            ? sphereBoundsInView(turnToFace(face, caster.corners[0]), caster.radius, isDirectional)
            : finishCorners(corners, isDirectional);
    const float kMargin = 0.02;  // texels; covers the rounding of the projection
    float size = float(map.resolution);
    vec2 lo = (bounds.lo / map.extent * 0.5 + 0.5) * size - kMargin;
    vec2 hi = (bounds.hi / map.extent * 0.5 + 0.5) * size + kMargin;
    bool isSeen = caster.isThere && bounds.isVisible && all(greaterThanEqual(hi, vec2(0))) &&
                  all(lessThanEqual(lo, vec2(size)));
    first = isSeen ? uvec2(clamp(lo, 0.0, size - 1.0)) / kMapTileSize : uvec2(1u);
    last = isSeen ? uvec2(clamp(hi, 0.0, size - 1.0)) / kMapTileSize : uvec2(0u);
}

#endif
