// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <oit/bindings.hpp>
#include <oit/linked_list.hpp>

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

namespace brume::oit {
namespace {

using frame::Access;

constexpr std::uint32_t kTilePixels = shader::kTileSize * shader::kTileSize;
constexpr std::uint64_t kEntryBytes = 8;

std::uint32_t countTiles(VkExtent2D extent) {
    return (extent.width + shader::kTileSize - 1) / shader::kTileSize *
           ((extent.height + shader::kTileSize - 1) / shader::kTileSize);
}

const gpu::Binding kOpaqueT{shader::kBindingOpaqueT, gpu::BindingType::SampledImage};

gpu::ComputePipeline makeListPipeline(gpu::Device& device, const char* stage,
                                      std::span<const std::uint32_t> spirv,
                                      const std::vector<gpu::Binding>& own,
                                      std::vector<std::uint32_t> specialization,
                                      std::vector<gpu::NumberedConstant> constants = {}) {
    return {device,
            {.name = fmt::format("oit.linked_list.{}", stage),
             .spirv = spirv,
             .bindings = join(frameBindings(), own),
             .pushConstantBytes = sizeof(shader::ListPush),
             .specialization = std::move(specialization),
             .constants = std::move(constants)}};
}

/// The finer of two builds of a shader, where the device has the numbers for it.
std::span<const std::uint32_t> choose(const gpu::Device& device,
                                      std::span<const std::uint32_t> float32,
                                      std::span<const std::uint32_t> float64) {
    return device.features().shaderFloat64 ? float64 : float32;
}

gpu::GraphicsPipeline makeSurfacePipeline(gpu::Device& device, const char* stage,
                                          std::span<const std::uint32_t> spirv,
                                          std::vector<gpu::NumberedConstant> constants = {}) {
    return {device,
            {.name = fmt::format("oit.linked_list.surface_{}", stage),
             .vertexSpirv =
                 choose(device, spv::common_mesh_vert, spv::common_mesh_vert_float64),
             .fragmentSpirv = spirv,
             .bindings = join(join(frameBindings(), meshBindings()), {kOpaqueT}),
             .pushConstantBytes = sizeof(shader::ListPush),
             .constants = std::move(constants)}};
}

gpu::Buffer makeBuffer(gpu::Device& device, const char* name, std::uint64_t bytes,
                       gpu::MemoryKind memory = gpu::MemoryKind::Device) {
    return {device,
            {.name = fmt::format("oit.linked_list.{}", name),
             .bytes = std::max<std::uint64_t>(bytes, 16),
             .memory = memory}};
}

}  // namespace

namespace linked_list {

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "linked_list",
        .summary =
            "Per-pixel lists of surfaces and medium intervals, sorted and integrated exactly.",
        .paper = "Barta, Kovacs: Order Independent Transparency with Per-Pixel Linked Lists, 2011",
        .exactness = Exactness::Exact,
        .passes = "1 compute (media) and 1 raster (surfaces), each twice: count, store; 1 resolve",
        .bytesPerPixel = "16 + 8 n + 60 s for n medium intervals and s surface fragments",
        .limits = "one screen tile's lists must fit into the budget",
        .settings = {{"budgetMiB", "1 .. 1048576 MiB", "1024",
                      "memory for list entries and surface records; beyond it, the screen is "
                      "rendered in bands"}}};
    return kInfo;
}

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method linked_list");
    LinkedListSettings values;
    values.budgetBytes = static_cast<std::uint64_t>(reader.integer("budgetMiB", 1024, 1, 1 << 20))
                         << 20;
    reader.finish();
    return std::make_unique<LinkedList>(device, inputs, values);
}

}  // namespace linked_list

