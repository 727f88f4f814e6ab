// SPDX-License-Identifier: Apache-2.0
// Choosing and making a device, its pipeline cache, its end.
#include <fmt/format.h>
#include <gpu/buffer.hpp>
#include <gpu/gpu_fixture.hpp>
#include <gpu/pipeline.hpp>
#include <spv/gpu_tests/fill.comp.hpp>

#include <filesystem>
#include <fstream>

namespace brume::test {
namespace {

using DeviceTest = GpuTest;

gpu::ComputePipeline makeFill(gpu::Device& device) {
    return gpu::ComputePipeline(device, {.name = "fill",
                                         .spirv = spv::gpu_tests_fill_comp,
                                         .bindings = {},
                                         .pushConstantBytes = 16,
                                         .specialization = {64, 1}});
}

// A file name that is free again at the end of the test.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& name)
        : mPath(
              std::filesystem::temp_directory_path() /
              fmt::format("brume_{}_{}", ::testing::UnitTest::GetInstance()->random_seed(), name)) {
        std::filesystem::remove(mPath);
    }
    ~TemporaryFile() { std::filesystem::remove(mPath); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::filesystem::path& path() const { return mPath; }

  private:
    std::filesystem::path mPath;
};

TEST_F(DeviceTest, Create_Default_HasQueueAndLimits) {
    EXPECT_NE(device().queue(), nullptr);
    EXPECT_GE(device().limits().maxStorageBufferRange, 1u << 27);
    EXPECT_GE(device().limits().maxPushDescriptors, 32u);
    EXPECT_GE(device().limits().maxPushConstantBytes, 128u);
    EXPECT_FALSE(device().info().name.empty());
    EXPECT_EQ(device().allocatedBytes(), 0u);
}

TEST_F(DeviceTest, Create_UnknownName_ListsEveryDevice) {
    gpu::DeviceOptions unknown;
    unknown.device = "no such device";
    try {
        gpu::Device::create(unknown, {});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        for (const gpu::DeviceInfo& info : gpu::listDevices())
            EXPECT_NE(std::string(error.what()).find(info.name), std::string::npos);
    }
}

TEST_F(DeviceTest, Create_ByPartOfNameOrIndex_FindsIt) {
    const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (!devices[i].rejections.empty()) continue;
        gpu::DeviceOptions byIndex;
        byIndex.device = std::to_string(i);
        EXPECT_EQ(gpu::Device::create(byIndex, {})->info().name, devices[i].name);
        gpu::DeviceOptions byName;
        byName.device = devices[i].name.substr(1);
        EXPECT_EQ(gpu::Device::create(byName, {})->info().name, devices[i].name);
    }
}

TEST_F(DeviceTest, TwoDevices_SideBySide_DoNotDisturbEachOther) {
    const auto second = gpu::Device::create(options(), log());
    const gpu::Buffer first(device(), {.name = "first", .bytes = 1024});
    const gpu::Buffer other(*second, {.name = "other", .bytes = 2048});
    EXPECT_GE(device().allocatedBytes(), 1024u);
    EXPECT_GE(second->allocatedBytes(), 2048u);
}

TEST_F(DeviceTest, Validation_WrongUse_IsCountedAndLogged) {
    const gpu::Buffer buffer(device(), {.name = "small", .bytes = 16});
    submit([&](gpu::Commands& commands) { commands.fillBuffer(buffer, 0, 2, 4); });
    EXPECT_FALSE(device().validationMessages().empty());
    device().clearValidationMessages();
    EXPECT_FALSE(takeMessages().empty());
}

TEST_F(DeviceTest, SynchronizationValidation_MissingBarrier_IsFound) {
    const gpu::Buffer a(device(), {.name = "a", .bytes = 64});
    const gpu::Buffer b(device(), {.name = "b", .bytes = 64});
    submit([&](gpu::Commands& commands) {
        commands.fillBuffer(a, 1);
        commands.copyBuffer(a, b, 64);
    });
    EXPECT_FALSE(takeMessages().empty());
}

TEST_F(DeviceTest, Destruction_LivingObject_IsNamedAndFreed) {
    auto own = gpu::Device::create(options(), log());
    const gpu::Buffer buffer(*own, {.name = "left behind", .bytes = 16});
    own.reset();
    const std::vector<std::string> messages = takeMessages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("'left behind'"), std::string::npos);
}

TEST_F(DeviceTest, PipelineCache_SavedAndCorrupted_LoadsOrStartsEmpty) {
    const TemporaryFile file("pipeline_cache");
    std::vector<std::string> notes;
    const Log notesLog([&](LogLevel, const std::string& message) { notes.push_back(message); });
    const auto build = [&] {
        notes.clear();
        gpu::DeviceOptions cached = options();
        cached.pipelineCacheFile = file.path();
        const auto own = gpu::Device::create(cached, notesLog);
        makeFill(*own);
        return notes.front();
    };
    EXPECT_EQ(build(), "pipeline cache: starts empty");
    ASSERT_TRUE(std::filesystem::exists(file.path()));
    EXPECT_EQ(build(), "pipeline cache: read");
    std::fstream(file.path(), std::ios::binary | std::ios::in | std::ios::out).seekp(30).put('x');
    EXPECT_EQ(build(), "pipeline cache: starts empty");
    std::filesystem::resize_file(file.path(), 5);
    EXPECT_EQ(build(), "pipeline cache: starts empty");
    EXPECT_EQ(build(), "pipeline cache: read");
}

TEST_F(DeviceTest, PipelineCache_UnwritableFolder_WarnsOnly) {
    gpu::DeviceOptions cached = options();
    cached.pipelineCacheFile = "/proc/brume/pipeline_cache";
    gpu::Device::create(cached, log()).reset();
    EXPECT_EQ(takeMessages().size(), 1u);
}

}  // namespace
}  // namespace brume::test
