// SPDX-License-Identifier: Apache-2.0
// Visits all that takes some light away along the ray of a texel, in pieces; opaque surfaces are
// left to the map of their own. The including shader defines
//   void takePiece(float t0, float t1, vec3 depth, uint id)   of a medium, constant density
//   void takeSurface(float t, vec3 transmittance, uint id)    thin
//   void finishCaster(bool isLast)   after each caster
// and counts the turns of its own loops in shadowIterations: a walk that takes long goes on in the
// next round, with what beginRound() and endRound() keep per texel.
// Pieces of one medium interval share an id and come in order; different ones in any order, which
// is the same in every run and for every order of submission.
#ifndef BRUME_SHADOWS_COMMON_WALK_GLSL
#define BRUME_SHADOWS_COMMON_WALK_GLSL
#include "casters.glsl"

const uint kSmoothPieces = 6u;  // of a smooth sphere

void walkSphere(SphereData sphere, Ray ray) {
    vec2 t;
    if (!hitShadowSphere(ray, sphere, t)) return;
    vec3 extinction = media[sphere.medium].extinction;
    uint pieces = sphere.profile == kProfileConstant ? 1u : kSmoothPieces;
    float step = (t.y - t.x) / float(pieces);
    for (uint i = 0u; i < pieces; ++i) {
        vec2 part =
            vec2(t.x + float(i) * step, i + 1u < pieces ? t.x + float(i + 1u) * step : t.y);
        takePiece(part.x, part.y, extinction * sphereDensityLength(ray, sphere, part), sphere.id);
        ++shadowIterations;
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
        ++shadowIterations;
    }
}

void walkBoxAt(ShadowMap map, uint index, Ray ray) {
    BoxData box = ShadowBoxes(map.boxes).at[index];
    bool isShared = box.kind == kBoxBrick && box.volume < kSharedVolumes;
    walkBox(box, ShadowVolumes(map.volumes).at[box.volume], ray,
            isShared ? kVolumeIds + box.volume : kBoxIds | index);
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

void walkTriangle(ShadowMap map, ShadowTriangle triangle, Ray ray) {
    ShadowMaterial material = ShadowMaterials(map.materials).at[triangle.material];
    TriangleHit hit;
    if (material.type == kMaterialOpaque || !intersectTriangle(ray, triangle, hit) || hit.t <= 0.0)
        return;
    float gain = map.hasCaustics != 0u
                     ? causticGain(triangle, material.ior, hit.weights, ray.direction)
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

void walkSolids(ShadowMap map) {
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

const uint kAllCasters = 0xffffffffu;
layout(buffer_reference, scalar) buffer Progress { uint at[]; };

// The first caster of this round in the tile's list; kAllCasters: none is left. The store goes on
// from what it has kept where it is not 0.
uint beginRound(ShadowPush push, uint texel) {
    return push.count > 0u ? Progress(push.source).at[texel] : 0u;
}

void endRound(ShadowPush push, uint texel, uint next) { Progress(push.source).at[texel] = next; }

// From the caster with that number in the tile's list on: spheres, boxes, triangles, and what solids
// are between their triangles. Returns where it has stopped. What `isWhole` says is not interrupted:
// the boxes of a tile.
uint walkCasters(ShadowMap map, uint tile, Ray ray, uint from, const bool isWhole) {
    uvec2 spheres = uvec2(UintArray(map.sphereOffsets).at[tile],
                          UintArray(map.sphereOffsets).at[tile + 1u]);
    uvec2 boxes = uvec2(UintArray(map.boxOffsets).at[tile], UintArray(map.boxOffsets).at[tile + 1u]);
    uvec2 triangles = uvec2(UintArray(map.triangleOffsets).at[tile],
                            UintArray(map.triangleOffsets).at[tile + 1u]);
    uint firstBox = spheres.y - spheres.x, firstTriangle = firstBox + boxes.y - boxes.x;
    uint last = firstTriangle + triangles.y - triangles.x;
    uint lastPause = isWhole ? firstBox : firstTriangle;
    solidHitCount = 0u;
    for (uint i = from; i <= last; ++i) {
        // Loops of one turn: some devices work through both sides of an if.
        for (bool isOne = i < firstBox; isOne; isOne = false)
            walkSphere(
                ShadowSpheres(map.spheres).at[UintArray(map.spherePairs).at[spheres.x + i]], ray);
        for (bool isOne = i >= firstBox && i < firstTriangle; isOne; isOne = false)
            walkBoxAt(map, UintArray(map.boxPairs).at[boxes.x + i - firstBox], ray);
        for (bool isOne = i >= firstTriangle && i < last; isOne; isOne = false)
            walkTriangle(map,
                         ShadowTriangles(map.triangles)
                             .at[UintArray(map.trianglePairs).at[triangles.x + i - firstTriangle]],
                         ray);
        for (bool isOne = i == last; isOne; isOne = false) walkSolids(map);
        shadowIterations += 2u;
        bool pauses = i < lastPause && shadowIterations >= kTurnsPerRound;
        finishCaster(i == last || pauses);
        if (pauses) return i + 1u;
    }
    return kAllCasters;
}

#endif
