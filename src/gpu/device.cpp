// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <gpu/instance.hpp>
#include <gpu/object_registry.hpp>
#include <gpu/pipeline_store.hpp>

#include <mutex>

namespace brume::gpu {
namespace {

const char* resultName(VkResult result) {
    switch (result) {
        case VK_NOT_READY:
            return "VK_NOT_READY";
        case VK_TIMEOUT:
            return "VK_TIMEOUT";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "VK_ERROR_MEMORY_MAP_FAILED";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "VK_ERROR_FORMAT_NOT_SUPPORTED";
        case VK_ERROR_SURFACE_LOST_KHR:
            return "VK_ERROR_SURFACE_LOST_KHR";
        case VK_ERROR_NATIVE_WINDOW_IN_USE_KHR:
            return "VK_ERROR_NATIVE_WINDOW_IN_USE_KHR";
        default:
            return "an unexpected Vulkan error";
    }
}

// volk reads vkGetDeviceProcAddr from a global of its own; it is lent for the call only, so that
// devices of several loaders and a host's own volk do not disturb each other.
void loadTable(VolkDeviceTable& table, PFN_vkGetDeviceProcAddr getProcAddr, VkDevice device) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    const PFN_vkGetDeviceProcAddr previous = vkGetDeviceProcAddr;
    vkGetDeviceProcAddr = getProcAddr;
    volkLoadDeviceTable(&table, device);
    vkGetDeviceProcAddr = previous;
}

// A host may have forgotten to enable something: better said now than by a crash.
void requireFunctions(const VolkDeviceTable& table, const std::string& device) {
    const auto require = [&](const void* function, const char* name, const char* enabledBy) {
        if (!function)
            throw inputError("wrapping a device", device,
                             fmt::format("it has no {}; enable {}", name, enabledBy));
    };
    require(reinterpret_cast<const void*>(table.vkCmdPushDescriptorSetKHR),
            "vkCmdPushDescriptorSetKHR", "the extension VK_KHR_push_descriptor");
    require(reinterpret_cast<const void*>(table.vkCmdPipelineBarrier2), "vkCmdPipelineBarrier2",
            "Vulkan 1.3 with the feature synchronization2");
    require(reinterpret_cast<const void*>(table.vkCmdBeginRendering), "vkCmdBeginRendering",
            "Vulkan 1.3 with the feature dynamicRendering");
    require(reinterpret_cast<const void*>(table.vkGetBufferDeviceAddress),
            "vkGetBufferDeviceAddress", "the feature bufferDeviceAddress");
}

VkDevice makeDevice(const InstanceFunctions& functions, const Candidate& chosen, bool canPresent) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = chosen.queueFamily;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    std::vector<const char*> extensions = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
    if (chosen.hasAtomicFloat) extensions.push_back(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    if (canPresent) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    FeatureChain chain(chosen.hasAtomicFloat);
    enableFeatures(chain, chosen.features);
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &chain.base;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    const VkResult result = functions.createDevice(chosen.physicalDevice, &info, nullptr, &device);
    if (result != VK_SUCCESS)
        throw failure("creating device", chosen.info.name, resultName(result));
    return device;
}

}  // namespace

struct Device::Debug {
    Log log;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    mutable std::mutex mutex;  // drivers and layers may call from any thread
    std::vector<std::string> messages;

    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* self) {
        auto& debug = *static_cast<Debug*>(self);
        const std::lock_guard lock(debug.mutex);
        debug.messages.emplace_back(data->pMessage);
        debug.log.write(severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT
                            ? LogLevel::Error
                            : LogLevel::Warning,
                        fmt::format("validation: {}", data->pMessage));
        return VK_FALSE;
    }
};

Device::Device() = default;

std::unique_ptr<Device> Device::create(const DeviceOptions& options, const Log& log) {
    std::unique_ptr<Device> device(new Device);
    device->mLog = log;
    device->mIsOwner = true;
    device->createInstance(options);
    device->createDevice(options);
    device->initialize(options.pipelineCacheFile);
    if (options.keepPipelines) device->mPipelineStore = std::make_unique<PipelineStore>();
    device->vk().vkGetDeviceQueue(device->mDevice, device->mQueueFamily, 0, &device->mQueue);
    log.debug(fmt::format("device: {} ({}), {}", device->mInfo.name, device->mInfo.type,
                          device->mInfo.driver));
    return device;
}

std::unique_ptr<Device> Device::wrap(const HostDevice& host, const Log& log) {
    std::unique_ptr<Device> device(new Device);
    device->mLog = log;
    device->mInstance = host.instance;
    device->mPhysicalDevice = host.physicalDevice;
    device->mDevice = host.device;
    device->mQueueFamily = host.queueFamily;
    device->mFeatures = host.features;
    device->mPipelineCache = host.pipelineCache;
    device->mIsCacheLent = host.pipelineCache != VK_NULL_HANDLE;
    if (host.allocator) device->mAllocator = *host.allocator;
    device->mMemoryHooks = host.memory;
    device->mBudgetBytes = host.memoryBudgetBytes;
    device->mFunctions = std::make_unique<InstanceFunctions>(
        InstanceFunctions::load(host.getInstanceProcAddr, host.instance, host.debugUtils));
    device->mInfo = describeDevice(*device->mFunctions, host.physicalDevice);
    device->initialize(host.pipelineCacheFile);
    return device;
}

