// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <gpu/pipeline_store.hpp>

#include <numeric>

namespace brume::gpu {
namespace {

constexpr const char* kDoing = "creating pipeline";

// Specialization values laid out for Vulkan; must stay where it is while in use.
struct Specialization {
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    VkSpecializationInfo info{};

    Specialization(const std::vector<std::uint32_t>& inOrder,
                   const std::vector<NumberedConstant>& numbered)
        : values(inOrder) {
        for (std::uint32_t i = 0; i < inOrder.size(); ++i)
            entries.push_back({i, i * 4u, sizeof(std::uint32_t)});
        for (const NumberedConstant& constant : numbered) {
            const auto index = static_cast<std::uint32_t>(values.size());
            entries.push_back({constant.id, index * 4u, sizeof(std::uint32_t)});
            values.push_back(constant.value);
        }
        info.mapEntryCount = static_cast<std::uint32_t>(entries.size());
        info.pMapEntries = entries.data();
        info.dataSize = values.size() * sizeof(std::uint32_t);
        info.pData = values.data();
    }
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;
};

// A shader module for as long as its pipeline is being created.
class Module {
  public:
    Module(Device& device, std::span<const std::uint32_t> spirv, const std::string& name)
        : mDevice(&device) {
        spirv = device.currentShader(spirv);
        VkShaderModuleCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        info.codeSize = spirv.size_bytes();
        info.pCode = spirv.data();
        device.check(device.vk().vkCreateShaderModule(device.handle(), &info, device.allocator(), &mHandle),
                     kDoing, name);
    }
    ~Module() { mDevice->vk().vkDestroyShaderModule(mDevice->handle(), mHandle, mDevice->allocator()); }
    Module(const Module&) = delete;
    Module& operator=(const Module&) = delete;

    VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage,
                                          const Specialization& specialization) const {
        VkPipelineShaderStageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage = stage;
        info.module = mHandle;
        info.pName = "main";
        info.pSpecializationInfo = &specialization.info;
        return info;
    }

  private:
    Device* mDevice;
    VkShaderModule mHandle = VK_NULL_HANDLE;
};

VkPipelineColorBlendAttachmentState toVulkan(const Blend& blend) {
    VkPipelineColorBlendAttachmentState state{};
    state.blendEnable = blend.isEnabled;
    state.srcColorBlendFactor = blend.sourceColor;
    state.dstColorBlendFactor = blend.targetColor;
    state.colorBlendOp = blend.colorOp;
    state.srcAlphaBlendFactor = blend.sourceAlpha;
    state.dstAlphaBlendFactor = blend.targetAlpha;
    state.alphaBlendOp = blend.alphaOp;
    state.colorWriteMask = blend.writeMask;
    return state;
}

// The fixed-function half of a graphics pipeline; the structures point at each other.
struct FixedState {
    VkPipelineVertexInputStateCreateInfo vertex{};
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    VkPipelineViewportStateCreateInfo viewport{};
    VkPipelineRasterizationStateCreateInfo raster{};
    VkPipelineMultisampleStateCreateInfo samples{};
    VkPipelineDepthStencilStateCreateInfo depth{};
    std::vector<VkPipelineColorBlendAttachmentState> blends;
    std::vector<VkFormat> formats;
    VkPipelineColorBlendStateCreateInfo blend{};
    std::array<VkDynamicState, 2> dynamics = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    VkPipelineRenderingCreateInfo rendering{};

    explicit FixedState(const GraphicsPipelineDesc& desc) {
        vertex.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
        assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
        assembly.topology = desc.topology;
        viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport.viewportCount = 1;
        viewport.scissorCount = 1;
        samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
        dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamics.size());
        dynamic.pDynamicStates = dynamics.data();
        setRaster(desc);
        setTargets(desc);
    }
    FixedState(const FixedState&) = delete;
    FixedState& operator=(const FixedState&) = delete;

    void setRaster(const GraphicsPipelineDesc& desc) {
        raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster.depthClampEnable = desc.depthClamp;
        raster.polygonMode = VK_POLYGON_MODE_FILL;
        raster.cullMode = desc.cullMode;
        raster.frontFace = desc.frontFace;
        raster.lineWidth = 1;
        depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth.depthTestEnable = desc.depthTest;
        depth.depthWriteEnable = desc.depthWrite;
        depth.depthCompareOp = desc.depthCompare;
    }

    void setTargets(const GraphicsPipelineDesc& desc) {
        for (const ColorTarget& target : desc.colors) {
            blends.push_back(toVulkan(target.blend));
            formats.push_back(target.format);
        }
        blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
        blend.attachmentCount = static_cast<std::uint32_t>(blends.size());
        blend.pAttachments = blends.data();
        rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
        rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
        rendering.pColorAttachmentFormats = formats.data();
        rendering.depthAttachmentFormat = desc.depthFormat;
    }
};

}  // namespace

