// SPDX-License-Identifier: Apache-2.0
// A Vulkan device, made by Brume or lent by a host, and what its objects share: functions, limits,
// names, deferred destruction, the pipeline cache and the validation messages.
#pragma once

#include <vulkan/vulkan.h>
#include <core/error.hpp>
#include <core/log.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct VolkDeviceTable;

namespace brume::gpu {

class ObjectRegistry;
class PipelineStore;
struct InstanceFunctions;

/// How Device::create() chooses and sets up a device.
struct DeviceOptions {
    /// Part of a device's name (any case) or its index in listDevices(). Empty: the first usable
    /// discrete device, then integrated, then virtual, then CPU.
    std::string device;
    bool validate = false;                    ///< load the Khronos validation layer
    bool synchronizationValidation = false;   ///< with validate: find missing barriers as well
    std::filesystem::path pipelineCacheFile;  ///< read now, written on destruction; empty: none
    /// Pipelines stay when their last user goes, for later ones of the same description: where many
    /// renderers follow each other.
    bool keepPipelines = false;
    /// For a device that shows images in windows (Swapchain): the instance extensions of the window
    /// system. Empty: none is shown.
    std::vector<std::string> windowExtensions;
};

/// Features beyond the required ones; Device::create() enables each one that the device has.
struct OptionalFeatures {
    bool shaderFloat64 = false;
    bool shaderInt64Atomics = false;      ///< on buffers
    bool shaderFloat32AtomicAdd = false;  ///< on buffers
    bool geometryShader = false;          ///< gl_PrimitiveID in fragment shaders needs it
    bool drawParameters = false;          ///< gl_BaseInstance, gl_DrawID
    bool multiDrawIndirect = false;
    bool storageImageWriteWithoutFormat = false;
    bool depthClamp = false;
    bool vertexStores = false;  ///< stores and atomics in vertex shaders
    bool pipelineStatistics = false;  ///< TimerPool::countFragments()
};

/// A failure that Vulkan has returned.
class VulkanError : public Error {
  public:
    VulkanError(const Error& error, VkResult result) : Error(error), mResult(result) {}
    VkResult result() const { return mResult; }

  private:
    VkResult mResult;
};

/// How a host wants device memory to be allocated: both or neither. Each call is one allocation.
struct MemoryHooks {
    void* user = nullptr;
    VkResult (*allocate)(void* user, const VkMemoryAllocateInfo* info, VkDeviceMemory* memory) =
        nullptr;
    void (*free)(void* user, VkDeviceMemory memory) = nullptr;
};

/// Everything that a host lends. All of it must outlive the Device. The host must have enabled
/// Vulkan 1.3 with dynamicRendering, synchronization2, maintenance4, bufferDeviceAddress,
/// scalarBlockLayout, timelineSemaphore, shaderInt64, independentBlend, fragmentStoresAndAtomics,
/// shaderStorageImageExtendedFormats and the extension VK_KHR_push_descriptor.
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    std::uint32_t queueFamily = 0;  ///< of the queue that Brume's commands are submitted to
    OptionalFeatures features;      ///< those that the host has enabled
    bool debugUtils = false;        ///< VK_EXT_debug_utils is enabled: names and labels
    std::filesystem::path pipelineCacheFile;
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;    ///< used instead of an own one
    const VkAllocationCallbacks* allocator = nullptr;  ///< copied; for every create and destroy
    MemoryHooks memory;
    std::uint64_t memoryBudgetBytes = ~std::uint64_t{0};  ///< more is refused
};

/// One physical device, as `brume list devices` shows it.
struct DeviceInfo {
    std::string name;
    std::string type;                     ///< discrete, integrated, virtual, cpu or other
    std::string driver;                   ///< name and version text of the driver
    std::string api;                      ///< Vulkan version, e.g. "1.3.230"
    std::vector<std::string> rejections;  ///< every reason why it cannot be used; empty: usable
};

