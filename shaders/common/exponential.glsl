// SPDX-License-Identifier: Apache-2.0
// The factor of Beer's law that survives thin media.
#ifndef BRUME_COMMON_EXPONENTIAL_GLSL
#define BRUME_COMMON_EXPONENTIAL_GLSL

// (1 - exp(-x)) / x for 0 <= x, where `decay` = exp(-x): a series below 0.1, where the difference
// has no digits left in fp32.
vec3 meanDecay(vec3 x, vec3 decay) {
    vec3 series = 1.0 - x * 0.5 * (1.0 - x * (1.0 / 3.0) * (1.0 - x * 0.25 * (1.0 - x * 0.2)));
    return mix((1.0 - decay) / max(x, vec3(0.1)), series, lessThan(x, vec3(0.1)));
}

// a + b as hi + lo, exactly (Knuth's two-sum).
void addExactly(inout vec3 hi, inout vec3 lo, vec3 value) {
    precise vec3 sum = hi + value;
    precise vec3 rounded = sum - hi;
    precise vec3 error = (hi - (sum - rounded)) + (value - rounded);
    hi = sum;
    lo += error;
}

void addExactly(inout float hi, inout float lo, float value) {
    precise float sum = hi + value;
    precise float rounded = sum - hi;
    precise float error = (hi - (sum - rounded)) + (value - rounded);
    hi = sum;
    lo += error;
}

#endif
