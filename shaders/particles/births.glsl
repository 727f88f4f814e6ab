// SPDX-License-Identifier: Apache-2.0
// The births of a tick, for the passes that count and make them.
layout(set = 0, binding = kBindingEmitters, scalar) readonly buffer Emitters {
    EmitterParameters emitters[];
};
layout(set = 0, binding = kBindingBatches, scalar) readonly buffer Batches { BirthBatch batches[]; };

/// The batches of an instance's tick: [x, y). Those of a sub-emitter or in world space lie one
/// instance after the other, all others are the same for all instances.
uvec2 batchRange(Tick tick, TickTotals totals, uint instance) {
    uint first = tick.firstBatch + instance * tick.batchStride;
    return uvec2(first, first + (tick.isChild != 0u ? totals.batchCount : tick.batchCount));
}

uint birthCountOf(Tick tick, TickTotals totals) {
    return tick.isChild != 0u ? totals.births : tick.birthCount;
}

/// The batch that holds a birth of the tick: the last one with first <= birth.
uint findBatch(uvec2 range, uint birth) {
    uint low = range.x;
    uint high = range.y;
    for (uint i = 0u; i < 32u && high > low + 1u; ++i) {
        uint middle = low + (high - low) / 2u;
        bool isBelow = batches[middle].first <= birth;
        low = isBelow ? middle : low;
        high = isBelow ? high : middle;
    }
    return low;
}

/// Moves on to the batch of the next birth. Bounded by their number as well: lavapipe fills
/// workgroups up to its vector width with lanes whose loads give 0, and they would never leave.
BirthBatch batchOf(uvec2 range, uint birth, inout uint index) {
    BirthBatch batch = batches[index];
    while (birth >= batch.first + batch.count && index + 1u < range.y) {
        ++index;
        batch = batches[index];
    }
    return batch;
}
