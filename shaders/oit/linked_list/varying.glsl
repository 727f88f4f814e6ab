// SPDX-License-Identifier: Apache-2.0
// Media whose density varies along the ray, or light that does: between events (a medium begins or
// ends, the ray crosses a voxel plane) every density is a polynomial of degree <= 4, so that
// Gauss's rule gives the optical depth exactly.
#ifndef BRUME_OIT_LINKED_LIST_VARYING_GLSL
#define BRUME_OIT_LINKED_LIST_VARYING_GLSL
#include "../../common/density.glsl"
#include "../integrate/light_nodes.glsl"
#include "../integrate/light_steps.glsl"
#include "surfaces.glsl"

// The open media live in list[0 .. state.open), the first state.openBoxes of them boxes, each as
// (bits of its end, kind and index): the entries there are used up. Boxes and spheres are visited
// by loops of their own, because on some devices a branch that is not taken costs as much as one
// that is.
//
// A place on the ray is the distance of the last event, `position`, and an offset behind it.
//
// Loops over nodes are innermost and unrolled: arrays that others index leave the registers.

void openMedium(uvec2 entry, bool isBox) {
    if (kBoxes && isBox) {
        if (state.openBoxes < state.open) storeEntry(state.open, loadEntry(state.openBoxes));
        storeEntry(state.openBoxes, entry);
        ++state.openBoxes;
    } else {
        storeEntry(state.open, entry);
    }
    ++state.open;
}

void closeMedium(uint index) {
    uint hole = index;
    if (kBoxes && index < state.openBoxes) {
        --state.openBoxes;
        storeEntry(hole, loadEntry(state.openBoxes));
        hole = state.openBoxes;
    }
    --state.open;
    storeEntry(hole, loadEntry(state.open));
}

// Media of one phase function are lit together. A number for each function, in rising order; media
// that scatter nothing have none.
const float kNoPhase = 8.0;

// A medium of density 1.
struct Matter {
    vec3 extinction, scattering;  // 1/m
    vec3 emission;                // radiance per metre
    float phase;                  // key of its phase function
};

Matter loadMatter(uint index) {
    MediumData medium = media[index];
    vec3 scattering = medium.extinction * medium.albedo;
    float key = medium.phase == kPhaseHenyeyGreenstein ? medium.g : 2.0 + float(medium.phase);
    return Matter(medium.extinction, scattering, medium.emission,
                  scattering == vec3(0) ? kNoPhase : key);
}

Matter keptMatter[kKeptMedia];

void keepMatter() {
    [[unroll]] for (uint i = 0u; i < kMediumCount; ++i) keptMatter[i] = loadMatter(i);
}

Matter findMatter(uint index) {
    if (kMediumCount == 0u) return loadMatter(index);
    Matter matter = keptMatter[0];
    [[unroll]] for (uint i = 1u; i < kMediumCount; ++i)
        if (index == i) matter = keptMatter[i];
    return matter;
}

float phaseOfKey(float key, float cosTheta) {
    return phaseFunction(key < 2.0 ? kPhaseHenyeyGreenstein : uint(key - 2.0), key, cosTheta);
}

// What is open, at a place.
struct OpenSet {
    Real leaving;       // where the first of them ends,
    uint leavingIndex;  // in the list
    float plane;        // offset of the next voxel plane
    float phase;        // smallest key
    bool isSampled;     // something that scatters asks for shadows at each place
};

OpenSet scanOpen() {
    bool isSolid = kSolids && state.solids.sourceHi != vec3(0);
    OpenSet set = OpenSet(Real(kFar), 0u, kFar, kNoPhase, isSolid);
    uvec2 first = kNoEntry;
    for (uint i = 0u; i < state.open; ++i) {
        uvec2 entry = loadEntry(i);
        set.leavingIndex = entry.x < first.x ? i : set.leavingIndex;
        first = entry.x < first.x ? entry : first;
        bool isBox = kBoxes && i < state.openBoxes;
        uint index = entry.y & kIndexMask;
        uint medium = isBox ? volumes[boxes[index].volume].medium : spheres[index].medium;
        float phase = findMatter(medium).phase;
        set.phase = min(set.phase, phase);
        bool isWhole = kWholeShadows && !isBox && spheres[index].shares != kNoShares;
        set.isSampled = set.isSampled || (phase < kNoPhase && !isWhole);
    }
    if (kBoxes)
        for (uint i = 0u; i < state.openBoxes; ++i) {
            BoxData box = boxes[loadEntry(i).y & kIndexMask];
            LocalRay local = localRay(ray, box, volumes[box.volume], position);
            set.plane = min(set.plane, nextPlane(box, local, state.offset));
        }
    iterations += state.open + state.openBoxes;
    if (first.x != kNoEntry.x) set.leaving = intersectMedium(first).y;
    return set;
}

// A step from an offset on.
struct Step {
    float from, distance;
    bool isSampled;  // as in OpenSet
};

