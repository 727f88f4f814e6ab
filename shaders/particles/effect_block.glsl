// SPDX-License-Identifier: Apache-2.0
// The parameters of the effect as the block that the shared headers read. A storage buffer for the reason given at
// struct Tick: the parameters bound loops.
layout(set = 0, binding = kBindingEffect, scalar) readonly buffer EffectBlock {
    EffectParameters effect;
};
// Modules without use cost nothing: their loops vanish when the pipeline is compiled.
#define BRUME_DECLARE_COUNT(Type, member, constant) \
    layout(constant_id = constant) const uint member##Count = 0u;
BRUME_MODULE_TYPES(BRUME_DECLARE_COUNT)
layout(constant_id = 32) const uint kSubEmitterCount = 0u;
layout(constant_id = 33) const uint kHasStrands = 0u;
layout(constant_id = 34) const uint kIsWorld = 0u;
layout(constant_id = 35) const uint kIsThinned = 0u;

#define BRUME_EFFECT effect
