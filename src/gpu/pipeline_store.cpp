// SPDX-License-Identifier: Apache-2.0
#include <gpu/pipeline_store.hpp>

#include <type_traits>

namespace brume::gpu {
namespace {

// Collects values as bytes; each is of a fixed size or preceded by its length.
class Description {
  public:
    template <typename T>
    Description& add(const T& value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        mText.append(reinterpret_cast<const char*>(&value), sizeof(value));
        return *this;
    }
    void add(const std::string& text) {
        add(text.size());
        mText += text;
    }
    void addShader(std::span<const std::uint32_t> words) {
        std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a, of words
        for (const std::uint32_t word : words) hash = (hash ^ word) * 0x100000001b3u;
        add(words.size()).add(hash);
    }
    template <typename Desc>
    void addCommon(const Desc& desc) {
        add(desc.name);
        add(desc.pushConstantBytes).add(desc.bindings.size());
        for (const Binding& b : desc.bindings) add(b.number).add(b.type).add(b.count);
        add(desc.specialization.size());
        for (const std::uint32_t value : desc.specialization) add(value);
        add(desc.constants.size());
        for (const NumberedConstant& constant : desc.constants) add(constant.id).add(constant.value);
    }
    void add(const Blend& b) {
        add(b.isEnabled).add(b.sourceColor).add(b.targetColor).add(b.sourceAlpha);
        add(b.targetAlpha).add(b.colorOp).add(b.alphaOp).add(b.writeMask);
    }
    std::string take() { return std::move(mText); }

  private:
    std::string mText;
};

}  // namespace

std::string describePipeline(const Device& device, const ComputePipelineDesc& desc) {
    Description description;
    description.addCommon(desc);
    description.addShader(device.currentShader(desc.spirv));
    return description.take();
}

std::string describePipeline(const Device& device, const GraphicsPipelineDesc& desc) {
    Description description;
    description.addCommon(desc);
    description.addShader(device.currentShader(desc.vertexSpirv));
    description.addShader(device.currentShader(desc.fragmentSpirv));
    description.add(desc.topology).add(desc.cullMode).add(desc.frontFace).add(desc.colors.size());
    for (const ColorTarget& color : desc.colors) {
        description.add(color.format);
        description.add(color.blend);
    }
    description.add(desc.depthFormat).add(desc.depthTest).add(desc.depthWrite);
    description.add(desc.depthCompare).add(desc.depthClamp);
    return description.take();
}

const PipelineStore::Entry* PipelineStore::find(const std::string& description) const {
    const auto found = mEntries.find(description);
    return found == mEntries.end() ? nullptr : &found->second;
}

void PipelineStore::keep(const std::string& description, Entry entry) {
    mEntries.insert_or_assign(description, std::move(entry));
}

}  // namespace brume::gpu
