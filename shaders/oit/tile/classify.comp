// SPDX-License-Identifier: Apache-2.0
// Finds out what each tile needs. Its list may be composited in order if, at each pixel, a medium
// begins behind all those of other sources before it in the list; media of one source may overlap
// in any order, because what they send is one and the same function of their summed depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/shadowing.glsl"
#include "column.glsl"

layout(constant_id = 6) const bool kOverlap = true;  // false: taken as one behind the other

// The media last met that share a source, and where they and those before them end.
struct Run {
    uint medium;
    vec3 tint;
    uint shares;
    float reach;
    float reachBefore;
};

Run runs[kRows];
bool isMixed = false;  // media of different sources overlap, or their order is another
bool needsLists = false;

void meetSphere(uint row, SphereData sphere) {
    Chord chord = findChord(rays[row], limits[row], sphere);
    if (chord.span <= 0.0) return;
    bool isSame = runs[row].medium == sphere.medium && runs[row].tint == sphere.tint &&
                  (!kWholeShadows || runs[row].shares == sphere.shares);
    if (!isSame) {
        runs[row].reachBefore = max(runs[row].reachBefore, runs[row].reach);
        runs[row].medium = sphere.medium;
        runs[row].tint = sphere.tint;
        runs[row].shares = sphere.shares;
    }
    const float kMargin = 1.000001;  // rounding must not hide an overlap
    isMixed = isMixed || chord.enter < runs[row].reachBefore * kMargin;
    runs[row].reach = max(runs[row].reach, chord.enter + chord.span);
}

void main() {
    uint tile;
    if (!beginColumn(tile)) return;
    [[unroll]] for (uint row = 0u; row < kRows; ++row) runs[row] = Run(~0u, vec3(0), 0u, 0.0, 0.0);
    uint k = UintArray(push.sphereOffsets).at[tile];
    uint last = UintArray(push.sphereOffsets).at[tile + 1u];
    bool isEmpty = k == last;
    needsLists = last - k > kTileLongestList;
    last = min(last, k + kTileLongestList);
    uint before = 0u;
    bool isSmooth = false;
    while (k < last) {
        uint index = UintArray(push.spherePairs).at[k];
        ++k;
        needsLists = needsLists || index < before;  // the list could not be sorted
        before = index;
        SphereData sphere = spheres[index];
        isSmooth = isSmooth || (kSmooth && sphere.profile == kProfileSmooth);
        if (!kOneSource && kOverlap) [[unroll]]
            for (uint row = 0u; row < kRows; ++row) meetSphere(row, sphere);
    }
    k = UintArray(push.boxOffsets).at[tile];
    last = UintArray(push.boxOffsets).at[tile + 1u];
    bool hasBoxes = k < last;
    bool areBoxesEasy = kOneSource || (kOneMedium && isEmpty);  // classify_boxes.comp says more
    needsLists = needsLists || (hasBoxes && !areBoxesEasy) || last - k > kTileLongestList;
    last = min(last, k + kTileLongestList);
    for (before = 0u; k < last; ++k) {
        uint index = UintArray(push.boxPairs).at[k];
        needsLists = needsLists || index < before;
        before = index;
    }
    needsLists = needsLists || (isMixed && (isSmooth || hasBoxes));
    uint needed = needsLists ? kClassLists
                  : isMixed  ? kClassMix
                  : hasBoxes ? kClassVolumes
                  : isEmpty  ? kClassEmpty
                             : kClassOrdered;
    atomicMax(UintArray(push.classes).at[tile], needed);
}
