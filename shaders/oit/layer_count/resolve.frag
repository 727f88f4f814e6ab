// SPDX-License-Identifier: Apache-2.0
// Counts as colours, logarithmic from 1 to kLargestLayerCount; none is black.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/frame_bindings.h"
#include "../../common/heat.h"
#include "layer_count.h"

layout(binding = kBindingLayerCount) uniform sampler2D counts;
layout(location = 0) out vec4 result;

void main() {
    float count = texelFetch(counts, ivec2(gl_FragCoord.xy), 0).x;
    float at = count < 1.0 ? 0.0 : 1.0 + (kHeatSteps - 1.0) * log2(count) / log2(kLargestLayerCount);
    result = vec4(heatColor(at), 1.0);
}
