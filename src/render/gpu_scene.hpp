// SPDX-License-Identifier: Apache-2.0
// The scene in device memory, relative to the camera.
#pragma once

#include <gpu/buffer.hpp>
#include <gpu/image.hpp>
#include <gpu/submitter.hpp>
#include <gpu/upload_ring.hpp>
#include <oit/inputs.hpp>
#include <render/renderer.hpp>
#include <render/view.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/sphere.h>

#include <map>
#include <vector>

namespace brume::render {

/// What does not depend on the camera is uploaded once; what does, whenever it changes.
class GpuScene {
  public:
    /// Allocates; `scene` must outlive this. Nothing is on the device before recordContent().
    GpuScene(gpu::Device& device, const PreparedScene& scene, const View& view);

    /// Records the upload of everything. Allocates what a frame keeps until it is retired.
    void recordContent(gpu::Commands& commands);

    /// Looks from elsewhere; the size of the image stays.
    void setView(const View& view);
    /// The scene's lights, media, spheres, transforms or background have other values than before,
    /// but nothing is added or removed.
    void invalidate() { mIsMoved = true; }
    /// The scene counts from another point now; its transforms have changed.
    void rebase(const dvec3& newOrigin);
    /// Records the upload of what changed since recordContent() or the last call, ordered after all
    /// that was recorded before and before all that follows.
    void recordView(gpu::Commands& commands, gpu::UploadRing& ring);

    /// The scene's meshes have become others, of materials that it had: makes room for them.
    /// Their upload is that of recordMeshes() and the next recordView(); nothing that uses the old
    /// ones may be in flight.
    void replaceMeshes();
    void recordMeshes(gpu::Commands& commands);

    /// Puts all spheres, those of effects too, into an order drawn with that seed: no image may
    /// change.
    void shuffleSpheres(gpu::Submitter& submitter, std::uint64_t seed);

    /// Gives each light the address of its ShadowMap, parallel to lights(), and spheres that of
    /// their shares of light (FrameData::lightShares), from the next upload on.
    void setShadows(const std::vector<VkDeviceAddress>& maps, VkDeviceAddress shares);

    /// Without the ambient ones: in the order of the shaders' array.
    const std::vector<scene::Light>& lights() const { return mSceneLights; }

    const scene::CameraFrame& camera() const { return mView.camera; }
    VkExtent2D extent() const;

    /// Everything but the frame's own references.
    oit::Inputs makeInputs() const;
    const gpu::Buffer& spheres() const { return mSpheres; }
    gpu::Device& device() const { return *mDevice; }
    std::uint32_t sphereCount() const { return mSphereCount; }
    std::uint32_t firstEffectSphere(std::size_t effect) const { return mFirstEffectSphere[effect]; }

    const std::vector<oit::SurfaceDraw>& opaqueMeshes() const { return mOpaque; }
    const gpu::Image& environment() const { return mEnvironment; }
    std::uint64_t bytes() const;

  private:
    /// What depends on the camera, as the device will have it.
    struct ViewData {
        shader::FrameData frame{};
        std::vector<shader::LightData> lights;
        std::vector<shader::MediumData> media;
        std::vector<shader::SphereData> spheres;
        std::vector<shader::BoxData> boxes;
        std::vector<std::byte> meshes;  // one every kUniformStride bytes
    };
    void makeSpheres();
    void makeVolumes();
    void makeMeshes();
    void makeFrame();
    void fillFrame();
    void fillMoved();
    const gpu::Image* makeTexture(const scene::Texture* texture);
    template <typename T>
    gpu::Buffer makeArray(const char* name, std::size_t count) const;
    template <typename T>
    void growArray(gpu::Buffer& buffer, const char* name, std::size_t count) const;

    gpu::Device* mDevice;
    const PreparedScene* mPrepared;
    View mView;
    std::vector<scene::Light> mSceneLights;
    std::vector<VkDeviceAddress> mShadowMaps;  // by light
    VkDeviceAddress mLightShares = 0;
    oit::Needs mNeeds;
    ViewData mData;
    bool mIsMoved = true;  // positions relative to the camera are to be computed anew
    std::vector<dvec3> mBoxCorners;  // world
    std::vector<float> mBrickData;   // until it is uploaded
    gpu::Buffer mFrame, mLights, mMedia, mSpheres, mBoxes, mVolumes, mBrickValues;
    gpu::Buffer mVertices, mIndices, mMeshes, mMaterials;
    gpu::Image mEnvironment;
    std::map<const scene::Texture*, gpu::Image> mTextures;
    std::vector<const scene::Texture*> mNewTextures;  // that are not uploaded yet
    gpu::Sampler mTexelSampler;
    std::vector<oit::SurfaceDraw> mOpaque, mTransparent;
    std::vector<std::uint32_t> mFirstEffectSphere;
    std::uint32_t mSphereCount = 0, mBoxCount = 0;
    bool mSphereIdsAscend = true;
};

}  // namespace brume::render
