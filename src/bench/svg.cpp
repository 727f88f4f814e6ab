// SPDX-License-Identifier: Apache-2.0
#include <bench/svg.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brume::bench {
namespace {

constexpr int kWidth = 640, kHeight = 360, kLeft = 70, kRight = 110, kTop = 20, kBottom = 50;
constexpr const char* kColors[] = {"#c40", "#27a", "#3a3", "#a3a", "#a80", "#088"};

/// Decades from `lo` to `hi` over a stretch of pixels.
struct Axis {
    double lo = 0, hi = 1;  // exponents of ten
    double from = 0, to = 1;

    Axis(const std::vector<double>& values, double from_, double to_) : from(from_), to(to_) {
        const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
        lo = std::floor(std::log10(*smallest));
        hi = std::max(std::ceil(std::log10(*largest)), lo + 1);
    }
    double place(double value) const {
        return from + (to - from) * (std::log10(value) - lo) / (hi - lo);
    }
};

struct Frame {
    Axis x, y;

    explicit Frame(const std::vector<dvec2>& points)
        : x(pick(points, 0), kLeft, kWidth - kRight), y(pick(points, 1), kHeight - kBottom, kTop) {}

    static std::vector<double> pick(const std::vector<dvec2>& points, int axis) {
        std::vector<double> values;
        for (const dvec2& p : points) values.push_back(p[axis]);
        return values;
    }
    std::string place(const dvec2& p) const {
        return fmt::format("{:.1f},{:.1f}", x.place(p.x), y.place(p.y));
    }

    std::string draw(const std::string& xLabel, const std::string& yLabel) const {
        std::string svg;
        for (double e = x.lo; e <= x.hi; ++e)
            svg += fmt::format(
                "<line class='grid' x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}'/>"
                "<text x='{0:.1f}' y='{3}' text-anchor='middle'>{4:g}</text>\n",
                x.place(std::pow(10, e)), y.to, y.from, y.from + 16, std::pow(10, e));
        for (double e = y.lo; e <= y.hi; ++e)
            svg += fmt::format(
                "<line class='grid' x1='{0}' y1='{1:.1f}' x2='{2}' y2='{1:.1f}'/>"
                "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5:g}</text>\n",
                x.from, y.place(std::pow(10, e)), x.to, x.from - 6, y.place(std::pow(10, e)) + 4,
                std::pow(10, e));
        return svg + fmt::format(
                         "<text x='{}' y='{}' text-anchor='middle'>{}</text><text x='12' y='{}' "
                         "text-anchor='middle' transform='rotate(-90 12 {})'>{}</text>\n",
                         (x.from + x.to) / 2, kHeight - 12, escapeHtml(xLabel), (y.from + y.to) / 2,
                         (y.from + y.to) / 2, escapeHtml(yLabel));
    }
};

std::string openSvg() {
    return fmt::format("<svg viewBox='0 0 {} {}' role='img'>\n", kWidth, kHeight);
}

std::string joinPoints(const Frame& frame, const std::vector<dvec2>& points) {
    std::string text;
    for (const dvec2& p : points) text += frame.place(p) + " ";
    return text;
}

}  // namespace

std::string drawMarks(const std::string& xLabel, const std::string& yLabel,
                      const std::vector<Mark>& marks, const std::vector<dvec2>& front) {
    if (marks.empty()) return {};
    std::vector<dvec2> points;
    for (const Mark& mark : marks) points.push_back(mark.at);
    const Frame frame(points);
    std::string svg = openSvg() + frame.draw(xLabel, yLabel);
    svg += fmt::format("<polyline class='front' points='{}'/>\n", joinPoints(frame, front));
    for (const Mark& mark : marks)
        svg += fmt::format(
            "<circle class='{}' cx='{:.1f}' cy='{:.1f}' r='4'><title>{}</title></circle>"
            "<text x='{:.1f}' y='{:.1f}'>{}</text>\n",
            mark.isBest ? "best" : "rest", frame.x.place(mark.at.x), frame.y.place(mark.at.y),
            escapeHtml(mark.hint), frame.x.place(mark.at.x) + 6, frame.y.place(mark.at.y) - 5,
            escapeHtml(mark.name));
    return svg + "</svg>\n";
}

std::string drawPlot(const Plot& plot) {
    std::vector<dvec2> all;
    for (const Series& series : plot.series)
        all.insert(all.end(), series.points.begin(), series.points.end());
    if (all.empty()) return {};
    const Frame frame(all);
    std::string svg = openSvg() + frame.draw(plot.xLabel, plot.yLabel);
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const Series& series = plot.series[i];
        if (series.points.empty()) continue;
        const char* color = kColors[i % std::size(kColors)];
        svg += fmt::format("<polyline fill='none' stroke='{}' points='{}'/>\n", color,
                           joinPoints(frame, series.points));
        for (const dvec2& p : series.points)
            svg += fmt::format(
                "<circle cx='{:.1f}' cy='{:.1f}' r='3' fill='{}'><title>{}: {:g}, {:.3g} "
                "{}</title></circle>",
                frame.x.place(p.x), frame.y.place(p.y), color, escapeHtml(series.name), p.x, p.y,
                escapeHtml(plot.yLabel));
        const dvec2 end = series.points.back();
        svg += fmt::format("<text x='{:.1f}' y='{:.1f}' style='fill:{}'>{}</text>\n",
                           frame.x.place(end.x) + 6, frame.y.place(end.y) + 3, color,
                           escapeHtml(series.name));
    }
    return svg + "</svg>\n";
}

std::string drawPlotFile(const Plot& plot) {
    const std::string svg = drawPlot(plot);
    if (svg.empty()) return {};
    const std::size_t body = svg.find('\n') + 1;
    return fmt::format(
               "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}'>\n"
               "<style>text{{font:10px sans-serif;fill:#333}}.grid{{stroke:#ddd}}</style>\n"
               "<rect width='{0}' height='{1}' fill='#fff'/>\n"
               "<text x='{2}' y='14' text-anchor='middle'>{3}</text>\n",
               kWidth, kHeight, kWidth / 2, escapeHtml(plot.title)) +
           svg.substr(body);
}

std::string escapeHtml(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '\'':
                result += "&#39;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    return result;
}

}  // namespace brume::bench
