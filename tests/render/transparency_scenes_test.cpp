// SPDX-License-Identifier: Apache-2.0
// What the papers' figures show, on the built-in scenes after them.
#include <bench/prepare.hpp>
#include <bench/scenes.hpp>
#include <render/render_fixture.hpp>

#include <fstream>

namespace brume::test {
namespace {

/// Memory of this process that is in use, 0 where the system does not tell.
std::uint64_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages = 0, resident = 0;
    file >> pages >> resident;
    return 4096 * resident;
}

class TransparencyScenes : public RenderTest {
  protected:
    static render::PreparedScene makeScene(const char* name) {
        render::PreparedScene prepared;
        prepared.scene = bench::makeScenes(name).at(0).scene;
        prepared.scene.image = {64, 36, 1};
        prepared.spheres = scene::makeMediumSpheres(prepared.scene.spheres);
        return prepared;
    }
};

/// McGuire and Mara 2016, figure 2: what lies behind crossed glass is filtered by both colours, in
/// whatever order.
TEST_F(TransparencyScenes, GlassBars_FilterTheBackgroundExactlyWithoutOrder) {
    render::PreparedScene bars = makeScene("glass_bars");
    for (scene::Material& material : bars.scene.materials) material.reflected = dvec3(0);
    const Image ordered = render(bars, {.method = "linked_list"}).image;
    const auto measureLargest = [&](const render::Options& options) {
        const Image image = render(bars, options).image;
        float largest = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest,
                                   std::abs(image.pixels[i][c] - ordered.pixels[i][c]));
        return largest;
    };
    EXPECT_LE(
        measureLargest({.method = "weighted", .settings = {{"precision", "exact"}}}), 1e-6);
    EXPECT_GT(measureLargest({.method = "sorted"}), 0.1) << "averages the colours";
}

/// Figure 3: the lower the collimation, the more is blurred of what stands behind the pane, and the
/// more the farther it stands.
TEST_F(TransparencyScenes, FrostedPanes_DifferFromClearOnesByTheirCollimation) {
    render::PreparedScene panes = makeScene("frosted_panes");
    panes.scene.image = {320, 180, 1};
    const Image blurred = render(panes, {.method = "weighted"}).image;
    const Image clear =
        render(panes, {.method = "weighted", .settings = {{"diffusion", "false"}}}).image;
    std::vector<double> change;
    for (int pane = 0; pane < 5; ++pane) {
        double sum = 0;
        for (int y = 50; y < 120; ++y)
            for (int x = 64 * pane + 8; x < 64 * pane + 56; ++x)
                sum += glm::length(blurred.at(x, y) - clear.at(x, y));
        change.push_back(sum);
    }
    // Panes that stand opposite each other see about the same.
    EXPECT_EQ(change[0], 0) << "collimation 1";
    EXPECT_GT(change[4], 0);
    EXPECT_GT(change[3], 1.5 * change[1]);
    EXPECT_GT(change[2], change[1]);
}

/// Drivers may compile a shader anew for each draw, and keep what they made.
TEST_F(TransparencyScenes, Frames_LeaveNoMemoryBehind) {
    constexpr std::uint64_t kMost = 24ull << 20;
    if (residentBytes() == 0) GTEST_SKIP() << "the system does not tell its memory";
    for (const char* scene : {"mixed", "engine", "frosted_panes"})
        for (const char* method : {"linked_list", "weighted"}) {
            render::PreparedScene prepared = makeScene(scene);
            prepared.scene.image = {16, 9, 1};
            render::Renderer renderer(device(), prepared, {.method = method, .settings = {}}, log());
            for (int frame = 0; frame < 3; ++frame) renderer.renderFrame();
            const std::uint64_t before = residentBytes();
            for (int frame = 0; frame < 12; ++frame) renderer.renderFrame();
            EXPECT_LT(residentBytes(), before + kMost) << scene << " by " << method;
        }
}

}  // namespace
}  // namespace brume::test
