// SPDX-License-Identifier: Apache-2.0
// Buffers, images, memory limits and deferred destruction.
#include <core/assert.hpp>
#include <gpu/gpu_fixture.hpp>
#include <gpu/upload.hpp>

#include <numeric>

namespace brume::test {
namespace {

using ObjectsTest = GpuTest;

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Failure);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return "";
}

TEST_F(ObjectsTest, Buffer_UploadAndRead_GivesTheSame) {
    std::vector<std::uint32_t> values(1000);
    std::iota(values.begin(), values.end(), 5u);
    gpu::Buffer buffer;
    submit([&](gpu::Commands& commands) {
        buffer = gpu::makeBuffer(commands, "values", values);
        gpu::upload(commands, buffer, std::vector<std::uint32_t>{1, 2}, 40);
    });
    values[10] = 1, values[11] = 2;
    EXPECT_EQ(submitter().readBuffer<std::uint32_t>(buffer, 1000), values);
    EXPECT_EQ(submitter().readBuffer<std::uint32_t>(buffer, 2, 40),
              (std::vector<std::uint32_t>{1, 2}));
}

TEST_F(ObjectsTest, Buffer_Mapped_IsSeenByTheDevice) {
    const gpu::Buffer source(device(),
                             {.name = "source", .bytes = 16, .memory = gpu::MemoryKind::Upload});
    const gpu::Buffer target(device(),
                             {.name = "target", .bytes = 16, .memory = gpu::MemoryKind::Readback});
    source.mappedAs<float>()[3] = 2.5f;
    submit([&](gpu::Commands& commands) {
        commands.copyBuffer(source, target, 16);
        commands.fullBarrier();
    });
    EXPECT_EQ(target.mappedAs<float>()[3], 2.5f);
    const gpu::Buffer unmapped(device(), {.name = "unmapped", .bytes = 16});
    EXPECT_THROW(unmapped.mappedAs<float>(), AssertionError);
}

// Whatever was in that memory before: counters are read before a frame has written them.
TEST_F(ObjectsTest, Buffer_Readback_BeginsAsZeros) {
    for (int i = 0; i < 4; ++i) {
        gpu::Buffer buffer(device(), {.name = "test.readback",
                                      .bytes = 64,
                                      .memory = gpu::MemoryKind::Readback});
        for (std::uint32_t& word : buffer.mappedAs<std::uint32_t>()) {
            EXPECT_EQ(word, 0u);
            word = 0xabababab;
        }
    }
}

TEST_F(ObjectsTest, Buffer_TooLarge_FailsWithNameAndSize) {
    const std::string message = messageOf(
        [&] { gpu::Buffer(device(), {.name = "far too large", .bytes = std::uint64_t{1} << 50}); });
    EXPECT_NE(message.find("far too large"), std::string::npos) << message;
    EXPECT_NE(message.find("1073741824.0 MiB"), std::string::npos) << message;
    EXPECT_EQ(device().allocatedBytes(), 0u);
}

TEST_F(ObjectsTest, Buffer_MoreThanTheHeap_FailsAndTheRestWorks) {
    const std::uint64_t bytes =
        std::min(device().limits().maxBufferBytes, device().limits().deviceHeapBytes) / 2 + 4096;
    if (bytes > (std::uint64_t{4} << 30)) GTEST_SKIP() << "the device has too much memory";
    const gpu::Buffer first(device(), {.name = "first", .bytes = bytes});
    const std::string message =
        messageOf([&] { gpu::Buffer(device(), {.name = "second", .bytes = bytes}); });
    EXPECT_NE(message.find("second"), std::string::npos) << message;
    EXPECT_NE(message.find("in use"), std::string::npos) << message;
    const gpu::Buffer small(device(), {.name = "small", .bytes = 16});
    EXPECT_EQ(device().objects().size(), 2u);
}

