// SPDX-License-Identifier: Apache-2.0
#include <oit/list_memory.hpp>

#include <shaders/common/frame.h>
#include <shaders/oit/media_bins/bins.h>
#include <spv/oit/linked_list/arguments.comp.hpp>
#include <spv/oit/linked_list/place.comp.hpp>
#include <spv/oit/linked_list/totals.comp.hpp>

#include <algorithm>
#include <cstddef>

namespace brume::oit {
namespace {

using frame::Access;

constexpr std::uint64_t kTilePixels = std::uint64_t{shader::kTileSize} * shader::kTileSize;

}  // namespace

ListMemory::ListMemory(gpu::Device& device, const std::string& name, const Needs& needs,
                       const MediaBins& bins)
    : mDevice(&device),
      mName(name),
      mHasSurfaces(needs.surfaces),
      mBins(&bins),
      mPrefixSum(device) {
    mBegin = makePipeline("begin", spv::oit_linked_list_arguments_comp, {false});
    mTotals = makePipeline("totals", spv::oit_linked_list_totals_comp);
    mPlace = makePipeline("place", spv::oit_linked_list_place_comp);
    mBandArguments = makePipeline("bands", spv::oit_linked_list_arguments_comp, {true});
    mCounters = makeBuffer("counters", sizeof(shader::ListCounters));
    mCountersRead =
        makeBuffer("counters_read", sizeof(shader::ListCounters), gpu::MemoryKind::Readback);
}

gpu::ComputePipeline ListMemory::makePipeline(const char* stage,
                                              std::span<const std::uint32_t> spirv,
                                              std::vector<std::uint32_t> specialization) const {
    return {*mDevice,
            {.name = mName + "." + stage,
             .spirv = spirv,
             .pushConstantBytes = sizeof(shader::PlacePush),
             .specialization = std::move(specialization)}};
}

gpu::Buffer ListMemory::makeBuffer(const char* stage, std::uint64_t bytes,
                                   gpu::MemoryKind memory) const {
    return {*mDevice,
            {.name = mName + "." + stage,
             .bytes = std::max<std::uint64_t>(bytes, 16),
             .memory = memory}};
}

void ListMemory::allocateSlots(std::uint32_t screenTileCount, gpu::MemoryKind mapMemory) {
    const std::uint64_t slots = mSlotCapacity, pixels = slots * kTilePixels;
    mTileMap = makeBuffer("tile_map", 4 * (1 + screenTileCount + slots), mapMemory);
    mTiles = makeBuffer("tiles", slots * sizeof(shader::ListTile));
    mOffsets = makeBuffer("offsets", 4 * slots * shader::kTileOffsets);
    mSurfaceOffsets =
        makeBuffer("surface_offsets", mHasSurfaces ? 4 * slots * shader::kTileOffsets : 0);
    mSurfaceCursors = makeBuffer("surface_cursors", mHasSurfaces ? 4 * pixels : 0);
    mProgress = makeBuffer("progress", 4 * pixels);
    mBlocks = makeBuffer("blocks", 4 * (slots + 1));
    mSums = makeBuffer("sums", 4ull * gpu::PrefixSum::sumCount(mSlotCapacity + 1));
}

void ListMemory::setTiles(std::span<const std::uint32_t> tiles, std::uint32_t screenTileCount) {
    mSlotCapacity = static_cast<std::uint32_t>(tiles.size());
    allocateSlots(screenTileCount, gpu::MemoryKind::Upload);
    const std::span<std::uint32_t> map = mTileMap.mappedAs<std::uint32_t>();
    map[0] = mSlotCapacity;
    std::fill_n(map.begin() + 1, screenTileCount, ~0u);
    mHasEveryTile = mSlotCapacity == screenTileCount;
    for (std::uint32_t slot = 0; slot < mSlotCapacity; ++slot) {
        mHasEveryTile = mHasEveryTile && tiles[slot] == slot;
        map[1 + tiles[slot]] = slot;
        map[1 + screenTileCount + slot] = tiles[slot];
    }
}

void ListMemory::setAnyTiles(std::uint32_t screenTileCount) {
    mSlotCapacity = screenTileCount;
    mHasEveryTile = false;
    allocateSlots(screenTileCount, gpu::MemoryKind::Device);
}

void ListMemory::allocate(std::uint64_t blocks, std::uint32_t bandCount) {
    mBlockCount = std::clamp<std::uint64_t>(blocks, 1, 0xffffffffu);
    mBandCount = bandCount;
    mLists = makeBuffer("lists", mBlockCount * shader::kBlockBytes);
    mBands = makeBuffer("bands", (1ull + mBandCount) * sizeof(shader::ListBand));
    mDrawCount = 0;
}

shader::PlacePush ListMemory::makePlacePush() const {
    return {.tileMap = mTileMap.deviceAddress(),
            .tiles = mTiles.deviceAddress(),
            .offsets = mOffsets.deviceAddress(),
            .surfaceOffsets = mSurfaceOffsets.deviceAddress(),
            .surfaceCursors = mSurfaceCursors.deviceAddress(),
            .counters = mCounters.deviceAddress(),
            .blocks = mBlocks.deviceAddress(),
            .bands = mBands.deviceAddress(),
            .draws = mDrawCount > 0 ? mDraws.deviceAddress() : 0,
            .binTotals = mBins->totals().deviceAddress(),
            .slotCapacity = mSlotCapacity,
            .bandCount = mBandCount,
            .blockCapacity = static_cast<std::uint32_t>(mBlockCount),
            .drawCount = mDrawCount,
            .recordBytes = mRecordBytes,
            .recordWords = mRecordWords};
}

void ListMemory::declareBegin(frame::FrameBuilder& frame, const Inputs& inputs) {
    const auto drawCount = static_cast<std::uint32_t>(inputs.surfaces.size());
    if (mHasSurfaces && mDrawCount != drawCount) {
        mDrawCount = drawCount;
        mDraws = makeBuffer("draws", sizeof(shader::DrawArguments) * mDrawCount * mBandCount,
                            gpu::MemoryKind::Upload);
        const auto draws = mDraws.mappedAs<shader::DrawArguments>();
        for (std::size_t i = 0; i < std::size_t{mDrawCount} * mBandCount; ++i)
            draws[i] = {inputs.surfaces[i % mDrawCount].vertexCount, 0, 0, 0};
    }
    frame::PassBuilder& pass = frame.addPass(mName + ".clear");
    for (const gpu::Buffer* buffer : {&mOffsets, &mSurfaceOffsets, &mProgress, &mBlocks, &mCounters})
        pass.writes(frame.importBuffer(*buffer), Access::TransferWrite);
    pass.reads(frame.importBuffer(mTileMap), Access::ComputeRead);
    pass.reads(frame.importBuffer(mBins->totals()), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mCounters, &mBands})
        pass.writes(frame.importBuffer(*buffer), Access::ComputeWrite);
    pass.record([this](gpu::Commands& commands, const frame::PassResources&) {
        for (const gpu::Buffer* buffer : {&mOffsets, &mProgress, &mBlocks, &mCounters})
            commands.fillBuffer(*buffer, 0);
        if (mHasSurfaces) commands.fillBuffer(mSurfaceOffsets, 0);
        commands.computeTransferBarrier();
        commands.bindCompute(mBegin);
        commands.pushConstants(makePlacePush());
        commands.dispatch(1);
    });
}

