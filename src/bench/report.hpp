// SPDX-License-Identifier: Apache-2.0
// A benchmark for people: one table, and pictures of what each method made of each scene.
#pragma once

#include <bench/measure.hpp>
#include <filesystem>
#include <span>
#include <string>

namespace brume::bench {

/// The rows as an aligned table; also valid Markdown.
std::string formatTable(std::span<const Measurement> measurements);

/// Writes report.html (plots of error against time), report.md with the table, rows.json, and per row an image and a picture of its error
/// (PNG) into `folder`, which is created. Throws a failure Error.
void writeReport(const std::filesystem::path& folder, std::span<const Measurement> measurements);

/// Writes a text file whole or not at all. Throws a failure Error.
void writeTextFile(const std::filesystem::path& file, const std::string& text);

}  // namespace brume::bench
