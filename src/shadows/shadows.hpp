// SPDX-License-Identifier: Apache-2.0
// The shadow maps of all lights of a scene.
#pragma once

#include <gpu/submitter.hpp>
#include <gpu/upload_ring.hpp>
#include <scene/scene.hpp>
#include <shadows/light_map.hpp>
#include <shadows/shadow_store.hpp>
#include <shadows/sphere_shares.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brume::shadows {

/// Over what a map averages at a point: a tent that reaches so far to either side.
struct Footprint {
    double reach = 0;  ///< m; 0: not at all, or not the same everywhere
    dvec3 right{0}, up{0};
    double bytesPerTexel = 0;  ///< of the store
};

class Shadows {
  public:
    /// `lights`: those of the shaders' array, in its order; each with its own store and settings,
    /// to which `overrides` are added. Throws an input Error for an unknown store or setting.
    Shadows(gpu::Device& device, const Casters& casters, std::span<const scene::Light> lights,
            const scene::Settings& overrides);

    using DeclareFunction = std::function<void(frame::FrameBuilder&, frame::BufferRef spheres)>;
    /// Runs one frame that ends with the given passes and returns when the device has finished it.
    using MeasureFunction = std::function<void(const DeclareFunction&)>;
    /// Finds out how many casters each tile has and allocates; once, before the first frame.
    void prepare(gpu::Submitter& submitter, const MeasureFunction& measure);

    /// Instead of prepare(), for hosts that cannot wait: room for so many pairs of tile and caster of
    /// each kind in each map. fit() and recordMaps() are due before the first frame.
    void reserve(std::uint32_t pairs);
    /// Fits the maps to where lights and casters are now, in device coordinates relative to `origin`;
    /// the number of lights and their stores stay.
    void fit(std::span<const scene::Light> lights, const dvec3& origin,
             const Box3& translucentBounds);
    /// Records the upload of what fit() has changed. Barriers are the caller's.
    void recordMaps(gpu::Commands& commands, gpu::UploadRing& ring) const;
    /// After reserve(): pairs that the newest finished frame had no room for.
    std::uint64_t droppedPairs() const;
    /// Some map is built once and kept: after the first frame, declare() adds less.
    bool keepsMaps() const;
    /// Kept maps are built anew by the next declare().
    void invalidate();

    /// Passes "shadow.<store>.<stage>" of all maps and "shadow.spheres"; what is declared after them may light things.
    void declare(frame::FrameBuilder& frame, frame::BufferRef spheres);

    /// Per light the address that its LightData takes; 0: no shadow.
    std::vector<VkDeviceAddress> addresses() const;
    /// What FrameData::lightShares takes; 0: no sphere is shadowed as a whole.
    VkDeviceAddress sharesAddress() const { return mShares ? mShares->address() : 0; }
    /// Device memory by kind; empty where no light has a shadow.
    std::map<std::string, std::uint64_t> bytes() const;
    Footprint footprint(std::uint32_t light) const;

  private:
    struct Map {
        std::unique_ptr<ShadowStore> store;
        std::unique_ptr<CasterBins> bins;
        shader::ShadowMap data{};
        gpu::Buffer buffer;
        CasterChoice choice = CasterChoice::All;
        Box3 bounds;
        Focus focus;
        bool isKept = false;  // once built, while nothing moves
        bool isBuilt = false;
    };
    struct LightMaps {
        std::unique_ptr<Map> own;     // of the light's store, or empty where nothing casts
        std::unique_ptr<Map> opaque;  // of the opaque casters
    };
    std::vector<Map*> allMaps() const;
    void linkOpaqueMaps();
    std::unique_ptr<Map> makeMap(const scene::Light& light, const std::string& store,
                                 scene::Settings settings);

    gpu::Device* mDevice;
    Casters mCasters;
    std::vector<LightMaps> mLights;
    std::optional<SphereShares> mShares;
};

}  // namespace brume::shadows
