// SPDX-License-Identifier: Apache-2.0
// Media whose density varies along the ray, or light that does: between events (a medium begins or
// ends, the ray crosses a voxel plane) every density is a polynomial of degree <= 4, so that
// Gauss's rule with three points gives the optical depth exactly.
#ifndef BRUME_OIT_LINKED_LIST_VARYING_GLSL
#define BRUME_OIT_LINKED_LIST_VARYING_GLSL
#include "../../common/density.glsl"
#include "path.glsl"

// Gauss-Legendre nodes and weights on [0, 1], and the integrals of the node polynomials up to each
// node (the Butcher matrix of the three-stage Gauss method).
const float kRoot15 = 3.872983346207417;
const vec3 kNodes = vec3(0.5 - kRoot15 / 10.0, 0.5, 0.5 + kRoot15 / 10.0);
const vec3 kWeights = vec3(5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0);
const mat3 kUpTo = mat3(  // column k: integral from 0 to node k
    5.0 / 36.0, 2.0 / 9.0 - kRoot15 / 15.0, 5.0 / 36.0 - kRoot15 / 30.0,
    5.0 / 36.0 + kRoot15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - kRoot15 / 24.0,
    5.0 / 36.0 + kRoot15 / 30.0, 2.0 / 9.0 + kRoot15 / 15.0, 5.0 / 36.0);

// Of the radiance in one step; and the error of the nodes per variation and fourth power of the
// depth (chosen by us, so that the hard rays of the tests are exact to 1e-5).
const float kAllowedError = 1e-6;
const float kErrorOfDepth = 3e-4;

struct Nodes {
    vec3 extinction[3];
    vec3 source[3];
};

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
    vec3 density[kGroup];     // at the three nodes, summed over the open intervals of a medium
    vec3 tinted[kGroup * 3];  // the same times their tints, 3 * medium + node
};

void addToGroup(inout Gathered sum, uint base, uint medium, vec3 densities, vec3 tint) {
    for (uint g = 0u; g < kGroup; ++g) {
        float own = medium == base + g ? 1.0 : 0.0;
        sum.density[g] += own * densities;
        for (uint k = 0u; k < 3u; ++k) sum.tinted[3u * g + k] += (own * densities[k]) * tint;
    }
}

Gathered gatherOpen(uint base, vec3 offsets) {
    Gathered sum;
    for (uint g = 0u; g < kGroup; ++g) sum.density[g] = vec3(0);
    for (uint g = 0u; g < kGroup * 3u; ++g) sum.tinted[g] = vec3(0);
    if (kBoxes)
        for (uint i = 0u; i < state.openBoxes; ++i) {
            BoxData box = boxes[loadEntry(i).y & kIndexMask];
            VolumeData volume = volumes[box.volume];
            LocalRay local = localRay(ray, box, volume, position);
            addToGroup(sum, base, volume.medium, boxDensities(box, local, offsets), vec3(1));
        }
    for (uint i = kBoxes ? state.openBoxes : 0u; i < state.open; ++i) {
        SphereData sphere = spheres[loadEntry(i).y & kIndexMask];
        addToGroup(sum, base, sphere.medium, sphereDensities(ray, sphere, position, offsets),
                   sphere.tint);
    }
    return sum;
}

// Radiance that the media of a group scatter towards the eye per unit of optical depth and albedo,
// at the three nodes: 3 * medium + node; and what an isotropic medium would.
struct Scattered {
    vec3 group[kGroup * 3];
    vec3 isotropic[3];
};

