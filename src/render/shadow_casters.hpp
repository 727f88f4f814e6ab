// SPDX-License-Identifier: Apache-2.0
// What can cast shadows in a scene, in the form that shadow maps read.
#pragma once

#include <render/gpu_scene.hpp>
#include <shadows/casters.hpp>

#include <map>

namespace brume::render {

/// World box of the media and of the thin and solid surfaces.
Box3 findTranslucentBounds(const PreparedScene& scene,
                           std::span<const scene::MediumSphere> particles);

/// Uploads the triangles and materials of a scene for shadow maps; media are those of the GpuScene.
class ShadowCasters {
  public:
    /// `particles`: of the effects, as far as they are on the device. Nothing is uploaded unless
    /// some light has a shadow.
    ShadowCasters(gpu::Submitter& submitter, const PreparedScene& scene, const GpuScene& device,
                  std::span<const scene::MediumSphere> particles);

    const shadows::Casters& casters() const { return mCasters; }
    std::uint64_t bytes() const;

  private:
    void uploadTriangles(gpu::Submitter& submitter, const PreparedScene& scene);
    void uploadMaterials(gpu::Submitter& submitter, const PreparedScene& scene);

    shadows::Casters mCasters;
    gpu::Buffer mTriangles, mMaterials;
    std::map<const scene::Texture*, gpu::Buffer> mTextures;
};

}  // namespace brume::render
