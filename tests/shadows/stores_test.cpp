// SPDX-License-Identifier: Apache-2.0
// What each shadow store promises: exact places exactly, noise without bias, bounds elsewhere.
#include <shadows/shadow_fixture.hpp>
#include <shadows/store_info.hpp>

namespace brume::test {
namespace {

/// Three coloured panes across the light, over each other.
TestScene makePanes(const std::string& shadow) {
    TestScene s;
    addSun(s, shadow, dvec3(0, -1, 0.001));
    const dvec3 colors[3] = {{0.9, 0.4, 0.2}, {0.3, 0.8, 0.5}, {0.6, 0.5, 0.9}};
    for (int i = 0; i < 3; ++i)
        s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeThin(0.7, colors[i])),
                  translation(dvec3(0, 0.5 - 0.5 * i, 0)));
    return s;
}

/// Away from the panes' edges and from the panes themselves.
std::vector<dvec3> panePoints() {
    std::vector<dvec3> points;
    for (const dvec3& p : scatterPoints(3, 2000, dvec3(-1.7, -1, -1.7), dvec3(1.7, 0.7, 1.7)))
        if (std::min({std::abs(p.y - 0.5), std::abs(p.y), std::abs(p.y + 0.5)}) > 0.01)
            points.push_back(p);
    return points;
}

TestScene makeCloud(const std::string& shadow) {
    TestScene s;
    addSun(s, shadow);
    const std::uint32_t smoke = s.addMedium(2.0);
    fillBricks(s.addGrid(smoke, glm::scale(translation(dvec3(-0.8)), dvec3(0.1))), 2, noiseAt);
    return s;
}

const std::vector<dvec3> kInside = scatterPoints(5, 4000, dvec3(-0.7), dvec3(0.7));
const std::vector<dvec3> kBehind =
    scatterPoints(6, 2000, dvec3(-0.4, -3.1, -0.4), dvec3(1.4, -3, 1.4));

class ShadowStores : public ShadowTest {};

TEST_F(ShadowStores, VisibilityOfPanes_IsExact) {
    const ProbeError error = measureError(makePanes("visibility"), panePoints());
    EXPECT_LE(error.max, 2e-6);
    EXPECT_EQ(error.outOfRange, 0u);
}

TEST_F(ShadowStores, VisibilityOfTwoHomogeneousBoxes_IsExact) {
    TestScene s;
    addSun(s, "visibility", dvec3(0, -1, 0.001));
    const std::uint32_t gas = s.addMedium(dvec3(1, 2, 3));
    s.addBox(gas, dvec3(-1, 0, -1), dvec3(1, 1, 1));
    s.addBox(gas, dvec3(-1, -1, -1), dvec3(1, -0.3, 1));
    const ProbeError error =
        measureError(s, scatterPoints(4, 2000, dvec3(-0.9, -1.5, -0.9), dvec3(0.9, 1.2, 0.9)));
    // A texel's ray is that of its centre: the light leans by a thousandth.
    EXPECT_LE(error.max, 1e-4);
}

TEST_F(ShadowStores, VisibilityOfCloud_MoreNodesAreBetter) {
    const TestScene s = makeCloud("visibility");
    double last = 1;
    for (const char* nodes : {"4", "8", "16"}) {
        const ProbeError inside = measureError(s, kInside, {{"nodes", nodes}});
        RecordProperty(std::string("rms_inside_") + nodes, std::to_string(inside.rms));
        EXPECT_LT(inside.rms, last);
        EXPECT_EQ(inside.outOfRange, 0u);
        last = inside.rms;
    }
    EXPECT_LE(last, 5e-3);
    EXPECT_LE(measureError(s, kBehind).rms, 1e-3);
}

TEST_F(ShadowStores, Visibility_OrderOfSubmissionChangesNothing) {
    TestScene s(8, 8);
    addSun(s, "visibility");
    const std::uint32_t smoke = s.addMedium(3.0, 0.9);
    Random random(2);
    for (int i = 0; i < 60; ++i) {
        const dvec3 center = random.vector(-1, 1);
        s.addSphere(smoke, center, random.uniform(0.1, 0.6), scene::Profile::Smooth);
    }
    const scene::Settings coarse{{"shadow.nodes", "4"}, {"shadow.resolution", "32"}};
    const std::uint64_t hash = hashOf(s, coarse);
    for (const char* seed : {"1", "2"}) {
        scene::Settings shuffled = coarse;
        shuffled["shuffle"] = seed;
        EXPECT_EQ(hashOf(s, shuffled), hash);
    }
}

TEST_F(ShadowStores, TotalBehindEverything_IsExact) {
    EXPECT_LE(measureError(makeCloud("total"), kBehind).rms, 1e-3);
    std::vector<dvec3> points = panePoints();
    std::erase_if(points, [](const dvec3& p) { return p.y > -0.5; });
    EXPECT_LE(measureError(makePanes("total"), points).max, 1e-6);
}

