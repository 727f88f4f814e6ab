// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <oit/bindings.hpp>
#include <oit/pixel_lists.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <shaders/common/mesh.h>
#include <shaders/oit/linked_list/lists.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace brume::oit {
namespace {

using frame::Access;

constexpr std::uint32_t kTilePixels = shader::kTileSize * shader::kTileSize;
constexpr std::uint32_t kAllBands = 0;

/// Recorded where nothing is measured: beyond the reserved memory a frame takes longer first, and
/// drops only then.
constexpr std::uint32_t kReservedBands = 4, kMostBands = 4096;

bool hasMedia(const Needs& needs) { return needs.spheres || needs.boxes; }

}  // namespace

void growBy(OitMethod& method, const OitMethod::MeasureFunction& measure,
            const std::function<void()>& reserve) {
    // Rounds grow from 1 to 4096; memory fits after two frames, as the second sees all pairs.
    constexpr int kMostFrames = 9;
    for (int i = 0; measure && i < kMostFrames; ++i) {
        measure([&](frame::FrameBuilder& frame, const Inputs& inputs) {
            method.declare(frame, inputs);
        });
        if (!method.lacksMemory()) return;
        reserve();
    }
}

PixelLists::PixelLists(gpu::Device& device, const std::string& name, const Needs& needs,
                       std::uint64_t budgetBytes, MediaBins& bins, float epsilon)
    : mDevice(&device),
      mName(name),
      mBudgetBytes(budgetBytes),
      mEpsilon(epsilon),
      mNeeds(needs),
      mBins(&bins),
      mMemory(device, name, needs, bins),
      mPipelines(device, name, needs) {
    setAlone(false);
    mPipelines.makeStores(traits(), false);
    mPipelines.makeResolve(traits());
}

ListTraits PixelLists::traits() const {
    return {.isAlone = mIsAlone,
            .isOneBand = mMemory.bandCount() == 1,
            .isEveryTile = mMemory.hasEveryTile(),
            .isOneRound = mRoundCount == 1};
}

void PixelLists::setTiles(std::span<const std::uint32_t> tiles, std::uint32_t screenTileCount) {
    mMemory.setTiles(tiles, screenTileCount);
    mPipelines.makeSurfaceCount(traits());
}

void PixelLists::setAnyTiles(std::uint32_t screenTileCount) {
    mMemory.setAnyTiles(screenTileCount);
    mPipelines.makeSurfaceCount(traits());
}

std::uint32_t PixelLists::sliceCountFor(std::uint32_t mediaCount) const {
    return std::max((mediaCount + shader::kMediaPerSlice - 1) / shader::kMediaPerSlice, 1u);
}

void PixelLists::prepare(const OitMethod::MeasureFunction& measure) {
    mSliceCount = sliceCountFor(mBins->longestList());
    setAlone(mNeeds.surfaces && !hasMedia(mNeeds) && !mNeeds.solids);
    measureLengths(measure);
    constexpr std::uint64_t kMostBlocks = (std::uint64_t{1} << 32) / shader::kTileSize;
    if (mIsAlone && (mMemory.counters().longest > shader::kLongestOfSurfaces ||
                     planMemory().blocks >= kMostBlocks)) {
        setAlone(false);
        measureLengths(measure);
    }
    const Memory memory = planMemory();
    mMemory.allocate(memory.blocks, memory.bandCount);
    mPipelines.makeStores(traits(), false);
    mPipelines.makeResolve(traits());
    planRounds(measure);
}

void PixelLists::setAlone(bool isAlone) {
    mIsAlone = isAlone;
    if (isAlone)
        mMemory.setRecordWords(mNeeds.colouredSurfaces ? shader::kThinRecordWords
                                                       : shader::kGreyRecordWords);
    else
        mMemory.setRecordBytes(mNeeds.solids ? shader::kSolidRecordBytes : shader::kRecordBytes);
}

void PixelLists::measureLengths(const OitMethod::MeasureFunction& measure) {
    mMemory.allocate(1, 1);
    measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
        mBins->declareCount(frame, inputs);
        mBins->declareScatter(frame, inputs);
        declareCount(frame, inputs);
        mMemory.declarePlace(frame);
        mMemory.declareReadback(frame);
    });
}

