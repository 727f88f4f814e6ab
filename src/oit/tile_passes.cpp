// SPDX-License-Identifier: Apache-2.0
#include <oit/bindings.hpp>
#include <oit/tile_passes.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <spv/common/mesh.vert.float64.hpp>
#include <spv/common/mesh.vert.hpp>
#include <spv/oit/tile/classify.comp.float64.hpp>
#include <spv/oit/tile/classify.comp.hpp>
#include <spv/oit/tile/classify_boxes.comp.float64.hpp>
#include <spv/oit/tile/classify_boxes.comp.hpp>
#include <spv/oit/tile/composite.comp.float64.hpp>
#include <spv/oit/tile/composite.comp.hpp>
#include <spv/oit/tile/lit_volumes.comp.float64.hpp>
#include <spv/oit/tile/lit_volumes.comp.hpp>
#include <spv/oit/tile/mark_surfaces.frag.hpp>
#include <spv/oit/tile/order.comp.float64.hpp>
#include <spv/oit/tile/order.comp.hpp>
#include <spv/oit/tile/overlaps.comp.float64.hpp>
#include <spv/oit/tile/overlaps.comp.hpp>
#include <spv/oit/tile/volumes.comp.float64.hpp>
#include <spv/oit/tile/volumes.comp.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace brume::oit::tile {
namespace {

using frame::Access;

/// What passes over mixtures keep to put it in order.
struct MixWindows {
    std::uint32_t events;   ///< of each pixel, in overlaps.comp
    std::uint32_t spheres;  ///< of each tile, in order.comp
};
constexpr std::array<MixWindows, kMixCount> kMixWindows = {
    {{4, 8}, {6, 10}, {8, 12}, {12, 16}, {16, 24}, {24, 48}}};

const gpu::Binding kOpaqueT{shader::kBindingOpaqueT, gpu::BindingType::SampledImage};
const std::vector<gpu::Binding> kImages = {
    {shader::kBindingOpaqueColor, gpu::BindingType::SampledImage},
    {shader::kBindingTileResult, gpu::BindingType::StorageImage}};

}  // namespace

Passes::Passes(gpu::Device& device, const Inputs& inputs, const Settings& settings)
    : mDevice(&device),
      mSettings(settings),
      mNeeds(inputs.needs),
      mTileCount(countTiles(inputs.extent)),
      mBins(device, "oit.tile", inputs, true) {
    mAll = {makePipeline("classify",
                         choose(spv::oit_tile_classify_comp, spv::oit_tile_classify_comp_float64),
                         {}, {mSettings.overlap}),
            shader::kTileSize};
    if (canComposite())
        mOrdered = {
            makePipeline("composite",
                         choose(spv::oit_tile_composite_comp, spv::oit_tile_composite_comp_float64),
                         kImages),
            shader::kTileSize, shader::kClassOrdered};
    makeVolumes();
    if (mNeeds.surfaces) makeMark();
    mClasses = makeBuffer("classes", 4ull * mTileCount);
    mCounters = makeBuffer("counters", sizeof(shader::TileCounters));
}

void Passes::makeVolumes() {
    const std::uint32_t pixels = shader::kTileSize * shader::kTileSize;
    if (mNeeds.boxes && mNeeds.oneSource) {
        mVolumes = {
            makePipeline("volumes",
                         choose(spv::oit_tile_volumes_comp, spv::oit_tile_volumes_comp_float64),
                         kImages),
            pixels, shader::kClassVolumes};
    } else if (canLightVolumes()) {
        mVolumes = {makePipeline("lit_volumes",
                                 choose(spv::oit_tile_lit_volumes_comp,
                                        spv::oit_tile_lit_volumes_comp_float64),
                                 kImages, {mNeeds.lamps}),
                    pixels, shader::kClassVolumes};
        mClassifyBoxes = makePipeline(
            "classify_boxes",
            choose(spv::oit_tile_classify_boxes_comp, spv::oit_tile_classify_boxes_comp_float64),
            {});
    }
}

void Passes::makeMark() {
    mMark = {*mDevice,
             {.name = "oit.tile.mark_surfaces",
              // The one that the lists are drawn with: both must see the same pixels.
              .vertexSpirv = mDevice->features().shaderFloat64
                                 ? std::span<const std::uint32_t>(spv::common_mesh_vert_float64)
                                 : spv::common_mesh_vert,
              .fragmentSpirv = spv::oit_tile_mark_surfaces_frag,
              .bindings = join(surfaceBindings(), {kOpaqueT}),
              .pushConstantBytes = sizeof(shader::TilePush),
              .constants = lightingConstants(mNeeds)}};
}

