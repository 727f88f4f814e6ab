// SPDX-License-Identifier: Apache-2.0
// Things that a host adds, changes, moves and removes while a scene runs.
#include <host/host_fixture.hpp>

#include <algorithm>

namespace brume::test {
namespace {

TEST_F(HostTest, ObjectsByCalls_EqualThoseOfAFile) {
    const Context context(host().contextInfo());
    Scene fromFile = makeSceneOfText(context, kSpheresScene, "sorted");
    Scene byCalls(context, init<BrumeSceneCreateInfo>());
    auto medium = init<BrumeMedium>();
    medium.name = "smoke";
    std::fill_n(medium.extinction, 3, 1.5);
    medium.albedo[0] = 0.9, medium.albedo[1] = 0.8, medium.albedo[2] = 0.7;
    BrumeId smoke = 0, lamp = 0, spheres = 0, effect = 0;
    check(brumeAddMedium(byCalls.get(), &medium, &smoke));
    EXPECT_EQ(brumeFindMedium(byCalls.get(), "smoke"), smoke);
    EXPECT_EQ(brumeFindMedium(byCalls.get(), "fog"), 0u);
    auto ambient = init<BrumeLight>();
    ambient.color[0] = 0.4, ambient.color[1] = 0.5, ambient.color[2] = 0.6;
    check(brumeAddLight(byCalls.get(), &ambient, nullptr));
    auto sun = init<BrumeLight>();
    sun.type = BRUME_LIGHT_DIRECTIONAL;
    std::fill_n(sun.color, 3, 1.0);
    sun.direction[0] = 0.6, sun.direction[1] = -0.7, sun.direction[2] = -0.4;
    check(brumeAddLight(byCalls.get(), &sun, &lamp));
    BrumeSphere list[2] = {};
    list[0] = {{-0.4, 0.1, 0}, 1.1f, 0.7f, {}, 1};
    list[1] = {{5, 5, 5}, 1.2f, 0.5f, {}, 1};
    check(brumeAddSpheres(byCalls.get(), smoke, 2, list, &spheres));
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(byCalls.get(), &puffs, &effect));
    const auto render = [&](Scene& scene) { return host().show(context, scene, 0.1); };
    EXPECT_NE(render(byCalls), render(fromFile));
    EXPECT_EQ(byCalls.counters().effects, 1u);

