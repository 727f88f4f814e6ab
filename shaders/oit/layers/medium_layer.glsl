// SPDX-License-Identifier: Apache-2.0
// The part of one soft sphere, brick or box that a ray sees, as a layer: exact by itself.
#ifndef BRUME_OIT_LAYERS_MEDIUM_LAYER_GLSL
#define BRUME_OIT_LAYERS_MEDIUM_LAYER_GLSL
#include "../../common/density.glsl"
#include "../../common/intersect.glsl"
#include "../../common/lighting.glsl"
#include "layer.glsl"

layout(binding = kBindingBoxes, scalar) readonly buffer Boxes { BoxData boxes[]; };
layout(binding = kBindingVolumes, scalar) readonly buffer Volumes { VolumeData volumes[]; };
layout(location = 0) flat in vec4 centerRadius;
layout(location = 1) flat in vec4 tintDensity;
layout(location = 2) flat in uvec4 kind;
layout(location = 3) flat in uint shares;

const vec3 kNodes = vec3(0.1127016653792583, 0.5, 0.8872983346207417);
const vec3 kWeights = vec3(5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0);

// Integral of the density over [t.x, t.y].
float boxDensityLength(RealRay ray, BoxData box, VolumeData volume, vec2 t) {
    LocalRay local = localRay(ray, box, volume, Real(0));
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

float sphereDensityLength(RealRay ray, vec2 t) {
    float length = t.y - t.x;
    if (!kVarying) return length * tintDensity.w;
    SphereData sphere = SphereData(centerRadius.xyz, vec3(0), centerRadius.w, tintDensity.xyz,
                                   tintDensity.w, kind.x, 0u, kind.y, shares);
    SphereDensity density = makeSphereDensity(ray, sphere, t.x);
    float sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += kWeights[k] * sphereDensity(density, length * kNodes[k]);
    return length * sum;
}

// False where the ray misses or meets something opaque before.
bool findInterval(Ray ray, float limit, out vec2 t, out float densityLength) {
    RealRay realRay = RealRay(Real3(ray.origin), Real3(ray.direction));
    if (kBoxes && kind.z != 0u) {
        BoxData box = boxes[kind.z - 1u];
        VolumeData volume = volumes[box.volume];
        LocalRay local = localRay(realRay, box, volume, Real(0));
        if (!intersectBox(local.origin, local.direction, box.size, t) || t.x >= limit) return false;
        t.y = min(t.y, limit);
        densityLength = boxDensityLength(realRay, box, volume, t);
        return true;
    }
    if (!intersectSphere(ray.origin, ray.direction, centerRadius.xyz, centerRadius.w, t) ||
        t.x >= limit)
        return false;
    t.y = min(t.y, limit);
    densityLength = sphereDensityLength(realRay, t);
    return true;
}

bool findMediumLayer(out Layer layer) {
    Ray ray = makeRay(layerPixel());
    float densityLength;
    if (!findInterval(ray, opaqueDistance(), layer.t, densityLength)) return false;
    MediumData medium = media[kind.x];
    vec3 tint = kBoxes && kind.z != 0u ? vec3(1) : tintDensity.xyz;
    vec3 middle = ray.origin + ray.direction * (0.5 * (layer.t.x + layer.t.y));
    vec3 light = scatteredRadiance(medium, shares, middle, ray.direction);
    vec3 source =
        tint * (medium.extinction * medium.albedo * light + medium.emission) * densityLength;
    setMedium(layer, medium.extinction * densityLength, source);
    layer.primitive = layer.object = kind.w;
    return true;
}

// Where the ray has passed each of the shares of the layer's density. Boxes count as homogeneous.
vec4 findShares(Layer layer, vec4 shares) {
    vec4 even = mix(layer.t.xxxx, layer.t.yyyy, shares);
    if (!kVarying || kind.y == kProfileConstant || (kBoxes && kind.z != 0u)) return even;
    // The chord of the whole sphere is u = -1 .. 1; along it (1 - u^2)^2 integrates to
    // u - 2/3 u^3 + u^5 / 5, from -8/15 to 8/15.
    Ray ray = makeRay(layerPixel());
    vec3 offset = centerRadius.xyz - ray.origin;
    float middle = dot(offset, ray.direction);
    vec3 perpendicular = offset - middle * ray.direction;
    float h = sqrt(max(centerRadius.w * centerRadius.w - dot(perpendicular, perpendicular), 1e-30));
    vec2 ends = clamp((layer.t - middle) / h, -1.0, 1.0), ends2 = ends * ends;
    ends = ends * (1.0 + ends2 * (ends2 * 0.2 - 2.0 / 3.0));
    vec4 target = mix(ends.xxxx, ends.yyyy, shares);
    // With x = 1 - |u|: x^3 (4/3 - x + x^2 / 5) = rest, by a guess and two steps of Newton's method
    // (error 1e-4 of the whole).
    vec4 rest = max(8.0 / 15.0 - abs(target), 0.0);
    vec4 x = exp2(log2(max(0.75 * rest, 1e-30)) / 3.0) * (1.0 + 0.669375 * rest);
    for (int i = 0; i < 2; ++i) {
        vec4 slope = x * x * (2.0 - x) * (2.0 - x);
        x -= (x * x * x * (4.0 / 3.0 + x * (x * 0.2 - 1.0)) - rest) / max(slope, 1e-12);
    }
    vec4 u = sign(target) * (1.0 - clamp(x, 0.0, 1.0));
    return clamp(middle + h * u, layer.t.xxxx, layer.t.yyyy);
}

#endif
