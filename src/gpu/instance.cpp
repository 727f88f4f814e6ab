// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first: it must see vulkan.h before anyone else.
#include <fmt/format.h>
#include <gpu/instance.hpp>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <mutex>
#include <set>

namespace brume::gpu {
namespace {

constexpr const char* kDoing = "creating device";
constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

template <typename Function>
void loadInto(Function& function, PFN_vkGetInstanceProcAddr loader, VkInstance instance,
              const char* name) {
    function = reinterpret_cast<Function>(loader(instance, name));
}

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::set<std::string> listExtensions(const InstanceFunctions& functions, VkPhysicalDevice device) {
    std::uint32_t count = 0;
    functions.enumerateDeviceExtensions(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    functions.enumerateDeviceExtensions(device, nullptr, &count, properties.data());
    std::set<std::string> names;
    for (const VkExtensionProperties& p : properties) names.insert(p.extensionName);
    return names;
}

struct RequiredFeature {
    const char* name;
    VkBool32* value;
};

// The one list of what Brume demands; used for asking, for enabling and for the reasons.
std::vector<RequiredFeature> requiredFeatures(FeatureChain& c) {
    return {
        {"dynamicRendering", &c.v13.dynamicRendering},
        {"synchronization2", &c.v13.synchronization2},
        {"maintenance4", &c.v13.maintenance4},
        {"shaderDemoteToHelperInvocation", &c.v13.shaderDemoteToHelperInvocation},
        {"shaderTerminateInvocation", &c.v13.shaderTerminateInvocation},
        {"bufferDeviceAddress", &c.v12.bufferDeviceAddress},
        {"scalarBlockLayout", &c.v12.scalarBlockLayout},
        {"timelineSemaphore", &c.v12.timelineSemaphore},
        {"shaderInt64", &c.base.features.shaderInt64},
        {"independentBlend", &c.base.features.independentBlend},
        {"fragmentStoresAndAtomics", &c.base.features.fragmentStoresAndAtomics},
        {"shaderStorageImageExtendedFormats", &c.base.features.shaderStorageImageExtendedFormats}};
}

struct OptionalFeature {
    bool OptionalFeatures::*flag;
    VkBool32* value;
};

std::vector<OptionalFeature> optionalFeatures(FeatureChain& c) {
    using F = OptionalFeatures;
    VkPhysicalDeviceFeatures& base = c.base.features;
    return {{&F::shaderFloat64, &base.shaderFloat64},
            {&F::shaderInt64Atomics, &c.v12.shaderBufferInt64Atomics},
            {&F::shaderFloat32AtomicAdd, &c.atomicFloat.shaderBufferFloat32AtomicAdd},
            {&F::geometryShader, &base.geometryShader},
            {&F::drawParameters, &c.v11.shaderDrawParameters},
            {&F::multiDrawIndirect, &base.multiDrawIndirect},
            {&F::storageImageWriteWithoutFormat, &base.shaderStorageImageWriteWithoutFormat},
            {&F::depthClamp, &base.depthClamp},
            {&F::vertexStores, &base.vertexPipelineStoresAndAtomics},
            {&F::pipelineStatistics, &base.pipelineStatisticsQuery}};
}

void checkFeatures(const InstanceFunctions& functions, Candidate& candidate) {
    FeatureChain chain(candidate.hasAtomicFloat);
    functions.getFeatures(candidate.physicalDevice, &chain.base);
    for (const RequiredFeature& f : requiredFeatures(chain))
        if (!*f.value) candidate.info.rejections.push_back(fmt::format("no feature {}", f.name));
    for (const OptionalFeature& f : optionalFeatures(chain))
        candidate.features.*f.flag = *f.value == VK_TRUE;
}

void chooseQueueFamily(const InstanceFunctions& functions, Candidate& candidate) {
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    std::uint32_t count = 0;
    functions.getQueueFamilies(candidate.physicalDevice, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    functions.getQueueFamilies(candidate.physicalDevice, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & kNeeded) != kNeeded) continue;
        candidate.queueFamily = i;
        return;
    }
    candidate.info.rejections.push_back("no queue family with graphics and compute");
}

int rankOf(const std::string& type) {
    static const char* const kOrder[] = {"discrete", "integrated", "virtual", "cpu"};
    return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), type) - kOrder);
}

