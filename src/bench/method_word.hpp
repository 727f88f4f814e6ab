// SPDX-License-Identifier: Apache-2.0
// A method with its settings in one word, as command lines and tables name it: "stochastic:samples=16".
#pragma once

#include <scene/settings.hpp>

#include <string>

namespace brume::bench {

struct MethodWord {
    std::string name;
    scene::Settings settings;
};

/// "NAME" or "NAME:KEY=VALUE:KEY=VALUE". Throws an input Error for what is not of that form; names
/// and keys are the methods' own business.
MethodWord parseMethodWord(const std::string& word);

}  // namespace brume::bench
