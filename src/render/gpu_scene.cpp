// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <gpu/upload.hpp>
#include <render/gpu_scene.hpp>
#include <render/needs.hpp>
#include <render/shader_data.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/frame_bindings.h>
#include <shaders/common/mesh.h>
#include <shaders/common/sphere.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

namespace brume::render {
namespace {

/// Uniform blocks, one every kUniformStride bytes.
template <typename T>
void setUniform(std::vector<std::byte>& bytes, std::size_t index, const T& value) {
    static_assert(sizeof(T) <= shader::kUniformStride);
    std::memcpy(&bytes[index * shader::kUniformStride], &value, sizeof(T));
}

dmat4 relativeFrom(const dmat4& worldFromObject, const dvec3& origin) {
    dmat4 m = worldFromObject;
    m[3] -= dvec4(origin, 0);
    return m;
}

}  // namespace

GpuScene::GpuScene(gpu::Device& device, const PreparedScene& prepared, const View& view)
    : mDevice(&device),
      mPrepared(&prepared),
      mView(view),
      mNeeds(findNeeds(prepared)),
      mTexelSampler(device, {.name = "render.texel_sampler", .filter = gpu::Filter::Nearest}) {
    makeSpheres();
    makeVolumes();
    makeMeshes();
    makeFrame();
}

VkExtent2D GpuScene::extent() const {
    return {static_cast<std::uint32_t>(mView.camera.width),
            static_cast<std::uint32_t>(mView.camera.height)};
}

/// Room for that many; bindings are never empty.
template <typename T>
gpu::Buffer GpuScene::makeArray(const char* name, std::size_t count) const {
    return {*mDevice, {.name = name, .bytes = std::max<std::size_t>(count, 1) * sizeof(T)}};
}

/// Keeps what is large enough; what grows does so by half, for the next time.
template <typename T>
void GpuScene::growArray(gpu::Buffer& buffer, const char* name, std::size_t count) const {
    if (buffer && buffer.bytes() >= count * sizeof(T)) return;
    buffer = makeArray<T>(name, buffer ? count + count / 2 : count);
}

void GpuScene::setView(const View& view) {
    if (view.camera.position != mView.camera.position) mIsMoved = true;
    mView = view;
}

void GpuScene::rebase(const dvec3& newOrigin) {
    for (dvec3& corner : mBoxCorners) corner -= newOrigin;
    mIsMoved = true;
}

void GpuScene::setShadows(const std::vector<VkDeviceAddress>& maps, VkDeviceAddress shares) {
    mShadowMaps = maps;
    mLightShares = shares;
}

void GpuScene::makeFrame() {
    const scene::Scene& scene = mPrepared->scene;
    for (const scene::Light& light : scene.lights)
        if (light.type != scene::LightType::Ambient) mSceneLights.push_back(light);
    mShadowMaps.resize(mSceneLights.size());
    const scene::Texture* environment = scene.background.environment.get();
    mEnvironment = gpu::Image(
        *mDevice,
        {.name = "render.environment",
         .format = VK_FORMAT_R32G32B32A32_SFLOAT,
         .width = environment ? static_cast<std::uint32_t>(environment->width) : 1u,
         .height = environment ? static_cast<std::uint32_t>(environment->height) : 1u});
    mFrame = makeArray<shader::FrameData>("render.frame", 1);
    mLights = makeArray<shader::LightData>(
        "render.lights", std::max<std::size_t>(mSceneLights.size(), shader::kUniformLights));
    mMedia = makeArray<shader::MediumData>("render.media", scene.media.size());
}

void GpuScene::fillFrame() {
    const scene::Scene& scene = mPrepared->scene;
    const scene::CameraFrame& camera = mView.camera;
    dvec3 ambient(0);
    std::size_t count = 0;
    for (const scene::Light& light : scene.lights) {
        if (light.type == scene::LightType::Ambient)
            ambient += light.color;
        else
            mSceneLights[count++] = light;
    }
    mData.lights.clear();
    for (std::size_t i = 0; i < mSceneLights.size(); ++i) {
        mData.lights.push_back(makeLight(mSceneLights[i], camera.position));
        mData.lights.back().shadow = mShadowMaps[i];
    }
    mData.media.clear();
    for (const scene::Medium& medium : scene.media) mData.media.push_back(makeMedium(medium));
    const scene::Texture* environment = scene.background.environment.get();
    const VkExtent2D size = extent();
    const ImagePlane plane = makeImagePlane(camera);
    mData.frame = {.right = vec3(camera.right),
                   .extentX = static_cast<float>(camera.extentX),
                   .up = vec3(camera.up),
                   .extentY = static_cast<float>(camera.extentY),
                   .centerX = static_cast<float>(camera.centerX),
                   .centerY = static_cast<float>(camera.centerY),
                   .forward = vec3(camera.forward),
                   .forwardLo = roundingOf(camera.forward),
                   .corner = vec3(plane.corner),
                   .cornerLo = roundingOf(plane.corner),
                   .pixelRight = vec3(plane.pixelRight),
                   .pixelRightLo = roundingOf(plane.pixelRight),
                   .pixelDown = vec3(plane.pixelDown),
                   .pixelDownLo = roundingOf(plane.pixelDown),
                   .near = static_cast<float>(camera.near),
                   .ambient = vec3(ambient),
                   .orthographic = camera.type == scene::CameraType::Orthographic,
                   .background = vec3(scene.background.radiance),
                   .environmentScale = static_cast<float>(scene.background.scale),
                   .size = {size.width, size.height},
                   .tiles = {(size.width + shader::kTileSize - 1) / shader::kTileSize,
                             (size.height + shader::kTileSize - 1) / shader::kTileSize},
                   .environmentSize = environment ? glm::uvec2(mEnvironment.extent().width,
                                                               mEnvironment.extent().height)
                                                  : glm::uvec2(0),
                   .sphereCount = mSphereCount,
                   .boxCount = mBoxCount,
                   .lightCount = static_cast<std::uint32_t>(mData.lights.size()),
                   .mediumCount = static_cast<std::uint32_t>(mData.media.size()),
                   .far = static_cast<float>(mView.far),
                   .brickValues = mBrickValues.deviceAddress(),
                   .lightShares = mLightShares};
}

void GpuScene::fillMoved() {
    const dvec3& origin = mView.camera.position;
    mData.spheres.clear();
    for (const scene::MediumSphere& sphere : mPrepared->spheres)
        mData.spheres.push_back(makeSphere(sphere, mData.spheres.size(), origin));
    for (std::size_t i = 0; i < mBoxCorners.size(); ++i) {
        const dvec3 corner = mBoxCorners[i] - origin;
        mData.boxes[i].corner = vec3(corner);
        mData.boxes[i].cornerLo = roundingOf(corner);
    }
    std::uint32_t vertex = 0, index = 0;
    for (std::size_t i = 0; i < mPrepared->scene.meshes.size(); ++i) {
        const scene::Mesh& mesh = mPrepared->scene.meshes[i];
        const dmat4 relative = relativeFrom(mesh.worldFromObject, origin);
        setUniform(mData.meshes, i,
                   shader::MeshData{
                       .relativeFromObject = glm::mat4x3(relative),
                       .relativeFromObjectLo = roundingOf(glm::dmat4x3(relative)),
                       .normalFromObject = glm::mat3(
                           glm::transpose(glm::inverse(dmat3(mesh.worldFromObject)))),
                       .firstVertex = vertex,
                       .firstIndex = index});
        vertex += static_cast<std::uint32_t>(mesh.positions.size());
        index += static_cast<std::uint32_t>(mesh.indices.size());
    }
    mIsMoved = false;
}

void GpuScene::recordView(gpu::Commands& commands, gpu::UploadRing& ring) {
    const bool isMoved = mIsMoved;
    if (isMoved) fillMoved();
    fillFrame();
    commands.fullBarrier();
    ring.write(commands, mFrame, std::span(&mData.frame, 1));
    ring.write(commands, mLights, mData.lights);
    ring.write(commands, mMedia, mData.media);
    if (isMoved) {
        ring.write(commands, mSpheres, mData.spheres);
        ring.write(commands, mBoxes, mData.boxes);
        ring.write(commands, mMeshes, mData.meshes);
    }
    commands.fullBarrier();
}

void GpuScene::makeSpheres() {
    const auto& spheres = mPrepared->spheres;
    mSphereIdsAscend = std::is_sorted(spheres.begin(), spheres.end(),
                                      [](const auto& a, const auto& b) { return a.id < b.id; });
    mSphereCount = static_cast<std::uint32_t>(spheres.size());
    for (const scene::EffectInstance& effect : mPrepared->scene.effects) {
        mFirstEffectSphere.push_back(mSphereCount);
        if (!effect.effect.surface) mSphereCount += effect.effect.capacity;
    }
    mSpheres = makeArray<shader::SphereData>("render.spheres", mSphereCount);
}

void GpuScene::shuffleSpheres(gpu::Submitter& submitter, std::uint64_t seed) {
    if (mSphereCount == 0) return;
    auto spheres = submitter.readBuffer<shader::SphereData>(mSpheres, mSphereCount);
    std::mt19937_64 random(seed);
    std::shuffle(spheres.begin(), spheres.end(), random);
    submitter.submitAndWait("upload spheres", [&](gpu::Commands& commands) {
        gpu::upload(commands, mSpheres, spheres);
    });
    mSphereIdsAscend = false;
}

void GpuScene::makeVolumes() {
    for (std::size_t i = 0; i < mPrepared->volumes.size(); ++i) {
        const volumes::VolumeGrid& grid = mPrepared->volumes[i];
        const auto index = static_cast<std::uint32_t>(i);
        if (mPrepared->scene.volumes[i].representation == scene::VolumeRepresentation::Particles)
            continue;
        const auto add = [&](const dvec3& lo, const dvec3& size, std::uint32_t kind,
                             std::uint64_t offset, float value) {
            mBoxCorners.push_back(transformPoint(grid.worldFromIndex, lo));
            mData.boxes.push_back({.volume = index,
                                   .size = vec3(size),
                                   .kind = kind,
                                   .valueOffset = static_cast<std::uint32_t>(offset),
                                   .value = value});
        };
        for (const volumes::Brick& brick : grid.bricks)
            add(dvec3(brick.origin), dvec3(volumes::kBrickCells), shader::kBoxBrick,
                mBrickData.size() + brick.valueOffset, brick.maxValue);
        for (const volumes::ValueBox& box : grid.boxes) {
            if (box.soft)
                add(box.lo - 1.0, box.hi - box.lo + 2.0, shader::kBoxSoft, 0, box.value);
            else
                add(box.lo, box.hi - box.lo, shader::kBoxHard, 0, box.value);
        }
        mBrickData.insert(mBrickData.end(), grid.values.begin(), grid.values.end());
    }
    if (mBrickData.size() > 0xffffffffull)
        throw failure("uploading volumes", "",
                      fmt::format("{} brick values, allowed are 2^32", mBrickData.size()));
    mBoxCount = static_cast<std::uint32_t>(mData.boxes.size());
    mVolumes = makeArray<shader::VolumeData>("render.volumes", mPrepared->volumes.size());
    mBoxes = makeArray<shader::BoxData>("render.boxes", mBoxCount);
    mBrickValues = makeArray<float>("render.brick_values", mBrickData.size());
}

const gpu::Image* GpuScene::makeTexture(const scene::Texture* texture) {
    gpu::Image& image = mTextures[texture];
    if (image) return &image;
    mNewTextures.push_back(texture);
    image = gpu::Image(
        *mDevice, {.name = texture ? "render.texture " + texture->name : "render.white",
                   .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                   .width = texture ? static_cast<std::uint32_t>(texture->width) : 1,
                   .height = texture ? static_cast<std::uint32_t>(texture->height) : 1});
    return &image;
}

void GpuScene::makeMeshes() {
    const scene::Scene& scene = mPrepared->scene;
    std::size_t vertices = 0, indices = 0;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const scene::Mesh& mesh = scene.meshes[i];
        const scene::Material& material = scene.materials[mesh.material];
        vertices += mesh.positions.size();
        indices += mesh.indices.size();
        const oit::SurfaceDraw draw{
            .mesh = static_cast<std::uint32_t>(i),
            .material = mesh.material,
            .vertexCount = static_cast<std::uint32_t>(mesh.indices.size()),
            .isSolid = material.type == scene::MaterialType::Solid,
            .colorTexture = makeTexture(material.colorTexture.get()),
            .emissionTexture = makeTexture(material.emissionTexture.get())};
        // Without a texture an alpha cutoff takes all of a mesh or nothing.
        if (!material.colorTexture && material.coverage < material.alphaCutoff) continue;
        (material.type == scene::MaterialType::Opaque ? mOpaque : mTransparent).push_back(draw);
    }
    growArray<shader::VertexData>(mVertices, "render.vertices", vertices);
    growArray<std::uint32_t>(mIndices, "render.indices", indices);
    mData.meshes.resize(scene.meshes.size() * shader::kUniformStride);
    growArray<std::byte>(mMeshes, "render.meshes",
                         std::max<std::size_t>(mData.meshes.size(), shader::kUniformStride));
    growArray<std::byte>(
        mMaterials, "render.materials",
        std::max<std::size_t>(scene.materials.size(), 1) * shader::kUniformStride);
}

