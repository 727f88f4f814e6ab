// SPDX-License-Identifier: Apache-2.0
// Inputs on which shadow maps usually break.
#include <shadows/shadow_fixture.hpp>
#include <shadows/store_info.hpp>

namespace brume::test {
namespace {

class ShadowHardCases : public ShadowTest {
  protected:
    /// All stores: finite, in [0, 1]; the exact one and visibility close to the reference.
    void expectSane(TestScene s, std::span<const dvec3> points, double visibilityRms = 0.01) {
        for (const shadows::StoreInfo& store : shadows::listStores()) {
            SCOPED_TRACE(store.name);
            s.scene.lights[0].shadow = store.name;
            const ProbeError error = measureError(s, points, {{"resolution", "128"}});
            EXPECT_EQ(error.outOfRange, 0u);
            EXPECT_LE(error.rms, store.name == "exact"        ? 1e-4
                                 : store.name == "visibility" ? visibilityRms
                                                              : 1.0);
        }
    }
};

TEST_F(ShadowHardCases, EmptyScene_IsLit) {
    TestScene s;
    addSun(s, "visibility");
    for (const vec3& t : probe(s, scatterPoints(1, 10, dvec3(-1), dvec3(1)))) EXPECT_EQ(t, vec3(1));
}

TEST_F(ShadowHardCases, ParticleLitFromTheFront_DoesNotShadowItsFront) {
    for (const shadows::StoreInfo& store : shadows::listStores()) {
        if (store.name == "total") continue;           // is the shadow of everything, wherever
        if (store.name == "stochastic_vsm") continue;  // its variance reaches in front
        if (store.name == "fourier") continue;         // and so do the waves of its series
        SCOPED_TRACE(store.name);
        TestScene s;
        addSun(s, std::string(store.name), dvec3(0.2, -1, 0.1));
        s.addSphere(s.addMedium(5.0), dvec3(0), 0.5);
        const dvec3 front = -0.5001 * s.scene.lights[0].direction;
        const std::vector<dvec3> points{front, 1.2 * front};
        for (const vec3& t : probe(s, points)) EXPECT_GE(t.x, 1 - 1e-3);
    }
}

TEST_F(ShadowHardCases, FaintLayer_IsNotLost) {
    for (const char* store : {"exact", "visibility", "total"}) {
        SCOPED_TRACE(store);
        TestScene s;
        addSun(s, store, dvec3(0, -1, 0.001));
        s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeThin(1e-3, dvec3(0))));
        for (const vec3& t : probe(s, scatterPoints(2, 50, dvec3(-1, -1, -1), dvec3(1, -0.5, 1))))
            EXPECT_NEAR(t.x, 0.999, 1e-6);
    }
}

TEST_F(ShadowHardCases, DenseCore_IsFiniteAndBlack) {
    TestScene s;
    addSun(s, "exact");
    s.addSphere(s.addMedium(1.0), dvec3(0), 0.5, scene::Profile::Smooth, 1e6);
    s.addSphere(0, dvec3(0.2, 0.5, 0), 0.6, scene::Profile::Smooth, 0.5);
    expectSane(s, scatterPoints(3, 1000, dvec3(-1), dvec3(1)), 0.06);
}

TEST_F(ShadowHardCases, DepthRangeOf1e5_IsSane) {
    TestScene s;
    addSun(s, "exact", dvec3(0.01, -1, 0.02));
    const std::uint32_t smoke = s.addMedium(1.0);
    s.addSphere(smoke, dvec3(0), 0.5, scene::Profile::Smooth);
    s.addSphere(smoke, dvec3(-1000, 1e5, 0), 3, scene::Profile::Smooth);
    for (const shadows::StoreInfo& store : shadows::listStores()) {
        SCOPED_TRACE(store.name);
        s.scene.lights[0].shadow = store.name;
        EXPECT_EQ(
            measureError(s, scatterPoints(3, 500, dvec3(-1), dvec3(1)), {{"resolution", "128"}})
                .outOfRange,
            0u);
    }
}

TEST_F(ShadowHardCases, LightInsideTheSmoke_IsSane) {
    TestScene s;
    s.addLight(scene::LightType::Point, dvec3(1)).position = dvec3(0.1, 0.05, 0);
    const std::uint32_t smoke = s.addMedium(dvec3(1, 2, 3));
    s.addSphere(smoke, dvec3(0), 0.8, scene::Profile::Smooth);
    s.addSphere(smoke, dvec3(0.5, 0, 0.3), 0.3);
    s.scene.camera.position = dvec3(0.2, 0, -0.1);  // inside as well
    expectSane(s, scatterPoints(3, 1000, dvec3(-1), dvec3(1)), 0.02);
}

