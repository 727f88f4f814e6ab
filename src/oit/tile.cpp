// SPDX-License-Identifier: Apache-2.0
// What: exact order-independent transparency in compute: media sorted by their smallest distance,
//       binned to screen tiles and composited front to back with all state in registers.
// Source: B. Kerbl et al.: "3D Gaussian Splatting for Real-Time Radiance Field Rendering", SIGGRAPH
//         2023, section 6 (tiles, depth order, early termination); A. Mai et al.: "EVER: Exact
//         Volumetric Ellipsoid Rendering for Real-time View Synthesis", 2024 (events of media that
//         overlap).
// Differs: media have extent; whether composition in the order of a tile's list is exact is not
//         assumed but found out at each pixel (classify.comp). Where media of constant density mix,
//         pixels go through their ends in the order of the tile's middle, which a small window in
//         registers puts right for each (overlaps.comp). Other tiles, such as those with surfaces,
//         get the sorted lists of each pixel (pixel_lists.hpp): nothing is dropped.
// Limits: with epsilon > 0 a pixel stops at that transmittance; the error is at most that times the
//         largest radiance that media or the background may still send (errorBound()). Without
//         `overlap`, spheres that mix are wrong, and nobody finds out by how much.
// Cost: 4 bytes per pair of tile and medium, 8 where media mix; nothing per pixel but where tiles
//         need lists.
#include <oit/bindings.hpp>
#include <oit/pixel_lists.hpp>
#include <oit/tile_plan.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <shaders/oit/tile/tile.h>
#include <shaders/shadows/common/maps.h>
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
#include <array>
#include <bit>
#include <numeric>
#include <optional>

namespace brume::oit::tile {
namespace {

using frame::Access;

/// What passes over mixtures keep to put it in order.
struct MixWindows {
    std::uint32_t events;   ///< of each pixel, in overlaps.comp
    std::uint32_t spheres;  ///< of each tile, in order.comp
};
constexpr std::array<MixWindows, shader::kClassLists - shader::kClassMix> kMixWindows = {
    {{4, 8}, {8, 12}, {12, 16}, {16, 24}, {24, 48}}};

const gpu::Binding kOpaqueT{shader::kBindingOpaqueT, gpu::BindingType::SampledImage};
const std::vector<gpu::Binding> kImages = {
    {shader::kBindingOpaqueColor, gpu::BindingType::SampledImage},
    {shader::kBindingTileResult, gpu::BindingType::StorageImage}};

struct Settings {
    float epsilon = 1.f / 1024;                 ///< transmittance at which a pixel stops; 0: exact
    std::uint64_t budgetBytes = 1024ull << 20;  ///< for lists
    bool overlap = true;      ///< false: spheres count as one behind the other
    bool everyFrame = false;  ///< plan each frame, on the device, also where measuring is possible
};

class Tile final : public OitMethod {
  public:
    Tile(gpu::Device& device, const Inputs& inputs, const Settings& settings);

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction& measure) override;
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override;
    std::optional<double> errorBound() override;
    bool lacksMemory() override;
    std::map<std::string, std::uint64_t> bytes() const override;

  private:
    /// Tiles that one pipeline visits.
    struct Group {
        gpu::ComputePipeline pipeline;
        std::uint32_t threadsPerTile = 0;
        std::uint32_t tileClass = shader::kClassEmpty;  ///< whose tiles it takes
        std::uint32_t tileCount = 0;                    ///< where the host has planned
        TileList tiles;
    };

