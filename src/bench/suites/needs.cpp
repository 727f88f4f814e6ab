// SPDX-License-Identifier: Apache-2.0
#include <bench/scene_builder.hpp>
#include <bench/scene_parts.hpp>
#include <bench/suites/needs.hpp>
#include <bench/suites/suite.hpp>
#include <shadows/store_info.hpp>

#include <fmt/format.h>

namespace brume::bench {
namespace {

/// Smoke before and behind two panes, under ambient light and one sun without shadows.
scene::Scene makePlainScene() {
    Builder b(dvec3(0, 0.8, 5), dvec3(0, 0.6, 0), 40);
    b.scene.image = {320, 180, 1};
    b.scene.background.radiance = dvec3(0.3, 0.4, 0.5);
    addDaylight(b.scene);
    b.addMesh(scene::makePlane(dvec2(12)), b.addOpaque({0.4, 0.38, 0.35}), dmat4(1));
    const std::uint32_t pane = b.addThin(0.8, dvec3(0.4), dvec3(0.1));
    b.addPane(pane, {1.6, 1.4}, {-0.6, 0.8, 0.5}, 15);
    b.addPane(pane, {1.6, 1.4}, {0.7, 0.8, -0.4}, -20);
    const std::uint32_t smoke = b.addMedium(2, dvec3(0.8));
    Random random(21);
    for (int i = 0; i < 200; ++i)
        b.addSphere(smoke, {random.uniform(-1.5, 1.5), random.uniform(0.1, 1.5), random.uniform(-1, 1)},
                    random.uniform(0.1, 0.25), random.uniform(0.1, 0.6));
    return b.scene;
}

scene::Material& paneOf(scene::Scene& scene) { return scene.materials[1]; }

void useColour(scene::Scene& scene, bool isUsed) {
    if (isUsed) paneOf(scene).transmission = dvec3(0.7, 0.4, 0.1);
}

void useDiffusion(scene::Scene& scene, bool isUsed) {
    if (isUsed) paneOf(scene).collimation = 0.5;
}

void useNothing(scene::Scene&, bool) {}

void useSecondMedium(scene::Scene& scene, bool isUsed) {
    if (!isUsed) return;
    scene.media.push_back(scene.media[0]);
    scene.media.back().albedo = dvec3(0.9, 0.4, 0.3);
    for (std::size_t i = 0; i < scene.spheres.size(); i += 2) scene.spheres[i].medium = 1;
}

template <int kCount>
void useLights(scene::Scene& scene, bool isUsed) {
    for (int i = 0; isUsed && i < kCount - 1; ++i) {
        scene::Light lamp;
        lamp.type = scene::LightType::Point;
        lamp.position = {std::cos(0.9 * i) * 2, 1.8, std::sin(0.9 * i) * 2};
        lamp.color = dvec3(0.5);
        scene.lights.push_back(lamp);
    }
}

/// Stores are known by name at run time only.
struct StoreUse {
    template <std::size_t kIndex>
    static void use(scene::Scene& scene, bool isUsed) {
        scene.lights[1].shadow = isUsed ? std::string(shadows::listStores()[kIndex].name) : "none";
        scene.lights[1].shadowSettings = {{"resolution", "128"}, {"opaqueResolution", "128"}};
    }
    template <std::size_t... kIndices>
    static void addAll(std::vector<Need>& needs, std::index_sequence<kIndices...>) {
        const auto stores = shadows::listStores();
        const auto add = [&](std::size_t index, void (*use)(scene::Scene&, bool)) {
            if (index >= stores.size()) return;
            const std::string name(stores[index].name);
            needs.push_back({"shadow_" + name, "shadow store " + name, "tile", "tile", use});
        };
        (add(kIndices, &StoreUse::use<kIndices>), ...);
    }
};

std::vector<Need> makeNeeds() {
    std::vector<Need> needs = {
        {"coloured", "coloured transmission, exact", "tile", "tile", &useColour},
        {"coloured_sums", "coloured transmission, sums", "weighted", "weighted", &useColour},
        {"diffusion", "diffusion", "weighted", "weighted", &useDiffusion},
        {"refraction", "refraction", "weighted:refraction=true", "weighted", &useNothing},
        {"overlap", "media that overlap and differ", "tile", "tile", &useSecondMedium},
        {"lights_2", "2 lights instead of 1", "tile", "tile", &useLights<2>},
        {"lights_4", "4 lights instead of 1", "tile", "tile", &useLights<4>},
        {"lights_8", "8 lights instead of 1", "tile", "tile", &useLights<8>}};
    StoreUse::addAll(needs, std::make_index_sequence<16>());
    return needs;
}

/// Described and not used: no mesh has the material, no sphere the medium.
scene::Scene makeUnusedScene() {
    scene::Scene scene = makePlainScene();
    scene::Material glass = paneOf(scene);
    glass.name = "unused";
    glass.transmission = dvec3(0.7, 0.4, 0.1);
    glass.collimation = 0.5;
    scene.materials.push_back(glass);
    glass.type = scene::MaterialType::Solid;
    glass.absorption = dvec3(1, 2, 3);
    scene.materials.push_back(glass);
    scene.media.push_back(scene.media[0]);
    scene.media.back().albedo = dvec3(0.9, 0.4, 0.3);
    return scene;
}

NamedScene makePairScene(const Need& need, bool isUsed) {
    scene::Scene scene = makePlainScene();
    need.use(scene, isUsed);
    return {"need_" + need.name + (isUsed ? "" : "_without"), std::move(scene)};
}

std::vector<Plan> plan(Scale scale) {
    const ivec2 size = scale == Scale::Full ? ivec2(1280, 720) : ivec2(160, 90);
    std::vector<Plan> plans;
    for (const Need& need : listNeeds()) {
        const std::string name = "need_" + need.name;
        plans.push_back({.scene = name, .methods = {need.method}, .size = size});
        plans.push_back({.scene = name + "_without",
                         .methods = {need.without},
                         .size = size,
                         .isRival = true});
    }
    for (const char* name : {"need_unused", "need_unused_without"})
        plans.push_back({.scene = name, .methods = listAllMethods(), .size = size});
    return plans;
}

std::uint64_t totalBytes(const Row& row) {
    const auto found = row.bytes.find("total");
    return found == row.bytes.end() ? 0 : found->second;
}

Table readCosts(std::span<const Measurement> rows) {
    Table table{.title = "What a need adds",
                .notes = {"To a scene of smoke, two panes and a sun; both scenes of a row in turn, frame by "
                          "frame."},
                .header = {"need", "method", "ms without", "ms with", "adds ms", "adds passes",
                           "adds KiB"},
                .textColumns = 2};
    for (const Need& need : listNeeds()) {
        const Row* with = findRow(rows, "need_" + need.name, need.method);
        const Row* without = findRow(rows, "need_" + need.name + "_without", need.without);
        if (!with || !without) continue;
        const auto difference = [](auto a, auto b) {
            return static_cast<long long>(a) - static_cast<long long>(b);
        };
        table.rows.push_back(
            {need.what, need.method, formatMs(without->time.median), formatMs(with->time.median),
             fmt::format("{:+.2f}", with->time.median - without->time.median),
             fmt::format("{:+}", difference(with->passes.size(), without->passes.size())),
             fmt::format("{:+}", difference(totalBytes(*with), totalBytes(*without)) / 1024)});
    }
    return table;
}

std::vector<std::string> passNames(const Row& row) {
    std::vector<std::string> names;
    for (const PassRow& pass : row.passes) names.push_back(pass.name);
    return names;
}

Table readUnused(std::span<const Measurement> rows) {
    Table table{.title = "What unused features add",
                .notes = {"Coloured glass, frosted glass, solid glass and a second medium are described in "
                          "the scene and used by nothing; the bytes are their lines in the "
                          "tables of materials and media."},
                .header = {"method", "same passes", "adds bytes", "same image"}};
    for (const std::string& method : listAllMethods()) {
        const Row* with = findRow(rows, "need_unused", method);
        const Row* without = findRow(rows, "need_unused_without", method);
        if (!with || !without) continue;
        const auto say = [](bool isSame) { return isSame ? "yes" : "NO"; };
        table.rows.push_back({method, say(passNames(*with) == passNames(*without)),
                              fmt::format("{:+}", static_cast<long long>(totalBytes(*with)) -
                                                       static_cast<long long>(totalBytes(*without))),
                              say(with->imageHash == without->imageHash)});
    }
    return table;
}

Findings read(std::span<const Measurement> rows, Scale) {
    return {.tables = {readCosts(rows), readUnused(rows)}};
}

}  // namespace

std::span<const Need> listNeeds() {
    static const std::vector<Need> needs = makeNeeds();
    return needs;
}

std::vector<NamedScene> makeNeedScenes(std::string_view name) {
    std::vector<NamedScene> all;
    for (const Need& need : listNeeds())
        for (const bool isUsed : {true, false}) {
            NamedScene named = makePairScene(need, isUsed);
            if (name == "needs" || name == named.name) all.push_back(std::move(named));
        }
    if (name == "needs" || name == "need_unused") all.push_back({"need_unused", makeUnusedScene()});
    if (name == "needs" || name == "need_unused_without")
        all.push_back({"need_unused_without", makePlainScene()});
    return all;
}

extern const Suite kNeedsSuite = {"needs", "what each optional feature adds, used and unused",
                                  &plan, &read};

}  // namespace brume::bench