Scattered scatterGroup(uint base, vec3 t) {
    Scattered scattered;
    uint phases[kGroup];
    float cosines[kGroup];
    for (uint g = 0u; g < kGroup; ++g) {
        phases[g] = media[min(base + g, max(frame.mediumCount, 1u) - 1u)].phase;
        cosines[g] = media[min(base + g, max(frame.mediumCount, 1u) - 1u)].g;
    }
    for (uint g = 0u; g < kGroup * 3u; ++g) scattered.group[g] = frame.ambient;
    for (uint k = 0u; k < 3u; ++k) scattered.isotropic[k] = frame.ambient;
    for (uint i = 0u; i < frame.lightCount; ++i) {
        LightData light = lights[i];
        vec3 irradiance, travel;
        for (uint k = 0u; k < 3u; ++k) {
            // Directional light is the same at all nodes.
            if (kVaryingLight || k == 0u)
                irradiance = lightIrradiance(light, i, vec3(ray.origin) + rayDirection * t[k], travel);
            float cosTheta = -dot(travel, rayDirection);
            scattered.isotropic[k] += irradiance * phaseIsotropic();
            for (uint g = 0u; g < kGroup; ++g)
                scattered.group[3u * g + k] +=
                    irradiance * phaseFunction(phases[g], cosines[g], cosTheta);
        }
    }
    return scattered;
}

void addGroup(inout Nodes nodes, uint base, Gathered sum, Scattered scattered) {
    for (uint g = 0u; g < kGroup; ++g) {
        MediumData medium = media[min(base + g, max(frame.mediumCount, 1u) - 1u)];
        vec3 scattering = medium.extinction * medium.albedo;
        for (int k = 0; k < 3; ++k) {
            nodes.extinction[k] += medium.extinction * sum.density[g][k];
            nodes.source[k] += sum.tinted[3u * g + k] *
                               (scattering * scattered.group[3u * g + k] + medium.emission);
        }
    }
}

// Extinction and source of everything that is open, at three distances.
Nodes evaluateNodes(vec3 offsets) {
    Nodes nodes;
    vec3 t = min(float(position) + offsets, vec3(1e6));
    Scattered scattered = scatterGroup(0u, t);
    uint groups = (frame.mediumCount + kGroup - 1u) / kGroup;
    iterations += groups * (1u + state.open + frame.lightCount) + shadowIterations;
    shadowIterations = 0u;
    for (int k = 0; k < 3; ++k) {
        nodes.extinction[k] = nodes.source[k] = vec3(0);
        if (kSurfaces) {
            nodes.extinction[k] = state.solids.extinctionHi + state.solids.extinctionLo;
            nodes.source[k] =
                (state.solids.sourceHi + state.solids.sourceLo) * scattered.isotropic[k];
        }
    }
    if (frame.mediumCount > 0u) {
        addGroup(nodes, 0u, gatherOpen(0u, offsets), scattered);
        for (uint base = kGroup; base < frame.mediumCount; base += kGroup)
            addGroup(nodes, base, gatherOpen(base, offsets), scatterGroup(base, t));
    }
    return nodes;
}

// The next place ahead at which the ray, `offset` from the apex of a cone, crosses it.
float nextConeCrossing(vec3 offset, vec3 axis, float cosAngle, float slack) {
    float oa = dot(offset, axis), da = dot(rayDirection, axis), c2 = cosAngle * cosAngle;
    float a = da * da - c2, b = oa * da - c2 * dot(offset, rayDirection);
    float c = oa * oa - c2 * dot(offset, offset);
    float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(b * b - a * c, 0.0)));
    float t1 = q / (abs(a) > 1e-20 ? a : 1e-20), t2 = c / (abs(q) > 1e-20 ? q : 1e-20);
    return min(t1 > slack ? t1 : kFar, t2 > slack ? t2 : kFar);
}

