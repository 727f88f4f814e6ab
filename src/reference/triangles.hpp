// SPDX-License-Identifier: Apache-2.0
// The triangles of a scene in world space and their exact intersection with rays.
#pragma once

#include <reference/bvh.hpp>
#include <scene/camera.hpp>
#include <scene/scene.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace brume::reference {

/// Where a ray meets a triangle.
struct Hit {
    double t = kInfinity;
    std::uint32_t triangle = 0;  ///< index into TriangleSet
    double b1 = 0, b2 = 0;       ///< barycentric weights of the second and third vertex
    bool entering = false;       ///< the ray meets the outside (counter-clockwise) face
};

inline constexpr std::uint32_t kNoTriangle = ~0u;

/// What shading needs to know about a hit.
struct SurfacePoint {
    dvec3 position;
    dvec3 normal;  ///< interpolated, unit length, towards the viewer
    dvec2 uv;
    const scene::Material* material = nullptr;
    std::uint32_t triangle = kNoTriangle;
};

/// All meshes of a scene, cut into those that end a ray and those that let light through.
class TriangleSet {
  public:
    /// The scene must outlive the set.
    explicit TriangleSet(const scene::Scene& scene);

    Box3 bounds() const;
    bool hasOpaque() const { return !mOpaque.isEmpty(); }
    bool hasTransparent() const { return !mTransparent.isEmpty(); }

    /// The opaque triangle hit first with t in [tMin, tMax), other than `except`; masked-away
    /// texels do not count.
    std::optional<Hit> findNearestOpaque(const scene::Ray& ray, double tMin, double tMax,
                                         std::uint32_t except = kNoTriangle) const;
    bool isBlocked(const scene::Ray& ray, double tMin, double tMax, std::uint32_t except) const;

    /// Appends all thin and solid triangles with t >= tMin, other than `except`, in order of (t,
    /// triangle).
    void collectTransparent(const scene::Ray& ray, double tMin, std::uint32_t except,
                            std::vector<Hit>& hits) const;

    std::size_t count() const { return mTriangles.size(); }
    /// Appends where a ray passes the planes through the light and an edge of a triangle.
    void collectShadowEdges(const scene::Ray& ray, const scene::Light& light,
                            std::vector<double>& distances) const;

    SurfacePoint describe(const scene::Ray& ray, const Hit& hit) const;
    const scene::Material& material(std::uint32_t triangle) const {
        return *mTriangles[triangle].material;
    }
    std::uint32_t meshIndex(std::uint32_t triangle) const { return mTriangles[triangle].mesh; }
    /// triangleHash() of mesh and index.
    std::uint32_t hash(std::uint32_t triangle) const;
    /// Coverage of the hit point: Material::coverage times the texture's alpha.
    double coverage(const Hit& hit) const;

  private:
    struct Triangle {
        dvec3 positions[3];  ///< world
        std::uint32_t mesh = 0, index = 0;
        const scene::Material* material = nullptr;
    };
    struct Shear;

    bool intersect(const Shear& shear, std::uint32_t triangle, double tMin, double tMax,
                   Hit& hit) const;
    bool exists(const Hit& hit) const;
    dvec2 uv(const Hit& hit) const;
    dvec3 interpolateNormal(const Hit& hit) const;

    const scene::Scene& mScene;
    std::vector<dmat3> mNormalMatrices;  ///< per mesh
    std::vector<Triangle> mTriangles;
    std::vector<std::uint32_t> mOpaqueIndices, mTransparentIndices;  ///< of the leaves of the trees
    Bvh mOpaque, mTransparent;
};

}  // namespace brume::reference
