// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <oit/bindings.hpp>
#include <oit/media_bins.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <shaders/common/sphere.h>
#include <shaders/oit/media_bins/bins.h>
#include <spv/oit/media_bins/bin.comp.hpp>
#include <spv/oit/media_bins/box_keys.comp.hpp>
#include <spv/oit/media_bins/box_rects.comp.hpp>
#include <spv/oit/media_bins/fit.comp.hpp>
#include <spv/oit/media_bins/gather.comp.hpp>
#include <spv/oit/media_bins/keys.comp.hpp>
#include <spv/oit/media_bins/sort.comp.hpp>
#include <spv/oit/media_bins/tile_limits.comp.hpp>

#include <algorithm>

namespace brume::oit {
namespace {

using frame::Access;

gpu::ComputePipeline makePipeline(gpu::Device& device, const std::string& name,
                                  std::span<const std::uint32_t> spirv,
                                  std::vector<gpu::Binding> own,
                                  std::vector<std::uint32_t> specialization = {}) {
    return {device,
            {.name = name,
             .spirv = spirv,
             .bindings = join(frameBindings(), own),
             .pushConstantBytes = sizeof(shader::BinPush),
             .specialization = std::move(specialization)}};
}

const gpu::Binding kSpheresBinding{shader::kBindingSpheres, gpu::BindingType::StorageBuffer};

const std::vector<gpu::Binding> kBoxBindings = {
    {shader::kBindingBoxes, gpu::BindingType::StorageBuffer},
    {shader::kBindingVolumes, gpu::BindingType::StorageBuffer}};

gpu::Buffer makeUints(gpu::Device& device, const std::string& name, std::uint64_t count) {
    return {device, {.name = name, .bytes = 4 * std::max<std::uint64_t>(count, 1)}};
}

}  // namespace

std::uint32_t countTiles(VkExtent2D extent) {
    return (extent.width + shader::kTileSize - 1) / shader::kTileSize *
           ((extent.height + shader::kTileSize - 1) / shader::kTileSize);
}

MediaBins::MediaBins(gpu::Device& device, const std::string& name, const Inputs& inputs,
                     bool areListsSorted)
    : mDevice(&device),
      mName(name),
      mTileCount(countTiles(inputs.extent)),
      mIdentityKeys(makePipeline(device, name + ".identity_keys", spv::oit_media_bins_keys_comp,
                                 {kSpheresBinding}, {1})),
      mDistanceKeys(makePipeline(device, name + ".distance_keys", spv::oit_media_bins_keys_comp,
                                 {kSpheresBinding}, {0})),
      mGather(makePipeline(
          device, name + ".gather", spv::oit_media_bins_gather_comp,
          {kSpheresBinding, {shader::kBindingSortedSpheres, gpu::BindingType::StorageBuffer}})),
      mBoxRects(makePipeline(
          device, name + ".box_rects", spv::oit_media_bins_box_rects_comp,
          join(kBoxBindings, {{shader::kBindingSortedBoxes, gpu::BindingType::StorageBuffer}}),
          {areListsSorted && inputs.boxCount > 0})),
      mTileLimits(makePipeline(
          device, name + ".tile_limits", spv::oit_media_bins_tile_limits_comp,
          {{shader::kBindingOpaqueT, gpu::BindingType::SampledImage}})),
      mPrefixSum(device) {
    const std::uint64_t sphereBytes = std::max(inputs.sphereCount, 1u) * sizeof(shader::SphereData);
    if (areListsSorted)
        mSortLists = makePipeline(device, name + ".sort_lists", spv::oit_media_bins_sort_comp, {});
    if (areListsSorted && inputs.boxCount > 0) {
        mBoxKeys = makePipeline(device, name + ".box_keys", spv::oit_media_bins_box_keys_comp,
                                kBoxBindings);
        mBoxSort.emplace(device, name + ".box_sort", inputs.boxCount);
        mBoxKeyValues = makeUints(device, name + ".box_keys", inputs.boxCount);
        mBoxValues = makeUints(device, name + ".box_values", inputs.boxCount);
        mSortedBoxes = {device,
                        {.name = name + ".sorted_boxes",
                         .bytes = std::uint64_t{inputs.boxCount} * sizeof(shader::BoxData)}};
    }
    if (inputs.sphereCount > 0) mSort.emplace(device, name + ".sort", inputs.sphereCount);
    mKeys = makeUints(device, name + ".keys", inputs.sphereCount);
    mValues = makeUints(device, name + ".values", inputs.sphereCount);
    mSortedSpheres = {device, {.name = name + ".sorted_spheres", .bytes = sphereBytes}};
    mLimits = makeUints(device, name + ".limits", mTileCount);
    mFit = {device,
            {.name = name + ".fit",
             .spirv = spv::oit_media_bins_fit_comp,
             .pushConstantBytes = sizeof(shader::FitPush)}};
    constexpr std::uint64_t kTotalsBytes = 2 * sizeof(shader::BinTotals);
    mTotals = {device, {.name = name + ".bin_totals", .bytes = kTotalsBytes}};
    mTotalsRead = {device,
                   {.name = name + ".bin_totals_read",
                    .bytes = kTotalsBytes,
                    .memory = gpu::MemoryKind::Readback}};
    mSpheres = makeSet(device, name + ".sphere_bins", inputs.sphereCount, shader::kKeysOfSpheres);
    mSpheres.keys = mKeys.deviceAddress();
    // Of parallel rays, boxes are sorted by their middles.
    const bool areBoxesByDistance = mBoxSort && !inputs.needs.orthographic;
    mBoxes = makeSet(device, name + ".box_bins", inputs.boxCount,
                     areBoxesByDistance ? shader::kKeysOfBoxes : shader::kKeysNothing);
    if (areBoxesByDistance) mBoxes.keys = mBoxKeyValues.deviceAddress();
}

MediaBins::Set MediaBins::makeSet(gpu::Device& device, const std::string& name,
                                  std::uint32_t count, std::uint32_t keyKind) const {
    Set set;
    set.count = count;
    set.binCount = makePipeline(device, name + ".count", spv::oit_media_bins_bin_comp, {},
                                {false, keyKind});
    set.binScatter = makePipeline(device, name + ".scatter", spv::oit_media_bins_bin_comp, {},
                                  {true, keyKind});
    set.rects = makeUints(device, name + ".rects", 2ull * count);
    set.wanted = makeUints(device, name + ".wanted", mTileCount + 1);
    set.fitted = makeUints(device, name + ".fitted", mTileCount + 1);
    set.cursors = makeUints(device, name + ".cursors", mTileCount);
    set.sums = makeUints(device, name + ".sums", gpu::PrefixSum::sumCount(mTileCount + 1));
    set.pairs = makeUints(device, name + ".pairs", 1);
    return set;
}

void MediaBins::recordLimits(gpu::Commands& commands, const Inputs& inputs,
                             const gpu::Image& opaqueT) const {
    commands.bindCompute(mTileLimits);
    bindFrame(commands, inputs);
    commands.bind(shader::kBindingOpaqueT, opaqueT, *inputs.texelSampler);
    commands.pushConstants(shader::BinPush{.limits = mLimits.deviceAddress()});
    commands.dispatch((mTileCount + 63) / 64);
}

void MediaBins::recordSort(gpu::Commands& commands, const Inputs& inputs,
                           const gpu::Buffer& spheres) const {
    const shader::BinPush push{.keys = mKeys.deviceAddress(),
                               .values = mValues.deviceAddress(),
                               .rects = mSpheres.rects.deviceAddress(),
                               .count = inputs.sphereCount};
    const std::uint32_t groups = (inputs.sphereCount + 63) / 64;
    const auto run = [&](const gpu::ComputePipeline& pipeline) {
        commands.bindCompute(pipeline);
        bindFrame(commands, inputs);
        commands.bind(shader::kBindingSpheres, spheres);
        if (&pipeline == &mGather) commands.bind(shader::kBindingSortedSpheres, mSortedSpheres);
        commands.pushConstants(push);
        commands.dispatch(groups);
        commands.computeBarrier();
    };
    run(mIdentityKeys);
    if (!inputs.sphereIdsAscend) {
        mSort->record(commands, mKeys, mValues, push.count);
        commands.computeBarrier();
    }
    run(mDistanceKeys);
    mSort->record(commands, mKeys, mValues, push.count);
    commands.computeBarrier();
    run(mGather);
}

void MediaBins::recordBoxes(gpu::Commands& commands, const Inputs& inputs) const {
    const shader::BinPush push{.keys = mBoxSort ? mBoxKeyValues.deviceAddress() : 0,
                               .values = mBoxSort ? mBoxValues.deviceAddress() : 0,
                               .rects = mBoxes.rects.deviceAddress(),
                               .count = mBoxes.count};
    const auto run = [&](const gpu::ComputePipeline& pipeline) {
        commands.bindCompute(pipeline);
        bindFrame(commands, inputs);
        commands.bind(shader::kBindingBoxes, *inputs.boxes);
        commands.bind(shader::kBindingVolumes, *inputs.volumes);
        if (&pipeline == &mBoxRects)
            commands.bind(shader::kBindingSortedBoxes, mBoxSort ? mSortedBoxes : mBoxes.rects);
        commands.pushConstants(push);
        commands.dispatch((mBoxes.count + 63) / 64);
        commands.computeBarrier();
    };
    if (mBoxSort) {
        run(mBoxKeys);
        mBoxSort->record(commands, mBoxKeyValues, mBoxValues, push.count);
        commands.computeBarrier();
    }
    run(mBoxRects);
}

void MediaBins::recordSortLists(gpu::Commands& commands, const Inputs& inputs,
                                const Set& set) const {
    commands.computeBarrier();
    commands.bindCompute(mSortLists);
    bindFrame(commands, inputs);
    commands.pushConstants(
        shader::BinPush{.counts = set.fitted.deviceAddress(), .pairs = set.pairs.deviceAddress()});
    commands.dispatch((mTileCount + 63) / 64);
}

// Where media are many, few have tiles in each of many slices.
std::uint32_t MediaBins::countSlices(std::uint32_t mediaCount) const {
    constexpr std::uint32_t kMany = 1u << 16;
    const std::uint32_t least = mTileCount / shader::kBinMostTiles + 1;
    return std::max(least, mediaCount < kMany ? 8u : 2u);
}

void MediaBins::recordBin(gpu::Commands& commands, const Inputs& inputs, const Set& set,
                          const gpu::ComputePipeline& pipeline) const {
    const bool isScatter = &pipeline == &set.binScatter;
    commands.bindCompute(pipeline);
    bindFrame(commands, inputs);
    commands.pushConstants(shader::BinPush{.keys = set.keys,
                                           .rects = set.rects.deviceAddress(),
                                           .counts = isScatter ? set.fitted.deviceAddress()
                                                               : set.wanted.deviceAddress(),
                                           .cursors = set.cursors.deviceAddress(),
                                           .pairs = set.pairs.deviceAddress(),
                                           .spheres = mSortedSpheres.deviceAddress(),
                                           .limits = mLimits.deviceAddress(),
                                           .count = set.count,
                                           .rowSlices = countSlices(set.count)});
    commands.dispatch((set.count + 63) / 64, countSlices(set.count));
}

void MediaBins::recordCount(gpu::Commands& commands, const Inputs& inputs, const Set& set) const {
    if (set.count > 0) recordBin(commands, inputs, set, set.binCount);
    commands.computeBarrier();
    mPrefixSum.record(commands, set.wanted.deviceAddress(), mTileCount + 1,
                      set.sums.deviceAddress());
    commands.computeBarrier();
    recordFit(commands, set);
}

void MediaBins::recordFit(gpu::Commands& commands, const Set& set) const {
    const std::uint64_t at = &set == &mBoxes ? sizeof(shader::BinTotals) : 0;
    commands.bindCompute(mFit);
    commands.pushConstants(shader::FitPush{.wanted = set.wanted.deviceAddress(),
                                           .fitted = set.fitted.deviceAddress(),
                                           .totals = mTotals.deviceAddress() + at,
                                           .tileCount = mTileCount,
                                           .capacity = set.capacity});
    commands.dispatch(mTileCount / 64 + 1);
}

void MediaBins::declareCount(frame::FrameBuilder& frame, const Inputs& inputs) {
    frame::PassBuilder& pass = frame.addPass(mName + ".bin");
    for (const Set* set : {&mSpheres, &mBoxes})
        for (const gpu::Buffer* buffer : {&set->wanted, &set->cursors})
            pass.writes(frame.importBuffer(*buffer), Access::TransferWrite);
    pass.writes(frame.importBuffer(mTotals), Access::TransferWrite);
    pass.reads(inputs.spheres, Access::ComputeRead).reads(inputs.opaqueT, Access::ComputeSample);
    if (mBoxSort)
        for (const gpu::Buffer* buffer : {&mBoxKeyValues, &mBoxValues, &mSortedBoxes})
            pass.writes(frame.importBuffer(*buffer), Access::ComputeWrite);
    for (const gpu::Buffer* buffer :
         {&mLimits, &mKeys, &mValues, &mSortedSpheres, &mTotals, &mSpheres.rects, &mSpheres.sums,
          &mSpheres.wanted, &mSpheres.fitted, &mBoxes.rects, &mBoxes.sums, &mBoxes.wanted,
          &mBoxes.fitted})
        pass.writes(frame.importBuffer(*buffer), Access::ComputeWrite);
    pass.record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
        for (const Set* set : {&mSpheres, &mBoxes}) {
            commands.fillBuffer(set->wanted, 0);
            commands.fillBuffer(set->cursors, 0);
        }
        commands.fillBuffer(mTotals, 0);
        commands.computeTransferBarrier();
        recordLimits(commands, inputs, resources.image(inputs.opaqueT));
        if (mSpheres.count > 0) recordSort(commands, inputs, resources.buffer(inputs.spheres));
        if (mBoxes.count > 0) recordBoxes(commands, inputs);
        recordCount(commands, inputs, mSpheres);
        recordCount(commands, inputs, mBoxes);
    });
    frame.addReadback(mName + ".bin_totals_read", frame.importBuffer(mTotals), mTotalsRead);
}