Candidate inspect(const InstanceFunctions& functions, VkPhysicalDevice device) {
    Candidate candidate;
    candidate.physicalDevice = device;
    candidate.info = describeDevice(functions, device);
    candidate.rank = rankOf(candidate.info.type);
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    functions.getProperties(device, &properties);
    if (properties.properties.apiVersion < VK_API_VERSION_1_3)
        candidate.info.rejections.push_back(
            fmt::format("Vulkan {}, needs 1.3", candidate.info.api));
    const std::set<std::string> extensions = listExtensions(functions, device);
    if (!extensions.contains(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME))
        candidate.info.rejections.push_back("no extension VK_KHR_push_descriptor");
    candidate.hasAtomicFloat = extensions.contains(VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    checkFeatures(functions, candidate);
    chooseQueueFamily(functions, candidate);
    return candidate;
}

std::string listText(const std::vector<Candidate>& candidates) {
    if (candidates.empty()) return "the Vulkan loader knows no device";
    std::string text = "the devices are:";
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const DeviceInfo& info = candidates[i].info;
        text += fmt::format("{} {} '{}' ({})", i ? ";" : "", i, info.name,
                            info.rejections.empty() ? "usable" : "not usable:");
        if (info.rejections.empty()) continue;
        text.pop_back();
        for (std::size_t r = 0; r < info.rejections.size(); ++r)
            text += (r ? ", " : " ") + info.rejections[r];
        text += ")";
    }
    return text;
}

bool isNamed(const std::vector<Candidate>& candidates, std::size_t index,
             const std::string& wanted) {
    if (std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c); }))
        return std::to_string(index) == wanted;
    return lowerCase(candidates[index].info.name).find(lowerCase(wanted)) != std::string::npos;
}

bool hasValidationLayer(PFN_vkGetInstanceProcAddr loader) {
    PFN_vkEnumerateInstanceLayerProperties enumerate = nullptr;
    loadInto(enumerate, loader, VK_NULL_HANDLE, "vkEnumerateInstanceLayerProperties");
    std::uint32_t count = 0;
    enumerate(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    enumerate(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& l) {
        return std::strcmp(l.layerName, kValidationLayer) == 0;
    });
}

bool hasInstanceExtension(PFN_vkGetInstanceProcAddr loader, const char* layer, const char* name) {
    PFN_vkEnumerateInstanceExtensionProperties enumerate = nullptr;
    loadInto(enumerate, loader, VK_NULL_HANDLE, "vkEnumerateInstanceExtensionProperties");
    std::uint32_t count = 0;
    enumerate(layer, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    enumerate(layer, &count, extensions.data());
    return std::any_of(
        extensions.begin(), extensions.end(),
        [name](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

}  // namespace

InstanceFunctions InstanceFunctions::load(PFN_vkGetInstanceProcAddr loader, VkInstance instance,
                                          bool debugUtils) {
    InstanceFunctions f;
    f.getProcAddr = loader;
    const auto get = [&](auto& function, const char* name) {
        loadInto(function, loader, instance, name);
    };
    get(f.destroyInstance, "vkDestroyInstance");
    get(f.enumeratePhysicalDevices, "vkEnumeratePhysicalDevices");
    get(f.enumerateDeviceExtensions, "vkEnumerateDeviceExtensionProperties");
    get(f.getProperties, "vkGetPhysicalDeviceProperties2");
    get(f.getFeatures, "vkGetPhysicalDeviceFeatures2");
    get(f.getMemoryProperties, "vkGetPhysicalDeviceMemoryProperties");
    get(f.getQueueFamilies, "vkGetPhysicalDeviceQueueFamilyProperties");
    get(f.getImageFormat, "vkGetPhysicalDeviceImageFormatProperties");
    get(f.getFormat, "vkGetPhysicalDeviceFormatProperties");
    get(f.createDevice, "vkCreateDevice");
    get(f.getDeviceProcAddr, "vkGetDeviceProcAddr");
    if (!debugUtils) return f;
    get(f.createMessenger, "vkCreateDebugUtilsMessengerEXT");
    get(f.destroyMessenger, "vkDestroyDebugUtilsMessengerEXT");
    get(f.setObjectName, "vkSetDebugUtilsObjectNameEXT");
    get(f.beginLabel, "vkCmdBeginDebugUtilsLabelEXT");
    get(f.endLabel, "vkCmdEndDebugUtilsLabelEXT");
    return f;
}

PFN_vkGetInstanceProcAddr systemLoader() {
    // The library is loaded once per process; a host that uses volk may have done so already.
    static std::once_flag once;
    std::call_once(once, [] {
        if (!vkGetInstanceProcAddr && volkInitialize() != VK_SUCCESS)
            vkGetInstanceProcAddr = nullptr;
    });
    if (!vkGetInstanceProcAddr)
        throw failure(kDoing, "", "there is no Vulkan loader (libvulkan.so.1) on this machine");
    return vkGetInstanceProcAddr;
}

FeatureChain::FeatureChain(bool withAtomicFloat) {
    base.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    atomicFloat.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_FLOAT_FEATURES_EXT;
    base.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
    v13.pNext = withAtomicFloat ? &atomicFloat : nullptr;
}

void enableFeatures(FeatureChain& chain, const OptionalFeatures& features) {
    for (const RequiredFeature& f : requiredFeatures(chain)) *f.value = VK_TRUE;
    for (const OptionalFeature& f : optionalFeatures(chain))
        *f.value = features.*f.flag ? VK_TRUE : VK_FALSE;
}

DeviceInfo describeDevice(const InstanceFunctions& functions, VkPhysicalDevice device) {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    functions.getProperties(device, &properties);
    const VkPhysicalDeviceProperties& p = properties.properties;
    DeviceInfo info;
    info.name = p.deviceName;
    info.driver = fmt::format("{} {}", driver.driverName, driver.driverInfo);
    info.api = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(p.apiVersion),
                           VK_API_VERSION_MINOR(p.apiVersion), VK_API_VERSION_PATCH(p.apiVersion));
    switch (p.deviceType) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            info.type = "discrete";
            break;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            info.type = "integrated";
            break;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            info.type = "virtual";
            break;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            info.type = "cpu";
            break;
        default:
            info.type = "other";
    }
    return info;
}

std::vector<Candidate> findCandidates(const InstanceFunctions& functions, VkInstance instance) {
    std::uint32_t count = 0;
    functions.enumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    functions.enumeratePhysicalDevices(instance, &count, devices.data());
    devices.resize(count);
    std::vector<Candidate> candidates;
    for (VkPhysicalDevice device : devices) candidates.push_back(inspect(functions, device));
    return candidates;
}

const Candidate& chooseCandidate(const std::vector<Candidate>& candidates,
                                 const std::string& wanted) {
    const Candidate* best = nullptr;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        if (!candidate.info.rejections.empty()) continue;
        if (!wanted.empty() && !isNamed(candidates, i, wanted)) continue;
        if (!best || candidate.rank < best->rank) best = &candidate;
    }
    if (best) return *best;
    if (!wanted.empty())
        throw inputError(kDoing, wanted,
                         "no usable device has this name or index; " + listText(candidates));
    throw failure(kDoing, "", "no device is usable; " + listText(candidates));
}