// A step short enough for three nodes near a point or spot light: 1/d^2 has its poles at the light,
// and kinks where it is capped at the light's radius and at the cones of a spot, which steps must
// not cross.
float limitStepByLight(LightData light, float place) {
    vec3 offset = light.position - vec3(ray.origin);
    float nearest = dot(offset, rayDirection), ahead = nearest - place;
    vec3 across = offset - nearest * rayDirection;
    float aside2 = dot(across, across);
    float distance = sqrt(ahead * ahead + aside2);
    float chord = sqrt(max(light.radius * light.radius - aside2, 0.0));
    float enter = ahead - chord, leave = ahead + chord, slack = 1e-3 * light.radius;
    float own = ahead > 0.0 ? max(distance / 3.0, 0.5 * sqrt(aside2)) : distance * 0.5;
    if (enter > slack)
        own = min(own, chord > 0.0 ? enter : own);
    else if (leave > slack)
        own = min(leave, 0.5 * light.radius);
    if (light.type == kLightSpot) {
        vec3 fromLight = place * rayDirection - offset;
        float near = 1e-5 * distance;
        own = min(own, nextConeCrossing(fromLight, light.direction, light.cosInner, near));
        own = min(own, nextConeCrossing(fromLight, light.direction, light.cosOuter, near));
    }
    return max(own, slack);
}

float limitStepByLights(float place) {
    float limit = kFar;
    for (uint i = 0u; i < frame.lightCount; ++i)
        limit = min(limit, min(lights[i].type != kLightDirectional
                                   ? limitStepByLight(lights[i], place)
                                   : kFar,
                               shadowStep(i)));
    iterations += frame.lightCount;
    return limit;
}

// Integrates source * exp(-depth) over one step. The mean source radiance is taken exactly; only
// its variation within the step is left to the nodes. Returns the estimated error in units of what
// is allowed; above 1 nothing is done.
float crossVarying(Nodes nodes, float distance) {
    vec3 extinction = vec3(0), source = vec3(0);
    for (int k = 0; k < 3; ++k) {
        extinction += kWeights[k] * nodes.extinction[k];
        source += kWeights[k] * nodes.source[k];
    }
    vec3 depth = min(extinction * distance, vec3(1e30));
    vec3 before = state.path.surfaces * state.path.decay;
    vec3 mean = source / max(extinction, vec3(1e-30));
    vec3 variation = vec3(0), size = vec3(0), deviation = vec3(0);
    for (int k = 0; k < 3; ++k) {
        vec3 depthAtNode =
            distance * (kUpTo[k][0] * nodes.extinction[0] + kUpTo[k][1] * nodes.extinction[1] +
                        kUpTo[k][2] * nodes.extinction[2]);
        vec3 difference = nodes.source[k] - mean * nodes.extinction[k];
        variation += kWeights[k] * difference * expChannels(-max(depthAtNode, 0.0));
        size += kWeights[k] * abs(difference);
        deviation = max(deviation, abs(difference) / max(nodes.extinction[k], vec3(1e-30)));
    }
    // No light comes from where there is nothing, only rounding.
    bvec3 empty = lessThan(depth, vec3(1e-7));
    // What is left to the nodes cannot exceed the deviation of the source radiance from its mean,
    // which in dense media is but rounding; of that they get more wrong the deeper the step.
    vec3 bound = min(mix(size * distance, vec3(0), empty), deviation);
    variation = clamp(variation * distance, -bound, bound);
    vec3 error = before * bound * min(kErrorOfDepth * depth * depth * depth * depth, vec3(1));
    float worst = max(error.x, max(error.y, error.z)) / kAllowedError;
    if (worst > 1.0 && max(depth.x, max(depth.y, depth.z)) > 0.1) return worst;
    crossConstant(state.path, extinction, source, distance);
    state.path.radiance += before * variation;
    return min(worst, 1.0);
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
    iterations += state.openBoxes;
    if (kVaryingLight)
        target = min(target, state.offset + limitStepByLights(float(position) + state.offset));
    return max(min(target, state.offset + state.stepLimit), state.offset);
}

// One step towards the offset `last`; true if that is reached.
bool stepTowards(float last) {
    if (state.open == 0u && state.solids.count <= 0) return true;
    float target = limitStep(last), distance = target - state.offset;
    if (distance > 0.0) {
        float error = crossVarying(evaluateNodes(state.offset + distance * kNodes), distance);
        // The error grows with a high power of the step.
        float scale = clamp(0.9 * pow(max(error, 1e-15), -0.2), 1e-6, 100.0);
        state.stepLimit = distance * (error > 1.0 ? min(scale, 0.5) : scale);
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
