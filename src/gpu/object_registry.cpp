// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <gpu/object_registry.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace brume::gpu {
namespace {

// Vulkan handles are pointers on 64-bit targets and integers on others: only a C cast fits both.
template <typename Handle>
Handle as(const OwnedHandle& owned) {
    return (Handle)owned.handle;
}

void destroyHandle(const Device& owner, const OwnedHandle& h) {
    const VkDevice device = owner.handle();
    const VolkDeviceTable& vk = owner.vk();
    const VkAllocationCallbacks* const allocator = owner.allocator();
    switch (h.type) {
        case VK_OBJECT_TYPE_BUFFER:
            vk.vkDestroyBuffer(device, as<VkBuffer>(h), allocator);
            break;
        case VK_OBJECT_TYPE_IMAGE:
            vk.vkDestroyImage(device, as<VkImage>(h), allocator);
            break;
        case VK_OBJECT_TYPE_IMAGE_VIEW:
            vk.vkDestroyImageView(device, as<VkImageView>(h), allocator);
            break;
        case VK_OBJECT_TYPE_SAMPLER:
            vk.vkDestroySampler(device, as<VkSampler>(h), allocator);
            break;
        case VK_OBJECT_TYPE_DEVICE_MEMORY:
            if (owner.memoryHooks().free)
                owner.memoryHooks().free(owner.memoryHooks().user, as<VkDeviceMemory>(h));
            else
                vk.vkFreeMemory(device, as<VkDeviceMemory>(h), allocator);
            break;
        case VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT:
            vk.vkDestroyDescriptorSetLayout(device, as<VkDescriptorSetLayout>(h), allocator);
            break;
        case VK_OBJECT_TYPE_PIPELINE_LAYOUT:
            vk.vkDestroyPipelineLayout(device, as<VkPipelineLayout>(h), allocator);
            break;
        case VK_OBJECT_TYPE_PIPELINE:
            vk.vkDestroyPipeline(device, as<VkPipeline>(h), allocator);
            break;
        case VK_OBJECT_TYPE_QUERY_POOL:
            vk.vkDestroyQueryPool(device, as<VkQueryPool>(h), allocator);
            break;
        case VK_OBJECT_TYPE_COMMAND_POOL:
            vk.vkDestroyCommandPool(device, as<VkCommandPool>(h), allocator);
            break;
        case VK_OBJECT_TYPE_FENCE:
            vk.vkDestroyFence(device, as<VkFence>(h), allocator);
            break;
        default:
            break;
    }
}

}  // namespace

std::uint64_t ObjectRegistry::add(const std::string& kind, const std::string& name) {
    Entry entry;
    entry.info.kind = kind;
    entry.info.name = name;
    mLiving.emplace(mNextId, std::move(entry));
    return mNextId++;
}

void ObjectRegistry::addHandle(std::uint64_t id, OwnedHandle handle) {
    mLiving.at(id).handles.push_back(handle);
}

void ObjectRegistry::addMemory(std::uint64_t id, const Allocation& allocation, MemoryKind kind) {
    Entry& entry = mLiving.at(id);
    // At the front: handles go in reverse order, so that memory goes last.
    entry.handles.insert(entry.handles.begin(),
                         owned(VK_OBJECT_TYPE_DEVICE_MEMORY, allocation.memory));
    entry.info.bytes = allocation.bytes;
    entry.info.heap = allocation.heap;
    entry.info.memory = kind;
    mHeapBytes[allocation.heap] += allocation.bytes;
    ++mAllocations;
}

void ObjectRegistry::destroy(const Entry& entry) {
    for (auto h = entry.handles.rbegin(); h != entry.handles.rend(); ++h)
        destroyHandle(*mDevice, *h);
    if (entry.info.bytes == 0) return;
    mHeapBytes[entry.info.heap] -= entry.info.bytes;
    --mAllocations;
}

void ObjectRegistry::retain(std::uint64_t id) { ++mLiving.at(id).ownerCount; }

void ObjectRegistry::release(std::uint64_t id) {
    if (mIsClosed) return;
    const auto found = mLiving.find(id);
    if (found == mLiving.end() || --found->second.ownerCount > 0) return;
    auto node = mLiving.extract(found);
    if (!isFrameOpen()) return destroy(node.mapped());
    node.mapped().serial = mBegun;
    mDying.push_back(std::move(node.mapped()));
}

void ObjectRegistry::retireFrame(std::uint64_t serial) {
    mRetired = std::max(mRetired, serial);
    std::erase_if(mDying, [this](const Entry& entry) {
        if (entry.serial > mRetired) return false;
        destroy(entry);
        return true;
    });
}

std::vector<ObjectInfo> ObjectRegistry::objects() const {
    std::vector<ObjectInfo> infos;
    for (const auto& [id, entry] : mLiving)
        if (entry.info.bytes > 0) infos.push_back(entry.info);
    return infos;
}

std::uint64_t ObjectRegistry::allocatedBytes() const {
    return std::accumulate(mHeapBytes.begin(), mHeapBytes.end(), std::uint64_t{0});
}

std::vector<std::string> ObjectRegistry::close() {
    std::vector<std::string> names;
    for (const auto& [id, entry] : mLiving) {
        names.push_back(fmt::format("{} '{}'", entry.info.kind, entry.info.name));
        destroy(entry);
    }
    for (const Entry& entry : mDying) destroy(entry);
    mLiving.clear();
    mDying.clear();
    mIsClosed = true;
    return names;
}

ObjectOwner::ObjectOwner(Device& device, const std::string& kind, const std::string& name)
    : mRegistry(device.registry()), mId(mRegistry->add(kind, name)) {}

ObjectOwner::ObjectOwner(ObjectOwner&& other) noexcept
    : mRegistry(std::move(other.mRegistry)), mId(std::exchange(other.mId, 0)) {}

ObjectOwner& ObjectOwner::operator=(ObjectOwner&& other) noexcept {
    if (this == &other) return *this;
    reset();
    mRegistry = std::move(other.mRegistry);
    mId = std::exchange(other.mId, 0);
    return *this;
}

ObjectOwner ObjectOwner::share() const {
    ObjectOwner other;
    if (!mRegistry) return other;
    mRegistry->retain(mId);
    other.mRegistry = mRegistry;
    other.mId = mId;
    return other;
}

void ObjectOwner::reset() {
    if (mRegistry) mRegistry->release(mId);
    mRegistry.reset();
}

}  // namespace brume::gpu
