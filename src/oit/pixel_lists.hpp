// SPDX-License-Identifier: Apache-2.0
// Sorted lists of thin surfaces and medium intervals for each pixel of some tiles, resolved
// exactly: method linked_list for all tiles, the exact fallback of method tile for a few.
#pragma once

#include <oit/list_memory.hpp>
#include <oit/list_pipelines.hpp>
#include <oit/oit_method.hpp>

#include <span>

namespace brume::oit {

/// The setting of methods that plan their frames.
inline constexpr scene::SettingInfo kEveryFrameInfo{
    "everyFrame", "true, false", "false",
    "plan each frame on the device, as within a host's frame, not once by a frame before"};

/// Where a method has reserved memory but frames can be measured: reserves more until one fits.
void growBy(OitMethod& method, const OitMethod::MeasureFunction& measure,
            const std::function<void()>& reserve);

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

    /// Instead of setTiles(): any of the screen's tiles may have lists, and passes ahead of
    /// declare() say which in tileMap().
    void setAnyTiles(std::uint32_t screenTileCount);
    /// Instead of prepare(): reserves memory without measuring, by what the last finished frame
    /// wanted, if there is one, and for at least `blocksPerTile` blocks of 64 bytes for each tile
    /// of the screen; within the budget.
    void reserve(std::uint32_t blocksPerTile);
    /// shaders/oit/linked_list/lists.h
    const gpu::Buffer& tileMap() const { return mMemory.tileMap(); }

    /// Writes the pixels of its tiles. `isFirstWriter`: no pass before has written the result.
    void declare(frame::FrameBuilder& frame, const Inputs& inputs, bool isFirstWriter);
    std::map<std::string, std::uint64_t> counters();
    /// The most that a pixel of the last finished frame misses.
    double errorBound();
    std::map<std::string, std::uint64_t> bytes() const;

  private:
    using Visit = ListMemory::Visit;
    struct Memory {
        std::uint64_t blocks = 0;
        std::uint32_t bandCount = 1;
    };

    Memory planMemory() const;
    /// Finds out in how many rounds the longest list is resolved.
    void planRounds(const OitMethod::MeasureFunction& measure);
    void setRounds(std::uint32_t count);
    std::uint32_t sliceCountFor(std::uint32_t mediaCount) const;
    std::uint64_t unvisitedMedia() const;
    ListTraits traits() const;
    /// ListTraits::isAlone; the memory takes other records then.
    void setAlone(bool isAlone);
    /// One frame that counts, to know what memory the lists take.
    void measureLengths(const OitMethod::MeasureFunction& measure);
    void declareCount(frame::FrameBuilder& frame, const Inputs& inputs);
    /// Completes a pass in which each invocation visits the media of its column of pixels.
    void declareMedia(frame::FrameBuilder& frame, const Inputs& inputs, std::uint32_t band,
                      frame::PassBuilder& pass, const gpu::ComputePipeline& pipeline);
    void declareStore(frame::FrameBuilder& frame, const Inputs& inputs, std::uint32_t band);
    void declareResolve(frame::FrameBuilder& frame, const Inputs& inputs, std::uint32_t band,
                        bool isFirstWriter);
    void declareSurfaces(frame::FrameBuilder& frame, const Inputs& inputs, std::uint32_t band,
                         const char* stage, const gpu::GraphicsPipeline& pipeline);
    shader::ListPush makePush(std::uint32_t band) const;

    gpu::Device* mDevice;
    std::string mName;
    std::uint64_t mBudgetBytes;
    float mEpsilon;
    Needs mNeeds;
    MediaBins* mBins;
    ListMemory mMemory;
    ListPipelines mPipelines;
    std::uint32_t mSliceCount = 1, mRoundCount = 1;
    bool mIsAlone = false;
    gpu::Buffer mStates;
};

}  // namespace brume::oit
