// SPDX-License-Identifier: Apache-2.0
// The border: arguments, versions, memory, threads.
#include <host/host_fixture.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <thread>

namespace {

// Of this thread: drivers compile shaders in others.
thread_local std::uint64_t gAllocations = 0;

}  // namespace

// Every allocation by the C++ of this program and of the library is counted.
void* operator new(std::size_t bytes) {
    ++gAllocations;
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
    throw std::bad_alloc();
}
// GCC does not see that both sides are replaced.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace brume::test {
namespace {

template <typename Function>
Function deviceFunction(const BrumeContextCreateInfo& info, const char* name) {
    const auto get = reinterpret_cast<PFN_vkGetDeviceProcAddr>(
        info.getInstanceProcAddr(info.instance, "vkGetDeviceProcAddr"));
    return reinterpret_cast<Function>(get(info.device, name));
}

struct MemoryCount {
    int allocated = 0, freed = 0;
    const VkAllocationCallbacks* callbacks = nullptr;
    PFN_vkAllocateMemory allocate = nullptr;
    PFN_vkFreeMemory free = nullptr;
    VkDevice device = VK_NULL_HANDLE;

    void hook(BrumeContextCreateInfo& info) {
        device = info.device;
        allocate = deviceFunction<PFN_vkAllocateMemory>(info, "vkAllocateMemory");
        free = deviceFunction<PFN_vkFreeMemory>(info, "vkFreeMemory");
        info.memoryUser = this;
        info.allocateMemory = [](void* user, const VkMemoryAllocateInfo* what,
                                 VkDeviceMemory* memory) {
            auto& self = *static_cast<MemoryCount*>(user);
            ++self.allocated;
            return self.allocate(self.device, what, nullptr, memory);
        };
        info.freeMemory = [](void* user, VkDeviceMemory memory) {
            auto& self = *static_cast<MemoryCount*>(user);
            ++self.freed;
            self.free(self.device, memory, nullptr);
        };
    }
};

Scene makeScene(const Context& context, const char* method = "sorted") {
    auto info = init<BrumeSceneCreateInfo>();
    info.text = kSpheresScene;
    info.method = method;
    Scene scene(context, info);
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    auto lamp = init<BrumeLight>();
    lamp.type = BRUME_LIGHT_DIRECTIONAL;
    std::fill_n(lamp.color, 3, 1.0);
    lamp.direction[1] = -1;
    lamp.shadow = "visibility";
    lamp.shadowSettings = "resolution=32";
    check(brumeAddLight(scene.get(), &lamp, nullptr));
    return scene;
}

// Without validation: the layer allocates for each command.
class HostMemoryOf : public ::testing::TestWithParam<const char*> {};

TEST_P(HostMemoryOf, SteadyFrame_AllocatesNothing) {
    const auto device = gpu::Device::create({}, {});
    gpu::Submitter submitter(*device);
    TestHost host(*device, submitter, {48, 32});
    auto info = host.contextInfo();
    MemoryCount memory;
    memory.hook(info);
    const Context context(info);
    Scene scene = makeScene(context, GetParam());
    scene.prepare(host.view());
    std::vector<std::uint64_t> heap;
    int deviceBefore = 0;
    for (int i = 0; i < 12; ++i) {
        host.draw({0.2f, 0.3f, 0.4f}, 0);
        if (i == 8) deviceBefore = memory.allocated;
        host.frame(context.get(), [&](VkCommandBuffer commands) {
            // The camera moves, so that everything relative to it is uploaded anew.
            const BrumeView view = host.view({0.01 * i, 0, 5});
            const std::uint64_t before = gAllocations;
            scene.cmdSimulate(commands, 1 / 60.0);
            scene.cmdShadow(commands, view);
            scene.cmdRender(commands, view);
            heap.push_back(gAllocations - before);
        });
    }
    for (int i = 8; i < 12; ++i) EXPECT_EQ(heap[i], 0u) << "heap, frame " << i;
    EXPECT_EQ(memory.allocated, deviceBefore);
    EXPECT_GT(memory.allocated, 10);
    EXPECT_GT(heap[0], 100u) << "the counter counts the library's allocations";
}

INSTANTIATE_TEST_SUITE_P(All, HostMemoryOf, ::testing::Values("sorted", "tile", "linked_list"));

/// Counts what a driver takes and gives back through the host's callbacks.
struct CallbackCount {
    long living = 0, calls = 0;
    VkAllocationCallbacks callbacks{};

