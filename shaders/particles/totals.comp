#version 460
// SPDX-License-Identifier: Apache-2.0
// Third pass of a tick, one invocation per instance: counts of groups become offsets; the counters
// move on.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

layout(set = 0, binding = kBindingGroups, scalar) buffer GroupsBlock { uint groups[]; };
layout(set = 0, binding = kBindingTotals, scalar) buffer TotalsBlock { TickTotals totals[]; };

void main() {
    Tick tick = ticks[push.slot];
    uint instance = threadIndex();
    if (instance >= tick.instances) return;
    uint survivorGroups = groupOf(tick, tick.survivorChunks);
    uint base = instance * tick.groups;
    uint sum = 0u;
    uint survivors = 0u;
    for (uint i = 0u; i < tick.groups; ++i) {
        survivors = i == survivorGroups ? sum : survivors;
        uint count = groups[base + i];
        groups[base + i] = sum;
        sum += count;
    }
    survivors = tick.groups == survivorGroups ? sum : survivors;

    TickTotals now = totals[instance];
    uint births = tick.isChild != 0u ? now.births : tick.birthCount;
    uint overflow = tick.isChild != 0u ? now.overflow : tick.overflow;
    uint previous = now.counters.alive;
    uint lasting = sum - survivors;  // births that outlive this tick
    now.counters.alive = min(sum, tick.capacity);
    uint turnedAway = sum - now.counters.alive;
    now.counters.born += births - turnedAway;
    now.counters.died += previous - survivors + births - lasting;
    now.counters.rejected += turnedAway + overflow;
    now.previousAlive = previous;
    now.slots = tick.slots;
    totals[instance] = now;
}
