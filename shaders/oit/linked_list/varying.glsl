// SPDX-License-Identifier: Apache-2.0
// Media whose density varies along the ray, or light that does: between events (a medium begins or
// ends, the ray crosses a voxel plane) every density is a polynomial of degree <= 4, so that
// Gauss's rule gives the optical depth exactly; five points, because those of three leave the
// light of a mixture off by 1e-4.
#ifndef BRUME_OIT_LINKED_LIST_VARYING_GLSL
#define BRUME_OIT_LINKED_LIST_VARYING_GLSL
#include "../../common/density.glsl"
#include "path.glsl"

// Gauss-Legendre nodes and weights on [0, 1], and the integrals of the node polynomials up to each
// node (the Butcher matrix of the five-stage Gauss method).
const int kNodeCount = 5;
const float kNodes[kNodeCount] =
    float[](0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332);
const float kWeights[kNodeCount] =
    float[](0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
            0.118463442528095);
const float kUpTo[kNodeCount * kNodeCount] =  // row k: from 0 to node k
    float[](0.059231721264, -0.019570364359, 0.011254400819, -0.005593793661, 0.001588112968,
            0.128151005670, 0.119657167625, -0.024592114620, 0.010318280671, -0.002768994399,
            0.113776288004, 0.260004651681, 0.142222222222, -0.020690316431, 0.004687154524,
            0.121232436927, 0.228996054579, 0.309036559064, 0.119657167625, -0.009687563142,
            0.116875329560, 0.244908128910, 0.273190043626, 0.258884699609, 0.059231721264);

// Of the radiance in one step (chosen by us, so that the hard rays of the tests are exact to 1e-5).
const float kAllowedError = 1e-6;
// Error of the nodes, in parts of the variation: smooth * depth^3 + wide * depth^2 * share^4, with
// the share of a smooth sphere's chord that the step covers (fitted to random mixtures, of which
// at most one in a hundred exceeds it).
const float kErrorOfDepth = 8e-5;
const float kErrorOfShare = 6e-4;

struct Nodes {
    vec3 extinction[kNodeCount];
    vec3 source[kNodeCount];
    float share;  // largest of a smooth sphere's chord that they span
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

// The next place ahead at which the ray, `offset` from the apex of a cone, crosses it.
float nextConeCrossing(vec3 offset, vec3 axis, float cosAngle, float slack) {
    float oa = dot(offset, axis), da = dot(rayDirection, axis), c2 = cosAngle * cosAngle;
    float a = da * da - c2, b = oa * da - c2 * dot(offset, rayDirection);
    float c = oa * oa - c2 * dot(offset, offset);
    float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(max(b * b - a * c, 0.0)));
    float t1 = q / (abs(a) > 1e-20 ? a : 1e-20), t2 = c / (abs(q) > 1e-20 ? q : 1e-20);
    return min(t1 > slack ? t1 : kFar, t2 > slack ? t2 : kFar);
}

// A step short enough for the nodes near a point or spot light: 1/d^2 has its poles at the light,
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
    vec3 origin = vec3(ray.origin), direction = vec3(ray.direction);
    for (uint i = 0u; i < frame.lightCount; ++i)
        limit = min(limit, min(lights[i].type != kLightDirectional
                                   ? limitStepByLight(lights[i], place)
                                   : kFar,
                               shadowStep(i, origin + direction * place, direction)));
    iterations += frame.lightCount;
    return limit;
}

// Integrates source * exp(-depth) over one step. The mean source radiance is taken exactly; only
// its variation within the step is left to the nodes. Returns the estimated error in units of what
// is allowed; above 1 nothing is done.
float crossVarying(Nodes nodes, float distance) {
    vec3 extinction = vec3(0), source = vec3(0);
    for (uint k = 0u; k < kNodeCount; ++k) {
        extinction += kWeights[k] * nodes.extinction[k];
        source += kWeights[k] * nodes.source[k];
    }
    vec3 depth = min(extinction * distance, vec3(1e30));
    vec3 before = state.path.surfaces * state.path.decay;
    vec3 mean = source / max(extinction, vec3(1e-30));
    vec3 variation = vec3(0), size = vec3(0), deviation = vec3(0);
    for (uint k = 0u; k < kNodeCount; ++k) {
        vec3 depthAtNode = vec3(0);
        for (uint j = 0u; j < kNodeCount; ++j)
            depthAtNode += kUpTo[kNodeCount * k + j] * nodes.extinction[j];
        depthAtNode *= distance;
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
    float share2 = nodes.share * nodes.share;
    vec3 part = depth * depth * (kErrorOfDepth * depth + kErrorOfShare * share2 * share2);
    vec3 error = before * bound * min(part, vec3(1));
    float worst = max(error.x, max(error.y, error.z)) / kAllowedError;
    if (worst > 1.0 && max(depth.x, max(depth.y, depth.z)) > 1e-3) return worst;
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
        float error = crossVarying(evaluateNodes(state.offset, distance), distance);
        // The error grows with a high power of the step.
        float scale = clamp(0.9 * pow(max(error, 1e-15), -0.25), 1e-6, 100.0);
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
