// SPDX-License-Identifier: Apache-2.0
// Media of constant density under light that does not vary along a ray: running sums of extinction
// and source with an integer count, reset in free space.
#ifndef BRUME_OIT_LINKED_LIST_CONSTANT_GLSL
#define BRUME_OIT_LINKED_LIST_CONSTANT_GLSL
#include "path.glsl"

// What a medium of density 1 does to a ray: its extinction and its source do not vary along it.
struct RayMedium {
    vec3 extinction;  // 1/m
    vec3 source;      // radiance per metre
};

RayMedium makeRayMedium(uint index) {
    MediumData medium = media[index];
    vec3 light = scatteredRadiance(medium, vec3(0), ray.direction);
    return RayMedium(medium.extinction,
                     medium.extinction * medium.albedo * light + medium.emission);
}

// The first media are worked out once per ray; scenes with more work theirs out at every event.
RayMedium keptMedia[kKeptMedia];

void keepMedia() {
    for (uint i = 0u; i < kKeptMedia; ++i)
        keptMedia[i] = makeRayMedium(min(i, max(frame.mediumCount, 1u) - 1u));
}

RayMedium findRayMedium(uint index) {
    if (!kFewMedia) return makeRayMedium(index);
    RayMedium medium = keptMedia[0];
    for (uint i = 1u; i < kKeptMedia; ++i)
        if (index == i) medium = keptMedia[i];
    return medium;
}

// Extinction, source and end of the interval that an entry stands for.
void loadInterval(uvec2 entry, out vec3 extinction, out vec3 source, out float end) {
    uint index = entry.y & kIndexMask;
    uint mediumIndex;
    float density;
    vec3 tint = vec3(1);
    vec2 t;
    if (kBoxes && (entry.y >> kKindShift) == kKindBox) {
        BoxData box = boxes[index];
        VolumeData volume = volumes[box.volume];
        intersectBox(volume.indexFromWorld * (ray.origin - box.corner),
                     volume.indexFromWorld * ray.direction, box.size, t);
        mediumIndex = volume.medium;
        density = box.value;
    } else {
        SphereData sphere = spheres[index];
        intersectSphere(ray.origin, ray.direction, sphere.center, sphere.radius, t);
        mediumIndex = sphere.medium;
        density = sphere.density;
        tint = sphere.tint;
    }
    end = t.y;
    RayMedium medium = findRayMedium(mediumIndex);
    extinction = medium.extinction * density;
    source = tint * density * medium.source;
}

// The open intervals' ends, sorted, live in list[head .. tail): the entries there are used up.
// Equal spheres end in the order in which they begin, so that most ends are appended.
void insertEnd(uint head, uint tail, uvec2 end) {
    uint slot = tail;
    while (slot > head) {
        uvec2 previous = loadEntry(slot - 1u);
        ++iterations;
        if (previous.x <= end.x) break;
        storeEntry(slot, previous);
        --slot;
    }
    storeEntry(slot, end);
}

void resolveConstant(inout Path path, Solids solids, float limit) {
    vec3 extinctionHi = vec3(0), extinctionLo = vec3(0), sourceHi = vec3(0), sourceLo = vec3(0);
    uint head = 0u, next = 0u;  // open ends: [head, next); unread entries: [next, count)
    float position = 0.0;
    keepMedia();
    MediumData isotropic = MediumData(vec3(0), kPhaseIsotropic, vec3(0), 0.0, vec3(0));
    vec3 solidLight = kSurfaces ? scatteredRadiance(isotropic, vec3(0), ray.direction) : vec3(0);
    uvec2 entry = next < count ? loadEntry(next) : uvec2(0);
    uvec2 end = uvec2(floatBitsToUint(kFar), 0u);
    while (iterations < kMaxIterations) {
        ++iterations;
        float enter = next < count ? uintBitsToFloat(entry.x) : kFar;
        float leave = head < next ? uintBitsToFloat(end.x) : kFar;
        float event = min(min(enter, leave), limit);
        vec3 extinction = extinctionHi + extinctionLo, source = sourceHi + sourceLo;
        if (kSurfaces) {
            vec3 scattering = solids.scatteringHi + solids.scatteringLo;
            extinction += solids.extinctionHi + solids.extinctionLo;
            source += scattering * solidLight;
        }
        crossConstant(path, extinction, source, max(event - position, 0.0));
        position = max(position, event);
        if (event >= limit || isOpaque(path)) break;

        bool isEnter = enter <= leave;
        uvec2 current = isEnter ? entry : end;
        if (kSurfaces && isEnter && (entry.y >> kKindShift) == kKindSurface) {
            SurfaceRecord record = loadRecord(entry);
            if (record.face == kFaceThin)
                crossThin(path, record);
            else
                crossSolid(solids, record);
            // The slot of the surface joins the free ones: move the open ends over it.
            for (uint i = next; i > head; --i) storeEntry(i, loadEntry(i - 1u));
            ++head;
            ++next;
            entry = next < count ? loadEntry(next) : uvec2(0);
            continue;
        }
        vec3 intervalExtinction, intervalSource;
        float intervalEnd;
        loadInterval(current, intervalExtinction, intervalSource, intervalEnd);
        float sign = isEnter ? 1.0 : -1.0;
        addExactly(extinctionHi, extinctionLo, sign * intervalExtinction);
        addExactly(sourceHi, sourceLo, sign * intervalSource);
        if (isEnter) {
            insertEnd(head, next, uvec2(floatBitsToUint(intervalEnd), current.y));
            ++next;
            entry = next < count ? loadEntry(next) : uvec2(0);
        } else {
            ++head;
        }
        if (head == next) {
            extinctionHi = extinctionLo = sourceHi = sourceLo = vec3(0);
        } else {
            end = loadEntry(head);
        }
    }
}

#endif