TEST_F(ShadowStores, StochasticWithoutCorrection_IsUnbiased) {
    const scene::Settings plain{{"alphaCorrection", "false"}};
    const ProbeError panes = measureError(makePanes("stochastic"), panePoints(), plain);
    // The noise of one tent of radius 7 is .084 sqrt(p (1 - p)) <= .042; several hundred of them
    // lie side by side here, so that the mean is 20 times closer.
    EXPECT_LE(std::abs(panes.bias), 2e-3);
    EXPECT_LE(panes.rms, 0.042);
    EXPECT_GT(panes.rms, 1e-4);
    const ProbeError cloud = measureError(makeCloud("stochastic"), kInside, plain);
    EXPECT_LE(std::abs(cloud.bias), 3e-3);
    EXPECT_EQ(cloud.outOfRange, 0u);
}

TEST_F(ShadowStores, StochasticWithCorrection_IsExactBehindPanes) {
    std::vector<dvec3> points = panePoints();
    std::erase_if(points, [](const dvec3& p) { return p.y > -0.5; });
    EXPECT_LE(measureError(makePanes("stochastic"), points).max, 1e-5);
}

TEST_F(ShadowStores, StochasticSamples_ReduceTheNoise) {
    const scene::Settings plain{{"filter", "2"}, {"alphaCorrection", "false"}};
    scene::Settings stratified = plain, independent = plain;
    stratified["samples"] = independent["samples"] = "4";
    independent["mask"] = "independent";
    TestScene s;
    addSun(s, "stochastic", dvec3(0, -1, 0.001));
    s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeThin(0.7, dvec3(0.5))));
    const std::vector<dvec3> points =
        scatterPoints(8, 2000, dvec3(-1.5, -0.6, -1.5), dvec3(1.5, -0.5, 1.5));
    const double one = measureError(s, points, plain).rms;
    const double four = measureError(s, points, independent).rms;
    EXPECT_LT(four, 0.75 * one);
    EXPECT_LT(measureError(s, points, stratified).rms, four);
}

TEST_F(ShadowStores, FourierOfCloud_GetsBetterWithCoefficients) {
    const TestScene s = makeCloud("fourier");
    const double few = measureError(s, kInside, {{"coefficients", "7"}}).rms;
    const ProbeError many = measureError(s, kInside, {{"coefficients", "15"}});
    EXPECT_LT(many.rms, few);
    EXPECT_LE(many.rms, 0.02);
    EXPECT_EQ(many.outOfRange, 0u);
}

TEST_F(ShadowStores, StochasticVsmOfThinPane_KeepsTheShadow) {
    TestScene s;
    addSun(s, "stochastic_vsm", dvec3(0, -1, 0.001));
    s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeThin(0.3, dvec3(0))),
              translation(dvec3(0, 0.5, 0)));
    s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeThin(0.0, dvec3(0))),
              translation(dvec3(0, -0.5, 0)));
    const ProbeError behind =
        measureError(s, scatterPoints(8, 500, dvec3(-1, -0.6, -1), dvec3(1, -0.5, 1)));
    EXPECT_LE(std::abs(behind.bias), 0.05);
}

TEST_F(ShadowStores, OpaqueCaster_DarkensItsShadowAndNothingElse) {
    TestScene s;
    addSun(s, "opaque", dvec3(0, -1, 0.001));
    s.addMesh(scene::makePlane(dvec2(1)), s.addMaterial(makeOpaque(dvec3(0.5))));
    s.addSphere(s.addMedium(5.0), dvec3(0, 0.5, 0), 0.3);
    const std::vector<dvec3> shadowed =
        scatterPoints(9, 200, dvec3(-0.4, -1, -0.4), dvec3(0.4, -0.1, 0.4));
    for (const vec3& t : probe(s, shadowed)) EXPECT_EQ(t, vec3(0));
    const std::vector<dvec3> lit = scatterPoints(9, 200, dvec3(-0.4, 0.1, -0.4), dvec3(2, 1, 0.4));
    for (const vec3& t : probe(s, lit)) EXPECT_EQ(t, vec3(1));
}

TEST_F(ShadowStores, OpaqueCaster_IsInEveryStore) {
    for (const shadows::StoreInfo& store : shadows::listStores()) {
        SCOPED_TRACE(store.name);
        TestScene s = makeCloud(std::string(store.name));
        s.addMesh(scene::makePlane(dvec2(6)), s.addMaterial(makeOpaque(dvec3(0.5))),
                  translation(dvec3(0, 2, 0)));
        for (const vec3& t : probe(s, scatterPoints(9, 50, dvec3(-0.5), dvec3(0.5))))
            EXPECT_EQ(t, vec3(0));
    }
}

TEST_F(ShadowStores, CutOutCaster_LetsLightThroughItsHoles) {
    for (const char* store : {"exact", "visibility"}) {
        SCOPED_TRACE(store);
        TestScene s;
        addSun(s, store, dvec3(0, -1, 0.001));
        auto texture = std::make_shared<scene::Texture>();
        texture->width = 2, texture->height = 1;
        texture->texels = {vec4(1, 0.5, 0.25, 1), vec4(1, 1, 1, 0)};
        scene::Material card = makeThin(1, dvec3(0.5));
        card.colorTexture = texture;
        s.addMesh(scene::makePlane(dvec2(2)), s.addMaterial(card));
        EXPECT_LE(
            measureError(s, scatterPoints(9, 500, dvec3(-0.8, -1, -0.8), dvec3(0.8, -0.1, 0.8)))
                .max,
            store == std::string("exact") ? 1e-4 : 2e-2);
    }
}

}  // namespace
}  // namespace brume::test