gpu::ComputePipeline Passes::makePipeline(const char* stage, std::span<const std::uint32_t> spirv,
                                          const std::vector<gpu::Binding>& own,
                                          const std::vector<std::uint32_t>& specialization) const {
    std::vector<std::uint32_t> constants = {mNeeds.orthographic,
                                            mNeeds.varyingDensity,
                                            mNeeds.oneSource,
                                            mNeeds.colouredExtinction,
                                            mNeeds.oneSource ? 1 : std::max(mNeeds.media, 1u),
                                            mNeeds.oneMedium};
    constants.insert(constants.end(), specialization.begin(), specialization.end());
    return {*mDevice,
            {.name = std::string("oit.tile.") + stage,
             .spirv = spirv,
             .bindings = join(join(frameBindings(), mediaBindings()), join({kOpaqueT}, own)),
             .pushConstantBytes = sizeof(shader::TilePush),
             .specialization = std::move(constants),
             .constants = lightingConstants(mNeeds)}};
}

void Passes::prepareMixed(std::size_t window) {
    const std::uint64_t endBytes = 4ull * mBins.sphereCapacity();
    if (!mSphereEnds || mSphereEnds.bytes() < endBytes)
        mSphereEnds = makeBuffer("sphere_ends", endBytes);
    if (mMixed[window].pipeline) return;
    const MixWindows& size = kMixWindows[window];
    const auto classIfSmall = static_cast<std::uint32_t>(shader::kClassMix + window + 1);
    mMixed[window].threadsPerTile = shader::kTileSize;
    mMixed[window].tileClass = static_cast<std::uint32_t>(shader::kClassMix + window);
    mMixed[window].pipeline =
        makePipeline(fmt::format("overlaps_{}", size.events).c_str(),
                     choose(spv::oit_tile_overlaps_comp, spv::oit_tile_overlaps_comp_float64),
                     kImages, {size.events, classIfSmall, mNeeds.tinted || mNeeds.wholeShadows});
    mOrders[window] = makePipeline(
        fmt::format("order_{}", size.spheres).c_str(),
        choose(spv::oit_tile_order_comp, spv::oit_tile_order_comp_float64), {}, {size.spheres});
}

gpu::Buffer Passes::makeBuffer(const char* stage, std::uint64_t bytes,
                               gpu::MemoryKind memory) const {
    return {*mDevice,
            {.name = std::string("oit.tile.") + stage,
             .bytes = std::max<std::uint64_t>(bytes, 16),
             .memory = memory}};
}

void Passes::setTiles(Group& group, const std::vector<std::uint32_t>& tiles) const {
    group.tileCount = static_cast<std::uint32_t>(tiles.size());
    group.tiles = TileList(*mDevice, "oit.tile.tiles", tiles, group.threadsPerTile);
}

void Passes::setAll() {
    std::vector<std::uint32_t> all(mTileCount);
    std::iota(all.begin(), all.end(), 0u);
    setTiles(mAll, all);
}

shader::TilePush Passes::makePush(const TileList& tiles) const {
    return {.tiles = tiles.buffer().deviceAddress(),
            .sphereOffsets = mBins.spheres().offsets,
            .spherePairs = mBins.spheres().pairs,
            .sphereEnds = mSphereEnds ? mSphereEnds.deviceAddress() : 0,
            .boxOffsets = mBins.boxes().offsets,
            .boxPairs = mBins.boxes().pairs,
            .classes = mClasses.deviceAddress(),
            .counters = mCounters.deviceAddress(),
            .epsilon = mSettings.epsilon,
            .largestTint = mNeeds.largestTint};
}

Groups Passes::all() {
    Groups all = {&mOrdered, &mVolumes};
    for (std::size_t i = 0; i < mMixed.size(); ++i) all[2 + i] = &mMixed[i];
    return all;
}

