// SPDX-License-Identifier: Apache-2.0
// What: exact order-independent transparency by per-pixel lists of thin surfaces and medium
//       intervals, sorted by distance and integrated front to back; overlapping media add up.
// Source: P. Barta, B. Kovacs: "Order Independent Transparency with Per-Pixel Linked Lists",
//         Central European Seminar on Computer Graphics, 2011.
// Equations: section 2 -> crossConstant(), crossVarying(); section 3.5 -> walkConstant(),
//         findSolidsAroundEye().
// Differs: sums of extinction and source with an integer count of open media instead of running
//         albedo quotients (those give 0/0 in free space and leave a residue that hides the sky);
//         a list is a contiguous array, counted before it is stored, so that its memory is known
//         and nothing is lost; media are found per screen tile in compute and stored as 8 bytes
//         (distance, index), from which the resolve intersects again, in double where the device
//         has it: fp32 distances are thicker than what dense media need; only triangles are rastered.
// Limits: more than some ten thousand varying media open at once at a pixel exceed what devices
//         that cap loop iterations do in one dispatch (counter "exhausted" > 0: not exact there).
//         Without shaderFloat64, media with optical depths of order 1 within 1e-6 of their distance
//         (sheets, rims) are off by up to 1e-4.
// Cost: 8 bytes per interval and surface, 52 more per surface, 16 per pixel and band; where lists
//         need several rounds to resolve, 212 more per pixel and band.
#pragma once

#include <oit/media_bins.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/linked_list/lists.h>

namespace brume::oit {

struct LinkedListSettings {
    std::uint64_t budgetBytes = 1024ull << 20;  ///< for list entries and surface records together
};

class LinkedList final : public OitMethod {
  public:
    LinkedList(gpu::Device& device, const Inputs& inputs, const LinkedListSettings& settings);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction& measure) override;
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override;
    std::map<std::string, std::uint64_t> bytes() const override;

  private:
    /// A run of tiles whose lists fit into the budget together.
    struct Band {
        std::uint32_t firstTile = 0;
        std::uint32_t tileCount = 0;
        std::uint64_t entryCount = 0;
        std::uint64_t recordCount = 0;
    };

    void planBands();
    /// Finds out in how many rounds the longest list is resolved.
    void planRounds(const MeasureFunction& measure);
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
    void declareResolve(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band);
    void declareSurfaces(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                         const char* stage, const gpu::GraphicsPipeline& pipeline);
    shader::ListPush makePush(const Band& band) const;

    gpu::Device* mDevice;
    LinkedListSettings mSettings;
    Needs mNeeds;
    std::uint32_t mTileCount;
    MediaBins mBins;
    gpu::PrefixSum mPrefixSum;
    gpu::ComputePipeline mCount, mStore, mResolve, mTotals;
    gpu::GraphicsPipeline mSurfaceCount, mSurfaceStore;
    std::vector<Band> mBands;
    std::uint64_t mSurfacesStored = 0, mLongest = 0;
    std::uint32_t mSliceCount = 1, mRoundCount = 1;
    gpu::Buffer mOffsets, mSums, mSurfaceOffsets, mSurfaceCursors, mProgress, mEntries, mRecords;
    gpu::Buffer mStates;
    gpu::Buffer mCounters, mCountersRead, mTileTotals, mTileTotalsRead;
    gpu::Buffer mBandTotals, mBandTotalsRead;
};

}  // namespace brume::oit