struct Gathered {
    vec3 extinction[kNodeCount];
    vec3 emission[kNodeCount];    // radiance per metre
    vec3 scattering[kNodeCount];  // of the media of one phase function, 1/m
    vec3 sampled[kNodeCount];     // of those among them that are shadowed at each place
    float share;                  // as in Nodes
    float plane;                  // offset of the next voxel plane behind the step
    float nextPhase;              // the next larger key
};

void addMatter(inout Gathered sum, float phase, Matter matter, float densities[kNodeCount],
               vec3 tint, bool isWhole) {
    vec3 emission = tint * matter.emission;
    vec3 scattering = matter.phase == phase ? tint * matter.scattering : vec3(0);
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        sum.extinction[k] += densities[k] * matter.extinction;
        sum.emission[k] += densities[k] * emission;
        sum.scattering[k] += densities[k] * scattering;
        if (kWholeShadows) sum.sampled[k] += isWhole ? vec3(0) : densities[k] * scattering;
    }
    sum.nextPhase = matter.phase > phase ? min(matter.phase, sum.nextPhase) : sum.nextPhase;
}

void gatherBox(inout Gathered sum, float phase, BoxData box, Step step) {
    VolumeData volume = volumes[box.volume];
    LocalRay local = localRay(ray, box, volume, position);
    BoxDensity density = makeBoxDensity(box, local, step.from + 0.5 * step.distance);
    float densities[kNodeCount];
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k)
        densities[k] = boxDensity(density, step.from + step.distance * kNodes[k]);
    addMatter(sum, phase, findMatter(volume.medium), densities, vec3(1), false);
    sum.plane = min(sum.plane, nextPlane(box, local, step.from + step.distance));
}

void gatherSphere(inout Gathered sum, float phase, SphereData sphere, Step step) {
    SphereDensity density = makeSphereDensity(ray, sphere, position);
    float densities[kNodeCount];
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k)
        densities[k] = sphereDensity(density, step.from + step.distance * kNodes[k]);
    addMatter(sum, phase, findMatter(sphere.medium), densities, sphere.tint,
              sphere.shares != kNoShares);
    float chord = max(density.behind + density.ahead, 1e-30);
    sum.share = max(sum.share, density.smoothScale > 0.0 ? step.distance / chord : 0.0);
}

// The open media over a step; scattering only of those with this phase function.
Gathered gatherOpen(float phase, Step step) {
    Gathered sum;
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k)
        sum.extinction[k] = sum.emission[k] = sum.scattering[k] = sum.sampled[k] = vec3(0);
    sum.share = 0.0;
    sum.plane = kFar;
    sum.nextPhase = kNoPhase;
    if (kBoxes)
        for (uint i = 0u; i < state.openBoxes; ++i)
            gatherBox(sum, phase, boxes[loadEntry(i).y & kIndexMask], step);
    for (uint i = kBoxes ? state.openBoxes : 0u; i < state.open; ++i)
        gatherSphere(sum, phase, spheres[loadEntry(i).y & kIndexMask], step);
    iterations += 1u + state.open;
    return sum;
}

// Scattering of the open spheres of one phase function that are shadowed as a whole, 1/m, times
// their share of light `index`.
struct WholeScattering {
    vec3 at[kNodeCount];
};

WholeScattering gatherWhole(uint index, float phase, Step step) {
    WholeScattering sum;
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) sum.at[k] = vec3(0);
    if (!kWholeShadows) return sum;
    for (uint i = kBoxes ? state.openBoxes : 0u; i < state.open; ++i) {
        SphereData sphere = spheres[loadEntry(i).y & kIndexMask];
        Matter matter = findMatter(sphere.medium);
        bool isCounted = sphere.shares != kNoShares && matter.phase == phase;
        vec3 share = isCounted ? wholeShare(sphere.shares, index) : vec3(0);
        vec3 scattering = share * sphere.tint * matter.scattering;
        SphereDensity density = makeSphereDensity(ray, sphere, position);
        [[unroll]] for (uint k = 0u; k < kNodeCount; ++k)
            sum.at[k] +=
                scattering * sphereDensity(density, step.from + step.distance * kNodes[k]);
    }
    iterations += state.open;
    return sum;
}

// What media of one phase function, and solids, which do so evenly, scatter towards the eye.
struct Scatterers {
    vec3 media[kNodeCount];    // 1/m
    vec3 sampled[kNodeCount];  // as in Gathered
    vec3 solids;
    float phase;
};

void addLight(inout Nodes nodes, Scatterers scatterers, LightNodes light, WholeScattering whole) {
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        vec3 scattering = kWholeShadows ? scatterers.sampled[k] * light.share[k] + whole.at[k]
                                        : scatterers.media[k] * light.share[k];
        nodes.source[k] += light.irradiance[k] *
                           (scattering * phaseOfKey(scatterers.phase, light.cosTheta[k]) +
                            scatterers.solids * light.share[k] * phaseIsotropic());
    }
}

