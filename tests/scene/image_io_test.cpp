// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <cmath>
#include <limits>

namespace brume {
namespace {

using test::messageOf;
using test::TempFolder;

Image makeGradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = vec3(0.01f * static_cast<float>(x), 1.0f / static_cast<float>(y + 1),
                                  0.3f * static_cast<float>(x * y));
    return image;
}

TEST(ImageIo_Exr, RoundTrip_KeepsEveryBit) {
    const TempFolder folder;
    for (const ivec2 size : {ivec2(1, 1), ivec2(17, 5), ivec2(64, 64)}) {
        Image image = makeGradient(size.x, size.y);
        image.at(0, 0) = vec3(-1.5f, 1e-30f, std::numeric_limits<float>::infinity());
        writeImage(folder / "a.exr", image);
        EXPECT_EQ(computeHash(readImage(folder / "a.exr")), computeHash(image));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr.part"));
}

TEST(ImageIo_Png, RoundTrip_IsTheToneCurveToEightBits) {
    const TempFolder folder;
    const Image image = makeGradient(40, 30);
    writeImage(folder / "a.png", image);
    const Image read = readImage(folder / "a.png");
    ASSERT_EQ(read.width, 40);
    ASSERT_EQ(read.height, 30);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(read.pixels[i][c], toneMap(image.pixels[i][c]), 0.006);
    EXPECT_NE(test::readBytes(folder / "a.png").find("0.2 / (1 + (x - 0.8) / 0.2)"),
              std::string::npos);
}

TEST(ImageIo_ToneMap, Curve_IsContinuousAndEndsBelowOne) {
    EXPECT_EQ(toneMap(0.5f), 0.5f);
    EXPECT_EQ(toneMap(-1.0f), 0.0f);
    EXPECT_EQ(toneMap(std::numeric_limits<float>::quiet_NaN()), 0.0f);
    EXPECT_EQ(toneMap(std::numeric_limits<float>::infinity()), 1.0f);
    EXPECT_NEAR(toneMap(0.8f + 1e-4f) - toneMap(0.8f), 1e-4, 1e-6);
    EXPECT_NEAR(toneMap(1.0f), 0.9, 1e-6);
}

TEST(ImageIo_Rgba, MemoryAndFile_GiveTheSameTexels) {
    const TempFolder folder;
    const std::string png = test::makePngBytes(7);
    folder.write("b.png", png);
    int width = 0, height = 0;
    const auto fromFile = readRgba(folder / "b.png", width, height);
    EXPECT_EQ(ivec2(width, height), ivec2(7, 7));
    const auto fromMemory =
        readRgba(std::vector<unsigned char>(png.begin(), png.end()), "b", width, height);
    EXPECT_EQ(fromFile, fromMemory);
    EXPECT_EQ(fromFile[0].w, 1.0f);
    EXPECT_NEAR(fromFile[0].z, 188.0 / 255, 1e-6);
}

TEST(ImageIo_Errors, BadFiles_AreOneLineInputErrors) {
    const TempFolder folder;
    folder.write("junk.png", "this is no picture");
    const std::string png = test::makePngBytes(64);
    folder.write("cut.png", png.substr(0, png.size() / 2));
    EXPECT_NE(messageOf([&] { readImage(folder / "absent.exr"); }).find("no such file"),
              std::string::npos);
    for (const char* name : {"junk.png", "cut.png"}) {
        const std::string message = messageOf([&] { readImage(folder / name); });
        EXPECT_NE(message.find(name), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
    EXPECT_NE(messageOf([&] {
                  writeImage(folder / "a.jpg", Image(1, 1));
              }).find("allowed are .exr and .png"),
              std::string::npos);
}

TEST(ImageIo_Write, MissingFolder_IsAFailureThatLeavesNothing) {
    const TempFolder folder;
    try {
        writeImage(folder / "absent/a.exr", Image(2, 2));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Failure);
    }
}

}  // namespace
}  // namespace brume
