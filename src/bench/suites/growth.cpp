// SPDX-License-Identifier: Apache-2.0
// Does the price grow linearly? By primitives and by pixels, over as much as two cores can do in
// minutes; the suite `sweeps` has more places and more axes.
#include <bench/suites/sweep.hpp>

#include <cmath>

namespace brume::bench {
namespace {

const std::vector<std::string> kMethods = {"tile", "tile:epsilon=0", "linked_list", "weighted"};

Sweep growPrimitives(bool isFull) {
    Sweep sweep{"primitives", "spheres of 4 pixels radius", kMethods, {}};
    for (const int count : isFull ? std::vector{10'000, 100'000, 1'000'000}
                                  : std::vector{1'000, 10'000, 30'000})
        sweep.stops.push_back({double(count), "spheres_" + formatCount(count) + "_4",
                               isFull ? ivec2(1280, 720) : ivec2(160, 90)});
    return sweep;
}

Sweep growPixels(bool isFull) {
    Sweep sweep{"pixels", "pixels, spheres growing with them", kMethods, {}};
    for (const int height : isFull ? std::vector{360, 720, 1080} : std::vector{90, 180}) {
        const ivec2 size(height * 16 / 9, height);
        sweep.stops.push_back({double(size.x) * size.y, isFull ? "spheres_10k_15" : "spheres_1k_48",
                               size});
    }
    return sweep;
}

std::vector<Sweep> makeSweeps(Scale scale) {
    return {growPrimitives(scale == Scale::Full), growPixels(scale == Scale::Full)};
}

std::vector<Plan> plan(Scale scale) { return planSweeps(makeSweeps(scale)); }

/// What one more primitive or pixel costs, between neighbouring places.
Table makePriceTable(const std::vector<Plot>& plots) {
    Table table{.title = "Price of one more",
                .header = {"by", "method", "from .. to", "ms", "ns per one more"},
                .textColumns = 2};
    for (const Plot& plot : plots)
        for (const Series& series : plot.series)
            for (std::size_t i = 1; i < series.points.size(); ++i) {
                const dvec2 a = series.points[i - 1], b = series.points[i];
                table.rows.push_back({plot.title, series.name, formatRange(a.x, b.x),
                                      formatMs(a.y) + " .. " + formatMs(b.y),
                                      formatMs(1e6 * (b.y - a.y) / (b.x - a.x))});
            }
    return table;
}

Findings read(std::span<const Measurement> rows, Scale scale) {
    Findings findings = readSweeps(makeSweeps(scale), rows);
    findings.tables.push_back(makePriceTable(findings.plots));
    return findings;
}

}  // namespace

extern const Suite kGrowthSuite = {"growth", "time by primitives and by pixels: is it linear?",
                                   &plan, &read};

}  // namespace brume::bench