LinkedList::LinkedList(gpu::Device& device, const Inputs& inputs,
                       const LinkedListSettings& settings)
    : mDevice(&device),
      mSettings(settings),
      mNeeds(inputs.needs),
      mTileCount(countTiles(inputs.extent)),
      mBins(device, "oit.linked_list", inputs),
      mPrefixSum(device) {
    const std::vector<std::uint32_t> mediaUsed = {mNeeds.spheres, mNeeds.boxes, mNeeds.surfaces};
    const auto mediaAnd = [](std::vector<gpu::Binding> more) {
        return join(mediaBindings(), more);
    };
    mCount = makeListPipeline(device, "count", spv::oit_linked_list_count_comp,
                              mediaAnd({kOpaqueT}), mediaUsed);
    mStore = makeListPipeline(device, "store", spv::oit_linked_list_store_comp,
                              mediaAnd({kOpaqueT}), mediaUsed);
    mResolve = makeResolve();
    mTotals =
        makeListPipeline(device, "totals", spv::oit_linked_list_totals_comp, {}, {mNeeds.surfaces});
    if (mNeeds.surfaces) {
        mSurfaceCount =
            makeSurfacePipeline(device, "count", spv::oit_linked_list_surface_count_frag);
        mSurfaceStore =
            makeSurfacePipeline(device, "store",
                                choose(device, spv::oit_linked_list_surface_store_frag,
                                       spv::oit_linked_list_surface_store_frag_float64),
                                lightingConstants(mNeeds));
    }
    mCounters = makeBuffer(device, "counters", sizeof(shader::ListCounters));
    mCountersRead = makeBuffer(device, "counters_read", sizeof(shader::ListCounters),
                               gpu::MemoryKind::Readback);
    const std::uint64_t totalBytes = mTileCount * sizeof(shader::TileTotals);
    mTileTotals = makeBuffer(device, "tile_totals", totalBytes);
    mTileTotalsRead = makeBuffer(device, "tile_totals_read", totalBytes, gpu::MemoryKind::Readback);
}

gpu::ComputePipeline LinkedList::makeResolve() const {
    const bool isVarying = mNeeds.varyingDensity || mNeeds.varyingLight;
    return makeListPipeline(
        *mDevice, "resolve",
        choose(*mDevice, spv::oit_linked_list_resolve_comp,
               spv::oit_linked_list_resolve_comp_float64),
        join(mediaBindings(), {kOpaqueT,
                               {shader::kBindingOpaqueColor, gpu::BindingType::SampledImage},
                               {shader::kBindingResult, gpu::BindingType::StorageImage}}),
        {mNeeds.surfaces, mNeeds.boxes, isVarying, mNeeds.varyingLight, mNeeds.colouredExtinction,
         mRoundCount > 1, mNeeds.media <= shader::kKeptMedia},
        lightingConstants(mNeeds));
}

const MethodInfo& LinkedList::info() const { return linked_list::info(); }

void LinkedList::prepare(const MeasureFunction& measure) {
    measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
        mBins.declareCount(frame, inputs);
        mBins.declareTotals(frame);
    });
    mBins.allocate();
    mSliceCount =
        std::max((mBins.longestList() + shader::kMediaPerSlice - 1) / shader::kMediaPerSlice, 1u);
    const Band whole{.firstTile = 0, .tileCount = mTileCount};
    mBands = {whole};
    allocateForBands();
    measure([this, whole](frame::FrameBuilder& frame, const Inputs& inputs) {
        mBins.declareCount(frame, inputs);
        mBins.declareScatter(frame, inputs);
        declareCount(frame, inputs, whole);
        declareTotals(frame, inputs);
    });
    planBands();
    allocateForBands();
    planRounds(measure);
}

void LinkedList::planRounds(const MeasureFunction& measure) {
    // So many constant media never need more: each enters and leaves once, and moves the others.
    constexpr std::uint64_t kAlwaysOneRound = 100;
    if (!mNeeds.varyingDensity && !mNeeds.varyingLight && mLongest <= kAlwaysOneRound) return;
    constexpr std::uint32_t kMaxRounds = 4096;
    for (;;) {
        measure(
            [this](frame::FrameBuilder& frame, const Inputs& inputs) { declare(frame, inputs); });
        if (counters().at("exhausted") == 0 || mRoundCount >= kMaxRounds) return;
        mRoundCount *= 2;
        mResolve = makeResolve();
        mStates =
            makeBuffer(*mDevice, "states", mProgress.bytes() / 4 * sizeof(shader::PixelState));
    }
}

void LinkedList::planBands() {
    const auto totals = mTileTotalsRead.mappedAs<shader::TileTotals>();
    mBands.clear();
    mSurfacesStored = mLongest = 0;
    std::uint64_t bandBytes = 0;
    for (std::uint32_t tile = 0; tile < mTileCount; ++tile) {
        const shader::TileTotals& total = totals[tile];
        const std::uint64_t bytes =
            total.entries * kEntryBytes + total.surfaces * sizeof(shader::SurfaceRecord);
        if (bytes > mSettings.budgetBytes)
            throw inputError(
                "setting up method linked_list", "budgetMiB",
                fmt::format("the lists of one tile of 8 x 8 pixels need {} MiB, allowed "
                            "are budgets of at least that",
                            (bytes >> 20) + 1));
        if (mBands.empty() || bandBytes + bytes > mSettings.budgetBytes) {
            mBands.push_back({.firstTile = tile});
            bandBytes = 0;
        }
        Band& band = mBands.back();
        ++band.tileCount;
        band.entryCount += total.entries;
        band.recordCount += total.surfaces;
        bandBytes += bytes;
        mSurfacesStored += total.surfaces;
        mLongest = std::max<std::uint64_t>(mLongest, total.longest);
    }
}