/// Every device of the Vulkan loader, in its order. Throws a failure Error without a loader.
std::vector<DeviceInfo> listDevices();

/// What code above this layer needs to know to stay within the device.
struct Limits {
    std::uint64_t maxStorageBufferRange = 0;  ///< largest buffer range that a binding may cover
    std::uint64_t maxBufferBytes = 0;         ///< largest buffer (reached by its device address)
    std::uint64_t maxAllocationBytes = 0;
    std::uint64_t deviceHeapBytes = 0;  ///< size of the largest device-local heap
    std::uint32_t maxAllocations = 0;
    std::uint32_t maxImageDimension2d = 0;
    std::uint32_t maxImageDimension3d = 0;
    std::uint32_t maxImageLayers = 0;
    std::uint32_t maxPushConstantBytes = 0;
    std::uint32_t maxPushDescriptors = 0;
    std::uint32_t maxGroupInvocations = 0;
    std::uint32_t maxGroupCount[3] = {};
    std::uint32_t maxSharedMemoryBytes = 0;
    std::uint32_t subgroupSize = 0;
    std::uint32_t timestampValidBits = 0;  ///< 0: no timestamps
    double timestampPeriodNs = 0;
};

/// Where an object's memory lies.
enum class MemoryKind {
    Device,   ///< fastest for the device, not mapped
    Upload,   ///< mapped: the host writes, the device reads
    Readback  ///< mapped and cached: the device writes, the host reads; buffers begin as zeros
};

/// A living object with memory, for byte counts.
struct ObjectInfo {
    std::string kind;  ///< "buffer", "image", ...
    std::string name;
    std::uint64_t bytes = 0;  ///< of device memory, as allocated
    MemoryKind memory = MemoryKind::Device;
    std::uint32_t heap = 0;  ///< index of the Vulkan memory heap
};

/// Memory of one object.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t bytes = 0;
    std::uint32_t heap = 0;
};

/// The device. Not thread-safe. It never submits, waits or owns a queue: that is its user's
/// business (for programs without a host: Submitter).
///
/// Destroying an object while the device may still use it is allowed: between beginFrame() and
/// retireFrame() destruction is deferred until the frame is retired.
class Device {
  public:
    /// Makes an own instance and device. Throws an input Error if `options.device` names none that
    /// is usable, else a failure Error; both list every device with all its reasons.
    static std::unique_ptr<Device> create(const DeviceOptions& options, const Log& log);

    /// Uses a host's device. Creates neither instance, device nor queue.
    static std::unique_ptr<Device> wrap(const HostDevice& host, const Log& log);

    /// Frees every object that is left and logs the names of those that still live as warnings
    /// (their own destructors then do nothing). The device must be idle.
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkDevice handle() const { return mDevice; }
    VkInstance instance() const { return mInstance; }
    VkPhysicalDevice physicalDevice() const { return mPhysicalDevice; }
    std::uint32_t queueFamily() const { return mQueueFamily; }
    VkQueue queue() const { return mQueue; }  ///< of an own device; null for a host's

    const VolkDeviceTable& vk() const { return *mTable; }  ///< device functions; include <volk.h>
    const Limits& limits() const { return mLimits; }
    const OptionalFeatures& features() const { return mFeatures; }
    const DeviceInfo& info() const { return mInfo; }
    const Log& log() const { return mLog; }
    VkPipelineCache pipelineCache() const { return mPipelineCache; }
    /// For every vkCreate and vkDestroy of this layer; may be null.
    const VkAllocationCallbacks* allocator() const { return mAllocator ? &*mAllocator : nullptr; }
    const MemoryHooks& memoryHooks() const { return mMemoryHooks; }
    bool isLavapipe() const { return mInfo.type == "cpu"; }  ///< pixels and threads are CPU work

    /// Begins a frame (any stretch of recorded commands); its serial counts from 1. Frames are
    /// retired in order.
    std::uint64_t beginFrame();
    /// The device has finished frame `serial` and all before it: frees what they kept alive.
    void retireFrame(std::uint64_t serial);
    bool isFrameOpen() const;  ///< whether a frame has begun that is not retired yet

