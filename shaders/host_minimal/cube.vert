// SPDX-License-Identifier: Apache-2.0
// A cube and a floor without any vertex buffer: 36 corners of the cube, then 6 of the floor.
#version 460

layout(push_constant) uniform Push {
    mat4 clipFromWorld;
    float angle;  // of the cube, radians
};
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out int isFloor;

const vec2 kCorners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1),
                                vec2(-1, 1));

void main() {
    vec2 corner = kCorners[gl_VertexIndex % 6];
    int face = gl_VertexIndex / 6;
    isFloor = face == 6 ? 1 : 0;
    if (face == 6) {
        position = vec3(6.0 * corner.x, 0.0, 6.0 * corner.y);
        normal = vec3(0, 1, 0);
    } else {
        int axis = face / 2;
        float side = face % 2 == 0 ? 1.0 : -1.0;
        vec3 p = vec3(0), n = vec3(0);
        n[axis] = p[axis] = side;
        p[(axis + 1) % 3] = corner.x;
        p[(axis + 2) % 3] = corner.y;
        mat3 turn = mat3(cos(angle), 0, -sin(angle), 0, 1, 0, sin(angle), 0, cos(angle));
        position = turn * (0.45 * p) + vec3(0, 0.75, 0);
        normal = turn * n;
    }
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
