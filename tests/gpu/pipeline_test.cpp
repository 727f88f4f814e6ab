// SPDX-License-Identifier: Apache-2.0
// Dispatching: specialization, push constants, device addresses, bindings, timers.
#include <core/assert.hpp>
#include <gpu/gpu_fixture.hpp>
#include <gpu/timer_pool.hpp>
#include <gpu/upload.hpp>
#include <spv/gpu_tests/fill.comp.hpp>
#include <spv/gpu_tests/sample3d.comp.hpp>

#include <bit>

namespace brume::test {
namespace {

using PipelineTest = GpuTest;

struct FillPush {
    VkDeviceAddress target;
    std::uint32_t base;
    std::uint32_t count;
};

gpu::ComputePipeline makeFill(gpu::Device& device, std::uint32_t stride, float scale) {
    return gpu::ComputePipeline(
        device, {.name = "fill",
                 .spirv = spv::gpu_tests_fill_comp,
                 .bindings = {},
                 .pushConstantBytes = sizeof(FillPush),
                 .specialization = {64, stride, std::bit_cast<std::uint32_t>(scale)}});
}

gpu::ComputePipeline makeSample(gpu::Device& device) {
    return gpu::ComputePipeline(device, {.name = "sample",
                                         .spirv = spv::gpu_tests_sample3d_comp,
                                         .bindings = {{0, gpu::BindingType::SampledImage},
                                                      {1, gpu::BindingType::StorageBuffer},
                                                      {2, gpu::BindingType::StorageBuffer}},
                                         .pushConstantBytes = 0,
                                         .specialization = {}});
}

TEST_F(PipelineTest, Dispatch_SpecializationAndPushConstants_GiveTheirValues) {
    const gpu::ComputePipeline pipeline = makeFill(device(), 3, 2.0f);
    const gpu::Buffer buffer(device(), {.name = "values", .bytes = 4000});
    submit([&](gpu::Commands& commands) {
        commands.bindCompute(pipeline);
        commands.pushConstants(FillPush{buffer.deviceAddress(), 10, 1000});
        commands.dispatchThreads(1000, 64);
    });
    const auto values = submitter().readBuffer<std::uint32_t>(buffer, 1000);
    for (std::uint32_t i = 0; i < 1000; ++i) ASSERT_EQ(values[i], 10 + 6 * i);
}

TEST_F(PipelineTest, Dispatch_BufferBeyondBindingRange_WorksByAddress) {
    constexpr std::uint32_t kCount = 40'000'000;  // 160 MB > 128 MiB
    const gpu::ComputePipeline pipeline = makeFill(device(), 1, 1.0f);
    const gpu::Buffer buffer(device(), {.name = "large", .bytes = std::uint64_t{kCount} * 4});
    submit([&](gpu::Commands& commands) {
        commands.bindCompute(pipeline);
        commands.pushConstants(FillPush{buffer.deviceAddress(), 0, kCount});
        commands.dispatchThreads(kCount, 64);
    });
    const std::uint64_t last = kCount - 4;
    EXPECT_EQ(submitter().readBuffer<std::uint32_t>(buffer, 4, last * 4),
              (std::vector<std::uint32_t>{kCount - 4, kCount - 3, kCount - 2, kCount - 1}));
}

TEST_F(PipelineTest, Bind_BufferBeyondBindingRange_IsRefused) {
    const std::uint64_t bytes = device().limits().maxStorageBufferRange + 256;
    if (bytes > (std::uint64_t{1} << 30)) GTEST_SKIP() << "the device's limit is too high";
    const gpu::ComputePipeline pipeline = makeSample(device());
    const gpu::Buffer buffer(device(), {.name = "large", .bytes = bytes});
    submit([&](gpu::Commands& commands) {
        commands.bindCompute(pipeline);
        EXPECT_THROW(commands.bind(1, buffer), AssertionError);
        EXPECT_NO_THROW(commands.bind(1, gpu::BufferRange{&buffer, 256, 1024}));
    });
}

TEST_F(PipelineTest, Sample_Volume_InterpolatesLinearly) {
    const gpu::Image volume(
        device(),
        {.name = "volume", .format = VK_FORMAT_R32_SFLOAT, .width = 4, .height = 3, .depth = 2});
    std::vector<float> texels;
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 4; ++x) texels.push_back(static_cast<float>(x + 10 * y + 100 * z));
    const gpu::Sampler sampler(device(), {.name = "linear"});
    const gpu::ComputePipeline pipeline = makeSample(device());
    const gpu::Buffer values(device(), {.name = "values", .bytes = 32});
    submit([&](gpu::Commands& commands) {
        gpu::upload(commands, volume, texels);
        // Texel centres, then half way between two of them along each axis.
        const std::vector<std::array<float, 4>> points = {{1.5f / 4, 1.5f / 3, 0.5f / 2, 0},
                                                          {2.0f / 4, 1.0f / 3, 1.0f / 2, 0}};
        const gpu::Buffer pointBuffer = gpu::makeBuffer(commands, "points", points);
        commands.bindCompute(pipeline);
        commands.bind(0, volume, sampler);
        commands.bind(1, pointBuffer);
        commands.bind(2, values);
        commands.dispatch(1);
    });
    const auto result = submitter().readBuffer<std::array<float, 4>>(values, 2);
    EXPECT_FLOAT_EQ(result[0][0], 11.0f);
    EXPECT_NEAR(result[1][0], 56.5f, 0.3f);
}

TEST_F(PipelineTest, Dispatch_WithMisuse_NamesPipelineAndBinding) {
    const gpu::ComputePipeline pipeline = makeSample(device());
    const gpu::ComputePipeline fill = makeFill(device(), 1, 1);
    const gpu::Buffer buffer(device(), {.name = "buffer", .bytes = 64});
    submit([&](gpu::Commands& commands) {
        EXPECT_THROW(commands.dispatch(1), AssertionError);
        commands.bindCompute(pipeline);
        commands.bind(1, buffer);
        EXPECT_THROW(commands.bind(0, buffer), AssertionError);
        EXPECT_THROW(commands.bind(9, buffer), AssertionError);
        try {
            commands.dispatch(1);
            ADD_FAILURE() << "no error";
        } catch (const AssertionError& error) {
            EXPECT_STREQ(error.what(), "recording with pipeline 'sample': binding 0[0] is missing");
        }
        EXPECT_THROW(commands.draw(3), AssertionError);
        commands.bindCompute(fill);
        EXPECT_THROW(commands.pushConstants(1.0f), AssertionError);
    });
}

class KeptPipelines : public PipelineTest {
  protected:
    KeptPipelines() { mKeepsPipelines = true; }
};

TEST_F(KeptPipelines, SameDescription_IsTheSamePipelineAndOthersAreNot) {
    const VkPipeline first = makeFill(device(), 1, 1.0f).handle();  // gone, but kept
    const gpu::ComputePipeline same = makeFill(device(), 1, 1.0f), other = makeFill(device(), 2, 1.0f);
    EXPECT_EQ(same.handle(), first);
    EXPECT_NE(other.handle(), first);
    const std::span<const std::uint32_t> words = spv::gpu_tests_fill_comp;
    std::vector<std::uint32_t> edited(words.begin(), words.end());
    edited[2] += 1;  // the number of the tool that wrote it
    device().replaceShader(words.data(), edited);
    EXPECT_NE(makeFill(device(), 1, 1.0f).handle(), first);
    device().replaceShader(words.data(), {});
    EXPECT_EQ(makeFill(device(), 1, 1.0f).handle(), first);
}

TEST_F(KeptPipelines, UsedAgain_StillWorks) {
    const gpu::Buffer buffer(device(), {.name = "values", .bytes = 256});
    for (std::uint32_t base : {1u, 2u}) {
        submit([&](gpu::Commands& commands) {
            const gpu::ComputePipeline pipeline = makeFill(device(), 0, 1.0f);
            commands.bindCompute(pipeline);
            commands.pushConstants(FillPush{buffer.deviceAddress(), base, 64});
            commands.dispatchThreads(64, 64);
        });
        EXPECT_EQ(submitter().readBuffer<std::uint32_t>(buffer, 1)[0], base);
    }
}

TEST_F(PipelineTest, Timers_LongAndShortScope_MeasureThem) {
    constexpr std::uint32_t kCount = 8'000'000;
    const gpu::ComputePipeline pipeline = makeFill(device(), 1, 1.0f);
    const gpu::Buffer buffer(device(), {.name = "values", .bytes = std::uint64_t{kCount} * 4});
    gpu::TimerPool timers(device(), "timers", 3);
    const auto record = [&](gpu::Commands& commands) {
        timers.reset(commands);
        const std::size_t all = timers.begin(commands, "all");
        for (const std::uint32_t count : {kCount, 64u, 64u}) {
            const std::size_t scope = timers.begin(commands, std::to_string(count));
            commands.bindCompute(pipeline);
            commands.pushConstants(FillPush{buffer.deviceAddress(), 0, count});
            commands.dispatchThreads(count, 64);
            timers.end(commands, scope);
        }
        timers.end(commands, all);
    };
    submit(record);  // the first use of a pipeline compiles it
    submit(record);
    const std::vector<gpu::ScopeTime> times = timers.read();
    ASSERT_EQ(times.size(), 4u);
    EXPECT_EQ(times[1].name, "8000000");
    EXPECT_EQ(times[3].timeMs, 0.0);  // beyond the pool
    if (device().limits().timestampValidBits == 0) return;
    EXPECT_GT(times[1].timeMs, times[2].timeMs);
    EXPECT_GE(times[0].timeMs, times[1].timeMs);
    EXPECT_NEAR(timers.readTotalMs(), times[0].timeMs, 1e-9);
}

}  // namespace
}  // namespace brume::test
