// SPDX-License-Identifier: Apache-2.0
// States of simulations.
#include <fuzz/target.hpp>
#include <particles/compiled_effect.hpp>
#include <particles/simulation_state.hpp>

void brume::fuzz::parse(Bytes bytes) {
    static const auto populations = [] {
        scene::Effect effect;
        effect.capacity = 64;
        effect.emitters = {{.rate = 100}};
        return particles::compileEffect(effect);
    }();
    const TempFile file(bytes, ".state");
    // The key that the corpus was written with: what is behind it shall be reached.
    particles::readCheckpoint(file.path(), {7, 1, 0}, populations);
}
