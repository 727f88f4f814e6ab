// SPDX-License-Identifier: Apache-2.0
// What loads is also checked and compiled by the simulator.
#include <fuzz/target.hpp>
#include <particles/compiled_effect.hpp>
#include <scene/loader.hpp>

void brume::fuzz::parse(Bytes bytes) {
    const scene::Effect effect = scene::parseEffect(textOf(bytes), "/nowhere/e.json", Log());
    particles::compileEffect(effect);
}
