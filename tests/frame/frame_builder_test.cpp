// SPDX-License-Identifier: Apache-2.0
// The pass contract: barriers that synchronization validation accepts, transient memory, errors.
#include <volk.h>
// volk.h goes first.
#include <core/assert.hpp>
#include <frame/frame_builder.hpp>
#include <gpu/gpu_fixture.hpp>
#include <spv/frame_tests/color.frag.hpp>
#include <spv/frame_tests/count.frag.hpp>
#include <spv/frame_tests/full_screen.vert.hpp>
#include <spv/frame_tests/increment.comp.hpp>
#include <spv/frame_tests/sample.comp.hpp>

namespace brume::test {
namespace {

using frame::Access;
using frame::BufferRef;
using frame::FrameBuilder;
using frame::ImageRef;
using frame::PassResources;
using gpu::BindingType;
using gpu::Commands;

struct DrawPush {
    std::array<float, 4> color;
    float depth;
};
constexpr std::uint32_t kDrawPushBytes = 20;
constexpr std::uint64_t kBytes = 1024;
constexpr VkFormat kColorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

class FrameTest : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        mPool = std::make_unique<frame::ResourcePool>(device());
        mIncrement = gpu::ComputePipeline(device(), {.name = "increment",
                                                     .spirv = spv::frame_tests_increment_comp,
                                                     .bindings = {{0, BindingType::StorageBuffer},
                                                                  {1, BindingType::StorageBuffer}},
                                                     .pushConstantBytes = 4,
                                                     .specialization = {}});
    }
    void TearDown() override {
        mIncrement = {};
        mPool.reset();
        GpuTest::TearDown();
    }

    gpu::GraphicsPipeline makeDraw(const std::string& name, const gpu::Blend& blend,
                                   bool depthWrite) {
        gpu::GraphicsPipelineDesc desc;
        desc.name = name;
        desc.vertexSpirv = spv::frame_tests_full_screen_vert;
        desc.fragmentSpirv = spv::frame_tests_color_frag;
        desc.pushConstantBytes = kDrawPushBytes;
        desc.colors = {{kColorFormat, blend}};
        desc.depthFormat = VK_FORMAT_D32_SFLOAT;
        desc.depthTest = true;
        desc.depthWrite = depthWrite;
        return gpu::GraphicsPipeline(device(), desc);
    }

    static void draw(Commands& commands, const gpu::GraphicsPipeline& pipeline,
                     const DrawPush& push) {
        commands.bindGraphics(pipeline);
        commands.pushConstantBytes(&push, kDrawPushBytes);
        commands.draw(3);
    }

    void addIncrement(FrameBuilder& frame, BufferRef source, BufferRef target,
                      std::uint32_t amount) {
        frame.addPass("increment")
            .reads(source, Access::ComputeRead)
            .writes(target, Access::ComputeWrite)
            .record([=, this](Commands& commands, const PassResources& resources) {
                commands.bindCompute(mIncrement);
                commands.bind(0, resources.buffer(source));
                commands.bind(1, resources.buffer(target));
                commands.pushConstants(amount);
                commands.dispatchThreads(kBytes / 4, 64);
            });
    }

    BufferRef addFill(FrameBuilder& frame, const std::string& name, std::uint32_t value) {
        const BufferRef buffer = frame.createBuffer(name, kBytes);
        frame.addPass("fill")
            .writes(buffer, Access::TransferWrite)
            .record([=](Commands& commands, const PassResources& resources) {
                commands.fillBuffer(resources.buffer(buffer), value);
            });
        return buffer;
    }

    gpu::Buffer makeReadback(std::uint64_t bytes) {
        return gpu::Buffer(
            device(), {.name = "readback", .bytes = bytes, .memory = gpu::MemoryKind::Readback});
    }

    std::unique_ptr<frame::ResourcePool> mPool;
    gpu::ComputePipeline mIncrement;
};

TEST_F(FrameTest, Buffers_TransferComputeChain_IsOrdered) {
    const gpu::Buffer result = makeReadback(kBytes);
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const BufferRef a = addFill(frame, "a", 5);
        const BufferRef b = frame.createBuffer("b", kBytes);
        addIncrement(frame, a, b, 10);    // read after write
        addIncrement(frame, b, a, 100);   // write after read
        addIncrement(frame, a, b, 1000);  // write after write
        frame.addReadback("read", b, result);
        frame.execute(commands);
    });
    for (const std::uint32_t value : result.mappedAs<std::uint32_t>()) ASSERT_EQ(value, 1115u);
}

