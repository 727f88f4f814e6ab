// SPDX-License-Identifier: Apache-2.0
// The instance functions that the device layer calls, and what it demands of a physical device.
#pragma once

#include <gpu/device.hpp>

#include <string>
#include <vector>

namespace brume::gpu {

/// Loaded per device from the loader or from a host, so that several can live together.
struct InstanceFunctions {
    PFN_vkGetInstanceProcAddr getProcAddr = nullptr;
    PFN_vkDestroyInstance destroyInstance = nullptr;
    PFN_vkEnumeratePhysicalDevices enumeratePhysicalDevices = nullptr;
    PFN_vkEnumerateDeviceExtensionProperties enumerateDeviceExtensions = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 getProperties = nullptr;
    PFN_vkGetPhysicalDeviceFeatures2 getFeatures = nullptr;
    PFN_vkGetPhysicalDeviceMemoryProperties getMemoryProperties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties getQueueFamilies = nullptr;
    PFN_vkGetPhysicalDeviceImageFormatProperties getImageFormat = nullptr;
    PFN_vkGetPhysicalDeviceFormatProperties getFormat = nullptr;
    PFN_vkCreateDevice createDevice = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr;
    // Of VK_EXT_debug_utils; null without it.
    PFN_vkCreateDebugUtilsMessengerEXT createMessenger = nullptr;
    PFN_vkDestroyDebugUtilsMessengerEXT destroyMessenger = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;

    /// `debugUtils`: the instance has enabled VK_EXT_debug_utils.
    static InstanceFunctions load(PFN_vkGetInstanceProcAddr loader, VkInstance instance,
                                  bool debugUtils);
};

/// The system's Vulkan loader. Throws a failure Error if it is not installed.
PFN_vkGetInstanceProcAddr systemLoader();

/// Feature structures linked into one chain, for asking and for enabling.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 base{};
    VkPhysicalDeviceVulkan11Features v11{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceVulkan13Features v13{};
    VkPhysicalDeviceShaderAtomicFloatFeaturesEXT atomicFloat{};

    explicit FeatureChain(bool withAtomicFloat);
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

/// A physical device and whether and how Brume would use it.
struct Candidate {
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    DeviceInfo info;
    int rank = 0;  ///< lower is preferred
    std::uint32_t queueFamily = 0;
    bool hasAtomicFloat = false;  ///< VK_EXT_shader_atomic_float
    OptionalFeatures features;
};

std::vector<Candidate> findCandidates(const InstanceFunctions& functions, VkInstance instance);

/// Name, type, driver and version of a device.
DeviceInfo describeDevice(const InstanceFunctions& functions, VkPhysicalDevice device);

/// Sets everything required and, of the optional, what `features` names.
void enableFeatures(FeatureChain& chain, const OptionalFeatures& features);

/// The instance, with validation if `options` ask for it. `hasDebugUtils` returns whether names
/// and messages are available.
VkInstance makeInstance(PFN_vkGetInstanceProcAddr loader, const DeviceOptions& options,
                        bool& hasDebugUtils);

/// The device that `wanted` names, or the best usable one. Throws as Device::create().
const Candidate& chooseCandidate(const std::vector<Candidate>& candidates,
                                 const std::string& wanted);

}  // namespace brume::gpu
