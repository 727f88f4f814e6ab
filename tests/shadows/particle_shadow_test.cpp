// SPDX-License-Identifier: Apache-2.0
// Spheres that are shadowed as a whole (scene::Shadowing::Particle).
#include <oit/method_info.hpp>
#include <shadows/shadow_fixture.hpp>

namespace brume::test {
namespace {

class ParticleShadows : public ShadowTest {
  protected:
    ParticleShadows() { mWithShadows = true; }

    static scene::MediumSphere& addParticle(TestScene& s, std::uint32_t medium, const dvec3& center,
                                            double radius,
                                            scene::Profile profile = scene::Profile::Constant) {
        scene::MediumSphere& sphere = s.addSphere(medium, center, radius, profile);
        sphere.shadowing = scene::Shadowing::Particle;
        return sphere;
    }

    /// A cloud of particles of two media, each with another phase function.
    static TestScene makeCloud(scene::Profile profile) {
        TestScene s(24, 24);
        addSun(s, "exact");
        s.scene.lights.push_back({.type = scene::LightType::Ambient, .color = dvec3(0.1, 0.2, 0.3)});
        const std::uint32_t grey = s.addMedium(2.0, 0.8);
        const std::uint32_t red = s.addMedium(dvec3(1, 2, 4), dvec3(0.9, 0.6, 0.3), dvec3(0.1, 0, 0));
        s.scene.media[red].phase = scene::PhaseType::HenyeyGreenstein;
        s.scene.media[red].g = 0.5;
        Random random(7);
        for (int i = 0; i < 12; ++i)
            addParticle(s, i % 2 ? red : grey, random.vector(-0.8, 0.8), random.uniform(0.1, 0.5),
                        profile)
                .tint = vec3(random.vector(0.5, 1));
        return s;
    }