void PixelLists::reserve(std::uint32_t blocksPerTile) {
    const shader::ListCounters seen = mMemory.counters();
    constexpr std::uint32_t kFirstSlices = 4, kMostRounds = 4096;
    const std::uint32_t longest = mBins->longestList();
    mSliceCount = std::max({mSliceCount, std::min(sliceCountFor(mBins->mediaCount()), kFirstSlices),
                            sliceCountFor(longest + longest / 4)});
    const std::uint64_t budget = mBudgetBytes / shader::kBlockBytes;
    const std::uint64_t wanted = seen.blocks + std::uint64_t{seen.blocks} / 4;
    const std::uint64_t least = std::uint64_t{mMemory.slotCapacity()} * blocksPerTile;
    const std::uint64_t blocks = std::min(std::max(wanted, least), budget);
    std::uint32_t bandCount = kReservedBands;
    if (blocks < wanted && seen.largestTile < blocks)
        bandCount = static_cast<std::uint32_t>(std::min<std::uint64_t>(
            wanted / (blocks - seen.largestTile) + 1, kMostBands));
    mMemory.allocate(blocks, bandCount);
    if (mIsAlone) {
        setAlone(false);
        mPipelines.makeResolve(traits());
    }
    mPipelines.makeStores(traits(), true);
    setRounds(seen.exhausted > 0 ? std::min(mRoundCount * 4, kMostRounds) : mRoundCount);
}

PixelLists::Memory PixelLists::planMemory() const {
    const shader::ListCounters wanted = mMemory.counters();
    const std::uint64_t budget = mBudgetBytes / shader::kBlockBytes;
    if (wanted.blocks <= budget) return {wanted.blocks, 1};
    // Tiles begin where the largest still ends within the band.
    if (wanted.largestTile < budget) {
        const std::uint64_t bands = (wanted.blocks - 1) / (budget - wanted.largestTile) + 1;
        if (bands <= kMostBands) return {budget, static_cast<std::uint32_t>(bands)};
    }
    throw inputError("setting up " + mName, "budgetMiB",
                     fmt::format("the lists of one tile of 8 x 8 pixels need {} MiB, allowed "
                                 "are budgets of more than that",
                                 (std::uint64_t{wanted.largestTile} * shader::kBlockBytes >> 20) + 1));
}

void PixelLists::setRounds(std::uint32_t count) {
    if (count != mRoundCount) {
        mRoundCount = count;
        mPipelines.makeResolve(traits());
    }
    const std::uint64_t pixels = std::uint64_t{mMemory.slotCapacity()} * kTilePixels;
    const std::uint64_t bytes = count > 1 ? pixels * sizeof(shader::PixelState) : 16;
    if (!mStates || mStates.bytes() != bytes)
        mStates = {*mDevice, {.name = mName + ".states", .bytes = bytes}};
}

void PixelLists::planRounds(const OitMethod::MeasureFunction& measure) {
    // So many constant media never need more: each enters and leaves once, and moves the others.
    constexpr std::uint64_t kAlwaysOneRound = 100;
    setRounds(mIsAlone ? 1 : mRoundCount);
    if (mIsAlone) return;
    if (!mNeeds.varyingDensity && !mNeeds.varyingLight &&
        mMemory.counters().longest <= kAlwaysOneRound)
        return;
    constexpr std::uint32_t kMaxRounds = 4096;
    for (;;) {
        measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
            mBins->declareCount(frame, inputs);
            mBins->declareScatter(frame, inputs);
            declare(frame, inputs, true);
        });
        if (counters().at("exhausted") == 0 || mRoundCount >= kMaxRounds) return;
        setRounds(mRoundCount * 2);
    }
}

shader::ListPush PixelLists::makePush(std::uint32_t band) const {
    shader::ListPush push = mMemory.makePush(band);
    push.roundCount = mRoundCount;
    push.epsilon = mEpsilon;
    push.largestTint = mNeeds.largestTint;
    push.states = mStates.deviceAddress();
    return push;
}

void PixelLists::declareSurfaces(frame::FrameBuilder& frame, const Inputs& inputs,
                                 std::uint32_t band, const char* stage,
                                 const gpu::GraphicsPipeline& pipeline) {
    frame::PassBuilder& pass = frame.addPass(fmt::format("{}.surface_{}", mName, stage));
    pass.reads(inputs.opaqueT, Access::FragmentSample);
    mMemory.declareReads(frame, pass, Access::FragmentRead);
    for (const gpu::Buffer* buffer : {&mMemory.offsets(), &mMemory.surfaceOffsets(),
                                      &mMemory.surfaceCursors(), &mMemory.lists()})
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
        for (std::uint32_t i = 0; i < inputs.surfaces.size(); ++i) {
            push.step = inputs.surfaces[i].mesh;
            commands.pushConstants(push);
            bindDraw(commands, inputs, inputs.surfaces[i]);
            if (band == kAllBands)
                commands.draw(inputs.surfaces[i].vertexCount);
            else
                mMemory.draw(commands, band, i);
        }
    });
}

