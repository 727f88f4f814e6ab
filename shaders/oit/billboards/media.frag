// SPDX-License-Identifier: Apache-2.0
// The exact radiance and transmittance of one medium by itself, for blending with "over".
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/density.glsl"
#include "../../common/exponential.glsl"
#include "../../common/intersect.glsl"
#include "../../common/lighting.glsl"

layout(constant_id = 0) const bool kBoxes = true;
layout(constant_id = 1) const bool kVarying = true;
layout(constant_id = 2) const bool kColoured = true;
layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(binding = kBindingOpaqueT) uniform sampler2D opaqueT;
layout(location = 0) flat in vec4 centerRadius;
layout(location = 1) flat in vec4 tintDensity;
layout(location = 2) flat in uvec3 kind;
layout(location = 0) out vec4 color;

const vec3 kNodes = vec3(0.1127016653792583, 0.5, 0.8872983346207417);
const vec3 kWeights = vec3(5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0);

// Integral of the density over [t.x, t.y].
float boxDensityLength(RealRay ray, BoxData box, VolumeData volume, vec2 t) {
    LocalRay local = localRay(ray, box, volume, 0.0);
    float sum = 0.0, position = t.x;
    for (int i = 0; i < 64 && position < t.y; ++i) {
        float target = min(nextPlane(box, local, position), t.y);
        float distance = target - position;
        BoxDensity density = makeBoxDensity(box, local, position + 0.5 * distance);
        for (int k = 0; k < 3; ++k)
            sum += distance * kWeights[k] * boxDensity(density, position + distance * kNodes[k]);
        position = target;
    }
    return sum;
}

float sphereDensityLength(RealRay ray, SphereData sphere, vec2 t) {
    float length = t.y - t.x;
    if (!kVarying) return length * sphere.density;
    SphereDensity density = makeSphereDensity(ray, sphere, t.x);
    float sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += kWeights[k] * sphereDensity(density, length * kNodes[k]);
    return length * sum;
}

void main() {
    RealRay ray = makeRealRay(gl_FragCoord.xy);
    float limit = texelFetch(opaqueT, ivec2(gl_FragCoord.xy), 0).x;
    vec2 t;
    float densityLength;
    if (kBoxes && kind.z != 0u) {
        BoxData box = boxes[kind.z - 1u];
        VolumeData volume = volumes[box.volume];
        LocalRay local = localRay(ray, box, volume, 0.0);
        if (!intersectBox(local.origin, local.direction, box.size, t) || t.x >= limit) discard;
        t.y = min(t.y, limit);
        densityLength = boxDensityLength(ray, box, volume, t);
    } else {
        SphereData sphere = SphereData(centerRadius.xyz, vec3(0), centerRadius.w, tintDensity.xyz,
                                       tintDensity.w, kind.x, 0u, kind.y);
        if (!intersectSphere(ray.origin, ray.direction, sphere.center, sphere.radius, t) ||
            t.x >= limit)
            discard;
        t.y = min(t.y, limit);
        densityLength = sphereDensityLength(ray, sphere, t);
    }
    MediumData medium = media[kind.x];
    vec3 tint = kBoxes && kind.z != 0u ? vec3(1) : tintDensity.xyz;
    vec3 depth = medium.extinction * densityLength;
    vec3 decay = kColoured ? exp(-depth) : vec3(exp(-depth.x));
    vec3 middle = ray.origin + ray.direction * (0.5 * (t.x + t.y));
    vec3 light = scatteredRadiance(medium, middle, ray.direction);
    vec3 source =
        tint * (medium.extinction * medium.albedo * light + medium.emission) * densityLength;
    color.rgb = source * meanDecay(depth, decay);
    color.a = 1.0 - (decay.x + decay.y + decay.z) / 3.0;
}
