// SPDX-License-Identifier: Apache-2.0
// The pipelines with which PixelLists counts, stores and resolves.
#pragma once

#include <oit/oit_method.hpp>

#include <span>
#include <string>
#include <vector>

namespace brume::oit {

/// What the shaders may take for granted of a frame's lists.
struct ListTraits {
    bool isAlone = false;  ///< thin surfaces alone, in lists that are known to be short: other
                           ///< records, another resolve (shaders/oit/linked_list/lists.h)
    bool isOneBand = false;    ///< all tiles' lists are in memory at once
    bool isEveryTile = false;  ///< all tiles of the screen have lists: slot s is tile s
    bool isOneRound = true;    ///< each list is resolved in one dispatch
};

class ListPipelines {
  public:
    /// `name`: as for PixelLists.
    ListPipelines(gpu::Device& device, const std::string& name, const Needs& needs);

    void makeSurfaceCount(const ListTraits& traits);
    /// `mayLackRoom`: memory has been reserved without knowing what the frame wants.
    void makeStores(const ListTraits& traits, bool mayLackRoom);
    void makeResolve(const ListTraits& traits);

    /// Of media; those of surfaces are empty where the scene has none.
    const gpu::ComputePipeline& count() const { return mCount; }
    const gpu::GraphicsPipeline& surfaceCount() const { return mSurfaceCount; }
    const gpu::ComputePipeline& store() const { return mStore; }
    const gpu::GraphicsPipeline& surfaceStore() const { return mSurfaceStore; }
    const gpu::ComputePipeline& resolve() const { return mResolve; }

  private:
    std::vector<std::uint32_t> surfaceConstants(const ListTraits& traits) const;
    gpu::ComputePipeline makeCompute(const char* stage, std::span<const std::uint32_t> spirv,
                                     const std::vector<gpu::Binding>& images,
                                     std::vector<std::uint32_t> specialization,
                                     std::vector<gpu::NumberedConstant> constants = {}) const;
    gpu::GraphicsPipeline makeSurface(const char* stage, std::span<const std::uint32_t> spirv,
                                      const ListTraits& traits) const;

    gpu::Device* mDevice;
    std::string mName;
    Needs mNeeds;
    gpu::ComputePipeline mCount, mStore, mResolve;
    gpu::GraphicsPipeline mSurfaceCount, mSurfaceStore;
};

}  // namespace brume::oit
