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

// The open media live in list[0 .. count), boxes first, each as (bits of its end, kind and index):
// the entries there are used up. Boxes and spheres are visited by loops of their own, because on
// some devices a branch that is not taken costs as much as one that is.
struct OpenSet {
    uint count;
    uint boxes;
};

void openMedium(inout OpenSet open, uvec2 entry, bool isBox) {
    if (kBoxes && isBox) {
        if (open.boxes < open.count) storeEntry(open.count, loadEntry(open.boxes));
        storeEntry(open.boxes, entry);
        ++open.boxes;
    } else {
        storeEntry(open.count, entry);
    }
    ++open.count;
}

void closeMedium(inout OpenSet open, uint index) {
    uint hole = index;
    if (kBoxes && index < open.boxes) {
        --open.boxes;
        storeEntry(hole, loadEntry(open.boxes));
        hole = open.boxes;
    }
    --open.count;
    storeEntry(hole, loadEntry(open.count));
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

Gathered gatherOpen(OpenSet open, uint base, vec3 t) {
    Gathered sum;
    for (uint g = 0u; g < kGroup; ++g) sum.density[g] = vec3(0);
    for (uint g = 0u; g < kGroup * 3u; ++g) sum.tinted[g] = vec3(0);
    if (kBoxes)
        for (uint i = 0u; i < open.boxes; ++i) {
            BoxData box = boxes[loadEntry(i).y & kIndexMask];
            VolumeData volume = volumes[box.volume];
            addToGroup(sum, base, volume.medium, boxDensities(box, localRay(ray, box, volume), t),
                       vec3(1));
        }
    for (uint i = kBoxes ? open.boxes : 0u; i < open.count; ++i) {
        SphereData sphere = spheres[loadEntry(i).y & kIndexMask];
        addToGroup(sum, base, sphere.medium, sphereDensities(ray, sphere, t), sphere.tint);
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
                irradiance = lightIrradiance(light, i, ray.origin + ray.direction * t[k], travel);
            float cosTheta = -dot(travel, ray.direction);
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
Nodes evaluateNodes(OpenSet open, Solids solids, vec3 t) {
    Nodes nodes;
    Scattered scattered = scatterGroup(0u, min(t, vec3(1e6)));
    for (int k = 0; k < 3; ++k) {
        nodes.extinction[k] = nodes.source[k] = vec3(0);
        if (kSurfaces) {
            nodes.extinction[k] = solids.extinctionHi + solids.extinctionLo;
            nodes.source[k] = (solids.scatteringHi + solids.scatteringLo) * scattered.isotropic[k];
        }
    }
    if (frame.mediumCount > 0u) {
        addGroup(nodes, 0u, gatherOpen(open, 0u, t), scattered);
        for (uint base = kGroup; base < frame.mediumCount; base += kGroup)
            addGroup(nodes, base, gatherOpen(open, base, t), scatterGroup(base, t));
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

// The entry and exit of the medium that an entry stands for.
vec2 intersectMedium(uvec2 entry, bool isBox) {
    vec2 t;
    uint index = entry.y & kIndexMask;
    if (kBoxes && isBox) {
        LocalRay local = localRay(ray, boxes[index], volumes[boxes[index].volume]);
        intersectBox(local.origin, local.direction, boxes[index].size, t);
    } else {
        intersectSphere(ray.origin, ray.direction, spheres[index].center, spheres[index].radius, t);
    }
    return t;
}

void resolveVarying(inout Path path, Solids solids, float limit) {
    OpenSet open = OpenSet(0u, 0u);
    uint next = 0u;
    float position = 0.0, stepLimit = kFar;
    while (iterations < kMaxIterations) {
        ++iterations;
        uvec2 entry = next < count ? loadEntry(next) : uvec2(0);
        float enter = next < count ? uintBitsToFloat(entry.x) : kFar;
        float leave = kFar, plane = kFar;
        uint leaving = 0u;
        for (uint i = 0u; i < open.count; ++i) {
            float end = uintBitsToFloat(loadEntry(i).x);
            if (end < leave) leave = end, leaving = i;
        }
        if (kBoxes)
            for (uint i = 0u; i < open.boxes; ++i) {
                BoxData box = boxes[loadEntry(i).y & kIndexMask];
                plane =
                    min(plane, nextPlane(box, localRay(ray, box, volumes[box.volume]), position));
            }
        iterations += 2u * open.count;
        float event = max(min(min(enter, leave), limit), position);
        float target = max(min(event, plane), position);
        if (open.count > 0u || solids.count > 0) {
            if (kVaryingLight) target = min(target, position + limitStepByLights(position));
            target = min(target, position + stepLimit);
        }
        float distance = target - position;
        if (distance > 0.0) {
            Nodes nodes = evaluateNodes(open, solids, position + distance * kNodes);
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
                bool isBox = (entry.y >> kKindShift) == kKindBox;
                openMedium(open, uvec2(floatBitsToUint(intersectMedium(entry, isBox).y), entry.y),
                           isBox);
            }
            ++next;
        } else {
            closeMedium(open, leaving);
        }
    }
}

#endif
