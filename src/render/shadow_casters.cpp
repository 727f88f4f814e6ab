// SPDX-License-Identifier: Apache-2.0
#include <gpu/upload.hpp>
#include <render/shadow_casters.hpp>

#include <shaders/common/mesh.h>
#include <shaders/shadows/common/maps.h>

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>

namespace brume::render {
namespace {

bool isGrey(const dvec3& v) { return v.x == v.y && v.y == v.z; }

void extend(Box3& bounds, const scene::MediumSphere& sphere) {
    if (!(sphere.radius > 0)) return;
    bounds.extend(sphere.center - dvec3(sphere.radius));
    bounds.extend(sphere.center + dvec3(sphere.radius));
}

/// As unpackNormal() of shaders/shadows/common/casters.glsl reads it.
std::uint32_t packNormal(const dvec3& unit) {
    const dvec3 n = unit / (std::abs(unit.x) + std::abs(unit.y) + std::abs(unit.z));
    dvec2 p(n.x, n.y);
    if (n.z < 0)
        p = {std::copysign(1 - std::abs(n.y), n.x), std::copysign(1 - std::abs(n.x), n.y)};
    return glm::packSnorm2x16(vec2(p));
}

/// Unit, in the world; the triangle's own where the mesh has none.
dvec3 worldNormal(const scene::Mesh& mesh, const dmat3& normalMatrix, std::uint32_t index,
                  const dvec3& ofTriangle) {
    const dvec3 normal =
        mesh.normals.empty() ? dvec3(0) : normalMatrix * dvec3(mesh.normals[index]);
    const double length = glm::length(normal);
    if (length > 0 && std::isfinite(length)) return normal / length;
    const double area = glm::length(ofTriangle);
    return area > 0 ? ofTriangle / area : dvec3(0, 0, 1);
}

bool castsColour(const scene::Material& material) {
    if (material.type == scene::MaterialType::Solid)
        return !isGrey(material.absorption + material.scattering);
    return material.type == scene::MaterialType::Thin &&
           (material.colorTexture || !isGrey(material.transmission));
}

/// The triangle whose indices begin at `first`, relative to `origin`; without an id.
shader::ShadowTriangle makeTriangle(const scene::Mesh& mesh, std::size_t first,
                                    const dmat3& normalMatrix, const dvec3& origin) {
    std::uint32_t indices[3], normals[3];
    dvec3 corners[3];
    for (int c = 0; c < 3; ++c) {
        indices[c] = mesh.indices[first + c];
        corners[c] =
            transformPoint(mesh.worldFromObject, dvec3(mesh.positions[indices[c]])) - origin;
    }
    const dvec3 ofTriangle = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    for (int c = 0; c < 3; ++c)
        normals[c] = packNormal(worldNormal(mesh, normalMatrix, indices[c], ofTriangle));
    return {.a = vec3(corners[0]),
            .b = vec3(corners[1]),
            .c = vec3(corners[2]),
            .uvA = mesh.uvs[indices[0]],
            .uvB = mesh.uvs[indices[1]],
            .uvC = mesh.uvs[indices[2]],
            .normalA = normals[0],
            .normalB = normals[1],
            .normalC = normals[2],
            .material = mesh.material,
            .id = 0};
}

}  // namespace

Box3 findTranslucentBounds(const PreparedScene& prepared,
                           std::span<const scene::MediumSphere> particles) {
    Box3 bounds;
    for (const scene::MediumSphere& sphere : prepared.spheres) extend(bounds, sphere);
    for (const scene::MediumSphere& sphere : particles) extend(bounds, sphere);
    for (const volumes::VolumeGrid& grid : prepared.volumes)
        if (!grid.isEmpty()) bounds.extend(grid.worldBounds());
    for (const scene::Mesh& mesh : prepared.scene.meshes) {
        if (prepared.scene.materials[mesh.material].type == scene::MaterialType::Opaque) continue;
        for (const vec3& position : mesh.positions)
            bounds.extend(transformPoint(mesh.worldFromObject, dvec3(position)));
    }
    return bounds;
}

ShadowCasters::ShadowCasters(gpu::Device& device, const PreparedScene& prepared,
                             const GpuScene& deviceScene, const Box3& translucentBounds)
    : mPrepared(&prepared) {
    const oit::Inputs inputs = deviceScene.makeInputs();
    mCasters.origin = deviceScene.camera().position;
    mCasters.frame = inputs.frame;
    mCasters.lights = inputs.lights;
    mCasters.media = inputs.media;
    mCasters.spheres = &deviceScene.spheres();
    mCasters.boxes = inputs.boxes;
    mCasters.volumes = inputs.volumes;
    mCasters.sphereCount = inputs.sphereCount;
    mCasters.hasWholeSpheres = inputs.needs.wholeShadows;
    mCasters.boxCount = inputs.boxCount;
    mCasters.translucentBounds = translucentBounds;
    for (const scene::Medium& medium : prepared.scene.media)
        if (!isGrey(medium.extinction)) mCasters.isColoured = true;
    makeTriangles();
    makeMaterials(device);
    mTriangles = {device,
                  {.name = "render.shadow_triangles",
                   .bytes = std::max<std::size_t>(mTriangleData.size(), 1) *
                            sizeof(shader::ShadowTriangle)}};
    mMaterials = {device,
                  {.name = "render.shadow_materials",
                   .bytes = std::max<std::size_t>(mMaterialData.size(), 1) *
                            sizeof(shader::ShadowMaterial)}};
    mCasters.triangles = &mTriangles;
    mCasters.materials = &mMaterials;
}

// The opaque ones first.
void ShadowCasters::makeTriangles() {
    mCasters.opaqueBounds = {};
    mTriangleData.clear();
    for (const bool wantsOpaque : {true, false}) {
        std::uint32_t id = 0;
        for (const scene::Mesh& mesh : mPrepared->scene.meshes) {
            const scene::Material& material = mPrepared->scene.materials[mesh.material];
            const bool isOpaque = material.type == scene::MaterialType::Opaque;
            const dmat3 normalMatrix = glm::transpose(glm::inverse(dmat3(mesh.worldFromObject)));
            if (castsColour(material)) mCasters.isColoured = true;
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3, ++id) {
                if (isOpaque != wantsOpaque) continue;
                shader::ShadowTriangle& triangle = mTriangleData.emplace_back(
                    makeTriangle(mesh, i, normalMatrix, mCasters.origin));
                triangle.id = id;
                if (!isOpaque) continue;
                for (const vec3& corner : {triangle.a, triangle.b, triangle.c})
                    mCasters.opaqueBounds.extend(dvec3(corner) + mCasters.origin);
            }
        }
        if (wantsOpaque)
            mCasters.opaqueTriangleCount = static_cast<std::uint32_t>(mTriangleData.size());
    }
    mCasters.translucentTriangleCount =
        static_cast<std::uint32_t>(mTriangleData.size()) - mCasters.opaqueTriangleCount;
}

