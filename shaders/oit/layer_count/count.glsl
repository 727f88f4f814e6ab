// SPDX-License-Identifier: Apache-2.0
// Adds one for a fragment.
#ifndef BRUME_OIT_LAYER_COUNT_COUNT_GLSL
#define BRUME_OIT_LAYER_COUNT_COUNT_GLSL
#include "layer_count.h"

layout(constant_id = kLayerCountConstantMisses) const bool kCountsMisses = false;
layout(location = 0) out float count;

void countFragment(bool isHit) {
    if (!isHit && !kCountsMisses) discard;
    count = 1.0;
}

#endif