    gpu::ComputePipeline makePipeline(const char* stage, std::span<const std::uint32_t> spirv,
                                      const std::vector<gpu::Binding>& own,
                                      const std::vector<std::uint32_t>& specialization = {}) const;
    /// Double precision shows where media are dense, and not beside what an early stop leaves out.
    std::span<const std::uint32_t> choose(std::span<const std::uint32_t> float32,
                                          std::span<const std::uint32_t> float64) const {
        return mSettings.epsilon == 0 && mDevice->features().shaderFloat64 ? float64 : float32;
    }
    /// Large shaders that few scenes need: made when there are tiles for them.
    void prepareMixed(std::size_t window);
    gpu::Buffer makeBuffer(const char* stage, std::uint64_t bytes,
                           gpu::MemoryKind memory = gpu::MemoryKind::Device) const;
    shader::TilePush makePush(const TileList& tiles) const;
    void setTiles(Group& group, const std::vector<std::uint32_t>& tiles) const;
    /// The whole screen, for classify.
    void setAll();
    /// Memory for frames that are planned on the device.
    void reserve();
    void makeLists();
    std::array<Group*, 2 + kMixWindows.size()> groups();
    void declarePlanned(frame::FrameBuilder& frame, const Inputs& inputs);
    void declareGroupCounts(frame::FrameBuilder& frame);
    void declareMark(frame::FrameBuilder& frame, const Inputs& inputs);
    void declareClassify(frame::FrameBuilder& frame, const Inputs& inputs);
    /// Sources are worked out once per ray: for a few media, where light is the same everywhere.
    bool canComposite() const {
        return !mNeeds.varyingLight && (mNeeds.oneSource || mNeeds.media <= shader::kTileMedia);
    }
    /// Bricks one behind the other, in one go: not where each look at a light walks its casters,
    /// which may take more loops than devices grant an invocation.
    bool canLightVolumes() const {
        return mNeeds.boxes && mNeeds.oneMedium && !mNeeds.oneSource &&
               (mNeeds.shadowStores & shader::kStoreExact) == 0;
    }
    bool canMix() const {
        return canComposite() && !mNeeds.oneSource && mNeeds.uniformSpheres && mSettings.overlap;
    }
    void planTiles();
    void declareClear(frame::FrameBuilder& frame, const Inputs& inputs);
    /// Lists the spheres of mixed tiles in the orders in which the rays through their middles meet
    /// them.
    void declareOrder(frame::FrameBuilder& frame, const Inputs& inputs, std::size_t window);
    void declareComposite(frame::FrameBuilder& frame, const Inputs& inputs, Group& group,
                          bool isFirstWriter);

    gpu::Device* mDevice;
    Settings mSettings;
    Needs mNeeds;
    std::uint32_t mTileCount;
    MediaBins mBins;
    Group mAll, mOrdered, mVolumes;                // mAll: those that classify visits
    std::array<Group, kMixWindows.size()> mMixed;  // by the size of their window
    std::array<gpu::ComputePipeline, kMixWindows.size()> mOrders;
    gpu::ComputePipeline mClassifyBoxes;
    std::optional<TilePlan> mPlan;  // none: planned by the host, once
    gpu::Buffer mGroupCountsRead;   // uint per group
    gpu::GraphicsPipeline mMark;
    std::optional<PixelLists> mLists;
    std::uint64_t mListTileCount = 0;
    gpu::Buffer mClasses, mClassesRead, mCounters, mCountersRead;
    gpu::Buffer mSphereEnds;       ///< uint[pairs], if media mix
    bool mIsScreenCovered = true;  // by the tiles of one group
};

Tile::Tile(gpu::Device& device, const Inputs& inputs, const Settings& settings)
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
    if (mNeeds.surfaces)
        mMark = {device,
                 {.name = "oit.tile.mark_surfaces",
                  // The one that the lists are drawn with: both must see the same pixels.
                  .vertexSpirv = device.features().shaderFloat64
                                     ? std::span<const std::uint32_t>(spv::common_mesh_vert_float64)
                                     : spv::common_mesh_vert,
                  .fragmentSpirv = spv::oit_tile_mark_surfaces_frag,
                  .bindings = join(surfaceBindings(), {kOpaqueT}),
                  .pushConstantBytes = sizeof(shader::TilePush),
                  .constants = lightingConstants(mNeeds)}};
    mClasses = makeBuffer("classes", 4ull * mTileCount);
    mClassesRead = makeBuffer("classes_read", 4ull * mTileCount, gpu::MemoryKind::Readback);
    mCounters = makeBuffer("counters", sizeof(shader::TileCounters));
    mCountersRead =
        makeBuffer("counters_read", sizeof(shader::TileCounters), gpu::MemoryKind::Readback);
}

