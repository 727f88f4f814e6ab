// SPDX-License-Identifier: Apache-2.0
// The scene in device memory, relative to the camera.
#pragma once

#include <gpu/buffer.hpp>
#include <gpu/image.hpp>
#include <gpu/submitter.hpp>
#include <oit/inputs.hpp>
#include <render/renderer.hpp>
#include <scene/camera.hpp>

#include <map>
#include <vector>

namespace brume::render {

/// Uploaded once per scene, camera and size.
class GpuScene {
  public:
    GpuScene(gpu::Submitter& submitter, const PreparedScene& scene);

    /// Puts all spheres, those of effects too, into an order drawn with that seed: no image may
    /// change.
    void shuffleSpheres(gpu::Submitter& submitter, std::uint64_t seed);

    /// Gives each light the address of its ShadowMap; parallel to lights().
    void setShadows(gpu::Submitter& submitter, const std::vector<VkDeviceAddress>& maps);

    /// Without the ambient ones: in the order of the shaders' array.
    const std::vector<scene::Light>& lights() const { return mSceneLights; }

    const scene::CameraFrame& camera() const {
        return mCamera;
    }  ///< of the samples; may stand in front of the scene's (orthographic)
    VkExtent2D extent() const;

    /// Everything but the frame's own references.
    oit::Inputs makeInputs() const;
    const gpu::Buffer& spheres() const { return mSpheres; }
    std::uint32_t sphereCount() const { return mSphereCount; }
    std::uint32_t firstEffectSphere(std::size_t effect) const { return mFirstEffectSphere[effect]; }

    const std::vector<oit::SurfaceDraw>& opaqueMeshes() const { return mOpaque; }
    const gpu::Image& environment() const { return mEnvironment; }
    std::uint64_t bytes() const;

  private:
    void findCamera(const PreparedScene& scene);
    void uploadFrame(gpu::Submitter& submitter, const PreparedScene& scene);
    void uploadSpheres(gpu::Submitter& submitter, const PreparedScene& scene);
    void uploadVolumes(gpu::Submitter& submitter, const PreparedScene& scene);
    void uploadMeshes(gpu::Submitter& submitter, const PreparedScene& scene);
    const gpu::Image* uploadTexture(gpu::Submitter& submitter, const scene::Texture* texture);

    scene::CameraFrame mCamera;
    std::vector<scene::Light> mSceneLights;
    oit::Needs mNeeds;
    double mFar = 1e6;
    gpu::Buffer mFrame, mLights, mMedia, mSpheres, mBoxes, mVolumes, mBrickValues;
    gpu::Buffer mVertices, mIndices, mMeshes, mMaterials;
    gpu::Image mEnvironment;
    std::map<const scene::Texture*, gpu::Image> mTextures;
    gpu::Sampler mTextureSampler, mTexelSampler;
    std::vector<oit::SurfaceDraw> mOpaque, mTransparent;
    std::vector<std::uint32_t> mFirstEffectSphere;
    std::uint32_t mSphereCount = 0, mBoxCount = 0;
    bool mSphereIdsAscend = true;
};

}  // namespace brume::render
