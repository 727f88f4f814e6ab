// SPDX-License-Identifier: Apache-2.0
// How media that scatter ask for shadows: spheres as a whole (SphereData::shares), or at each place.
#ifndef BRUME_COMMON_SHADOWING_GLSL
#define BRUME_COMMON_SHADOWING_GLSL
#include "../shadows/common/maps.h"

layout(constant_id = kConstantShadowing) const uint kShadowing =
    kShadowingWhole | kShadowingSampled;
const bool kWholeShadows = (kShadowing & kShadowingWhole) != 0u;
const bool kSampledShadows = (kShadowing & kShadowingSampled) != 0u;

#endif