VkInstance makeInstance(PFN_vkGetInstanceProcAddr loader, const DeviceOptions& options,
                        bool& hasDebugUtils) {
    if (options.validate && !hasValidationLayer(loader))
        throw failure(kDoing, "validation", "the layer VK_LAYER_KHRONOS_validation is missing");
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "brume";
    application.pEngineName = "brume";
    application.apiVersion = VK_API_VERSION_1_3;
    const VkValidationFeatureEnableEXT enabled =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT validation{};
    validation.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    validation.enabledValidationFeatureCount = options.synchronizationValidation ? 1 : 0;
    validation.pEnabledValidationFeatures = &enabled;
    hasDebugUtils = hasInstanceExtension(loader, nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                    (options.validate && hasInstanceExtension(loader, kValidationLayer,
                                                              VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
    std::vector<const char*> extensions;
    if (hasDebugUtils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    for (const std::string& name : options.windowExtensions) {
        if (!hasInstanceExtension(loader, nullptr, name.c_str()))
            throw failure(kDoing, "instance",
                          fmt::format("the Vulkan loader has no extension {} for windows", name));
        extensions.push_back(name.c_str());
    }
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = options.validate ? &validation : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = options.validate ? 1 : 0;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    PFN_vkCreateInstance create = nullptr;
    loadInto(create, loader, VK_NULL_HANDLE, "vkCreateInstance");
    VkInstance instance = VK_NULL_HANDLE;
    if (const VkResult result = create(&info, nullptr, &instance); result != VK_SUCCESS)
        throw failure(kDoing, "instance",
                      fmt::format("the Vulkan loader answers error {}", static_cast<int>(result)));
    return instance;
}

std::vector<DeviceInfo> listDevices() {
    bool hasDebugUtils = false;
    const PFN_vkGetInstanceProcAddr loader = systemLoader();
    VkInstance instance = makeInstance(loader, {}, hasDebugUtils);
    const InstanceFunctions functions = InstanceFunctions::load(loader, instance, hasDebugUtils);
    std::vector<DeviceInfo> infos;
    for (Candidate& candidate : findCandidates(functions, instance))
        infos.push_back(std::move(candidate.info));
    functions.destroyInstance(instance, nullptr);
    return infos;
}

}  // namespace brume::gpu
