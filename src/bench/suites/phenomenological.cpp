// SPDX-License-Identifier: Apache-2.0
// Table 1 of McGuire, Mara, "A Phenomenological Scattering Model for Order-Independent
// Transparency", 2016: run times of shadows, store and resolve.
#include <bench/suites/paper_table.hpp>

namespace brume::bench {
namespace {

PaperScene makeScene(const char* label, const char* scene, const char* method, double shadowMs,
                     double storeMs, double resolveMs) {
    return {label, scene, method,
            {{"shadow", shadowMs, "shadow."},
             {"OIT", storeMs, "oit.weighted.store|oit.weighted.clear"},
             {"resolve", resolveMs, "oit.weighted.resolve|oit.weighted.upsample"},
             {"sum", shadowMs + storeMs + resolveMs, "shadow.|oit."}},
            3};
}

PaperTable makeTable() {
    const char* plain = "weighted:diffusion=false";
    const char* low = "weighted:diffusion=false:lowResolution=4";
    return {"Phenomenological model, table 1",
            {makeScene("Door (fig. 1 left)", "frosted_panes", "weighted", 1.56, 0.04, 2.37),
             makeScene("Glasses (fig. 1 centre)", "glass_bars", "weighted:refraction=true", 5.38,
                       1.53, 0.09),
             makeScene("Foggy Night (fig. 1 right)", "foggy_street", plain, 1.92, 4.32, 4.02),
             makeScene("the same, 4x4", "foggy_street", low, 1.92, 0.37, 5.01),
             makeScene("Chess (fig. 7)", "mesh_spheres", plain, 4.89, 6.21, 0.09),
             makeScene("Engine (fig. 9)", "engine", plain, 2.03, 10.0, 0.07),
             makeScene("Hair (fig. 11)", "fur", plain, 29.68, 19.21, 0.06),
             makeScene("Car (fig. 12)", "smoke_and_glass", plain, 2.23, 2.91, 0.11),
             makeScene("the same, 4x4", "smoke_and_glass", low, 2.23, 0.25, 1.10),
             makeScene("San Miguel (fig. 14)", "mixed", plain, 6.62, 0.54, 0.09)},
            {"Published: GeForce GTX 980, 1920x1080, shadow maps of 4096 texels filtered to 1024; "
             "its two figures for shadows are added.",
             "Shares are of the sum. The store of shadows is `stochastic_vsm`, of the sun where "
             "there is one.",
             "Substituted: built scenes of the same kinds for the models; 6 000 hairs for 24 million "
             "triangles; a grid of 1 000 thin spheres for the chess set; maps of 1024 texels."}};
}

std::vector<Plan> plan(Scale scale) {
    const bool isFull = scale == Scale::Full;
    const ivec2 size = isFull ? ivec2(1920, 1080) : ivec2(240, 135);
    std::vector<Plan> plans;
    for (const PaperScene& scene : makeTable().scenes) {
        if (!plans.empty() && plans.back().scene == scene.scene) {
            plans.back().methods.push_back(scene.method);
            continue;
        }
        Plan plan{.scene = scene.scene, .methods = {scene.method}, .size = size};
        // Lamps on all sides would need six maps each, which the paper's spotlights do not.
        plan.shadow = scene.scene == "foggy_street" ? "none" : "stochastic_vsm";
        plan.settings = {{"shadow.resolution", isFull ? "1024" : "64"}};
        plans.push_back(plan);
    }
    return plans;
}

Findings read(std::span<const Measurement> rows, Scale scale) {
    PaperTable table = makeTable();
    if (scale == Scale::Quick)
        table.notes.emplace_back("Ours at 240x135, shadow maps of 64 texels.");
    return {.tables = {makePaperTable(table, rows)}};
}

}  // namespace

extern const Suite kPhenomenologicalSuite = {
    "phenomenological", "table 1 of McGuire, Mara 2016", &plan, &read};

}  // namespace brume::bench