void Device::createInstance(const DeviceOptions& options) {
    const PFN_vkGetInstanceProcAddr loader = systemLoader();
    bool hasDebugUtils = false;
    mInstance = makeInstance(loader, options, hasDebugUtils);
    mFunctions = std::make_unique<InstanceFunctions>(
        InstanceFunctions::load(loader, mInstance, hasDebugUtils));
    if (options.validate && hasDebugUtils) createMessenger();
}

void Device::createMessenger() {
    mDebug = std::make_unique<Debug>();
    mDebug->log = mLog;
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = &Debug::receive;
    info.pUserData = mDebug.get();
    check(mFunctions->createMessenger(mInstance, &info, nullptr, &mDebug->messenger),
          "creating device", "debug messenger");
}

void Device::createDevice(const DeviceOptions& options) {
    const std::vector<Candidate> candidates = findCandidates(*mFunctions, mInstance);
    const Candidate& chosen = chooseCandidate(candidates, options.device);
    mPhysicalDevice = chosen.physicalDevice;
    mQueueFamily = chosen.queueFamily;
    mInfo = chosen.info;
    mFeatures = chosen.features;
    mDevice = makeDevice(*mFunctions, chosen, !options.windowExtensions.empty());
}

void Device::initialize(const std::filesystem::path& cacheFile) {
    mTable = std::make_unique<VolkDeviceTable>();
    loadTable(*mTable, mFunctions->getDeviceProcAddr, mDevice);
    requireFunctions(*mTable, mInfo.name);
    mRegistry = std::make_shared<ObjectRegistry>(*this);
    readLimits();
    mPipelineCacheFile = cacheFile;
    loadPipelineCache();
}

Device::~Device() {
    if (mRegistry) {
        if (mIsOwner) mTable->vkDeviceWaitIdle(mDevice);
        try {
            savePipelineCache();
        } catch (const std::exception& e) {
            mLog.warning(e.what());
        }
        mPipelineStore.reset();
        for (const std::string& name : mRegistry->close())
            mLog.warning(fmt::format("destroying device: {} still lives", name));
        if (!mIsCacheLent) mTable->vkDestroyPipelineCache(mDevice, mPipelineCache, allocator());
    }
    if (!mIsOwner) return;
    if (mDevice && mTable) mTable->vkDestroyDevice(mDevice, nullptr);
    if (mDebug && mDebug->messenger)
        mFunctions->destroyMessenger(mInstance, mDebug->messenger, nullptr);
    if (mInstance && mFunctions) mFunctions->destroyInstance(mInstance, nullptr);
}

std::uint64_t Device::beginFrame() { return mRegistry->beginFrame(); }
void Device::retireFrame(std::uint64_t serial) { mRegistry->retireFrame(serial); }
bool Device::isFrameOpen() const { return mRegistry->isFrameOpen(); }
std::vector<ObjectInfo> Device::objects() const { return mRegistry->objects(); }
std::uint64_t Device::allocatedBytes() const { return mRegistry->allocatedBytes(); }

std::vector<std::string> Device::validationMessages() const {
    if (!mDebug) return {};
    const std::lock_guard lock(mDebug->mutex);
    return mDebug->messages;
}

void Device::clearValidationMessages() {
    if (!mDebug) return;
    const std::lock_guard lock(mDebug->mutex);
    mDebug->messages.clear();
}

void Device::check(VkResult result, const char* doing, const std::string& object) const {
    if (result == VK_SUCCESS) return;
    throw VulkanError(
        failure(doing, object,
                fmt::format("{} ({}) from {}", resultName(result), static_cast<int>(result),
                            mInfo.name.empty() ? "the Vulkan loader" : mInfo.name)),
        result);
}

void Device::replaceShader(const std::uint32_t* original, std::vector<std::uint32_t> words) {
    if (words.empty())
        mReplacedShaders.erase(original);
    else
        mReplacedShaders[original] = std::move(words);
}

std::span<const std::uint32_t> Device::currentShader(std::span<const std::uint32_t> spirv) const {
    const auto found = mReplacedShaders.find(spirv.data());
    return found == mReplacedShaders.end() ? spirv : std::span<const std::uint32_t>(found->second);
}

void Device::setName(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!mFunctions->setObjectName) return;
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    check(mFunctions->setObjectName(mDevice, &info), "naming object", name);
}

void Device::beginLabel(VkCommandBuffer commands, const char* name) const {
    if (!mFunctions->beginLabel) return;
    VkDebugUtilsLabelEXT label{};
    label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    label.pLabelName = name;
    mFunctions->beginLabel(commands, &label);
}

void Device::endLabel(VkCommandBuffer commands) const {
    if (mFunctions->endLabel) mFunctions->endLabel(commands);
}

}  // namespace brume::gpu
