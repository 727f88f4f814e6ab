// SPDX-License-Identifier: Apache-2.0
// Lets one function be compiled as GLSL and as C++ and give the same bits.
//
// Bit identity holds for + - *, floor, comparisons and integer operations. Replayable code
// therefore uses nothing else (sqrt, exp, sin and division are not exact on every device), marks
// every float that it computes BRUME_PRECISE, which forbids fusing and reordering, and writes sums
// out instead of calling dot(). C++ is built with -ffp-contract=off.
#ifndef BRUME_SHADERS_COMMON_SHARED_MATH_H
#define BRUME_SHADERS_COMMON_SHARED_MATH_H
#include "shared.h"

#ifdef __cplusplus

#include <bit>
#include <cmath>

#define BRUME_SHARED inline
#define BRUME_PRECISE
#define BRUME_OUT(type) type&
#define BRUME_INOUT(type) type&

namespace brume::shader {

using glm::uvec3;

inline uint floatBitsToUint(float x) { return std::bit_cast<uint>(x); }
inline float uintBitsToFloat(uint x) { return std::bit_cast<float>(x); }
inline float floor(float x) { return std::floor(x); }
inline float abs(float x) { return std::fabs(x); }

inline void umulExtended(uint a, uint b, uint& high, uint& low) {
    const uint64_t product = uint64_t{a} * b;
    high = static_cast<uint>(product >> 32u);
    low = static_cast<uint>(product);
}

}  // namespace brume::shader

#else

#define BRUME_SHARED
#define BRUME_PRECISE precise
#define BRUME_OUT(type) out type
#define BRUME_INOUT(type) inout type

#endif
#endif
