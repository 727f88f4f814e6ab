// SPDX-License-Identifier: Apache-2.0
// What does this scene use? Everything that it does not is neither computed nor allocated.
#pragma once

#include <oit/inputs.hpp>
#include <render/renderer.hpp>

#include <string>

namespace brume::render {

oit::Needs findNeeds(const PreparedScene& scene);

/// One line per need, for --explain.
std::string describe(const oit::Needs& needs);

}  // namespace brume::render
