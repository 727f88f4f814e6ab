// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <gpu/submitter.hpp>

namespace brume::gpu {
namespace {

// Retires a frame however its scope is left.
class FrameScope {
  public:
    explicit FrameScope(Device& device) : mDevice(&device), mSerial(device.beginFrame()) {}
    ~FrameScope() { mDevice->retireFrame(mSerial); }
    FrameScope(const FrameScope&) = delete;
    FrameScope& operator=(const FrameScope&) = delete;

  private:
    Device* mDevice;
    std::uint64_t mSerial;
};

}  // namespace

Submitter::Submitter(Device& device, VkQueue queue)
    : mDevice(&device), mQueue(queue ? queue : device.queue()) {
    if (!mQueue) throw AssertionError("Submitter: a host's device needs the host's queue");
    const VolkDeviceTable& vk = device.vk();
    mOwner = ObjectOwner(device, "submitter", "submitter");
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = device.queueFamily();
    constexpr const char* kDoing = "creating submitter";
    device.check(vk.vkCreateCommandPool(device.handle(), &pool, device.allocator(), &mPool), kDoing, "pool");
    mOwner.add(owned(VK_OBJECT_TYPE_COMMAND_POOL, mPool));
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = mPool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    device.check(vk.vkAllocateCommandBuffers(device.handle(), &allocate, &mCommands), kDoing,
                 "commands");
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    device.check(vk.vkCreateFence(device.handle(), &fence, device.allocator(), &mFence), kDoing, "fence");
    mOwner.add(owned(VK_OBJECT_TYPE_FENCE, mFence));
}

Submitter::~Submitter() = default;

void Submitter::submitAndWait(const std::string& name,
                              const std::function<void(Commands&)>& record) {
    const VolkDeviceTable& vk = mDevice->vk();
    const FrameScope frame(*mDevice);
    mDevice->check(vk.vkResetCommandBuffer(mCommands, 0), "recording", name);
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    mDevice->check(vk.vkBeginCommandBuffer(mCommands, &begin), "recording", name);
    Commands commands(*mDevice, mCommands);
    commands.beginLabel(name);
    record(commands);
    commands.endLabel();
    mDevice->check(vk.vkEndCommandBuffer(mCommands), "recording", name);
    VkCommandBufferSubmitInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    buffer.commandBuffer = mCommands;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &buffer;
    mDevice->check(vk.vkQueueSubmit2(mQueue, 1, &submit, mFence), "submitting", name);
    mDevice->check(vk.vkWaitForFences(mDevice->handle(), 1, &mFence, VK_TRUE, UINT64_MAX),
                   "waiting for", name);
    mDevice->check(vk.vkResetFences(mDevice->handle(), 1, &mFence), "waiting for", name);
}

void Submitter::read(const Buffer& source, void* target, std::uint64_t bytes,
                     std::uint64_t offset) {
    if (bytes == 0) return;
    if (offset + bytes > source.bytes())
        throw AssertionError(fmt::format("reading buffer '{}': {} bytes at {} of {}", source.name(),
                                         bytes, offset, source.bytes()));
    const Buffer staging(
        *mDevice,
        {.name = "read " + source.name(), .bytes = bytes, .memory = MemoryKind::Readback});
    submitAndWait(staging.name(), [&](Commands& commands) {
        commands.fullBarrier();
        commands.copyBuffer(source, staging, bytes, offset);
        commands.fullBarrier();
    });
    std::memcpy(target, staging.mapped(), bytes);
}

std::vector<std::byte> Submitter::read(const Image& source) {
    const VkExtent3D extent = source.extent3d();
    std::vector<std::byte> texels(static_cast<std::size_t>(extent.width) * extent.height *
                                  extent.depth * source.range().layerCount *
                                  texelBytes(source.format()));
    const VkImageLayout layout = source.layout();
    if (texels.empty() || layout == VK_IMAGE_LAYOUT_UNDEFINED)
        throw AssertionError(fmt::format("reading image '{}': nothing to read", source.name()));
    const Buffer staging(
        *mDevice,
        {.name = "read " + source.name(), .bytes = texels.size(), .memory = MemoryKind::Readback});
    submitAndWait(staging.name(), [&](Commands& commands) {
        commands.transition(source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        commands.copyImageToBuffer(source, staging);
        commands.transition(source, layout);
        commands.fullBarrier();
    });
    std::memcpy(texels.data(), staging.mapped(), texels.size());
    return texels;
}

}  // namespace brume::gpu
