// SPDX-License-Identifier: Apache-2.0
// The lines of a viewer's script, checked; see script.hpp for what they mean.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace brume::view {

struct ScriptLine {
    std::string file;
    int number = 0;  ///< of the line, from 1
    std::string verb;
    std::vector<std::string> words;  ///< as many as the verb takes
};

/// `name`: of the file, in messages. Throws an input Error with file:line for what is no command.
std::vector<ScriptLine> parseScript(const std::string& text, const std::string& name);

/// A word that the verb takes as a number, in [-1e9, 1e9].
double scriptNumber(const ScriptLine& line, std::size_t word);
std::optional<double> parseScriptNumber(const std::string& word);

/// A key by its name in scripts, as window.hpp numbers it; 0 for what is none.
int scriptKey(const std::string& name);

}  // namespace brume::view
