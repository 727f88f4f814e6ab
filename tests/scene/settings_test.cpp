// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/settings.hpp>

namespace brume::scene {
namespace {

using test::messageOf;

TEST(Settings_Reader, GivenAndMissingKeys_GiveValuesAndDefaults) {
    const Settings settings{{"a", "2.5"}, {"b", "-7"}, {"c", "true"}, {"d", "fast"}};
    SettingsReader reader(settings, "setting up");
    EXPECT_EQ(reader.number("a", 1, 0, 10), 2.5);
    EXPECT_EQ(reader.integer("b", 1, -10, 10), -7);
    EXPECT_TRUE(reader.boolean("c", false));
    EXPECT_EQ(reader.choice("d", "slow", {"slow", "fast"}), "fast");
    EXPECT_EQ(reader.number("e", 3, 0, 10), 3);
    EXPECT_NO_THROW(reader.finish());
}

TEST(Settings_Reader, BadValues_NameKeyAndRange) {
    const Settings settings{{"a", "2.5x"}, {"b", "11"}, {"c", "yes"}, {"n", "nan"}};
    SettingsReader reader(settings, "setting up");
    EXPECT_EQ(messageOf([&] { reader.number("a", 1, 0, 10); }),
              "setting up: setting \"a\" is \"2.5x\", must be a number from 0 to 10");
    EXPECT_EQ(messageOf([&] { reader.integer("b", 1, 0, 10); }),
              "setting up: setting \"b\" is \"11\", must be an integer from 0 to 10");
    EXPECT_EQ(messageOf([&] { reader.boolean("c", false); }),
              "setting up: setting \"c\" is \"yes\", must be one of true, false");
    EXPECT_NE(messageOf([&] { reader.number("n", 1, 0, 10); }), "no error");
}

TEST(Settings_Reader, UnaskedKey_ListsTheKnownOnes) {
    const Settings settings{{"tyop", "1"}};
    SettingsReader reader(settings, "setting up");
    reader.number("budgetMiB", 1, 0, 10);
    reader.boolean("bands", false);
    EXPECT_EQ(messageOf([&] { reader.finish(); }),
              "setting up: unknown setting \"tyop\", known are budgetMiB, bands");
}

}  // namespace
}  // namespace brume::scene
