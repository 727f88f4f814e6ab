// SPDX-License-Identifier: Apache-2.0
#include <bench/suites/sweep.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brume::bench {
namespace {

bool needsError(const Sweep& sweep) { return sweep.figures.size() > 1; }

/// findRow() does not look at settings, which tell the stops of shadow maps apart.
const Row* findStop(std::span<const Measurement> rows, const Stop& stop, const std::string& word) {
    for (const Measurement& m : rows)
        if (m.row.scene == stop.scene && m.row.method == word && m.row.failure.empty() &&
            m.row.width == stop.size.x && m.row.height == stop.size.y &&
            std::all_of(stop.settings.begin(), stop.settings.end(), [&](const auto& setting) {
                const auto found = m.row.settings.find(setting.first);
                return found != m.row.settings.end() && found->second == setting.second;
            }))
            return &m.row;
    return nullptr;
}

Plot makePlot(const Sweep& sweep, Figure figure, std::span<const Measurement> rows) {
    Plot plot{(figure == Figure::Ms ? "Time by " : "Error by ") + sweep.title, sweep.xLabel,
              figure == Figure::Ms ? "ms" : "rmse", {}};
    for (const std::string& method : sweep.methods) {
        Series series{method, {}};
        for (const Stop& stop : sweep.stops) {
            const Row* row = findStop(rows, stop, method + stop.setting);
            if (!row || (figure == Figure::Rmse && !row->error)) continue;
            const double y = figure == Figure::Ms ? row->time.median : row->error->rmse;
            if (y > 0) series.points.emplace_back(stop.x, y);
        }
        if (!series.points.empty()) plot.series.push_back(std::move(series));
    }
    return plot;
}

/// From neighbour to neighbour too: where it bends, one exponent says little.
Cells describeSeries(const Plot& plot, const Series& series) {
    const auto& points = series.points;
    const auto between = [&](std::size_t first, std::size_t last) {
        const double exponent = fitExponent({points[first], points[last]});
        return std::isfinite(exponent) ? fmt::format("{:.2f}", exponent) : std::string("-");
    };
    const std::size_t last = points.size() - 1;
    return {plot.title, series.name,
            formatRange(points.front().x, points.back().x),
            fmt::format("{:.3g} .. {:.3g} {}", points.front().y, points.back().y, plot.yLabel),
            last > 0 ? fmt::format("{:.2f}", fitExponent(points)) : "-",
            last > 0 ? between(last - 1, last) : "-"};
}

}  // namespace

std::string formatCount(int count) {
    if (count % 1'000'000 == 0) return fmt::format("{}m", count / 1'000'000);
    if (count % 1'000 == 0) return fmt::format("{}k", count / 1'000);
    return std::to_string(count);
}

std::string formatRange(double from, double to) {
    return fmt::format("{:g} .. {:g}", from, to);
}

std::vector<Plan> planSweeps(std::span<const Sweep> sweeps) {
    std::vector<Plan> plans;
    for (const Sweep& sweep : sweeps)
        for (const Stop& stop : sweep.stops) {
            Plan plan{.scene = stop.scene,
                      .size = stop.size,
                      .shadow = stop.shadow,
                      .settings = stop.settings,
                      .withError = needsError(sweep),
                      .truth = stop.truth};
            for (const std::string& method : sweep.methods)
                plan.methods.push_back(method + stop.setting);
            plans.push_back(plan);
        }
    return plans;
}

Findings readSweeps(std::span<const Sweep> sweeps, std::span<const Measurement> rows) {
    Findings findings;
    Table table{.title = "Exponents: figure = c x^e",
                .header = {"sweep", "method", "x", "from .. to", "e", "e at the end"},
                .textColumns = 2};
    for (const Sweep& sweep : sweeps)
        for (const Figure figure : sweep.figures) {
            Plot plot = makePlot(sweep, figure, rows);
            for (const Series& series : plot.series)
                table.rows.push_back(describeSeries(plot, series));
            if (!plot.series.empty()) findings.plots.push_back(std::move(plot));
        }
    findings.tables.push_back(std::move(table));
    return findings;
}

}  // namespace brume::bench