TEST_F(ObjectsTest, Image_TooLargeOrOfWrongUse_FailsWithName) {
    const std::string large = messageOf([&] {
        gpu::Image(device(),
                   {.name = "wide", .format = VK_FORMAT_R8_UNORM, .width = 1u << 20, .height = 1});
    });
    EXPECT_NE(large.find("wide"), std::string::npos) << large;
    const std::string wrong = messageOf([&] {
        gpu::Image(device(), {.name = "odd",
                              .format = VK_FORMAT_D32_SFLOAT,
                              .width = 4,
                              .height = 4,
                              .usage = gpu::kUsageColor});
    });
    EXPECT_NE(wrong.find("d32_sfloat"), std::string::npos) << wrong;
}

TEST_F(ObjectsTest, Image_ClearAndRead_GivesTheColor) {
    const gpu::Image image(device(), {.name = "image",
                                      .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                      .width = 5,
                                      .height = 3,
                                      .usage = gpu::kUsageTransferRead | gpu::kUsageTransferWrite});
    submit([&](gpu::Commands& commands) {
        commands.transition(image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, true);
        commands.clearColorImage(image, std::array{1.0f, 2.0f, 3.0f, 4.0f});
    });
    const auto texels = submitter().readImage<std::array<float, 4>>(image);
    EXPECT_EQ(texels, std::vector(15, std::array{1.0f, 2.0f, 3.0f, 4.0f}));
}

TEST_F(ObjectsTest, Image_ArrayUploadAndRead_GivesTheSame) {
    const gpu::Image image(device(), {.name = "layers",
                                      .format = VK_FORMAT_R32_SFLOAT,
                                      .width = 4,
                                      .height = 2,
                                      .layers = 3,
                                      .usage = gpu::kUsageSampled | gpu::kUsageTransferRead |
                                               gpu::kUsageTransferWrite});
    std::vector<float> texels(24);
    std::iota(texels.begin(), texels.end(), 0.0f);
    submit([&](gpu::Commands& commands) { gpu::upload(commands, image, texels); });
    EXPECT_EQ(submitter().readImage<float>(image), texels);
}

TEST_F(ObjectsTest, DeferredDestruction_OpenFrames_KeepsUntilRetired) {
    const auto inFlight = [&] { return device().allocatedBytes(); };
    const std::uint64_t first = device().beginFrame();
    gpu::Buffer a(device(), {.name = "a", .bytes = 4096});
    const std::uint64_t bytes = inFlight();
    a = {};
    const std::uint64_t second = device().beginFrame();
    gpu::Buffer(device(), {.name = "b", .bytes = 4096});
    EXPECT_EQ(inFlight(), 2 * bytes);
    EXPECT_TRUE(device().objects().empty());
    device().retireFrame(first);
    EXPECT_EQ(inFlight(), bytes);
    device().retireFrame(second);
    EXPECT_EQ(inFlight(), 0u);
    gpu::Buffer(device(), {.name = "c", .bytes = 4096});
    EXPECT_EQ(inFlight(), 0u);
}

TEST_F(ObjectsTest, Upload_OutsideAFrame_IsRefused) {
    const gpu::Buffer target(device(), {.name = "target", .bytes = 16});
    gpu::Commands commands(device(), VK_NULL_HANDLE);
    EXPECT_THROW(gpu::upload(commands, target, std::vector<float>(4)), AssertionError);
}

TEST_F(ObjectsTest, Submit_ThrowingRecorder_LeavesTheSubmitterUsable) {
    EXPECT_THROW(submit([](gpu::Commands&) { throw std::runtime_error("recorder"); }),
                 std::runtime_error);
    EXPECT_FALSE(device().isFrameOpen());
    const gpu::Buffer buffer(device(), {.name = "buffer", .bytes = 16});
    submit([&](gpu::Commands& commands) { commands.fillBuffer(buffer, 3); });
    EXPECT_EQ(submitter().readBuffer<std::uint32_t>(buffer, 1)[0], 3u);
}

}  // namespace
}  // namespace brume::test
