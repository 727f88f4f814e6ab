// SPDX-License-Identifier: Apache-2.0
// Tables 1 and 2 of Barta, Kovacs, "Order Independent Transparency with Per-Pixel Linked Lists",
// 2011: frames per second by the number of full-screen layers.
#include <bench/suites/suite.hpp>

#include <fmt/format.h>

namespace brume::bench {
namespace {

struct PaperRate {
    int layers;
    ivec2 size;
    double fps;
};

constexpr PaperRate kRates[] = {
    {2, {800, 600}, 90},   {4, {800, 600}, 49},   {6, {800, 600}, 32},   {8, {800, 600}, 23},
    {10, {800, 600}, 18},  {12, {800, 600}, 14},  {14, {800, 600}, 12},  {16, {800, 600}, 10},
    {2, {1024, 768}, 51},  {4, {1024, 768}, 27},  {6, {1024, 768}, 18},  {8, {1024, 768}, 13},
    {10, {1024, 768}, 10}, {12, {1024, 768}, 8},  {14, {1024, 768}, 6},  {16, {1024, 768}, 5}};

ivec2 scaleSize(ivec2 size, Scale scale) { return scale == Scale::Full ? size : size / 4; }

std::string nameScene(const PaperRate& rate) {
    return fmt::format("layers_{}_{}x{}", rate.layers, rate.size.x, rate.size.y);
}

std::vector<Plan> plan(Scale scale) {
    std::vector<Plan> plans;
    for (const PaperRate& rate : kRates) {
        if (scale == Scale::Quick && rate.layers % 4 != 0) continue;
        plans.push_back({.scene = nameScene(rate),
                         .methods = {"linked_list", "tile"},
                         .size = scaleSize(rate.size, scale)});
    }
    return plans;
}

Findings read(std::span<const Measurement> rows, Scale scale) {
    Table table{.title = "Per-pixel linked lists, tables 1 and 2",
                .notes = {"Published: ATI Radeon HD 5700, Direct3D 11. Mlpx/s: millions of pixels times "
                          "layers per second, which does not depend on the size.",
                          "Ours: `linked_list`, with every layer shaded, sorted and blended exactly."},
                .header = {"size", "layers", "paper FPS", "paper Mlpx/s", "ours FPS", "ours ms",
                           "ours Mlpx/s", "ours / paper"}};
    if (scale == Scale::Quick) table.notes.emplace_back("Ours at a quarter of the size per edge.");
    for (const PaperRate& rate : kRates) {
        const ivec2 size = scaleSize(rate.size, scale);
        const Row* row = findRow(rows, nameScene(rate), "linked_list", size);
        if (!row || !row->layerPixelsPerSecond) continue;
        const double paper = 1e-6 * rate.fps * rate.layers * rate.size.x * rate.size.y;
        const double ours = 1e-6 * *row->layerPixelsPerSecond;
        table.rows.push_back({fmt::format("{}x{}", rate.size.x, rate.size.y),
                              std::to_string(rate.layers), fmt::format("{:.0f}", rate.fps),
                              fmt::format("{:.1f}", paper),
                              fmt::format("{:.1f}", 1e3 / row->time.median),
                              formatMs(row->time.median), fmt::format("{:.1f}", ours),
                              fmt::format("{:.2f}", ours / paper)});
    }
    return {.tables = {table}};
}

}  // namespace

extern const Suite kLinkedListSuite = {"linked_list", "tables 1 and 2 of Barta, Kovacs 2011", &plan,
                                       &read};

}  // namespace brume::bench