void GpuScene::replaceMeshes() {
    mOpaque.clear();
    mTransparent.clear();
    makeMeshes();
    mIsMoved = true;
}

void GpuScene::recordMeshes(gpu::Commands& commands) {
    std::vector<shader::VertexData> vertices;
    std::vector<std::uint32_t> indices;
    for (const scene::Mesh& mesh : mPrepared->scene.meshes) {
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            vertices.push_back({mesh.positions[i], mesh.normals[i], mesh.uvs[i]});
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    gpu::upload(commands, mVertices, vertices);
    gpu::upload(commands, mIndices, indices);
    for (const scene::Texture* texture : mNewTextures)
        gpu::upload(commands, mTextures[texture],
                    texture ? texture->texels : std::vector<vec4>{vec4(1)});
    mNewTextures.clear();
}

void GpuScene::recordContent(gpu::Commands& commands) {
    const scene::Scene& scene = mPrepared->scene;
    std::vector<shader::VolumeData> volumes;
    for (std::size_t i = 0; i < mPrepared->volumes.size(); ++i) {
        const dmat3 linear(mPrepared->volumes[i].worldFromIndex);
        volumes.push_back({.indexFromWorld = glm::mat3(glm::inverse(linear)),
                           .worldFromIndex = glm::mat3(linear),
                           .medium = scene.volumes[i].medium});
    }
    std::vector<std::byte> materials(scene.materials.size() * shader::kUniformStride);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        setUniform(materials, i, makeMaterial(scene.materials[i]));
    gpu::upload(commands, mVolumes, volumes);
    gpu::upload(commands, mBrickValues, mBrickData);
    mBrickData = {};
    gpu::upload(commands, mMaterials, materials);
    recordMeshes(commands);
    const scene::Texture* environment = scene.background.environment.get();
    gpu::upload(commands, mEnvironment,
                environment ? environment->texels : std::vector<vec4>{vec4(0)});

    fillMoved();
    fillFrame();
    // Slots of effects are empty until their particles appear.
    mData.spheres.resize(mSphereCount);
    gpu::upload(commands, mFrame, std::span(&mData.frame, 1));
    gpu::upload(commands, mLights, mData.lights);
    gpu::upload(commands, mMedia, mData.media);
    gpu::upload(commands, mSpheres, mData.spheres);
    gpu::upload(commands, mBoxes, mData.boxes);
    gpu::upload(commands, mMeshes, mData.meshes);
}

oit::Inputs GpuScene::makeInputs() const {
    return {.needs = mNeeds,
            .extent = extent(),
            .supersample = static_cast<std::uint32_t>(mPrepared->scene.image.supersample),
            .frame = &mFrame,
            .lights = &mLights,
            .media = &mMedia,
            .boxes = &mBoxes,
            .volumes = &mVolumes,
            .vertices = &mVertices,
            .indices = &mIndices,
            .meshes = &mMeshes,
            .materials = &mMaterials,
            .environment = &mEnvironment,
            .texelSampler = &mTexelSampler,
            .sphereCount = mSphereCount,
            .boxCount = mBoxCount,
            .sphereIdsAscend = mSphereIdsAscend,
            .surfaces = mTransparent};
}

std::uint64_t GpuScene::bytes() const {
    std::uint64_t sum = mEnvironment.bytes();
    for (const auto& [texture, image] : mTextures) sum += image.bytes();
    for (const gpu::Buffer* buffer : {&mFrame, &mLights, &mMedia, &mSpheres, &mBoxes, &mVolumes,
                                      &mBrickValues, &mVertices, &mIndices, &mMeshes, &mMaterials})
        sum += buffer->bytes();
    return sum;
}

}  // namespace brume::render
