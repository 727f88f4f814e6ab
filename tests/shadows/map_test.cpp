// SPDX-License-Identifier: Apache-2.0
// The maps themselves: what they cost, and that static shadows stay where they are.
#include <core/error.hpp>
#include <shadows/shadow_fixture.hpp>

namespace brume::test {
namespace {

TestScene makeSmoke(const std::string& shadow) {
    TestScene s(8, 8);
    addSun(s, shadow);
    const std::uint32_t smoke = s.addMedium(3.0, 0.9);
    Random random(2);
    for (int i = 0; i < 30; ++i) {
        const dvec3 center = random.vector(-1, 1);
        s.addSphere(smoke, center, random.uniform(0.1, 0.4), scene::Profile::Smooth);
    }
    return s;
}

const std::vector<dvec3> kPoints = scatterPoints(3, 1000, dvec3(-1), dvec3(1));

class ShadowMaps : public ShadowTest {};

TEST_F(ShadowMaps, LightWithoutShadow_CostsNothing) {
    const render::Result frame = render(makeSmoke("none"), {.method = "unordered"});
    for (const render::PassTime& pass : frame.passes)
        EXPECT_FALSE(pass.name.starts_with("shadow.")) << pass.name;
    EXPECT_EQ(frame.bytes.count("shadows"), 0u);
}

TEST_F(ShadowMaps, GreyCasters_TakeOneChannel) {
    const scene::Settings settings{{"shadow.resolution", "64"}};
    TestScene s = makeSmoke("total");
    const std::uint64_t grey = render(s, {.method = "unordered", .settings = settings}).bytes.at("shadows");
    s.scene.media[0].extinction = dvec3(3, 3, 2.9);
    const std::uint64_t coloured = render(s, {.method = "unordered", .settings = settings}).bytes.at("shadows");
    EXPECT_EQ(coloured - grey, 2u * 4 * 64 * 64);
}

TEST_F(ShadowMaps, MovingCamera_LeavesTheShadowWhereItIs) {
    for (const char* store : {"visibility", "stochastic", "opaque"}) {
        SCOPED_TRACE(store);
        TestScene s = makeSmoke(store);
        s.addMesh(scene::makeBox(dvec3(0.3)), s.addMaterial(makeOpaque(dvec3(0.5))));
        const std::vector<vec3> before = probe(s, kPoints);
        s.scene.camera.position = dvec3(3.7, 1.1, -2.3);
        const std::vector<vec3> after = probe(s, kPoints);
        double sum = 0;
        for (std::size_t i = 0; i < kPoints.size(); ++i) {
            const double d = before[i].x - after[i].x;
            sum += d * d;
        }
        EXPECT_LE(std::sqrt(sum / static_cast<double>(kPoints.size())), 1e-3);
    }
}

TEST_F(ShadowMaps, MovingLight_ChangesLessThanTheNoiseBound) {
    TestScene s = makeSmoke("stochastic");
    const std::vector<vec3> before = probe(s, kPoints);
    const std::vector<dvec3> exactBefore = computeExact(s, kPoints);
    s.scene.lights[0].direction = glm::normalize(s.scene.lights[0].direction + dvec3(0.002, 0, 0));
    const std::vector<vec3> after = probe(s, kPoints);
    const std::vector<dvec3> exactAfter = computeExact(s, kPoints);
    double change = 0, bound = 0;
    for (std::size_t i = 0; i < kPoints.size(); ++i) {
        const double p = exactAfter[i].x, real = exactAfter[i].x - exactBefore[i].x;
        change += std::pow(after[i].x - before[i].x - real, 2);
        bound += 2 * 0.084 * 0.084 * p * (1 - p);  // of two independent noises
    }
    EXPECT_LE(change, bound);
}

TEST_F(ShadowMaps, KeptMap_GivesTheSameImage) {
    const TestScene s = makeSmoke("visibility");
    render::Renderer renderer(
        device(), s, {.settings = {{"shadow.keep", "true"}, {"shadow.resolution", "32"}}}, log());
    const std::uint64_t first = computeHash(renderer.renderFrame().image);
    const render::Result second = renderer.renderFrame();
    EXPECT_EQ(computeHash(second.image), first);
    for (const render::PassTime& pass : second.passes)
        EXPECT_FALSE(pass.name.starts_with("shadow.")) << pass.name;
}

TEST_F(ShadowMaps, SeveralLights_EachHaveTheirOwnMap) {
    TestScene s = makeSmoke("none");
    s.scene.lights.clear();
    addSun(s, "visibility", dvec3(0.3, -1, 0));
    addSun(s, "none", dvec3(0, -1, 0));
    addSun(s, "exact", dvec3(-0.5, -1, 0.2));
    render::Renderer renderer(device(), s, {.method = "unordered"}, log());
    const std::vector<vec3> first = renderer.probeShadows(0, kPoints).values;
    const std::vector<vec3> second = renderer.probeShadows(1, kPoints).values;
    const std::vector<vec3> third = renderer.probeShadows(2, kPoints).values;
    TestScene alone = s;
    alone.scene.lights = {s.scene.lights[2]};
    const std::vector<vec3> expected = probe(alone, kPoints);
    double difference = 0;
    for (std::size_t i = 0; i < kPoints.size(); ++i) {
        EXPECT_EQ(second[i], vec3(1));
        EXPECT_NEAR(third[i].x, expected[i].x, 1e-6);
        difference += std::abs(first[i].x - third[i].x);
    }
    EXPECT_GT(difference, 1);
}

TEST_F(ShadowMaps, UnknownStoreOrSetting_IsAnErrorThatListsTheKnown) {
    const auto messageOf = [&](const std::string& store, const std::string& setting) {
        try {
            probe(makeSmoke(store), kPoints, {{setting, "8"}});
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(messageOf("visibilty", "nodes").find("visibility, exact"), std::string::npos);
    EXPECT_NE(messageOf("visibility", "node").find("nodes"), std::string::npos);
}

}  // namespace
}  // namespace brume::test
