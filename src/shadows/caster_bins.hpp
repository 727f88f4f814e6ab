// SPDX-License-Identifier: Apache-2.0
// The casters of a map, binned to its tiles.
#pragma once

#include <frame/frame_builder.hpp>
#include <gpu/prefix_sum.hpp>
#include <gpu/radix_sort.hpp>
#include <shadows/casters.hpp>

#include <shaders/shadows/common/maps.h>

#include <array>
#include <memory>

namespace brume::shadows {

/// Which casters a map has.
enum class CasterChoice { Opaque, Translucent, All };

/// The most casters that a tile has.
struct ListLengths {
    std::uint64_t spheres = 0, boxes = 0;
};

/// Casters sorted by distance, then pairs of tile and caster sorted by tile: no atomics, so that
/// every list is the same in every run and whatever the order of submission.
class CasterBins {
  public:
    CasterBins(gpu::Device& device, const Casters& casters, CasterChoice choice,
               const shader::ShadowMap& map);

    /// Counts the pairs; after that frame, allocate() makes room for them.
    void declareCount(frame::FrameBuilder& frame, const gpu::Buffer& mapBuffer,
                      frame::BufferRef spheres);
    void allocate(shader::ShadowMap& map);
    /// Adds declare() and reads the lists' lengths back: after that frame longestLists() are known.
    void declareLengths(frame::FrameBuilder& frame, const gpu::Buffer& mapBuffer,
                        frame::BufferRef spheres);
    /// After reserve() those of the newest finished frame, and half as much again.
    ListLengths longestLists() const;
    /// uint per texel of the map, for passes in rounds.
    const gpu::Buffer& progress() const { return mProgress; }
    /// Instead of counting first: room for that many pairs of each kind of caster. Frames then sort
    /// what the newest finished frame had and half as much again; what does not fit casts no shadow
    /// and is counted.
    void reserve(shader::ShadowMap& map, std::uint32_t pairs);
    /// After reserve(): pairs that the newest finished frame had no room for.
    std::uint64_t droppedPairs() const;
    /// Pass "shadow.bins": counts and fills the tiles' lists.
    void declare(frame::FrameBuilder& frame, const gpu::Buffer& mapBuffer,
                 frame::BufferRef spheres);
    void declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass) const;

    std::uint64_t bytes() const;

  private:
    struct Set {
        std::uint32_t kind = 0, first = 0, count = 0;
        std::uint32_t pairCount = 0;  // there is room for
        gpu::Buffer orderKeys, order, counts, sums, total;
        gpu::Buffer tiles, casters, starts, startsRead;
        gpu::ComputePipeline identity, distance, count_, write;
        std::unique_ptr<gpu::RadixSort> orderSort, pairSort;
    };
    Set makeSet(std::uint32_t kind, std::uint32_t first, std::uint32_t count);
    void recordCount(gpu::Commands& commands, const Set& set, VkDeviceAddress map) const;
    void recordPairs(gpu::Commands& commands, const Set& set, VkDeviceAddress map) const;
    void declareTotals(frame::FrameBuilder& frame);
    void makeStartsRead();
    void declareStartsRead(frame::FrameBuilder& frame);
    void setRoom(Set& set, std::uint32_t pairs);
    void setAddresses(shader::ShadowMap& map) const;
    std::uint32_t pairsToSort(const Set& set) const;
    void run(gpu::Commands& commands, const gpu::ComputePipeline& pipeline,
             const shader::ShadowBinPush& push, std::uint32_t threads) const;

    gpu::Device* mDevice;
    const Casters* mCasters;
    std::uint32_t mTileCount;
    bool mIsReserved = false;
    gpu::PrefixSum mPrefixSum;
    gpu::ComputePipeline mStarts;
    gpu::Buffer mProgress;
    std::array<Set, 3> mSets;  // spheres, boxes, triangles
};

}  // namespace brume::shadows
