// SPDX-License-Identifier: Apache-2.0
// Brume on a device that a host has made with its own means.
#include <volk.h>
// volk.h goes first.
#include <dlfcn.h>
#include <gpu/buffer.hpp>
#include <gpu/gpu_fixture.hpp>
#include <gpu/image.hpp>

namespace brume::test {
namespace {

// A minimal host: instance, device and queue without anything of Brume's.
class Host {
  public:
    Host() {
        mLibrary = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
        getInstanceProcAddr =
            reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(mLibrary, "vkGetInstanceProcAddr"));
        VkApplicationInfo application{};
        application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        application.apiVersion = VK_API_VERSION_1_3;
        VkInstanceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        info.pApplicationInfo = &application;
        get<PFN_vkCreateInstance>("vkCreateInstance")(&info, nullptr, &instance);
        std::uint32_t count = 1;
        get<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance, &count,
                                                                          &physicalDevice);
        createDevice();
    }
    ~Host() {
        get<PFN_vkDestroyDevice>("vkDestroyDevice")(device, nullptr);
        get<PFN_vkDestroyInstance>("vkDestroyInstance")(instance, nullptr);
        dlclose(mLibrary);
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    gpu::HostDevice lend() const {
        gpu::HostDevice host;
        host.instance = instance;
        host.physicalDevice = physicalDevice;
        host.device = device;
        host.getInstanceProcAddr = getInstanceProcAddr;
        return host;
    }

    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;

  private:
    template <typename Function>
    Function get(const char* name) {
        return reinterpret_cast<Function>(getInstanceProcAddr(instance, name));
    }

    void createDevice() {
        VkPhysicalDeviceVulkan13Features v13{};
        v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
        v13.dynamicRendering = v13.synchronization2 = v13.maintenance4 = VK_TRUE;
        VkPhysicalDeviceVulkan12Features v12{};
        v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
        v12.pNext = &v13;
        v12.bufferDeviceAddress = v12.scalarBlockLayout = v12.timelineSemaphore = VK_TRUE;
        VkPhysicalDeviceFeatures2 features{};
        features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        features.pNext = &v12;
        features.features.shaderInt64 = VK_TRUE;
        const float priority = 1;
        VkDeviceQueueCreateInfo queues{};
        queues.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queues.queueCount = 1;
        queues.pQueuePriorities = &priority;
        const char* const extension = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
        VkDeviceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.pNext = &features;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queues;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
        get<PFN_vkCreateDevice>("vkCreateDevice")(physicalDevice, &info, nullptr, &device);
        get<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device, 0, 0, &queue);
    }

    void* mLibrary = nullptr;
};

TEST(HostTest, Wrap_HostsDevice_RecordsAndLeavesItAlive) {
    Host host;
    for (int round = 0; round < 2; ++round) {
        const auto device = gpu::Device::wrap(host.lend(), {});
        EXPECT_EQ(device->queue(), nullptr);
        EXPECT_EQ(device->handle(), host.device);
        gpu::Submitter submitter(*device, host.queue);
        const gpu::Buffer buffer(*device, {.name = "buffer", .bytes = 64});
        submitter.submitAndWait("fill",
                                [&](gpu::Commands& commands) { commands.fillBuffer(buffer, 7); });
        EXPECT_EQ(submitter.readBuffer<std::uint32_t>(buffer, 16),
                  std::vector<std::uint32_t>(16, 7));
    }
}

TEST(HostTest, Wrap_BesideAnOwnDevice_BothWork) {
    Host host;
    const auto own = gpu::Device::create({}, {});
    const auto wrapped = gpu::Device::wrap(host.lend(), {});
    const gpu::Buffer a(*own, {.name = "a", .bytes = 64});
    const gpu::Buffer b(*wrapped, {.name = "b", .bytes = 64});
    EXPECT_NE(a.deviceAddress(), 0u);
    EXPECT_NE(b.deviceAddress(), 0u);
    EXPECT_THROW(gpu::Submitter submitter(*wrapped), std::logic_error);
}

}  // namespace
}  // namespace brume::test
