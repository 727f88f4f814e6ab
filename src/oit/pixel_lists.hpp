// SPDX-License-Identifier: Apache-2.0
// Sorted lists of thin surfaces and medium intervals for each pixel of some tiles, resolved
// exactly: method linked_list for all tiles, the exact fallback of method tile for a few.
#pragma once

#include <oit/media_bins.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/linked_list/lists.h>

#include <span>

namespace brume::oit {

class PixelLists {
  public:
    /// `name`: prefix of the passes, e.g. "oit.linked_list". `budgetBytes`: for list entries and
    /// surface records together; beyond it the tiles are rendered in bands. `bins` are the
    /// caller's, who declares them ahead of declare(). `epsilon`: radiance that a pixel may miss where
    /// it stops early; 0: none.
    PixelLists(gpu::Device& device, const std::string& name, const Needs& needs,
               std::uint64_t budgetBytes, MediaBins& bins, float epsilon = 0);

    /// Which tiles have lists; at least one. Before prepare().
    void setTiles(std::span<const std::uint32_t> tiles, std::uint32_t screenTileCount);
    /// Measures and allocates; the bins must be allocated. Throws an input Error if the budget
    /// cannot hold the lists of one tile.
    void prepare(const OitMethod::MeasureFunction& measure);
    /// Writes the pixels of its tiles. `isFirstWriter`: no pass before has written the result.
    void declare(frame::FrameBuilder& frame, const Inputs& inputs, bool isFirstWriter);
    std::map<std::string, std::uint64_t> counters();
    /// The most that a pixel of the last finished frame misses.
    double errorBound();
    std::map<std::string, std::uint64_t> bytes() const;

  private:
    /// A run of tiles whose lists fit into the budget together.
    struct Band {
        std::uint32_t firstSlot = 0;  ///< of the tiles that have lists
        std::uint32_t tileCount = 0;
        std::uint64_t entryCount = 0;
        std::uint64_t recordCount = 0;
    };

    void planBands();
    /// Finds out in how many rounds the longest list is resolved.
    void planRounds(const OitMethod::MeasureFunction& measure);
    gpu::ComputePipeline makeResolve() const;
    void allocateForBands();
    void declareClear(frame::FrameBuilder& frame, const Band& band);
    void declareCount(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band);
    void declareTotals(frame::FrameBuilder& frame, const Inputs& inputs);
    void declareScan(frame::FrameBuilder& frame, const Band& band);
    /// Completes a pass in which each invocation visits the media of its column of pixels.
    void declareMedia(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                      frame::PassBuilder& pass, const gpu::ComputePipeline& pipeline);
    void declareStore(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band);
    void declareResolve(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                        bool isFirstWriter);
    void declareSurfaces(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                         const char* stage, const gpu::GraphicsPipeline& pipeline);
    gpu::Buffer makeBuffer(const char* stage, std::uint64_t bytes,
                           gpu::MemoryKind memory = gpu::MemoryKind::Device) const;
    shader::ListPush makePush(const Band& band) const;

    gpu::Device* mDevice;
    std::string mName;
    std::uint64_t mBudgetBytes;
    float mEpsilon;
    Needs mNeeds;
    MediaBins* mBins;
    std::uint32_t mTileCount = 0;
    gpu::PrefixSum mPrefixSum;
    gpu::ComputePipeline mCount, mStore, mResolve, mTotals;
    gpu::GraphicsPipeline mSurfaceCount, mSurfaceStore;
    std::vector<Band> mBands;
    std::uint64_t mSurfacesStored = 0, mLongest = 0;
    std::uint32_t mSliceCount = 1, mRoundCount = 1;
    gpu::Buffer mTileMap, mOffsets, mSums, mSurfaceOffsets, mSurfaceCursors, mProgress, mLists;
    gpu::Buffer mStates;
    gpu::Buffer mCounters, mCountersRead, mTileTotals, mTileTotalsRead;
    gpu::Buffer mBandTotals, mBandTotalsRead;
};

}  // namespace brume::oit
