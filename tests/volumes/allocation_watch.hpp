// SPDX-License-Identifier: Apache-2.0
// The largest single allocation by operator new, to show that damaged files do not ask for the
// world.
#pragma once

#include <cstddef>

namespace brume::volumes::test {

void resetLargestAllocation();
std::size_t largestAllocation();

}  // namespace brume::volumes::test
