// SPDX-License-Identifier: Apache-2.0
// The memory of pixel lists, and how a frame's lists share it: decided on the device, so that
// nobody waits for counts.
#pragma once

#include <oit/media_bins.hpp>

#include <shaders/oit/linked_list/lists.h>

#include <span>

namespace brume::oit {

/// Bytes per list of a tile are known once its media and surfaces are counted. Tiles whose lists
/// fit into the memory together are a band; one band after the other is stored and resolved. All
/// bands are recorded: those that a frame does not need do no work. What the bands cannot hold is
/// dropped and counted: each tile and each pixel then keeps the same share of its list.
class ListMemory {
  public:
    ListMemory(gpu::Device& device, const std::string& name, const Needs& needs,
               const MediaBins& bins);

    /// Which tiles have lists, the same in every frame; at least one.
    void setTiles(std::span<const std::uint32_t> tiles, std::uint32_t screenTileCount);
    /// Any of the screen's tiles may have lists: passes ahead of declareBegin() fill tileMap().
    void setAnyTiles(std::uint32_t screenTileCount);
    /// Lists have entries, and records of so many bytes.
    void setRecordBytes(std::uint32_t bytes) {
        mRecordBytes = bytes;
        mRecordWords = 0;
    }
    /// Lists have no entries, and records of so many words (shaders/oit/linked_list/lists.h).
    void setRecordWords(std::uint32_t words) { mRecordWords = words; }
    /// Makes the memory for lists that `bandCount` bands use one after the other.
    void allocate(std::uint64_t blocks, std::uint32_t bandCount);

    /// Pass "<name>.clear": nothing is counted yet; how many tiles band 0 has.
    void declareBegin(frame::FrameBuilder& frame, const Inputs& inputs);
    /// Pass "<name>.place", after the lists' lengths are counted in offsets().
    void declarePlace(frame::FrameBuilder& frame);
    void declareReadback(frame::FrameBuilder& frame);

    /// As shaders/oit/linked_list/lists.h; band 0: all tiles.
    shader::ListPush makePush(std::uint32_t band) const;
    enum class Visit { Columns, LaterColumns, Pixels };
    void dispatch(gpu::Commands& commands, std::uint32_t band, Visit visit) const;
    /// Draws surface i of the inputs, if the band has tiles.
    void draw(gpu::Commands& commands, std::uint32_t band, std::uint32_t surface) const;
    /// Must be declared as read by passes that use the push or one of the two above.
    void declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass,
                      frame::Access access) const;

    std::uint32_t bandCount() const { return mBandCount; }
    /// setTiles() has got all tiles of the screen in their order: slot s is tile s.
    bool hasEveryTile() const { return mHasEveryTile; }
    std::uint32_t slotCapacity() const { return mSlotCapacity; }
    std::uint64_t blocks() const { return mBlockCount; }
    const gpu::Buffer& tileMap() const { return mTileMap; }
    const gpu::Buffer& offsets() const { return mOffsets; }
    const gpu::Buffer& surfaceOffsets() const { return mSurfaceOffsets; }
    const gpu::Buffer& surfaceCursors() const { return mSurfaceCursors; }
    const gpu::Buffer& progress() const { return mProgress; }
    const gpu::Buffer& lists() const { return mLists; }
    const gpu::Buffer& countersBuffer() const { return mCounters; }

    /// Of the last finished frame.
    shader::ListCounters counters() const;
    std::map<std::string, std::uint64_t> bytes() const;

  private:
    void allocateSlots(std::uint32_t screenTileCount, gpu::MemoryKind mapMemory);
    gpu::Buffer makeBuffer(const char* stage, std::uint64_t bytes,
                           gpu::MemoryKind memory = gpu::MemoryKind::Device) const;
    gpu::ComputePipeline makePipeline(const char* stage, std::span<const std::uint32_t> spirv,
                                      std::vector<std::uint32_t> specialization = {}) const;
    shader::PlacePush makePlacePush() const;
    void recordPlace(gpu::Commands& commands) const;

    gpu::Device* mDevice;
    std::string mName;
    bool mHasSurfaces, mHasEveryTile = false;
    std::uint32_t mRecordBytes = 0, mRecordWords = 0;
    const MediaBins* mBins;
    gpu::PrefixSum mPrefixSum;
    gpu::ComputePipeline mBegin, mTotals, mPlace, mBandArguments;
    std::uint32_t mSlotCapacity = 0, mBandCount = 1, mDrawCount = 0;
    std::uint64_t mBlockCount = 0;
    gpu::Buffer mTileMap, mTiles, mOffsets, mSurfaceOffsets, mSurfaceCursors, mProgress;
    gpu::Buffer mBlocks, mSums, mBands, mDraws, mLists, mCounters, mCountersRead;
};

}  // namespace brume::oit
