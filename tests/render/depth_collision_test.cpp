// SPDX-License-Identifier: Apache-2.0
// Particles that hit what the picture shows: against planes, where the right answer is known.
#include <core/error.hpp>
#include <render/effect_particles.hpp>
#include <render/render_fixture.hpp>

#include <gpu/submitter.hpp>

namespace brume::test {
namespace {

class DepthCollision : public RenderTest {
  protected:
    /// Fifty particles that fall from 1.2 m above the ground at y = -0.8, seen from in front.
    TestScene makeFall(const scene::ModuleSettings& collider) {
        TestScene s(64, 64);
        s.scene.camera.position = dvec3(0, 0.5, -4);
        s.addMesh(scene::makePlane(dvec2(6)), s.addMaterial(makeOpaque(dvec3(0.5))),
                  translation(dvec3(0, -0.8, 0)));
        scene::Effect effect;
        effect.capacity = 64;
        effect.emitters = {{.bursts = {{0, 50}},
                            .shape = scene::EmitterShape::Disc,
                            .position = {0, 0.2, 0},
                            .radius = 0.5,
                            .lifetime = dvec2(1e6)}};
        effect.modules = {{.type = "gravity", .where = "e.json:2:3"}};
        if (!collider.type.empty()) effect.modules.push_back(collider);
        effect.radius.keys = {{0, 0.02}};
        s.scene.effects.push_back({.effect = effect, .medium = s.addMedium(1.0, 0.5)});
        s.scene.effects[0].worldFromEffect = glm::scale(dmat4(1), dvec3(2));
        s.scene.effects[0].time = 2;
        s.addDaylight();
        return s;
    }

    static scene::ModuleSettings depthCollider(const char* response, double restitution = 0) {
        return {.type = "collide_depth",
                .values = {{"restitution", {restitution}}, {"radius", {0.01}}},
                .texts = {{"response", response}},
                .where = "e.json:3:4"};
    }

    std::vector<scene::MediumSphere> spheresOf(const TestScene& s) {
        return render::Renderer(device(), s, {.method = "unordered"}, log()).readEffects().spheres;
    }
};

TEST_F(DepthCollision, WithoutTheModule_ParticlesFallThroughTheGround) {
    for (const scene::MediumSphere& sphere : spheresOf(makeFall({})))
        EXPECT_LT(sphere.center.y, -10);
}

TEST_F(DepthCollision, Bouncing_ComesToRestOnTheGround) {
    const auto spheres = spheresOf(makeFall(depthCollider("bounce")));
    ASSERT_EQ(spheres.size(), 50u);
    // The module's radius of 0.01 m, twice as large; the plane is that of a 64 x 64 image.
    for (const scene::MediumSphere& sphere : spheres)
        EXPECT_NEAR(sphere.center.y, -0.8 + 0.02, 2e-3);
}

TEST_F(DepthCollision, Restitution_IsThatOfTheClosedForm) {
    TestScene s = makeFall(depthCollider("bounce", 1));
    // In effect space it falls 0.59 m to y = -0.39 and is back at the top after twice the time.
    s.scene.effects[0].effect.tickRate = 1000;
    s.scene.effects[0].time = 2 * std::sqrt(2 * 0.59 / 9.81);
    for (const scene::MediumSphere& sphere : spheresOf(s)) EXPECT_NEAR(sphere.center.y, 0.4, 0.03);
}

TEST_F(DepthCollision, StickingAndKilling_DoWhatTheySay) {
    TestScene sticks = makeFall(depthCollider("stick"));
    sticks.scene.effects[0].effect.emitters[0].speed = dvec2(0.3);
    sticks.scene.effects[0].effect.emitters[0].direction = dvec3(1, 0, 0);
    sticks.scene.effects[0].time = 0.4;  // they land after 0.35 s
    const auto landed = spheresOf(sticks);
    sticks.scene.effects[0].time = 2;
    const auto later = spheresOf(sticks);
    ASSERT_EQ(landed.size(), 50u);
    ASSERT_EQ(later.size(), 50u);
    for (std::size_t i = 0; i < later.size(); ++i) {
        EXPECT_NEAR(later[i].center.y, -0.78, 3e-3);
        EXPECT_EQ(later[i].center, landed[i].center);
    }
    EXPECT_TRUE(spheresOf(makeFall(depthCollider("kill"))).empty());
}

TEST_F(DepthCollision, WhatIsNotSeen_IsNotHit) {
    TestScene s = makeFall(depthCollider("bounce"));
    s.scene.camera.target = s.scene.camera.position + dvec3(0, 5, -1);  // looks away
    for (const scene::MediumSphere& sphere : spheresOf(s)) EXPECT_LT(sphere.center.y, -10);
    TestScene thin = makeFall(depthCollider("bounce"));
    // 0.5 mm are less than a tick's way at 5 m/s.
    thin.scene.effects[0].effect.modules[1].values["thickness"] = {5e-4};
    std::size_t passed = 0;
    for (const scene::MediumSphere& sphere : spheresOf(thin)) passed += sphere.center.y < -1;
    EXPECT_GT(passed, 25u);
}

TEST_F(DepthCollision, ParallelRays_SeeTheSameGround) {
    TestScene s = makeFall(depthCollider("bounce"));
    s.scene.camera.type = scene::CameraType::Orthographic;
    s.scene.camera.height = 4;
    s.scene.camera.position = dvec3(0, 3, -4);
    s.scene.camera.target = dvec3(0);
    const auto spheres = spheresOf(s);
    ASSERT_EQ(spheres.size(), 50u);
    for (const scene::MediumSphere& sphere : spheres) EXPECT_NEAR(sphere.center.y, -0.78, 3e-3);
}

TEST_F(DepthCollision, Checkpoints_AreRefusedAtTheModule) {
    const TestScene s = makeFall(depthCollider("bounce"));
    const render::EffectParticles effects(device(), s);
    gpu::Submitter submitter(device());
    try {
        effects.writeCheckpoints(submitter, "/nowhere", 0);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        EXPECT_EQ(std::string(error.what()).rfind("writing checkpoints: e.json:3:4: ", 0), 0u)
            << error.what();
    }
}

}  // namespace
}  // namespace brume::test
