// SPDX-License-Identifier: Apache-2.0
// Inputs at which renderers of transparency break, as scenes "hard_<name>"; the right answer is the
// reference's, which its own tests hold against closed forms.
#pragma once

#include <bench/error_metrics.hpp>
#include <bench/scenes.hpp>
#include <oit/method_info.hpp>

#include <span>
#include <string_view>
#include <vector>

namespace brume::bench {

struct HardCase {
    std::string_view name;  ///< "hard_thin"
    std::string_view what;  ///< what is hard about it
    std::vector<oit::Weakness> demands;  ///< beyond them, every method must get it right
    double tolerance = 1e-5;             ///< largest error of an exact method
    NamedScene (*make)();
};

std::span<const HardCase> listHardCases();

/// Largest error that an approximation may have where the case does not demand what it is weak at.
inline constexpr double kHardTolerance = 4e-3;

/// The scene of that name, all of them for "hard", nothing for others.
std::vector<NamedScene> makeHardScenes(std::string_view name);

enum class Verdict {
    Right,  ///< within the tolerance
    Said,   ///< further off, as the method's info() says that it may be
    Wrong   ///< further off without saying so, or not finite
};

/// `method`: a word of MeasureOptions::methods. Of a noisy method the mean over the image must be
/// within a hundredth even so. Throws an input Error for an unknown method.
Verdict judgeHardCase(const std::string& method, const HardCase& hard, const ErrorMetrics& error);

}  // namespace brume::bench
