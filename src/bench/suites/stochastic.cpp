// SPDX-License-Identifier: Apache-2.0
// Table 1 of Enderton, Sintorn, Shirley, Luebke, "Stochastic Transparency", 2011: run times of the
// phases of the final algorithm.
#include <bench/suites/paper_table.hpp>

namespace brume::bench {
namespace {

const std::string kMethod = "stochastic:samples=8";

PaperScene makeScene(const char* label, const char* scene, std::vector<double> ms) {
    return {label, scene, kMethod,
            {{"base", ms[0], "oit.unordered", "unordered"},
             {"shadow", ms[1], "shadow."},
             {"opaque", ms[2], "render."},
             {"total alpha and stochastic depth", ms[3], "oit.stochastic.store"},
             {"accumulation", ms[4], "oit.stochastic.gather"},
             {"other", ms[5], "other"},
             {"total", ms[6], "total"}}};
}

/// Total alpha and stochastic depth are one phase with us: 3.3 + 2.7, 8.6 + 8.7, 6.9 + 7.0.
PaperTable makeTable() {
    return {"Stochastic Transparency, table 1",
            {makeScene("Motor (fig. 2)", "engine", {3.6, -1, 2.6, 6.0, 3.4, 1.6, 13.6}),
             makeScene("Dog (fig. 7)", "fur", {14.7, 8.9, 1.2, 17.3, 9.5, 1.5, 38.4}),
             makeScene("WindyHill (fig. 1)", "mixed", {9.5, 13.1, 2.8, 13.9, 6.9, 1.7, 38.4})},
            {"Published: GeForce GTX 280, 500x500, 8 samples, shadow maps of 16 samples.",
             "Shares are of `base`: drawing everything once, shaded and blended in any order, the "
             "paper's lower bound; ours is the method `unordered`.",
             "Substituted: 60 shells for the CAD motor, 6 000 hairs for 300 000, foliage, hair, "
             "cloth, windows and smoke for 15 000 hairs and 6 000 cards; samples of one position "
             "per pixel for MSAA; 8 samples per texel of the shadow map for 16."}};
}

std::vector<Plan> plan(Scale scale) {
    const bool isFull = scale == Scale::Full;
    std::vector<Plan> plans;
    for (const PaperScene& scene : makeTable().scenes) {
        Plan plan{.scene = scene.scene,
                  .methods = {"unordered", kMethod},
                  .size = ivec2(isFull ? 500 : 125)};
        if (scene.phases[1].paperMs > 0) {
            plan.shadow = "stochastic";
            plan.settings = {{"shadow.resolution", isFull ? "2048" : "64"},
                             {"shadow.samples", isFull ? "8" : "1"}};
        }
        plans.push_back(plan);
    }
    return plans;
}

Findings read(std::span<const Measurement> rows, Scale scale) {
    PaperTable table = makeTable();
    if (scale == Scale::Quick)
        table.notes.emplace_back("Ours at 125x125, shadow maps of 64 texels with one sample each.");
    return {.tables = {makePaperTable(table, rows)}};
}

}  // namespace

extern const Suite kStochasticSuite = {"stochastic", "table 1 of Enderton et al. 2011", &plan, &read};

}  // namespace brume::bench