    /// Living objects that own memory, in order of creation.
    std::vector<ObjectInfo> objects() const;
    /// Bytes allocated now: objects() and those whose destruction is deferred.
    std::uint64_t allocatedBytes() const;

    /// Validation messages so far (warnings and errors). Only an own device with `validate`.
    std::vector<std::string> validationMessages() const;
    void clearValidationMessages();

    /// Writes the pipeline cache now (also done by the destructor). Throws a failure Error.
    void savePipelineCache() const;

    /// Pipelines made from now on use `words` instead of the embedded shader that begins at
    /// `original`; empty: that shader again. For tools that edit shaders.
    void replaceShader(const std::uint32_t* original, std::vector<std::uint32_t> words);

    // For the objects of this layer -------------------------------------------------------------

    /// Throws a VulkanError "<doing>: <object>: VK_ERROR_..." unless `result` is a success.
    void check(VkResult result, const char* doing, const std::string& object) const;
    /// Gives a handle its name in debuggers and messages.
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name) const;
    void beginLabel(VkCommandBuffer commands, const char* name) const;
    void endLabel(VkCommandBuffer commands) const;
    /// Memory for an object; refuses what does not fit, with sizes and limits in the message.
    Allocation allocate(const VkMemoryRequirements& needed, MemoryKind kind, bool hasAddress,
                        const std::string& object);
    /// The shader, or what replaces it.
    std::span<const std::uint32_t> currentShader(std::span<const std::uint32_t> spirv) const;
    /// What the device supports for such an image; VK_ERROR_FORMAT_NOT_SUPPORTED if nothing.
    VkResult imageLimits(const VkImageCreateInfo& info, VkImageFormatProperties& limits) const;
    /// Can images of this format be colour targets that blend?
    bool canBlend(VkFormat format) const;
    const std::shared_ptr<ObjectRegistry>& registry() const { return mRegistry; }
    PipelineStore* pipelineStore() const { return mPipelineStore.get(); }  ///< null: none is kept

  private:
    struct Debug;  // the debug messenger and what it has collected
    Device();
    void createInstance(const DeviceOptions& options);
    void createDevice(const DeviceOptions& options);
    void createMessenger();
    void initialize(const std::filesystem::path& cacheFile);
    void readLimits();
    void loadPipelineCache();
    std::uint32_t findMemoryType(std::uint32_t typeBits, MemoryKind kind) const;

    Log mLog;
    DeviceInfo mInfo;
    VkInstance mInstance = VK_NULL_HANDLE;
    VkPhysicalDevice mPhysicalDevice = VK_NULL_HANDLE;
    VkDevice mDevice = VK_NULL_HANDLE;
    VkQueue mQueue = VK_NULL_HANDLE;
    std::uint32_t mQueueFamily = 0;
    bool mIsOwner = false;
    std::unique_ptr<InstanceFunctions> mFunctions;
    std::unique_ptr<VolkDeviceTable> mTable;
    std::unique_ptr<Debug> mDebug;
    Limits mLimits;
    OptionalFeatures mFeatures;
    VkPhysicalDeviceMemoryProperties mMemory{};
    VkPhysicalDeviceProperties mProperties{};
    std::filesystem::path mPipelineCacheFile;
    VkPipelineCache mPipelineCache = VK_NULL_HANDLE;
    bool mIsCacheLent = false;
    std::optional<VkAllocationCallbacks> mAllocator;
    MemoryHooks mMemoryHooks;
    std::uint64_t mBudgetBytes = ~std::uint64_t{0};
    std::shared_ptr<ObjectRegistry> mRegistry;
    std::unique_ptr<PipelineStore> mPipelineStore;
    std::map<const std::uint32_t*, std::vector<std::uint32_t>> mReplacedShaders;
};

}  // namespace brume::gpu
