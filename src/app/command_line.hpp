// SPDX-License-Identifier: Apache-2.0
// From the words on the command line to a command, and from its outcome to an exit code.
#pragma once

#include <app/commands/bench.hpp>

#include <string>
#include <vector>

namespace brume::app {

/// Runs what was asked for. Returns 0 done, 1 failed, 2 wrong usage or bad input file; never
/// throws. Errors go to stderr as one line.
int run(int argc, char** argv);

/// What the words of a `brume bench` command ask for. Throws an input Error for other words.
BenchArguments parseBenchCommand(std::vector<std::string> words);

}  // namespace brume::app