void LinkedList::allocateForBands() {
    Band largest;
    for (const Band& band : mBands) {
        largest.tileCount = std::max(largest.tileCount, band.tileCount);
        largest.entryCount = std::max(largest.entryCount, band.entryCount);
        largest.recordCount = std::max(largest.recordCount, band.recordCount);
    }
    const std::uint32_t pixels = largest.tileCount * kTilePixels;
    mOffsets = makeBuffer(*mDevice, "offsets", 4ull * (pixels + 1));
    mSums = makeBuffer(*mDevice, "sums", 4ull * gpu::PrefixSum::sumCount(pixels + 1));
    mSurfaceOffsets =
        makeBuffer(*mDevice, "surface_offsets", mNeeds.surfaces ? 4ull * (pixels + 1) : 0);
    mSurfaceCursors = makeBuffer(*mDevice, "surface_cursors", mNeeds.surfaces ? 4ull * pixels : 0);
    mProgress = makeBuffer(*mDevice, "progress", 4ull * pixels);
    mEntries = makeBuffer(*mDevice, "entries", largest.entryCount * kEntryBytes);
    mRecords = makeBuffer(*mDevice, "records", largest.recordCount * sizeof(shader::SurfaceRecord));
    mBandTotals = makeBuffer(*mDevice, "band_totals", 4 * mBands.size());
    mBandTotalsRead =
        makeBuffer(*mDevice, "band_totals_read", 4 * mBands.size(), gpu::MemoryKind::Readback);
}

shader::ListPush LinkedList::makePush(const Band& band) const {
    return {.firstTile = band.firstTile,
            .tileCount = band.tileCount,
            .entries = mEntries.deviceAddress(),
            .offsets = mOffsets.deviceAddress(),
            .surfaceOffsets = mSurfaceOffsets.deviceAddress(),
            .surfaceCursors = mSurfaceCursors.deviceAddress(),
            .records = mRecords.deviceAddress(),
            .sphereOffsets = mBins.spheres().offsets,
            .spherePairs = mBins.spheres().pairs,
            .boxOffsets = mBins.boxes().offsets,
            .boxPairs = mBins.boxes().pairs,
            .counters = mCounters.deviceAddress(),
            .progress = mProgress.deviceAddress(),
            .states = mRoundCount > 1 ? mStates.deviceAddress() : 0,
            .roundCount = mRoundCount};
}

void LinkedList::declareSurfaces(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                                 const char* stage, const gpu::GraphicsPipeline& pipeline) {
    frame::PassBuilder& pass = frame.addPass(fmt::format("oit.linked_list.surface_{}", stage));
    pass.reads(inputs.opaqueT, Access::FragmentSample);
    for (const gpu::Buffer* buffer :
         {&mOffsets, &mSurfaceOffsets, &mSurfaceCursors, &mCounters, &mEntries, &mRecords})
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
            push.meshIndex = mesh;
            commands.pushConstants(push);
        });
    });
}

