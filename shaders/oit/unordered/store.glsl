// SPDX-License-Identifier: Apache-2.0
// Blends a layer with "over"; the colour of its transmittance is averaged.
#ifndef BRUME_OIT_UNORDERED_STORE_GLSL
#define BRUME_OIT_UNORDERED_STORE_GLSL
#include "../layers/layer.glsl"

layout(location = 0) out vec4 color;

void storeLayer(Layer layer) {
    color = vec4(layer.radiance, kColoured ? meanOf(layer.loss) : layer.loss.x);
}

#endif
