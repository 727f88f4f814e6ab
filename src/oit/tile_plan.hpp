// SPDX-License-Identifier: Apache-2.0
// Which tiles a pass visits: lists of tiles, made by the host or, within a frame, by the device.
#pragma once

#include <oit/inputs.hpp>

#include <gpu/pipeline.hpp>

#include <span>

namespace brume::oit {

/// A tile list of shaders/oit/tile/tile.h.
class TileList {
  public:
    TileList() = default;
    /// Of these tiles.
    TileList(gpu::Device& device, const std::string& name, std::span<const std::uint32_t> tiles,
             std::uint32_t threadsPerTile);
    /// Empty, with room for some; TilePlan fills it.
    TileList(gpu::Device& device, const std::string& name, std::uint32_t capacity,
             std::uint32_t threadsPerTile);

    const gpu::Buffer& buffer() const { return mBuffer; }
    std::uint32_t threadsPerTile() const { return mThreadsPerTile; }
    void declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass) const;
    /// As many workgroups of 64 invocations as its tiles need.
    void dispatch(gpu::Commands& commands) const { commands.dispatchIndirect(mBuffer); }
    /// One invocation per tile.
    void dispatchPerTile(gpu::Commands& commands) const;

  private:
    gpu::Buffer mBuffer;
    std::uint32_t mThreadsPerTile = 0;
};

/// Lists tiles by what classify has found that they need, without the host. Where a frame has no
/// tile of a class, the passes that visit its list do no work.
class TilePlan {
  public:
    TilePlan(gpu::Device& device, const std::string& name, std::uint32_t tileCount);

    /// Adds a pass that fills the list with the tiles whose classes are in the mask.
    void declareList(frame::FrameBuilder& frame, const gpu::Buffer& classes,
                     std::uint32_t classMask, const TileList& list) const;
    /// The same for the tile map of pixel lists (shaders/oit/linked_list/lists.h).
    void declareMap(frame::FrameBuilder& frame, const gpu::Buffer& classes,
                    std::uint32_t classMask, const gpu::Buffer& tileMap) const;

  private:
    std::string mName;
    std::uint32_t mTileCount;
    gpu::ComputePipeline mList, mMap, mArguments;
};

}  // namespace brume::oit
