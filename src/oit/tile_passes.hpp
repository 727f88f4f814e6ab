// SPDX-License-Identifier: Apache-2.0
// The passes over tiles of which method tile (tile.cpp) puts its frames together.
#pragma once

#include <oit/media_bins.hpp>
#include <oit/tile_plan.hpp>

#include <shaders/oit/tile/tile.h>
#include <shaders/shadows/common/maps.h>

#include <array>

namespace brume::oit::tile {

struct Settings {
    float epsilon = 1.f / 1024;                 ///< transmittance at which a pixel stops; 0: exact
    std::uint64_t budgetBytes = 1024ull << 20;  ///< for lists
    bool overlap = true;                        ///< false: spheres count as one behind the other
    bool everyFrame = false;  ///< plan each frame, on the device, also where measuring is possible
};

/// Tiles that one pipeline visits.
struct Group {
    gpu::ComputePipeline pipeline;
    std::uint32_t threadsPerTile = 0;
    std::uint32_t tileClass = shader::kClassEmpty;  ///< whose tiles it takes
    std::uint32_t tileCount = 0;                    ///< where the host has planned
    TileList tiles;
};

/// Passes over mixtures, by the sizes of their windows.
inline constexpr std::size_t kMixCount = shader::kClassLists - shader::kClassMix;
using Groups = std::array<Group*, 2 + kMixCount>;

/// Bins, pipelines and what they share on the device.
class Passes {
  public:
    Passes(gpu::Device& device, const Inputs& inputs, const Settings& settings);

    /// Sources are worked out once per ray: for a few media, where light is the same everywhere.
    bool canComposite() const {
        return !mNeeds.varyingLight && (mNeeds.oneSource || mNeeds.media <= shader::kTileMedia);
    }
    bool canMix() const {
        return canComposite() && !mNeeds.oneSource && mNeeds.uniformSpheres && mSettings.overlap;
    }
    /// Large shaders that few scenes need: made when there are tiles for them. Makes room for all
    /// pairs as well.
    void prepareMixed(std::size_t window);

    MediaBins& bins() { return mBins; }
    const MediaBins& bins() const { return mBins; }
    /// Classify visits the whole screen, until told to forget.
    void setAll();
    void forgetAll() { mAll.tiles = {}; }
    void setTiles(Group& group, const std::vector<std::uint32_t>& tiles) const;
    Group& ordered() { return mOrdered; }
    Group& volumes() { return mVolumes; }
    Group& mixed(std::size_t window) { return mMixed[window]; }
    /// In the order in which they are to be visited.
    Groups all();

    const gpu::Buffer& classes() const { return mClasses; }
    const gpu::Buffer& counters() const { return mCounters; }
    gpu::Buffer makeBuffer(const char* stage, std::uint64_t bytes,
                           gpu::MemoryKind memory = gpu::MemoryKind::Device) const;

    /// Clears the classes, and marks the tiles where there are surfaces.
    void declareMark(frame::FrameBuilder& frame, const Inputs& inputs);
    void declareClassify(frame::FrameBuilder& frame, const Inputs& inputs);
    /// Lists the spheres of mixed tiles in the orders in which the rays through their middles meet
    /// them.
    void declareOrder(frame::FrameBuilder& frame, const Inputs& inputs, std::size_t window);
    void declareComposite(frame::FrameBuilder& frame, const Inputs& inputs, Group& group,
                          bool isFirstWriter);

    std::map<std::string, std::uint64_t> bytes() const;

  private:
    gpu::ComputePipeline makePipeline(const char* stage, std::span<const std::uint32_t> spirv,
                                      const std::vector<gpu::Binding>& own,
                                      const std::vector<std::uint32_t>& specialization = {}) const;
    /// Double precision shows where media are dense, and not beside what an early stop leaves out.
    std::span<const std::uint32_t> choose(std::span<const std::uint32_t> float32,
                                          std::span<const std::uint32_t> float64) const {
        return mSettings.epsilon == 0 && mDevice->features().shaderFloat64 ? float64 : float32;
    }
    /// Bricks one behind the other, in one go: not where each look at a light walks its casters,
    /// which may take more loops than devices grant an invocation.
    bool canLightVolumes() const {
        return mNeeds.boxes && mNeeds.oneMedium && !mNeeds.oneSource &&
               (mNeeds.shadowStores & shader::kStoreExact) == 0;
    }
    void makeVolumes();
    void makeMark();
    shader::TilePush makePush(const TileList& tiles) const;

    gpu::Device* mDevice;
    Settings mSettings;
    Needs mNeeds;
    std::uint32_t mTileCount;
    MediaBins mBins;
    Group mAll, mOrdered, mVolumes;  // mAll: those that classify visits
    std::array<Group, kMixCount> mMixed;
    std::array<gpu::ComputePipeline, kMixCount> mOrders;
    gpu::ComputePipeline mClassifyBoxes;
    gpu::GraphicsPipeline mMark;
    gpu::Buffer mClasses, mCounters;
    gpu::Buffer mSphereEnds;  ///< uint[pairs], if media mix
};

}  // namespace brume::oit::tile
