// SPDX-License-Identifier: Apache-2.0
// The brume command.
#include <app/command_line.hpp>

int main(int argc, char** argv) { return brume::app::run(argc, argv); }
