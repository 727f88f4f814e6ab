// SPDX-License-Identifier: Apache-2.0
// The state before a tick: word k of all particles in array k (passes.h, kStateWords).
#define BRUME_STATE_WORD(k) \
    layout(set = 0, binding = kBindingState + k, scalar) readonly buffer State##k { uint64_t state##k[]; };
BRUME_STATE_WORD(0)
BRUME_STATE_WORD(1)
BRUME_STATE_WORD(2)
BRUME_STATE_WORD(3)
BRUME_STATE_WORD(4)

/// Only the words with the life; the birth index comes along.
ParticleLife loadLife(uint slot, out uint birthIndex) {
    uvec2 birth = unpackUint2x32(state3[slot]);
    uvec2 rest = unpackUint2x32(state4[slot]);
    birthIndex = rest.y;
    return ParticleLife(birth.x, uintBitsToFloat(birth.y), uintBitsToFloat(rest.x));
}

void loadMotion(uint slot, out vec3 position, out vec3 velocity) {
    vec2 a = uintBitsToFloat(unpackUint2x32(state0[slot]));
    vec2 b = uintBitsToFloat(unpackUint2x32(state1[slot]));
    vec2 c = uintBitsToFloat(unpackUint2x32(state2[slot]));
    position = vec3(a, b.x);
    velocity = vec3(b.y, c);
}
