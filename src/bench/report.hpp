// SPDX-License-Identifier: Apache-2.0
// A benchmark for people: tables on the terminal, and a page with plots and pictures.
#pragma once

#include <bench/results.hpp>

#include <filesystem>
#include <span>
#include <string>

namespace brume::bench {

/// One row per measurement.
Table makeRowTable(std::span<const Measurement> measurements);
/// One row per pass: its time beside the least that its bytes and fragments take.
Table makePassTable(std::span<const Measurement> measurements);
/// The rows as an aligned table; also valid Markdown.
std::string formatTable(std::span<const Measurement> measurements);

/// One HTML page that needs no other file and no network: the machine, what the suites found,
/// error against time, pictures (result, reference, amplified difference), tables that sort by a
/// click or by "#sort=<table>:<column>" in the address, and the command of each row.
std::string makePage(const Results& results);

/// Writes report.html, report.md with the tables, its plots as plot_0.svg, plot_1.svg, ... and
/// rows.json into `folder`, which is created.
/// Throws a failure Error.
void writeReport(const std::filesystem::path& folder, const Results& results);

/// Writes a text file whole or not at all. Throws a failure Error.
void writeTextFile(const std::filesystem::path& file, const std::string& text);

}  // namespace brume::bench
