// SPDX-License-Identifier: Apache-2.0
// Vulkan calls that fail: each in turn, with each error. The result tells, nothing crashes, and the
// same calls work afterwards.
#include <host/host_fixture.hpp>

#include <gpu/instance.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>

namespace brume::test {
namespace {

/// What goes between the library and the driver.
struct Faults {
    std::map<std::string, int> calls;  // by function
    std::string failing;               // function whose call ...
    int failingCall = -1;              // ... number so many fails
    VkResult error = VK_SUCCESS;
    bool hasFailed = false;

    bool takes(const char* name) {
        const int call = calls[name]++;
        if (hasFailed || failing != name || call != failingCall) return false;
        return hasFailed = true;
    }
};
Faults gFaults;
PFN_vkGetInstanceProcAddr gInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr gDeviceProc = nullptr;

template <typename Name, typename Function>
struct Wrapped;
template <typename Name, typename... Arguments>
struct Wrapped<Name, VkResult(VKAPI_PTR*)(Arguments...)> {
    static inline VkResult(VKAPI_PTR* real)(Arguments...) = nullptr;
    static VkResult VKAPI_CALL call(Arguments... arguments) {
        if (gFaults.takes(Name::kName)) return gFaults.error;
        return real(arguments...);
    }
};

#define BRUME_WRAP(function)                            \
    struct Name_##function {                            \
        static constexpr const char* kName = #function; \
    };                                                  \
    using Wrapped_##function = Wrapped<Name_##function, PFN_##function>;
BRUME_WRAP(vkCreateBuffer)
BRUME_WRAP(vkAllocateMemory)
BRUME_WRAP(vkBindBufferMemory)
BRUME_WRAP(vkMapMemory)
BRUME_WRAP(vkCreateImage)
BRUME_WRAP(vkBindImageMemory)
BRUME_WRAP(vkCreateImageView)
BRUME_WRAP(vkCreateSampler)
BRUME_WRAP(vkCreateShaderModule)
BRUME_WRAP(vkCreateDescriptorSetLayout)
BRUME_WRAP(vkCreatePipelineLayout)
BRUME_WRAP(vkCreateComputePipelines)
BRUME_WRAP(vkCreateGraphicsPipelines)
BRUME_WRAP(vkCreatePipelineCache)
#undef BRUME_WRAP

template <typename WrappedFunction, typename Name>
bool tryWrap(const char* name, PFN_vkVoidFunction found, PFN_vkVoidFunction& result) {
    if (std::string_view(name) != Name::kName) return false;
    WrappedFunction::real = reinterpret_cast<decltype(WrappedFunction::real)>(found);
    result = reinterpret_cast<PFN_vkVoidFunction>(&WrappedFunction::call);
    return true;
}

PFN_vkVoidFunction VKAPI_CALL getDeviceProc(VkDevice device, const char* name) {
    PFN_vkVoidFunction found = gDeviceProc(device, name);
#define BRUME_TRY(function) || tryWrap<Wrapped_##function, Name_##function>(name, found, found)
    static_cast<void>(
        false BRUME_TRY(vkCreateBuffer) BRUME_TRY(vkAllocateMemory) BRUME_TRY(vkBindBufferMemory)
            BRUME_TRY(vkMapMemory) BRUME_TRY(vkCreateImage) BRUME_TRY(vkBindImageMemory)
                BRUME_TRY(vkCreateImageView) BRUME_TRY(vkCreateSampler)
                    BRUME_TRY(vkCreateShaderModule) BRUME_TRY(vkCreateDescriptorSetLayout)
                        BRUME_TRY(vkCreatePipelineLayout) BRUME_TRY(vkCreateComputePipelines)
                            BRUME_TRY(vkCreateGraphicsPipelines) BRUME_TRY(vkCreatePipelineCache));
#undef BRUME_TRY
    return found;
}

PFN_vkVoidFunction VKAPI_CALL getInstanceProc(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction found = gInstanceProc(instance, name);
    if (std::string_view(name) != "vkGetDeviceProcAddr") return found;
    gDeviceProc = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProc);
}

/// A context, a scene and a frame; each step is tried until it works.
struct Outcome {
    std::vector<BrumeResult> errors;
    std::vector<vec4> image;
    int latePipelines = 0;  // made after brumePrepare()
};

int countPipelines() {
    return gFaults.calls["vkCreateComputePipelines"] + gFaults.calls["vkCreateGraphicsPipelines"];
}

