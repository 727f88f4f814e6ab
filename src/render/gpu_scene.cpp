// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <gpu/upload.hpp>
#include <render/gpu_scene.hpp>
#include <render/needs.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/mesh.h>
#include <shaders/common/sphere.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

namespace brume::render {
namespace {

/// A buffer with the values, or with one zero element: bindings are never empty.
template <typename T>
gpu::Buffer makeArray(gpu::Submitter& submitter, const std::string& name, std::vector<T> values) {
    if (values.empty()) values.resize(1);
    gpu::Buffer buffer;
    submitter.submitAndWait("upload " + name, [&](gpu::Commands& commands) {
        buffer = gpu::makeBuffer(commands, name, values);
    });
    return buffer;
}

/// Uniform blocks, one every kUniformStride bytes.
template <typename T>
gpu::Buffer makeUniforms(gpu::Submitter& submitter, const std::string& name,
                         const std::vector<T>& values) {
    static_assert(sizeof(T) <= shader::kUniformStride);
    std::vector<std::byte> bytes(values.size() * shader::kUniformStride);
    for (std::size_t i = 0; i < values.size(); ++i)
        std::memcpy(&bytes[i * shader::kUniformStride], &values[i], sizeof(T));
    return makeArray(submitter, name, std::move(bytes));
}

/// What rounding to float takes from a value.
float roundingOf(double value) { return static_cast<float>(value - static_cast<float>(value)); }
vec3 roundingOf(const dvec3& value) { return vec3(value - dvec3(vec3(value))); }

shader::LightData makeLight(const scene::Light& light, const dvec3& origin) {
    shader::LightData data{};
    data.color = vec3(light.color);
    data.type = light.type == scene::LightType::Directional ? shader::kLightDirectional
                : light.type == scene::LightType::Point     ? shader::kLightPoint
                                                            : shader::kLightSpot;
    data.position = vec3(light.position - origin);
    data.radius = static_cast<float>(light.radius);
    data.direction = vec3(light.direction);
    data.cosInner = static_cast<float>(std::cos(light.innerAngle));
    data.cosOuter = static_cast<float>(std::cos(light.outerAngle));
    return data;
}

shader::MediumData makeMedium(const scene::Medium& medium) {
    return {.extinction = vec3(medium.extinction),
            .phase = medium.phase == scene::PhaseType::Isotropic  ? shader::kPhaseIsotropic
                     : medium.phase == scene::PhaseType::Rayleigh ? shader::kPhaseRayleigh
                                                                  : shader::kPhaseHenyeyGreenstein,
            .albedo = vec3(medium.albedo),
            .g = static_cast<float>(medium.g),
            .emission = vec3(medium.emission)};
}

shader::MaterialData makeMaterial(const scene::Material& material) {
    shader::MaterialData data{};
    data.albedo = vec3(material.albedo);
    data.type = material.type == scene::MaterialType::Opaque ? shader::kMaterialOpaque
                : material.type == scene::MaterialType::Thin ? shader::kMaterialThin
                                                             : shader::kMaterialSolid;
    data.emission = vec3(material.emission);
    data.coverage = static_cast<float>(material.coverage);
    data.transmission = vec3(material.transmission);
    data.alphaCutoff = static_cast<float>(material.alphaCutoff);
    data.reflected = vec3(material.reflected);
    data.extinction = vec3(material.absorption + material.scattering);
    data.scattering = vec3(material.scattering);
    data.collimation = static_cast<float>(material.collimation);
    data.ior = static_cast<float>(material.ior);
    data.roughness = static_cast<float>(material.roughness);
    return data;
}

shader::SphereData makeSphere(const scene::MediumSphere& sphere, const dvec3& origin) {
    const dvec3 center = sphere.center - origin;
    return {.center = vec3(center),
            .centerLo = roundingOf(center),
            .radius = sphere.radius,
            .tint = sphere.tint,
            .density = sphere.density,
            .medium = sphere.medium,
            .id = sphere.id,
            .profile = sphere.profile == scene::Profile::Smooth ? shader::kProfileSmooth
                                                                : shader::kProfileConstant};
}

dmat4 relativeFrom(const dmat4& worldFromObject, const dvec3& origin) {
    dmat4 m = worldFromObject;
    m[3] -= dvec4(origin, 0);
    return m;
}

Box3 findBounds(const PreparedScene& prepared) {
    Box3 bounds;
    for (const scene::MediumSphere& sphere : prepared.spheres) {
        bounds.extend(sphere.center - dvec3(sphere.radius));
        bounds.extend(sphere.center + dvec3(sphere.radius));
    }
    for (const volumes::VolumeGrid& grid : prepared.volumes) bounds.extend(grid.worldBounds());
    for (const scene::Mesh& mesh : prepared.scene.meshes)
        for (const vec3& position : mesh.positions)
            bounds.extend(transformPoint(mesh.worldFromObject, dvec3(position)));
    return bounds;
}

}  // namespace

GpuScene::GpuScene(gpu::Submitter& submitter, const PreparedScene& prepared)
    : mNeeds(findNeeds(prepared)),
      mTextureSampler(submitter.device(), {.name = "render.texture_sampler",
                                           .filter = gpu::Filter::Linear,
                                           .addressX = gpu::AddressMode::Repeat,
                                           .addressY = gpu::AddressMode::Repeat}),
      mTexelSampler(submitter.device(),
                    {.name = "render.texel_sampler", .filter = gpu::Filter::Nearest}) {
    findCamera(prepared);
    uploadSpheres(submitter, prepared);
    uploadVolumes(submitter, prepared);
    uploadMeshes(submitter, prepared);
    uploadFrame(submitter, prepared);
}

VkExtent2D GpuScene::extent() const {
    return {static_cast<std::uint32_t>(mCamera.width), static_cast<std::uint32_t>(mCamera.height)};
}

void GpuScene::findCamera(const PreparedScene& prepared) {
    const scene::ImageSettings& image = prepared.scene.image;
    mCamera = scene::makeCameraFrame(prepared.scene.camera, image.width * image.supersample,
                                     image.height * image.supersample);
    if (mCamera.type != scene::CameraType::Orthographic) return;
    // Parallel rays may start anywhere along themselves: begin just before the scene, so that
    // distances keep their digits when the camera stands far away.
    const Box3 bounds = findBounds(prepared);
    if (bounds.isEmpty()) return;
    const double reach = 0.5 * glm::length(bounds.size()) * 1.01 + 1e-3;
    const double middle = glm::dot(bounds.center() - mCamera.position, mCamera.forward);
    const double room = prepared.scene.effects.empty() ? reach : reach + 1000;
    const double shift = std::max(middle - room, 0.0);
    mCamera.position += shift * mCamera.forward;
    mCamera.near = std::max(mCamera.near - shift, 0.0);
    mFar = std::max(middle - shift + room, mCamera.near + 1);
}

void GpuScene::uploadFrame(gpu::Submitter& submitter, const PreparedScene& prepared) {
    const scene::Scene& scene = prepared.scene;
    gpu::Device& device = submitter.device();
    std::vector<shader::LightData> lights;
    dvec3 ambient(0);
    for (const scene::Light& light : scene.lights) {
        if (light.type == scene::LightType::Ambient)
            ambient += light.color;
        else
            mSceneLights.push_back(light);
    }
    for (const scene::Light& light : mSceneLights)
        lights.push_back(makeLight(light, mCamera.position));
    std::vector<shader::MediumData> media;
    for (const scene::Medium& medium : scene.media) media.push_back(makeMedium(medium));

    const scene::Texture* environment = scene.background.environment.get();
    const std::uint32_t width = environment ? static_cast<std::uint32_t>(environment->width) : 0;
    const std::uint32_t height = environment ? static_cast<std::uint32_t>(environment->height) : 0;
    mEnvironment = gpu::Image(device, {.name = "render.environment",
                                       .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                       .width = std::max(width, 1u),
                                       .height = std::max(height, 1u)});
    const std::vector<vec4> texels = environment ? environment->texels : std::vector<vec4>{vec4(0)};
    submitter.submitAndWait("upload environment", [&](gpu::Commands& commands) {
        gpu::upload(commands, mEnvironment, texels);
    });

    const auto w = static_cast<std::uint32_t>(mCamera.width);
    const auto h = static_cast<std::uint32_t>(mCamera.height);
    const shader::FrameData data{.right = vec3(mCamera.right),
                                 .rightLo = roundingOf(mCamera.right),
                                 .extentX = static_cast<float>(mCamera.extentX),
                                 .extentXLo = roundingOf(mCamera.extentX),
                                 .up = vec3(mCamera.up),
                                 .upLo = roundingOf(mCamera.up),
                                 .extentY = static_cast<float>(mCamera.extentY),
                                 .extentYLo = roundingOf(mCamera.extentY),
                                 .forward = vec3(mCamera.forward),
                                 .forwardLo = roundingOf(mCamera.forward),
                                 .near = static_cast<float>(mCamera.near),
                                 .ambient = vec3(ambient),
                                 .orthographic = mCamera.type == scene::CameraType::Orthographic,
                                 .background = vec3(scene.background.radiance),
                                 .environmentScale = static_cast<float>(scene.background.scale),
                                 .size = {w, h},
                                 .tiles = {(w + shader::kTileSize - 1) / shader::kTileSize,
                                           (h + shader::kTileSize - 1) / shader::kTileSize},
                                 .environmentSize = {width, height},
                                 .sphereCount = mSphereCount,
                                 .boxCount = mBoxCount,
                                 .lightCount = static_cast<std::uint32_t>(lights.size()),
                                 .mediumCount = static_cast<std::uint32_t>(media.size()),
                                 .far = static_cast<float>(mFar),
                                 .brickValues = mBrickValues.deviceAddress()};
    mFrame = makeArray(submitter, "render.frame", std::vector{data});
    mLights = makeArray(submitter, "render.lights", std::move(lights));
    mMedia = makeArray(submitter, "render.media", std::move(media));
}

void GpuScene::setShadows(gpu::Submitter& submitter, const std::vector<VkDeviceAddress>& maps) {
    std::vector<shader::LightData> lights;
    for (std::size_t i = 0; i < mSceneLights.size(); ++i) {
        lights.push_back(makeLight(mSceneLights[i], mCamera.position));
        lights.back().shadow = maps[i];
    }
    if (lights.empty()) return;
    submitter.submitAndWait(
        "upload lights", [&](gpu::Commands& commands) { gpu::upload(commands, mLights, lights); });
}

void GpuScene::uploadSpheres(gpu::Submitter& submitter, const PreparedScene& prepared) {
    std::vector<shader::SphereData> spheres;
    for (const scene::MediumSphere& sphere : prepared.spheres)
        spheres.push_back(makeSphere(sphere, mCamera.position));
    mSphereIdsAscend = std::is_sorted(spheres.begin(), spheres.end(),
                                      [](const auto& a, const auto& b) { return a.id < b.id; });
    for (const scene::EffectInstance& effect : prepared.scene.effects) {
        mFirstEffectSphere.push_back(static_cast<std::uint32_t>(spheres.size()));
        if (!effect.effect.surface) spheres.resize(spheres.size() + effect.effect.capacity);
    }
    mSphereCount = static_cast<std::uint32_t>(spheres.size());
    mSpheres = makeArray(submitter, "render.spheres", std::move(spheres));
}

void GpuScene::shuffleSpheres(gpu::Submitter& submitter, std::uint64_t seed) {
    if (mSphereCount == 0) return;
    auto spheres = submitter.readBuffer<shader::SphereData>(mSpheres, mSphereCount);
    std::mt19937_64 random(seed);
    std::shuffle(spheres.begin(), spheres.end(), random);
    mSpheres = makeArray(submitter, "render.spheres", std::move(spheres));
    mSphereIdsAscend = false;
}

void GpuScene::uploadVolumes(gpu::Submitter& submitter, const PreparedScene& prepared) {
    std::vector<shader::VolumeData> volumes;
    std::vector<shader::BoxData> boxes;
    std::vector<float> values;
    for (std::size_t i = 0; i < prepared.volumes.size(); ++i) {
        const volumes::VolumeGrid& grid = prepared.volumes[i];
        const auto index = static_cast<std::uint32_t>(volumes.size());
        const dmat3 linear(grid.worldFromIndex);
        volumes.push_back({.indexFromWorld = glm::mat3(glm::inverse(linear)),
                           .worldFromIndex = glm::mat3(linear),
                           .medium = prepared.scene.volumes[i].medium});
        if (prepared.scene.volumes[i].representation == scene::VolumeRepresentation::Particles)
            continue;
        const auto add = [&](const dvec3& lo, const dvec3& size, std::uint32_t kind,
                             std::uint64_t offset, float value) {
            const dvec3 corner = transformPoint(grid.worldFromIndex, lo) - mCamera.position;
            boxes.push_back({.corner = vec3(corner),
                             .cornerLo = roundingOf(corner),
                             .volume = index,
                             .size = vec3(size),
                             .kind = kind,
                             .valueOffset = static_cast<std::uint32_t>(offset),
                             .value = value});
        };
        for (const volumes::Brick& brick : grid.bricks)
            add(dvec3(brick.origin), dvec3(volumes::kBrickCells), shader::kBoxBrick,
                values.size() + brick.valueOffset, brick.maxValue);
        for (const volumes::ValueBox& box : grid.boxes) {
            if (box.soft)
                add(box.lo - 1.0, box.hi - box.lo + 2.0, shader::kBoxSoft, 0, box.value);
            else
                add(box.lo, box.hi - box.lo, shader::kBoxHard, 0, box.value);
        }
        values.insert(values.end(), grid.values.begin(), grid.values.end());
    }
    if (values.size() > 0xffffffffull)
        throw failure("uploading volumes", "",
                      fmt::format("{} brick values, allowed are 2^32", values.size()));
    mBoxCount = static_cast<std::uint32_t>(boxes.size());
    mVolumes = makeArray(submitter, "render.volumes", std::move(volumes));
    mBoxes = makeArray(submitter, "render.boxes", std::move(boxes));
    mBrickValues = makeArray(submitter, "render.brick_values", std::move(values));
}

const gpu::Image* GpuScene::uploadTexture(gpu::Submitter& submitter,
                                          const scene::Texture* texture) {
    gpu::Image& image = mTextures[texture];
    if (image) return &image;
    image = gpu::Image(submitter.device(),
                       {.name = texture ? "render.texture " + texture->name : "render.white",
                        .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                        .width = texture ? static_cast<std::uint32_t>(texture->width) : 1,
                        .height = texture ? static_cast<std::uint32_t>(texture->height) : 1});
    const std::vector<vec4> texels = texture ? texture->texels : std::vector<vec4>{vec4(1)};
    submitter.submitAndWait("upload texture",
                            [&](gpu::Commands& commands) { gpu::upload(commands, image, texels); });
    return &image;
}

void GpuScene::uploadMeshes(gpu::Submitter& submitter, const PreparedScene& prepared) {
    std::vector<shader::VertexData> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<shader::MeshData> meshes;
    std::vector<shader::MaterialData> materials;
    for (const scene::Material& material : prepared.scene.materials)
        materials.push_back(makeMaterial(material));
    for (const scene::Mesh& mesh : prepared.scene.meshes) {
        const dmat3 linear(mesh.worldFromObject);
        const dmat4 relative = relativeFrom(mesh.worldFromObject, mCamera.position);
        meshes.push_back(
            {.relativeFromObject = glm::mat4x3(relative),
             .relativeFromObjectLo = glm::mat4x3(relative - dmat4(glm::mat4(relative))),
             .normalFromObject = glm::mat3(glm::transpose(glm::inverse(linear))),
             .firstVertex = static_cast<std::uint32_t>(vertices.size()),
             .firstIndex = static_cast<std::uint32_t>(indices.size())});
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            vertices.push_back({mesh.positions[i], mesh.normals[i], mesh.uvs[i]});
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());

        const scene::Material& material = prepared.scene.materials[mesh.material];
        const oit::SurfaceDraw draw{
            .mesh = static_cast<std::uint32_t>(meshes.size() - 1),
            .material = mesh.material,
            .vertexCount = static_cast<std::uint32_t>(mesh.indices.size()),
            .isSolid = material.type == scene::MaterialType::Solid,
            .colorTexture = uploadTexture(submitter, material.colorTexture.get()),
            .emissionTexture = uploadTexture(submitter, material.emissionTexture.get())};
        (material.type == scene::MaterialType::Opaque ? mOpaque : mTransparent).push_back(draw);
    }
    mVertices = makeArray(submitter, "render.vertices", std::move(vertices));
    mIndices = makeArray(submitter, "render.indices", std::move(indices));
    mMeshes = makeUniforms(submitter, "render.meshes", meshes);
    mMaterials = makeUniforms(submitter, "render.materials", materials);
}

oit::Inputs GpuScene::makeInputs() const {
    return {.needs = mNeeds,
            .extent = extent(),
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
            .textureSampler = &mTextureSampler,
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