void Passes::declareMark(frame::FrameBuilder& frame, const Inputs& inputs) {
    const frame::BufferRef classes = frame.importBuffer(mClasses);
    frame.addPass("oit.tile.clear_classes")
        .writes(classes, Access::TransferWrite)
        .record([this](gpu::Commands& commands, const frame::PassResources&) {
            commands.fillBuffer(mClasses, shader::kClassEmpty);
        });
    if (!mNeeds.surfaces) return;
    frame.addPass("oit.tile.mark_surfaces")
        .reads(inputs.opaqueT, Access::FragmentSample)
        .readsWrites(classes, Access::FragmentWrite)
        .renderArea(inputs.extent)
        .record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.bindGraphics(mMark);
            bindFrame(commands, inputs);
            bindMeshes(commands, inputs);
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            drawSurfaces(commands, inputs,
                         [&](std::uint32_t) { commands.pushConstants(makePush(mAll.tiles)); });
        });
}

void Passes::declareClassify(frame::FrameBuilder& frame, const Inputs& inputs) {
    const frame::BufferRef classes = frame.importBuffer(mClasses);
    frame::PassBuilder& pass = frame.addPass("oit.tile.classify");
    mBins.declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.readsWrites(classes, Access::ComputeWrite);
    pass.record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
        const auto run = [&](const gpu::ComputePipeline& pipeline, std::uint32_t threadsPerTile) {
            commands.bindCompute(pipeline);
            bindFrame(commands, inputs);
            bindMedia(commands, inputs, mBins.sortedSpheres(), mBins.listedBoxes(inputs));
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            commands.pushConstants(makePush(mAll.tiles));
            commands.dispatchThreads(std::uint64_t{mTileCount} * threadsPerTile, 64);
        };
        run(mAll.pipeline, shader::kTileSize);
        if (!mClassifyBoxes) return;
        commands.computeBarrier();
        run(mClassifyBoxes, shader::kTileSize * shader::kTileSize);
    });
}

void Passes::declareOrder(frame::FrameBuilder& frame, const Inputs& inputs, std::size_t window) {
    frame::PassBuilder& pass = frame.addPass(mOrders[window].name());
    mBins.declareReorders(frame, pass);
    mMixed[window].tiles.declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.writes(frame.importBuffer(mSphereEnds), Access::ComputeWrite);
    pass.record(
        [this, inputs, window](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.bindCompute(mOrders[window]);
            bindFrame(commands, inputs);
            bindMedia(commands, inputs, mBins.sortedSpheres(), mBins.listedBoxes(inputs));
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            commands.pushConstants(makePush(mMixed[window].tiles));
            mMixed[window].tiles.dispatchPerTile(commands);
        });
}

void Passes::declareComposite(frame::FrameBuilder& frame, const Inputs& inputs, Group& group,
                              bool isFirstWriter) {
    frame::PassBuilder& pass = frame.addPass(group.pipeline.name());
    mBins.declareReads(frame, pass);
    group.tiles.declareReads(frame, pass);
    pass.reads(inputs.opaqueT, Access::ComputeSample);
    pass.reads(inputs.opaqueColor, Access::ComputeSample);
    if (mSphereEnds) pass.reads(frame.importBuffer(mSphereEnds), Access::ComputeRead);
    for (const gpu::Buffer* buffer : {&mCounters, &mClasses})
        pass.readsWrites(frame.importBuffer(*buffer), Access::ComputeWrite);
    if (isFirstWriter)
        pass.writes(inputs.result, Access::ComputeWrite);
    else
        pass.readsWrites(inputs.result, Access::ComputeWrite);
    pass.record(
        [this, inputs, &group](gpu::Commands& commands, const frame::PassResources& resources) {
            commands.bindCompute(group.pipeline);
            bindFrame(commands, inputs);
            bindMedia(commands, inputs, mBins.sortedSpheres(), mBins.listedBoxes(inputs));
            commands.bind(shader::kBindingOpaqueT, resources.image(inputs.opaqueT),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingOpaqueColor, resources.image(inputs.opaqueColor),
                          *inputs.texelSampler);
            commands.bind(shader::kBindingTileResult, resources.image(inputs.result));
            commands.pushConstants(makePush(group.tiles));
            group.tiles.dispatch(commands);
        });
}

std::map<std::string, std::uint64_t> Passes::bytes() const {
    std::map<std::string, std::uint64_t> bytes;
    bytes["pairs"] = mBins.pairBytes();
    bytes["bins"] = mBins.bytes() - bytes["pairs"] + mSphereEnds.bytes();
    bytes["tiles"] = mClasses.bytes() + mAll.tiles.buffer().bytes() +
                     mOrdered.tiles.buffer().bytes() + mVolumes.tiles.buffer().bytes();
    for (const Group& group : mMixed) bytes["tiles"] += group.tiles.buffer().bytes();
    return bytes;
}

}  // namespace brume::oit::tile