VkDescriptorType toVulkan(BindingType type) {
    switch (type) {
        case BindingType::UniformBuffer:
            return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
        case BindingType::StorageImage:
            return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        case BindingType::SampledImage:
            return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        default:
            return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
}

Blend Blend::custom(VkBlendFactor source, VkBlendFactor target) {
    Blend blend;
    blend.isEnabled = true;
    blend.sourceColor = blend.sourceAlpha = source;
    blend.targetColor = blend.targetAlpha = target;
    return blend;
}

Blend Blend::additive() { return custom(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE); }

Blend Blend::premultipliedOver() {
    return custom(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA);
}

Blend Blend::multiply() {
    Blend blend = custom(VK_BLEND_FACTOR_DST_COLOR, VK_BLEND_FACTOR_ZERO);
    blend.sourceAlpha = VK_BLEND_FACTOR_DST_ALPHA;
    return blend;
}

void Pipeline::describe(const std::string& name, const std::vector<Binding>& bindings,
                        std::uint32_t pushConstantBytes, VkShaderStageFlags stages) {
    if (name.empty()) throw AssertionError("creating pipeline: it has no name");
    mName = name;
    mBindings = bindings;
    mPushConstantBytes = pushConstantBytes;
    mStages = stages;
}

void Pipeline::makeLayout(Device& device) {
    const auto descriptors =
        std::accumulate(mBindings.begin(), mBindings.end(), 0u,
                        [](std::uint32_t sum, const Binding& b) { return sum + b.count; });
    if (descriptors > device.limits().maxPushDescriptors ||
        mPushConstantBytes > device.limits().maxPushConstantBytes)
        throw failure(
            kDoing, mName,
            fmt::format("{} bindings and {} bytes of push constants, but {} allows {} "
                        "and {}",
                        descriptors, mPushConstantBytes, device.info().name,
                        device.limits().maxPushDescriptors, device.limits().maxPushConstantBytes));
    std::vector<VkDescriptorSetLayoutBinding> entries;
    for (const Binding& b : mBindings)
        entries.push_back({b.number, toVulkan(b.type), b.count, mStages, nullptr});
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
    set.bindingCount = static_cast<std::uint32_t>(entries.size());
    set.pBindings = entries.data();
    const VolkDeviceTable& vk = device.vk();
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    device.check(vk.vkCreateDescriptorSetLayout(device.handle(), &set, device.allocator(), &setLayout), kDoing,
                 mName);
    mOwner.add(owned(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, setLayout));
    const VkPushConstantRange range{mStages, 0, mPushConstantBytes};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &setLayout;
    layout.pushConstantRangeCount = mPushConstantBytes > 0 ? 1 : 0;
    layout.pPushConstantRanges = &range;
    device.check(vk.vkCreatePipelineLayout(device.handle(), &layout, device.allocator(), &mLayout), kDoing,
                 mName);
    mOwner.add(owned(VK_OBJECT_TYPE_PIPELINE_LAYOUT, mLayout));
}

void Pipeline::adopt(Device& device, VkResult result, VkPipelineBindPoint bindPoint) {
    device.check(result, kDoing, mName);
    mBindPoint = bindPoint;
    mOwner.add(owned(VK_OBJECT_TYPE_PIPELINE, mHandle));
    device.setName(VK_OBJECT_TYPE_PIPELINE, (std::uint64_t)mHandle, mName);
}

bool Pipeline::takeKept(const Device& device, const std::string& description,
                        VkPipelineBindPoint bindPoint) {
    const PipelineStore* store = device.pipelineStore();
    const PipelineStore::Entry* entry = store ? store->find(description) : nullptr;
    if (!entry) return false;
    mHandle = entry->handle;
    mLayout = entry->layout;
    mBindPoint = bindPoint;
    mOwner = entry->owner.share();
    return true;
}

void Pipeline::keep(const Device& device, const std::string& description) const {
    if (PipelineStore* store = device.pipelineStore())
        store->keep(description, {mHandle, mLayout, mOwner.share()});
}

ComputePipeline::ComputePipeline(Device& device, const ComputePipelineDesc& desc) {
    describe(desc.name, desc.bindings, desc.pushConstantBytes, VK_SHADER_STAGE_COMPUTE_BIT);
    const std::string description =
        device.pipelineStore() ? describePipeline(device, desc) : std::string();
    if (takeKept(device, description, VK_PIPELINE_BIND_POINT_COMPUTE)) return;
    mOwner = ObjectOwner(device, "pipeline", mName);
    makeLayout(device);
    const Module module(device, desc.spirv, mName);
    const Specialization specialization(desc.specialization, desc.constants);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = module.stage(VK_SHADER_STAGE_COMPUTE_BIT, specialization);
    info.layout = mLayout;
    adopt(device,
          device.vk().vkCreateComputePipelines(device.handle(), device.pipelineCache(), 1, &info,
                                               device.allocator(), &mHandle),
          VK_PIPELINE_BIND_POINT_COMPUTE);
    keep(device, description);
}

GraphicsPipeline::GraphicsPipeline(Device& device, const GraphicsPipelineDesc& desc) {
    describe(desc.name, desc.bindings, desc.pushConstantBytes,
             VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
    const std::string description =
        device.pipelineStore() ? describePipeline(device, desc) : std::string();
    if (takeKept(device, description, VK_PIPELINE_BIND_POINT_GRAPHICS)) return;
    mOwner = ObjectOwner(device, "pipeline", mName);
    makeLayout(device);
    const Module vertex(device, desc.vertexSpirv, mName);
    const Module fragment(device, desc.fragmentSpirv, mName);
    const Specialization specialization(desc.specialization, desc.constants);
    const std::array stages = {vertex.stage(VK_SHADER_STAGE_VERTEX_BIT, specialization),
                               fragment.stage(VK_SHADER_STAGE_FRAGMENT_BIT, specialization)};
    const FixedState state(desc);
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &state.rendering;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &state.vertex;
    info.pInputAssemblyState = &state.assembly;
    info.pViewportState = &state.viewport;
    info.pRasterizationState = &state.raster;
    info.pMultisampleState = &state.samples;
    info.pDepthStencilState = &state.depth;
    info.pColorBlendState = &state.blend;
    info.pDynamicState = &state.dynamic;
    info.layout = mLayout;
    adopt(device,
          device.vk().vkCreateGraphicsPipelines(device.handle(), device.pipelineCache(), 1, &info,
                                                device.allocator(), &mHandle),
          VK_PIPELINE_BIND_POINT_GRAPHICS);
    keep(device, description);
}

}  // namespace brume::gpu