TEST_F(FrameTest, Images_RasterToComputeToHost_AreOrdered) {
    constexpr std::uint32_t kSize = 20;
    const gpu::GraphicsPipeline opaque = makeDraw("opaque", gpu::Blend::none(), true);
    const gpu::GraphicsPipeline over = makeDraw("over", gpu::Blend::premultipliedOver(), false);
    const gpu::ComputePipeline sample(
        device(), {.name = "sample",
                   .spirv = spv::frame_tests_sample_comp,
                   .bindings = {{0, BindingType::SampledImage}, {1, BindingType::StorageImage}},
                   .pushConstantBytes = 0,
                   .specialization = {}});
    const gpu::Sampler sampler(device(), {.name = "nearest", .filter = gpu::Filter::Nearest});
    const gpu::Buffer result = makeReadback(kSize * kSize * 16);
    const gpu::Buffer depths = makeReadback(kSize * kSize * 4);
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const ImageRef color = frame.createImage(
            {.name = "color", .format = kColorFormat, .width = kSize, .height = kSize, .usage = 0});
        const ImageRef depth = frame.createImage({.name = "depth",
                                                  .format = VK_FORMAT_D32_SFLOAT,
                                                  .width = kSize,
                                                  .height = kSize,
                                                  .usage = 0});
        const ImageRef doubled = frame.createImage({.name = "doubled",
                                                    .format = kColorFormat,
                                                    .width = kSize,
                                                    .height = kSize,
                                                    .usage = 0});
        frame.addPass("opaque")
            .color(color, gpu::LoadOp::Clear, {9, 9, 9, 1})
            .depth(depth, gpu::LoadOp::Clear)
            .record([&](Commands& c, const PassResources&) {
                draw(c, opaque, {{0.5f, 0.25f, 0, 1}, 0.5f});
            });
        frame.addPass("transparent")
            .color(color, gpu::LoadOp::Load)
            .depthTest(depth)
            .record([&](Commands& c, const PassResources&) {
                draw(c, over, {{0.1f, 0.1f, 0.1f, 0.5f}, 0.75f});  // before the opaque one
                draw(c, over, {{7, 7, 7, 1}, 0.25f});              // behind it
            });
        frame.addPass("double")
            .reads(color, Access::ComputeSample)
            .writes(doubled, Access::ComputeWrite)
            .record([=, &sample, &sampler](Commands& c, const PassResources& resources) {
                c.bindCompute(sample);
                c.bind(0, resources.image(color), sampler);
                c.bind(1, resources.image(doubled));
                c.dispatch((kSize + 7) / 8, (kSize + 7) / 8);
            });
        frame.addReadback("read color", doubled, result);
        frame.addReadback("read depth", depth, depths);
        frame.execute(commands);
    });
    const auto texel = result.mappedAs<std::array<float, 4>>()[kSize * kSize - 1];
    EXPECT_FLOAT_EQ(texel[0], 2 * (0.1f + 0.5f * 0.5f));
    EXPECT_FLOAT_EQ(texel[1], 2 * (0.1f + 0.5f * 0.25f));
    EXPECT_FLOAT_EQ(depths.mappedAs<float>()[7], 0.5f);
}

TEST_F(FrameTest, DepthTest_SampledInTheSamePass_SharesALayout) {
    const gpu::GraphicsPipeline over = makeDraw("over", gpu::Blend::additive(), false);
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const ImageRef color = frame.createImage(
            {.name = "color", .format = kColorFormat, .width = 8, .height = 8, .usage = 0});
        const ImageRef depth = frame.createImage(
            {.name = "depth", .format = VK_FORMAT_D32_SFLOAT, .width = 8, .height = 8, .usage = 0});
        frame.addPass("prepare").depth(depth, gpu::LoadOp::Clear);
        frame.addPass("draw")
            .color(color, gpu::LoadOp::Clear)
            .depthTest(depth)
            .reads(depth, Access::FragmentSample)
            .record([&, depth](Commands& c, const PassResources& resources) {
                EXPECT_EQ(resources.image(depth).layout(),
                          VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
                draw(c, over, {{1, 1, 1, 1}, 0.5f});
            });
        frame.execute(commands);
    });
}

TEST_F(FrameTest, Raster_WithoutAttachments_StoresFromFragments) {
    constexpr std::uint32_t kSize = 16;
    gpu::GraphicsPipelineDesc desc;
    desc.name = "count";
    desc.vertexSpirv = spv::frame_tests_full_screen_vert;
    desc.fragmentSpirv = spv::frame_tests_count_frag;
    desc.bindings = {{0, BindingType::StorageBuffer}};
    desc.pushConstantBytes = kDrawPushBytes;
    desc.specialization = {kSize};
    const gpu::GraphicsPipeline count(device(), desc);
    const gpu::Buffer result = makeReadback(kBytes);
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const BufferRef counts = addFill(frame, "counts", 0);
        for (int pass = 0; pass < 2; ++pass)
            frame.addPass("count")
                .readsWrites(counts, Access::FragmentWrite)
                .renderArea({kSize, kSize})
                .record([=, &count](Commands& c, const PassResources& resources) {
                    const DrawPush push{{}, 0.5f};
                    c.bindGraphics(count);
                    c.bind(0, resources.buffer(counts));
                    c.pushConstantBytes(&push, kDrawPushBytes);
                    c.draw(3);
                });
        frame.addReadback("read", counts, result);
        frame.execute(commands);
    });
    for (const std::uint32_t value : result.mappedAs<std::uint32_t>()) ASSERT_EQ(value, 2u);
}

