// SPDX-License-Identifier: Apache-2.0
// The media of a frame, sorted front to back and binned to screen tiles.
#pragma once

#include <gpu/prefix_sum.hpp>
#include <gpu/radix_sort.hpp>
#include <oit/inputs.hpp>

#include <algorithm>
#include <optional>

namespace brume::oit {

/// For reserve() before anything is known.
inline constexpr std::uint32_t kReservedPairsPerTile = 64;

/// How many screen tiles cover an image.
std::uint32_t countTiles(VkExtent2D extent);

/// Count, scan, scatter: what memory the tiles' lists want is known before any of it is written.
/// Where they have less, each tile keeps the same share of its list, nearly its nearest media.
/// If the lists are sorted, media stand in the order of their smallest possible distances; else
/// spheres nearly so, and boxes in any order. What something opaque hides from all of a tile is not
/// in its list.
class MediaBins {
  public:
    /// `name` of the passes' prefix, e.g. "oit.linked_list".
    MediaBins(gpu::Device& device, const std::string& name, const Inputs& inputs,
              bool areListsSorted = false);

    /// Pass "<name>.bin": sorts, and counts how many media touch each tile.
    void declareCount(frame::FrameBuilder& frame, const Inputs& inputs);
    /// Makes room for the lists as the last finished frame wanted them. A frame that has declared
    /// the count alone is enough.
    void allocate() { reserve(0); }
    /// Likewise, with some more; at least `pairs` for spheres and for boxes where there are any.
    void reserve(std::uint64_t pairs);
    /// Pass "<name>.scatter": fills the tiles' lists.
    void declareScatter(frame::FrameBuilder& frame, const Inputs& inputs);

    /// Must be declared as read by passes that use the addresses below.
    void declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass) const;
    /// For passes that bring the tiles' lists of spheres into another order.
    void declareReorders(frame::FrameBuilder& frame, frame::PassBuilder& pass) const;

    /// What the lists' indices mean.
    const gpu::Buffer& sortedSpheres() const { return mSortedSpheres; }
    const gpu::Buffer& listedBoxes(const Inputs& inputs) const {
        return mBoxSort ? mSortedBoxes : *inputs.boxes;
    }
    struct List {
        VkDeviceAddress offsets = 0;  ///< uint[tiles + 1], within the memory
        VkDeviceAddress pairs = 0;    ///< uint[], indices into the sorted spheres or the boxes
    };
    List spheres() const { return listOf(mSpheres); }
    List boxes() const { return listOf(mBoxes); }
    /// Spheres or boxes, whichever are more.
    std::uint32_t mediaCount() const { return std::max(mSpheres.count, mBoxes.count); }
    /// Of the last finished frame: what its lists wanted, and how much of that had no room.
    std::uint64_t pairCount() const;
    std::uint64_t droppedPairs() const;
    /// Room for pairs of tile and sphere.
    std::uint32_t sphereCapacity() const { return mSpheres.capacity; }
    /// Spheres or boxes of the tile that wants most of them.
    std::uint32_t longestList() const;
    /// shader::BinTotals[2], of spheres and boxes, on the device.
    const gpu::Buffer& totals() const { return mTotals; }
    std::uint64_t bytes() const;
    /// Of the lists themselves; part of bytes().
    std::uint64_t pairBytes() const { return mSpheres.pairs.bytes() + mBoxes.pairs.bytes(); }

  private:
    struct Set {
        std::uint32_t count = 0;
        gpu::ComputePipeline binCount, binScatter;
        VkDeviceAddress keys = 0;  ///< sorted, where they tell distances
        gpu::Buffer rects, wanted, fitted, cursors, sums, pairs;
        std::uint32_t capacity = 1;  ///< pairs
    };
    static List listOf(const Set& set) {
        return {set.fitted.deviceAddress(), set.pairs.deviceAddress()};
    }
    Set makeSet(gpu::Device& device, const std::string& name, std::uint32_t count,
                std::uint32_t keyKind) const;
    void recordLimits(gpu::Commands& commands, const Inputs& inputs,
                      const gpu::Image& opaqueT) const;
    void recordSort(gpu::Commands& commands, const Inputs& inputs,
                    const gpu::Buffer& spheres) const;
    void recordCount(gpu::Commands& commands, const Inputs& inputs, const Set& set) const;
    void recordBoxes(gpu::Commands& commands, const Inputs& inputs) const;
    void recordSortLists(gpu::Commands& commands, const Inputs& inputs, const Set& set) const;
    void recordFit(gpu::Commands& commands, const Set& set) const;
    std::uint32_t countSlices(std::uint32_t mediaCount) const;
    void recordBin(gpu::Commands& commands, const Inputs& inputs, const Set& set,
                   const gpu::ComputePipeline& pipeline) const;

    gpu::Device* mDevice;
    std::string mName;
    std::uint32_t mTileCount;
    gpu::ComputePipeline mIdentityKeys, mDistanceKeys, mGather, mBoxRects, mTileLimits;
    gpu::ComputePipeline mBoxKeys, mSortLists, mFit;
    gpu::PrefixSum mPrefixSum;
    std::optional<gpu::RadixSort> mSort, mBoxSort;
    gpu::Buffer mKeys, mValues, mSortedSpheres, mBoxKeyValues, mBoxValues, mSortedBoxes;
    gpu::Buffer mLimits, mTotals, mTotalsRead;
    Set mSpheres, mBoxes;
};

}  // namespace brume::oit
