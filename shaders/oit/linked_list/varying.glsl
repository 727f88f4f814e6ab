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

struct Nodes {
    vec3 extinction[3];
    vec3 source[3];
};

void addToNodes(inout Nodes nodes, MediumData medium, vec3 tint, vec3 densities, vec3 t,
                vec3 constantLight) {
    for (int k = 0; k < 3; ++k) {
        vec3 light = kVaryingLight ? scatteredRadiance(medium, ray.origin + ray.direction * t[k],
                                                       ray.direction)
                                   : constantLight;
        vec3 extinction = medium.extinction * densities[k];
        nodes.extinction[k] += extinction;
        nodes.source[k] +=
            tint * (extinction * medium.albedo * light + medium.emission * densities[k]);
    }
}

// Extinction and source of everything that is open, at three distances.
Nodes evaluateNodes(uint openCount, Solids solids, vec3 t) {
    Nodes nodes;
    MediumData isotropic = MediumData(vec3(0), kPhaseIsotropic, vec3(0), 0.0, vec3(0));
    for (int k = 0; k < 3; ++k) {
        nodes.extinction[k] = vec3(0);
        nodes.source[k] = vec3(0);
        if (kSurfaces) {
            vec3 scattering = solids.scatteringHi + solids.scatteringLo;
            nodes.extinction[k] = solids.extinctionHi + solids.extinctionLo;
            nodes.source[k] =
                scattering * scatteredRadiance(isotropic,
                                               ray.origin + ray.direction * min(t[k], 1e6),
                                               ray.direction);
        }
    }
    for (uint i = 0u; i < openCount; ++i) {
        uvec2 entry = loadEntry(i);
        uint index = entry.y & kIndexMask;
        vec3 densities, tint = vec3(1);
        uint mediumIndex;
        if (kBoxes && (entry.y >> kKindShift) == kKindBox) {
            BoxData box = boxes[index];
            VolumeData volume = volumes[box.volume];
            densities = boxDensities(box, localRay(ray, box, volume), t);
            mediumIndex = volume.medium;
        } else {
            SphereData sphere = spheres[index];
            densities = sphereDensities(ray, sphere, t);
            mediumIndex = sphere.medium;
            tint = sphere.tint;
        }
        MediumData medium = media[mediumIndex];
        vec3 light = kVaryingLight ? vec3(0) : scatteredRadiance(medium, vec3(0), ray.direction);
        addToNodes(nodes, medium, tint, densities, t, light);
    }
    return nodes;
}

// A step short enough for three nodes near every light: 1/d^2 has its poles at the light, and a
// kink where it is capped at the light's radius, which steps must not cross.
float limitStepByLights(float position) {
    float limit = kFar;
    for (uint i = 0u; i < frame.lightCount; ++i) {
        if (lights[i].type == kLightDirectional) continue;
        float radius = lights[i].radius;
        vec3 offset = lights[i].position - ray.origin;
        float nearest = dot(offset, ray.direction), ahead = nearest - position;
        vec3 across = offset - nearest * ray.direction;
        float aside2 = dot(across, across);
        float distance = sqrt(ahead * ahead + aside2);
        float chord = sqrt(max(radius * radius - aside2, 0.0));
        float enter = ahead - chord, leave = ahead + chord, slack = 1e-3 * radius;
        float own = ahead > 0.0 ? max(distance / 3.0, 0.5 * sqrt(aside2)) : distance * 0.5;
        if (enter > slack)
            own = min(own, chord > 0.0 ? enter : own);
        else if (leave > slack)
            own = min(leave, 0.5 * radius);
        limit = min(limit, max(own, slack));
    }
    return limit;
}

