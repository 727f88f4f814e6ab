// SPDX-License-Identifier: Apache-2.0
// What a scene is said to need decides which pipelines draw it.
#include <render/needs.hpp>

#include <gtest/gtest.h>

namespace brume::test {
namespace {

render::PreparedScene makeSmoke() {
    render::PreparedScene prepared;
    prepared.scene.media.resize(2);
    prepared.spheres.resize(3);
    return prepared;
}

scene::EffectInstance makeEffect() {
    scene::EffectInstance instance;
    instance.effect.emitters.resize(1);
    return instance;
}

TEST(Needs, OneMediumAndTint_AreOneSource) {
    render::PreparedScene prepared = makeSmoke();
    prepared.scene.effects = {makeEffect()};
    oit::Needs needs = render::findNeeds(prepared);
    EXPECT_TRUE(needs.oneMedium);
    EXPECT_TRUE(needs.oneSource);
    EXPECT_FALSE(needs.tinted);

    for (scene::MediumSphere& sphere : prepared.spheres) sphere.tint = vec3(0.5);
    EXPECT_TRUE(render::findNeeds(prepared).tinted) << "the effect is white";
    prepared.scene.effects[0].effect.tint.keys = {{0, dvec3(0.5)}};
    needs = render::findNeeds(prepared);
    EXPECT_FALSE(needs.tinted);
    EXPECT_TRUE(needs.oneSource);
}

TEST(Needs, EffectThatChangesItsTintOrHasAnotherMedium_IsAnotherSource) {
    render::PreparedScene prepared = makeSmoke();
    prepared.scene.effects = {makeEffect()};
    prepared.scene.effects[0].effect.tint.keys = {{0, dvec3(1)}, {1, dvec3(0.5)}};
    EXPECT_TRUE(render::findNeeds(prepared).tinted);
    EXPECT_FALSE(render::findNeeds(prepared).oneMedium);

    prepared.scene.effects = {makeEffect()};
    prepared.scene.effects[0].medium = 1;
    EXPECT_FALSE(render::findNeeds(prepared).tinted);
    EXPECT_FALSE(render::findNeeds(prepared).oneMedium);
}

TEST(Needs, LampLight_IsNotTheSameEverywhere) {
    render::PreparedScene prepared = makeSmoke();
    prepared.scene.media[0].extinction = prepared.scene.media[0].albedo = dvec3(1);
    scene::Light lamp;
    lamp.type = scene::LightType::Point;
    prepared.scene.lights = {lamp};
    EXPECT_TRUE(render::findNeeds(prepared).varyingLight);
    EXPECT_TRUE(render::findNeeds(prepared).oneMedium);
    EXPECT_FALSE(render::findNeeds(prepared).oneSource);
}

}  // namespace
}  // namespace brume::test
