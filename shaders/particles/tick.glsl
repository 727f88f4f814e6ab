// SPDX-License-Identifier: Apache-2.0
// What the passes of a tick share: their invocations, and which particles each handles.
#include "passes.h"

layout(local_size_x_id = 0) in;
layout(push_constant, scalar) uniform Push { TickPush push; };

/// The index of an invocation of Commands::dispatchThreads.
uint threadIndex() {
    return gl_GlobalInvocationID.x +
           gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
}

/// Existing particles of a chunk: [x, y); empty for chunks of births.
uvec2 survivorRange(uint chunk, uint alive) {
    uint begin = chunk < push.survivorChunks ? chunk * push.chunkSize : alive;
    return uvec2(begin, min(begin + push.chunkSize, alive));
}

/// Births of a chunk: [x, y), counted over the tick; empty for chunks of existing particles.
uvec2 birthRange(uint chunk) {
    uint begin = chunk < push.survivorChunks ? push.birthCount
                                             : (chunk - push.survivorChunks) * push.chunkSize;
    return uvec2(begin, min(begin + push.chunkSize, push.birthCount));
}

/// The group of a chunk; births begin a new one.
uint groupOf(uint chunk) {
    uint survivorGroups = (push.survivorChunks + kChunksPerGroup - 1u) / kChunksPerGroup;
    return chunk < push.survivorChunks
               ? chunk / kChunksPerGroup
               : survivorGroups + (chunk - push.survivorChunks) / kChunksPerGroup;
}
