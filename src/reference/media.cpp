// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <reference/media.hpp>
#include <reference/roots.hpp>

#include <fmt/format.h>

#include <map>
#include <tuple>

namespace brume::reference {
namespace {

Source tintedSource(const scene::Medium& medium, const dvec3& tint) {
    return {medium.extinction, medium.extinction * medium.albedo * tint, medium.emission * tint,
            medium.phase, medium.g};
}

bool isSame(const Source& a, const Source& b) {
    return a.extinction == b.extinction && a.scattering == b.scattering &&
           a.emission == b.emission && a.phase == b.phase && a.g == b.g;
}

}  // namespace

MediaSet::MediaSet(const Input& input) : mMaterials(input.scene.materials) {
    for (const scene::Material& material : input.scene.materials)
        mMaterialSources.push_back(
            addSource({material.absorption + material.scattering, material.scattering}));
    for (const scene::Medium& medium : input.scene.media)
        mMediumSources.push_back(addSource(tintedSource(medium, dvec3(1))));
    addSpheres(input);
    addGrids(input);
    for (const scene::Mesh& mesh : input.scene.meshes)
        if (mMaterials[mesh.material].type == scene::MaterialType::Solid &&
            scatters(mMaterialSources[mesh.material]))
            mHasSampledMedia = true;
}

std::uint32_t MediaSet::addSource(const Source& source) {
    mSources.push_back(source);
    return static_cast<std::uint32_t>(mSources.size() - 1);
}

std::uint32_t MediaSet::sourceOfMedium(std::uint32_t medium, const char* what) const {
    if (medium < mMediumSources.size()) return mMediumSources[medium];
    throw inputError(
        "preparing the reference", what,
        fmt::format("medium {} does not exist, the scene has {}", medium, mMediumSources.size()));
}

void MediaSet::addSpheres(const Input& input) {
    std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> known;
    std::vector<Box3> boxes;
    for (const scene::MediumSphere& sphere : input.spheres) {
        const std::uint32_t plain = sourceOfMedium(sphere.medium, "a sphere");
        if (!(sphere.radius > 0) || !(sphere.density > 0)) continue;
        const vec3& tint = sphere.tint;
        const auto [entry, isNew] =
            known.try_emplace({sphere.medium, tint.x, tint.y, tint.z}, plain);
        if (isNew) {
            const Source source = tintedSource(input.scene.media[sphere.medium], dvec3(tint));
            if (!isSame(source, mSources[plain])) entry->second = addSource(source);
        }
        const bool isWhole = sphere.shadowing == scene::Shadowing::Particle;
        if (scatters(entry->second)) (isWhole ? mHasWholeSpheres : mHasSampledMedia) = true;
        mSpheres.push_back({sphere.center, sphere.radius, sphere.density, entry->second,
                            sphere.profile, isWhole});
        const dvec3 radius(sphere.radius);
        boxes.push_back({sphere.center - radius, sphere.center + radius});
    }
    mSphereTree = Bvh(boxes);
}

void MediaSet::addGrids(const Input& input) {
    if (input.volumes.size() != input.scene.volumes.size())
        throw inputError("preparing the reference", "volumes",
                         fmt::format("{} grids were given, the scene has {} volumes",
                                     input.volumes.size(), input.scene.volumes.size()));
    for (std::size_t i = 0; i < input.volumes.size(); ++i) {
        const volumes::VolumeGrid& grid = input.volumes[i];
        const std::uint32_t source = sourceOfMedium(input.scene.volumes[i].medium, "a volume");
        if (grid.isEmpty()) continue;
        if (scatters(source)) mHasSampledMedia = true;
        mGrids.push_back({std::make_unique<volumes::DensityField>(grid),
                          dvec3(grid.worldFromIndex[3]), glm::inverse(dmat3(grid.worldFromIndex)),
                          source});
        mGridBounds.extend(grid.worldBounds());
    }
}

std::uint32_t MediaSet::sourceOfMaterial(const scene::Material& material) const {
    return mMaterialSources[static_cast<std::size_t>(&material - mMaterials.data())];
}

Box3 MediaSet::bounds() const {
    Box3 box = mSphereTree.bounds();
    box.extend(mGridBounds);
    return box;
}

bool MediaSet::makePiece(const SphereShape& sphere, const scene::Ray& ray, double tMax,
                         Piece& piece) {
    // The distance of the centre from the ray by its perpendicular: b^2 - c would lose small
    // spheres.
    const dvec3 toCenter = sphere.center - ray.origin;
    const double middle = glm::dot(toCenter, ray.direction);
    const double distance = glm::length(toCenter - middle * ray.direction);
    const double half2 = (sphere.radius - distance) * (sphere.radius + distance);
    if (!(half2 > 0)) return false;
    const double half = std::sqrt(half2), enter = middle - half, leave = middle + half;
    piece.t0 = std::max(0.0, enter), piece.t1 = std::min(tMax, leave);
    if (!(piece.t0 < piece.t1)) return false;
    piece.source = sphere.source;
    if (sphere.profile == scene::Profile::Constant) {
        piece.kind = Piece::Kind::Constant;
        piece.c[0] = sphere.density;
    } else {
        // 1 - r^2/R^2 = (t - enter) (leave - t) / R^2 on the chord.
        const double r2 = sphere.radius * sphere.radius;
        piece.kind = Piece::Kind::Smooth;
        piece.c[0] = sphere.density / (r2 * r2), piece.c[1] = enter, piece.c[2] = leave;
    }
    return true;
}

volumes::IndexRay MediaSet::toIndexSpace(const Grid& grid, const scene::Ray& ray) {
    return {grid.indexFromWorld * (ray.origin - grid.offset), grid.indexFromWorld * ray.direction};
}

void MediaSet::collect(const scene::Ray& ray, double tMax, std::vector<Piece>& pieces) const {
    mSphereTree.visit(SlabRay(ray.origin, ray.direction), 0, tMax, [&](std::uint32_t i) {
        Piece piece;
        if (!makePiece(mSpheres[i], ray, tMax, piece)) return;
        if (mSpheres[i].isWhole) piece.sphere = i;
        pieces.push_back(piece);
    });
    for (const Grid& grid : mGrids)
        grid.field->visitRay(toIndexSpace(grid, ray), 0, tMax,
                             [&](const volumes::DensitySegment& s) {
                                 pieces.push_back({s.t0,
                                                   s.t1,
                                                   {s.c[0], s.c[1], s.c[2], s.c[3]},
                                                   grid.source,
                                                   Piece::Kind::Cubic,
                                                   kNoSphere});
                             });
}

dvec3 MediaSet::opticalDepth(const scene::Ray& ray, double tMax) const {
    dvec3 depth(0);
    mSphereTree.visit(SlabRay(ray.origin, ray.direction), 0, tMax, [&](std::uint32_t i) {
        Piece piece;
        if (makePiece(mSpheres[i], ray, tMax, piece))
            depth += mSources[piece.source].extinction * piece.integrate(piece.t0, piece.t1);
    });
    for (const Grid& grid : mGrids)
        depth += mSources[grid.source].extinction *
                 std::max(0.0, grid.field->opticalDepth(toIndexSpace(grid, ray), 0, tMax));
    return depth;
}

void MediaSet::collectShadowEdges(const scene::Ray& ray, const scene::Light& light,
                                  std::vector<double>& distances) const {
    for (const SphereShape& sphere : mSpheres) {
        const double r2 = sphere.radius * sphere.radius;
        if (light.type == scene::LightType::Directional) {
            // The distance of the centre from the line through the point along the light is R.
            const dvec3 o = glm::cross(ray.origin - sphere.center, light.direction);
            const dvec3 d = glm::cross(ray.direction, light.direction);
            appendRoots(glm::dot(d, d), glm::dot(o, d), glm::dot(o, o) - r2, distances);
        } else {
            // |(p - l) x (c - l)|^2 = R^2 |p - l|^2 for the line through the light l and the point
            // p.
            const dvec3 fromLight = ray.origin - light.position;
            const dvec3 toCenter = sphere.center - light.position;
            const dvec3 o = glm::cross(fromLight, toCenter);
            const dvec3 d = glm::cross(ray.direction, toCenter);
            appendRoots(glm::dot(d, d) - r2,
                        glm::dot(o, d) - r2 * glm::dot(fromLight, ray.direction),
                        glm::dot(o, o) - r2 * glm::dot(fromLight, fromLight), distances);
        }
    }
}

}  // namespace brume::reference
