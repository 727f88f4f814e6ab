// SPDX-License-Identifier: Apache-2.0
// What method stochastic is and what may be asked of it.
#pragma once

#include <oit/oit_method.hpp>
#include <scene/settings.hpp>

#include <shaders/oit/stochastic/stochastic.h>

#include <cstdint>

namespace brume::oit::stochastic {

struct Settings {
    std::uint32_t samples = 4;
    bool isNaive = false;
    std::uint32_t estimator = shader::kEstimatorDepthAlpha;
    std::uint32_t seed = shader::kSeedPrimitive;
    std::uint32_t pattern = 0;
    float error = 0;  ///< > 0: adaptive
    std::uint32_t filter = 0;

    bool isAdaptive() const { return error > 0; }
};

/// Throws an input Error that names the setting and what is allowed.
Settings readSettings(const scene::Settings& given);

const MethodInfo& info();

}  // namespace brume::oit::stochastic
