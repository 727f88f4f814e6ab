// SPDX-License-Identifier: Apache-2.0
// Compute and graphics pipelines: one push-descriptor set (set 0), push constants and
// specialization constants.
#pragma once

#include <gpu/object_registry.hpp>

#include <span>
#include <string>
#include <vector>

namespace brume::gpu {

enum class BindingType {
    StorageBuffer,
    UniformBuffer,
    StorageImage,  ///< in layout GENERAL
    SampledImage   ///< with its sampler (GLSL sampler2D, sampler3D, ...)
};
VkDescriptorType toVulkan(BindingType type);

struct Binding {
    std::uint32_t number = 0;  ///< layout(set = 0, binding = number)
    BindingType type = BindingType::StorageBuffer;
    std::uint32_t count = 1;  ///< > 1: an array; the sum over a pipeline is <= maxPushDescriptors
};

/// A specialization constant by its constant_id.
struct NumberedConstant {
    std::uint32_t id = 0;
    std::uint32_t value = 0;
};

struct ComputePipelineDesc {
    std::string name;
    std::span<const std::uint32_t> spirv;  ///< read during creation only
    std::vector<Binding> bindings;
    std::uint32_t pushConstantBytes = 0;  ///< multiple of 4; portable up to 128
    /// The i-th value goes to constant_id = i: int, uint, bool, or a float through std::bit_cast.
    std::vector<std::uint32_t> specialization;
    std::vector<NumberedConstant> constants;  ///< further ones, of included files
};

/// How a colour attachment takes a fragment: result = source * sourceFactor op target *
/// targetFactor.
struct Blend {
    bool isEnabled = false;
    VkBlendFactor sourceColor = VK_BLEND_FACTOR_ONE;
    VkBlendFactor targetColor = VK_BLEND_FACTOR_ZERO;
    VkBlendFactor sourceAlpha = VK_BLEND_FACTOR_ONE;
    VkBlendFactor targetAlpha = VK_BLEND_FACTOR_ZERO;
    VkBlendOp colorOp = VK_BLEND_OP_ADD;
    VkBlendOp alphaOp = VK_BLEND_OP_ADD;
    VkColorComponentFlags writeMask = 0xf;

    static Blend none() { return {}; }
    static Blend additive();           ///< target + source
    static Blend premultipliedOver();  ///< source + (1 - source.a) target
    static Blend multiply();           ///< target * source, all four channels
    static Blend custom(VkBlendFactor source, VkBlendFactor target);
};

struct ColorTarget {
    VkFormat format = VK_FORMAT_UNDEFINED;
    Blend blend;
};

/// No vertex input: vertex shaders pull from buffers by gl_VertexIndex. Viewport and scissor are
/// dynamic (Commands::beginRendering sets both to the whole target, y downwards).
struct GraphicsPipelineDesc {
    std::string name;
    std::span<const std::uint32_t> vertexSpirv;
    std::span<const std::uint32_t> fragmentSpirv;
    std::vector<Binding> bindings;  ///< visible to both stages
    std::uint32_t pushConstantBytes = 0;
    std::vector<std::uint32_t> specialization;  ///< for both stages
    std::vector<NumberedConstant> constants;    ///< further ones, of included files
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkCullModeFlags cullMode = VK_CULL_MODE_NONE;
    VkFrontFace frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    std::vector<ColorTarget> colors;             ///< may be empty: a pass that only stores
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;  ///< undefined: no depth attachment
    bool depthTest = false;
    bool depthWrite = false;
    VkCompareOp depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;  ///< reversed z: near 1, far 0
    bool depthClamp = false;  ///< instead of clipping at near and far; needs the feature
};

/// What Commands needs of either kind of pipeline. Move-only; empty by default.
class Pipeline {
  public:
    const std::string& name() const { return mName; }
    VkPipeline handle() const { return mHandle; }
    VkPipelineLayout layout() const { return mLayout; }
    VkPipelineBindPoint bindPoint() const { return mBindPoint; }
    const std::vector<Binding>& bindings() const { return mBindings; }
    std::uint32_t pushConstantBytes() const { return mPushConstantBytes; }
    VkShaderStageFlags stages() const { return mStages; }
    explicit operator bool() const { return static_cast<bool>(mOwner); }

  protected:
    Pipeline() = default;
    void describe(const std::string& name, const std::vector<Binding>& bindings,
                  std::uint32_t pushConstantBytes, VkShaderStageFlags stages);
    void makeLayout(Device& device);
    void adopt(Device& device, VkResult result, VkPipelineBindPoint bindPoint);
    /// Takes what the device has kept of this description, if it has.
    bool takeKept(const Device& device, const std::string& description,
                  VkPipelineBindPoint bindPoint);
    void keep(const Device& device, const std::string& description) const;

    std::string mName;
    VkPipeline mHandle = VK_NULL_HANDLE;
    VkPipelineLayout mLayout = VK_NULL_HANDLE;
    VkPipelineBindPoint mBindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;
    VkShaderStageFlags mStages = 0;
    std::vector<Binding> mBindings;
    std::uint32_t mPushConstantBytes = 0;
    ObjectOwner mOwner;
};

class ComputePipeline : public Pipeline {
  public:
    ComputePipeline() = default;
    ComputePipeline(Device& device, const ComputePipelineDesc& desc);
};

class GraphicsPipeline : public Pipeline {
  public:
    GraphicsPipeline() = default;
    GraphicsPipeline(Device& device, const GraphicsPipelineDesc& desc);
};

}  // namespace brume::gpu
