// SPDX-License-Identifier: Apache-2.0
// One lamp and some sky.
#version 460

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in int isFloor;
layout(location = 0) out vec4 color;

void main() {
    float lamp = max(dot(normalize(normal), normalize(vec3(-0.6, 0.8, 0.35))), 0.0);
    vec3 light = vec3(0.9, 0.82, 0.7) * lamp + vec3(0.10, 0.12, 0.16);
    bool isOdd = mod(floor(position.x) + floor(position.z), 2.0) > 0.5;
    vec3 albedo = isFloor == 0 ? vec3(0.8, 0.28, 0.08) : isOdd ? vec3(0.30) : vec3(0.22);
    float haze = isFloor == 0 ? 0.0 : smoothstep(2.5, 6.0, length(position.xz));
    color = vec4(mix(albedo * light, vec3(0.05, 0.06, 0.09), haze), 1.0);
}
