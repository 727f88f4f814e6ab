// SPDX-License-Identifier: Apache-2.0
// A renderer that goes on in time or looks from elsewhere shows what a new one would.
#include <render/render_fixture.hpp>

#include <particles/surfaces.hpp>

namespace brume::test {
namespace {

class Advance : public RenderTest {
  protected:
    render::Renderer makeRenderer(const TestScene& s, const scene::Settings& settings = {}) {
        return render::Renderer(device(), s, {.method = "linked_list", .settings = settings},
                                log());
    }

    static scene::Effect makeCloud(double rate) {
        scene::Effect effect;
        effect.capacity = 2000;
        effect.emitters = {{.rate = rate,
                            .bursts = {{0, 20}},
                            .shape = scene::EmitterShape::Sphere,
                            .radius = 0.6,
                            .speed = {0.1, 0.3},
                            .spread = kPi,
                            .lifetime = dvec2(100)}};
        effect.radius.keys = {{0, 0.08}};
        return effect;
    }
};

TEST_F(Advance, Billboards_AreMadeAnewInTheSameRenderer) {
    for (const char* shadow : {"none", "exact"}) {
        SCOPED_TRACE(shadow);
        TestScene s(32, 32);
        s.addDaylight();
        for (scene::Light& light : s.scene.lights)
            if (light.type == scene::LightType::Directional) light.shadow = shadow;
        s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeOpaque(dvec3(0.5))),
                  translation(dvec3(0, -0.8, 0)));
        scene::Effect effect = makeCloud(200);
        effect.surface = scene::Surface{.type = scene::SurfaceType::Billboard};
        const std::uint32_t material = s.addMaterial(particles::makeSurfaceMaterial(
            makeThin(0.8, dvec3(0.5, 0.6, 0.7), dvec3(0.3, 0.2, 0.1)), effect));
        s.scene.effects.push_back({.effect = effect, .material = material, .isPrepared = true});
        s.scene.effects[0].time = 0.2;
        render::Renderer renderer = makeRenderer(s);
        std::uint64_t last = computeHash(renderer.renderFrame().image);
        for (const double time : {0.4, 3.0, 0.3}) {  // more of them, and fewer again
            s.scene.effects[0].time = time;
            s.scene.camera.position += dvec3(0.3, 0.1, 0);
            ASSERT_TRUE(renderer.advance()) << time;
            const std::uint64_t hash = computeHash(renderer.renderFrame().image);
            EXPECT_EQ(hash, computeHash(makeRenderer(s).renderFrame().image)) << time;
            EXPECT_NE(hash, last);
            last = hash;
        }
    }
}

// The second begins later than the first, though neither has begun when the renderer is made.
TEST_F(Advance, InstancesWithStartsOfTheirOwn_BeginAtThem) {
    TestScene s(24, 24);
    s.addDaylight();
    const std::uint32_t medium = s.addMedium(4.0, 0.5);
    for (const double start : {1.0, 1.5})
        s.scene.effects.push_back({.file = "/cloud.json",
                                   .effect = makeCloud(100),
                                   .medium = medium,
                                   .seed = 5,
                                   .time = 0.5,
                                   .start = start});
    render::Renderer renderer = makeRenderer(s);
    for (const double time : {1.2, 1.9}) {
        for (scene::EffectInstance& effect : s.scene.effects) effect.time = time;
        ASSERT_TRUE(renderer.advance());
        EXPECT_EQ(computeHash(renderer.renderFrame().image),
                  computeHash(makeRenderer(s).renderFrame().image))
            << time;
    }
}

TEST_F(Advance, LoopThatBeginsAnew_LeavesNothingBehind) {
    TestScene s(24, 24);
    s.addDaylight();
    scene::Effect effect = makeCloud(200);
    effect.emitters[0].lifetime = dvec2(0.5);
    s.scene.effects.push_back(
        {.file = "/cloud.json", .effect = effect, .medium = s.addMedium(4.0, 0.5)});
    s.scene.effects[0].loop = 0.6;
    s.scene.effects[0].time = 0.58;
    render::Renderer renderer = makeRenderer(s);
    const auto before = renderer.readEffects().spheres.size();
    s.scene.effects[0].time = 0.61;
    ASSERT_TRUE(renderer.advance());
    EXPECT_LT(renderer.readEffects().spheres.size(), before / 2);
    EXPECT_EQ(computeHash(renderer.renderFrame().image),
              computeHash(makeRenderer(s).renderFrame().image));
}

// Particles that are thinned out look otherwise from another distance, also to the lights.
TEST_F(Advance, CameraAloneWithThinning_MakesKeptShadowMapsAnew) {
    TestScene s(16, 16);
    scene::Effect effect = makeCloud(0);
    effect.emitters[0].bursts = {{0, 1500}};
    effect.thinning = {.distance = 4, .least = 0.01};
    s.scene.effects.push_back({.effect = effect, .medium = s.addMedium(6.0, 0.5)});
    s.scene.effects[0].time = 0.1;
    scene::Light& sun = s.addLight(scene::LightType::Directional, dvec3(3));
    sun.direction = dvec3(0, -1, 0);
    sun.shadow = "exact";
    std::vector<dvec3> below;
    for (int i = 0; i < 64; ++i) below.emplace_back(i % 8 * 0.2 - 0.7, -1, i / 8 * 0.2 - 0.7);
    const scene::Settings settings = {{"shadow.keep", "true"}, {"shadow.resolution", "64"}};

    render::Renderer renderer = makeRenderer(s, settings);
    const std::vector<vec3> near = renderer.probeShadows(0, below).values;
    s.scene.camera.position = dvec3(0, 0, -40);
    ASSERT_TRUE(renderer.advance());
    const std::vector<vec3> moved = renderer.probeShadows(0, below).values;
    const std::vector<vec3> fresh = makeRenderer(s, settings).probeShadows(0, below).values;
    double changed = 0;
    for (std::size_t i = 0; i < below.size(); ++i) {
        EXPECT_NEAR(moved[i].x, fresh[i].x, 1e-3) << i;
        changed += std::abs(moved[i].x - near[i].x);
    }
    EXPECT_GT(changed, 1);  // far fewer spheres, far larger
}

}  // namespace
}  // namespace brume::test
