// SPDX-License-Identifier: Apache-2.0
// Numbers of the geometry along a ray: double where the device has it (BRUME_FLOAT64), else float.
// In dense media a micrometre is a thickness that shows, and fp32 distances are no finer than that
// a few metres away.
#ifndef BRUME_COMMON_REAL_GLSL
#define BRUME_COMMON_REAL_GLSL

#ifdef BRUME_FLOAT64
#define Real double
#define Real2 dvec2
#define Real3 dvec3
#define RealMat3 dmat3
#define RealMat4x3 dmat4x3
#else
#define Real float
#define Real2 vec2
#define Real3 vec3
#define RealMat3 mat3
#define RealMat4x3 mat4x3
#endif

// A number kept as its float and what that has lost, which makes no other float.
#ifdef BRUME_FLOAT64
Real makeReal(float hi, float lo) { return Real(hi) + Real(lo); }
Real3 makeReal(vec3 hi, vec3 lo) { return Real3(hi) + Real3(lo); }
#else
Real makeReal(float hi, float lo) { return hi; }
Real3 makeReal(vec3 hi, vec3 lo) { return hi; }
#endif

// What the float nearest to x has lost of it.
float findLo(Real x) { return float(x - Real(float(x))); }

#endif
