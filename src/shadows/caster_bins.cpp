// SPDX-License-Identifier: Apache-2.0
#include <shadows/caster_bins.hpp>
#include <shadows/map_pass.hpp>

#include <spv/shadows/bins/order.comp.hpp>
#include <spv/shadows/bins/pairs.comp.hpp>
#include <spv/shadows/bins/starts.comp.hpp>

#include <algorithm>

namespace brume::shadows {
namespace {

using frame::Access;

gpu::ComputePipeline makePipeline(gpu::Device& device, const std::string& name,
                                  std::span<const std::uint32_t> spirv,
                                  std::vector<std::uint32_t> specialization) {
    return makeMapPipeline(device, name, spirv, std::move(specialization),
                           sizeof(shader::ShadowBinPush));
}

gpu::Buffer makeUints(gpu::Device& device, const std::string& name, std::uint64_t count) {
    return {device, {.name = name, .bytes = 4 * std::max<std::uint64_t>(count, 1)}};
}

}  // namespace

CasterBins::CasterBins(gpu::Device& device, const Casters& casters, CasterChoice choice,
                       const shader::ShadowMap& map)
    : mDevice(&device),
      mCasters(&casters),
      mTileCount(map.faceCount * (map.resolution / shader::kMapTileSize) *
                 (map.resolution / shader::kMapTileSize)),
      mPrefixSum(device),
      mStarts(makePipeline(device, "shadow.bins.starts", spv::shadows_bins_starts_comp, {})) {
    const bool withMedia = choice != CasterChoice::Opaque;
    const std::uint32_t opaque =
        choice == CasterChoice::Translucent ? 0 : casters.opaqueTriangleCount;
    const std::uint32_t translucent = withMedia ? casters.translucentTriangleCount : 0;
    if (choice == CasterChoice::Translucent)
        mProgress = makeUints(*mDevice, "shadow.bins.progress",
                              mTileCount * shader::kMapTileSize * shader::kMapTileSize);
    mSets[0] = makeSet(shader::kCasterSphere, 0, withMedia ? casters.sphereCount : 0);
    mSets[1] = makeSet(shader::kCasterBox, 0, withMedia ? casters.boxCount : 0);
    mSets[2] = makeSet(shader::kCasterTriangle,
                       choice == CasterChoice::Translucent ? casters.opaqueTriangleCount : 0,
                       opaque + translucent);
}

CasterBins::Set CasterBins::makeSet(std::uint32_t kind, std::uint32_t first, std::uint32_t count) {
    Set set;
    set.kind = kind;
    set.first = first;
    set.count = count;
    set.starts = makeUints(*mDevice, "shadow.bins.starts", mTileCount + 1);
    set.tiles = makeUints(*mDevice, "shadow.bins.tiles", 1);
    set.casters = makeUints(*mDevice, "shadow.bins.casters", 1);
    set.orderKeys = makeUints(*mDevice, "shadow.bins.order_keys", count);
    set.order = makeUints(*mDevice, "shadow.bins.order", count);
    set.counts = makeUints(*mDevice, "shadow.bins.counts", count + 1);
    set.sums = makeUints(*mDevice, "shadow.bins.sums", gpu::PrefixSum::sumCount(count + 1));
    set.total = {*mDevice,
                 {.name = "shadow.bins.total", .bytes = 4, .memory = gpu::MemoryKind::Readback}};
    if (count == 0) return set;
    set.identity =
        makePipeline(*mDevice, "shadow.bins.identity", spv::shadows_bins_order_comp, {kind, 1});
    set.distance =
        makePipeline(*mDevice, "shadow.bins.distance", spv::shadows_bins_order_comp, {kind, 0});
    set.count_ =
        makePipeline(*mDevice, "shadow.bins.count", spv::shadows_bins_pairs_comp, {kind, 0});
    set.write =
        makePipeline(*mDevice, "shadow.bins.write", spv::shadows_bins_pairs_comp, {kind, 1});
    set.orderSort = std::make_unique<gpu::RadixSort>(*mDevice, "shadow.bins.order_sort", count);
    return set;
}

void CasterBins::run(gpu::Commands& commands, const gpu::ComputePipeline& pipeline,
                     const shader::ShadowBinPush& push, std::uint32_t threads) const {
    commands.bindCompute(pipeline);
    bindCasters(commands, *mCasters);
    commands.pushConstants(push);
    commands.dispatchThreads(threads, 64);
    commands.computeBarrier();
}

void CasterBins::recordCount(gpu::Commands& commands, const Set& set, VkDeviceAddress map) const {
    shader::ShadowBinPush push{.map = map,
                               .keys = set.orderKeys.deviceAddress(),
                               .values = set.order.deviceAddress(),
                               .order = set.order.deviceAddress(),
                               .offsets = set.counts.deviceAddress(),
                               .count = set.count,
                               .first = set.first};
    run(commands, set.identity, push, set.count);
    // Boxes and triangles already are in the order of their identity.
    if (set.kind == shader::kCasterSphere) {
        set.orderSort->record(commands, set.orderKeys, set.order, set.count);
        commands.computeBarrier();
    }
    run(commands, set.distance, push, set.count);
    set.orderSort->record(commands, set.orderKeys, set.order, set.count);
    commands.computeBarrier();
    run(commands, set.count_, push, set.count);
    mPrefixSum.record(commands, push.offsets, set.count + 1, set.sums.deviceAddress());
    commands.computeBarrier();
}

void CasterBins::recordPairs(gpu::Commands& commands, const Set& set, VkDeviceAddress map) const {
    shader::ShadowBinPush push{.map = map,
                               .keys = set.tiles.deviceAddress(),
                               .values = set.casters.deviceAddress(),
                               .order = set.order.deviceAddress(),
                               .offsets = set.counts.deviceAddress(),
                               .count = set.count,
                               .first = set.first,
                               .tileCount = mTileCount,
                               .capacity = pairsToSort(set)};
    if (push.capacity > 0) {
        if (mIsReserved) {
            // What is not written below belongs to no tile and goes to the end.
            commands.fillBuffer(set.tiles, ~0u, 0, 4ull * push.capacity);
            commands.computeTransferBarrier();
        }
        run(commands, set.write, push, set.count);
        set.pairSort->record(commands, set.tiles, set.casters, push.capacity);
        commands.computeBarrier();
    }
    push.count = push.capacity;
    push.offsets = set.starts.deviceAddress();
    run(commands, mStarts, push, mTileCount + 1);
}

void CasterBins::declareCount(frame::FrameBuilder& frame, const gpu::Buffer& mapBuffer,
                              frame::BufferRef spheres) {
    frame::PassBuilder& pass = frame.addPass("shadow.bins");
    pass.reads(spheres, Access::ComputeRead);
    pass.reads(frame.importBuffer(mapBuffer), Access::ComputeRead);
    for (const Set& set : mSets) {
        pass.writes(frame.importBuffer(set.counts), Access::TransferWrite);
        for (const gpu::Buffer* buffer : {&set.orderKeys, &set.order, &set.counts, &set.sums})
            pass.writes(frame.importBuffer(*buffer), Access::ComputeWrite);
    }
    pass.record([this, &mapBuffer](gpu::Commands& commands, const frame::PassResources&) {
        for (const Set& set : mSets) {
            commands.fillBuffer(set.counts, 0);
            commands.fillBuffer(set.sums, 0);
        }
        commands.computeTransferBarrier();
        for (const Set& set : mSets)
            if (set.count > 0) recordCount(commands, set, mapBuffer.deviceAddress());
    });
    declareTotals(frame);
}

void CasterBins::declareTotals(frame::FrameBuilder& frame) {
    frame::PassBuilder& copy = frame.addPass("shadow.bins_read");
    for (const Set& set : mSets) {
        copy.reads(frame.importBuffer(set.counts), Access::TransferRead);
        copy.writes(frame.importBuffer(set.total), Access::TransferWrite);
    }
    copy.record([this](gpu::Commands& commands, const frame::PassResources&) {
        for (const Set& set : mSets)
            commands.copyBuffer(set.counts, set.total, 4, 4ull * set.count);
        commands.fullBarrier();  // to the host
    });
}

void CasterBins::allocate(shader::ShadowMap& map) {
    for (Set& set : mSets) setRoom(set, set.total.mappedAs<std::uint32_t>()[0]);
    setAddresses(map);
}

void CasterBins::declareLengths(frame::FrameBuilder& frame, const gpu::Buffer& mapBuffer,
                                frame::BufferRef spheres) {
    makeStartsRead();
    declare(frame, mapBuffer, spheres);
    if (!mIsReserved) declareStartsRead(frame);
}

void CasterBins::makeStartsRead() {
    for (Set& set : mSets)
        set.startsRead = {*mDevice,
                          {.name = "shadow.bins.starts_read",
                           .bytes = set.starts.bytes(),
                           .memory = gpu::MemoryKind::Readback}};
}

void CasterBins::declareStartsRead(frame::FrameBuilder& frame) {
    for (Set& set : mSets)
        frame.addReadback("shadow.bins_read", frame.importBuffer(set.starts), set.startsRead);
}

ListLengths CasterBins::longestLists() const {
    const auto longest = [&](const Set& set) -> std::uint64_t {
        const auto starts = set.startsRead.mappedAs<std::uint32_t>();
        std::uint32_t most = 0;
        // What another frame is writing may be torn.
        for (std::size_t tile = 0; tile < mTileCount; ++tile)
            most = std::max(most, starts[tile + 1] - std::min(starts[tile], starts[tile + 1]));
        return mIsReserved ? std::min<std::uint64_t>(set.count, most + most / 2 + 64) : most;
    };
    return {longest(mSets[0]), longest(mSets[1])};
}

void CasterBins::reserve(shader::ShadowMap& map, std::uint32_t pairs) {
    mIsReserved = true;
    for (Set& set : mSets) {
        setRoom(set, set.count > 0 ? pairs : 0);
        set.total.mappedAs<std::uint32_t>()[0] = set.pairCount;  // nothing is known yet
    }
    makeStartsRead();
    for (Set& set : mSets) {
        const auto starts = set.startsRead.mappedAs<std::uint32_t>();
        std::fill(starts.begin(), starts.end(), 0u);
    }
    setAddresses(map);
}

std::uint32_t CasterBins::pairsToSort(const Set& set) const {
    if (!mIsReserved) return set.pairCount;
    const std::uint64_t last = set.total.mappedAs<std::uint32_t>()[0];
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(set.pairCount, last + last / 2 + 4096));
}

