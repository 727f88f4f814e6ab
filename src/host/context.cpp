// SPDX-License-Identifier: Apache-2.0
#include <host/context.hpp>
#include <host/errors.hpp>
#include <host/scene.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::host {
namespace {

constexpr const char* kCreate = "brumeCreateContext";

Log makeLog(const BrumeContextCreateInfo& info) {
    if (!info.log) return {};
    return Log([log = info.log, user = info.logUser](LogLevel level, const std::string& message) {
        log(user, static_cast<BrumeLogLevel>(level), message.c_str());
    });
}

void check(const BrumeContextCreateInfo& info) {
    const auto require = [](bool isGiven, const char* what) {
        if (!isGiven) throw refuse(kCreate, what, "it is null");
    };
    if (info.headerVersion / 1000 != BRUME_HEADER_VERSION / 1000)
        throw refuse(
            kCreate, "headerVersion",
            fmt::format("it is {}, allowed is {}", info.headerVersion, BRUME_HEADER_VERSION));
    require(info.instance, "instance");
    require(info.physicalDevice, "physicalDevice");
    require(info.device, "device");
    require(info.getInstanceProcAddr, "getInstanceProcAddr");
    if (info.framesInFlight > 16)
        throw refuse(kCreate, "framesInFlight",
                     fmt::format("it is {}, allowed are 1 to 16", info.framesInFlight));
    if (!info.allocateMemory != !info.freeMemory)
        throw refuse(kCreate, "allocateMemory", "either both memory hooks are given or none");
}

gpu::OptionalFeatures featuresOf(std::uint32_t bits) {
    gpu::OptionalFeatures features;
    features.shaderFloat64 = bits & BRUME_FEATURE_SHADER_FLOAT64;
    features.shaderInt64Atomics = bits & BRUME_FEATURE_SHADER_INT64_ATOMICS;
    features.shaderFloat32AtomicAdd = bits & BRUME_FEATURE_FLOAT32_ATOMIC_ADD;
    features.geometryShader = bits & BRUME_FEATURE_GEOMETRY_SHADER;
    features.drawParameters = bits & BRUME_FEATURE_DRAW_PARAMETERS;
    features.depthClamp = bits & BRUME_FEATURE_DEPTH_CLAMP;
    return features;
}

gpu::HostDevice hostDeviceOf(const BrumeContextCreateInfo& info) {
    gpu::HostDevice host;
    host.instance = info.instance;
    host.physicalDevice = info.physicalDevice;
    host.device = info.device;
    host.getInstanceProcAddr = info.getInstanceProcAddr;
    host.queueFamily = info.queueFamily;
    host.features = featuresOf(info.features);
    host.debugUtils = info.features & BRUME_FEATURE_DEBUG_UTILS;
    host.pipelineCache = info.pipelineCache;
    host.allocator = info.allocator;
    host.memory = {info.memoryUser, info.allocateMemory, info.freeMemory};
    if (info.memoryBudgetBytes > 0) host.memoryBudgetBytes = info.memoryBudgetBytes;
    return host;
}

}  // namespace

Context::Context(const BrumeContextCreateInfo& info)
    : mLog(makeLog(info)),
      mReaders{info.readImage, info.readVolume, info.readUser},
      mMaxTicks(info.maxTicksPerFrame > 0 ? info.maxTicksPerFrame : 600),
      mShadowPairs(info.shadowPairBudget > 0 ? info.shadowPairBudget : 1u << 18),
      mSerials(info.framesInFlight > 0 ? info.framesInFlight : 2) {
    check(info);
    mDevice = gpu::Device::wrap(hostDeviceOf(info), mLog);
}

Context::~Context() { mScenes.clear(); }

void Context::beginFrame(std::uint64_t frameIndex) {
    if (mFrame > 0 && frameIndex <= mFrameIndex)
        throw refuse(
            "brumeBeginFrame", "frameIndex",
            fmt::format("it is {}, must be above the last one's {}", frameIndex, mFrameIndex));
    // Slots go by the count of frames, so that a host may leave indices out.
    mFrameIndex = frameIndex;
    mSlot = static_cast<std::uint32_t>(mFrame % mSerials.size());
    ++mFrame;
    if (mSerials[mSlot] > 0) mDevice->retireFrame(mSerials[mSlot]);
    mSerials[mSlot] = mDevice->beginFrame();
}

void Context::requireFrame(const char* call) const {
    if (mFrame == 0) throw refuse(call, "", "no frame has begun, call brumeBeginFrame() first");
}

void Context::forgetFrame() {
    for (const auto& scene : mScenes) scene->forgetFrame();
}

Scene& Context::addScene(std::unique_ptr<Scene> scene) {
    mScenes.push_back(std::move(scene));
    return *mScenes.back();
}

void Context::removeScene(const Scene* scene) {
    std::erase_if(mScenes, [&](const auto& owned) { return owned.get() == scene; });
}

}  // namespace brume::host