gpu::ComputePipeline Tile::makePipeline(const char* stage, std::span<const std::uint32_t> spirv,
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

void Tile::prepareMixed(std::size_t window) {
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

gpu::Buffer Tile::makeBuffer(const char* stage, std::uint64_t bytes, gpu::MemoryKind memory) const {
    return {*mDevice,
            {.name = std::string("oit.tile.") + stage,
             .bytes = std::max<std::uint64_t>(bytes, 16),
             .memory = memory}};
}

void Tile::setTiles(Group& group, const std::vector<std::uint32_t>& tiles) const {
    group.tileCount = static_cast<std::uint32_t>(tiles.size());
    group.tiles = TileList(*mDevice, "oit.tile.tiles", tiles, group.threadsPerTile);
}

void Tile::setAll() {
    std::vector<std::uint32_t> all(mTileCount);
    std::iota(all.begin(), all.end(), 0u);
    setTiles(mAll, all);
}

shader::TilePush Tile::makePush(const TileList& tiles) const {
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

std::array<Tile::Group*, 2 + kMixWindows.size()> Tile::groups() {
    std::array<Group*, 2 + kMixWindows.size()> all = {&mOrdered, &mVolumes};
    for (std::size_t i = 0; i < mMixed.size(); ++i) all[2 + i] = &mMixed[i];
    return all;
}

void Tile::reserve() {
    mBins.reserve(std::uint64_t{mTileCount} * kReservedPairsPerTile);
    if (!mPlan) {
        mPlan.emplace(*mDevice, "oit.tile.plan", mTileCount);
        mIsScreenCovered = false;
        setAll();
        for (std::size_t i = 0; canMix() && i < mMixed.size(); ++i) prepareMixed(i);
        for (Group* group : groups())
            if (group->pipeline)
                group->tiles =
                    TileList(*mDevice, "oit.tile.tiles", mTileCount, group->threadsPerTile);
        mGroupCountsRead =
            makeBuffer("group_counts_read", 4 * groups().size(), gpu::MemoryKind::Readback);
        std::ranges::fill(mGroupCountsRead.mappedAs<std::uint32_t>(), 0u);
        makeLists();
        mLists->setAnyTiles(mTileCount);
    }
    if (canMix()) prepareMixed(0);  // room for all pairs
    constexpr std::uint32_t kBlocksPerTile = 16;  // 1 KiB, two entries a pixel
    mLists->reserve(kBlocksPerTile);
}

void Tile::makeLists() {
    mLists.emplace(*mDevice, "oit.tile.lists", mNeeds, mSettings.budgetBytes, mBins,
                   mSettings.epsilon);
}

void Tile::prepare(const MeasureFunction& measure) {
    if (!measure || mSettings.everyFrame) {
        reserve();
        return growBy(*this, measure, [this] { reserve(); });
    }
    measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
        mBins.declareCount(frame, inputs);
    });
    mBins.allocate();
    setAll();
    measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
        mBins.declareCount(frame, inputs);
        mBins.declareScatter(frame, inputs);
        declareMark(frame, inputs);
        declareClassify(frame, inputs);
    });
    planTiles();
    // Which tiles cannot hold what is open at a time?
    for (std::size_t window = 0; window < mMixed.size(); ++window) {
        if (mMixed[window].tileCount == 0) continue;
        measure([this, window](frame::FrameBuilder& frame, const Inputs& inputs) {
            mBins.declareCount(frame, inputs);
            mBins.declareScatter(frame, inputs);
            declareOrder(frame, inputs, window);
            declareComposite(frame, inputs, mMixed[window], true);
            frame.addReadback("oit.tile.classes_read", frame.importBuffer(mClasses), mClassesRead);
        });
        planTiles();
    }
    if (mLists) mLists->prepare(measure);
}

void Tile::declareMark(frame::FrameBuilder& frame, const Inputs& inputs) {
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
            drawSurfaces(commands, inputs, [&](std::uint32_t) {
                commands.pushConstants(makePush(mAll.tiles));
            });
        });
}

void Tile::declareClassify(frame::FrameBuilder& frame, const Inputs& inputs) {
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
    if (!mPlan) frame.addReadback("oit.tile.classes_read", classes, mClassesRead);
}

