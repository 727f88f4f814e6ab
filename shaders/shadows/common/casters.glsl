// SPDX-License-Identifier: Apache-2.0
// What takes light away along a ray: soft spheres, volume bricks and boxes, triangles.
#ifndef BRUME_SHADOWS_COMMON_CASTERS_GLSL
#define BRUME_SHADOWS_COMMON_CASTERS_GLSL
#include "../../common/density.glsl"
#include "../../common/intersect.glsl"
#include "../../common/mesh.h"
#include "map.glsl"

layout(buffer_reference, scalar) readonly buffer ShadowSpheres { SphereData at[]; };
layout(buffer_reference, scalar) readonly buffer ShadowBoxes { BoxData at[]; };
layout(buffer_reference, scalar) readonly buffer ShadowVolumes { VolumeData at[]; };
layout(buffer_reference, scalar) readonly buffer ShadowTriangles { ShadowTriangle at[]; };
layout(buffer_reference, scalar) readonly buffer ShadowMaterials { ShadowMaterial at[]; };
layout(buffer_reference, scalar) readonly buffer ShadowTexels { vec4 at[]; };

// Trips of loops, for callers whose device limits them.
uint shadowIterations = 0u;

const vec3 kShadowNodes = vec3(0.1127016653792583, 0.5, 0.8872983346207417);
const vec3 kShadowWeights = vec3(5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0);

// Shadows are traced in fp32 everywhere: what it loses at the front of dense media is narrower than
// any texel.
bool hitShadowSphere(Ray ray, SphereData sphere, out vec2 t) {
    return intersectSphere(vec3(0), ray.direction, (sphere.center - ray.origin) + sphere.centerLo,
                           sphere.radius, t);
}

// Integral of the density over [t.x, t.y] of a chord; exact (a polynomial of degree 4).
float sphereDensityLength(Ray ray, SphereData sphere, vec2 t) {
    float l = t.y - t.x;
    if (sphere.profile == kProfileConstant) return sphere.density * l;
    precise vec3 offset = (sphere.center - ray.origin) + sphere.centerLo;
    precise float middle = dot(offset, ray.direction);
    precise vec3 perpendicular = offset - middle * ray.direction;
    precise float h2 = sphere.radius * sphere.radius - dot(perpendicular, perpendicular);
    precise float reach = sqrt(max(h2, 0.0));
    vec3 place = t.x + l * kShadowNodes - middle;
    vec3 q = max((reach + place) * (reach - place), 0.0) / (sphere.radius * sphere.radius);
    return sphere.density * l * dot(kShadowWeights, q * q);
}

LocalRay shadowLocalRay(Ray ray, BoxData box, VolumeData volume) {
    return LocalRay(volume.indexFromWorld * ((ray.origin - box.corner) - box.cornerLo),
                    volume.indexFromWorld * ray.direction);
}

// The same over one cell of a brick or one ramp of a soft box, in which the density is a cubic.
float cellDensityLength(BoxData box, LocalRay local, float from, float to) {
    BoxDensity density = makeBoxDensity(box, local, 0.5 * (from + to));
    vec3 nodes = from + (to - from) * kShadowNodes;
    return (to - from) * dot(kShadowWeights, vec3(boxDensity(density, nodes.x),
                                                  boxDensity(density, nodes.y),
                                                  boxDensity(density, nodes.z)));
}

float brickDensityLength(BoxData box, LocalRay local, vec2 t) {
    float sum = 0.0, position = t.x;
    for (int i = 0; i < 64 && position < t.y; ++i) {
        float target = min(nextPlane(box, local, position), t.y);
        sum += cellDensityLength(box, local, position, target);
        position = target;
        ++shadowIterations;
    }
    return sum;
}

// Where a ray meets a triangle. Each edge is judged by the same numbers for both triangles that
// share it, so that no ray slips through and none meets both.
float judgeEdge(vec3 direction, vec3 p, vec3 q, out bool isTaken) {
    bool isSwapped = p.x != q.x ? p.x > q.x : p.y != q.y ? p.y > q.y : p.z > q.z;
    precise vec3 lo = isSwapped ? q : p, hi = isSwapped ? p : q;
    precise vec3 normal = cross(lo, hi);
    precise float side = dot(direction, normal);
    isTaken = side == 0.0 && !isSwapped;
    return isSwapped ? -side : side;
}

struct TriangleHit {
    float t;
    vec3 weights;  // barycentric
    bool isFront;  // the ray meets the outside
};

