// SPDX-License-Identifier: Apache-2.0
// What:   a tile of blue noise: ranks 0 .. n^2 - 1, each once, that are evenly spread at every
//         threshold, also across the edges of the tile.
// Source: R. Ulichney: "The void-and-cluster method for dither array generation", SPIE 1913, 1993.
// Cost:   n^4 additions; 64^2 takes some 50 ms once per device.
#pragma once

#include <vector>

namespace brume::shadows {

/// size^2 values (rank + 1/2) / size^2 in (0, 1), row by row; the same in every run.
std::vector<float> makeBlueNoise(int size);

}  // namespace brume::shadows
