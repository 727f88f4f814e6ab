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
#include <oit/pixel_lists.hpp>
#include <oit/tile_passes.hpp>

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

namespace brume::oit::tile {
namespace {

using frame::Access;

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
    /// Memory for frames that are planned on the device.
    void reserve();
    void makeLists();
    void planTiles();
    void declareBins(frame::FrameBuilder& frame, const Inputs& inputs);
    void readClasses(frame::FrameBuilder& frame);
    void declareClear(frame::FrameBuilder& frame, const Inputs& inputs);
    void declarePlanned(frame::FrameBuilder& frame, const Inputs& inputs);
    void declareGroupCounts(frame::FrameBuilder& frame);

    gpu::Device* mDevice;
    Settings mSettings;
    Needs mNeeds;
    std::uint32_t mTileCount;
    Passes mPasses;
    std::optional<TilePlan> mPlan;  // none: planned by the host, once
    std::optional<PixelLists> mLists;
    std::uint64_t mListTileCount = 0;
    gpu::Buffer mClassesRead, mCountersRead;
    gpu::Buffer mGroupCountsRead;  // uint per group
    bool mIsScreenCovered = true;  // by the tiles of one group
};

Tile::Tile(gpu::Device& device, const Inputs& inputs, const Settings& settings)
    : mDevice(&device),
      mSettings(settings),
      mNeeds(inputs.needs),
      mTileCount(countTiles(inputs.extent)),
      mPasses(device, inputs, settings),
      mClassesRead(
          mPasses.makeBuffer("classes_read", 4ull * mTileCount, gpu::MemoryKind::Readback)),
      mCountersRead(mPasses.makeBuffer("counters_read", sizeof(shader::TileCounters),
                                       gpu::MemoryKind::Readback)) {}

void Tile::reserve() {
    mPasses.bins().reserve(std::uint64_t{mTileCount} * kReservedPairsPerTile);
    if (!mPlan) {
        mPlan.emplace(*mDevice, "oit.tile.plan", mTileCount);
        mIsScreenCovered = false;
        mPasses.setAll();
        for (std::size_t i = 0; mPasses.canMix() && i < kMixCount; ++i) mPasses.prepareMixed(i);
        for (Group* group : mPasses.all())
            if (group->pipeline)
                group->tiles =
                    TileList(*mDevice, "oit.tile.tiles", mTileCount, group->threadsPerTile);
        mGroupCountsRead = mPasses.makeBuffer("group_counts_read", 4 * mPasses.all().size(),
                                              gpu::MemoryKind::Readback);
        makeLists();
        mLists->setAnyTiles(mTileCount);
    }
    if (mPasses.canMix()) mPasses.prepareMixed(0);  // room for all pairs
    constexpr std::uint32_t kBlocksPerTile = 16;    // 1 KiB, two entries a pixel
    mLists->reserve(kBlocksPerTile);
}

void Tile::makeLists() {
    mLists.emplace(*mDevice, "oit.tile.lists", mNeeds, mSettings.budgetBytes, mPasses.bins(),
                   mSettings.epsilon);
}

void Tile::prepare(const MeasureFunction& measure) {
    if (!measure || mSettings.everyFrame) {
        reserve();
        return growBy(*this, measure, [this] { reserve(); });
    }
    measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
        mPasses.bins().declareCount(frame, inputs);
    });
    mPasses.bins().allocate();
    mPasses.setAll();
    measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
        declareBins(frame, inputs);
        mPasses.declareMark(frame, inputs);
        mPasses.declareClassify(frame, inputs);
        readClasses(frame);
    });
    planTiles();
    // Which tiles cannot hold what is open at a time?
    for (std::size_t window = 0; window < kMixCount; ++window) {
        if (mPasses.mixed(window).tileCount == 0) continue;
        measure([this, window](frame::FrameBuilder& frame, const Inputs& inputs) {
            declareBins(frame, inputs);
            mPasses.declareOrder(frame, inputs, window);
            mPasses.declareComposite(frame, inputs, mPasses.mixed(window), true);
            readClasses(frame);
        });
        planTiles();
    }
    if (mLists) mLists->prepare(measure);
}

void Tile::planTiles() {
    std::vector<std::uint32_t> empty, ordered, volumes, lists;
    std::array<std::vector<std::uint32_t>, kMixCount> mixed;
    const auto classes = mClassesRead.mappedAs<std::uint32_t>();
    for (std::uint32_t tile = 0; tile < mTileCount; ++tile) {
        if (classes[tile] == shader::kClassEmpty)
            empty.push_back(tile);
        else if (classes[tile] == shader::kClassOrdered && mPasses.canComposite())
            ordered.push_back(tile);
        else if (classes[tile] >= shader::kClassMix && classes[tile] < shader::kClassLists &&
                 mPasses.canComposite())
            mixed[classes[tile] - shader::kClassMix].push_back(tile);
        else if (classes[tile] == shader::kClassVolumes && mPasses.volumes().pipeline)
            volumes.push_back(tile);
        else
            lists.push_back(tile);
    }
    // Copying the image is cheaper than visiting many empty tiles.
    mIsScreenCovered = mPasses.canComposite() && empty.size() < mTileCount / 4 &&
                       empty.size() + ordered.size() == mTileCount;
    if (mIsScreenCovered) ordered.insert(ordered.end(), empty.begin(), empty.end());
    mPasses.setTiles(mPasses.ordered(), ordered);
    mPasses.setTiles(mPasses.volumes(), volumes);
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        if (!mixed[i].empty()) mPasses.prepareMixed(i);
        mPasses.setTiles(mPasses.mixed(i), mixed[i]);
    }
    mPasses.forgetAll();  // not visited again
    mListTileCount = lists.size();
    mLists.reset();
    if (lists.empty()) return;
    makeLists();
    mLists->setTiles(lists, mTileCount);
}