void ShadowCasters::makeMaterials(gpu::Device& device) {
    for (const scene::Material& material : mPrepared->scene.materials) {
        shader::ShadowMaterial& data = mMaterialData.emplace_back();
        data.transmission = vec3(material.transmission);
        data.type = material.type == scene::MaterialType::Opaque ? shader::kMaterialOpaque
                    : material.type == scene::MaterialType::Thin ? shader::kMaterialThin
                                                                 : shader::kMaterialSolid;
        data.extinction = vec3(material.absorption + material.scattering);
        data.coverage = static_cast<float>(
            material.type == scene::MaterialType::Thin ? material.coverage : 1.0);
        data.alphaCutoff = static_cast<float>(material.alphaCutoff);
        data.ior = static_cast<float>(material.ior);
        const scene::Texture* texture = material.colorTexture.get();
        const bool usesTexture =
            texture && (material.type == scene::MaterialType::Thin || material.alphaCutoff >= 0);
        if (!usesTexture) continue;
        gpu::Buffer& buffer = mTextures[texture];
        if (!buffer)
            buffer = {device,
                      {.name = "render.shadow_texture " + texture->name,
                       .bytes = std::max<std::size_t>(texture->texels.size(), 1) * sizeof(vec4)}};
        data.textureSize = {static_cast<std::uint32_t>(texture->width),
                            static_cast<std::uint32_t>(texture->height)};
        data.texture = buffer.deviceAddress();
    }
}

void ShadowCasters::recordContent(gpu::Commands& commands) {
    gpu::upload(commands, mTriangles, mTriangleData);
    gpu::upload(commands, mMaterials, mMaterialData);
    for (const auto& [texture, buffer] : mTextures) gpu::upload(commands, buffer, texture->texels);
}

void ShadowCasters::recordOrigin(gpu::Commands& commands, gpu::UploadRing& ring,
                                 const dvec3& origin) {
    if (origin == mCasters.origin) return;
    mCasters.origin = origin;
    makeTriangles();
    ring.write(commands, mTriangles, mTriangleData);
}

std::uint64_t ShadowCasters::bytes() const {
    std::uint64_t sum = mTriangles.bytes() + mMaterials.bytes();
    for (const auto& [texture, buffer] : mTextures) sum += buffer.bytes();
    return sum;
}

}  // namespace brume::render