std::uint64_t CasterBins::droppedPairs() const {
    std::uint64_t dropped = 0;
    if (!mIsReserved) return dropped;
    for (const Set& set : mSets) {
        const std::uint32_t total = set.total.mappedAs<std::uint32_t>()[0];
        dropped += total - std::min(total, set.pairCount);
    }
    return dropped;
}

void CasterBins::setRoom(Set& set, std::uint32_t pairs) {
    set.pairCount = pairs;
    set.tiles = makeUints(*mDevice, "shadow.bins.tiles", pairs);
    set.casters = makeUints(*mDevice, "shadow.bins.casters", pairs);
    if (pairs > 0)
        set.pairSort = std::make_unique<gpu::RadixSort>(*mDevice, "shadow.bins.pair_sort", pairs);
}

void CasterBins::setAddresses(shader::ShadowMap& map) const {
    map.sphereOffsets = mSets[0].starts.deviceAddress();
    map.spherePairs = mSets[0].casters.deviceAddress();
    map.boxOffsets = mSets[1].starts.deviceAddress();
    map.boxPairs = mSets[1].casters.deviceAddress();
    map.triangleOffsets = mSets[2].starts.deviceAddress();
    map.trianglePairs = mSets[2].casters.deviceAddress();
}

void CasterBins::declare(frame::FrameBuilder& frame, const gpu::Buffer& mapBuffer,
                         frame::BufferRef spheres) {
    frame::PassBuilder& pass = frame.addPass("shadow.bins");
    pass.reads(spheres, Access::ComputeRead);
    pass.reads(frame.importBuffer(mapBuffer), Access::ComputeRead);
    for (const Set& set : mSets) {
        pass.writes(frame.importBuffer(set.counts), Access::TransferWrite);
        for (const gpu::Buffer* buffer : {&set.orderKeys, &set.order, &set.counts, &set.sums,
                                          &set.tiles, &set.casters, &set.starts})
            pass.writes(frame.importBuffer(*buffer), Access::ComputeWrite);
        if (mIsReserved) pass.writes(frame.importBuffer(set.tiles), Access::TransferWrite);
    }
    pass.record([this, &mapBuffer](gpu::Commands& commands, const frame::PassResources&) {
        for (const Set& set : mSets) commands.fillBuffer(set.counts, 0);
        commands.computeTransferBarrier();
        for (const Set& set : mSets) {
            if (set.count > 0) recordCount(commands, set, mapBuffer.deviceAddress());
            recordPairs(commands, set, mapBuffer.deviceAddress());
        }
    });
    if (!mIsReserved) return;
    declareTotals(frame);
    declareStartsRead(frame);
}

void CasterBins::declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass) const {
    for (const Set& set : mSets)
        for (const gpu::Buffer* buffer : {&set.casters, &set.starts})
            pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
}

std::uint64_t CasterBins::bytes() const {
    std::uint64_t sum = mProgress.bytes();
    for (const Set& set : mSets) {
        for (const gpu::Buffer* buffer : {&set.orderKeys, &set.order, &set.counts, &set.sums,
                                          &set.tiles, &set.casters, &set.starts})
            sum += buffer->bytes();
        if (set.orderSort) sum += set.orderSort->bytes();
        if (set.pairSort) sum += set.pairSort->bytes();
    }
    return sum;
}

}  // namespace brume::shadows