void MediaBins::reserve(std::uint64_t pairs) {
    const auto totals = mTotalsRead.mappedAs<shader::BinTotals>();
    for (Set* set : {&mSpheres, &mBoxes}) {
        const std::uint64_t wanted = totals[set == &mBoxes].pairs;
        const std::uint64_t most = 0xffffffffu;  // indices have 32 bits
        const std::uint64_t least = set->count > 0 ? pairs : 0;
        const std::uint64_t room =
            std::min(std::max(least, pairs > 0 ? wanted + wanted / 4 : wanted), most);
        set->capacity = static_cast<std::uint32_t>(std::max<std::uint64_t>(room, 1));
        const std::string name = set->pairs.name();
        set->pairs = makeUints(*mDevice, name, set->capacity);
    }
}

std::uint64_t MediaBins::pairCount() const {
    const auto totals = mTotalsRead.mappedAs<shader::BinTotals>();
    return std::uint64_t{totals[0].pairs} + totals[1].pairs;
}

std::uint64_t MediaBins::droppedPairs() const {
    const auto totals = mTotalsRead.mappedAs<shader::BinTotals>();
    std::uint64_t dropped = 0;
    for (const Set* set : {&mSpheres, &mBoxes}) {
        const std::uint32_t wanted = totals[set == &mBoxes].pairs;
        dropped += wanted - std::min(wanted, set->capacity);
    }
    return dropped;
}

