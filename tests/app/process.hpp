// SPDX-License-Identifier: Apache-2.0
// Runs the brume command as a user would and says what came of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace brume::app {

struct Outcome {
    int exitCode = -1;  ///< 128 + signal if it was killed
    std::string out;
    std::string err;
    long maxResidentMiB = 0;
};

struct Limits {
    int seconds = 120;        ///< of processor time; then it is killed
    long addressMiB = 0;      ///< of address space; 0: none (sanitizers need terabytes)
    std::string environment;  ///< one more "NAME=value", or empty
};

/// Runs `brume <arguments>`, with nothing on its standard input.
Outcome runBrume(const std::vector<std::string>& arguments, const Limits& limits = {});

/// The same, killed as soon as `isEnough()`, which is asked again and again.
Outcome runBrumeUntil(const std::vector<std::string>& arguments,
                      const std::function<bool()>& isEnough);

/// True if `err` is exactly one line that begins with "brume: ".
bool isOneErrorLine(const std::string& err);

}  // namespace brume::app
