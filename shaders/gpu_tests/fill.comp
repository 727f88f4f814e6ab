// SPDX-License-Identifier: Apache-2.0
// Writes base + stride * index through a device address.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kStride = 1;
layout(constant_id = 2) const float kScale = 1.0;

layout(buffer_reference, scalar) buffer Values { uint values[]; };
layout(push_constant, scalar) uniform Push {
    Values target;
    uint base;
    uint count;
};

void main() {
    uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (i < count) target.values[i] = base + kStride * i * uint(kScale);
}