std::uint32_t MediaBins::longestList() const {
    const auto totals = mTotalsRead.mappedAs<shader::BinTotals>();
    return std::max(totals[0].longest, totals[1].longest);
}

void MediaBins::declareScatter(frame::FrameBuilder& frame, const Inputs& inputs) {
    frame::PassBuilder& pass = frame.addPass(mName + ".scatter");
    for (const gpu::Buffer* buffer : {&mLimits, &mKeys})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    if (mBoxSort) pass.reads(frame.importBuffer(mBoxKeyValues), Access::ComputeRead);
    for (const Set* set : {&mSpheres, &mBoxes}) {
        for (const gpu::Buffer* buffer : {&set->rects, &set->fitted})
            pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
        pass.readsWrites(frame.importBuffer(set->cursors), Access::ComputeWrite);
        pass.writes(frame.importBuffer(set->pairs), Access::ComputeWrite);
    }
    pass.record([this, inputs](gpu::Commands& commands, const frame::PassResources&) {
        for (const Set* set : {&mSpheres, &mBoxes})
            if (set->count > 0) recordBin(commands, inputs, *set, set->binScatter);
        for (const Set* set : {&mSpheres, &mBoxes})
            if (mSortLists && set->count > 0) recordSortLists(commands, inputs, *set);
    });
}

