// SPDX-License-Identifier: Apache-2.0
#include "renderer.hpp"

#include <spv/host_minimal/cube.frag.hpp>
#include <spv/host_minimal/cube.vert.hpp>

#include <cmath>
#include <cstring>

namespace host_minimal {
namespace {

void check(VkResult result, const char* doing) {
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string(doing) + ": VkResult " + std::to_string(result));
}

VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data,
                                       void* messages) {
    static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
    return VK_FALSE;
}

struct Push {
    float clipFromWorld[16];
    float angle;
};

}  // namespace

void barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, VkImageLayout from,
             VkImageLayout to) {
    VkImageMemoryBarrier2 info{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    info.srcStageMask = info.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    info.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    info.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    info.oldLayout = from;
    info.newLayout = to;
    info.srcQueueFamilyIndex = info.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    info.image = image;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &info;
    vkCmdPipelineBarrier2(commands, &dependency);
}

Renderer::Renderer(std::uint32_t width_, std::uint32_t height_, bool validate,
                   const std::vector<const char*>& windowExtensions)
    : width(width_), height(height_) {
    createInstance(validate, windowExtensions);
    createDevice(!windowExtensions.empty());
    color = createImage(VK_FORMAT_R8G8B8A8_SRGB,
                        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                            VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                        VK_IMAGE_ASPECT_COLOR_BIT);
    depth = createImage(VK_FORMAT_D32_SFLOAT,
                        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                        VK_IMAGE_ASPECT_DEPTH_BIT);
    createFrames();
    createPipeline();
    setCamera();
}

Renderer::~Renderer() {
    vkDeviceWaitIdle(device);
    vkDestroyPipeline(device, mPipeline, nullptr);
    vkDestroyPipelineLayout(device, mLayout, nullptr);
    for (Frame& frame : mFrames) vkDestroyFence(device, frame.fence, nullptr);
    vkDestroyCommandPool(device, mPool, nullptr);
    for (const Image* image : {&color, &depth}) {
        vkDestroyImageView(device, image->view, nullptr);
        vkDestroyImage(device, image->image, nullptr);
        vkFreeMemory(device, image->memory, nullptr);
    }
    vkDestroyDevice(device, nullptr);
    if (mMessenger)
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
            instance, "vkDestroyDebugUtilsMessengerEXT"))(instance, mMessenger, nullptr);
    vkDestroyInstance(instance, nullptr);
}

void Renderer::createInstance(bool validate, std::vector<const char*> extensions) {
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    const VkValidationFeatureEnableEXT enabled =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &enabled;
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    if (validate) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    if (validate) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
    }
    check(vkCreateInstance(&info, nullptr, &instance), "creating instance");
    if (!validate) return;
    VkDebugUtilsMessengerCreateInfoEXT messenger{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = receive;
    messenger.pUserData = &mMessages;
    check(reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
              vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"))(
              instance, &messenger, nullptr, &mMessenger),
          "creating messenger");
}