void ListMemory::declarePlace(frame::FrameBuilder& frame) {
    frame::PassBuilder& pass = frame.addPass(mName + ".place");
    pass.reads(frame.importBuffer(mBands), Access::IndirectRead);
    pass.reads(frame.importBuffer(mBins->totals()), Access::ComputeRead);
    for (const gpu::Buffer* buffer :
         {&mOffsets, &mSurfaceOffsets, &mSurfaceCursors, &mBlocks, &mSums, &mCounters, &mTiles,
          &mBands})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    if (mDrawCount > 0) pass.writes(frame.importBuffer(mDraws), Access::ComputeWrite);
    pass.record([this](gpu::Commands& commands, const frame::PassResources&) {
        recordPlace(commands);
    });
}

void ListMemory::recordPlace(gpu::Commands& commands) const {
    constexpr std::uint64_t kSlots = offsetof(shader::ListBand, slots);
    const shader::PlacePush push = makePlacePush();
    const auto bind = [&](const gpu::ComputePipeline& pipeline) {
        commands.bindCompute(pipeline);
        commands.pushConstants(push);
    };
    bind(mTotals);
    commands.dispatchIndirect(mBands, kSlots);
    commands.computeBarrier();
    mPrefixSum.record(commands, push.blocks, mSlotCapacity + 1, mSums.deviceAddress());
    commands.computeBarrier();
    bind(mPlace);
    commands.dispatchIndirect(mBands, kSlots);
    commands.computeBarrier();
    bind(mBandArguments);
    commands.dispatch(1);
}