    CallbackCount() {
        callbacks.pUserData = this;
        callbacks.pfnAllocation = [](void* user, std::size_t bytes, std::size_t alignment,
                                     VkSystemAllocationScope) {
            auto& self = *static_cast<CallbackCount*>(user);
            ++self.living, ++self.calls;
            return std::aligned_alloc(std::max<std::size_t>(alignment, 8),
                                      (bytes + alignment - 1) / alignment * alignment);
        };
        callbacks.pfnReallocation = [](void*, void*, std::size_t, std::size_t,
                                       VkSystemAllocationScope) -> void* { return nullptr; };
        callbacks.pfnFree = [](void* user, void* memory) {
            if (memory) --static_cast<CallbackCount*>(user)->living;
            std::free(memory);
        };
    }
};

TEST_F(HostTest, HundredContexts_LeaveNothingBehind) {
    auto info = host().contextInfo();
    MemoryCount memory;
    memory.hook(info);
    CallbackCount driver;
    info.allocator = &driver.callbacks;
    for (int i = 0; i < 100; ++i) {
        const Context context(info);
        auto sceneInfo = init<BrumeSceneCreateInfo>();
        sceneInfo.text = kSpheresScene;
        Scene scene(context, sceneInfo);
        if (i % 25 != 0) continue;
        scene.prepare(host().view());
        host().draw({0, 0, 0}, 0);
        host().frames = 0;
        host().frame(context.get(),
                     [&](VkCommandBuffer commands) { scene.cmdRender(commands, host().view()); });
    }
    EXPECT_GT(memory.allocated, 40);
    EXPECT_EQ(memory.allocated, memory.freed);
    EXPECT_GT(driver.calls, 100);
    EXPECT_EQ(driver.living, 0);
    // Whatever else is left, validation tells when the device goes.
}

TEST_F(HostTest, MemoryBudget_IsKept) {
    auto info = host().contextInfo();
    info.memoryBudgetBytes = 1 << 16;
    const Context context(info);
    Scene scene = makeScene(context);
    EXPECT_EQ(brumePrepare(scene.get(), std::array{host().view()}.data()),
              BRUME_ERROR_OUT_OF_DEVICE_MEMORY);
    EXPECT_NE(std::string(brumeLastError()).find("budget"), std::string::npos) << brumeLastError();
    EXPECT_LE(scene.counters().contextBytes, info.memoryBudgetBytes);
}

TEST_F(HostTest, LogOfTheHost_IsTold) {
    std::vector<std::string> warnings;
    auto info = host().contextInfo();
    info.logUser = &warnings;
    info.log = [](void* user, BrumeLogLevel level, const char* message) {
        if (level == BRUME_LOG_WARNING)
            static_cast<std::vector<std::string>*>(user)->emplace_back(message);
    };
    const Context context(info);
    const Scene scene = makeScene(context);
    EXPECT_TRUE(warnings.empty()) << warnings[0];
    auto sceneInfo = init<BrumeSceneCreateInfo>();
    std::string text = kSpheresScene;
    text.insert(1, R"( "particleBudget": 10,)");
    sceneInfo.text = text.c_str();
    const Scene cut(context, sceneInfo);
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(cut.get(), &puffs, nullptr));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("10"), std::string::npos) << warnings[0];
}

