// SPDX-License-Identifier: Apache-2.0
// The entry point that libFuzzer calls.
#include <fuzz/target.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    brume::fuzz::runOne({data, size});
    return 0;
}