    // Changed and removed, both are the same.
    std::fill_n(sun.color, 3, 3.0);
    check(brumeSetLight(byCalls.get(), lamp, &sun));
    list[1].center[0] = 0.6, list[1].center[1] = -0.2, list[1].center[2] = -0.5;
    check(brumeSetSpheres(byCalls.get(), spheres, list));
    check(brumeRemove(byCalls.get(), effect));
    EXPECT_EQ(render(byCalls), render(fromFile));
    EXPECT_EQ(brumeRemove(byCalls.get(), effect), BRUME_ERROR_INVALID_ARGUMENT);
}

// A full-grown effect goes on where it was when something else is added.
TEST_F(HostTest, AddingAnEffect_KeepsTheOthersRunning) {
    const Context context(host().contextInfo());
    Scene scene = makeSceneOfText(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    const auto step = [&](double seconds) { return host().show(context, scene, seconds); };
    step(0.5);
    const std::vector<vec4> before = step(0.5);
    puffs.worldFromEffect[0] = puffs.worldFromEffect[5] = puffs.worldFromEffect[10] = 1;
    puffs.worldFromEffect[13] = 100;  // out of sight
    puffs.worldFromEffect[15] = 1;
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    EXPECT_EQ(step(0), before);
    EXPECT_EQ(scene.counters().ticksBehind, 0u);
}

TEST_F(HostTest, MaxTicksPerFrame_IsCaughtUpLater) {
    auto info = host().contextInfo();
    info.maxTicksPerFrame = 20;
    const Context context(info);
    Scene scene = makeSceneOfText(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    std::vector<std::uint64_t> behind;
    for (int i = 0; i < 4; ++i) {
        host().show(context, scene, i == 0 ? 1 : 0);
        behind.push_back(scene.counters().ticksBehind);
    }
    EXPECT_EQ(behind, (std::vector<std::uint64_t>{40, 20, 0, 0}));
}

// A thousand kilometres away, and then counted from there: the same picture, and the effect goes
// on.
TEST_F(HostTest, RebasedScene_ShowsTheSame) {
    const Context context(host().contextInfo());
    Scene scene = makeSceneOfText(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    BrumeId id = 0;
    check(brumeAddEffect(scene.get(), &puffs, &id));
    const auto step = [&](double seconds, const dvec3& position) {
        return host().show(context, scene, seconds, host().view(position));
    };
    const dvec3 home(0, 0, 5), away(1048576, -2097152, 524288);  // sums that floats keep
    const std::vector<vec4> before = step(0.5, home);
    double lo[3], hi[3], movedLo[3], movedHi[3];
    check(brumeGetEffectBounds(scene.get(), id, lo, hi));
    check(brumeRebaseScene(scene.get(), &away.x));
    const auto expectSame = [&](const std::vector<vec4>& now) {
        for (std::size_t i = 0; i < now.size(); ++i)
            ASSERT_LT(glm::length(now[i] - before[i]), 1e-5) << i;
    };
    expectSame(step(0, home - away));
    check(brumeGetEffectBounds(scene.get(), id, movedLo, movedHi));
    for (int i = 0; i < 3; ++i) {
        EXPECT_LT(lo[i], hi[i]);
        EXPECT_EQ(movedLo[i], lo[i] - away[i]);
        EXPECT_EQ(movedHi[i], hi[i] - away[i]);
    }
    const dvec3 back = -away;
    check(brumeRebaseScene(scene.get(), &back.x));
    expectSame(step(0, home));
    EXPECT_NE(step(0.2, home), before);
    EXPECT_EQ(brumeRebaseScene(scene.get(), nullptr), BRUME_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(brumeGetEffectBounds(scene.get(), id + 1000, lo, hi), BRUME_ERROR_INVALID_ARGUMENT);
}

TEST_F(HostTest, BudgetOfARemovedEffect_GoesToTheOneThatWasCut) {
    const Context context(host().contextInfo());
    std::string text = kSpheresScene;
    text.insert(1, R"( "particleBudget": 300,)");
    Scene scene = makeSceneOfText(context, text.c_str(), "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;  // wants 200
    BrumeId first = 0;
    check(brumeAddEffect(scene.get(), &puffs, &first));
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    const auto countSlots = [&] {
        host().show(context, scene, 0.1);
        return scene.counters().sphereSlots;
    };
    EXPECT_EQ(countSlots(), 2 + 300u);
    check(brumeRemove(scene.get(), first));
    EXPECT_EQ(countSlots(), 2 + 200u);
    EXPECT_EQ(scene.counters().ticksBehind, 0u);
}

TEST_F(HostTest, EffectsThatNeedAPicture_AreRefusedAtTheirModule) {
    const Context context(host().contextInfo());
    Scene scene = makeSceneOfText(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = R"({ "version": 1, "medium": "smoke", "emitters": [ { "rate": 9, "lifetime": 1 } ],
      "modules": [ { "type": "collide_depth" } ] })";
    EXPECT_EQ(brumeAddEffect(scene.get(), &puffs, nullptr), BRUME_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(brumeLastError()).find("effect.json:2:20: module 'collide_depth'"),
              std::string::npos)
        << brumeLastError();
}

TEST_F(HostTest, VolumeByACall_IsSeen) {
    const Context context(host().contextInfo());
    Scene scene = makeSceneOfText(context, kSpheresScene, "sorted");
    std::vector<float> values(9 * 9 * 9, 1.5f);
    const std::int32_t origin[3] = {0, 0, 0};
    auto density = init<BrumeDensity>();
    density.brickCount = 1;
    density.origins = origin;
    density.values = values.data();
    for (int i = 0; i < 3; ++i) density.worldFromIndex[5 * i] = 0.2;
    density.worldFromIndex[15] = 1;
    auto volume = init<BrumeVolume>();
    volume.medium = brumeFindMedium(scene.get(), "smoke");
    volume.density = &density;
    const auto render = [&] { return host().show(context, scene); };
    const std::vector<vec4> before = render();
    BrumeId id = 0;
    check(brumeAddVolume(scene.get(), &volume, &id));
    EXPECT_NE(render(), before);
    EXPECT_EQ(scene.counters().boxes, 1u);
    check(brumeRemove(scene.get(), id));
    EXPECT_EQ(render(), before);
    const std::int32_t crooked[3] = {0, 3, 0};
    density.origins = crooked;
    EXPECT_EQ(brumeAddVolume(scene.get(), &volume, nullptr), BRUME_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace brume::test