// The first device; with the features that Brume asks for (docs/host.md).
void Renderer::createDevice(bool hasWindow) {
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(instance, &count, &physicalDevice);
    if (count == 0) throw std::runtime_error("there is no Vulkan device");
    VkPhysicalDeviceFeatures available{};
    vkGetPhysicalDeviceFeatures(physicalDevice, &available);
    hasFloat64 = available.shaderFloat64;
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    v13.dynamicRendering = v13.synchronization2 = v13.maintenance4 = VK_TRUE;
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    v12.pNext = &v13;
    v12.bufferDeviceAddress = v12.scalarBlockLayout = v12.timelineSemaphore = VK_TRUE;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    features.pNext = &v12;
    features.features.shaderInt64 = features.features.independentBlend = VK_TRUE;
    features.features.fragmentStoresAndAtomics = VK_TRUE;
    features.features.shaderStorageImageExtendedFormats = VK_TRUE;
    features.features.shaderFloat64 = available.shaderFloat64;
    const float priority = 1;
    VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queues.queueCount = 1;
    queues.pQueuePriorities = &priority;
    const char* const extensions[] = {VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME,
                                      VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queues;
    info.enabledExtensionCount = hasWindow ? 2 : 1;
    info.ppEnabledExtensionNames = extensions;
    check(vkCreateDevice(physicalDevice, &info, nullptr, &device), "creating device");
    vkGetDeviceQueue(device, queueFamily, 0, &queue);
}

std::uint32_t Renderer::findMemory(std::uint32_t types, VkMemoryPropertyFlags flags) const {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physicalDevice, &memory);
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((types >> i & 1) && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
    throw std::runtime_error("there is no fitting memory");
}

Image Renderer::createImage(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    Image result;
    result.format = format;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {width, height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    check(vkCreateImage(device, &info, nullptr, &result.image), "creating image");
    VkMemoryRequirements needed{};
    vkGetImageMemoryRequirements(device, result.image, &needed);
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocate.allocationSize = needed.size;
    allocate.memoryTypeIndex = findMemory(needed.memoryTypeBits, 0);
    check(vkAllocateMemory(device, &allocate, nullptr, &result.memory), "allocating image");
    check(vkBindImageMemory(device, result.image, result.memory, 0), "binding image");
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = result.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {aspect, 0, 1, 0, 1};
    check(vkCreateImageView(device, &view, nullptr, &result.view), "creating view");
    return result;
}

void Renderer::createFrames() {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = queueFamily;
    check(vkCreateCommandPool(device, &pool, nullptr, &mPool), "creating pool");
    for (Frame& frame : mFrames) {
        VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        allocate.commandPool = mPool;
        allocate.commandBufferCount = 1;
        check(vkAllocateCommandBuffers(device, &allocate, &frame.commands), "creating commands");
        VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        check(vkCreateFence(device, &fence, nullptr, &frame.fence), "creating fence");
    }
}

void Renderer::createPipeline() {
    const VkPushConstantRange range{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push)};
    VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device, &layout, nullptr, &mLayout), "creating layout");
    VkPipelineShaderStageCreateInfo stages[2] = {};
    const auto addStage = [&](int i, VkShaderStageFlagBits stage, const std::uint32_t* code,
                              std::size_t bytes) {
        VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        info.codeSize = bytes;
        info.pCode = code;
        stages[i] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
        stages[i].stage = stage;
        stages[i].pName = "main";
        check(vkCreateShaderModule(device, &info, nullptr, &stages[i].module), "creating shader");
    };
    namespace spv = brume::spv;  // where the build puts compiled shaders
    addStage(0, VK_SHADER_STAGE_VERTEX_BIT, spv::host_minimal_cube_vert,
             sizeof(spv::host_minimal_cube_vert));
    addStage(1, VK_SHADER_STAGE_FRAGMENT_BIT, spv::host_minimal_cube_frag,
             sizeof(spv::host_minimal_cube_frag));
    VkPipelineVertexInputStateCreateInfo vertex{
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depthState{
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depthState.depthTestEnable = depthState.depthWriteEnable = VK_TRUE;
    depthState.depthCompareOp = VK_COMPARE_OP_GREATER;
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = 0xf;
    VkPipelineColorBlendStateCreateInfo blend{
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = 1;
    blend.pAttachments = &attachment;
    const VkDynamicState dynamics[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamics;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &color.format;
    rendering.depthAttachmentFormat = depth.format;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = &rendering;
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &vertex;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depthState;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = mLayout;
    check(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &mPipeline),
          "creating pipeline");
    for (const auto& stage : stages) vkDestroyShaderModule(device, stage.module, nullptr);
}

// From a little above, looking slightly down: a rotation about x, then away from the cube.
void Renderer::setCamera() {
    const double pitch = 0.22, distance = 4.2, focal = 1.9, near = 0.05;
    const double c = std::cos(pitch), s = std::sin(pitch), eye = 0.95;
    const double view[16] = {1, 0, 0, 0, 0, c, s, 0, 0, -s, c, 0, 0, -c * eye, -s * eye - distance,
                             1};
    // Reversed and infinite: depth = near / distance. Vulkan's clip space has y downwards.
    const double clip[16] = {
        focal * height / width, 0, 0, 0, 0, -focal, 0, 0, 0, 0, 0, -1, 0, 0, near, 0};
    std::memcpy(viewFromWorld, view, sizeof(view));
    std::memcpy(clipFromView, clip, sizeof(clip));
}

VkCommandBuffer Renderer::beginFrame() {
    Frame& frame = mFrames[mFrame % kFramesInFlight];
    check(vkWaitForFences(device, 1, &frame.fence, VK_TRUE, UINT64_MAX), "waiting");
    check(vkResetFences(device, 1, &frame.fence), "resetting fence");
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(frame.commands, &begin), "beginning commands");
    return frame.commands;
}

void Renderer::drawOpaque(VkCommandBuffer commands, double seconds) {
    barrier(commands, color.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    barrier(commands, depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    VkRenderingAttachmentInfo colors{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colors.imageView = color.view;
    colors.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colors.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colors.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    colors.clearValue.color = {{0.05f, 0.06f, 0.09f, 1}};
    VkRenderingAttachmentInfo depths = colors;
    depths.imageView = depth.view;
    depths.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depths.clearValue.depthStencil = {0, 0};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = {width, height};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colors;
    info.pDepthAttachment = &depths;
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &info.renderArea);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, mPipeline);
    Push push{};
    for (int i = 0; i < 16; ++i)
        for (int k = 0; k < 4; ++k)
            push.clipFromWorld[i] +=
                static_cast<float>(clipFromView[4 * k + i % 4] * viewFromWorld[i / 4 * 4 + k]);
    push.angle = static_cast<float>(seconds);
    vkCmdPushConstants(commands, mLayout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(push), &push);
    vkCmdDraw(commands, 42, 1, 0, 0);
    vkCmdEndRendering(commands);
}

void Renderer::endFrame(VkSemaphore wait, VkSemaphore signal) {
    Frame& frame = mFrames[mFrame++ % kFramesInFlight];
    check(vkEndCommandBuffer(frame.commands), "ending commands");
    VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commands.commandBuffer = frame.commands;
    VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &commands;
    VkSemaphoreSubmitInfo semaphores[2] = {{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO},
                                           {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO}};
    semaphores[0].semaphore = wait;
    semaphores[1].semaphore = signal;
    semaphores[0].stageMask = semaphores[1].stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    submit.waitSemaphoreInfoCount = wait ? 1 : 0;
    submit.pWaitSemaphoreInfos = &semaphores[0];
    submit.signalSemaphoreInfoCount = signal ? 1 : 0;
    submit.pSignalSemaphoreInfos = &semaphores[1];
    check(vkQueueSubmit2(queue, 1, &submit, frame.fence), "submitting");
}

}  // namespace host_minimal
