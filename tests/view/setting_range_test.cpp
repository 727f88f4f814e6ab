// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <oit/method_info.hpp>
#include <shadows/store_info.hpp>
#include <view/setting_range.hpp>

namespace brume::view {
namespace {

using Kind = SettingRange::Kind;

SettingRange read(std::string_view values, std::string_view fallback) {
    return readRange({"name", values, fallback, ""});
}

TEST(SettingRange_WholeNumbers, HaveLimitsAndUnit) {
    const SettingRange range = read("8 .. 4096 texels, multiple of 8", "512 (256 per face)");
    EXPECT_EQ(range.kind, Kind::Number);
    EXPECT_EQ(range.lo, 8);
    EXPECT_EQ(range.hi, 4096);
    EXPECT_TRUE(range.isWhole);
    EXPECT_EQ(range.unit, "texels");
}

TEST(SettingRange_TightRange, IsRead) {
    const SettingRange range = read("1..64", "8");
    EXPECT_EQ(range.lo, 1);
    EXPECT_EQ(range.hi, 64);
    EXPECT_TRUE(range.isWhole);
}

TEST(SettingRange_Fractions, AreNotWhole) {
    EXPECT_FALSE(read("0..1", "0").isWhole);
    const SettingRange wide = read("1e-6..1e6 m", "5");
    EXPECT_EQ(wide.lo, 1e-6);
    EXPECT_EQ(wide.hi, 1e6);
    EXPECT_EQ(wide.unit, "m");
    EXPECT_FALSE(wide.isWhole);
    EXPECT_TRUE(wide.isWide);
}

TEST(SettingRange_Words, AreChoicesOrFlags) {
    EXPECT_EQ(read("true, false", "true").kind, Kind::Flag);
    const SettingRange range = read("half, single, exact", "single");
    EXPECT_EQ(range.kind, Kind::Choice);
    EXPECT_EQ(range.choices, (std::vector<std::string>{"half", "single", "exact"}));
    EXPECT_EQ(read("m", "0").kind, Kind::Number);
    EXPECT_EQ(read("anything goes here", "x").kind, Kind::Text);
}

// Whoever registers a technique gets widgets, not text fields.
TEST(SettingRange_EveryRegisteredSetting, IsUnderstood) {
    const auto check = [](const scene::SettingInfo& info) {
        const SettingRange range = readRange(info);
        EXPECT_NE(range.kind, Kind::Text) << info.name << ": " << info.values;
        const std::optional<double> fallback = leadingNumber(info.defaultValue);
        if (range.kind == Kind::Number) {
            ASSERT_TRUE(fallback) << info.name;
            EXPECT_GE(*fallback, range.lo) << info.name;
            EXPECT_LE(*fallback, range.hi) << info.name;
        }
        if (range.kind == Kind::Choice) {
            EXPECT_NE(std::find(range.choices.begin(), range.choices.end(), info.defaultValue),
                      range.choices.end())
                << info.name;
        }
    };
    for (const oit::MethodInfo& method : oit::listMethods())
        for (const scene::SettingInfo& info : method.settings) check(info);
    for (const shadows::StoreInfo& store : shadows::listStores())
        for (const scene::SettingInfo& info : store.settings) check(info);
    for (const scene::SettingInfo& info : shadows::listMapSettings()) check(info);
}

TEST(FormatNumber_Values, AreShort) {
    EXPECT_EQ(formatNumber(512), "512");
    EXPECT_EQ(formatNumber(0.30000001192), "0.3");
    EXPECT_EQ(formatNumber(1e-6), "1e-06");
}

}  // namespace
}  // namespace brume::view
