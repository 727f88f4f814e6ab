// SPDX-License-Identifier: Apache-2.0
#include <reference/triangles.hpp>

#include <shaders/common/triangle_hash.h>
#include <scene/texture.hpp>

#include <algorithm>

namespace brume::reference {

/// The ray's part of the watertight test of Woop, Benthin and Wald (2013): the axes are permuted
/// and sheared until the ray runs along +z.
struct TriangleSet::Shear {
    dvec3 origin;
    int x = 0, y = 1, z = 2;
    double sx = 0, sy = 0, sz = 1;

    explicit Shear(const scene::Ray& ray) : origin(ray.origin) {
        const dvec3 size = glm::abs(ray.direction);
        z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        x = (z + 1) % 3, y = (z + 2) % 3;
        if (ray.direction[z] < 0) std::swap(x, y);
        sx = ray.direction[x] / ray.direction[z];
        sy = ray.direction[y] / ray.direction[z];
        sz = 1.0 / ray.direction[z];
    }

    dvec3 apply(const dvec3& p) const {
        const dvec3 a = p - origin;
        return {a[x] - sx * a[z], a[y] - sy * a[z], sz * a[z]};
    }
};

namespace {

/// Twice the signed area of (0, a, b); exactly antisymmetric, so triangles that share an edge
/// agree.
double edgeFunction(const dvec3& a, const dvec3& b) { return a.x * b.y - a.y * b.x; }

/// Is the ray on the inner side of the edge a -> b of a triangle of this orientation? A ray exactly
/// through an edge belongs to one of the two triangles that share it, or, at a silhouette, to
/// both or none: a closed mesh is never entered without being left.
bool isInside(double edge, double orientation, const dvec3& a, const dvec3& b) {
    if (edge != 0) return (edge > 0) == (orientation > 0);
    const dvec2 direction = orientation * (dvec2(b) - dvec2(a));
    return direction.y > 0 || (direction.y == 0 && direction.x < 0);
}

}  // namespace

TriangleSet::TriangleSet(const scene::Scene& scene) : mScene(scene) {
    std::vector<Box3> opaqueBoxes, transparentBoxes;
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
        const scene::Mesh& mesh = scene.meshes[m];
        mNormalMatrices.push_back(glm::transpose(glm::inverse(dmat3(mesh.worldFromObject))));
        const scene::Material& material = scene.materials[mesh.material];
        const bool isOpaque = material.type == scene::MaterialType::Opaque;
        for (std::uint32_t i = 0; 3 * i + 2 < mesh.indices.size(); ++i) {
            Triangle triangle{{}, m, i, &material};
            Box3 box;
            for (int corner = 0; corner < 3; ++corner) {
                const dvec3 position(mesh.positions[mesh.indices[3 * i + corner]]);
                triangle.positions[corner] = transformPoint(mesh.worldFromObject, position);
                box.extend(triangle.positions[corner]);
            }
            (isOpaque ? opaqueBoxes : transparentBoxes).push_back(box);
            (isOpaque ? mOpaqueIndices : mTransparentIndices)
                .push_back(static_cast<std::uint32_t>(mTriangles.size()));
            mTriangles.push_back(triangle);
        }
    }
    mOpaque = Bvh(opaqueBoxes);
    mTransparent = Bvh(transparentBoxes);
}

Box3 TriangleSet::bounds() const {
    Box3 box = mOpaque.bounds();
    box.extend(mTransparent.bounds());
    return box;
}

bool TriangleSet::intersect(const Shear& shear, std::uint32_t index, double tMin, double tMax,
                            Hit& hit) const {
    const Triangle& triangle = mTriangles[index];
    const dvec3 a = shear.apply(triangle.positions[0]);
    const dvec3 b = shear.apply(triangle.positions[1]);
    const dvec3 c = shear.apply(triangle.positions[2]);
    const double u = edgeFunction(c, b), v = edgeFunction(a, c), w = edgeFunction(b, a);
    const double determinant = u + v + w;
    if (determinant == 0) return false;
    if (!isInside(u, determinant, c, b) || !isInside(v, determinant, a, c) ||
        !isInside(w, determinant, b, a))
        return false;
    const double t = (u * a.z + v * b.z + w * c.z) / determinant;
    if (!(t >= tMin && t < tMax)) return false;
    hit = {t, index, v / determinant, w / determinant, determinant > 0};
    return true;
}

bool TriangleSet::exists(const Hit& hit) const {
    const double cutoff = material(hit.triangle).alphaCutoff;
    return cutoff < 0 || coverage(hit) >= cutoff;
}

std::optional<Hit> TriangleSet::findNearestOpaque(const scene::Ray& ray, double tMin, double tMax,
                                                  std::uint32_t except) const {
    const Shear shear(ray);
    std::optional<Hit> nearest;
    mOpaque.visit(SlabRay(ray.origin, ray.direction), tMin, tMax, [&](std::uint32_t leaf) {
        const std::uint32_t index = mOpaqueIndices[leaf];
        Hit hit;
        if (index == except || !intersect(shear, index, tMin, kInfinity, hit)) return;
        // Of two at the same distance the lower index wins, whatever the order of the visit.
        const bool isNearer =
            hit.t < tMax || (nearest && hit.t == tMax && index < nearest->triangle);
        if (isNearer && exists(hit)) nearest = hit, tMax = hit.t;
    });
    return nearest;
}

