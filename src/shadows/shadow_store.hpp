// SPDX-License-Identifier: Apache-2.0
// The contract of a shadow store: what a light's map keeps of the casters along its rays. Its
// counterpart in shaders is shaders/shadows/<name>/transmittance.glsl.
#pragma once

#include <shadows/caster_bins.hpp>
#include <shadows/store_info.hpp>

#include <shaders/shadows/common/maps.h>

#include <memory>
#include <string>

namespace brume::shadows {

/// What a map needs of its store.
struct StoreRequest {
    bool isColoured = false;   ///< else one channel serves all three
    bool hasSurfaces = false;  ///< thin or solid ones
};

/// The map that a store is built for.
struct MapBuild {
    const shader::ShadowMap* map = nullptr;
    const gpu::Buffer* mapBuffer = nullptr;  ///< the same on the device
    const Casters* casters = nullptr;
    const CasterBins* bins = nullptr;
    frame::BufferRef spheres;
};

/// A store only adds passes to a frame that its host builds.
class ShadowStore {
  public:
    virtual ~ShadowStore() = default;

    virtual const StoreInfo& info() const = 0;

    /// Allocates for map.resolution and map.faceCount, and fills in what transmittance() reads.
    virtual void allocate(shader::ShadowMap& map) = 0;

    /// Adds the passes "shadow.<name>.<stage>" that build it.
    virtual void declare(frame::FrameBuilder& frame, const MapBuild& build) const = 0;

    /// Device memory held.
    virtual std::uint64_t bytes() const = 0;
};

/// Makes a registered store. Throws an input Error for an unknown name or setting.
std::unique_ptr<ShadowStore> createStore(const std::string& name, gpu::Device& device,
                                         const StoreRequest& request,
                                         const scene::Settings& settings);

}  // namespace brume::shadows
