// SPDX-License-Identifier: Apache-2.0
// Numbered file names.
#include <gtest/gtest.h>

#include <core/frame_path.hpp>

namespace brume {
namespace {

TEST(FramePath, PlacesForNumbers_AreFound) {
    EXPECT_TRUE(hasFrameNumber("smoke_%04d.vdb"));
    EXPECT_TRUE(hasFrameNumber("shots/smoke.####.vdb"));
    EXPECT_FALSE(hasFrameNumber("shots##/smoke.vdb"));
    EXPECT_FALSE(hasFrameNumber("100%.vdb"));
}

TEST(FramePath, Hashes_BecomeTheNumberWithThatManyDigits) {
    EXPECT_EQ(makeFramePath("out/plume.####.exr", 7), "out/plume.0007.exr");
    EXPECT_EQ(makeFramePath("p##.png", 123), "p123.png");
}

TEST(FramePath, PrintfStyle_BecomesTheNumber) {
    EXPECT_EQ(makeFramePath("plume_%04d.png", 42), "plume_0042.png");
    EXPECT_EQ(makeFramePath("plume_%d.png", 42), "plume_42.png");
}

TEST(FramePath, OtherPercentSigns_AreLeftAlone) {
    EXPECT_EQ(makeFramePath("100%s_%n.png", 3), "100%s_%n_0003.png");
    EXPECT_EQ(makeFramePath("50%_%02d.png", 3), "50%_03.png");
}

TEST(FramePath, NoPattern_PutsTheNumberBeforeTheExtension) {
    EXPECT_EQ(makeFramePath("out/plume.png", 12), "out/plume_0012.png");
}

TEST(FramePath, PatternInTheFolder_IsNotTouched) {
    EXPECT_EQ(makeFramePath("a##/p.exr", 1), "a##/p_0001.exr");
}

}  // namespace
}  // namespace brume