Outcome runAll(TestHost& host, const char* method) {
    Outcome run;
    const auto insist = [&](const std::function<BrumeResult()>& call) {
        for (int i = 0; i < 3; ++i) {
            const BrumeResult result = call();
            if (result == BRUME_SUCCESS) return;
            run.errors.push_back(result);
            EXPECT_STRNE(brumeLastError(), "");
        }
        ADD_FAILURE() << "does not recover: " << brumeLastError();
    };
    gInstanceProc = gpu::systemLoader();
    auto info = host.contextInfo();
    info.getInstanceProcAddr = getInstanceProc;
    BrumeContext context = nullptr;
    insist([&] { return brumeCreateContext(&info, &context); });
    auto sceneInfo = init<BrumeSceneCreateInfo>();
    sceneInfo.text = kSpheresScene;
    sceneInfo.method = method;
    BrumeScene scene = nullptr;
    insist([&] { return brumeCreateScene(context, &sceneInfo, &scene); });
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    insist([&] { return brumeAddEffect(scene, &puffs, nullptr); });
    host.draw({0.2f, 0.3f, 0.4f}, 0);
    const BrumeView view = host.view();
    insist([&] { return brumePrepare(scene, &view); });
    run.latePipelines = -countPipelines();
    auto step = init<BrumeStep>();
    step.seconds = 0.3;
    bool isStepped = false;
    insist([&] {
        BrumeResult result = BRUME_SUCCESS;
        try {
            host.frame(context, [&](VkCommandBuffer commands) {
                if (!isStepped) result = brumeCmdSimulate(scene, commands, &step);
                isStepped = isStepped || result == BRUME_SUCCESS;
                if (result == BRUME_SUCCESS) result = brumeCmdRender(scene, commands, &view);
                // A frame that was not recorded whole is not to be submitted.
                if (result != BRUME_SUCCESS) throw ApiError(result);
            });
        } catch (const ApiError&) {
        }
        return result;
    });
    run.latePipelines += countPipelines();
    run.image = host.read();
    brumeDestroyContext(context);
    return run;
}

bool isThorough() {
    const char* wanted = std::getenv("BRUME_FAULTS");
    return wanted && std::string_view(wanted) == "all";
}

/// Calls of a function that was called `count` times: all if isThorough(), else one, another for
/// each error and function.
std::vector<int> chooseCalls(int count, VkResult error) {
    if (!isThorough())
        return {static_cast<int>((static_cast<unsigned>(-error) * 7919u + count) % count)};
    std::vector<int> calls(count);
    std::iota(calls.begin(), calls.end(), 0);
    return calls;
}

struct FaultCase {
    VkResult error;
    const char* method;
    int every;  // of so many functions one, unless isThorough()
};

/// Its name in lists of tests, the same in every run.
void PrintTo(const FaultCase& c, std::ostream* out) { *out << c.method; }

class HostFaults : public ::testing::TestWithParam<FaultCase> {};

TEST_P(HostFaults, EachCallInTurn_IsReportedAndSurvived) {
    const auto [error, method, every] = GetParam();
    std::vector<std::string> messages;
    gpu::DeviceOptions options;
    options.validate = true;
    auto device = gpu::Device::create(options, Log([&](LogLevel level, const std::string& text) {
                                          if (level >= LogLevel::Warning) messages.push_back(text);
                                      }));
    {
        gpu::Submitter submitter(*device);
        TestHost host(*device, submitter, {16, 8});
        gFaults = {};
        const Outcome good = runAll(host, method);
        EXPECT_TRUE(good.errors.empty());
        EXPECT_EQ(good.latePipelines, 0) << "brumePrepare() makes all of them";
        const std::map<std::string, int> calls = gFaults.calls;
        EXPECT_EQ(calls.size(), 14u) << "functions that the library calls";
        gFaults = {};
        host.frames = 0;
        runAll(host, method);
        EXPECT_EQ(gFaults.calls, calls) << "they are the same each time";
        const std::map<VkResult, BrumeResult> expected = {
            {VK_ERROR_OUT_OF_DEVICE_MEMORY, BRUME_ERROR_OUT_OF_DEVICE_MEMORY},
            {VK_ERROR_OUT_OF_HOST_MEMORY, BRUME_ERROR_OUT_OF_HOST_MEMORY},
            {VK_ERROR_DEVICE_LOST, BRUME_ERROR_DEVICE_LOST}};
        int tried = 0, made = 0, index = -error;
        for (const auto& [function, count] : calls) {
            made += count;
            if (!isThorough() && index++ % every != 0) continue;
            for (const int call : chooseCalls(count, error)) {
                gFaults = {{}, function, call, error, false};
                SCOPED_TRACE(function + ", call " + std::to_string(call));
                host.frames = 0;
                const Outcome run = runAll(host, method);
                ++tried;
                EXPECT_TRUE(gFaults.hasFailed);
                ASSERT_EQ(run.errors.size(), 1u);
                EXPECT_EQ(run.errors[0], expected.at(error));
                EXPECT_TRUE(run.image == good.image);
            }
        }
        RecordProperty("calls", made);
        RecordProperty("failed", tried);
        std::printf("%d of %d calls of %zu functions failed\n", tried, made, calls.size());
    }
    device.reset();
    for (const std::string& message : messages) ADD_FAILURE() << message;
}

INSTANTIATE_TEST_SUITE_P(All, HostFaults,
                         ::testing::Values(FaultCase{VK_ERROR_OUT_OF_DEVICE_MEMORY, "unordered", 1},
                                           FaultCase{VK_ERROR_OUT_OF_HOST_MEMORY, "unordered", 2},
                                           FaultCase{VK_ERROR_DEVICE_LOST, "unordered", 2},
                                           FaultCase{VK_ERROR_OUT_OF_DEVICE_MEMORY, "tile", 3}),
                         [](const auto& tested) {
                             return "Error" + std::to_string(-tested.param.error) + "_" +
                                    tested.param.method;
                         });

}  // namespace
}  // namespace brume::test
