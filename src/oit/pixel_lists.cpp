// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <oit/bindings.hpp>
#include <oit/pixel_lists.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <shaders/common/mesh.h>
#include <shaders/oit/linked_list/lists.h>
#include <spv/common/mesh.vert.float64.hpp>
#include <spv/common/mesh.vert.hpp>
#include <spv/oit/linked_list/count.comp.hpp>
#include <spv/oit/linked_list/resolve.comp.float64.hpp>
#include <spv/oit/linked_list/resolve.comp.hpp>
#include <spv/oit/linked_list/store.comp.hpp>
#include <spv/oit/linked_list/surface_count.frag.hpp>
#include <spv/oit/linked_list/surface_store.frag.float64.hpp>
#include <spv/oit/linked_list/surface_store.frag.hpp>
#include <spv/oit/linked_list/totals.comp.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace brume::oit {
namespace {

using frame::Access;

constexpr std::uint32_t kTilePixels = shader::kTileSize * shader::kTileSize;
constexpr std::uint64_t kEntryBytes = 8;

const gpu::Binding kOpaqueT{shader::kBindingOpaqueT, gpu::BindingType::SampledImage};

gpu::ComputePipeline makeListPipeline(gpu::Device& device, const std::string& name,
                                      std::span<const std::uint32_t> spirv,
                                      const std::vector<gpu::Binding>& own,
                                      std::vector<std::uint32_t> specialization,
                                      std::vector<gpu::NumberedConstant> constants = {}) {
    return {device,
            {.name = name,
             .spirv = spirv,
             .bindings = join(frameBindings(), own),
             .pushConstantBytes = sizeof(shader::ListPush),
             .specialization = std::move(specialization),
             .constants = std::move(constants)}};
}

/// The entries of a band and, behind them, its surface records.
std::uint64_t listBytes(std::uint64_t entries, std::uint64_t records) {
    return entries * kEntryBytes + records * sizeof(shader::SurfaceRecord);
}

gpu::GraphicsPipeline makeSurfacePipeline(gpu::Device& device, const std::string& name,
                                          std::span<const std::uint32_t> spirv,
                                          std::vector<gpu::NumberedConstant> constants = {}) {
    return {device,
            {.name = name,
             .vertexSpirv = chooseReal(device, spv::common_mesh_vert, spv::common_mesh_vert_float64),
             .fragmentSpirv = spirv,
             .bindings = join(surfaceBindings(), {kOpaqueT}),
             .pushConstantBytes = sizeof(shader::ListPush),
             .constants = std::move(constants)}};
}

}  // namespace

PixelLists::PixelLists(gpu::Device& device, const std::string& name, const Needs& needs,
                       std::uint64_t budgetBytes, MediaBins& bins, float epsilon)
    : mDevice(&device),
      mName(name),
      mBudgetBytes(budgetBytes),
      mEpsilon(epsilon),
      mNeeds(needs),
      mBins(&bins),
      mPrefixSum(device) {
    const std::vector<std::uint32_t> mediaUsed = {mNeeds.spheres, mNeeds.boxes, mNeeds.surfaces};
    const auto mediaAnd = [](std::vector<gpu::Binding> more) {
        return join(mediaBindings(), more);
    };
    mCount = makeListPipeline(device, name + ".count", spv::oit_linked_list_count_comp,
                              mediaAnd({kOpaqueT}), mediaUsed);
    mStore = makeListPipeline(device, name + ".store", spv::oit_linked_list_store_comp,
                              mediaAnd({kOpaqueT}), mediaUsed);
    mResolve = makeResolve();
    mTotals = makeListPipeline(device, name + ".totals", spv::oit_linked_list_totals_comp, {},
                               {mNeeds.surfaces});
    if (mNeeds.surfaces) {
        mSurfaceCount = makeSurfacePipeline(device, name + ".surface_count",
                                            spv::oit_linked_list_surface_count_frag,
                                            lightingConstants(mNeeds));
        mSurfaceStore = makeSurfacePipeline(device, name + ".surface_store",
                                            chooseReal(device, spv::oit_linked_list_surface_store_frag,
                                                   spv::oit_linked_list_surface_store_frag_float64),
                                            lightingConstants(mNeeds));
    }
    mCounters = makeBuffer("counters", sizeof(shader::ListCounters));
    mCountersRead =
        makeBuffer("counters_read", sizeof(shader::ListCounters), gpu::MemoryKind::Readback);
}

