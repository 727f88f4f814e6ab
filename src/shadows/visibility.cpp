// SPDX-License-Identifier: Apache-2.0
// What:   per texel a piecewise curve of optical depth over distance with at most K nodes.
// Source: M. Salvi, K. Vidimce, A. Lauritzen, A. Lefohn: "Adaptive volumetric shadow maps",
//         EGSR 2010. doi:10.1111/j.1467-8659.2010.01724.x
// Equations: section 3.2, node removal by least change -> removeLeastNode()
// Differs: casters come from lists sorted by distance and identity, so that the curve does not
//         depend on the order of submission; nodes keep the optical depth on both sides (a surface
//         is one node, a homogeneous medium two, both exact); channels share their nodes; the
//         curve is made with 4 nodes more than are kept; squared error, not area; a step may also
//         be moved to a neighbour.
// Limits: fewer nodes than the curve has steps and bends: the least important ones are smoothed.
// Cost:   4 K (1 + 2 c) bytes per texel with c channels; 4 K reads per lit point.
#include <shadows/map_pass.hpp>

#include <spv/shadows/visibility/build.comp.hpp>

namespace brume::shadows::visibility {
namespace {

constexpr std::uint32_t kSpareNodes = 4;
constexpr std::uint32_t kTurnsPerPiece = 8;

class Visibility final : public ShadowStore {
  public:
    Visibility(gpu::Device& device, const StoreRequest& request, std::uint32_t nodeCount)
        : mDevice(&device),
          mNodeCount(nodeCount),
          mBuild(makeMapPipeline(device, "shadow.visibility.build",
                                 spv::shadows_visibility_build_comp,
                                 {request.isColoured, nodeCount + kSpareNodes,
                                  request.hasSurfaces})) {}

    const StoreInfo& info() const override;
    void allocate(shader::ShadowMap& map) override {
        map.count = mNodeCount;
        mCurves = {*mDevice,
                   {.name = "shadow.visibility.curves",
                    .bytes = 4ull * mNodeCount * (1 + 2 * map.channels) * texelCount(map)}};
        map.texels = mCurves.deviceAddress();
    }
    void declare(frame::FrameBuilder& frame, const MapBuild& build) const override {
        declareWalk(frame, "shadow.visibility.build", build, mBuild, mCurves, kTurnsPerPiece);
    }
    std::uint64_t bytes() const override { return mCurves.bytes(); }

  private:
    gpu::Device* mDevice;
    std::uint32_t mNodeCount;
    gpu::ComputePipeline mBuild;
    gpu::Buffer mCurves;
};

}  // namespace

const StoreInfo& info() {
    static const StoreInfo kInfo{
        .name = "visibility",
        .summary = "Adaptive visibility curve per texel.",
        .paper = "Salvi, Vidimce, Lauritzen, Lefohn: Adaptive Volumetric Shadow Maps, 2010",
        .result = "exact where a curve has no more nodes than are kept, and behind everything",
        .bytesPerTexel = "4 K (1 + 2 c), K nodes, c channels",
        .limits = "16 faces of solid glass along a light ray",
        .bit = shader::kStoreVisibility,
        .settings = {{"nodes", "2 .. 32", "8", "nodes of a curve"}}};
    return kInfo;
}

const StoreInfo& Visibility::info() const { return visibility::info(); }

std::unique_ptr<ShadowStore> create(gpu::Device& device, const StoreRequest& request,
                                    const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up shadow visibility");
    const auto nodes = static_cast<std::uint32_t>(reader.integer("nodes", 8, 2, 32));
    reader.finish();
    return std::make_unique<Visibility>(device, request, nodes);
}

}  // namespace brume::shadows::visibility
