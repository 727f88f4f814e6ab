// SPDX-License-Identifier: Apache-2.0
// What the passes of a tick share: their invocations, and which particles each handles.
#include "passes.h"

layout(local_size_x_id = 0) in;
layout(push_constant, scalar) uniform Push { TickPush push; };
layout(set = 0, binding = kBindingTicks, scalar) readonly buffer TicksBlock { Tick ticks[]; };

/// The index of an invocation of Commands::dispatchThreads.
uint threadIndex() {
    return gl_GlobalInvocationID.x +
           gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
}

/// Existing particles of a chunk: [x, y); empty for chunks of births. Counted in the instance.
uvec2 survivorRange(Tick tick, uint chunk, uint alive) {
    uint begin = chunk < tick.survivorChunks ? chunk * tick.chunkSize : alive;
    return uvec2(begin, min(begin + tick.chunkSize, alive));
}

/// Births of a chunk: [x, y), counted over the tick of the instance; empty for chunks of existing
/// particles.
uvec2 birthRange(Tick tick, uint chunk, uint birthCount) {
    uint begin = chunk < tick.survivorChunks ? birthCount
                                             : (chunk - tick.survivorChunks) * tick.chunkSize;
    return uvec2(begin, min(begin + tick.chunkSize, birthCount));
}

/// The group of a chunk; births begin a new one.
uint groupOf(Tick tick, uint chunk) {
    uint survivorGroups = (tick.survivorChunks + kChunksPerGroup - 1u) / kChunksPerGroup;
    return chunk < tick.survivorChunks
               ? chunk / kChunksPerGroup
               : survivorGroups + (chunk - tick.survivorChunks) / kChunksPerGroup;
}