gpu::Buffer PixelLists::makeBuffer(const char* stage, std::uint64_t bytes,
                                   gpu::MemoryKind memory) const {
    return {*mDevice,
            {.name = fmt::format("{}.{}", mName, stage),
             .bytes = std::max<std::uint64_t>(bytes, 16),
             .memory = memory}};
}

void PixelLists::setTiles(std::span<const std::uint32_t> tiles, std::uint32_t screenTileCount) {
    mTileCount = static_cast<std::uint32_t>(tiles.size());
    mTileMap =
        makeBuffer("tile_map", 4ull * (screenTileCount + mTileCount), gpu::MemoryKind::Upload);
    const std::span<std::uint32_t> map = mTileMap.mappedAs<std::uint32_t>();
    std::fill_n(map.begin(), screenTileCount, ~0u);
    for (std::uint32_t slot = 0; slot < mTileCount; ++slot) {
        map[tiles[slot]] = slot;
        map[screenTileCount + slot] = tiles[slot];
    }
    const std::uint64_t totalBytes = mTileCount * sizeof(shader::TileTotals);
    mTileTotals = makeBuffer("tile_totals", totalBytes);
    mTileTotalsRead = makeBuffer("tile_totals_read", totalBytes, gpu::MemoryKind::Readback);
}

gpu::ComputePipeline PixelLists::makeResolve() const {
    const bool isVarying = mNeeds.varyingDensity || mNeeds.varyingLight;
    return makeListPipeline(
        *mDevice, mName + ".resolve",
        chooseReal(*mDevice, spv::oit_linked_list_resolve_comp,
               spv::oit_linked_list_resolve_comp_float64),
        join(mediaBindings(), {kOpaqueT,
                               {shader::kBindingOpaqueColor, gpu::BindingType::SampledImage},
                               {shader::kBindingResult, gpu::BindingType::StorageImage}}),
        {mNeeds.surfaces, mNeeds.boxes, isVarying, mNeeds.varyingLight, mNeeds.colouredExtinction,
         mRoundCount > 1, mNeeds.media <= shader::kKeptMedia ? mNeeds.media : 0},
        lightingConstants(mNeeds));
}

void PixelLists::prepare(const OitMethod::MeasureFunction& measure) {
    mSliceCount =
        std::max((mBins->longestList() + shader::kMediaPerSlice - 1) / shader::kMediaPerSlice, 1u);
    const Band whole{.firstSlot = 0, .tileCount = mTileCount};
    mBands = {whole};
    allocateForBands();
    measure([this, whole](frame::FrameBuilder& frame, const Inputs& inputs) {
        mBins->declareCount(frame, inputs);
        mBins->declareScatter(frame, inputs);
        declareCount(frame, inputs, whole);
        declareTotals(frame, inputs);
    });
    planBands();
    allocateForBands();
    planRounds(measure);
}

void PixelLists::planRounds(const OitMethod::MeasureFunction& measure) {
    // So many constant media never need more: each enters and leaves once, and moves the others.
    constexpr std::uint64_t kAlwaysOneRound = 100;
    if (!mNeeds.varyingDensity && !mNeeds.varyingLight && mLongest <= kAlwaysOneRound) return;
    constexpr std::uint32_t kMaxRounds = 4096;
    for (;;) {
        measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
            mBins->declareCount(frame, inputs);
            mBins->declareScatter(frame, inputs);
            declare(frame, inputs, true);
        });
        if (counters().at("exhausted") == 0 || mRoundCount >= kMaxRounds) return;
        mRoundCount *= 2;
        mResolve = makeResolve();
        mStates = makeBuffer("states", mProgress.bytes() / 4 * sizeof(shader::PixelState));
    }
}