TEST_F(FrameTest, Indirect_ArgumentsFromTransfer_AreSeen) {
    const gpu::Buffer result = makeReadback(kBytes);
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const BufferRef arguments = frame.createBuffer("arguments", 12);
        const BufferRef source = addFill(frame, "source", 1);
        const BufferRef target = addFill(frame, "target", 0);
        frame.addPass("arguments")
            .writes(arguments, Access::TransferWrite)
            .record([=](Commands& c, const PassResources& resources) {
                const std::array<std::uint32_t, 3> groups = {2, 1, 1};
                c.updateBuffer(resources.buffer(arguments), groups.data(), sizeof(groups));
            });
        frame.addPass("indirect")
            .reads(arguments, Access::IndirectRead)
            .reads(source, Access::ComputeRead)
            .writes(target, Access::ComputeWrite)
            .record([=, this](Commands& c, const PassResources& resources) {
                c.bindCompute(mIncrement);
                c.bind(0, resources.buffer(source));
                c.bind(1, resources.buffer(target));
                c.pushConstants(41u);
                c.dispatchIndirect(resources.buffer(arguments));
            });
        frame.addReadback("read", target, result);
        frame.execute(commands);
    });
    EXPECT_EQ(result.mappedAs<std::uint32_t>()[127], 42u);
    EXPECT_EQ(result.mappedAs<std::uint32_t>()[128], 0u);
}

TEST_F(FrameTest, Transients_SteadyFrames_AllocateNothing) {
    const auto runFrame = [&] {
        submit([&](Commands& commands) {
            FrameBuilder frame(*mPool);
            const BufferRef a = addFill(frame, "a", 1);
            const BufferRef b = frame.createBuffer("b", kBytes);
            addIncrement(frame, a, b, 1);
            addFill(frame, "c", 2);  // takes over the memory of a
            frame.execute(commands);
        });
    };
    runFrame();
    EXPECT_EQ(mPool->allocations(), 2u);
    for (int i = 0; i < 5; ++i) runFrame();
    EXPECT_EQ(mPool->allocations(), 2u);
    for (int i = 0; i < 3; ++i)
        submit([&](Commands& commands) { FrameBuilder(*mPool).execute(commands); });
    EXPECT_EQ(mPool->bytes(), 0u);
}

TEST_F(FrameTest, Imports_AcrossFrames_KeepContentAndLayout) {
    const gpu::Image image(
        device(), {.name = "history",
                   .format = kColorFormat,
                   .width = 4,
                   .height = 4,
                   .usage = gpu::kUsageColor | gpu::kUsageSampled | gpu::kUsageTransferRead});
    const gpu::GraphicsPipeline add = makeDraw("add", gpu::Blend::additive(), false);
    for (int i = 0; i < 3; ++i)
        submit([&](Commands& commands) {
            FrameBuilder frame(*mPool);
            const ImageRef history = frame.importImage(image);
            const ImageRef depth = frame.createImage({.name = "depth",
                                                      .format = VK_FORMAT_D32_SFLOAT,
                                                      .width = 4,
                                                      .height = 4,
                                                      .usage = 0});
            frame.addPass("add")
                .color(history, i == 0 ? gpu::LoadOp::Clear : gpu::LoadOp::Load)
                .depth(depth, gpu::LoadOp::Clear)
                .record([&](Commands& c, const PassResources&) {
                    draw(c, add, {{1, 2, 3, 4}, 0.5f});
                });
            frame.finishAs(history, Access::FragmentSample);
            frame.execute(commands);
        });
    EXPECT_EQ(image.layout(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    const auto texels = submitter().readImage<std::array<float, 4>>(image);
    EXPECT_EQ(texels[5], (std::array{3.0f, 6.0f, 9.0f, 12.0f}));
}

TEST_F(FrameTest, Timers_EachPass_HasItsName) {
    gpu::TimerPool timers(device());
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const BufferRef a = addFill(frame, "a", 1);
        addIncrement(frame, a, frame.createBuffer("b", kBytes), 1);
        timers.reset(commands);
        frame.execute(commands, &timers);
    });
    const std::vector<gpu::ScopeTime> times = timers.read();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "fill");
    EXPECT_EQ(times[1].name, "increment");
}

