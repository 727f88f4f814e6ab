// SPDX-License-Identifier: Apache-2.0
// Media whose density varies along the ray, or light that does: between events (a medium begins or
// ends, the ray crosses a voxel plane) every density is a polynomial of degree <= 4, so that
// Gauss's rule gives the optical depth exactly.
#ifndef BRUME_OIT_LINKED_LIST_VARYING_GLSL
#define BRUME_OIT_LINKED_LIST_VARYING_GLSL
#include "../../common/density.glsl"
#include "../integrate/light_steps.glsl"
#include "../integrate/quadrature.glsl"
#include "surfaces.glsl"

// The open media live in list[0 .. state.open), the first state.openBoxes of them boxes, each as
// (bits of its end, kind and index): the entries there are used up. Boxes and spheres are visited
// by loops of their own, because on some devices a branch that is not taken costs as much as one
// that is.
//
// A place on the ray is the distance of the last event, `position`, and an offset behind it.

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

// Media are gathered in groups of this many: each light and medium is then loaded once per step
// and not once per open interval.
const uint kGroup = 4u;

struct Gathered {
    float density[kGroup * kNodeCount];  // summed over the open intervals of a medium
    vec3 tinted[kGroup * kNodeCount];    // the same times their tints; kNodeCount * medium + node
    float share;                         // as in Nodes
};

void addToGroup(inout Gathered sum, uint base, uint medium, float densities[kNodeCount],
                vec3 tint) {
    for (uint g = 0u; g < kGroup; ++g) {
        float own = medium == base + g ? 1.0 : 0.0;
        for (uint k = 0u; k < kNodeCount; ++k) {
            sum.density[kNodeCount * g + k] += own * densities[k];
            sum.tinted[kNodeCount * g + k] += (own * densities[k]) * tint;
        }
    }
}

void gatherBox(inout Gathered sum, uint base, BoxData box, float from, float distance) {
    VolumeData volume = volumes[box.volume];
    LocalRay local = localRay(ray, box, volume, position);
    BoxDensity density = makeBoxDensity(box, local, from + 0.5 * distance);
    float densities[kNodeCount];
    for (uint k = 0u; k < kNodeCount; ++k)
        densities[k] = boxDensity(density, from + distance * kNodes[k]);
    addToGroup(sum, base, volume.medium, densities, vec3(1));
}

void gatherSphere(inout Gathered sum, uint base, SphereData sphere, float from, float distance) {
    SphereDensity density = makeSphereDensity(ray, sphere, position);
    float densities[kNodeCount];
    for (uint k = 0u; k < kNodeCount; ++k)
        densities[k] = sphereDensity(density, from + distance * kNodes[k]);
    addToGroup(sum, base, sphere.medium, densities, sphere.tint);
    float chord = max(density.behind + density.ahead, 1e-30);
    sum.share = max(sum.share, density.smoothScale > 0.0 ? distance / chord : 0.0);
}

// The open media over the step from offset `from`.
Gathered gatherOpen(uint base, float from, float distance) {
    Gathered sum;
    for (uint g = 0u; g < kGroup * kNodeCount; ++g) {
        sum.density[g] = 0.0;
        sum.tinted[g] = vec3(0);
    }
    sum.share = 0.0;
    if (kBoxes)
        for (uint i = 0u; i < state.openBoxes; ++i)
            gatherBox(sum, base, boxes[loadEntry(i).y & kIndexMask], from, distance);
    for (uint i = kBoxes ? state.openBoxes : 0u; i < state.open; ++i)
        gatherSphere(sum, base, spheres[loadEntry(i).y & kIndexMask], from, distance);
    return sum;
}

// Radiance that the media of a group scatter towards the eye per unit of optical depth and albedo,
// at the nodes: kNodeCount * medium + node; and what an isotropic medium would.
struct Scattered {
    vec3 group[kGroup * kNodeCount];
    vec3 isotropic[kNodeCount];
};

Scattered scatterGroup(uint base, float from, float distance) {
    Scattered scattered;
    uint phases[kGroup];
    float cosines[kGroup];
    for (uint g = 0u; g < kGroup; ++g) {
        phases[g] = media[min(base + g, max(frame.mediumCount, 1u) - 1u)].phase;
        cosines[g] = media[min(base + g, max(frame.mediumCount, 1u) - 1u)].g;
    }
    for (uint g = 0u; g < kGroup * kNodeCount; ++g) scattered.group[g] = frame.ambient;
    for (uint k = 0u; k < kNodeCount; ++k) scattered.isotropic[k] = frame.ambient;
    for (uint i = 0u; i < frame.lightCount; ++i) {
        LightData light = lights[i];
        vec3 irradiance, travel;
        for (uint k = 0u; k < kNodeCount; ++k) {
            float t = min(float(position) + from + distance * kNodes[k], 1e6);
            // Directional light is the same at all nodes.
            if (kVaryingLight || k == 0u)
                irradiance = lightIrradiance(light, i, vec3(ray.origin) + rayDirection * t, travel);
            float cosTheta = -dot(travel, rayDirection);
            scattered.isotropic[k] += irradiance * phaseIsotropic();
            for (uint g = 0u; g < kGroup; ++g)
                scattered.group[kNodeCount * g + k] +=
                    irradiance * phaseFunction(phases[g], cosines[g], cosTheta);
        }
    }
    return scattered;
}

