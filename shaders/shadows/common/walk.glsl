// SPDX-License-Identifier: Apache-2.0
// Visits all that takes some light away along the ray of a texel, in pieces; opaque surfaces are
// left to the map of their own. The including shader defines
//   void takePiece(float t0, float t1, vec3 depth, uint id)   of a medium, constant density
//   void takeSurface(float t, vec3 transmittance, uint id)    thin
//   bool hasRoom(uint pieces)         for what the next caster may be taken in
//   void finishPieces(bool isLast)    when there is none, and at the end
// and counts the turns of its own loops in shadowIterations: a walk that takes long goes on in the
// next round, with what beginRound() and endRound() keep per texel.
// Pieces of one medium interval share an id and come in order; different ones in any order, which
// is the same in every run and for every order of submission.
#ifndef BRUME_SHADOWS_COMMON_WALK_GLSL
#define BRUME_SHADOWS_COMMON_WALK_GLSL
#include "casters.glsl"

const uint kSmoothPieces = 3u;  // of a smooth sphere
const uint kBoxPieces = 32u;    // more than a ray crosses cells of a brick

// A smooth sphere as three pieces, or as one if it is thin: optical depth stays within 2.4 % of the
// sphere's, or 4 %. The outer ones are narrower than what they stand for, whose ends are thin.
void walkSphere(SphereData sphere, Ray ray) {
    vec2 t;
    if (!hitShadowSphere(ray, sphere, t)) return;
    const float kInner = 0.47, kOuter = 0.85, kOuterOfOne = 0.65;  // of half the chord
    const float kThin = 0.1;
    vec3 extinction = media[sphere.medium].extinction;
    vec3 whole = extinction * sphereDensityLength(ray, sphere, t);
    bool isSmooth = sphere.profile != kProfileConstant;
    bool isOne = !isSmooth || max(whole.x, max(whole.y, whole.z)) < kThin;
    uint pieces = isOne ? 1u : kSmoothPieces;
    bool isCut = t.x <= 0.0;  // the ray begins inside
    float outer = isCut || !isSmooth ? 1.0 : isOne ? kOuterOfOne : kOuter;
    float middle = 0.5 * (t.x + t.y), reach = 0.5 * (t.y - t.x);
    for (uint i = 0u; i < pieces; ++i) {
        vec2 part = vec2(i == 0u   ? -1.0
                         : i == 1u ? -kInner
                                   : kInner,
                         i + 1u == pieces ? 1.0
                         : i == 0u        ? -kInner
                                          : kInner);
        vec2 range = middle + reach * clamp(part, -outer, outer);
        vec2 length = clamp(middle + reach * part, t.x, t.y);
        vec3 depth = isOne ? whole : extinction * sphereDensityLength(ray, sphere, length);
        takePiece(range.x, range.y, depth, sphere.id);
        ++shadowIterations;
    }
}

struct BoxHit {
    BoxData box;
    LocalRay local;
    vec3 extinction;
    vec2 t;
    uint id;
};

bool hitShadowBox(ShadowMap map, uint index, Ray ray, out BoxHit hit) {
    hit.box = ShadowBoxes(map.boxes).at[index];
    VolumeData volume = ShadowVolumes(map.volumes).at[hit.box.volume];
    hit.local = shadowLocalRay(ray, hit.box, volume);
    hit.extinction = media[volume.medium].extinction;
    bool isShared = hit.box.kind == kBoxBrick && hit.box.volume < kSharedVolumes;
    hit.id = isShared ? kVolumeIds + hit.box.volume : kBoxIds | index;
    return intersectBox(hit.local.origin, hit.local.direction, hit.box.size, hit.t);
}

void walkBox(BoxHit hit) {
    float position = hit.t.x, from = hit.t.x;
    vec3 depth = vec3(0);
    for (int i = 0; i < 64 && position < hit.t.y; ++i) {
        float target = min(nextPlane(hit.box, hit.local, position), hit.t.y);
        vec3 added = hit.extinction * cellDensityLength(hit.box, hit.local, position, target);
        // Empty cells end a piece: it would smear what is behind them.
        bool isEmpty = max(added.x, max(added.y, added.z)) == 0.0;
        float end = isEmpty ? position : target;
        depth += added;
        bool isDone =
            isEmpty || target >= hit.t.y || max(depth.x, max(depth.y, depth.z)) >= kPieceDepth;
        // One call: the including shader's function is long, and copied for each.
        if (isDone && from < end) takePiece(from, end, depth, hit.id);
        if (isDone) {
            from = target;
            depth = vec3(0);
        }
        position = target;
        ++shadowIterations;
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

bool isTired() { return shadowIterations >= kTurnsPerRound; }

// From the caster with that number in the tile's list on: spheres, boxes, triangles, and what
// solids are between their triangles. Returns where it has stopped. What `isWhole` says is not
// interrupted: the boxes of a tile.
//
// Some devices work through both sides of an if, with all texels that they look at together.
// Therefore each kind has a loop of its own, cells are walked when each ray has found its next box,
// and pieces are finished when many have come together.
uint walkCasters(ShadowMap map, uint tile, Ray ray, uint from, const bool isWhole) {
    uvec2 spheres =
        uvec2(UintArray(map.sphereOffsets).at[tile], UintArray(map.sphereOffsets).at[tile + 1u]);
    uvec2 boxes =
        uvec2(UintArray(map.boxOffsets).at[tile], UintArray(map.boxOffsets).at[tile + 1u]);
    uvec2 triangles = uvec2(UintArray(map.triangleOffsets).at[tile],
                            UintArray(map.triangleOffsets).at[tile + 1u]);
    uint firstBox = spheres.y - spheres.x, firstTriangle = firstBox + boxes.y - boxes.x;
    uint last = firstTriangle + triangles.y - triangles.x;
    uint lastPause = isWhole ? firstBox : firstTriangle;
    solidHitCount = 0u;
    uint i = from;
    bool pauses = false;
    while (i <= last && !pauses) {
        for (; i < firstBox && hasRoom(kSmoothPieces) && !isTired(); ++i) {
            uint index = UintArray(map.spherePairs).at[spheres.x + i];
            walkSphere(ShadowSpheres(map.spheres).at[index], ray);
            shadowIterations += 2u;
        }
        while (i >= firstBox && i < firstTriangle && hasRoom(kBoxPieces) &&
               (isWhole || !isTired())) {
            BoxHit hit;
            bool isMet = false;
            for (; i < firstTriangle && !isMet && (isWhole || !isTired()); ++i) {
                uint index = UintArray(map.boxPairs).at[boxes.x + i - firstBox];
                isMet = hitShadowBox(map, index, ray, hit);
                ++shadowIterations;
            }
            for (bool isOne = isMet; isOne; isOne = false) walkBox(hit);
            ++shadowIterations;
        }
        for (; i >= firstTriangle && i < last && hasRoom(1u); ++i) {
            uint index = UintArray(map.trianglePairs).at[triangles.x + i - firstTriangle];
            walkTriangle(map, ShadowTriangles(map.triangles).at[index], ray);
            shadowIterations += 2u;
        }
        for (; i == last && hasRoom(kMaxSolidHits); ++i) walkSolids(map);
        pauses = i <= lastPause && isTired();
        finishPieces(i > last || pauses);
        ++shadowIterations;
    }
    return pauses ? i : kAllCasters;
}

#endif
