// SPDX-License-Identifier: Apache-2.0
// One measurement, as `brume render --json` and each row of `brume bench --json` state it.
#pragma once

#include <bench/error_metrics.hpp>
#include <bench/statistics.hpp>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <render/renderer.hpp>
#include <scene/settings.hpp>
#include <span>
#include <string>
#include <vector>

namespace brume::bench {

/// What one pass of a frame cost.
struct PassRow {
    std::string name;  ///< "oit.linked_list.resolve"
    TimeSummary time;  ///< ms, by the device's timestamps
    std::uint64_t bytes = 0;      ///< of what it declares to read and to write, each once
    std::uint64_t fragments = 0;  ///< shader invocations; 0 where they were not counted
    double roofMs = 0;  ///< least time for those at the measured rates; 0 without rates
};

struct Row {
    std::string suite;   ///< that asked for it, or empty
    std::string scene;   ///< file or name of a built-in scene
    std::string method;  ///< as in --method
    std::string shadow;  ///< "none", a store, or several joined by '+'
    scene::Settings settings;
    int width = 0;
    int height = 0;
    std::string device;
    std::string driver;
    std::string commit;                          ///< of Brume
    TimeSummary time;      ///< ms, first to last command of a frame, on the device
    TimeSummary wall;      ///< ms, recording, submitting and waiting, on the host
    TimeSummary yardstick; ///< ms of Yardstick::measure() in the same rounds; no repeats: none
    std::vector<PassRow> passes;
    std::map<std::string, std::uint64_t> bytes;  ///< by kind, "total" among them
    std::map<std::string, std::uint64_t> counters;
    std::uint64_t imageHash = 0;        ///< of the last frame; 16 hexadecimal digits in JSON
    std::optional<ErrorMetrics> error;  ///< if compared
    std::optional<double> errorBound;   ///< largest possible error, if the method knows one
    std::optional<double> layerPixelsPerSecond;  ///< scenes with a known number of layers only
    std::map<std::string, std::uint64_t> seeds;  ///< of everything random
    std::string command;                         ///< that measures this row again, for a shell
    std::string failure;                         ///< why there is no measurement, or empty
};

/// What `brume simulate --json` states.
struct SimulationRow {
    std::string effect;  ///< file
    std::uint64_t seed = 0;
    int frames = 0;
    double secondsPerFrame = 0;
    std::uint64_t ticks = 0;
    std::uint64_t hash = 0;  ///< over all bits of all particles; 16 hexadecimal digits in JSON
    std::uint64_t alive = 0, born = 0, died = 0, rejected = 0, killed = 0;
    TimeSummary time;  ///< ms per frame
    std::string device;
    std::string driver;
    std::string commit;
};

/// JSON objects, indented. Infinite values (psnr of equal images) become null.
std::string toJson(const Row& row);
std::string toJson(const SimulationRow& row);
std::string toJson(const ErrorMetrics& error);  ///< {"error": {...}}

/// The object of one row, for larger documents.
nlohmann::ordered_json describe(const Row& row);

/// {"<key>": [...]}: the rows of a benchmark or the frames of a sequence.
std::string toJson(std::span<const Row> rows, const std::string& key);

/// A word for a shell: quoted if it needs to be.
std::string quoteForShell(const std::string& word);

/// Brume's version and git commit, e.g. "0.1.0" and "1a2b3c4d" ("unknown" without git).
std::string version();
std::string commit();

}  // namespace brume::bench