// Integrates source * exp(-depth) over one step. The mean source radiance is taken exactly; only
// its variation within the step is left to the nodes. False (and nothing done) if the step is too
// long for that.
bool crossVarying(inout Path path, Nodes nodes, float distance) {
    vec3 extinction = vec3(0), source = vec3(0);
    for (int k = 0; k < 3; ++k) {
        extinction += kWeights[k] * nodes.extinction[k];
        source += kWeights[k] * nodes.source[k];
    }
    vec3 depth = extinction * distance;
    vec3 before = path.surfaces * path.decay;
    vec3 mean = source / max(extinction, vec3(1e-30));
    bvec3 empty = lessThan(depth, vec3(1e-7));
    vec3 variation = vec3(0), size = vec3(0);
    for (int k = 0; k < 3; ++k) {
        vec3 depthAtNode =
            distance * (kUpTo[k][0] * nodes.extinction[0] + kUpTo[k][1] * nodes.extinction[1] +
                        kUpTo[k][2] * nodes.extinction[2]);
        vec3 difference = nodes.source[k] - mean * nodes.extinction[k];
        variation += kWeights[k] * difference * expChannels(-max(depthAtNode, 0.0));
        size += kWeights[k] * abs(difference);
    }
    variation = mix(variation * distance, vec3(0), empty);
    size = mix(before * size * distance, vec3(0), empty);
    vec3 error = size * min(depth * depth * depth, vec3(1)) * 0.02;
    if (max(error.x, max(error.y, error.z)) > 1e-6 && max(depth.x, max(depth.y, depth.z)) > 0.25)
        return false;
    crossConstant(path, extinction, source, distance);
    path.radiance += before * variation;
    return true;
}

void resolveVarying(inout Path path, Solids solids, float limit) {
    // The open media live in list[0 .. openCount), unordered, as (bits of their end, kind and
    // index): the entries there are used up.
    uint openCount = 0u, next = 0u;
    float position = 0.0, stepLimit = kFar;
    while (iterations < kMaxIterations) {
        ++iterations;
        uvec2 entry = next < count ? loadEntry(next) : uvec2(0);
        float enter = next < count ? uintBitsToFloat(entry.x) : kFar;
        float leave = kFar, plane = kFar;
        uint leaving = 0u;
        for (uint i = 0u; i < openCount; ++i) {
            uvec2 open = loadEntry(i);
            float end = uintBitsToFloat(open.x);
            if (end < leave) leave = end, leaving = i;
            if (kBoxes && (open.y >> kKindShift) == kKindBox) {
                BoxData box = boxes[open.y & kIndexMask];
                plane =
                    min(plane, nextPlane(box, localRay(ray, box, volumes[box.volume]), position));
            }
        }
        iterations += 2u * openCount;
        float event = max(min(min(enter, leave), limit), position);
        float target = max(min(event, plane), position);
        if (openCount > 0u || solids.count > 0) {
            if (kVaryingLight) target = min(target, position + limitStepByLights(position));
            target = min(target, position + stepLimit);
        }
        float distance = target - position;
        if (distance > 0.0) {
            Nodes nodes = evaluateNodes(openCount, solids, position + distance * kNodes);
            if (!crossVarying(path, nodes, distance)) {
                stepLimit = distance * 0.4;
                continue;
            }
        }
        stepLimit = target < event ? 4.0 * max(distance, 1e-6 * position) : kFar;
        position = target;
        if (position >= limit || isOpaque(path)) break;
        if (target < event) continue;

        if (enter <= leave) {
            if (kSurfaces && (entry.y >> kKindShift) == kKindSurface) {
                SurfaceRecord record = loadRecord(entry);
                if (record.face == kFaceThin)
                    crossThin(path, record);
                else
                    crossSolid(solids, record);
            } else {
                vec2 t;
                uint index = entry.y & kIndexMask;
                if (kBoxes && (entry.y >> kKindShift) == kKindBox) {
                    LocalRay local = localRay(ray, boxes[index], volumes[boxes[index].volume]);
                    intersectBox(local.origin, local.direction, boxes[index].size, t);
                } else {
                    intersectSphere(ray.origin, ray.direction, spheres[index].center,
                                    spheres[index].radius, t);
                }
                storeEntry(openCount, uvec2(floatBitsToUint(t.y), entry.y));
                ++openCount;
            }
            ++next;
        } else {
            --openCount;
            storeEntry(leaving, loadEntry(openCount));
        }
    }
}

#endif