void Tile::planTiles() {
    std::vector<std::uint32_t> empty, ordered, volumes, lists;
    std::array<std::vector<std::uint32_t>, kMixWindows.size()> mixed;
    const auto classes = mClassesRead.mappedAs<std::uint32_t>();
    for (std::uint32_t tile = 0; tile < mTileCount; ++tile) {
        if (classes[tile] == shader::kClassEmpty)
            empty.push_back(tile);
        else if (classes[tile] == shader::kClassOrdered && canComposite())
            ordered.push_back(tile);
        else if (classes[tile] >= shader::kClassMix && classes[tile] < shader::kClassLists &&
                 canComposite())
            mixed[classes[tile] - shader::kClassMix].push_back(tile);
        else if (classes[tile] == shader::kClassVolumes && mVolumes.pipeline)
            volumes.push_back(tile);
        else
            lists.push_back(tile);
    }
    // Copying the image is cheaper than visiting many empty tiles.
    mIsScreenCovered = canComposite() && empty.size() < mTileCount / 4 &&
                       empty.size() + ordered.size() == mTileCount;
    if (mIsScreenCovered) ordered.insert(ordered.end(), empty.begin(), empty.end());
    setTiles(mOrdered, ordered);
    setTiles(mVolumes, volumes);
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        if (!mixed[i].empty()) prepareMixed(i);
        setTiles(mMixed[i], mixed[i]);
    }
    mAll.tiles = {};  // not visited again
    mListTileCount = lists.size();
    mLists.reset();
    if (lists.empty()) return;
    makeLists();
    mLists->setTiles(lists, mTileCount);
}

void Tile::declareClear(frame::FrameBuilder& frame, const Inputs& inputs) {
    frame::PassBuilder& pass = frame.addPass("oit.tile.clear");
    pass.writes(frame.importBuffer(mCounters), Access::TransferWrite);
    if (!mIsScreenCovered)
        pass.reads(inputs.opaqueColor, Access::TransferRead)
            .writes(inputs.result, Access::TransferWrite);
    pass.record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
        commands.fillBuffer(mCounters, 0);
        if (!mIsScreenCovered)
            commands.copyImage(resources.image(inputs.opaqueColor), resources.image(inputs.result));
    });
}