void addGroup(inout Nodes nodes, uint base, Gathered sum, Scattered scattered) {
    for (uint g = 0u; g < kGroup; ++g) {
        MediumData medium = media[min(base + g, max(frame.mediumCount, 1u) - 1u)];
        vec3 scattering = medium.extinction * medium.albedo;
        for (uint k = 0u; k < kNodeCount; ++k) {
            uint i = kNodeCount * g + k;
            nodes.extinction[k] += medium.extinction * sum.density[i];
            nodes.source[k] += sum.tinted[i] * (scattering * scattered.group[i] + medium.emission);
        }
    }
    nodes.share = max(nodes.share, sum.share);
}

// Extinction and source of everything that is open, at the nodes of the step from offset `from`.
Nodes evaluateNodes(float from, float distance) {
    Nodes nodes;
    nodes.share = 0.0;
    Scattered scattered = scatterGroup(0u, from, distance);
    uint groups = (frame.mediumCount + kGroup - 1u) / kGroup;
    iterations += groups * (1u + state.open + frame.lightCount) + shadowIterations;
    shadowIterations = 0u;
    for (uint k = 0u; k < kNodeCount; ++k) {
        nodes.extinction[k] = nodes.source[k] = vec3(0);
        if (kSurfaces) {
            nodes.extinction[k] = state.solids.extinctionHi + state.solids.extinctionLo;
            nodes.source[k] =
                (state.solids.sourceHi + state.solids.sourceLo) * scattered.isotropic[k];
        }
    }
    if (frame.mediumCount > 0u) {
        addGroup(nodes, 0u, gatherOpen(0u, from, distance), scattered);
        for (uint base = kGroup; base < frame.mediumCount; base += kGroup)
            addGroup(nodes, base, gatherOpen(base, from, distance),
                     scatterGroup(base, from, distance));
    }
    return nodes;
}

// Where the open medium ends that ends first.
Real findNextEnd(out uint leaving) {
    uvec2 first = kNoEntry;
    leaving = 0u;
    for (uint i = 0u; i < state.open; ++i) {
        uvec2 entry = loadEntry(i);
        if (entry.x < first.x) first = entry, leaving = i;
    }
    iterations += state.open;
    return first.x == kNoEntry.x ? Real(kFar) : intersectMedium(first).y;
}

// How far the next step may go, from state.offset to at most `last`.
float limitStep(float last) {
    float target = last;
    if (kBoxes)
        for (uint i = 0u; i < state.openBoxes; ++i) {
            BoxData box = boxes[loadEntry(i).y & kIndexMask];
            LocalRay local = localRay(ray, box, volumes[box.volume], position);
            target = min(target, nextPlane(box, local, state.offset));
        }
    iterations += state.openBoxes + (kVaryingLight ? frame.lightCount : 0u);
    if (kVaryingLight)
        target = min(target, state.offset + limitStepByLights(vec3(ray.origin), rayDirection,
                                                       float(position) + state.offset));
    return max(min(target, state.offset + state.stepLimit), state.offset);
}

// One step towards the offset `last`; true if that is reached.
bool stepTowards(float last) {
    if (state.open == 0u && state.solids.count <= 0) return true;
    float target = limitStep(last), distance = target - state.offset;
    if (distance > 0.0) {
        float error = crossVarying(state.path, evaluateNodes(state.offset, distance), distance);
        state.stepLimit = distance * scaleStep(error);
        if (error > 1.0) return false;
    } else {
        state.stepLimit = kFar;
    }
    state.offset = target;
    return target >= last;
}

// From where the state says to the end of the ray, or of the round.
void walkVarying(Real limit) {
    uvec2 enter = mediumEntry(), surface = surfaceEntry();
    uint leavingIndex;
    Real leaving = findNextEnd(leavingIndex);
    while (iterations <= kIterationsPerRound) {
        ++iterations;
        Real2 entering = enter.x == kNoEntry.x ? Real2(kFar) : intersectMedium(enter);
        Real cross = kSurfaces ? surfaceDistance(surface) : Real(kFar);
        Real event = max(min(min(entering.x, leaving), min(cross, limit)), position);
        bool isReached = stepTowards(float(event - position));
        if (isOpaque(state.path) || (isReached && event >= limit)) {
            state.stage = kStageDone;
            break;
        }
        if (!isReached) continue;
        position = event;
        state.offset = 0.0;
        state.stepLimit = kFar;

        if (kSurfaces && cross < min(entering.x, leaving)) {
            crossSurface(state.path, state.solids, loadRecord(surface));
            ++state.surface;
            surface = surfaceEntry();
            continue;
        }
        if (entering.x <= leaving) {
            bool isBox = (enter.y >> kKindShift) == kKindBox;
            uvec2 open = uvec2(distanceKey(float(entering.y)), enter.y);
            ++state.medium;
            enter = mediumEntry();
            openMedium(open, isBox);
        } else {
            closeMedium(leavingIndex);
        }
        leaving = findNextEnd(leavingIndex);
    }
}

#endif
