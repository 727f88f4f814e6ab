// SPDX-License-Identifier: Apache-2.0
// Nearest and farthest distance of a pixel's layers: moments are only sharp over a short range.
#ifndef BRUME_OIT_MOMENT_RANGE_GLSL
#define BRUME_OIT_MOMENT_RANGE_GLSL
#include "../layers/layer.glsl"

layout(location = 0) out vec4 range;

void storeLayer(Layer layer) { range = vec4(-layer.t.x, layer.t.y, 0.0, 0.0); }

#endif