void PixelLists::planBands() {
    const auto totals = mTileTotalsRead.mappedAs<shader::TileTotals>();
    mBands.clear();
    mSurfacesStored = mLongest = 0;
    for (std::uint32_t tile = 0; tile < mTileCount; ++tile) {
        const shader::TileTotals& total = totals[tile];
        const std::uint64_t bytes = listBytes(total.entries, total.surfaces);
        if (bytes > mBudgetBytes)
            throw inputError(
                "setting up " + mName, "budgetMiB",
                fmt::format("the lists of one tile of 8 x 8 pixels need {} MiB, allowed "
                            "are budgets of at least that",
                            (bytes >> 20) + 1));
        if (mBands.empty() ||
            listBytes(mBands.back().entryCount, mBands.back().recordCount) + bytes > mBudgetBytes)
            mBands.push_back({.firstSlot = tile});
        Band& band = mBands.back();
        ++band.tileCount;
        band.entryCount += total.entries;
        band.recordCount += total.surfaces;
        mSurfacesStored += total.surfaces;
        mLongest = std::max<std::uint64_t>(mLongest, total.longest);
    }
}

void PixelLists::allocateForBands() {
    Band largest;
    std::uint64_t bytes = 0;
    for (const Band& band : mBands) {
        largest.tileCount = std::max(largest.tileCount, band.tileCount);
        bytes = std::max(bytes, listBytes(band.entryCount, band.recordCount));
    }
    const std::uint32_t pixels = largest.tileCount * kTilePixels;
    mOffsets = makeBuffer("offsets", 4ull * (pixels + 1));
    mSums = makeBuffer("sums", 4ull * gpu::PrefixSum::sumCount(pixels + 1));
    mSurfaceOffsets = makeBuffer("surface_offsets", mNeeds.surfaces ? 4ull * (pixels + 1) : 0);
    mSurfaceCursors = makeBuffer("surface_cursors", mNeeds.surfaces ? 4ull * pixels : 0);
    mProgress = makeBuffer("progress", 4ull * pixels);
    mLists = makeBuffer("lists", bytes);
    mBandTotals = makeBuffer("band_totals", 4 * mBands.size());
    mBandTotalsRead = makeBuffer("band_totals_read", 4 * mBands.size(), gpu::MemoryKind::Readback);
}

shader::ListPush PixelLists::makePush(const Band& band) const {
    return {.firstSlot = band.firstSlot,
            .tileCount = band.tileCount,
            .roundCount = mRoundCount,
            .tileMap = mTileMap.deviceAddress(),
            .entries = mLists.deviceAddress(),
            .offsets = mOffsets.deviceAddress(),
            .surfaceOffsets = mSurfaceOffsets.deviceAddress(),
            .surfaceCursors = mSurfaceCursors.deviceAddress(),
            .records = mLists.deviceAddress() + band.entryCount * kEntryBytes,
            .sphereOffsets = mBins->spheres().offsets,
            .spherePairs = mBins->spheres().pairs,
            .boxOffsets = mBins->boxes().offsets,
            .boxPairs = mBins->boxes().pairs,
            .counters = mCounters.deviceAddress(),
            .progress = mProgress.deviceAddress(),
            .states = mRoundCount > 1 ? mStates.deviceAddress() : 0,
            .epsilon = mEpsilon,
            .largestTint = mNeeds.largestTint};
}

void PixelLists::declareSurfaces(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                                 const char* stage, const gpu::GraphicsPipeline& pipeline) {
    frame::PassBuilder& pass = frame.addPass(fmt::format("{}.surface_{}", mName, stage));
    pass.reads(inputs.opaqueT, Access::FragmentSample);
    for (const gpu::Buffer* buffer :
         {&mOffsets, &mSurfaceOffsets, &mSurfaceCursors, &mCounters, &mLists})
        pass.readsWrites(frame.importBuffer(*buffer), Access::FragmentWrite);
    pass.renderArea(inputs.extent);
    pass.record([this, inputs, band, &pipeline](gpu::Commands& commands,
                                                const frame::PassResources& resources) {
        commands.bindGraphics(pipeline);
        bindFrame(commands, inputs);
        bindMeshes(commands, inputs);
        commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                      *inputs.texelSampler);
        shader::ListPush push = makePush(band);
        drawSurfaces(commands, inputs, [&](std::uint32_t mesh) {
            push.step = mesh;
            commands.pushConstants(push);
        });
    });
}

