// SPDX-License-Identifier: Apache-2.0
// Composites the list of each pixel front to back, exactly: media add up where they overlap.
// Two forms: running sums where every medium and light is constant along the ray, and quadrature
// over the set of open media where densities or light vary.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/chords.glsl"
#include "../../common/lighting.glsl"
#include "pixels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kSurfaces = true;
layout(constant_id = 1) const bool kBoxes = true;
layout(constant_id = 2) const bool kVarying = true;       // densities or light vary along the ray
layout(constant_id = 3) const bool kVaryingLight = true;  // point or spot lights
layout(constant_id = 4) const bool kColoured = true;      // extinction differs between channels
layout(constant_id = 5) const bool kRounds = true;        // more than one: keep states
layout(constant_id = 6) const uint kMediumCount = kKeptMedia;  // 0: more than kKeptMedia
layout(constant_id = 7) const bool kSolids = true;        // among the surfaces
layout(binding = kBindingSpheres, scalar) readonly buffer Spheres { SphereData spheres[]; };
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(binding = kBindingOpaqueColor) uniform sampler2D opaqueColor;
layout(binding = kBindingResult, rgba32f) writeonly uniform image2D result;
layout(buffer_reference, scalar) buffer StateArray { PixelState at[]; };

// Where the sky is: 2^100, the same number as float and as double.
const float kFar = 1267650600228229401496703205376.0;
const uvec2 kNoEntry = uvec2(0x71800000u, 0u);  // at kFar

RealRay ray;
vec3 rayDirection;  // rounded
Uvec2Array entries;   // of the tile
uint64_t records;     // address of the tile's
uint first;       // of the list
uint mediaCount;  // its first part
uint count;       // with the surfaces that are stored
uint iterations = 0u;
PixelState state;
Real position;  // of the last event; kept in the state between rounds

uvec2 loadEntry(uint i) { return entries.at[first + i]; }
void storeEntry(uint i, uvec2 entry) { entries.at[first + i] = entry; }
SolidRecord loadRecord(uvec2 entry) {
    uint index = entry.y & kIndexMask;
    if (kSolids) return SolidRecordArray(records).at[index];
    return SolidRecord(RecordArray(records).at[index], vec3(0), vec3(0), kFaceThin);
}

uvec2 mediumEntry() { return state.medium < mediaCount ? loadEntry(state.medium) : kNoEntry; }
uvec2 surfaceEntry() {
    return kSurfaces && state.surface < count ? loadEntry(state.surface) : kNoEntry;
}

// The interval of a medium on the ray.
Real2 intersectMedium(uvec2 entry) {
    uint index = entry.y & kIndexMask;
    if (kBoxes && (entry.y >> kKindShift) == kKindBox)
        return boxChord(ray, boxes[index], volumes[boxes[index].volume]);
    return sphereChord(ray, spheres[index]);
}

Real surfaceDistance(uvec2 entry) {
    float lo = entry.x == kNoEntry.x ? 0.0 : loadRecord(entry).surface.distanceLo;
    return makeReal(uintBitsToFloat(entry.x), lo);
}

#include "early_stop.glsl"
#include "constant.glsl"
#include "sort.glsl"
#include "varying.glsl"

// Solids around the eye: what the ray leaves without having entered it, seen over the whole list,
// also behind opaque surfaces (Barta & Kovacs 2011, section 3.5, the backward pass).
Sums findSolidsAroundEye() {
    Sums solids = noSums();
    for (uint i = mediaCount; i < count; ++i) {
        SolidRecord record = loadRecord(loadEntry(i));
        if (record.face == kFaceThin) continue;
        float sign = record.face == kFaceBack ? 1.0 : -1.0;
        solids.count += record.face == kFaceBack ? 1 : -1;
        addExactly(solids.extinctionHi, solids.extinctionLo, sign * record.extinction);
        addExactly(solids.sourceHi, solids.sourceLo, sign * record.scattering);
    }
    iterations += count - mediaCount;
    return solids.count > 0 ? solids : noSums();
}

void beginState(bool isUnsorted) {
    state.stage = isUnsorted ? kStageSortMedia : kSurfaces ? kStageSortSurfaces : kStageWalk;
    state.at = state.medium = state.open = state.openBoxes = 0u;
    state.surface = mediaCount;
    position = Real(0);
    state.offset = 0.0;
    state.stepLimit = kFar;
    state.path = beginPath();
    state.media = noSums();
    state.solids = kSolids ? findSolidsAroundEye() : noSums();
}

void advance(Real limit) {
    if (state.stage == kStageSortMedia && sortList(0u, mediaCount)) {
        state.stage = kSurfaces ? kStageSortSurfaces : kStageWalk;
        state.at = 0u;
    }
    if (kSurfaces && state.stage == kStageSortSurfaces && sortList(mediaCount, count))
        state.stage = kStageWalk;
    if (state.stage == kStageWalk) {
        if (kVarying)
            walkVarying(limit);
        else
            walkConstant(limit);
    }
    // The device has ended the loops, nobody knows where.
    if (state.stage != kStageDone && iterations <= kIterationsPerRound) state.stage = kStageLost;
}

void main() {
    uint slot, tile;
    bool isInBand =
        findSlot(gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, slot, tile);
    uvec2 pixel = tileCorner(tile) + gl_LocalInvocationID.xy;
    if (!isInBand || any(greaterThanEqual(pixel, frame.size))) return;
    uint index = slot * 64u + gl_LocalInvocationIndex;
    uint listIndex = slot * kTileOffsets + gl_LocalInvocationIndex;
    entries = entriesOf(slot);
    if (kSurfaces) records = recordsOf(slot);
    first = UintArray(push.offsets).at[listIndex];
    count = UintArray(push.offsets).at[listIndex + 1u] - first;
    mediaCount = count;
    if (kSurfaces) {
        uint firstSurface = UintArray(push.surfaceOffsets).at[listIndex];
        uint room = UintArray(push.surfaceOffsets).at[listIndex + 1u] - firstSurface;
        mediaCount -= room;
        count = mediaCount + min(UintArray(push.surfaceCursors).at[index] - firstSurface, room);
    }
    ray = makeRealRay(vec2(pixel) + 0.5);
    rayDirection = vec3(ray.direction);
    Real limit = Real(min(texelFetch(opaqueT, ivec2(pixel), 0).x, kFar));

    if (kRounds && push.step > 0u) {
        state = StateArray(push.states).at[index];
        if (state.stage >= kStageDone) return;
        position = makeReal(state.position, state.positionLo);
    } else {
        beginState((UintArray(push.progress).at[index] & kUnsortedBit) != 0u);
    }
    vec3 behind = texelFetch(opaqueColor, ivec2(pixel), 0).rgb;
    allowStop(behind);
    advance(limit);
    vec3 rest = state.path.surfaces * state.path.decay;
    vec3 radiance = state.path.radiance + rest * behind;
    imageStore(result, ivec2(pixel), vec4(radiance, 1.0));
    if (kRounds) {
        state.position = float(position);
        state.positionLo = findLo(position);
        StateArray(push.states).at[index] = state;
    }
    if (push.epsilon > 0.0 && canStop(state.path)) countStop(state.path);
    if (state.stage != kStageDone && push.step + 1u == push.roundCount)
        atomicAdd(CounterBlock(push.counters).counters.exhausted, 1u);
}
