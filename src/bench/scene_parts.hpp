// SPDX-License-Identifier: Apache-2.0
// What the built-in scenes have in common.
#pragma once

#include <bench/scenes.hpp>
#include <optional>
#include <random>

namespace brume::bench {

/// Numbers in [0, 1) that are the same with every standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : mEngine(seed) {}
    double uniform() { return static_cast<double>(mEngine() >> 11) * 0x1p-53; }
    double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

  private:
    std::mt19937_64 mEngine;
};

/// Bluish ambient light and a sun.
void addDaylight(scene::Scene& scene);

/// The scenes of src/bench/transparency_scenes.cpp; nothing for another name.
std::optional<scene::Scene> makeTransparencyScene(std::string_view name);

}  // namespace brume::bench
