// SPDX-License-Identifier: Apache-2.0
// Other programs that the viewer uses where they are installed.
#pragma once

#include <string>
#include <vector>

namespace brume::view {

/// Whether a program of that name is in the PATH.
bool hasProgram(const std::string& name);

/// Runs a program of the PATH and waits for it. `output`: what it has printed, errors as well.
/// Returns its exit status, or -1 if it could not be run or was ended by a signal.
int runProgram(const std::vector<std::string>& arguments, std::string& output);

}  // namespace brume::view
