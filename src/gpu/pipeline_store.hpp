// SPDX-License-Identifier: Apache-2.0
// Pipelines that a device keeps for later ones of the same description: where scenes or methods
// follow each other, making them costs more than drawing does.
#pragma once

#include <gpu/object_registry.hpp>
#include <gpu/pipeline.hpp>

#include <map>
#include <string>

namespace brume::gpu {

/// What a description comes to: equal texts, equal pipelines. It holds the shaders' contents, as
/// hashes, since tools may replace them.
std::string describePipeline(const Device& device, const ComputePipelineDesc& desc);
std::string describePipeline(const Device& device, const GraphicsPipelineDesc& desc);

/// Grows by one entry per distinct description, until the device goes.
class PipelineStore {
  public:
    struct Entry {
        VkPipeline handle = VK_NULL_HANDLE;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        ObjectOwner owner;  ///< one of several
    };
    /// Null if there is none.
    const Entry* find(const std::string& description) const;
    void keep(const std::string& description, Entry entry);

  private:
    std::map<std::string, Entry> mEntries;
};

}  // namespace brume::gpu
