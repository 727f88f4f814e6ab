// SPDX-License-Identifier: Apache-2.0
// Exact transmittance from a point to the light: every caster of the point's tile is intersected
// with the light ray itself.
#ifndef BRUME_SHADOWS_EXACT_TRANSMITTANCE_GLSL
#define BRUME_SHADOWS_EXACT_TRANSMITTANCE_GLSL
#include "../common/casters.glsl"

vec3 exactSphereDepth(ShadowMap map, uint tile, Ray ray, float end) {
    vec3 depth = vec3(0);
    uint k = UintArray(map.sphereOffsets).at[tile];
    uint last = UintArray(map.sphereOffsets).at[tile + 1u];
    for (; k < last; ++k) {
        SphereData sphere = ShadowSpheres(map.spheres).at[UintArray(map.spherePairs).at[k]];
        vec2 t;
        bool isHit = hitShadowSphere(ray, sphere, t);
        t.y = min(t.y, end);
        if (isHit && t.y > t.x)
            depth += media[sphere.medium].extinction * sphereDensityLength(ray, sphere, t);
        ++shadowIterations;
    }
    return depth;
}

vec3 exactBoxDepth(ShadowMap map, uint tile, Ray ray, float end) {
    vec3 depth = vec3(0);
    uint k = UintArray(map.boxOffsets).at[tile];
    uint last = UintArray(map.boxOffsets).at[tile + 1u];
    for (; k < last; ++k) {
        BoxData box = ShadowBoxes(map.boxes).at[UintArray(map.boxPairs).at[k]];
        VolumeData volume = ShadowVolumes(map.volumes).at[box.volume];
        LocalRay local = shadowLocalRay(ray, box, volume);
        vec2 t;
        bool isHit = intersectBox(local.origin, local.direction, box.size, t);
        t.y = min(t.y, end);
        if (isHit && t.y > t.x)
            depth += media[volume.medium].extinction * brickDensityLength(box, local, t);
        ++shadowIterations;
    }
    return depth;
}

// Product of the thin and opaque surfaces; `depth` gains what solids take away.
vec3 exactSurfaces(ShadowMap map, uint tile, Ray ray, float end, inout vec3 depth) {
    vec3 product = vec3(1), solids = vec3(0);
    uint k = UintArray(map.triangleOffsets).at[tile];
    uint last = UintArray(map.triangleOffsets).at[tile + 1u];
    for (; k < last; ++k) {
        ShadowTriangle triangle =
            ShadowTriangles(map.triangles).at[UintArray(map.trianglePairs).at[k]];
        ShadowMaterial material = ShadowMaterials(map.materials).at[triangle.material];
        TriangleHit hit;
        ++shadowIterations;
        if (!intersectTriangle(ray, triangle, hit) || hit.t <= 0.0 || hit.t >= end) continue;
        product *= surfaceTransmittance(triangle, material, hit.weights);
        if (material.type == kMaterialSolid)
            solids += material.extinction * (hit.isFront ? -hit.t : hit.t);
    }
    depth += max(solids, 0.0);
    return product;
}

vec3 exactTransmittance(ShadowMap map, vec3 position, MapPoint point) {
    bool isDirectional = map.isDirectional != 0u;
    Ray ray = Ray(position, isDirectional ? -map.forward
                                          : (map.origin - position) / max(point.distance, 1e-30));
    float end = isDirectional ? 3.0e38 : point.distance;
    uint tile = mapTile(map, point.face, uvec2(point.texel));
    vec3 depth = exactSphereDepth(map, tile, ray, end) + exactBoxDepth(map, tile, ray, end);
    vec3 product = exactSurfaces(map, tile, ray, end, depth);
    return product * exp(-depth);
}

#endif