bool TriangleSet::isBlocked(const scene::Ray& ray, double tMin, double tMax,
                            std::uint32_t except) const {
    if (mOpaque.isEmpty()) return false;
    const Shear shear(ray);
    bool isHit = false;
    mOpaque.visit(SlabRay(ray.origin, ray.direction), tMin, tMax, [&](std::uint32_t leaf) {
        const std::uint32_t index = mOpaqueIndices[leaf];
        Hit hit;
        if (index == except || !intersect(shear, index, tMin, tMax, hit) || !exists(hit)) return;
        isHit = true, tMax = -kInfinity;  // prunes the rest
    });
    return isHit;
}

void TriangleSet::collectTransparent(const scene::Ray& ray, double tMin, std::uint32_t except,
                                     std::vector<Hit>& hits) const {
    if (mTransparent.isEmpty()) return;
    const Shear shear(ray);
    const auto first = static_cast<std::ptrdiff_t>(hits.size());
    mTransparent.visit(
        SlabRay(ray.origin, ray.direction), tMin, kInfinity, [&](std::uint32_t leaf) {
            const std::uint32_t index = mTransparentIndices[leaf];
            Hit hit;
            if (index != except && intersect(shear, index, tMin, kInfinity, hit) && exists(hit))
                hits.push_back(hit);
        });
    std::sort(hits.begin() + first, hits.end(), [](const Hit& a, const Hit& b) {
        return a.t != b.t ? a.t < b.t : a.triangle < b.triangle;
    });
}

void TriangleSet::collectShadowEdges(const scene::Ray& ray, const scene::Light& light,
                                     std::vector<double>& distances) const {
    for (const Triangle& triangle : mTriangles)
        for (int corner = 0; corner < 3; ++corner) {
            const dvec3 a = triangle.positions[corner], b = triangle.positions[(corner + 1) % 3];
            const bool isParallel = light.type == scene::LightType::Directional;
            const dvec3 toLight = isParallel ? light.direction : a - light.position;
            const dvec3 normal = glm::cross(b - a, toLight);
            const double slope = glm::dot(normal, ray.direction);
            if (slope != 0) distances.push_back(glm::dot(normal, a - ray.origin) / slope);
        }
}

std::uint32_t TriangleSet::hash(std::uint32_t triangle) const {
    return shader::triangleHash(mTriangles[triangle].mesh, mTriangles[triangle].index);
}

dvec2 TriangleSet::uv(const Hit& hit) const {
    const Triangle& triangle = mTriangles[hit.triangle];
    const scene::Mesh& mesh = mScene.meshes[triangle.mesh];
    if (mesh.uvs.empty()) return dvec2(0);
    const auto corner = [&](int i) {
        return dvec2(mesh.uvs[mesh.indices[3 * triangle.index + i]]);
    };
    return (1 - hit.b1 - hit.b2) * corner(0) + hit.b1 * corner(1) + hit.b2 * corner(2);
}

double TriangleSet::coverage(const Hit& hit) const {
    const scene::Material& m = material(hit.triangle);
    return m.colorTexture ? m.coverage * scene::sampleBilinear(*m.colorTexture, uv(hit)).a
                          : m.coverage;
}

dvec3 TriangleSet::interpolateNormal(const Hit& hit) const {
    const Triangle& triangle = mTriangles[hit.triangle];
    const scene::Mesh& mesh = mScene.meshes[triangle.mesh];
    const double weights[3] = {1 - hit.b1 - hit.b2, hit.b1, hit.b2};
    dvec3 normal(0);
    if (!mesh.normals.empty())
        for (int i = 0; i < 3; ++i)
            normal += weights[i] * dvec3(mesh.normals[mesh.indices[3 * triangle.index + i]]);
    normal = mNormalMatrices[triangle.mesh] * normal;
    if (glm::dot(normal, normal) > 0) return glm::normalize(normal);
    return glm::normalize(glm::cross(triangle.positions[1] - triangle.positions[0],
                                     triangle.positions[2] - triangle.positions[0]));
}

SurfacePoint TriangleSet::describe(const scene::Ray& ray, const Hit& hit) const {
    const Triangle& triangle = mTriangles[hit.triangle];
    const dvec3 position = (1 - hit.b1 - hit.b2) * triangle.positions[0] +
                           hit.b1 * triangle.positions[1] + hit.b2 * triangle.positions[2];
    dvec3 normal = interpolateNormal(hit);
    if (glm::dot(normal, ray.direction) > 0) normal = -normal;
    return {position, normal, uv(hit), triangle.material, hit.triangle};
}

}  // namespace brume::reference
