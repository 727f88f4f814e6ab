// SPDX-License-Identifier: Apache-2.0
// The births of a tick, for the passes that count and make them.
layout(set = 0, binding = kBindingEmitters, scalar) readonly buffer Emitters {
    EmitterParameters emitters[];
};
layout(set = 0, binding = kBindingBatches, scalar) readonly buffer Batches { BirthBatch batches[]; };

/// Walks through the batches of the tick as the index of a birth rises.
struct BatchCursor {
    uint index;
    uint first;  // births of this tick before this batch
};

BatchCursor firstBatch(Tick tick) { return BatchCursor(tick.firstBatch, 0u); }

BirthBatch batchOf(Tick tick, uint birth, inout BatchCursor cursor) {
    uint last = tick.firstBatch + tick.batchCount - 1u;
    BirthBatch batch = batches[cursor.index];
    // Bounded by their number as well: lavapipe fills workgroups up to its vector width with
    // lanes whose loads give 0, and they would never leave.
    while (birth >= cursor.first + batch.count && cursor.index < last) {
        cursor.first += batch.count;
        ++cursor.index;
        batch = batches[cursor.index];
    }
    return batch;
}
