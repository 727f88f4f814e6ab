// SPDX-License-Identifier: Apache-2.0
#include <bench/pareto.hpp>
#include <bench/svg.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brume::bench {
namespace {

constexpr double kSmallestError = 1e-7;  // what equal images are drawn at

bool isComparable(const Row& row) {
    return row.failure.empty() && row.error && row.time.median > 0 &&
           std::isfinite(row.error->rmse);
}

std::vector<std::size_t> listRivals(std::span<const Measurement> measurements,
                                    const std::string& group) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < measurements.size(); ++i)
        if (isComparable(measurements[i].row) && describeGroup(measurements[i].row) == group)
            rows.push_back(i);
    return rows;
}

}  // namespace

std::string describeGroup(const Row& row) {
    std::string group = fmt::format("{} {}x{}", row.scene, row.width, row.height);
    if (!row.shadow.empty() && row.shadow != "none") group += " " + row.shadow;
    return group;
}

std::vector<std::size_t> findParetoFront(std::span<const Measurement> measurements,
                                         const std::string& group) {
    std::vector<std::size_t> rows = listRivals(measurements, group);
    const auto key = [&](std::size_t i) {
        const Row& row = measurements[i].row;
        return std::pair(row.time.median, row.error->rmse);
    };
    std::sort(rows.begin(), rows.end(), [&](auto a, auto b) { return key(a) < key(b); });
    std::vector<std::size_t> front;
    for (const std::size_t i : rows)
        if (front.empty() || key(i).second < key(front.back()).second) front.push_back(i);
    return front;
}

std::set<std::string> findDominated(std::span<const Measurement> measurements) {
    std::set<std::string> dominated, groups;
    for (const Measurement& m : measurements) {
        if (isComparable(m.row)) dominated.insert(m.row.method);
        groups.insert(describeGroup(m.row));
    }
    for (const std::string& group : groups)
        for (const std::size_t i : findParetoFront(measurements, group))
            dominated.erase(measurements[i].row.method);
    return dominated;
}

std::string drawParetoPlot(std::span<const Measurement> measurements, const std::string& group) {
    const std::vector<std::size_t> rivals = listRivals(measurements, group);
    if (rivals.size() < 2) return {};
    const std::vector<std::size_t> front = findParetoFront(measurements, group);
    const auto place = [&](std::size_t i) {
        const Row& row = measurements[i].row;
        return dvec2(row.time.median, std::max(row.error->rmse, kSmallestError));
    };
    std::vector<dvec2> line;
    for (const std::size_t i : front) line.push_back(place(i));
    std::vector<Mark> marks;
    for (const std::size_t i : rivals) {
        const Row& row = measurements[i].row;
        marks.push_back({place(i), row.method,
                         fmt::format("{}: {:.3g} ms, rmse {:.2e}", row.method, row.time.median,
                                     row.error->rmse),
                         std::find(front.begin(), front.end(), i) != front.end()});
    }
    return drawMarks("ms", "rmse", marks, line);
}

}  // namespace brume::bench
