// SPDX-License-Identifier: Apache-2.0
#include <oit/tile_plan.hpp>

#include <shaders/oit/tile/tile.h>
#include <spv/oit/tile/arguments.comp.hpp>
#include <spv/oit/tile/plan.comp.hpp>

#include <algorithm>

namespace brume::oit {
namespace {

using frame::Access;

gpu::ComputePipeline makePipeline(gpu::Device& device, const std::string& name,
                                  std::span<const std::uint32_t> spirv,
                                  std::vector<std::uint32_t> specialization = {}) {
    return {device,
            {.name = name,
             .spirv = spirv,
             .pushConstantBytes = sizeof(shader::TilePlanPush),
             .specialization = std::move(specialization)}};
}

gpu::Buffer makeList(gpu::Device& device, const std::string& name, std::size_t tiles,
                     gpu::MemoryKind memory) {
    return {device,
            {.name = name, .bytes = 4 * (shader::kTileListHead + tiles), .memory = memory}};
}

/// As arguments.comp does.
void storeGroups(std::span<std::uint32_t> arguments, std::size_t threads) {
    const auto groups = static_cast<std::uint32_t>((threads + 63) / 64);
    const std::uint32_t rows = std::max((groups + 65534) / 65535, 1u);
    arguments[0] = (groups + rows - 1) / rows;
    arguments[1] = rows;
    arguments[2] = 1;
}

}  // namespace

TileList::TileList(gpu::Device& device, const std::string& name,
                   std::span<const std::uint32_t> tiles, std::uint32_t threadsPerTile)
    : mBuffer(makeList(device, name, tiles.size(), gpu::MemoryKind::Upload)),
      mThreadsPerTile(threadsPerTile) {
    const std::span<std::uint32_t> list = mBuffer.mappedAs<std::uint32_t>();
    storeGroups(list, tiles.size() * threadsPerTile);
    storeGroups(list.subspan(shader::kTileListPerTile), tiles.size());
    list[shader::kTileListCount] = static_cast<std::uint32_t>(tiles.size());
    std::ranges::copy(tiles, list.begin() + shader::kTileListHead);
}

TileList::TileList(gpu::Device& device, const std::string& name, std::uint32_t capacity,
                   std::uint32_t threadsPerTile)
    : mBuffer(makeList(device, name, capacity, gpu::MemoryKind::Device)),
      mThreadsPerTile(threadsPerTile) {}

void TileList::declareReads(frame::FrameBuilder& frame, frame::PassBuilder& pass) const {
    const frame::BufferRef list = frame.importBuffer(mBuffer);
    pass.reads(list, Access::IndirectRead).reads(list, Access::ComputeRead);
}

void TileList::dispatchPerTile(gpu::Commands& commands) const {
    commands.dispatchIndirect(mBuffer, 4 * shader::kTileListPerTile);
}

TilePlan::TilePlan(gpu::Device& device, const std::string& name, std::uint32_t tileCount)
    : mName(name),
      mTileCount(tileCount),
      mList(makePipeline(device, name + ".list", spv::oit_tile_plan_comp, {false})),
      mMap(makePipeline(device, name + ".map", spv::oit_tile_plan_comp, {true})),
      mArguments(makePipeline(device, name + ".arguments", spv::oit_tile_arguments_comp)) {}

void TilePlan::declareList(frame::FrameBuilder& frame, const gpu::Buffer& classes,
                           std::uint32_t classMask, const TileList& list) const {
    const frame::BufferRef target = frame.importBuffer(list.buffer());
    frame.addPass(mName + ".list")
        .reads(frame.importBuffer(classes), Access::ComputeRead)
        .writes(target, Access::TransferWrite)
        .writes(target, Access::ComputeWrite)
        .record([this, &classes, classMask, &list](gpu::Commands& commands,
                                                   const frame::PassResources&) {
            const shader::TilePlanPush push{.classes = classes.deviceAddress(),
                                            .list = list.buffer().deviceAddress(),
                                            .tileCount = mTileCount,
                                            .classMask = classMask,
                                            .threadsPerTile = list.threadsPerTile()};
            commands.fillBuffer(list.buffer(), 0, 0, 4 * shader::kTileListHead);
            commands.computeTransferBarrier();
            commands.bindCompute(mList);
            commands.pushConstants(push);
            commands.dispatch((mTileCount + 63) / 64);
            commands.computeBarrier();
            commands.bindCompute(mArguments);
            commands.pushConstants(push);
            commands.dispatch(1);
        });
}

void TilePlan::declareMap(frame::FrameBuilder& frame, const gpu::Buffer& classes,
                          std::uint32_t classMask, const gpu::Buffer& tileMap) const {
    const frame::BufferRef target = frame.importBuffer(tileMap);
    frame.addPass(mName + ".map")
        .reads(frame.importBuffer(classes), Access::ComputeRead)
        .writes(target, Access::TransferWrite)
        .writes(target, Access::ComputeWrite)
        .record([this, &classes, classMask, &tileMap](gpu::Commands& commands,
                                                      const frame::PassResources&) {
            commands.fillBuffer(tileMap, 0, 0, 4);
            commands.computeTransferBarrier();
            commands.bindCompute(mMap);
            commands.pushConstants(shader::TilePlanPush{.classes = classes.deviceAddress(),
                                                        .list = tileMap.deviceAddress(),
                                                        .tileCount = mTileCount,
                                                        .classMask = classMask});
            commands.dispatch((mTileCount + 63) / 64);
        });
}

}  // namespace brume::oit
