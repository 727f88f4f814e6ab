// SPDX-License-Identifier: Apache-2.0
// Stores the texels of a sampled image into a storage image, doubled.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D source;
layout(binding = 1, rgba32f) writeonly uniform image2D target;
void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (all(lessThan(p, imageSize(target)))) imageStore(target, p, 2.0 * texelFetch(source, p, 0));
}
