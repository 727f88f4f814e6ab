// SPDX-License-Identifier: Apache-2.0
// What the steps of the radix sort share. Between the first and the last pass key and value lie in
// one 64-bit word, because software devices move words one by one, whatever their size. They also
// keep private arrays for a fraction of what a buffer costs, and reach bindings faster than
// addresses; those serve arrays that are too large to be bound.
#include "scan.h"

const uint kSortUnrolled = 4u;  // elements per trip of a loop; chosen by us

layout(local_size_x = 32) in;
layout(constant_id = 0) const uint kReadsPairs = 0u;
layout(constant_id = 1) const uint kWritesPairs = 0u;
layout(constant_id = 2) const uint kByAddress = 0u;
layout(push_constant, scalar) uniform Push { SortPush push; };
layout(set = 0, binding = 0, scalar) buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, scalar) buffer Values { uint values[]; };
layout(set = 0, binding = 2, scalar) readonly buffer PairsIn { uint64_t pairsIn[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer PairsOut { uint64_t pairsOut[]; };
layout(set = 0, binding = 4, scalar) buffer Counts { uint counts[]; };  // digit-major
layout(buffer_reference, scalar) buffer PairArray { uint64_t at[]; };

uint chunkCount() { return (push.count + push.chunkSize - 1u) / push.chunkSize; }

/// Elements of a chunk: [x, y).
uvec2 chunkRange(uint chunk) {
    return uvec2(chunk * push.chunkSize, min((chunk + 1u) * push.chunkSize, push.count));
}

uint loadKey(uint i) {
    if (kReadsPairs != 0u)
        return uint(kByAddress != 0u ? PairArray(push.pairsIn).at[i] : pairsIn[i]);
    return kByAddress != 0u ? UintArray(push.keys).at[i] : keys[i];
}

uint64_t loadPair(uint i) {
    if (kReadsPairs != 0u) return kByAddress != 0u ? PairArray(push.pairsIn).at[i] : pairsIn[i];
    uint value = kByAddress != 0u ? UintArray(push.values).at[i] : values[i];
    return packUint2x32(uvec2(loadKey(i), value));
}

void storePair(uint i, uint64_t pair) {
    if (kWritesPairs != 0u) {
        if (kByAddress != 0u)
            PairArray(push.pairsOut).at[i] = pair;
        else
            pairsOut[i] = pair;
        return;
    }
    uvec2 both = unpackUint2x32(pair);
    if (kByAddress != 0u) {
        UintArray(push.keys).at[i] = both.x;
        UintArray(push.values).at[i] = both.y;
    } else {
        keys[i] = both.x;
        values[i] = both.y;
    }
}

uint digitOf(uint key) { return (key >> push.shift) & (kSortDigits - 1u); }
