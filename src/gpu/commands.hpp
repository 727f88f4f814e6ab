// SPDX-License-Identifier: Apache-2.0
// A thin recorder over a command buffer that someone else owns and submits.
#pragma once

#include <gpu/buffer.hpp>
#include <gpu/image.hpp>
#include <gpu/pipeline.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

namespace brume::gpu {

/// Of one pipeline, and colour attachments of one pass: what every Vulkan 1.3 device has.
inline constexpr std::size_t kMaxBindings = 32, kMaxColors = 8;

enum class LoadOp { Load, Clear, DontCare };

struct ColorAttachment {
    const Image* image = nullptr;
    LoadOp load = LoadOp::Load;
    std::array<float, 4> clear = {0, 0, 0, 0};              ///< for float and normalised formats
    std::array<std::uint32_t, 4> clearUint = {0, 0, 0, 0};  ///< for integer formats
};

struct DepthAttachment {
    const Image* image = nullptr;
    LoadOp load = LoadOp::Load;
    float clear = 0;  ///< reversed z: 0 is far away
    bool isReadOnly = false;
};

/// Records into `commands`, which must be in the recording state. Bindings and push constants
/// belong to the bound pipeline: binding another one forgets them. Every draw or dispatch checks
/// that all bindings of the pipeline are given (AssertionError naming the missing one).
class Commands {
  public:
    Commands(Device& device, VkCommandBuffer commands) : mDevice(&device), mHandle(commands) {}

    Device& device() const { return *mDevice; }
    VkCommandBuffer handle() const { return mHandle; }

    void bindCompute(const ComputePipeline& pipeline) { bindPipeline(pipeline); }
    void bindGraphics(const GraphicsPipeline& pipeline) { bindPipeline(pipeline); }

    /// The size must be the pipeline's pushConstantBytes.
    template <typename T>
    void pushConstants(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        pushConstantBytes(&value, sizeof(T));
    }
    void pushConstantBytes(const void* data, std::size_t bytes);

    /// For StorageBuffer and UniformBuffer bindings; `element` of an array binding. The range must
    /// not exceed Limits::maxStorageBufferRange (AssertionError).
    void bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t element = 0);
    void bind(std::uint32_t binding, const BufferRange& range, std::uint32_t element = 0);
    /// For StorageImage bindings; the image must be in layout GENERAL when the commands run.
    void bind(std::uint32_t binding, const Image& image, std::uint32_t element = 0);
    /// For SampledImage bindings; the image is expected in its current layout().
    void bind(std::uint32_t binding, const Image& image, const Sampler& sampler,
              std::uint32_t element = 0);

    void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
    /// Enough groups of `groupSize` for `threads`, in x and, beyond its limit, y:
    /// shaders compute their index as x + y * gl_NumWorkGroups.x * groupSize and check the bound.
    void dispatchThreads(std::uint64_t threads, std::uint32_t groupSize);
    void dispatchIndirect(const Buffer& arguments, std::uint64_t offset = 0);
    std::uint64_t dispatchCount() const { return mDispatchCount; }  ///< recorded by this object
    void draw(std::uint32_t vertices, std::uint32_t instances = 1, std::uint32_t firstVertex = 0,
              std::uint32_t firstInstance = 0);
    void drawIndirect(const Buffer& arguments, std::uint64_t offset = 0, std::uint32_t draws = 1,
                      std::uint32_t stride = sizeof(VkDrawIndirectCommand));
    void bindIndexBuffer(const Buffer& buffer, std::uint64_t offset = 0);  ///< of uint32
    void drawIndexed(std::uint32_t indices, std::uint32_t instances = 1,
                     std::uint32_t firstIndex = 0, std::int32_t vertexOffset = 0,
                     std::uint32_t firstInstance = 0);

    void drawIndexedIndirect(const Buffer& arguments, std::uint64_t offset = 0,
                             std::uint32_t draws = 1,
                             std::uint32_t stride = sizeof(VkDrawIndexedIndirectCommand));