void PixelLists::declareClear(frame::FrameBuilder& frame, const Band& band) {
    frame::PassBuilder& pass = frame.addPass(mName + ".clear");
    for (const gpu::Buffer* buffer :
         {&mOffsets, &mSurfaceOffsets, &mSurfaceCursors, &mProgress, &mCounters})
        pass.writes(frame.importBuffer(*buffer), Access::TransferWrite);
    pass.record([this, isFirst = band.firstSlot == 0](gpu::Commands& commands,
                                                      const frame::PassResources&) {
        commands.fillBuffer(mOffsets, 0);
        commands.fillBuffer(mProgress, 0);
        if (mNeeds.surfaces) {
            commands.fillBuffer(mSurfaceOffsets, 0);
            commands.fillBuffer(mSurfaceCursors, 0);
        }
        if (isFirst) commands.fillBuffer(mCounters, 0);
    });
}

void PixelLists::declareCount(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band) {
    declareClear(frame, band);
    if (mNeeds.surfaces) declareSurfaces(frame, inputs, band, "count", mSurfaceCount);
    frame::PassBuilder& pass = frame.addPass(mName + ".count");
    pass.reads(frame.importBuffer(mSurfaceOffsets), Access::ComputeRead);
    pass.readsWrites(frame.importBuffer(mOffsets), Access::ComputeWrite);
    declareMedia(frame, inputs, band, pass, mCount);
}

void PixelLists::declareMedia(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                              frame::PassBuilder& pass, const gpu::ComputePipeline& pipeline) {
    mBins->declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.record([this, inputs, band, &pipeline](gpu::Commands& commands,
                                                const frame::PassResources& resources) {
        commands.bindCompute(pipeline);
        bindFrame(commands, inputs);
        bindMedia(commands, inputs, mBins->sortedSpheres(), mBins->listedBoxes(inputs));
        commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                      *inputs.texelSampler);
        shader::ListPush push = makePush(band);
        for (std::uint32_t slice = 0; slice < mSliceCount; ++slice) {
            if (slice > 0) commands.computeBarrier();  // the slice before it writes the same lists
            push.step = slice * shader::kMediaPerSlice;
            commands.pushConstants(push);
            commands.dispatchThreads(std::uint64_t{band.tileCount} * shader::kTileSize,
                                     kTilePixels);
        }
    });
}

void PixelLists::declareTotals(frame::FrameBuilder& frame, const Inputs& inputs) {
    frame::PassBuilder& pass = frame.addPass(mName + ".totals");
    for (const gpu::Buffer* buffer : {&mOffsets, &mSurfaceOffsets})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    pass.writes(frame.importBuffer(mTileTotals), Access::ComputeWrite);
    pass.record([this, inputs](gpu::Commands& commands, const frame::PassResources&) {
        commands.bindCompute(mTotals);
        bindFrame(commands, inputs);
        shader::ListPush push = makePush({0, mTileCount});
        push.counters = mTileTotals.deviceAddress();
        commands.pushConstants(push);
        commands.dispatch((mTileCount + 63) / 64);
    });
    frame.addReadback(mName + ".totals_read", frame.importBuffer(mTileTotals), mTileTotalsRead);
}

void PixelLists::declareScan(frame::FrameBuilder& frame, const Band& band) {
    const std::uint32_t count = band.tileCount * kTilePixels + 1;
    frame::PassBuilder& pass = frame.addPass(mName + ".scan");
    for (const gpu::Buffer* buffer : {&mOffsets, &mSurfaceOffsets, &mSums})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    pass.record([this, count](gpu::Commands& commands, const frame::PassResources&) {
        if (mNeeds.surfaces) {
            mPrefixSum.record(commands, mSurfaceOffsets.deviceAddress(), count,
                              mSums.deviceAddress());
            commands.computeBarrier();
        }
        mPrefixSum.record(commands, mOffsets.deviceAddress(), count, mSums.deviceAddress());
    });
    // What the band's lists really hold, against what they were planned for.
    const std::uint64_t index = static_cast<std::uint64_t>(&band - mBands.data());
    frame.addPass(mName + ".band_total")
        .reads(frame.importBuffer(mSums), Access::TransferRead)
        .writes(frame.importBuffer(mBandTotals), Access::TransferWrite)
        .record([this, index, count](gpu::Commands& commands, const frame::PassResources&) {
            commands.copyBuffer(mSums, mBandTotals, 4, 4ull * gpu::PrefixSum::totalIndex(count),
                                4 * index);
        });
}

