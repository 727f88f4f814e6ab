// SPDX-License-Identifier: Apache-2.0
// Declaring and describing a frame.
#include <fmt/format.h>
#include <core/assert.hpp>
#include <frame/frame_builder.hpp>

#include <algorithm>
#include <set>

namespace brume::frame {
namespace {

std::uint64_t estimateBytes(const gpu::ImageDesc& desc) {
    return std::uint64_t{desc.width} * desc.height * std::max(desc.depth, 1u) *
           std::max(desc.layers, 1u) * gpu::texelBytes(desc.format);
}

std::string describeImage(const gpu::ImageDesc& desc) {
    std::string text =
        fmt::format("{} {}x{}", gpu::formatName(desc.format), desc.width, desc.height);
    if (desc.depth > 0) text += fmt::format("x{}", desc.depth);
    if (desc.layers > 0) text += fmt::format(", {} layers", desc.layers);
    return text;
}

std::string joinUses(const std::vector<ResourceUse>& uses) {
    std::string text;
    for (const ResourceUse& use : uses)
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", use.resource, use.access);
    return text.empty() ? "-" : text;
}

}  // namespace

BufferRef FrameBuilder::importBuffer(const gpu::Buffer& buffer) {
    for (std::uint32_t i = 0; i < mResources.size(); ++i)
        if (mResources[i].buffer == &buffer) return {i};
    Resource resource;
    resource.bufferDesc = {buffer.name(), buffer.bytes()};
    resource.buffer = &buffer;
    mResources.push_back(std::move(resource));
    return {static_cast<std::uint32_t>(mResources.size() - 1)};
}

ImageRef FrameBuilder::importImage(const gpu::Image& image) {
    for (std::uint32_t i = 0; i < mResources.size(); ++i)
        if (mResources[i].image == &image) return {i};
    Resource resource;
    resource.isImage = true;
    resource.imageDesc = image.desc();
    resource.image = &image;
    mResources.push_back(std::move(resource));
    return {static_cast<std::uint32_t>(mResources.size() - 1)};
}

BufferRef FrameBuilder::createBuffer(const std::string& name, std::uint64_t bytes) {
    Resource resource;
    resource.isTransient = true;
    resource.bufferDesc = {name, bytes};
    mResources.push_back(std::move(resource));
    return {static_cast<std::uint32_t>(mResources.size() - 1)};
}

ImageRef FrameBuilder::createImage(const gpu::ImageDesc& desc) {
    Resource resource;
    resource.isImage = true;
    resource.isTransient = true;
    resource.imageDesc = desc;
    mResources.push_back(std::move(resource));
    return {static_cast<std::uint32_t>(mResources.size() - 1)};
}

PassBuilder& FrameBuilder::addPass(const std::string& name) {
    mPasses.emplace_back();
    mPasses.back().mName = name;
    return mPasses.back();
}

void FrameBuilder::addReadback(const std::string& name, BufferRef source,
                               const gpu::Buffer& target) {
    const BufferRef targetRef = importBuffer(target);
    addPass(name)
        .reads(source, Access::TransferRead)
        .writes(targetRef, Access::TransferWrite)
        .record([=](gpu::Commands& commands, const PassResources& resources) {
            const gpu::Buffer& from = resources.buffer(source);
            const gpu::Buffer& to = resources.buffer(targetRef);
            commands.copyBuffer(from, to, std::min(from.bytes(), to.bytes()));
        });
    mFinal.emplace_back(targetRef.index, Access::HostRead);
}

void FrameBuilder::addReadback(const std::string& name, ImageRef source,
                               const gpu::Buffer& target) {
    const BufferRef targetRef = importBuffer(target);
    const std::uint64_t needed = estimateBytes(mResources.at(source.index).imageDesc);
    if (needed == 0 || target.bytes() < needed)
        throw AssertionError(fmt::format("reading back '{}': the buffer has {} bytes, needs {}",
                                         mResources[source.index].name(), target.bytes(), needed));
    addPass(name)
        .reads(source, Access::TransferRead)
        .writes(targetRef, Access::TransferWrite)
        .record([=](gpu::Commands& commands, const PassResources& resources) {
            commands.copyImageToBuffer(resources.image(source), resources.buffer(targetRef));
        });
    mFinal.emplace_back(targetRef.index, Access::HostRead);
}

void FrameBuilder::finishAs(ImageRef ref, Access access) {
    const Resource& resource = mResources.at(ref.index);
    if (resource.isTransient)
        throw AssertionError(
            fmt::format("'{}' is transient and does not outlive the frame", resource.name()));
    mFinal.emplace_back(ref.index, access);
}

FrameDescription FrameBuilder::describe() const {
    FrameDescription description;
    for (const PassBuilder& pass : mPasses) {
        PassDescription entry;
        entry.name = pass.mName;
        for (const PassBuilder::Use& use : pass.mUses) {
            const ResourceUse text = {mResources.at(use.index).name(),
                                      std::string(accessInfo(use.access).name)};
            if (use.isRead) entry.reads.push_back(text);
            if (use.isWrite) entry.writes.push_back(text);
        }
        description.passes.push_back(std::move(entry));
    }
    for (const Resource& resource : mResources) {
        TargetDescription target;
        target.name = resource.name();
        target.format = resource.isImage ? describeImage(resource.imageDesc) : "buffer";
        target.bytes =
            resource.isImage ? estimateBytes(resource.imageDesc) : resource.bufferDesc.bytes;
        target.isTransient = resource.isTransient;
        description.targets.push_back(std::move(target));
    }
    return description;
}

std::map<std::string, std::uint64_t> FrameBuilder::passBytes() const {
    std::map<std::string, std::uint64_t> bytes;
    for (const PassBuilder& pass : mPasses) {
        std::set<std::uint32_t> read, written;
        for (const PassBuilder::Use& use : pass.mUses) {
            if (use.isRead) read.insert(use.index);
            if (use.isWrite) written.insert(use.index);
        }
        for (const std::set<std::uint32_t>* touched : {&read, &written})
            for (const std::uint32_t index : *touched) {
                const Resource& resource = mResources.at(index);
                bytes[pass.mName] += resource.isImage ? estimateBytes(resource.imageDesc)
                                                      : resource.bufferDesc.bytes;
            }
    }
    return bytes;
}

std::string FrameDescription::text() const {
    std::string text = "passes:\n";
    for (const PassDescription& pass : passes)
        text += fmt::format("  {}\n    reads  {}\n    writes {}\n", pass.name, joinUses(pass.reads),
                            joinUses(pass.writes));
    text += "targets:\n";
    for (const TargetDescription& target : targets)
        text += fmt::format("  {}: {}, {} bytes, {}\n", target.name, target.format, target.bytes,
                            target.isTransient ? "transient" : "persistent");
    return text;
}

}  // namespace brume::frame
