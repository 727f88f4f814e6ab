// SPDX-License-Identifier: Apache-2.0
#include <oit/bindings.hpp>
#include <oit/list_pipelines.hpp>

#include <shaders/common/frame_bindings.h>
#include <shaders/oit/linked_list/lists.h>
#include <spv/common/mesh.vert.float64.hpp>
#include <spv/common/mesh.vert.hpp>
#include <spv/oit/linked_list/count.comp.hpp>
#include <spv/oit/linked_list/resolve.comp.float64.hpp>
#include <spv/oit/linked_list/resolve.comp.hpp>
#include <spv/oit/linked_list/resolve_surfaces.comp.hpp>
#include <spv/oit/linked_list/store.comp.hpp>
#include <spv/oit/linked_list/surface_count.frag.hpp>
#include <spv/oit/linked_list/surface_store.frag.float64.hpp>
#include <spv/oit/linked_list/surface_store.frag.hpp>

namespace brume::oit {
namespace {

const gpu::Binding kOpaqueT{shader::kBindingOpaqueT, gpu::BindingType::SampledImage};

}  // namespace

ListPipelines::ListPipelines(gpu::Device& device, const std::string& name, const Needs& needs)
    : mDevice(&device), mName(name), mNeeds(needs) {
    mCount = makeCompute("count", spv::oit_linked_list_count_comp, {kOpaqueT},
                         {mNeeds.spheres, mNeeds.boxes, mNeeds.surfaces});
}

gpu::ComputePipeline ListPipelines::makeCompute(const char* stage,
                                                std::span<const std::uint32_t> spirv,
                                                const std::vector<gpu::Binding>& images,
                                                std::vector<std::uint32_t> specialization,
                                                std::vector<gpu::NumberedConstant> constants) const {
    return {*mDevice,
            {.name = mName + '.' + stage,
             .spirv = spirv,
             .bindings = join(frameBindings(), join(mediaBindings(), images)),
             .pushConstantBytes = sizeof(shader::ListPush),
             .specialization = std::move(specialization),
             .constants = std::move(constants)}};
}

gpu::GraphicsPipeline ListPipelines::makeSurface(const char* stage,
                                                 std::span<const std::uint32_t> spirv,
                                                 const ListTraits& traits) const {
    return {*mDevice,
            {.name = mName + '.' + stage,
             .vertexSpirv = chooseReal(*mDevice, spv::common_mesh_vert, spv::common_mesh_vert_float64),
             .fragmentSpirv = spirv,
             .bindings = join(surfaceBindings(), {kOpaqueT}),
             .pushConstantBytes = sizeof(shader::ListPush),
             .specialization = surfaceConstants(traits),
             .constants = lightingConstants(mNeeds)}};
}

/// kListConstant...
std::vector<std::uint32_t> ListPipelines::surfaceConstants(const ListTraits& traits) const {
    return {mNeeds.spheres || mNeeds.boxes, traits.isOneBand, traits.isAlone,
            mNeeds.colouredSurfaces, traits.isEveryTile};
}

void ListPipelines::makeSurfaceCount(const ListTraits& traits) {
    if (mNeeds.surfaces)
        mSurfaceCount =
            makeSurface("surface_count", spv::oit_linked_list_surface_count_frag, traits);
}

void ListPipelines::makeStores(const ListTraits& traits, bool mayLackRoom) {
    mStore = makeCompute("store", spv::oit_linked_list_store_comp, {kOpaqueT},
                         {mNeeds.spheres, mNeeds.boxes, mNeeds.surfaces, mayLackRoom});
    if (mNeeds.surfaces)
        mSurfaceStore =
            makeSurface("surface_store",
                        chooseReal(*mDevice, spv::oit_linked_list_surface_store_frag,
                                   spv::oit_linked_list_surface_store_frag_float64),
                        traits);
}

void ListPipelines::makeResolve(const ListTraits& traits) {
    const std::vector<gpu::Binding> images = {
        kOpaqueT,
        {shader::kBindingOpaqueColor, gpu::BindingType::SampledImage},
        {shader::kBindingResult, gpu::BindingType::StorageImage}};
    if (traits.isAlone) {
        mResolve = makeCompute("resolve", spv::oit_linked_list_resolve_surfaces_comp, images,
                               surfaceConstants(traits));
        return;
    }
    const bool isVarying = mNeeds.varyingDensity || mNeeds.varyingLight;
    const std::uint32_t keptMedia = mNeeds.media <= shader::kKeptMedia ? mNeeds.media : 0;
    mResolve = makeCompute(
        "resolve",
        chooseReal(*mDevice, spv::oit_linked_list_resolve_comp,
                   spv::oit_linked_list_resolve_comp_float64),
        images,
        {mNeeds.surfaces, mNeeds.boxes, isVarying, mNeeds.varyingLight, mNeeds.colouredExtinction,
         !traits.isOneRound, keptMedia, mNeeds.solids},
        lightingConstants(mNeeds));
}

}  // namespace brume::oit
