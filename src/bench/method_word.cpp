// SPDX-License-Identifier: Apache-2.0
#include <bench/method_word.hpp>
#include <core/error.hpp>

#include <fmt/format.h>

#include <sstream>

namespace brume::bench {

MethodWord parseMethodWord(const std::string& word) {
    std::istringstream parts(word);
    MethodWord method;
    std::getline(parts, method.name, ':');
    for (std::string part; std::getline(parts, part, ':');) {
        const std::size_t equals = part.find('=');
        if (equals == 0 || equals == std::string::npos)
            throw inputError("benchmarking", "method " + word,
                             fmt::format("\"{}\" is not of the form key=value", part));
        method.settings[part.substr(0, equals)] = part.substr(equals + 1);
    }
    return method;
}

}  // namespace brume::bench
