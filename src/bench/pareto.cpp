// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bench/pareto.hpp>
#include <cmath>

namespace brume::bench {
namespace {

constexpr double kSmallestError = 1e-7;  // what equal images are drawn at
constexpr int kWidth = 640, kHeight = 360, kMargin = 56;

bool isComparable(const Row& row) {
    return row.failure.empty() && row.error && row.time.median > 0 &&
           std::isfinite(row.error->rmse);
}

std::string escape(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '&')
            result += "&amp;";
        else
            result += c;
    }
    return result;
}

/// One axis: decades from `lo` to `hi` over a stretch of pixels.
struct Axis {
    double lo = 0, hi = 1;  // exponents of ten
    double from = 0, to = 1;

    double place(double value) const {
        return from + (to - from) * (std::log10(value) - lo) / (hi - lo);
    }
};

Axis fitAxis(const std::vector<double>& values, double from, double to) {
    const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
    Axis axis{std::floor(std::log10(*smallest)), std::ceil(std::log10(*largest)), from, to};
    if (axis.hi <= axis.lo) axis.hi = axis.lo + 1;
    return axis;
}

std::string drawGrid(const Axis& x, const Axis& y) {
    std::string svg;
    for (double e = x.lo; e <= x.hi; ++e) {
        const double at = x.place(std::pow(10, e));
        svg += fmt::format(
            "<line class='grid' x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}'/>"
            "<text x='{0:.1f}' y='{3}' text-anchor='middle'>{4:g} ms</text>\n",
            at, y.to, y.from, y.from + 16, std::pow(10, e));
    }
    for (double e = y.lo; e <= y.hi; ++e) {
        const double at = y.place(std::pow(10, e));
        svg += fmt::format(
            "<line class='grid' x1='{0}' y1='{1:.1f}' x2='{2}' y2='{1:.1f}'/>"
            "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5:.0e}</text>\n",
            x.from, at, x.to, x.from - 6, at + 4, std::pow(10, e));
    }
    return svg;
}

std::string drawScene(std::span<const Measurement> measurements, const std::string& scene) {
    std::vector<std::size_t> rows;
    std::vector<double> times, errors;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        const Row& row = measurements[i].row;
        if (row.scene != scene || !isComparable(row)) continue;
        rows.push_back(i);
        times.push_back(row.time.median);
        errors.push_back(std::max(row.error->rmse, kSmallestError));
    }
    if (rows.empty()) return {};
    const Axis x = fitAxis(times, kMargin + 14, kWidth - kMargin);
    const Axis y = fitAxis(errors, kHeight - kMargin, 20);
    const std::vector<std::size_t> front = findParetoFront(measurements, scene);

    std::string svg = fmt::format("<h2>{}</h2>\n<svg viewBox='0 0 {} {}' role='img'>\n",
                                  escape(scene), kWidth, kHeight) +
                      drawGrid(x, y);
    std::vector<std::string> line;
    const auto place = [&](std::size_t i) {
        const Row& row = measurements[i].row;
        return dvec2(x.place(row.time.median),
                     y.place(std::max(row.error->rmse, kSmallestError)));
    };
    for (const std::size_t i : front)
        line.push_back(fmt::format("{:.1f},{:.1f}", place(i).x, place(i).y));
    svg += fmt::format("<polyline class='front' points='{}'/>\n", fmt::join(line, " "));
    for (const std::size_t i : rows) {
        const bool isOnFront = std::find(front.begin(), front.end(), i) != front.end();
        const Row& row = measurements[i].row;
        svg += fmt::format(
            "<circle class='{}' cx='{:.1f}' cy='{:.1f}' r='4'><title>{}: {:.3g} ms, rmse "
            "{:.2e}</title></circle><text x='{:.1f}' y='{:.1f}'>{}</text>\n",
            isOnFront ? "best" : "rest", place(i).x, place(i).y, escape(row.method),
            row.time.median, row.error->rmse, place(i).x + 6, place(i).y - 5,
            escape(row.method));
    }
    return svg + "</svg>\n";
}

constexpr const char* kStyle =
    "body{font:14px sans-serif;max-width:60em;margin:2em auto;padding:0 1em;background:#fff;"
    "color:#222}svg{width:100%;max-width:640px}svg text{font-size:10px;fill:#333}"
    ".grid{stroke:#ddd}.front{fill:none;stroke:#c40;stroke-width:1.5}.best{fill:#c40}"
    ".rest{fill:#579}pre{overflow-x:auto;font-size:11px}";

}  // namespace

std::vector<std::size_t> findParetoFront(std::span<const Measurement> measurements,
                                         const std::string& scene) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < measurements.size(); ++i)
        if (measurements[i].row.scene == scene && isComparable(measurements[i].row))
            rows.push_back(i);
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
    std::set<std::string> dominated, scenes;
    for (const Measurement& m : measurements) {
        if (isComparable(m.row)) dominated.insert(m.row.method);
        scenes.insert(m.row.scene);
    }
    for (const std::string& scene : scenes)
        for (const std::size_t i : findParetoFront(measurements, scene))
            dominated.erase(measurements[i].row.method);
    return dominated;
}

std::string makeParetoPage(std::span<const Measurement> measurements, const std::string& title,
                           const std::string& table) {
    std::string page = fmt::format(
        "<!doctype html>\n<html lang='en'><meta charset='utf-8'><title>{0}</title>\n"
        "<style>{1}</style>\n<h1>{0}</h1>\n<p>Error (rmse, linear radiance) against time; the line "
        "joins the methods that no other beats in both.</p>\n",
        escape(title), kStyle);
    const std::set<std::string> dominated = findDominated(measurements);
    page += dominated.empty()
                ? std::string("<p>Every method is on the line of some scene.</p>\n")
                : fmt::format("<p>Beaten in both on every scene here: {}.</p>\n",
                              escape(fmt::format("{}", fmt::join(dominated, ", "))));
    std::vector<std::string> drawn;
    for (const Measurement& m : measurements) {
        if (std::find(drawn.begin(), drawn.end(), m.row.scene) != drawn.end()) continue;
        drawn.push_back(m.row.scene);
        page += drawScene(measurements, m.row.scene);
    }
    return page + "<h2>Table</h2>\n<pre>" + escape(table) + "</pre>\n</html>\n";
}

}  // namespace brume::bench