TEST_F(FrameTest, Describe_DeclaredFrame_NamesPassesAndTargets) {
    FrameBuilder frame(*mPool);
    const BufferRef a = addFill(frame, "a", 1);
    addIncrement(frame, a, frame.createBuffer("b", kBytes), 1);
    frame.createImage({.name = "color", .format = kColorFormat, .width = 8, .height = 4});
    const frame::FrameDescription description = frame.describe();
    ASSERT_EQ(description.passes.size(), 2u);
    EXPECT_EQ(description.passes[1].reads[0].resource, "a");
    EXPECT_EQ(description.passes[1].writes[0].access, "compute write");
    ASSERT_EQ(description.targets.size(), 3u);
    EXPECT_EQ(description.targets[2].format, "r32g32b32a32_sfloat 8x4");
    EXPECT_EQ(description.targets[2].bytes, 512u);
    EXPECT_NE(description.text().find("increment"), std::string::npos);
}

// Twice the same passes: the second time nothing is made, and the result is that of the first.
TEST_F(FrameTest, ExecutedAgain_GivesTheSame) {
    const gpu::Buffer result = makeReadback(kBytes);
    FrameBuilder frame(*mPool);
    const BufferRef filled = addFill(frame, "filled", 41);
    const BufferRef next = frame.createBuffer("next", kBytes);
    addIncrement(frame, filled, next, 1);
    frame.addReadback("read", next, result);
    std::uint64_t allocations = 0;
    for (int i = 0; i < 3; ++i) {
        result.mappedAs<std::uint32_t>()[0] = 0;
        submit([&](Commands& commands) { EXPECT_TRUE(frame.execute(commands)); });
        EXPECT_EQ(result.mappedAs<std::uint32_t>()[0], 42u) << i;
        if (i == 0) allocations = mPool->allocations();
    }
    EXPECT_EQ(mPool->allocations(), allocations);
}

// Between execute() and resume() the caller draws into the pass's rendering, here by clearing.
TEST_F(FrameTest, HandedOverPass_TakesWhatTheCallerDraws) {
    const gpu::Buffer result = makeReadback(4 * sizeof(float));
    FrameBuilder frame(*mPool);
    const ImageRef image = frame.createImage({.name = "image",
                                              .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                              .usage = 0});
    frame.addPass("open").color(image, gpu::LoadOp::Clear, {1, 2, 3, 4}).handOver();
    frame.addReadback("read", image, result);
    for (const float value : {7.f, 8.f}) {
        submit([&](Commands& commands) {
            EXPECT_THROW(frame.resume(commands), AssertionError);
            EXPECT_FALSE(frame.execute(commands));
            EXPECT_TRUE(frame.isPaused());
            VkClearAttachment clear{VK_IMAGE_ASPECT_COLOR_BIT, 0, {}};
            clear.clearValue.color = {{value, 0, 0, 0}};
            const VkClearRect area{{{0, 0}, {1, 1}}, 0, 1};
            device().vk().vkCmdClearAttachments(commands.handle(), 1, &clear, 1, &area);
            EXPECT_TRUE(frame.resume(commands));
        });
        EXPECT_EQ(result.mappedAs<float>()[0], value);
    }
}

TEST_F(FrameTest, Misuse_IsRefusedByName) {
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const BufferRef a = frame.createBuffer("a", kBytes);
        frame.addPass("reader").reads(a, Access::ComputeRead);
        EXPECT_THROW(frame.execute(commands), AssertionError);
    });
    submit([&](Commands& commands) {
        FrameBuilder frame(*mPool);
        const BufferRef a = addFill(frame, "a", 1);
        const BufferRef b = frame.createBuffer("secret", kBytes);
        frame.addPass("sneaky").reads(a, Access::ComputeRead).record([=](auto&, const auto& r) {
            r.buffer(b);
        });
        try {
            frame.execute(commands);
            ADD_FAILURE() << "no error";
        } catch (const AssertionError& error) {
            EXPECT_STREQ(error.what(),
                         "pass 'sneaky' uses buffer 'secret' without having declared it");
        }
    });
    FrameBuilder frame(*mPool);
    const BufferRef a = frame.createBuffer("a", kBytes);
    EXPECT_THROW(frame.addPass("p").writes(a, Access::ComputeRead), AssertionError);
    EXPECT_THROW(frame.addPass("p").reads(a, Access::ComputeWrite), AssertionError);
    EXPECT_THROW(frame.addPass("p").reads(BufferRef{}, Access::ComputeRead), AssertionError);
}

}  // namespace
}  // namespace brume::test
