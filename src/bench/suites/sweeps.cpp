// SPDX-License-Identifier: Apache-2.0
// How time and error grow with the size of a thing, on logarithmic axes, with the fitted exponents.
#include <bench/suites/suite.hpp>

#include <fmt/format.h>

namespace brume::bench {
namespace {

/// One measured place on an axis.
struct Stop {
    double x = 0;
    std::string scene;
    ivec2 size{0};
    std::string shadow;
    scene::Settings settings;
    std::string setting;  ///< appended to the words of the methods: ":samples=4"
    std::string truth = {};
};

enum class Figure { Ms, Rmse };

struct Sweep {
    std::string title;  ///< "particles"
    std::string xLabel;
    std::vector<std::string> methods;
    std::vector<Stop> stops;
    std::vector<Figure> figures = {Figure::Ms};
};

std::string formatCount(int count) {
    if (count % 1'000'000 == 0) return fmt::format("{}m", count / 1'000'000);
    if (count % 1'000 == 0) return fmt::format("{}k", count / 1'000);
    return std::to_string(count);
}

Sweep sweepParticles(bool isFull) {
    Sweep sweep{"particles", "spheres of 4 pixels radius", {"tile", "linked_list", "weighted"}, {}};
    const std::vector<int> counts =
        isFull ? std::vector<int>{1'000, 3'000, 10'000, 30'000, 100'000, 300'000, 1'000'000}
               : std::vector<int>{1'000, 4'000, 16'000};
    for (const int count : counts)
        sweep.stops.push_back({double(count), "spheres_" + formatCount(count) + "_4",
                               isFull ? ivec2(1280, 720) : ivec2(320, 180)});
    return sweep;
}

Sweep sweepLayers(bool isFull) {
    Sweep sweep{"layers", "full-screen layers", {"tile", "linked_list", "weighted", "moment"}, {}};
    const ivec2 size = isFull ? ivec2(640, 360) : ivec2(160, 90);
    for (int layers = 2; layers <= (isFull ? 256 : 64); layers *= isFull ? 2 : 4)
        sweep.stops.push_back(
            {double(layers), fmt::format("layers_{}_{}x{}", layers, size.x, size.y), size});
    return sweep;
}

Sweep sweepResolution(bool isFull) {
    Sweep sweep{"resolution", "pixels", {"tile", "linked_list", "weighted"}, {}};
    const std::vector<int> heights = isFull ? std::vector<int>{360, 720, 1080, 1440, 2160}
                                            : std::vector<int>{90, 180, 360};
    for (const int height : heights) {
        const ivec2 size(height * 16 / 9, height);
        sweep.stops.push_back({double(size.x) * size.y,
                               isFull ? "spheres_10k_15" : "spheres_1k_48", size});
    }
    return sweep;
}

Sweep sweepSamples(bool isFull) {
    Sweep sweep{"samples", "samples per pixel", {"stochastic"}, {}, {Figure::Ms, Figure::Rmse}};
    for (int samples = 1; samples <= (isFull ? 64 : 16); samples *= isFull ? 2 : 4)
        sweep.stops.push_back({double(samples), "mixed", isFull ? ivec2(640, 360) : ivec2(96, 54),
                               {}, {}, fmt::format(":samples={}", samples)});
    return sweep;
}

Sweep sweepShadowTexels(bool isFull) {
    Sweep sweep{"shadow texels", "texels per edge of the map", {"tile"}, {},
                {Figure::Ms, Figure::Rmse}};
    for (int texels = 64; texels <= (isFull ? 1024 : 256); texels *= 2)
        sweep.stops.push_back({double(texels), "smoke_and_glass",
                               isFull ? ivec2(320, 180) : ivec2(64, 36), "visibility",
                               {{"shadow.resolution", std::to_string(texels)},
                                {"shadow.opaqueResolution", std::to_string(texels)}}});
    return sweep;
}

Sweep sweepTolerance(bool isFull) {
    Sweep sweep{"tolerance", "tolerance of boxes for voxels, thousandths", {"tile"}, {},
                {Figure::Ms, Figure::Rmse}};
    for (int thousandths = 10; thousandths <= 640; thousandths *= isFull ? 2 : 4)
        sweep.stops.push_back({double(thousandths), fmt::format("boxes_{}", thousandths),
                               isFull ? ivec2(320, 180) : ivec2(96, 54), {}, {}, {}, "boxes_0"});
    return sweep;
}

Sweep sweepEpsilon(bool isFull) {
    Sweep sweep{"epsilon", "transmittance at which a pixel stops", {"tile"}, {},
                {Figure::Ms, Figure::Rmse}};
    for (int power = -4; power >= -16; power -= isFull ? 2 : 4)
        sweep.stops.push_back({std::exp2(power), isFull ? "mixed_10k_64" : "mixed_1k_64",
                               isFull ? ivec2(640, 360) : ivec2(160, 90), {}, {},
                               fmt::format(":epsilon={}", std::exp2(power))});
    return sweep;
}

std::vector<Sweep> makeSweeps(Scale scale) {
    const bool isFull = scale == Scale::Full;
    return {sweepParticles(isFull),    sweepLayers(isFull),    sweepResolution(isFull),
            sweepSamples(isFull),      sweepShadowTexels(isFull), sweepTolerance(isFull),
            sweepEpsilon(isFull)};
}

bool needsError(const Sweep& sweep) { return sweep.figures.size() > 1; }

std::vector<Plan> plan(Scale scale) {
    std::vector<Plan> plans;
    for (const Sweep& sweep : makeSweeps(scale))
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
            fmt::format("{:g} .. {:g}", points.front().x, points.back().x),
            fmt::format("{:.3g} .. {:.3g} {}", points.front().y, points.back().y, plot.yLabel),
            last > 0 ? fmt::format("{:.2f}", fitExponent(points)) : "-",
            last > 0 ? between(last - 1, last) : "-"};
}

Findings read(std::span<const Measurement> rows, Scale scale) {
    Findings findings;
    Table table{.title = "Exponents: figure = c x^e",
                .header = {"sweep", "method", "x", "from .. to", "e", "e at the end"},
                .textColumns = 2};
    for (const Sweep& sweep : makeSweeps(scale))
        for (const Figure figure : sweep.figures) {
            Plot plot = makePlot(sweep, figure, rows);
            for (const Series& series : plot.series)
                table.rows.push_back(describeSeries(plot, series));
            if (!plot.series.empty()) findings.plots.push_back(std::move(plot));
        }
    findings.tables.push_back(std::move(table));
    return findings;
}

}  // namespace

extern const Suite kSweepsSuite = {"sweeps", "time and error by particles, layers, pixels, samples, "
                                             "shadow texels, tolerance and epsilon",
                                   &plan, &read};

}  // namespace brume::bench