void PixelLists::declareStore(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band) {
    frame::PassBuilder& pass = frame.addPass(mName + ".store");
    pass.reads(frame.importBuffer(mOffsets), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mLists, &mProgress})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    declareMedia(frame, inputs, band, pass, mStore);
    if (mNeeds.surfaces) declareSurfaces(frame, inputs, band, "store", mSurfaceStore);
}

void PixelLists::declareResolve(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                                bool isFirstWriter) {
    frame::PassBuilder& pass = frame.addPass(mName + ".resolve");
    mBins->declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.reads(inputs.opaqueColor, Access::ComputeSample);
    for (const gpu::Buffer* buffer : {&mOffsets, &mSurfaceOffsets, &mProgress})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mLists, &mCounters})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    if (mRoundCount > 1) pass.readsWrites(frame.importBuffer(mStates), Access::ComputeWrite);
    // Each band writes its own pixels of the image.
    if (isFirstWriter)
        pass.writes(inputs.result, Access::ComputeWrite);
    else
        pass.readsWrites(inputs.result, Access::ComputeWrite);
    pass.record(
        [this, inputs, band](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.bindCompute(mResolve);
            bindFrame(commands, inputs);
            bindMedia(commands, inputs, mBins->sortedSpheres(), mBins->listedBoxes(inputs));
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingOpaqueColor, resources.image(inputs.opaqueColor),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingResult, resources.image(inputs.result));
            shader::ListPush push = makePush(band);
            for (push.step = 0; push.step < push.roundCount; ++push.step) {
                if (push.step > 0) commands.computeBarrier();  // states of the round before it
                commands.pushConstants(push);
                commands.dispatchThreads(std::uint64_t{band.tileCount} * kTilePixels, kTilePixels);
            }
        });
}

void PixelLists::declare(frame::FrameBuilder& frame, const Inputs& inputs, bool isFirstWriter) {
    for (const Band& band : mBands) {
        declareCount(frame, inputs, band);
        declareScan(frame, band);
        declareStore(frame, inputs, band);
        declareResolve(frame, inputs, band, isFirstWriter && band.firstSlot == 0);
    }
    frame.addReadback(mName + ".counters", frame.importBuffer(mCounters), mCountersRead);
    frame.addReadback(mName + ".band_totals", frame.importBuffer(mBandTotals), mBandTotalsRead);
}

std::map<std::string, std::uint64_t> PixelLists::counters() {
    const auto counters = mCountersRead.mappedAs<shader::ListCounters>()[0];
    const auto totals = mBandTotalsRead.mappedAs<std::uint32_t>();
    std::uint64_t stored = 0, dropped = 0;
    for (std::size_t i = 0; i < mBands.size(); ++i) {
        stored += totals[i];
        dropped += totals[i] - std::min<std::uint64_t>(totals[i], mBands[i].entryCount);
    }
    return {{"stored", stored},        {"surfaces", mSurfacesStored},
            {"dropped", dropped},      {"bands", mBands.size()},
            {"longestList", mLongest}, {"exhausted", counters.exhausted},
            {"rounds", mRoundCount},   {"stopped", counters.stopped}};
}

double PixelLists::errorBound() {
    return std::bit_cast<float>(mCountersRead.mappedAs<shader::ListCounters>()[0].bound);
}

std::map<std::string, std::uint64_t> PixelLists::bytes() const {
    return {{"lists", mLists.bytes()},
            {"listOffsets", mOffsets.bytes() + mSums.bytes() + mSurfaceOffsets.bytes() +
                                mSurfaceCursors.bytes() + mProgress.bytes()},
            {"listStates", mStates.bytes()},
            {"listTiles", mTileMap.bytes() + mTileTotals.bytes()}};
}

}  // namespace brume::oit
