// SPDX-License-Identifier: Apache-2.0
// Shaders of a host with the includes for them: layers of its own, and shadows on its own things.
#include <gpu/upload.hpp>
#include <host/host_fixture.hpp>

#include <spv/common/screen.vert.hpp>
#include <spv/host_tests/layer.frag.hpp>
#include <spv/host_tests/shadow.comp.hpp>

#include <cmath>

namespace brume::test {
namespace {

const char* const kInkScene = R"({ "version": 1,
  "lights": [ { "type": "ambient", "radiance": [0, 0, 0] },
              { "type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1],
                "shadow": "total", "shadowSettings": { "resolution": "64" } } ],
  "media": { "ink": { "extinction": [0.8, 0.4, 0.2], "albedo": [0, 0, 0] } },
  "spheres": [ { "center": [0, 0, 0], "radius": 1.5, "medium": "ink", "density": 1 } ] })";

// Whatever the order, the background is seen through both; a single layer is exact, and of two
// black ones so is the product.
TEST_F(HostTest, HostLayers_AreComposedWithSmoke) {
    const gpu::GraphicsPipeline pane(
        device(), {.name = "test.pane",
                   .vertexSpirv = spv::common_screen_vert,
                   .fragmentSpirv = spv::host_tests_layer_frag,
                   .pushConstantBytes = 32,
                   .colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::additive()},
                              {VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::additive()}}});
    const Context context(host().contextInfo());
    auto info = init<BrumeSceneCreateInfo>();
    info.text = kInkScene;
    info.hostLayers = 1;
    Scene scene(context, info);
    const auto render = [&](std::optional<std::array<vec4, 2>> layer) {
        host().draw({1, 1, 1}, 0);
        host().frame(context.get(), [&](VkCommandBuffer commandBuffer) {
            const BrumeView view = host().view();
            check(brumeCmdBeginLayers(scene.get(), commandBuffer, &view));
            gpu::Commands commands(device(), commandBuffer);
            if (layer) {
                commands.bindGraphics(pane);
                commands.pushConstants(*layer);
                commands.draw(3);
            }
            check(brumeCmdEndLayers(scene.get(), commandBuffer));
        });
        return host().read();
    };
    const std::vector<vec4> smoke = render({});
    const std::size_t center = 16 * 48 + 24;
    EXPECT_NEAR(smoke[center].x, std::exp(-0.8 * 3), 5e-3);
    EXPECT_NEAR(smoke[center].z, std::exp(-0.2 * 3), 5e-3);
    const vec3 through(0.5f, 0.25f, 0.9f);
    for (const float distance : {2.f, 9.f}) {  // before and behind
        const auto both = render(std::array{vec4(0), vec4(through, distance)});
        for (std::size_t i = 0; i < both.size(); ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(both[i][c], smoke[i][c] * through[c], 2e-6) << i;
    }
    // A pane that glows, where there is no smoke.
    const auto glowing = render(std::array{vec4(0.2f, 0.1f, 0, 0), vec4(0.5f, 0.5f, 0.5f, 3)});
    EXPECT_NEAR(glowing[0].x, 0.7, 1e-5);
    EXPECT_NEAR(glowing[0].y, 0.6, 1e-5);

    // The same scene by brumeCmdRender(): nobody draws.
    host().draw({1, 1, 1}, 0);
    host().frame(context.get(),
                 [&](VkCommandBuffer commands) { scene.cmdRender(commands, host().view()); });
    EXPECT_EQ(host().read(), smoke);
    host().frame(context.get(), [&](VkCommandBuffer commands) {
        EXPECT_EQ(brumeCmdEndLayers(scene.get(), commands), BRUME_ERROR_INVALID_ARGUMENT);
    });
    info.method = "sorted";
    EXPECT_THROW(Scene(context, info), ApiError);
}