void PixelLists::declareCount(frame::FrameBuilder& frame, const Inputs& inputs) {
    mMemory.declareBegin(frame, inputs);
    if (mNeeds.surfaces) declareSurfaces(frame, inputs, kAllBands, "count", mPipelines.surfaceCount());
    frame::PassBuilder& pass = frame.addPass(mName + ".count");
    pass.readsWrites(frame.importBuffer(mMemory.offsets()), Access::ComputeWrite);
    declareMedia(frame, inputs, kAllBands, pass, mPipelines.count());
}

void PixelLists::declareMedia(frame::FrameBuilder& frame, const Inputs& inputs,
                              std::uint32_t band, frame::PassBuilder& pass,
                              const gpu::ComputePipeline& pipeline) {
    mBins->declareReads(frame, pass);
    mMemory.declareReads(frame, pass, Access::ComputeRead);
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
            mMemory.dispatch(commands, band, slice > 0 ? Visit::LaterColumns : Visit::Columns);
        }
    });
}

void PixelLists::declareStore(frame::FrameBuilder& frame, const Inputs& inputs,
                              std::uint32_t band) {
    frame::PassBuilder& pass = frame.addPass(mName + ".store");
    for (const gpu::Buffer* buffer : {&mMemory.offsets(), &mMemory.surfaceOffsets()})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mMemory.lists(), &mMemory.progress()})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    declareMedia(frame, inputs, band, pass, mPipelines.store());
    if (mNeeds.surfaces) declareSurfaces(frame, inputs, band, "store", mPipelines.surfaceStore());
}

void PixelLists::declareResolve(frame::FrameBuilder& frame, const Inputs& inputs,
                                std::uint32_t band, bool isFirstWriter) {
    frame::PassBuilder& pass = frame.addPass(mName + ".resolve");
    mBins->declareReads(frame, pass);
    mMemory.declareReads(frame, pass, Access::ComputeRead);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.reads(inputs.opaqueColor, Access::ComputeSample);
    for (const gpu::Buffer* buffer : {&mMemory.offsets(), &mMemory.surfaceOffsets(),
                                      &mMemory.surfaceCursors(), &mMemory.progress()})
        pass.reads(frame.importBuffer(*buffer), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mMemory.lists(), &mMemory.countersBuffer()})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    if (mRoundCount > 1) pass.readsWrites(frame.importBuffer(mStates), Access::ComputeWrite);
    // Each band writes its own pixels of the image.
    if (isFirstWriter)
        pass.writes(inputs.result, Access::ComputeWrite);
    else
        pass.readsWrites(inputs.result, Access::ComputeWrite);
    pass.record(
        [this, inputs, band](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.bindCompute(mPipelines.resolve());
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
                mMemory.dispatch(commands, band, Visit::Pixels);
            }
        });
}

void PixelLists::declare(frame::FrameBuilder& frame, const Inputs& inputs, bool isFirstWriter) {
    declareCount(frame, inputs);
    mMemory.declarePlace(frame);
    for (std::uint32_t band = 1; band <= mMemory.bandCount(); ++band) {
        declareStore(frame, inputs, band);
        declareResolve(frame, inputs, band, isFirstWriter && band == 1);
    }
    mMemory.declareReadback(frame);
}

std::uint64_t PixelLists::unvisitedMedia() const {
    const std::uint64_t visited = std::uint64_t{mSliceCount} * shader::kMediaPerSlice;
    const std::uint64_t longest = mMemory.counters().slots > 0 ? mBins->longestList() : 0;
    return longest - std::min(longest, visited);
}

std::map<std::string, std::uint64_t> PixelLists::counters() {
    const shader::ListCounters counters = mMemory.counters();
    const auto sum = [](glm::uvec2 words) { return std::uint64_t{words.y} << 32 | words.x; };
    return {{"stored", sum(counters.stored)},
            {"surfaces", sum(counters.surfaces)},
            {"dropped", sum(counters.dropped) + unvisitedMedia()},
            {"bands", counters.bands},
            {"longestList", counters.longest},
            {"exhausted", counters.exhausted},
            {"rounds", mRoundCount},
            {"stopped", counters.stopped},
            {"listTiles", counters.slots},
            {"listBytesWanted", std::uint64_t{counters.blocks} * shader::kBlockBytes}};
}

double PixelLists::errorBound() { return std::bit_cast<float>(mMemory.counters().bound); }

std::map<std::string, std::uint64_t> PixelLists::bytes() const {
    auto bytes = mMemory.bytes();
    bytes["listStates"] = mStates.bytes();
    return bytes;
}

}  // namespace brume::oit
