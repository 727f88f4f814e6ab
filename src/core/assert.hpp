// SPDX-License-Identifier: Apache-2.0
// Assertions about our own mistakes; on in the dev, test and asan builds (BRUME_ASSERTS).
#pragma once

#include <fmt/format.h>

#include <stdexcept>

namespace brume {

/// Thrown by a failed assertion: a bug in Brume, never in its input.
class AssertionError : public std::logic_error {
    using std::logic_error::logic_error;
};

}  // namespace brume

#ifdef BRUME_ASSERTS
#define BRUME_ASSERT_OP(a, op, b)                                                                  \
    do {                                                                                           \
        const auto& brumeLeft = (a);                                                               \
        const auto& brumeRight = (b);                                                              \
        if (!(brumeLeft op brumeRight))                                                            \
            throw ::brume::AssertionError(fmt::format("{}:{}: {} ({} and {})", __FILE__, __LINE__, \
                                                      #a " " #op " " #b, brumeLeft, brumeRight));  \
    } while (false)
#else
#define BRUME_ASSERT_OP(a, op, b) static_cast<void>(0)
#endif

#define BRUME_ASSERT_EQ(a, b) BRUME_ASSERT_OP(a, ==, b)
#define BRUME_ASSERT_LT(a, b) BRUME_ASSERT_OP(a, <, b)
#define BRUME_ASSERT_LE(a, b) BRUME_ASSERT_OP(a, <=, b)
