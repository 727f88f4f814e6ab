// SPDX-License-Identifier: Apache-2.0
// The suites by name, and what several of them do alike.
#include <bench/suites/paper_table.hpp>
#include <bench/suites/suite.hpp>
#include <oit/method_info.hpp>

#include <fmt/format.h>

#include <cmath>

namespace brume::bench {

// One per file of this folder.
extern const Suite kMethodsSuite, kStochasticSuite, kPhenomenologicalSuite, kLinkedListSuite,
    kPeerSuite, kHardSuite, kNeedsSuite, kSweepsSuite, kGrowthSuite, kShadowsSuite, kSimulationSuite;

std::span<const Suite> listSuites() {
    static const Suite all[] = {kMethodsSuite, kStochasticSuite, kPhenomenologicalSuite,
                                kLinkedListSuite, kPeerSuite, kHardSuite, kNeedsSuite,
                                kSweepsSuite, kGrowthSuite, kShadowsSuite, kSimulationSuite};
    return all;
}

const Suite* findSuite(std::string_view name) {
    for (const Suite& suite : listSuites())
        if (suite.name == name) return &suite;
    return nullptr;
}

const Row* findRow(std::span<const Measurement> rows, std::string_view scene,
                   std::string_view method, ivec2 size, std::string_view shadow) {
    for (const Measurement& m : rows)
        if (m.row.scene == scene && m.row.method == method && m.row.failure.empty() &&
            (size.x == 0 || (m.row.width == size.x && m.row.height == size.y)) &&
            (shadow.empty() || m.row.shadow == shadow))
            return &m.row;
    return nullptr;
}

std::vector<std::string> listAllMethods() {
    std::vector<std::string> methods;
    for (const oit::MethodInfo& info : oit::listMethods()) {
        methods.emplace_back(info.name);
        if (info.name == "tile") methods.emplace_back("tile:epsilon=0");
    }
    return methods;
}

double sumPasses(const Row& row, std::string_view beginnings) {
    double sum = 0;
    for (const PassRow& pass : row.passes)
        for (std::string_view rest = beginnings; !rest.empty();) {
            const std::string_view word = rest.substr(0, rest.find('|'));
            rest.remove_prefix(std::min(rest.size(), word.size() + 1));
            if (!pass.name.starts_with(word)) continue;
            sum += pass.time.median;
            break;
        }
    return sum;
}

std::string formatMs(double ms) {
    if (!std::isfinite(ms)) return "-";
    const int digits = ms < 1 ? 3 : ms < 10 ? 2 : ms < 100 ? 1 : 0;
    return fmt::format("{:.{}f}", ms, digits);
}

std::string formatError(double error) { return fmt::format("{:.1e}", error); }

namespace {

/// Of our row: everything, passes by their names, or what the named ones of all phases leave.
double measurePhase(const Row& row, const PaperScene& scene, const PaperPhase& phase) {
    if (phase.passes == "total") return row.time.median;
    if (phase.passes != "other") return sumPasses(row, phase.passes);
    double rest = row.time.median;
    for (const PaperPhase& named : scene.phases)
        if (named.passes != "other" && named.passes != "total" && named.method.empty())
            rest -= sumPasses(row, named.passes);
    return std::max(rest, 0.0);
}

}  // namespace

Table makePaperTable(const PaperTable& paper, std::span<const Measurement> rows) {
    Table table{.title = paper.title,
                .header = {"paper's scene", "ours", "phase", "paper ms", "ours ms", "ours / paper",
                           "paper share", "ours share"},
                .textColumns = 3};
    table.notes = paper.notes;
    for (const PaperScene& scene : paper.scenes) {
        const auto measure = [&](const PaperPhase& phase) {
            const Row* row = findRow(rows, scene.scene,
                                     phase.method.empty() ? scene.method : phase.method);
            return row ? measurePhase(*row, scene, phase) : std::nan("");
        };
        const PaperPhase& whole = scene.phases[scene.whole];
        const double ours = measure(whole);
        for (const PaperPhase& phase : scene.phases) {
            const double ms = measure(phase);
            const bool isKnown = std::isfinite(ms) && phase.paperMs >= 0;
            table.rows.push_back(
                {scene.label, scene.scene, phase.label,
                 phase.paperMs < 0 ? "-" : formatMs(phase.paperMs), formatMs(ms),
                 isKnown && phase.paperMs > 0 ? fmt::format("{:.1f}", ms / phase.paperMs) : "-",
                 phase.paperMs < 0 ? "-" : fmt::format("{:.2f}", phase.paperMs / whole.paperMs),
                 std::isfinite(ms) ? fmt::format("{:.2f}", ms / ours) : "-"});
        }
    }
    return table;
}

}  // namespace brume::bench
