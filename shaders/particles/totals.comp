#version 460
// SPDX-License-Identifier: Apache-2.0
// Third pass of a tick, one invocation: counts of groups become offsets; the counters move on.
#extension GL_GOOGLE_include_directive : require
#include "tick.glsl"

layout(set = 0, binding = kBindingGroups, scalar) buffer GroupsBlock { uint groups[]; };
layout(set = 0, binding = kBindingTotals, scalar) buffer TotalsBlock { TickTotals totals; };

void main() {
    if (threadIndex() != 0u) return;
    Tick tick = ticks[push.slot];
    uint survivorGroups = groupOf(tick, tick.survivorChunks);
    uint birthGroups = (tick.birthChunks + kChunksPerGroup - 1u) / kChunksPerGroup;
    uint sum = 0u;
    uint survivors = 0u;
    for (uint i = 0u; i < survivorGroups + birthGroups; ++i) {
        survivors = i == survivorGroups ? sum : survivors;
        uint count = groups[i];
        groups[i] = sum;
        sum += count;
    }
    survivors = birthGroups == 0u ? sum : survivors;

    ParticleCounters counters = totals.counters;
    uint previous = counters.alive;
    uint lasting = sum - survivors;  // births that outlive this tick
    counters.alive = min(sum, tick.capacity);
    uint turnedAway = sum - counters.alive;
    counters.born += tick.birthCount - turnedAway;
    counters.died += previous - survivors + tick.birthCount - lasting;
    counters.rejected += turnedAway + tick.overflow;
    totals.counters = counters;
    totals.previousAlive = previous;
    totals.slots = tick.slots;
}
