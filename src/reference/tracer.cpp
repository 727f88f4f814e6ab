// SPDX-License-Identifier: Apache-2.0
#include <reference/tracer.hpp>

#include <reference/surface_response.hpp>
#include <scene/texture.hpp>

#include <algorithm>
#include <tuple>

namespace brume::reference {
namespace {

using Kind = RayScratch::Event::Kind;

bool isBefore(const RayScratch::Event& a, const RayScratch::Event& b) {
    return std::tie(a.t, a.kind, a.index) < std::tie(b.t, b.kind, b.index);
}

}  // namespace

struct Tracer::World {
    const scene::Scene& scene;
    TriangleSet triangles;
    MediaSet media;
    Occlusion occlusion;
    Lighting lighting;

    World(const Input& input, bool withShadows)
        : scene(input.scene),
          triangles(input.scene),
          media(input),
          occlusion(triangles, media),
          lighting(input.scene, media, occlusion, withShadows) {}

    double size() const {
        Box3 box = triangles.bounds();
        box.extend(media.bounds());
        const double size = box.isEmpty() ? 0 : glm::length(box.size());
        return size > 0 ? size : 1;
    }

    SurfaceResponse respondTo(const scene::Ray& ray, const Hit& hit) const {
        const SurfacePoint point = triangles.describe(ray, hit);
        const bool isLit = point.material->type != scene::MaterialType::Solid;
        return respond(*point.material, point.uv, isLit ? lighting.illuminate(point) : dvec3(0),
                       findGloss(ray, hit, point));
    }

    Gloss findGloss(const scene::Ray& ray, const Hit& hit, const SurfacePoint& point) const {
        const scene::Material& material = *point.material;
        if (material.roughness < 0 || material.type == scene::MaterialType::Opaque) return {};
        const bool isPane = material.type == scene::MaterialType::Thin;
        const double cosine = std::max(-glm::dot(point.normal, ray.direction), 0.0);
        Gloss gloss;
        gloss.share = glassReflectance(cosine, material.ior, isPane);
        gloss.radiance = gloss.share *
                         scene::environmentRadiance(scene.background,
                                                    ray.direction + 2 * cosine * point.normal);
        // Lights do not reach the inner side of a solid.
        if (isPane || hit.entering) gloss.radiance += lighting.highlights(point, ray.direction);
        return gloss;
    }

    void collectEvents(const scene::Ray& ray, double tEnd, RayScratch& scratch) const;
    void sweep(const scene::Ray& ray, double tEnd, RayScratch& scratch) const;
};

void Tracer::World::collectEvents(const scene::Ray& ray, double tEnd, RayScratch& s) const {
    s.events.clear();
    for (std::uint32_t i = 0; i < s.hits.size(); ++i)
        if (s.hits[i].t < tEnd) s.events.push_back({s.hits[i].t, Kind::Surface, i});
    if (!s.integral.isUniform()) {
        for (std::uint32_t i = 0; i < s.pieces.size(); ++i) {
            s.events.push_back({s.pieces[i].t0, Kind::Open, i});
            s.events.push_back({s.pieces[i].t1, Kind::Close, i});
        }
        s.breaks.clear();
        if (!s.pieces.empty()) lighting.collectBreaks(ray, s.breaks);
        for (const double t : s.breaks)
            if (t > 0 && t < tEnd) s.events.push_back({t, Kind::Break, 0});
    }
    std::sort(s.events.begin(), s.events.end(), isBefore);
    s.events.push_back({tEnd, Kind::Break, 0});
}

void Tracer::World::sweep(const scene::Ray& ray, double tEnd, RayScratch& s) const {
    s.integral.start(ray, s.pieces);
    collectEvents(ray, tEnd, s);
    s.open.clear();
    double t = 0;
    for (const RayScratch::Event& event : s.events) {
        if (event.t > t) {
            if (s.integral.isUniform())
                s.integral.advanceUniform(t, event.t);
            else
                s.integral.advance(t, event.t, s.open);
            t = event.t;
        }
        if (event.kind == Kind::Open) s.open.push_back(event.index);
        if (event.kind == Kind::Close) std::erase(s.open, event.index);
        if (event.kind == Kind::Surface && !s.integral.isDark())
            s.integral.pass(respondTo(ray, s.hits[event.index]));
    }
}

Tracer::Tracer(const Input& input, bool withShadows)
    : mWorld(std::make_shared<const World>(input, withShadows)) {}

RayScratch Tracer::makeScratch() const {
    return RayScratch(MediumIntegral(mWorld->media, mWorld->lighting, mWorld->size()));
}

RayResult Tracer::integrateRay(const scene::Ray& ray, double surfaceMin,
                               RayScratch& scratch) const {
    const World& world = *mWorld;
    const auto opaque = world.triangles.findNearestOpaque(ray, surfaceMin, kInfinity);
    const double tEnd = opaque ? opaque->t : kEndOfRay;
    RayResult result;
    if (opaque) result.triangles += world.triangles.hash(opaque->triangle);
    scratch.hits.clear();
    world.triangles.collectTransparent(ray, surfaceMin, kNoTriangle, scratch.hits);
    for (const Hit& hit : scratch.hits)
        if (hit.t < tEnd) result.triangles += world.triangles.hash(hit.triangle);
    scratch.pieces.clear();
    world.media.collect(ray, tEnd, scratch.pieces);
    world.occlusion.collectSolids(scratch.hits, tEnd, scratch.pieces);
    world.sweep(ray, tEnd, scratch);
    result.transmittance = scratch.integral.transmittance();
    if (!scratch.integral.isDark())
        scratch.integral.pass(
            opaque ? world.respondTo(ray, *opaque)
                   : SurfaceResponse{dvec3(0), scene::environmentRadiance(world.scene.background,
                                                                          ray.direction)});
    result.radiance = scratch.integral.radiance();
    return result;
}

RayResult Tracer::integrateRay(const scene::Ray& ray, double surfaceMin) const {
    RayScratch scratch = makeScratch();
    return integrateRay(ray, surfaceMin, scratch);
}

dvec3 Tracer::transmittance(const dvec3& from, const dvec3& to) const {
    const double length = glm::length(to - from);
    if (!(length > 0)) return dvec3(1);
    return mWorld->occlusion.transmittance({from, (to - from) / length}, 0, length);
}

}  // namespace brume::reference
