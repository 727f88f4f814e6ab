// SPDX-License-Identifier: Apache-2.0
// What: exact order-independent transparency by per-pixel lists of thin surfaces and medium
//       intervals, sorted by distance and integrated front to back; overlapping media add up.
// Source: P. Barta, B. Kovacs: "Order Independent Transparency with Per-Pixel Linked Lists",
//         Central European Seminar on Computer Graphics, 2011.
// Equations: section 2 -> crossConstant(), crossVarying(); section 3.5 -> walkConstant(),
//         findSolidsAroundEye().
// Differs: sums of extinction and source with an integer count of open media instead of running
//         albedo quotients (those give 0/0 in free space and leave a residue that hides the sky);
//         a list is a contiguous array, counted before it is stored, so that its memory is known
//         and nothing is lost; media are found per screen tile in compute and stored as 8 bytes
//         (distance, index), from which the resolve intersects again, in double where the device
//         has it: fp32 distances are thicker than what dense media need; only triangles are
//         rastered.
// Limits: more than some ten thousand varying media open at once at a pixel exceed what devices
//         that cap loop iterations do in one dispatch (counter "exhausted" > 0: not exact there).
//         Without shaderFloat64, media with optical depths of order 1 within 1e-6 of their distance
//         (sheets, rims) are off by up to 1e-4.
// Cost: 8 bytes per interval and surface, 32 more per surface (60 with solids), in blocks of 64 per
//         tile; short lists of thin surfaces alone: 32 per surface, 24 where all are grey. 8 per pixel,
//         16 with surfaces; where lists need several rounds to resolve, 216 more per pixel.
#include <oit/pixel_lists.hpp>

#include <numeric>

namespace brume::oit::linked_list {

namespace {

class LinkedList final : public OitMethod {
  public:
    LinkedList(gpu::Device& device, const Inputs& inputs, std::uint64_t budgetBytes,
               bool isEveryFrame)
        : mIsEveryFrame(isEveryFrame),
          mTileCount(countTiles(inputs.extent)),
          mBins(device, "oit.linked_list", inputs),
          mLists(device, "oit.linked_list", inputs.needs, budgetBytes, mBins) {
        std::vector<std::uint32_t> tiles(mTileCount);
        std::iota(tiles.begin(), tiles.end(), 0u);
        mLists.setTiles(tiles, mTileCount);
    }

    const MethodInfo& info() const override;

    void prepare(const MeasureFunction& measure) override {
        if (!measure || mIsEveryFrame) {
            reserve();
            return growBy(*this, measure, [this] { reserve(); });
        }
        measure([this](frame::FrameBuilder& frame, const Inputs& inputs) {
            mBins.declareCount(frame, inputs);
        });
        mBins.allocate();
        mLists.prepare(measure);
    }

    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override {
        mBins.declareCount(frame, inputs);
        mBins.declareScatter(frame, inputs);
        mLists.declare(frame, inputs, true);
    }

    std::map<std::string, std::uint64_t> counters() override {
        auto counters = mLists.counters();
        counters["dropped"] += mBins.droppedPairs();
        return counters;
    }

    bool lacksMemory() override {
        const auto counted = counters();
        return counted.at("dropped") + counted.at("exhausted") > 0;
    }

    std::optional<double> errorBound() override { return 0; }

    std::map<std::string, std::uint64_t> bytes() const override {
        auto bytes = mLists.bytes();
        bytes["bins"] = mBins.bytes();
        return bytes;
    }

  private:
    // Where nothing can be measured, to begin with: 4 KiB, eight entries a pixel.
    static constexpr std::uint32_t kBlocksPerTile = 64;

    void reserve() {
        mBins.reserve(std::uint64_t{mTileCount} * kReservedPairsPerTile);
        mLists.reserve(kBlocksPerTile);
    }

    bool mIsEveryFrame;
    std::uint32_t mTileCount;
    MediaBins mBins;
    PixelLists mLists;
};

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "linked_list",
        .summary =
            "Per-pixel lists of surfaces and medium intervals, sorted and integrated exactly.",
        .paper = "Barta, Kovacs: Order Independent Transparency with Per-Pixel Linked Lists, 2011",
        .exactness = Exactness::Exact,
        .passes = "1 compute (media) and 1 raster (surfaces), each twice: count, store; 1 resolve",
        .bytesPerPixel = "16 + 8 n + 40 s for n medium intervals and s surface fragments; 68 s with solids; "
                         "16 + 32 m of thin surfaces alone, 24 m of grey ones, where eight pixels in a row "
                         "have up to m",
        .limits = "one screen tile's lists must fit into the budget",
        .settings = {{"budgetMiB", "1 .. 1048576 MiB", "1024",
                      "memory for list entries and surface records; beyond it, the screen is "
                      "rendered in bands"},
                     kEveryFrameInfo}};
    return kInfo;
}

const MethodInfo& LinkedList::info() const { return linked_list::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method linked_list");
    const auto budgetMiB = reader.integer("budgetMiB", 1024, 1, 1 << 20);
    const bool isEveryFrame = reader.boolean(std::string(kEveryFrameInfo.name), false);
    reader.finish();
    return std::make_unique<LinkedList>(
        device, inputs, static_cast<std::uint64_t>(budgetMiB) << 20, isEveryFrame);
}

}  // namespace brume::oit::linked_list
