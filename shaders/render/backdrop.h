// SPDX-License-Identifier: Apache-2.0
// From a host's depth buffer to distances, and from the result to its colours; C++ and GLSL.
#ifndef BRUME_SHADERS_RENDER_BACKDROP_H
#define BRUME_SHADERS_RENDER_BACKDROP_H
#include "../common/shared.h"

BRUME_STRUCTS_BEGIN

// The host's depth d lies at view depth (b - d e) / (d c - a), m along the camera's axis.
struct BackdropPush {
    float a, b, c, e;
    float farDepth;         // what the host clears its depth to: nothing opaque is there
    uint offsetX, offsetY;  // of the viewport in the host's images, pixels
};

BRUME_CONST uint kBindingHostDepth = 8u;
BRUME_CONST uint kBindingHostColor = 9u;
BRUME_CONST uint kBindingComposed = 8u;

BRUME_STRUCTS_END
#endif
