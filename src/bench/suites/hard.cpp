// SPDX-License-Identifier: Apache-2.0
// Every method on every hard case: error, finite, time.
#include <bench/hard_scenes.hpp>
#include <bench/suites/suite.hpp>

#include <fmt/format.h>

namespace brume::bench {
namespace {

std::vector<Plan> plan(Scale) {
    std::vector<Plan> plans;
    for (const HardCase& hard : listHardCases())
        plans.push_back({.scene = std::string(hard.name), .methods = listAllMethods()});
    return plans;
}

std::string judge(const HardCase& hard, const Measurement& m) {
    const Row& row = m.row;
    if (!row.failure.empty()) return "failed";
    if (!row.error) return "-";
    if (row.error->nonFinite > 0) return fmt::format("{} not finite", row.error->nonFinite);
    const std::string error = formatError(row.error->max);
    switch (judgeHardCase(row.method, hard, *row.error)) {
        case Verdict::Right:
            return error;
        case Verdict::Said:
            return error + " (said)";
        case Verdict::Wrong:
            break;
    }
    return error + " WRONG";
}

Findings read(std::span<const Measurement> rows, Scale) {
    Table errors{.title = "Largest error of each method on each hard case",
                 .notes = {fmt::format("Exact methods may be off by rounding, others by {} (of radiance "
                                       "around 1); `(said)`: it is further off, as `brume list "
                                       "methods` says it may be; `WRONG`: it is and does not say so.",
                                       kHardTolerance)},
                 .header = {"case", "what"},
                 .textColumns = 2};
    Table times{.title = "The same cases, ms", .header = {"case"}};
    const std::vector<std::string> methods = listAllMethods();
    errors.header.insert(errors.header.end(), methods.begin(), methods.end());
    times.header.insert(times.header.end(), methods.begin(), methods.end());
    for (const HardCase& hard : listHardCases()) {
        Cells error = {std::string(hard.name), std::string(hard.what)};
        Cells time = {std::string(hard.name)};
        for (const std::string& method : methods)
            for (const Measurement& m : rows)
                if (m.row.scene == hard.name && m.row.method == method) {
                    error.push_back(judge(hard, m));
                    time.push_back(formatMs(m.row.time.median));
                }
        if (error.size() > 2) errors.rows.push_back(error), times.rows.push_back(time);
    }
    return {.tables = {errors, times}};
}

}  // namespace

extern const Suite kHardSuite = {"hard", "inputs at which renderers of transparency break", &plan,
                                 &read};

}  // namespace brume::bench
