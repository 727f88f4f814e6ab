// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/texture.hpp>

namespace brume::scene {
namespace {

Texture makeTexture(int width, int height) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) texture.texels.emplace_back(x, y, x * y, 1);
    return texture;
}

TEST(Texture_Bilinear, TexelCentres_GiveTheTexels) {
    const Texture texture = makeTexture(4, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) {
            const vec4 value = sampleBilinear(texture, {(x + 0.5) / 4, (y + 0.5) / 3});
            EXPECT_LT(glm::length(value - texture.texels[static_cast<std::size_t>(y * 4 + x)]),
                      1e-6f);
        }
}

TEST(Texture_Bilinear, BetweenAndBeyond_BlendsAndRepeats) {
    const Texture texture = makeTexture(4, 3);
    EXPECT_NEAR(sampleBilinear(texture, {2.0 / 4, 0.5 / 3}).x, 1.5, 1e-6);
    EXPECT_NEAR(sampleBilinear(texture, {0, 0.5 / 3}).x, 1.5, 1e-6);  // between texels 3 and 0
    for (double shift : {-2.0, -1.0, 1.0, 5.0})
        EXPECT_LT(glm::length(sampleBilinear(texture, {0.3 + shift, 0.7 - shift}) -
                              sampleBilinear(texture, {0.3, 0.7})),
                  1e-5f);
}

TEST(Environment_Uv, Axes_LieWhereTheConventionSays) {
    EXPECT_NEAR(environmentUv({0, 0, -1}).x, 0.5, 1e-15);
    EXPECT_NEAR(environmentUv({1, 0, 0}).x, 0.75, 1e-15);
    EXPECT_NEAR(environmentUv({-1, 0, 0}).x, 0.25, 1e-15);
    EXPECT_NEAR(environmentUv({0, 1, 0}).y, 0, 1e-15);
    EXPECT_NEAR(environmentUv({0, -1, 0}).y, 1, 1e-15);
}

TEST(Environment_Poles, LastRow_IsNotMixedWithTheFirst) {
    auto map = std::make_shared<Texture>(makeTexture(4, 8));
    Background background;
    background.environment = map;
    background.scale = 2;
    EXPECT_NEAR(environmentRadiance(background, {0, 1, 0}).y, 0, 1e-12);
    EXPECT_NEAR(environmentRadiance(background, {0, -1, 0}).y, 14, 1e-12);
    background.environment = nullptr;
    background.radiance = dvec3(1, 2, 3);
    EXPECT_EQ(environmentRadiance(background, {0, 1, 0}), dvec3(1, 2, 3));
}

TEST(Environment_SharedFiles, Load_HasPlausibleContent) {
    for (const char* name : {"kloppenheim_05_1k.hdr", "narrow_moonlit_road_1k.hdr"}) {
        const std::filesystem::path file = test::sharedData() / "hdr" / name;
        BRUME_SKIP_WITHOUT(file);
        const auto texture = loadTexture(file);
        EXPECT_EQ(ivec2(texture->width, texture->height), ivec2(1024, 512));
        dvec3 upper(0), lower(0);
        float largest = 0;
        for (std::size_t i = 0; i < texture->texels.size(); ++i) {
            const vec4& t = texture->texels[i];
            ASSERT_TRUE(std::isfinite(t.x) && t.x >= 0 && t.w == 1);
            (i < texture->texels.size() / 2 ? upper : lower) += dvec3(t);
            largest = std::max(largest, t.x);
        }
        EXPECT_GT(upper.z, lower.z) << "the sky is brighter than the ground: " << name;
        EXPECT_GT(largest, 1) << name;
    }
}

}  // namespace
}  // namespace brume::scene