    void expectExactEverywhere(const TestScene& s, const std::string& name, double maxError = 1e-5,
                               double excludedShare = 0) {
        for (const char* method : {"linked_list", "tile"}) {
            SCOPED_TRACE(method);
            mMethod = {.method = method};
            if (mMethod.method == "tile") mMethod.settings["epsilon"] = "0";
            expectExact(s, name + "_" + method, maxError, excludedShare);
        }
    }
};

TEST_F(ParticleShadows, LoneParticle_IsLitAsWithoutShadow) {
    TestScene s(24, 24);
    addSun(s, "exact", dvec3(0.2, -0.5, 1));
    addParticle(s, s.addMedium(3.0, 0.7), dvec3(0.1, 0, 0), 0.8, scene::Profile::Smooth);
    const Image shadowed = render(s).image;
    s.scene.lights[0].shadow = "none";
    const Image free = render(s).image;
    for (std::size_t i = 0; i < free.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shadowed.pixels[i][c], free.pixels[i][c], 1e-5);
}

TEST_F(ParticleShadows, ParticleBehindAnother_HasTheLightOfItsFront) {
    // The sun looks along x; the camera sees the two side by side.
    TestScene s(24, 24);
    addSun(s, "exact", dvec3(1, 0, 0));
    const std::uint32_t smoke = s.addMedium(1.5, 1.0);
    addParticle(s, smoke, dvec3(-0.6, 0, 0), 0.4);
    addParticle(s, smoke, dvec3(0.6, 0, 0), 0.4);
    s.scene.background.radiance = dvec3(0);
    const Image image = render(s).image;
    const vec3 lit = image.at(12 + 3, 12), behind = image.at(12 - 4, 12);  // x runs to the left
    ASSERT_GT(lit.x, 0.01f);
    EXPECT_NEAR(behind.x / lit.x, std::exp(-1.5 * 0.8), 1e-4);
}

TEST_F(ParticleShadows, ConstantParticlesUnderASun_EqualTheReference) {
    expectExactEverywhere(makeCloud(scene::Profile::Constant), "constant_sun");
}

TEST_F(ParticleShadows, ParticlesAlikeButForTheirShadows_EqualTheReference) {
    TestScene s = makeCloud(scene::Profile::Constant);
    for (scene::MediumSphere& sphere : s.spheres) {
        sphere.medium = 1;
        sphere.tint = vec3(1);
    }
    expectExactEverywhere(s, "alike");
}

TEST_F(ParticleShadows, SmoothParticlesUnderSunAndSpot_EqualTheReference) {
    TestScene s = makeCloud(scene::Profile::Smooth);
    scene::Light& spot = s.addLight(scene::LightType::Spot, dvec3(4, 3, 2));
    spot.position = dvec3(1.5, 2, -1);
    spot.direction = glm::normalize(dvec3(-0.6, -0.8, 0.4));
    spot.shadow = "exact";
    expectExactEverywhere(s, "smooth_sun_spot");
}

TEST_F(ParticleShadows, LightInsideAParticle_IsNotShadowedByIt) {
    TestScene s(16, 16);
    scene::Light& lamp = s.addLight(scene::LightType::Point, dvec3(1));
    lamp.position = dvec3(0.1, 0.05, 0);
    lamp.shadow = "exact";
    const std::uint32_t smoke = s.addMedium(4.0, 0.5);
    addParticle(s, smoke, dvec3(0), 0.8);
    addParticle(s, smoke, dvec3(1.2, 0, 0), 0.3);
    expectExactEverywhere(s, "light_inside");
}

TEST_F(ParticleShadows, ParticlesAmongEmissionAndClearGlass_EqualTheReference) {
    TestScene s = makeCloud(scene::Profile::Constant);
    s.addBox(s.addMedium(dvec3(0.3), dvec3(0), dvec3(0.2)), dvec3(-0.5), dvec3(0.5));
    s.addPane(s.addMaterial(makeThin(0.7, dvec3(0.9, 0.5, 0.2))), 0.1, 0.57);
    expectExactEverywhere(s, "with_glass", 1e-5, 0.005);
}

TEST_F(ParticleShadows, BesideMediaShadowedAtEachPlace_FollowTheReference) {
    TestScene s = makeCloud(scene::Profile::Smooth);
    s.addBox(s.addMedium(0.8, 0.9), dvec3(-0.4), dvec3(0.7));
    s.addSphere(0, dvec3(-0.5, 0.3, 0), 0.4, scene::Profile::Smooth);
    // Light is followed in steps there (docs/shadows.md).
    expectExactEverywhere(s, "mixed", 3e-3);
}

TEST_F(ParticleShadows, ApproximateMethods_LightAParticleAlike) {
    TestScene s(24, 24);
    addSun(s, "exact", dvec3(0, -1, 0.001));
    const std::uint32_t smoke = s.addMedium(1.0, 0.8);
    addParticle(s, smoke, dvec3(0), 0.4);
    addParticle(s, s.addMedium(2.0), dvec3(0, 2.5, 0), 0.5);  // out of view: casts only
    const Image exact = render(s).image;
    for (const char* method : {"sorted", "weighted", "moment", "peel", "k_buffer", "unordered"}) {
        SCOPED_TRACE(method);
        const Image image = render(s, {.method = method}).image;
        // weighted and moment keep half floats.
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            EXPECT_NEAR(image.pixels[i].x, exact.pixels[i].x, 2e-3);
    }
}

TEST_F(ParticleShadows, EveryStore_LightsTheFrontParticleFully) {
    for (const char* store : {"exact", "visibility", "opaque"}) {
        SCOPED_TRACE(store);
        TestScene s(24, 24);
        addSun(s, store, dvec3(0.3, -1, 0.2));
        addParticle(s, s.addMedium(5.0, 0.5), dvec3(0), 0.5);
        const Image shadowed = render(s).image;
        s.scene.lights[0].shadow = "none";
        const Image free = render(s).image;
        for (std::size_t i = 0; i < free.pixels.size(); ++i)
            EXPECT_NEAR(shadowed.pixels[i].x, free.pixels[i].x, 1e-3 * free.pixels[i].x);
    }
}

}  // namespace
}  // namespace brume::test
