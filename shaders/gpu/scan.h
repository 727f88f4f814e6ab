// SPDX-License-Identifier: Apache-2.0
// Exclusive prefix sum and radix sort over buffers of uint; C++ and GLSL.
#ifndef BRUME_SHADERS_GPU_SCAN_H
#define BRUME_SHADERS_GPU_SCAN_H
#include "../common/shared.h"

BRUME_STRUCTS_BEGIN

// Elements that one invocation sums in sequence: short enough for devices that cap the loop
// iterations of an invocation, long enough to need no shared memory.
BRUME_CONST uint kScanChunk = 256u;
BRUME_CONST uint kSortDigits = 256u;

struct ScanPush {
    uint64_t values;  // uint[count], in place: becomes the sum of all values before it
    uint64_t sums;    // uint[ceil(count / kScanChunk) + 1]; the last element becomes the total
    uint count;
};

struct SortPush {
    uint64_t keys, values;       // uint[count]
    uint64_t pairsIn, pairsOut;  // uint64_t[count]: key + 2^32 value
    uint count;
    uint chunkSize;
    uint shift;  // of the digit, bits
};

BRUME_STRUCTS_END
#endif
