#version 460
// SPDX-License-Identifier: Apache-2.0
// The cheapest layer: what blending one fragment costs on this device.

layout(location = 0) out vec4 color;

void main() {
    color = vec4(0.01, 0.02, 0.03, 0.04);
}