// It is not made anew, and it is the host's to destroy: validation tells of a second time.
TEST_F(HostTest, PipelineCacheOfTheHost_StaysTheHosts) {
    auto info = host().contextInfo();
    const VkPipelineCacheCreateInfo cacheInfo{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    ASSERT_EQ(deviceFunction<PFN_vkCreatePipelineCache>(info, "vkCreatePipelineCache")(
                  info.device, &cacheInfo, nullptr, &info.pipelineCache),
              VK_SUCCESS);
    {
        const Context context(info);
        Scene scene = makeScene(context);
        scene.prepare(host().view());
    }
    std::size_t bytes = 0;
    EXPECT_EQ(deviceFunction<PFN_vkGetPipelineCacheData>(info, "vkGetPipelineCacheData")(
                  info.device, info.pipelineCache, &bytes, nullptr),
              VK_SUCCESS);
    EXPECT_GT(bytes, 0u);
    deviceFunction<PFN_vkDestroyPipelineCache>(info, "vkDestroyPipelineCache")(
        info.device, info.pipelineCache, nullptr);
}

TEST_F(HostTest, BadArguments_AreRefusedByName) {
    BrumeContext none = nullptr;
    auto info = host().contextInfo();
    const auto expect = [](BrumeResult result, const char* word) {
        EXPECT_EQ(result, BRUME_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(brumeLastError()).find(word), std::string::npos)
            << brumeLastError() << " lacks " << word;
    };
    expect(brumeCreateContext(nullptr, &none), "null");
    expect(brumeCreateContext(&info, nullptr), "context");
    info.device = VK_NULL_HANDLE;
    expect(brumeCreateContext(&info, &none), "device");
    info = host().contextInfo();
    info.headerVersion = 999999999;
    expect(brumeCreateContext(&info, &none), "headerVersion");
    info = host().contextInfo();
    info.structSize = 0;
    expect(brumeCreateContext(&info, &none), "structSize");
    EXPECT_EQ(none, nullptr);

    const Context context(host().contextInfo());
    auto sceneInfo = init<BrumeSceneCreateInfo>();
    BrumeScene missing = nullptr;
    sceneInfo.file = "/nowhere/scene.json";
    expect(brumeCreateScene(context.get(), &sceneInfo, &missing), "scene.json");
    sceneInfo.file = nullptr;
    sceneInfo.method = "mosaic";
    expect(brumeCreateScene(context.get(), &sceneInfo, &missing), "mosaic");
    sceneInfo.method = "sorted";
    sceneInfo.text = "{ \"version\": 1, \"lihgts\": [] }";
    expect(brumeCreateScene(context.get(), &sceneInfo, &missing), "lihgts");

    Scene scene = makeScene(context);
    const BrumeView view = host().view();
    const auto prepareWith = [&](const std::function<void(BrumeView&)>& change) {
        BrumeView changed = view;
        change(changed);
        return brumePrepare(scene.get(), &changed);
    };
    expect(prepareWith([](BrumeView& v) { v.viewFromWorld[0] = 2; }), "scales");
    expect(prepareWith([](BrumeView& v) { v.clipFromView[4] = 0.1; }), "skewed");
    expect(prepareWith([](BrumeView& v) { v.width = 49; }), "beyond");
    expect(prepareWith([](BrumeView& v) { v.x = -1; }), "viewport");
    expect(prepareWith([](BrumeView& v) { v.color.format = VK_FORMAT_UNDEFINED; }), "color");
    expect(prepareWith([](BrumeView& v) { std::fill_n(v.clipFromView, 16, NAN); }), "clipFromView");
    auto step = init<BrumeStep>();
    const auto commands = reinterpret_cast<VkCommandBuffer>(std::uintptr_t{8});  // never used
    expect(brumeCmdSimulate(scene.get(), commands, &step), "frame");
    check(brumeBeginFrame(context.get(), 1));
    expect(brumeBeginFrame(context.get(), 1), "frameIndex");
    for (const double seconds : {-1.0, double(NAN), std::numeric_limits<double>::infinity()}) {
        step.seconds = seconds;
        expect(brumeCmdSimulate(scene.get(), commands, &step), "seconds");
    }
    expect(brumeCmdRender(scene.get(), nullptr, &view), "commands");
    expect(brumeCmdRender(nullptr, commands, &view), "scene");
    brumeDestroyScene(nullptr);
    brumeDestroyContext(nullptr);
}

// Members that a caller does not know, or that we do not know.
TEST_F(HostTest, StructuresOfOtherVersions_AreRead) {
    struct Newer {
        BrumeStep known;
        std::uint64_t unknown;
    };
    const Context context(host().contextInfo());
    Scene scene = makeScene(context);
    host().draw({0, 0, 0}, 0);
    host().frame(context.get(), [&](VkCommandBuffer commands) {
        Newer step{init<BrumeStep>(), 0};
        step.known.structSize = sizeof(Newer);
        EXPECT_EQ(brumeCmdSimulate(scene.get(), commands, &step.known), BRUME_SUCCESS);
        step.unknown = 1;
        EXPECT_EQ(brumeCmdSimulate(scene.get(), commands, &step.known),
                  BRUME_ERROR_INVALID_ARGUMENT);
        // An older caller had no `seconds`.
        BrumeStep older = init<BrumeStep>();
        older.structSize = offsetof(BrumeStep, seconds);
        older.seconds = NAN;
        EXPECT_EQ(brumeCmdSimulate(scene.get(), commands, &older), BRUME_SUCCESS);
        auto counters = init<BrumeCounters>();
        counters.structSize = offsetof(BrumeCounters, frames);
        counters.frames = 77;
        EXPECT_EQ(brumeGetCounters(scene.get(), &counters), BRUME_SUCCESS);
        EXPECT_EQ(counters.effects, 1u);
        EXPECT_EQ(counters.frames, 77u) << "not beyond its size";
    });
}

// Each thread with a device, a context and a scene of its own; the same pictures come out.
TEST(HostThreads, TwoContexts_RunBesideEachOther) {
    std::vector<vec4> images[2];
    std::vector<std::string> messages[2];
    const auto work = [&](int index) {
        gpu::DeviceOptions options;
        options.validate = true;
        const auto device = gpu::Device::create(
            options, Log([&, index](LogLevel level, const std::string& message) {
                if (level >= LogLevel::Warning) messages[index].push_back(message);
            }));
        gpu::Submitter submitter(*device);
        TestHost host(*device, submitter, {48, 32});
        const Context context(host.contextInfo());
        Scene scene = makeScene(context);
        for (int frame = 0; frame < 4; ++frame) {
            host.draw({0.2f, 0.3f, 0.4f}, 0);
            host.frame(context.get(), [&](VkCommandBuffer commands) {
                scene.cmdSimulate(commands, 0.1);
                scene.cmdRender(commands, host.view());
            });
        }
        images[index] = host.read();
    };
    std::thread other(work, 1);
    work(0);
    other.join();
    EXPECT_EQ(images[0], images[1]);
    for (const auto& list : messages)
        for (const std::string& message : list) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace brume::test
