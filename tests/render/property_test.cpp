// SPDX-License-Identifier: Apache-2.0
// Random scenes of spheres, solids, panes (some with textures) and lights: the exact methods give the
// image of the reference. A scene that fails is made as small as it goes on failing and kept as a
// file.
//
// RC_PARAMS="max_success=10000 seed=7" tests others (see rapidcheck); BRUME_COUNTEREXAMPLES names
// the folder for those that fail, instead of the temporary one.
#include <gtest/gtest.h>

#include <bench/prepare.hpp>
#include <core/image_io.hpp>
#include <render/render_fixture.hpp>
#include <scene/loader.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace brume::test {
namespace {

using Json = nlohmann::json;

/// A number in [lo, hi] in hundredths of the way; shrinks towards lo.
rc::Gen<double> between(double lo, double hi) {
    return rc::gen::map(rc::gen::inRange(0, 101),
                        [=](int i) { return lo + (hi - lo) * static_cast<double>(i) / 100; });
}

/// A number in [lo, hi], evenly in its logarithm.
rc::Gen<double> magnitude(double lo, double hi) {
    return rc::gen::map(between(std::log(lo), std::log(hi)), [](double x) { return std::exp(x); });
}

rc::Gen<Json> triple(const rc::Gen<double>& number) {
    return rc::gen::map(rc::gen::container<std::vector<double>>(3, number),
                        [](const std::vector<double>& v) { return Json(v); });
}

rc::Gen<Json> direction() {
    return rc::gen::map(triple(between(-1, 1)), [](Json v) {
        if (v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0) v[1] = -1.0;
        return v;
    });
}

/// A choice of names that have an entry in the scene.
rc::Gen<Json> anyOf(std::vector<std::string> names) {
    return rc::gen::map(rc::gen::elementOf(std::move(names)), [](const std::string& s) {
        return Json(s);
    });
}

template <typename... Gens>
rc::Gen<Json> object(const Gens&... members) {
    return rc::gen::map(rc::gen::tuple(members.second...), [=](const auto& values) {
        Json made = Json::object();
        std::apply([&](const auto&... value) { ((made[members.first] = value), ...); }, values);
        return made;
    });
}

rc::Gen<Json> medium() {
    return object(std::pair("extinction", triple(magnitude(0.05, 20))),
                  std::pair("albedo", triple(between(0, 1))),
                  std::pair("emission", triple(between(0, 2))),
                  std::pair("phase", rc::gen::element(
                                         Json{{"type", "isotropic"}}, Json{{"type", "rayleigh"}},
                                         Json{{"type", "henyey_greenstein"}, {"g", 0.6}})));
}

rc::Gen<Json> sphere() {
    return object(std::pair("center", triple(between(-1.2, 1.2))),
                  std::pair("radius", magnitude(0.05, 1.5)),
                  std::pair("density", magnitude(0.01, 30)),
                  std::pair("profile", anyOf({"constant", "smooth"})),
                  std::pair("medium", anyOf({"a", "b"})));
}

rc::Gen<Json> placement() {
    return object(std::pair("translate", triple(between(-1, 1))),
                  std::pair("rotate", triple(between(0, 90))));
}

rc::Gen<Json> pane() {
    return object(std::pair("shape", rc::gen::just(Json("plane"))),
                  std::pair("size", rc::gen::just(Json{2, 2})),
                  std::pair("material", anyOf({"thin", "wall"})),
                  std::pair("transform", placement()));
}

rc::Gen<Json> solid() {
    return object(std::pair("shape", rc::gen::just(Json("box"))),
                  std::pair("size", triple(between(0.1, 1.5))),
                  std::pair("material", rc::gen::just(Json("solid"))),
                  std::pair("transform", placement()));
}

rc::Gen<Json> light() {
    return rc::gen::oneOf(
        object(std::pair("type", rc::gen::just(Json("directional"))),
               std::pair("direction", direction()),
               std::pair("irradiance", triple(between(0, 3)))),
        object(std::pair("type", rc::gen::just(Json("point"))),
               std::pair("position", triple(between(-2, 2))),
               std::pair("intensity", triple(between(0, 3))),
               std::pair("radius", rc::gen::just(Json(0.1)))),
        object(std::pair("type", rc::gen::just(Json("spot"))),
               std::pair("position", triple(between(-2, 2))), std::pair("direction", direction()),
               std::pair("intensity", triple(between(0, 3)))));
}

rc::Gen<std::vector<Json>> upTo(int count, const rc::Gen<Json>& thing) {
    return rc::gen::mapcat(rc::gen::inRange(0, count + 1), [=](int n) {
        return rc::gen::container<std::vector<Json>>(static_cast<std::size_t>(n), thing);
    });
}

/// In the folder of the scenes, for panes and walls.
constexpr const char* kTextureFile = "brume_counterexample.png";

void writeTexture(const std::filesystem::path& folder) {
    Image image(7, 5);
    Random random(3);
    for (vec3& texel : image.pixels) texel = vec3(random.vector(0, 1));
    writeImage(folder / kTextureFile, image);
}

Json makeScene() {
    Json meshes = *upTo(3, pane()).as("panes");
    for (const Json& mesh : *upTo(2, solid()).as("solids")) meshes.push_back(mesh);
    Json lights = *upTo(2, light()).as("lights");
    lights.push_back({{"type", "ambient"}, {"radiance", {0.3, 0.4, 0.5}}});
    Json thin = {{"type", "thin"}, {"coverage", 0.8}, {"transmission", {0.9, 0.4, 0.2}},
                 {"reflected", {0.1, 0.2, 0.3}}};
    Json wall = {{"type", "opaque"}, {"albedo", {0.5, 0.6, 0.7}}};
    if (*rc::gen::arbitrary<bool>().as("has textures"))
        thin["texture"] = wall["texture"] = kTextureFile;
    return {
        {"version", 1},
        {"camera", {{"position", {0.013, 0.021, -4}}, {"target", {0, 0, 0}}, {"verticalFov", 40}}},
        {"image", {{"width", 24}, {"height", 24}}},
        {"background", {{"radiance", {0.2, 0.3, 0.4}}}},
        {"lights", lights},
        {"media", {{"a", *medium().as("medium a")}, {"b", *medium().as("medium b")}}},
        {"materials",
         {{"thin", thin},
          {"wall", wall},
          {"solid",
           {{"type", "solid"}, {"absorption", {1, 0.5, 0.2}}, {"scattering", {0.1, 0.4, 0.3}}}}}},
        {"meshes", meshes},
        {"spheres", *upTo(8, sphere()).as("spheres")}};
}

/// The exact methods and what makes them so.
std::vector<render::Options> exactMethods() {
    return {{.method = "linked_list"}, {.method = "tile", .settings = {{"epsilon", "0"}}}};
}

class Properties : public RenderTest {
  protected:
    /// The names of the methods that are off by more than 1e-5, in parts of the brightest radiance
    /// above 1, or not finite.
    std::string findWrong(const render::PreparedScene& prepared) {
        const reference::Result expected = renderReference(prepared);
        std::string wrong;
        for (const render::Options& method : exactMethods()) {
            mMethod = method;
            const Difference d = measure(prepared, expected);
            if (d.nonFinite == 0 && d.max <= 1e-5 * std::max(1.0, d.largest)) continue;
            wrong += fmt::format("{} ({:.2e} at ({}, {}), {} not finite) ", method.method, d.max,
                                 d.worst.x, d.worst.y, d.nonFinite);
        }
        return wrong;
    }
};

TEST_F(Properties, ExactMethods_GiveTheImageOfTheReference) {
    setenv("RC_PARAMS", "max_success=25 seed=20", 0);
    const char* kept = std::getenv("BRUME_COUNTEREXAMPLES");
    const std::filesystem::path folder =
        kept ? std::filesystem::path(kept) : std::filesystem::temp_directory_path();
    const std::filesystem::path file = folder / "brume_counterexample.json";
    std::filesystem::remove(file);
    writeTexture(folder);
    const bool holds = rc::check("exact methods give the image of the reference", [&] {
        const Json json = makeScene();
        const std::filesystem::path tried = folder / "brume_property.json";
        std::ofstream(tried) << json.dump(2) << '\n';
        const std::string wrong =
            findWrong(bench::prepareScene(scene::loadScene(tried, log()), log()));
        // The last one that fails is the smallest.
        std::filesystem::rename(tried, wrong.empty() ? tried : file);
        std::filesystem::remove(tried);
        RC_ASSERT(wrong == "");
    });
    EXPECT_TRUE(holds) << "kept as " << file;
}

/// What random scenes once found: opaque walls seen at flat angles, with lights beside them, were off
/// by 2e-5 where distances and places were rounded to float.
TEST_F(Properties, Counterexamples_AreExactNow) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(
             BRUME_SOURCE_DIR "/tests/render/counterexamples")) {
        ++count;
        EXPECT_EQ(findWrong(bench::prepareScene(scene::loadScene(entry.path(), log()), log())), "")
            << entry.path();
    }
    EXPECT_GE(count, 3);
}

}  // namespace
}  // namespace brume::test
