// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <core/error.hpp>
#include <particles/modules/curl_noise.hpp>

namespace brume::particles::curl_noise {
namespace {

// Root mean square of shader::curlNoiseOctave, measured over 2e6 points;
// CurlNoise_Strength_IsRootMeanSquare checks it.
constexpr double kOctaveRms = 0.03956;

void add(const ModuleValues& values, ModuleSums& sums) {
    shader::EffectParameters& parameters = *sums.parameters;
    shader::CurlNoise& noise =
        appendModule(values, "curl_noise", parameters.curlNoiseCount, parameters.curlNoise);
    const double octaves = values.number("octaves");
    // Octaves are independent, so their squares add: 1 + 1/4 + 1/16 ...
    const double squares = (1 - std::pow(0.25, octaves)) / (1 - 0.25);
    noise.strength =
        static_cast<float>(values.number("strength") / (kOctaveRms * std::sqrt(squares)));
    noise.frequency = static_cast<float>(1 / values.number("scale"));
    noise.octaves = static_cast<std::uint32_t>(octaves);
    noise.seed = shader::pcg3d(shader::uvec3(parameters.curlNoiseCount, 0, 0)).x;
    sums.noiseDrifts.push_back(values.vector("drift"));
}

}  // namespace

Module module() {
    return {{.name = "curl_noise",
             .summary = "turbulent acceleration without sources or sinks",
             .keys = {{.name = "strength",
                       .unit = "m/s^2",
                       .summary = "root mean square of the acceleration",
                       .fallback = {1},
                       .lo = 0,
                       .hi = 1e6},
                      {.name = "scale",
                       .unit = "m",
                       .summary = "size of the largest eddies",
                       .fallback = {1},
                       .lo = 1e-3,
                       .hi = 1e6},
                      {.name = "octaves",
                       .unit = "1",
                       .summary = "each with half the size and half the strength",
                       .fallback = {1},
                       .lo = 1,
                       .hi = 8,
                       .isInteger = true},
                      {.name = "drift",
                       .unit = "m/s",
                       .summary = "velocity at which the eddies move through space",
                       .fallback = {0, 0, 0},
                       .lo = -1e4,
                       .hi = 1e4}}},
            add};
}

}  // namespace brume::particles::curl_noise
