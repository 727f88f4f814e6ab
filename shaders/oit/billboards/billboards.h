// SPDX-License-Identifier: Apache-2.0
// Media drawn as screen-aligned quads; C++ and GLSL.
#ifndef BRUME_SHADERS_OIT_BILLBOARDS_H
#define BRUME_SHADERS_OIT_BILLBOARDS_H
#include "../../common/shared.h"

BRUME_STRUCTS_BEGIN

struct BillboardPush {
    uint64_t keys;   // sort: uint[count]
    uint64_t order;  // uint[count], indices in drawing order; 0: as they come
    uint count;      // sphereCount + boxCount
};

BRUME_STRUCTS_END
#endif