// Blended into the host's own rendering, with and without its depth attached.
TEST_F(HostTest, DrawnInsideTheHostsRendering_EqualsRender) {
    const Context context(host().contextInfo());
    const auto make = [&](BrumeInside inside) {
        auto info = init<BrumeSceneCreateInfo>();
        info.text = kSpheresScene;
        info.method = "sorted";
        info.inside = inside;
        Scene scene(context, info);
        auto puffs = init<BrumeEffect>();
        puffs.text = kEffect;
        puffs.time = 0.4;
        check(brumeAddEffect(scene.get(), &puffs, nullptr));
        return scene;
    };
    Scene rendered = make(BRUME_INSIDE_NOTHING);
    host().draw({0.2f, 0.3f, 0.4f}, 0.02f);  // a wall at 5 m
    host().frame(context.get(),
                 [&](VkCommandBuffer commands) { rendered.cmdRender(commands, host().view()); });
    const std::vector<vec4> expected = host().read();
    for (const BrumeInside inside : {BRUME_INSIDE_COLOR, BRUME_INSIDE_COLOR_DEPTH}) {
        Scene drawn = make(inside);
        for (int frame = 0; frame < 3; ++frame) {
            host().draw({0.2f, 0.3f, 0.4f}, 0.02f);
            host().frame(context.get(), [&](VkCommandBuffer commandBuffer) {
                const BrumeView view = host().view();
                EXPECT_EQ(brumeCmdDraw(drawn.get(), commandBuffer), BRUME_ERROR_INVALID_ARGUMENT);
                EXPECT_EQ(brumeCmdRender(drawn.get(), commandBuffer, &view),
                          BRUME_ERROR_INVALID_ARGUMENT);
                check(brumeCmdPrepareDraw(drawn.get(), commandBuffer, &view));
                gpu::Commands commands(device(), commandBuffer);
                const gpu::ColorAttachment color{&host().color, gpu::LoadOp::Load, {}, {}};
                std::optional<gpu::DepthAttachment> depth;
                if (inside == BRUME_INSIDE_COLOR_DEPTH)
                    depth = gpu::DepthAttachment{&host().depth, gpu::LoadOp::Load};
                commands.beginRendering(std::span(&color, 1), depth);
                check(brumeCmdDraw(drawn.get(), commandBuffer));
                commands.endRendering();
            });
            double largest = 0;
            const std::vector<vec4> seen = host().read();
            for (std::size_t i = 0; i < seen.size(); ++i)
                for (int c = 0; c < 4; ++c)
                    largest = std::max(largest, std::abs(double(seen[i][c]) - expected[i][c]));
            EXPECT_LE(largest, 1e-6) << "frame " << frame;
        }
    }
    auto info = init<BrumeSceneCreateInfo>();
    info.text = kSpheresScene;
    info.method = "weighted";
    info.inside = BRUME_INSIDE_COLOR;
    EXPECT_THROW(Scene(context, info), ApiError);
}

TEST_F(HostTest, HostShader_SamplesOurShadows) {
    const gpu::ComputePipeline ask(device(), {.name = "test.shadow",
                                              .spirv = spv::host_tests_shadow_comp,
                                              .bindings = {{0, gpu::BindingType::StorageBuffer},
                                                           {1, gpu::BindingType::StorageBuffer}},
                                              .pushConstantBytes = 8});
    const Context context(host().contextInfo());
    auto info = init<BrumeSceneCreateInfo>();
    info.text = kInkScene;
    info.method = "sorted";
    Scene scene(context, info);
    // Below, above and beside the ball; the camera stands at (0.5, 0, 5).
    const dvec3 eye(0.5, 0, 5);
    std::vector<vec4> points;
    for (const dvec3& p : {dvec3(0, -2, 0), dvec3(0, 2, 0), dvec3(3, -2, 0), dvec3(0.4, -2, 0.3)})
        points.push_back(vec4(vec3(p - eye), 1));
    points.resize(8);
    gpu::Buffer questions(device(), {.name = "test.questions", .bytes = 8 * sizeof(vec4)});
    gpu::Buffer answers(device(), {.name = "test.answers", .bytes = 8 * sizeof(vec4)});
    submit([&](gpu::Commands& commands) { gpu::upload(commands, questions, points); });

    EXPECT_EQ(brumeGetLight(scene.get(), 9), 0u);
    const BrumeId sun = brumeGetLight(scene.get(), 1);
    VkDeviceAddress shadow = 1;
    EXPECT_EQ(brumeGetShadow(scene.get(), sun, &shadow), BRUME_ERROR_INVALID_ARGUMENT);
    host().frame(context.get(), [&](VkCommandBuffer commandBuffer) {
        scene.cmdShadow(commandBuffer, host().view(eye));
        check(brumeGetShadow(scene.get(), brumeGetLight(scene.get(), 0), &shadow));
        EXPECT_EQ(shadow, 0u) << "ambient light has no shadow";
        check(brumeGetShadow(scene.get(), sun, &shadow));
        gpu::Commands commands(device(), commandBuffer);
        commands.bindCompute(ask);
        commands.bind(0, questions);
        commands.bind(1, answers);
        commands.pushConstants(shadow);
        commands.dispatch(1);
    });
    const auto seen = submitter().readBuffer<vec4>(answers, 8);
    const auto expectAt = [&](std::size_t i, double chord) {
        const double sigma[] = {0.8, 0.4, 0.2};
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[i][c], std::exp(-sigma[c] * chord), 2e-2) << "point " << i;
    };
    expectAt(0, 3);
    expectAt(2, 0);
    expectAt(3, 2 * std::sqrt(1.5 * 1.5 - 0.25));
}

}  // namespace
}  // namespace brume::test