void addLights(inout Nodes nodes, Scatterers scatterers, Step step) {
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k)
        nodes.source[k] += (scatterers.media[k] + scatterers.solids) * frame.ambient;
    LitStep lit = LitStep(vec3(ray.origin) + rayDirection * min(float(position) + step.from, 1e6),
                          rayDirection, min(step.distance, 1e6), step.isSampled);
    bool isLit = scatterers.phase < kNoPhase || scatterers.solids != vec3(0);
    uint lightCount = isLit ? frame.lightCount : 0u;
    for (uint i = 0u; i < lightCount; ++i)
        addLight(nodes, scatterers, makeLightNodes(lights[i], i, lit, kVaryingLight),
                 gatherWhole(i, scatterers.phase, step));
    iterations += (1u + kShadowLookups) * lightCount + shadowIterations;
    shadowIterations = 0u;
}

// Extinction and source of everything that is open, at the nodes of a step. `phase`: smallest key.
// `plane`: offset of the next voxel plane behind the step.
Nodes evaluateNodes(float phase, Step step, out float plane) {
    Nodes nodes;
    vec3 solidExtinction =
        kSolids ? state.solids.extinctionHi + state.solids.extinctionLo : vec3(0);
    vec3 solids = kSolids ? state.solids.sourceHi + state.solids.sourceLo : vec3(0);
    nodes.share = 0.0;
    [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
        nodes.extinction[k] = nodes.source[k] = vec3(0);
    }
    for (bool isFirst = true;; isFirst = false) {
        Gathered sum = gatherOpen(phase, step);
        float first = isFirst ? 1.0 : 0.0;
        [[unroll]] for (uint k = 0u; k < kNodeCount; ++k) {
            nodes.extinction[k] += first * (sum.extinction[k] + solidExtinction);
            nodes.source[k] += first * sum.emission[k];
        }
        nodes.share = sum.share;
        plane = sum.plane;
        addLights(nodes, Scatterers(sum.scattering, sum.sampled, first * solids, phase), step);
        if (sum.nextPhase >= kNoPhase) break;
        phase = sum.nextPhase;
    }
    return nodes;
}

// Steps on to the offset `last`, or to the end of the round; the open set is that at the begin.
void walkTo(OpenSet set, float last) {
    while (iterations <= kIterationsPerRound) {
        ++iterations;
        Step step;
        step.isSampled = set.isSampled;
        step.from = state.offset;
        float target = max(min(min(set.plane, last), step.from + state.stepLimit), step.from);
        step.distance = target - step.from;
        float plane;
        float error =
            crossVarying(state.path, evaluateNodes(set.phase, step, plane), step.distance);
        bool isDone = error <= 1.0;
        state.stepLimit = step.distance > 0.0 ? step.distance * scaleStep(error) : kFar;
        state.offset = isDone ? target : step.from;
        set.plane = isDone ? plane : set.plane;
        if (canStop(state.path) || state.offset >= last) break;
    }
}

// How far from state.offset light can be taken as smooth.
float limitByLights(OpenSet set) {
    bool isLit = set.phase < kNoPhase || (kSolids && state.solids.sourceHi != vec3(0));
    if (!kVaryingLight || !isLit) return kFar;
    iterations += frame.lightCount;
    return limitStepByLights(vec3(ray.origin), rayDirection, float(position) + state.offset,
                             set.isSampled);
}

// From where the state says to the end of the ray, or of the round.
void walkVarying(Real limit) {
    keepMatter();
    uvec2 enter = mediumEntry(), surface = surfaceEntry();
    while (iterations <= kIterationsPerRound) {
        ++iterations;
        OpenSet set = scanOpen();
        Real2 entering = enter.x == kNoEntry.x ? Real2(kFar) : intersectMedium(enter);
        Real cross = kSurfaces ? surfaceDistance(surface) : Real(kFar);
        Real event = max(min(min(entering.x, set.leaving), min(cross, limit)), position);
        float last = max(float(event - position), state.offset);
        walkTo(set, min(last, state.offset + limitByLights(set)));
        bool isReached = state.offset >= last;
        if (canStop(state.path) || (isReached && event >= limit)) {
            state.stage = kStageDone;
            break;
        }
        if (!isReached) continue;
        position = event;
        state.offset = 0.0;
        state.stepLimit = kFar;

        if (kSurfaces && cross < min(entering.x, set.leaving)) {
            crossSurface(state.path, state.solids, loadRecord(surface));
            ++state.surface;
            surface = surfaceEntry();
        } else if (entering.x <= set.leaving) {
            bool isBox = (enter.y >> kKindShift) == kKindBox;
            openMedium(uvec2(distanceKey(float(entering.y)), enter.y), isBox);
            ++state.medium;
            enter = mediumEntry();
        } else {
            closeMedium(set.leavingIndex);
        }
    }
}

#endif
