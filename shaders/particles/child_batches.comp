#version 460
// SPDX-License-Identifier: Apache-2.0
// Batches that the chunks of a parent have listed move into one row, in the order of the parents.
#extension GL_GOOGLE_include_directive : require
#include "passes.h"

layout(local_size_x_id = 0) in;
layout(push_constant, scalar) uniform Push { ChildPush push; };
layout(set = 0, binding = kBindingTicks, scalar) readonly buffer TicksBlock { Tick ticks[]; };
layout(set = 0, binding = kBindingRecords, scalar) readonly buffer RecordsBlock { BirthBatch records[]; };
layout(set = 0, binding = kBindingRecordCounts, scalar) readonly buffer RecordCountsBlock { RecordCount recordCounts[]; };
layout(set = 0, binding = kBindingChildTotals, scalar) readonly buffer ChildTotalsBlock { TickTotals childTotals[]; };
layout(set = 0, binding = kBindingChildBatches, scalar) writeonly buffer ChildBatchesBlock { BirthBatch childBatches[]; };

void main() {
    uint chunk = gl_GlobalInvocationID.x +
                 gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    Tick tick = ticks[push.slot];
    uint all = tick.chunks * tick.instances;
    if (chunk >= all) return;
    uint instance = chunk / tick.chunks;
    TickTotals child = childTotals[instance];
    uint asked = child.counters.born + child.counters.rejected;
    RecordCount before = recordCounts[push.sub * all + chunk];
    bool isLast = chunk + 1u == (instance + 1u) * tick.chunks;
    uint end = isLast ? child.batchCount : recordCounts[push.sub * all + chunk + 1u].records;
    uint source = (push.sub * all + chunk) * tick.chunkSize;
    uint target = instance * push.batchStride;
    uint first = before.births;
    for (uint i = before.records; i < end; ++i) {
        BirthBatch batch = records[source + i - before.records];
        batch.first = first;
        batch.firstBirthIndex = asked + first;
        first += batch.count;
        childBatches[target + i] = batch;
    }
}
