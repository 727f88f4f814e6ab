// SPDX-License-Identifier: Apache-2.0
// From the words on the command line to a command, and from its outcome to an exit code.
#pragma once

namespace brume::app {

/// Runs what was asked for. Returns 0 done, 1 failed, 2 wrong usage or bad input file; never
/// throws. Errors go to stderr as one line.
int run(int argc, char** argv);

}  // namespace brume::app
