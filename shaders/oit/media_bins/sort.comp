// SPDX-License-Identifier: Apache-2.0
// Sorts each tile's list by index, that is front to back: the scatter has left it nearly sorted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../common/bindings.glsl"
#include "../../gpu/address.glsl"
#include "bins.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { BinPush push; };

uint first;
uint load(uint i) { return UintArray(push.pairs).at[first + i]; }
void store(uint i, uint value) { UintArray(push.pairs).at[first + i] = value; }

// True if that took no more than `budget` shifts.
bool sortByInsertion(uint size, uint budget) {
    uint shifts = 0u;
    uint largest = load(0u);
    for (uint i = 1u; i < size && shifts <= budget; ++i) {
        uint value = load(i), slot = i;
        uint previous = largest;
        while (previous > value) {
            store(slot, previous);
            --slot;
            ++shifts;
            previous = slot > 0u ? load(slot - 1u) : 0u;
        }
        if (slot != i) store(slot, value);
        largest = max(largest, value);
    }
    return shifts <= budget;
}

void siftDown(uint root, uint size) {
    uint value = load(root);
    for (uint child = 2u * root + 1u; child < size; child = 2u * root + 1u) {
        if (child + 1u < size && load(child + 1u) > load(child)) ++child;
        if (load(child) <= value) break;
        store(root, load(child));
        root = child;
    }
    store(root, value);
}

void sortByHeap(uint size) {
    for (uint i = size / 2u; i > 0u; --i) siftDown(i - 1u, size);
    for (uint last = size - 1u; last > 0u; --last) {
        uint largest = load(0u);
        store(0u, load(last));
        store(last, largest);
        siftDown(0u, last);
    }
}

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= frame.tiles.x * frame.tiles.y) return;
    first = UintArray(push.counts).at[tile];
    uint size = UintArray(push.counts).at[tile + 1u] - first;
    // Iterations stay below the 65 535 after which some devices end all loops; what is not sorted
    // by then is left to methods that do not need it.
    if (size < 2u || size > 30000u) return;
    bool isHeapCheap = size < 1500u;
    if (!sortByInsertion(size, isHeapCheap ? 8u * size : 30000u) && isHeapCheap) sortByHeap(size);
}
