// SPDX-License-Identifier: Apache-2.0
// For fragment shaders of hosts: transparent things of the host composited with Brume's, whatever
// their order. Draw them between brumeCmdBeginLayers() and brumeCmdEndLayers().
//
//   #include "host/brume_store.glsl"             // with -I <prefix>/include/brume/glsl
//   brumeStore(radiance, transmittance, distance);
//
// It declares the outputs 0 and 1. The pipeline: two colour attachments R32G32B32A32_SFLOAT, blending
// ONE, ONE, ADD in colour and alpha; no depth attachment. What opaque things hide is the shader's to
// discard, e.g. by the host's depth as a texture.
// The scene: created with `hostLayers`, whose method is "weighted" with its default weights.
#ifndef BRUME_HOST_BRUME_STORE_GLSL
#define BRUME_HOST_BRUME_STORE_GLSL

layout(location = 0) out vec4 brumeSum;
layout(location = 1) out vec4 brumeDepth;

// A layer L <- radiance + transmittance * L. `radiance`: what it adds by itself, with its coverage;
// `transmittance`: per channel in [0, 1]; `distance`: m from the eye along the ray.
void brumeStore(vec3 radiance, vec3 transmittance, float distance) {
    vec3 loss = clamp(1.0 - transmittance, vec3(0), vec3(1));
    // As many digits as 1 - loss has; at most so much that no float overflows in sums.
    vec3 depth = min(-log(max(transmittance, vec3(1e-36))), vec3(80));
    float mean = (loss.x + loss.y + loss.z) * (1.0 / 3.0);
    if (mean < 1e-7 && radiance != vec3(0)) {
        mean = 1e-7;
        depth = max(depth, vec3(1e-7));
    }
    // Eq. 5 of the method, by distance: (5 m / distance)^2.
    float weight = clamp(25.0 / max(distance * distance, 1e-18), 1e-12, 1e12);
    brumeSum = vec4(weight * radiance, weight * mean);
    brumeDepth = vec4(max(depth, vec3(0)), 0.0);
}

#endif
