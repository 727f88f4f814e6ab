// SPDX-License-Identifier: Apache-2.0
// What the viewer's user interface is drawn from; C++ and GLSL.
#ifndef BRUME_SHADERS_VIEW_UI_H
#define BRUME_SHADERS_VIEW_UI_H
#include "../common/shared.h"

BRUME_STRUCTS_BEGIN

// As Dear ImGui lays them out.
struct UiVertex {
    vec2 position;  // points
    vec2 uv;
    uint color;     // sRGB and alpha, 8 bits each, red lowest
};

struct UiPush {
    vec2 scale, offset;  // clip = position * scale + offset
    float gain;          // pictures: factor of radiance
};

BRUME_CONST uint kBindingUiVertices = 0u;
BRUME_CONST uint kBindingUiTexture = 1u;

BRUME_STRUCTS_END
#ifdef __cplusplus
static_assert(sizeof(brume::shader::UiVertex) == 20);
static_assert(offsetof(brume::shader::UiVertex, color) == 16);
#endif
#endif