TEST_F(ShadowHardCases, CasterAroundASpot_IsNotClippedNearIt) {
    TestScene s;
    scene::Light& spot = s.addLight(scene::LightType::Spot, dvec3(1));
    spot.position = dvec3(0, 2, 0);
    spot.direction = dvec3(0, -1, 0);
    const std::uint32_t smoke = s.addMedium(1.0);
    s.addSphere(smoke, dvec3(0, 2, 0), 0.3);  // the light stands in its middle
    s.addMesh(scene::makePlane(dvec2(0.001)), s.addMaterial(makeThin(0.5, dvec3(0))),
              translation(dvec3(0, 1.9999, 0)));
    expectSane(s, scatterPoints(3, 1000, dvec3(-0.4, -0.5, -0.4), dvec3(0.4, 0.5, 0.4)), 0.02);
}

// Some devices end loops silently after 65 535 turns.
TEST_F(ShadowHardCases, ThousandsOfParticlesPerTexel_AllCount) {
    TestScene s;
    addSun(s, "exact", dvec3(0.02, -1, 0.01));
    const std::uint32_t smoke = s.addMedium(1.0);
    Random random(5);
    for (int i = 0; i < 3000; ++i)
        s.addSphere(smoke, random.vector(-0.3, 0.3), 0.5, scene::Profile::Smooth, 2e-3);
    const std::vector<dvec3> points =
        scatterPoints(3, 50, dvec3(-0.2, -1.2, -0.2), dvec3(0.2, -0.9, 0.2));
    for (const char* store : {"exact", "visibility", "total", "fourier"}) {
        SCOPED_TRACE(store);
        s.scene.lights[0].shadow = store;
        EXPECT_LE(measureError(s, points, {{"resolution", "32"}}).max, 7e-3);
    }
}

TEST_F(ShadowHardCases, GrazingLightOnAFloor_HasNoAcne) {
    TestScene s(24, 24);
    s.scene.camera.position = dvec3(0, 3, 0);
    s.scene.camera.up = dvec3(0, 0, 1);
    s.scene.background.radiance = dvec3(0);
    s.addMesh(scene::makePlane(dvec2(20)), s.addMaterial(makeOpaque(dvec3(1))));
    for (const char* store : {"exact", "visibility"}) {
        SCOPED_TRACE(store);
        s.scene.lights.clear();
        addSun(s, store, dvec3(1, -0.05, 0.1));
        const double cosine = -s.scene.lights[0].direction.y;
        for (const vec3& pixel : render(s, {.method = "unordered"}).image.pixels)
            EXPECT_NEAR(pixel.x, 3 * cosine / kPi, 1e-5);
    }
}

const render::Options kMethod{.method = "unordered"};  // exact for one layer

/// A glossy pane that a low sun from the left lights up, before nothing.
TestScene makeGlossyPane(const std::string& store) {
    TestScene s(12, 12);
    s.scene.background.radiance = dvec3(0);
    addSun(s, store, dvec3(0.95, 0, 0.31));
    scene::Material glossy = makeThin(1, dvec3(0.2), dvec3(0.05));
    glossy.roughness = 0.7;
    s.addPane(s.addMaterial(glossy), 0);
    return s;
}

// What reflects diffusely and what mirrors the lamp lose the same share: nothing to the pane
// itself, all to a wall, half to another pane, neither of which is in sight.
TEST_F(ShadowHardCases, HighlightOfAPane_IsShadowedAsTheRest) {
    const TestScene lit = makeGlossyPane("none");
    TestScene matt = lit;
    matt.scene.materials[0].roughness = -1;
    const Image expected = render(lit, kMethod).image;
    EXPECT_GT(expected.at(6, 6).x, 1.5f * render(matt, kMethod).image.at(6, 6).x)
        << "there is a highlight";
    for (const double share : {1.0, 0.5, 0.0}) {
        TestScene s = makeGlossyPane("visibility");
        const scene::Material between =
            share > 0 ? makeThin(1, dvec3(share)) : makeOpaque(dvec3(0));
        if (share < 1)
            s.addMesh(scene::makePlane(dvec2(3, 9)), s.addMaterial(between),
                      translation(dvec3(-3.4, 0, -1)) *
                          glm::rotate(dmat4(1), radians(-90), dvec3(1, 0, 0)));
        const Image image = render(s, kMethod).image;
        EXPECT_NEAR(image.at(6, 6).x, share * expected.at(6, 6).x, 1e-5) << share;
        for (std::size_t i = 0; share == 1 && i < image.pixels.size(); ++i)
            ASSERT_NEAR(image.pixels[i].x, expected.pixels[i].x, 1e-5) << i;
    }
}

TEST_F(ShadowHardCases, ReceiverInThePlaneOfAPane_IsFinite) {
    TestScene s;
    addSun(s, "exact", dvec3(0, -1, 0.001));
    s.addMesh(scene::makePlane(dvec2(2)), s.addMaterial(makeThin(0.5, dvec3(0.2))));
    for (const shadows::StoreInfo& store : shadows::listStores()) {
        s.scene.lights[0].shadow = store.name;
        EXPECT_EQ(
            measureError(s, scatterPoints(2, 200, dvec3(-1, 0, -1), dvec3(1, 0, 1))).outOfRange,
            0u);
    }
}

}  // namespace
}  // namespace brume::test