bool intersectTriangle(Ray ray, ShadowTriangle triangle, out TriangleHit hit) {
    precise vec3 a = triangle.a - ray.origin, b = triangle.b - ray.origin,
                 c = triangle.c - ray.origin;
    bool zeroA, zeroB, zeroC;
    float wa = judgeEdge(ray.direction, b, c, zeroA), wb = judgeEdge(ray.direction, c, a, zeroB),
          wc = judgeEdge(ray.direction, a, b, zeroC);
    bool isFront = (wa > 0.0 || zeroA) && (wb > 0.0 || zeroB) && (wc > 0.0 || zeroC);
    bool isBack = (wa < 0.0 || (wa == 0.0 && !zeroA)) && (wb < 0.0 || (wb == 0.0 && !zeroB)) &&
                  (wc < 0.0 || (wc == 0.0 && !zeroC));
    float sum = wa + wb + wc;
    vec3 normal = cross(b - a, c - a);
    float facing = dot(normal, ray.direction);
    hit.t = dot(normal, a) / (abs(facing) > 1e-30 ? facing : 1e-30);
    hit.weights = abs(sum) > 1e-30 ? vec3(wa, wb, wc) / sum : vec3(1.0 / 3.0);
    hit.isFront = facing < 0.0;
    return (isFront || isBack) && abs(sum) > 1e-30 && abs(facing) > 1e-30;
}

vec4 materialTexel(ShadowMaterial material, ivec2 texel) {
    ivec2 size = ivec2(material.textureSize);
    ivec2 t = texel - ivec2(floor(vec2(texel) / vec2(size))) * size;
    return ShadowTexels(material.texture).at[uint(t.y * size.x + t.x)];
}

// Colour and alpha of a texture; bilinear, repeating.
vec4 materialColor(ShadowTriangle triangle, ShadowMaterial material, vec3 weights) {
    if (material.textureSize.x == 0u) return vec4(1);
    vec2 uv = weights.x * triangle.uvA + weights.y * triangle.uvB + weights.z * triangle.uvC;
    vec2 position = (uv - floor(uv)) * vec2(material.textureSize) - 0.5;
    ivec2 low = ivec2(floor(position));
    vec2 f = position - vec2(low);
    return mix(mix(materialTexel(material, low), materialTexel(material, low + ivec2(1, 0)), f.x),
               mix(materialTexel(material, low + ivec2(0, 1)),
                   materialTexel(material, low + ivec2(1, 1)), f.x),
               f.y);
}

// What a thin or opaque surface lets through; solids let all through.
vec3 surfaceTransmittance(ShadowTriangle triangle, ShadowMaterial material, vec3 weights) {
    vec4 color = materialColor(triangle, material, weights);
    float alpha = material.coverage * color.a;
    if (material.type == kMaterialSolid || alpha < material.alphaCutoff) return vec3(1);
    if (material.type == kMaterialOpaque) return vec3(0);
    return 1.0 - alpha * (1.0 - material.transmission * color.rgb);
}

// Caustics by density: glass that stands across the light throws less shadow, glass that it grazes
// more. McGuire and Mara 2016, eq. 10 to 12; s^0.2 is left out where s is 0.

// A unit vector as an octahedron unfolded to a square, 16 bits per axis.
vec3 unpackNormal(uint bits) {
    vec2 p = unpackSnorm2x16(bits);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float fold = max(-n.z, 0.0);
    return normalize(n - vec3(mix(vec2(-fold), vec2(fold), greaterThanEqual(n.xy, vec2(0))), 0.0));
}

// What the share of light that a surface takes is multiplied by; 1 where `ior` is 1.
float causticGain(ShadowTriangle triangle, float ior, vec3 weights, vec3 direction) {
    float s = clamp(0.5 * (ior - 1.0), 0.0, 1.0);
    if (s == 0.0) return 1.0;
    vec3 normal = normalize(weights.x * unpackNormal(triangle.normalA) +
                            weights.y * unpackNormal(triangle.normalB) +
                            weights.z * unpackNormal(triangle.normalC));
    float g = 1.0 - 2.0 * pow(min(abs(dot(normal, direction)), 1.0), 128.0 * s * s);
    return 1.0 + g * pow(s, 0.2);
}

vec3 gatherLight(vec3 transmittance, float gain) {
    return 1.0 - min(gain * (1.0 - transmittance), vec3(1));
}

#endif
