// SPDX-License-Identifier: Apache-2.0
// What: media sorted far to near by the distance of their centres on the device, then blended with
//       "over": what most engines do.
// Source: T. Porter, T. Duff: "Compositing Digital Images", SIGGRAPH 1984 (the operator).
// Limits: overlapping media are not mixed and pop when their centres change order; surfaces are
//         blended after all media, solids after all; coloured transmission is blended by its mean.
// Cost: 24 bytes per medium; one sort, one raster pass.
#include <gpu/radix_sort.hpp>
#include <oit/bindings.hpp>
#include <oit/layers.hpp>
#include <oit/oit_method.hpp>

#include <shaders/oit/layers/layers.h>
#include <spv/oit/sorted/keys.comp.hpp>

#include <algorithm>

namespace brume::oit::sorted {
namespace {

using frame::Access;

class Sorted final : public OitMethod {
  public:
    Sorted(gpu::Device& device, const Inputs& inputs, std::uint32_t lowResolution)
        : mCount(inputs.sphereCount + inputs.boxCount),
          mLayers(device, "oit.sorted", inputs, lowResolution),
          mKeysPipeline(device, {.name = "oit.sorted.keys",
                                 .spirv = spv::oit_sorted_keys_comp,
                                 .bindings = join(frameBindings(), mediaBindings()),
                                 .pushConstantBytes = sizeof(shader::LayerPush)}),
          mSort(device, "oit.sorted.sort", mCount),
          mKeys(device, {.name = "oit.sorted.keys", .bytes = 4ull * std::max(mCount, 1u)}),
          mOrder(device, {.name = "oit.sorted.order", .bytes = 4ull * std::max(mCount, 1u)}) {}

    const MethodInfo& info() const override;
    void prepare(const MeasureFunction&) override {}
    void declare(frame::FrameBuilder& frame, const Inputs& inputs) override;
    std::map<std::string, std::uint64_t> counters() override { return {}; }
    std::map<std::string, std::uint64_t> bytes() const override {
        return {{"sort", mSort.bytes() + mKeys.bytes() + mOrder.bytes()}};
    }

  private:
    std::uint32_t mCount;
    OverLayers mLayers;
    gpu::ComputePipeline mKeysPipeline;
    gpu::RadixSort mSort;
    gpu::Buffer mKeys, mOrder;
};

void Sorted::declare(frame::FrameBuilder& frame, const Inputs& inputs) {
    const frame::BufferRef order = frame.importBuffer(mOrder);
    frame.addPass("oit.sorted.sort")
        .reads(inputs.spheres, Access::ComputeRead)
        .writes(frame.importBuffer(mKeys), Access::ComputeWrite)
        .writes(order, Access::ComputeWrite)
        .record([this, inputs](gpu::Commands& commands, const frame::PassResources& resources) {
            if (mCount == 0) return;
            commands.bindCompute(mKeysPipeline);
            bindFrame(commands, inputs);
            bindMedia(commands, inputs, resources.buffer(inputs.spheres), *inputs.boxes);
            commands.pushConstants(shader::LayerPush{
                .keys = mKeys.deviceAddress(), .order = mOrder.deviceAddress(), .count = mCount});
            commands.dispatch((mCount + 63) / 64);
            commands.computeBarrier();
            mSort.record(commands, mKeys, mOrder, mCount);
        });
    mLayers.declare(frame, inputs, order);
}

}  // namespace

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "sorted",
        .summary = "Billboards sorted by the distance of their centres, blended far to near.",
        .paper = "Porter, Duff: Compositing Digital Images, 1984",
        .exactness = Exactness::Approximate,
        .passes = "1 sort + 1 raster",
        .bytesPerPixel = "0 (16 per medium; 40 with solids; lowResolution n: 16 / n^2)",
        .limits =
            "overlapping media are not mixed; surfaces come after all media; colour of "
            "transmission is averaged",
        .weaknesses = {Weakness::Overlap, Weakness::Surfaces, Weakness::Colour},
        .settings = {kLowResolution}};
    return kInfo;
}

const MethodInfo& Sorted::info() const { return sorted::info(); }

std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings) {
    scene::SettingsReader reader(settings, "setting up method sorted");
    const std::uint32_t lowResolution = readLowResolution(reader);
    reader.finish();
    return std::make_unique<Sorted>(device, inputs, lowResolution);
}

}  // namespace brume::oit::sorted
