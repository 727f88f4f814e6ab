// SPDX-License-Identifier: Apache-2.0
// What can cast shadows in a scene, in the form that shadow maps read.
#pragma once

#include <render/gpu_scene.hpp>
#include <shadows/casters.hpp>

#include <shaders/shadows/common/maps.h>

#include <map>

namespace brume::render {

/// World box of the media and of the thin and solid surfaces, but for the particles of effects.
Box3 findTranslucentBounds(const PreparedScene& scene);

/// The triangles and materials of a scene for shadow maps; media are those of the GpuScene.
class ShadowCasters {
  public:
    /// `translucentBounds`: as findTranslucentBounds() says. Allocates; `scene` must outlive this.
    /// Nothing is on the device before recordContent().
    ShadowCasters(gpu::Device& device, const PreparedScene& scene, const GpuScene& deviceScene,
                  const Box3& translucentBounds);

    /// Records the upload of everything. Allocates what a frame keeps until it is retired.
    void recordContent(gpu::Commands& commands);
    /// The casters as seen from another origin; records the upload. Barriers are the caller's.
    void recordOrigin(gpu::Commands& commands, gpu::UploadRing& ring, const dvec3& origin);

    /// The scene counts from another point now; its transforms have changed.
    void rebase(const dvec3& newOrigin) { mCasters.origin -= newOrigin; }

    const shadows::Casters& casters() const { return mCasters; }
    std::uint64_t bytes() const;

  private:
    void makeTriangles();
    void makeMaterials(gpu::Device& device);

    const PreparedScene* mPrepared;
    shadows::Casters mCasters;
    std::vector<shader::ShadowTriangle> mTriangleData;  // relative to the casters' origin
    std::vector<shader::ShadowMaterial> mMaterialData;
    gpu::Buffer mTriangles, mMaterials;
    std::map<const scene::Texture*, gpu::Buffer> mTextures;
};

}  // namespace brume::render
