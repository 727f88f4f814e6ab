#version 460
// SPDX-License-Identifier: Apache-2.0
// After a parent's tick, one invocation per instance: what each chunk asks of a sub-emitter becomes
// an offset, and the sum becomes the births of the child's tick; the first in order are kept.
#extension GL_GOOGLE_include_directive : require
#include "passes.h"

layout(local_size_x_id = 0) in;
layout(push_constant, scalar) uniform Push { ChildPush push; };
layout(set = 0, binding = kBindingTicks, scalar) readonly buffer TicksBlock { Tick ticks[]; };
layout(set = 0, binding = kBindingRecordCounts, scalar) buffer RecordCountsBlock { RecordCount recordCounts[]; };
layout(set = 0, binding = kBindingChildTotals, scalar) buffer ChildTotalsBlock { TickTotals childTotals[]; };

void main() {
    uint instance = gl_GlobalInvocationID.x;
    Tick tick = ticks[push.slot];
    if (instance >= tick.instances) return;
    uint base = (push.sub * tick.instances + instance) * tick.chunks;
    RecordCount sum = RecordCount(0u, 0u);
    for (uint i = base; i < base + tick.chunks; ++i) {
        RecordCount count = recordCounts[i];
        recordCounts[i] = sum;
        sum.records += count.records;
        sum.births += count.births;
    }
    uint births = min(sum.births, push.capacity);
    childTotals[instance].births = births;
    childTotals[instance].overflow = sum.births - births;
    childTotals[instance].batchCount = sum.records;
}
