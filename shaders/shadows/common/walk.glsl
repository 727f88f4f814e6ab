// SPDX-License-Identifier: Apache-2.0
// Visits all that takes some light away along the ray of a texel, in pieces; opaque surfaces are
// left to the map of their own. The including shader defines
//   void takePiece(float t0, float t1, vec3 depth, uint id)   of a medium, constant density
//   void takeSurface(float t, vec3 transmittance, uint id)    thin
// Pieces of one medium interval share an id and come in order; different ones in any order, which
// is the same in every run and for every order of submission.
#ifndef BRUME_SHADOWS_COMMON_WALK_GLSL
#define BRUME_SHADOWS_COMMON_WALK_GLSL
#include "casters.glsl"

const uint kSmoothPieces = 6u;  // of a smooth sphere

void walkSpheres(ShadowMap map, uint tile, Ray ray) {
    uint k = UintArray(map.sphereOffsets).at[tile];
    uint last = UintArray(map.sphereOffsets).at[tile + 1u];
    for (; k < last; ++k) {
        SphereData sphere = ShadowSpheres(map.spheres).at[UintArray(map.spherePairs).at[k]];
        vec2 t;
        if (!hitShadowSphere(ray, sphere, t)) continue;
        vec3 extinction = media[sphere.medium].extinction;
        uint pieces = sphere.profile == kProfileConstant ? 1u : kSmoothPieces;
        float step = (t.y - t.x) / float(pieces);
        for (uint i = 0u; i < pieces; ++i) {
            vec2 part =
                vec2(t.x + float(i) * step, i + 1u < pieces ? t.x + float(i + 1u) * step : t.y);
            takePiece(part.x, part.y, extinction * sphereDensityLength(ray, sphere, part),
                      sphere.id);
        }
    }
}

void walkBox(BoxData box, VolumeData volume, Ray ray, uint id) {
    LocalRay local = shadowLocalRay(ray, box, volume);
    vec2 t;
    if (!intersectBox(local.origin, local.direction, box.size, t)) return;
    vec3 extinction = media[volume.medium].extinction;
    float position = t.x, from = t.x;
    vec3 depth = vec3(0);
    for (int i = 0; i < 64 && position < t.y; ++i) {
        float target = min(nextPlane(box, local, position), t.y);
        vec3 added = extinction * cellDensityLength(box, local, position, target);
        // Empty cells end a piece: it would smear what is behind them.
        bool isEmpty = max(added.x, max(added.y, added.z)) == 0.0;
        float end = isEmpty ? position : target;
        depth += added;
        bool isDone = isEmpty || target >= t.y ||
                      max(depth.x, max(depth.y, depth.z)) >= kPieceDepth;
        // One call: the including shader's function is long, and copied for each.
        if (isDone && from < end) takePiece(from, end, depth, id);
        if (isDone) {
            from = target;
            depth = vec3(0);
        }
        position = target;
    }
}

void walkBoxes(ShadowMap map, uint tile, Ray ray) {
    uint k = UintArray(map.boxOffsets).at[tile];
    uint last = UintArray(map.boxOffsets).at[tile + 1u];
    for (; k < last; ++k) {
        uint index = UintArray(map.boxPairs).at[k];
        BoxData box = ShadowBoxes(map.boxes).at[index];
        bool isShared = box.kind == kBoxBrick && box.volume < kSharedVolumes;
        walkBox(box, ShadowVolumes(map.volumes).at[box.volume], ray,
                isShared ? kVolumeIds + box.volume : kBoxIds | index);
    }
}

// Faces of solids along the ray, sorted.
struct SolidHit {
    float t;
    vec3 extinction;  // that begins, or with a minus ends
    float gain;       // of the share of light that is taken behind this face
};
SolidHit solidHits[kMaxSolidHits];
uint solidHitCount = 0u;

void insertSolidHit(SolidHit hit) {
    if (solidHitCount >= kMaxSolidHits) return;
    uint slot = solidHitCount;
    for (; slot > 0u && solidHits[slot - 1u].t > hit.t; --slot)
        solidHits[slot] = solidHits[slot - 1u];
    solidHits[slot] = hit;
    ++solidHitCount;
}

void walkTriangles(ShadowMap map, uint tile, Ray ray) {
    uint k = UintArray(map.triangleOffsets).at[tile];
    uint last = UintArray(map.triangleOffsets).at[tile + 1u];
    solidHitCount = 0u;
    for (; k < last; ++k) {
        ShadowTriangle triangle =
            ShadowTriangles(map.triangles).at[UintArray(map.trianglePairs).at[k]];
        ShadowMaterial material = ShadowMaterials(map.materials).at[triangle.material];
        TriangleHit hit;
        if (material.type == kMaterialOpaque || !intersectTriangle(ray, triangle, hit) ||
            hit.t <= 0.0)
            continue;
        float gain = map.hasCaustics != 0u ? causticGain(triangle, material.ior, hit.weights,
                                                         ray.direction)
                                           : 1.0;
        if (material.type == kMaterialSolid) {
            vec3 change = hit.isFront ? material.extinction : -material.extinction;
            insertSolidHit(SolidHit(hit.t, change, gain));
        } else {
            vec3 t = surfaceTransmittance(triangle, material, hit.weights);
            takeSurface(hit.t, map.hasCaustics != 0u ? gatherLight(t, gain) : t,
                        kTriangleIds | triangle.id);
        }
    }
    vec3 extinction = vec3(0);
    for (uint i = 0u; i + 1u < solidHitCount; ++i) {
        extinction += solidHits[i].extinction;
        float l = solidHits[i + 1u].t - solidHits[i].t;
        if (l <= 0.0 || max(extinction.x, max(extinction.y, extinction.z)) <= 1e-12) continue;
        vec3 depth = max(extinction, 0.0) * l;
        if (map.hasCaustics != 0u)
            depth = -log(max(gatherLight(exp(-depth), solidHits[i].gain), 1e-30));
        takePiece(solidHits[i].t, solidHits[i + 1u].t, depth, kSolidIds | i);
    }
}

void walkCasters(ShadowMap map, uint tile, Ray ray) {
    walkSpheres(map, tile, ray);
    walkBoxes(map, tile, ray);
    walkTriangles(map, tile, ray);
}

#endif