void LinkedList::declareClear(frame::FrameBuilder& frame, const Band& band) {
    frame::PassBuilder& pass = frame.addPass("oit.linked_list.clear");
    for (const gpu::Buffer* buffer :
         {&mOffsets, &mSurfaceOffsets, &mSurfaceCursors, &mProgress, &mCounters})
        pass.writes(frame.importBuffer(*buffer), Access::TransferWrite);
    pass.record([this, isFirst = band.firstTile == 0](gpu::Commands& commands,
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

void LinkedList::declareCount(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band) {
    declareClear(frame, band);
    if (mNeeds.surfaces) declareSurfaces(frame, inputs, band, "count", mSurfaceCount);
    frame::PassBuilder& pass = frame.addPass("oit.linked_list.count");
    pass.reads(frame.importBuffer(mSurfaceOffsets), Access::ComputeRead);
    pass.readsWrites(frame.importBuffer(mOffsets), Access::ComputeWrite);
    declareMedia(frame, inputs, band, pass, mCount);
}

void LinkedList::declareMedia(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band,
                              frame::PassBuilder& pass, const gpu::ComputePipeline& pipeline) {
    mBins.declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.record([this, inputs, band, &pipeline](gpu::Commands& commands,
                                                const frame::PassResources& resources) {
        commands.bindCompute(pipeline);
        bindFrame(commands, inputs);
        bindMedia(commands, inputs, mBins.sortedSpheres());
        commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                      *inputs.texelSampler);
        shader::ListPush push = makePush(band);
        for (std::uint32_t slice = 0; slice < mSliceCount; ++slice) {
            if (slice > 0) commands.computeBarrier();  // the slice before it writes the same lists
            push.firstMedium = slice * shader::kMediaPerSlice;
            commands.pushConstants(push);
            commands.dispatchThreads(std::uint64_t{band.tileCount} * shader::kTileSize,
                                     kTilePixels);
        }
    });
}

void LinkedList::declareTotals(frame::FrameBuilder& frame, const Inputs& inputs) {
    frame::PassBuilder& pass = frame.addPass("oit.linked_list.totals");
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
    frame.addReadback("oit.linked_list.totals_read", frame.importBuffer(mTileTotals),
                      mTileTotalsRead);
}

void LinkedList::declareScan(frame::FrameBuilder& frame, const Band& band) {
    const std::uint32_t count = band.tileCount * kTilePixels + 1;
    frame::PassBuilder& pass = frame.addPass("oit.linked_list.scan");
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
    frame.addPass("oit.linked_list.band_total")
        .reads(frame.importBuffer(mSums), Access::TransferRead)
        .writes(frame.importBuffer(mBandTotals), Access::TransferWrite)
        .record([this, index, count](gpu::Commands& commands, const frame::PassResources&) {
            commands.copyBuffer(mSums, mBandTotals, 4, 4ull * gpu::PrefixSum::totalIndex(count),
                                4 * index);
        });
}

void LinkedList::declareStore(frame::FrameBuilder& frame, const Inputs& inputs, const Band& band) {
    frame::PassBuilder& pass = frame.addPass("oit.linked_list.store");
    pass.reads(frame.importBuffer(mOffsets), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mEntries, &mProgress})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    declareMedia(frame, inputs, band, pass, mStore);
    if (mNeeds.surfaces) declareSurfaces(frame, inputs, band, "store", mSurfaceStore);
}

void LinkedList::declareResolve(frame::FrameBuilder& frame, const Inputs& inputs,
                                const Band& band) {
    frame::PassBuilder& pass = frame.addPass("oit.linked_list.resolve");
    mBins.declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.reads(inputs.opaqueColor, Access::ComputeSample);
    for (const gpu::Buffer* buffer : {&mOffsets, &mSurfaceOffsets, &mRecords, &mProgress})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mEntries, &mCounters})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    if (mRoundCount > 1) pass.readsWrites(frame.importBuffer(mStates), Access::ComputeWrite);
    // Each band writes its own pixels of the image.
    if (band.firstTile == 0)
        pass.writes(inputs.result, Access::ComputeWrite);
    else
        pass.readsWrites(inputs.result, Access::ComputeWrite);
    pass.record(
        [this, inputs, band](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.bindCompute(mResolve);
            bindFrame(commands, inputs);
            bindMedia(commands, inputs, mBins.sortedSpheres());
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingOpaqueColor, resources.image(inputs.opaqueColor),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingResult, resources.image(inputs.result));
            shader::ListPush push = makePush(band);
            for (push.round = 0; push.round < push.roundCount; ++push.round) {
                if (push.round > 0) commands.computeBarrier();  // states of the round before it
                commands.pushConstants(push);
                commands.dispatchThreads(std::uint64_t{band.tileCount} * kTilePixels, kTilePixels);
            }
        });
}

void LinkedList::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    mBins.declareCount(frame, inputs);
    mBins.declareScatter(frame, inputs);
    for (const Band& band : mBands) {
        declareCount(frame, inputs, band);
        declareScan(frame, band);
        declareStore(frame, inputs, band);
        declareResolve(frame, inputs, band);
    }
    frame.addReadback("oit.linked_list.counters", frame.importBuffer(mCounters), mCountersRead);
    frame.addReadback("oit.linked_list.band_totals", frame.importBuffer(mBandTotals),
                      mBandTotalsRead);
}

std::map<std::string, std::uint64_t> LinkedList::counters() {
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
            {"rounds", mRoundCount}};
}

std::map<std::string, std::uint64_t> LinkedList::bytes() const {
    return {{"lists", mEntries.bytes() + mRecords.bytes()},
            {"listOffsets", mOffsets.bytes() + mSums.bytes() + mSurfaceOffsets.bytes() +
                                mSurfaceCursors.bytes() + mProgress.bytes()},
            {"listStates", mStates.bytes()},
            {"bins", mBins.bytes()}};
}

}  // namespace brume::oit