    /// Attachments must be in their attachment layouts. Viewport and scissor become `area`, by
    /// default the first attachment's extent (required when there is none).
    void beginRendering(std::span<const ColorAttachment> colors,
                        const std::optional<DepthAttachment>& depth = {}, VkExtent2D area = {});
    void endRendering();
    void setScissor(const VkRect2D& scissor);
    void setViewport(const VkViewport& viewport);

    void fillBuffer(const Buffer& buffer, std::uint32_t value, std::uint64_t offset = 0,
                    std::uint64_t bytes = VK_WHOLE_SIZE);
    /// At most 65536 bytes, a multiple of 4, copied into the command buffer itself.
    void updateBuffer(const Buffer& buffer, const void* data, std::uint64_t bytes,
                      std::uint64_t offset = 0);
    /// The same for an array of any size, `offset` in bytes.
    template <typename T>
    void updateArray(const Buffer& buffer, std::span<const T> values, std::uint64_t offset = 0) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
        constexpr std::size_t kPerUpdate = 65536 / sizeof(T);
        for (std::size_t first = 0; first < values.size(); first += kPerUpdate)
            updateBuffer(buffer, &values[first],
                         std::min(kPerUpdate, values.size() - first) * sizeof(T),
                         offset + first * sizeof(T));
    }
    void copyBuffer(const Buffer& source, const Buffer& target, std::uint64_t bytes,
                    std::uint64_t sourceOffset = 0, std::uint64_t targetOffset = 0);
    /// Tightly packed rows; the image in TRANSFER_SRC_OPTIMAL, for the other TRANSFER_DST_OPTIMAL.
    void copyImageToBuffer(const Image& source, const Buffer& target, std::uint64_t offset = 0);
    void copyBufferToImage(const Buffer& source, const Image& target, std::uint64_t offset = 0);
    /// Whole images of equal size and compatible formats.
    void copyImage(const Image& source, const Image& target);
    /// In layout GENERAL or TRANSFER_DST_OPTIMAL.
    void clearColorImage(const Image& image, const std::array<float, 4>& value);
    void clearColorImage(const Image& image, const std::array<std::uint32_t, 4>& value);

    void beginLabel(const char* name);
    void beginLabel(const std::string& name) { beginLabel(name.c_str()); }
    void endLabel();

    void memoryBarrier(VkPipelineStageFlags2 sourceStages, VkAccessFlags2 sourceAccess,
                       VkPipelineStageFlags2 targetStages, VkAccessFlags2 targetAccess);
    /// Compute writes before it are seen by compute shaders and indirect arguments after it. For
    /// the steps within one pass; between passes the frame places the barriers.
    void computeBarrier();
    /// Transfer (fill, update, copy) and compute, either way. Within one pass only.
    void computeTransferBarrier();
    /// Everything before it is finished and seen by everything after it, the host included.
    void fullBarrier();
    /// Changes the layout from image.layout(), with a full wait. For set-up; within a frame the
    /// FrameBuilder does it exactly. `discard`: the old content is not needed.
    void transition(const Image& image, VkImageLayout layout, bool discard = false);
    void pipelineBarrier(const VkDependencyInfo& dependency);

  private:
    struct Bound {
        std::uint32_t binding = 0;
        std::uint32_t element = 0;
        VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        VkDescriptorBufferInfo buffer{};
        VkDescriptorImageInfo image{};
        bool isPushed = false;  ///< descriptors that stay are not pushed again with the next draw
    };
    void bindPipeline(const Pipeline& pipeline);
    const Binding& requireBinding(std::uint32_t binding, std::uint32_t element) const;
    void setBound(const Bound& bound);
    void flush(VkPipelineBindPoint bindPoint);

    Device* mDevice;
    VkCommandBuffer mHandle;
    const Pipeline* mPipeline = nullptr;
    std::array<Bound, kMaxBindings> mBound;  // recording allocates nothing
    std::size_t mBoundCount = 0;
    bool mIsDirty = false;
    std::uint64_t mDispatchCount = 0;
};

}  // namespace brume::gpu