void MediaBins::declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass) const {
    for (const gpu::Buffer* buffer :
         {&mSortedSpheres, &mSpheres.fitted, &mSpheres.pairs, &mBoxes.fitted, &mBoxes.pairs})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    if (mBoxSort) pass.reads(frame.importBuffer(mSortedBoxes), Access::ComputeRead);
}

void MediaBins::declareReorders(frame::FrameBuilder& frame, frame::PassBuilder& pass) const {
    for (const gpu::Buffer* buffer : {&mSortedSpheres, &mSpheres.fitted})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    pass.readsWrites(frame.importBuffer(mSpheres.pairs), Access::ComputeWrite);
}

std::uint64_t MediaBins::bytes() const {
    std::uint64_t sum =
        mKeys.bytes() + mValues.bytes() + mSortedSpheres.bytes() + mLimits.bytes();
    if (mSort) sum += mSort->bytes();
    if (mBoxSort)
        sum +=
            mBoxSort->bytes() + mBoxKeyValues.bytes() + mBoxValues.bytes() + mSortedBoxes.bytes();
    for (const Set* set : {&mSpheres, &mBoxes})
        for (const gpu::Buffer* buffer :
             {&set->rects, &set->wanted, &set->fitted, &set->cursors, &set->sums, &set->pairs})
            sum += buffer->bytes();
    return sum;
}

}  // namespace brume::oit