void Tile::declareBins(frame::FrameBuilder& frame, const Inputs& inputs) {
    mPasses.bins().declareCount(frame, inputs);
    mPasses.bins().declareScatter(frame, inputs);
}

void Tile::readClasses(frame::FrameBuilder& frame) {
    frame.addReadback("oit.tile.classes_read", frame.importBuffer(mPasses.classes()), mClassesRead);
}

void Tile::declareClear(frame::FrameBuilder& frame, const Inputs& inputs) {
    frame::PassBuilder& pass = frame.addPass("oit.tile.clear");
    pass.writes(frame.importBuffer(mPasses.counters()), Access::TransferWrite);
    if (!mIsScreenCovered)
        pass.reads(inputs.opaqueColor, Access::TransferRead)
            .writes(inputs.result, Access::TransferWrite);
    pass.record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
        commands.fillBuffer(mPasses.counters(), 0);
        if (!mIsScreenCovered)
            commands.copyImage(resources.image(inputs.opaqueColor), resources.image(inputs.result));
    });
}

void Tile::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    declareBins(frame, inputs);
    declareClear(frame, inputs);
    if (mPlan) return declarePlanned(frame, inputs);
    bool isFirstWriter = mIsScreenCovered;
    const auto composite = [&](Group& group) {
        mPasses.declareComposite(frame, inputs, group, isFirstWriter);
        isFirstWriter = false;
    };
    for (Group* group : {&mPasses.ordered(), &mPasses.volumes()})
        if (group->tileCount > 0) composite(*group);
    for (std::size_t window = 0; window < kMixCount; ++window) {
        if (mPasses.mixed(window).tileCount == 0) continue;
        mPasses.declareOrder(frame, inputs, window);
        composite(mPasses.mixed(window));
    }
    if (mLists) mLists->declare(frame, inputs, false);
    frame.addReadback("oit.tile.counters_read", frame.importBuffer(mPasses.counters()),
                      mCountersRead);
}

// Tiles that a group cannot do have gone over to the class of a later one when that is listed.
void Tile::declarePlanned(frame::FrameBuilder& frame, const Inputs& inputs) {
    mPasses.declareMark(frame, inputs);
    mPasses.declareClassify(frame, inputs);
    std::uint32_t listClasses = (2u << shader::kClassLists) - 1 - (1u << shader::kClassEmpty);
    for (Group* group : mPasses.all()) {
        if (!group->pipeline) continue;
        listClasses &= ~(1u << group->tileClass);
        mPlan->declareList(frame, mPasses.classes(), 1u << group->tileClass, group->tiles);
        if (group->tileClass >= shader::kClassMix)
            mPasses.declareOrder(frame, inputs, group->tileClass - shader::kClassMix);
        mPasses.declareComposite(frame, inputs, *group, false);
    }
    mPlan->declareMap(frame, mPasses.classes(), listClasses, mLists->tileMap());
    mLists->declare(frame, inputs, false);
    declareGroupCounts(frame);
    frame.addReadback("oit.tile.counters_read", frame.importBuffer(mPasses.counters()),
                      mCountersRead);
}

void Tile::declareGroupCounts(frame::FrameBuilder& frame) {
    frame::PassBuilder& pass = frame.addPass("oit.tile.group_counts");
    for (const Group* group : mPasses.all())
        if (group->pipeline)
            pass.reads(frame.importBuffer(group->tiles.buffer()), Access::TransferRead);
    pass.writes(frame.importBuffer(mGroupCountsRead), Access::TransferWrite);
    pass.record([this](gpu::Commands& commands, const frame::PassResources&) {
        std::uint64_t at = 0;
        for (const Group* group : mPasses.all()) {
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
    std::array<std::uint64_t, 2 + kMixCount> tiles{};
    for (std::size_t i = 0; i < tiles.size(); ++i)
        tiles[i] =
            mPlan ? mGroupCountsRead.mappedAs<std::uint32_t>()[i] : mPasses.all()[i]->tileCount;
    std::map<std::string, std::uint64_t> counters = {{"dropped", 0}, {"exhausted", 0}};
    if (mLists) counters = mLists->counters();
    const auto own = mCountersRead.mappedAs<shader::TileCounters>()[0];
    counters["pairs"] = mPasses.bins().pairCount();
    counters["tilesOrdered"] = tiles[0];
    counters["tilesVolumes"] = tiles[1];
    // Planned on the device, those that one window was too small for are in the next one's list
    // too.
    counters["tilesMixed"] =
        mPlan ? tiles[2] : std::accumulate(tiles.begin() + 2, tiles.end(), std::uint64_t{0});
    counters["tilesLists"] = mPlan ? counters.at("listTiles") : mListTileCount;
    counters["dropped"] += mPasses.bins().droppedPairs();
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
    std::map<std::string, std::uint64_t> bytes = mPasses.bytes();
    if (mLists) bytes.merge(mLists->bytes());
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