void ListMemory::declareReadback(frame::FrameBuilder& frame) {
    frame.addReadback(mName + ".counters", frame.importBuffer(mCounters), mCountersRead);
}

shader::ListPush ListMemory::makePush(std::uint32_t band) const {
    return {.band = mBands.deviceAddress() + band * sizeof(shader::ListBand),
            .tileMap = mTileMap.deviceAddress(),
            .tiles = mTiles.deviceAddress(),
            .lists = mLists.deviceAddress(),
            .offsets = mOffsets.deviceAddress(),
            .surfaceOffsets = mSurfaceOffsets.deviceAddress(),
            .surfaceCursors = mSurfaceCursors.deviceAddress(),
            .sphereOffsets = mBins->spheres().offsets,
            .spherePairs = mBins->spheres().pairs,
            .boxOffsets = mBins->boxes().offsets,
            .boxPairs = mBins->boxes().pairs,
            .counters = mCounters.deviceAddress(),
            .progress = mProgress.deviceAddress()};
}

void ListMemory::dispatch(gpu::Commands& commands, std::uint32_t band, Visit visit) const {
    const std::uint64_t member = visit == Visit::Columns ? offsetof(shader::ListBand, columns)
                                 : visit == Visit::LaterColumns
                                     ? offsetof(shader::ListBand, laterColumns)
                                     : offsetof(shader::ListBand, pixels);
    commands.dispatchIndirect(mBands, band * sizeof(shader::ListBand) + member);
}

void ListMemory::draw(gpu::Commands& commands, std::uint32_t band, std::uint32_t surface) const {
    const std::uint64_t index = std::uint64_t{band - 1} * mDrawCount + surface;
    commands.drawIndirect(mDraws, index * sizeof(shader::DrawArguments));
}

void ListMemory::declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass,
                              Access access) const {
    for (const gpu::Buffer* buffer : {&mTileMap, &mTiles, &mBands})
        pass.reads(frame.importBuffer(*buffer), access);
    pass.reads(frame.importBuffer(mBands), Access::IndirectRead);
    if (access == Access::FragmentRead && mDrawCount > 0)
        pass.reads(frame.importBuffer(mDraws), Access::IndirectRead);
}

shader::ListCounters ListMemory::counters() const {
    return mCountersRead.mappedAs<shader::ListCounters>()[0];
}

std::map<std::string, std::uint64_t> ListMemory::bytes() const {
    return {{"lists", mLists.bytes()},
            {"listOffsets", mOffsets.bytes() + mSums.bytes() + mSurfaceOffsets.bytes() +
                                mSurfaceCursors.bytes() + mProgress.bytes() + mBlocks.bytes()},
            {"listTiles", mTileMap.bytes() + mTiles.bytes() + mBands.bytes() + mDraws.bytes()}};
}

}  // namespace brume::oit