void Tile::declareOrder(frame::FrameBuilder& frame, const Inputs& inputs, std::size_t window) {
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

void Tile::declareComposite(frame::FrameBuilder& frame, const Inputs& inputs, Group& group,
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

void Tile::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    mBins.declareCount(frame, inputs);
    mBins.declareScatter(frame, inputs);
    declareClear(frame, inputs);
    if (mPlan) return declarePlanned(frame, inputs);
    bool isFirstWriter = mIsScreenCovered;
    const auto composite = [&](Group& group) {
        declareComposite(frame, inputs, group, isFirstWriter);
        isFirstWriter = false;
    };
    for (Group* group : {&mOrdered, &mVolumes})
        if (group->tileCount > 0) composite(*group);
    for (std::size_t window = 0; window < mMixed.size(); ++window) {
        if (mMixed[window].tileCount == 0) continue;
        declareOrder(frame, inputs, window);
        composite(mMixed[window]);
    }
    if (mLists) mLists->declare(frame, inputs, false);
    frame.addReadback("oit.tile.counters_read", frame.importBuffer(mCounters), mCountersRead);
}

// Tiles that a group cannot do have gone over to the class of a later one when that is listed.
void Tile::declarePlanned(frame::FrameBuilder& frame, const Inputs& inputs) {
    declareMark(frame, inputs);
    declareClassify(frame, inputs);
    std::uint32_t listClasses = (2u << shader::kClassLists) - 1 - (1u << shader::kClassEmpty);
    for (Group* group : groups()) {
        if (!group->pipeline) continue;
        listClasses &= ~(1u << group->tileClass);
        mPlan->declareList(frame, mClasses, 1u << group->tileClass, group->tiles);
        if (group->tileClass >= shader::kClassMix)
            declareOrder(frame, inputs, group->tileClass - shader::kClassMix);
        declareComposite(frame, inputs, *group, false);
    }
    mPlan->declareMap(frame, mClasses, listClasses, mLists->tileMap());
    mLists->declare(frame, inputs, false);
    declareGroupCounts(frame);
    frame.addReadback("oit.tile.counters_read", frame.importBuffer(mCounters), mCountersRead);
}

void Tile::declareGroupCounts(frame::FrameBuilder& frame) {
    frame::PassBuilder& pass = frame.addPass("oit.tile.group_counts");
    for (const Group* group : groups())
        if (group->pipeline)
            pass.reads(frame.importBuffer(group->tiles.buffer()), Access::TransferRead);
    pass.writes(frame.importBuffer(mGroupCountsRead), Access::TransferWrite);
    pass.record([this](gpu::Commands& commands, const frame::PassResources&) {
        std::uint64_t at = 0;
        for (const Group* group : groups()) {
            if (group->pipeline)
                commands.copyBuffer(group->tiles.buffer(), mGroupCountsRead, 4,
                                    4 * shader::kTileListCount, at);
            at += 4;
        }
    });
}

bool Tile::lacksMemory() {
    const auto counted = counters();
    return mPlan && counted.at("dropped") + counted.at("exhausted") > 0;
}

std::map<std::string, std::uint64_t> Tile::counters() {
    std::array<std::uint64_t, 2 + kMixWindows.size()> tiles{};
    for (std::size_t i = 0; i < tiles.size(); ++i)
        tiles[i] = mPlan ? mGroupCountsRead.mappedAs<std::uint32_t>()[i] : groups()[i]->tileCount;
    std::map<std::string, std::uint64_t> counters = {{"dropped", 0}, {"exhausted", 0}};
    if (mLists) counters = mLists->counters();
    const auto own = mCountersRead.mappedAs<shader::TileCounters>()[0];
    counters["pairs"] = mBins.pairCount();
    counters["tilesOrdered"] = tiles[0];
    counters["tilesVolumes"] = tiles[1];
    // Planned on the device, those that one window was too small for are in the next one's list too.
    counters["tilesMixed"] =
        mPlan ? tiles[2] : std::accumulate(tiles.begin() + 2, tiles.end(), std::uint64_t{0});
    counters["tilesLists"] = mPlan ? counters.at("listTiles") : mListTileCount;
    counters["dropped"] += mBins.droppedPairs();
    counters["exhausted"] += own.exhausted;
    counters["stopped"] += own.stopped;
    return counters;
}

std::optional<double> Tile::errorBound() {
    if (!mSettings.overlap) return std::nullopt;
    const double own =
        std::bit_cast<float>(mCountersRead.mappedAs<shader::TileCounters>()[0].bound);
    return mLists ? std::max(own, mLists->errorBound()) : own;
}

std::map<std::string, std::uint64_t> Tile::bytes() const {
    std::map<std::string, std::uint64_t> bytes;
    if (mLists) bytes = mLists->bytes();
    bytes["pairs"] = mBins.pairBytes();
    bytes["bins"] = mBins.bytes() - bytes["pairs"] + mSphereEnds.bytes();
    bytes["tiles"] = mClasses.bytes() + mAll.tiles.buffer().bytes() +
                     mOrdered.tiles.buffer().bytes() + mVolumes.tiles.buffer().bytes();
    for (const Group& group : mMixed) bytes["tiles"] += group.tiles.buffer().bytes();
    return bytes;
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "tile",
        .summary =
            "Media composited per screen tile in compute, in certified order; lists only "
            "where that needs them.",
        .paper = "Kerbl et al.: 3D Gaussian Splatting, 2023 (tiles); Barta, Kovacs 2011 (lists)",
        .exactness = Exactness::Bounded,
        .passes = "1 sort + 1 compute; those of linked_list for tiles with surfaces or mixtures",
        .bytesPerPixel = "0 (4 per pair of tile and medium); in tiles with lists as linked_list",
        .limits = "exact with epsilon = 0; else off by at most epsilon times the radiance behind",
        .settings = {{"epsilon", "0 .. 0.5", "0.0009765625",
                      "transmittance at which a pixel stops; 0: never"},
                     {"overlap", "true, false", "true",
                      "whether spheres mix where they overlap; false, for billboards that do not: "
                      "faster, and without an error bound"},
                     {"budgetMiB", "1 .. 1048576 MiB", "1024",
                      "memory for lists; beyond it, tiles are rendered in bands"},
                     kEveryFrameInfo}};
    return kInfo;
}

const MethodInfo& Tile::info() const { return tile::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method tile");
    Settings values;
    values.epsilon = static_cast<float>(reader.number("epsilon", values.epsilon, 0, 0.5));
    values.budgetBytes = static_cast<std::uint64_t>(reader.integer("budgetMiB", 1024, 1, 1 << 20))
                         << 20;
    values.overlap = reader.boolean("overlap", values.overlap);
    values.everyFrame = reader.boolean(std::string(kEveryFrameInfo.name), false);
    reader.finish();
    return std::make_unique<Tile>(device, inputs, values);
}

}  // namespace brume::oit::tile
