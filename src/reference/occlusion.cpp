// SPDX-License-Identifier: Apache-2.0
#include <reference/occlusion.hpp>

#include <reference/surface_response.hpp>

#include <algorithm>

namespace brume::reference {
namespace {

/// Beyond it the edges are left to the halving of panels.
constexpr std::size_t kMaxShadowEdgeCasters = 64;

}  // namespace

dvec3 Occlusion::transmittance(const scene::Ray& ray, double tMin, double tMax,
                               std::uint32_t except) const {
    tMax = std::min(tMax, kEndOfRay);
    if (mTriangles.isBlocked(ray, tMin, tMax, except)) return dvec3(0);
    dvec3 depth = mMedia.opticalDepth(ray, tMax), factor(1);
    if (mTriangles.hasTransparent()) {
        std::vector<Hit> hits;
        std::vector<Piece> solids;
        mTriangles.collectTransparent(ray, tMin, except, hits);
        for (const Hit& hit : hits) {
            if (hit.t >= tMax) break;
            const SurfacePoint point = mTriangles.describe(ray, hit);
            factor *= respond(*point.material, point.uv, dvec3(0)).transmittance;
        }
        collectSolids(hits, tMax, solids);
        for (const Piece& piece : solids)
            depth += mMedia.source(piece.source).extinction * piece.integrate(piece.t0, piece.t1);
    }
    return factor * glm::exp(-depth);
}

void Occlusion::collectSolids(std::span<const Hit> hits, double tMax,
                              std::vector<Piece>& pieces) const {
    const auto isSolid = [&](const Hit& hit) {
        return mTriangles.material(hit.triangle).type == scene::MaterialType::Solid;
    };
    for (auto hit = hits.begin(); hit != hits.end(); ++hit) {
        if (!isSolid(*hit)) continue;
        const std::uint32_t mesh = mTriangles.meshIndex(hit->triangle);
        const bool isFirst = std::none_of(hits.begin(), hit, [&](const Hit& other) {
            return mTriangles.meshIndex(other.triangle) == mesh;
        });
        if (isFirst) collectSolid(hits, mesh, tMax, pieces);
    }
}

void Occlusion::collectSolid(std::span<const Hit> hits, std::uint32_t mesh, double tMax,
                             std::vector<Piece>& pieces) const {
    const auto isOfMesh = [&](const Hit& hit) {
        return mTriangles.meshIndex(hit.triangle) == mesh;
    };
    // Where the ray starts inside it leaves once more than it enters (Barta and Kovács 2011).
    int inside = 0;
    for (const Hit& hit : hits)
        if (isOfMesh(hit)) inside += hit.entering ? -1 : 1;
    inside = std::max(inside, 0);
    Piece piece;
    const auto open = [&](double t0, double t1) {
        piece.t0 = t0, piece.t1 = std::min(t1, tMax), piece.c[0] = inside;
        if (inside > 0 && piece.t0 < piece.t1) pieces.push_back(piece);
    };
    double last = 0;
    for (const Hit& hit : hits) {
        if (!isOfMesh(hit)) continue;
        piece.source = mMedia.sourceOfMaterial(mTriangles.material(hit.triangle));
        open(last, hit.t);
        inside = std::max(0, inside + (hit.entering ? 1 : -1));
        last = hit.t;
    }
    open(last, kEndOfRay);
}

void Occlusion::collectShadowEdges(const scene::Ray& ray, const scene::Light& light,
                                   std::vector<double>& distances) const {
    if (mMedia.sphereCount() <= kMaxShadowEdgeCasters)
        mMedia.collectShadowEdges(ray, light, distances);
    if (mTriangles.count() <= kMaxShadowEdgeCasters)
        mTriangles.collectShadowEdges(ray, light, distances);
}

}  // namespace brume::reference
