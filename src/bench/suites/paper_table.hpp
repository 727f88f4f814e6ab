// SPDX-License-Identifier: Apache-2.0
// A published table of phases of a frame, and ours beside it.
#pragma once

#include <bench/suites/suite.hpp>

namespace brume::bench {

struct PaperPhase {
    std::string label;    ///< as published
    double paperMs = -1;  ///< as published; -1: not given
    std::string passes;  ///< beginnings of our passes' names, separated by '|'; "total": the frame;
                         ///< "other": what the scene's other phases leave of it
    std::string method = {};  ///< that is measured for it; empty: the scene's
};

struct PaperScene {
    std::string label;   ///< as published, with the figure
    std::string scene;   ///< our substitute
    std::string method;  ///< word of Plan::methods
    std::vector<PaperPhase> phases;
    std::size_t whole = 0;  ///< the phase that shares are shares of
};

struct PaperTable {
    std::string title;
    std::vector<PaperScene> scenes;
    std::vector<std::string> notes;  ///< substitutions among them
};

Table makePaperTable(const PaperTable& paper, std::span<const Measurement> rows);

}  // namespace brume::bench
