// SPDX-License-Identifier: Apache-2.0
// Media of constant density under light that does not vary along a ray: running sums of extinction
// and source with an integer count, reset in free space.
#ifndef BRUME_OIT_LINKED_LIST_CONSTANT_GLSL
#define BRUME_OIT_LINKED_LIST_CONSTANT_GLSL
#include "surfaces.glsl"

// What a medium of density 1 does to a ray: its extinction and its source do not vary along it.
struct RayMedium {
    vec3 extinction;  // 1/m
    vec3 source;      // radiance per metre
};

RayMedium makeRayMedium(uint index, uint shares) {
    MediumData medium = media[index];
    vec3 light = scatteredRadiance(medium, shares, vec3(0), rayDirection);
    return RayMedium(medium.extinction,
                     medium.extinction * medium.albedo * light + medium.emission);
}

// The first media are worked out once per ray; scenes with more, or with spheres that have shadows
// of their own, work theirs out at every event.
const bool kKeepsMedia = kMediumCount > 0u && !kWholeShadows;
RayMedium keptMedia[kKeptMedia];

void keepMedia() {
    if (!kKeepsMedia) return;
    for (uint i = 0u; i < kMediumCount; ++i) keptMedia[i] = makeRayMedium(i, kNoShares);
}

RayMedium findRayMedium(uint index, uint shares) {
    if (!kKeepsMedia) return makeRayMedium(index, shares);
    RayMedium medium = keptMedia[0];
    for (uint i = 1u; i < kMediumCount; ++i)
        if (index == i) medium = keptMedia[i];
    return medium;
}

// Extinction and source of the interval that an entry stands for.
RayMedium loadRayMedium(uvec2 entry) {
    uint index = entry.y & kIndexMask;
    uint mediumIndex, shares = kNoShares;
    float density;
    vec3 tint = vec3(1);
    if (kBoxes && (entry.y >> kKindShift) == kKindBox) {
        mediumIndex = volumes[boxes[index].volume].medium;
        density = boxes[index].value;
    } else {
        mediumIndex = spheres[index].medium;
        density = spheres[index].density;
        tint = spheres[index].tint;
        shares = spheres[index].shares;
    }
    iterations += kKeepsMedia ? 0u : frame.lightCount;
    RayMedium medium = findRayMedium(mediumIndex, shares);
    return RayMedium(medium.extinction * density, tint * density * medium.source);
}

// The open intervals' ends, sorted, live in list[state.open .. state.medium): the entries there are
// used up. Equal spheres end in the order in which they begin, so that most ends are appended.
void insertEnd(uvec2 end) {
    uint slot = state.medium;
    while (slot > state.open) {
        uvec2 previous = loadEntry(slot - 1u);
        ++iterations;
        if (previous.x <= end.x) break;
        storeEntry(slot, previous);
        --slot;
    }
    storeEntry(slot, end);
}

void enterMedium(uvec2 entry, Real end) {
    RayMedium medium = loadRayMedium(entry);
    addToSums(state.media, 1.0, medium.extinction, medium.source);
    insertEnd(uvec2(distanceKey(float(end)), entry.y));
    ++state.medium;
}

void leaveMedium(uvec2 entry) {
    RayMedium medium = loadRayMedium(entry);
    addToSums(state.media, -1.0, medium.extinction, medium.source);
    ++state.open;
}

void crossTo(Real event, vec3 solidLight) {
    vec3 extinction = state.media.extinctionHi + state.media.extinctionLo;
    vec3 source = state.media.sourceHi + state.media.sourceLo;
    if (kSolids) {
        extinction += state.solids.extinctionHi + state.solids.extinctionLo;
        source += (state.solids.sourceHi + state.solids.sourceLo) * solidLight;
    }
    crossConstant(state.path, extinction, source, max(float(event - position), 0.0));
    position = max(position, event);
}

// From where the state says to the end of the ray, or of the round.
void walkConstant(Real limit) {
    keepMedia();
    MediumData isotropic = MediumData(vec3(0), kPhaseIsotropic, vec3(0), 0.0, vec3(0));
    vec3 solidLight = kSolids ? scatteredRadiance(isotropic, kNoShares, vec3(0), rayDirection) : vec3(0);
    uvec2 enter = mediumEntry(), surface = surfaceEntry();
    uvec2 leave = state.open < state.medium ? loadEntry(state.open) : kNoEntry;
    while (iterations <= kIterationsPerRound) {
        ++iterations;
        // The lists are in order of rounded distances; which head is next is decided finely.
        Real2 entering = enter.x == kNoEntry.x ? Real2(kFar) : intersectMedium(enter);
        Real leaving = leave.x == kNoEntry.x ? Real(kFar) : intersectMedium(leave).y;
        Real cross = kSurfaces ? surfaceDistance(surface) : Real(kFar);
        Real event = min(min(entering.x, leaving), min(cross, limit));
        crossTo(event, solidLight);
        if (event >= limit || canStop(state.path)) {
            state.stage = kStageDone;
            break;
        }
        if (kSurfaces && cross < min(entering.x, leaving)) {
            crossSurface(state.path, state.solids, loadRecord(surface));
            ++state.surface;
            surface = surfaceEntry();
            continue;
        }
        if (entering.x <= leaving) {
            enterMedium(enter, entering.y);
            enter = mediumEntry();
        } else {
            leaveMedium(leave);
        }
        leave = state.open < state.medium ? loadEntry(state.open) : kNoEntry;
    }
}

#endif
