// SPDX-License-Identifier: Apache-2.0
#include <shaders/particles/appearance.h>
#include <particles/appearance_curves.hpp>
#include <particles/blackbody.hpp>
#include <particles/surfaces.hpp>
#include <scene/texture.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace brume::particles {
namespace {

constexpr int kRibbonAges = 64, kRibbonRows = 16;  // texels; chosen by us
constexpr int kLeastCells = 32, kMostCells = 256, kMostCellEdge = 64;

/// Tint and density at an age.
struct Look {
    dvec3 tint{1};
    double coverage = 1;
};

Look lookAt(const scene::Effect& effect, double age) {
    Look look;
    look.tint = curveAt(effect.tint, age);
    if (!effect.temperature.keys.empty())
        look.tint *= blackbodyColor(curveAt(effect.temperature, age));
    look.coverage = std::clamp(curveAt(effect.density, age), 0.0, 1.0);
    return look;
}

double fade(const scene::Effect& effect, double r2) {
    if (!effect.smoothProfile) return 1;
    const double rest = std::max(1 - r2, 0.0);
    return rest * rest;
}

/// The pair of textures that a surface's material gets.
class LookTextures {
  public:
    LookTextures(const scene::Material& base, int width, int height) : mBase(&base) {
        mColor->name = mEmission->name = base.name + " over life";
        mColor->width = mEmission->width = width;
        mColor->height = mEmission->height = height;
        mColor->texels.resize(static_cast<std::size_t>(width) * height);
        mEmission->texels.resize(mColor->texels.size());
    }

    /// `color` and `emission`: what the material's own textures say there.
    void set(int x, int y, const Look& look, double fade, const vec4& color, const vec3& emission) {
        const std::size_t i = static_cast<std::size_t>(y) * mColor->width + x;
        const dvec3 tint = glm::min(look.tint, dvec3(1));
        mColor->texels[i] =
            vec4(vec3(color) * vec3(tint), color.a * static_cast<float>(look.coverage * fade));
        mEmission->texels[i] = vec4(emission * vec3(look.tint), 1);
    }

    scene::Material material() const {
        scene::Material result = *mBase;
        result.colorTexture = mColor;
        if (result.emission != dvec3(0)) result.emissionTexture = mEmission;
        return result;
    }

  private:
    const scene::Material* mBase;
    std::shared_ptr<scene::Texture> mColor = std::make_shared<scene::Texture>();
    std::shared_ptr<scene::Texture> mEmission = std::make_shared<scene::Texture>();
};

vec4 sampleOr1(const std::shared_ptr<const scene::Texture>& texture, const dvec2& uv) {
    return texture ? scene::sampleBilinear(*texture, uv) : vec4(1);
}

scene::Material makeRibbonMaterial(const scene::Material& base, const scene::Effect& effect) {
    LookTextures textures(base, kRibbonAges, kRibbonRows);
    for (int x = 0; x < kRibbonAges; ++x) {
        const double age = x / (kRibbonAges - 1.0);
        const Look look = lookAt(effect, age);
        for (int y = 0; y < kRibbonRows; ++y) {
            const double across = y / (kRibbonRows - 1.0);
            const dvec2 uv(age, across);
            textures.set(x, y, look, fade(effect, std::pow(2 * across - 1, 2)),
                         sampleOr1(base.colorTexture, uv), vec3(sampleOr1(base.emissionTexture, uv)));
        }
    }
    return textures.material();
}

/// The pictures of a billboard's life, in cells of a square sheet.
struct Film {
    int cells = 0, columns = 0, rows = 0;

    explicit Film(const scene::Surface& surface)
        : cells(std::clamp(4 * surface.columns * surface.rows, kLeastCells, kMostCells)),
          columns(static_cast<int>(std::ceil(std::sqrt(cells)))),
          rows((cells + columns - 1) / columns) {}

    double ageOf(int cell) const { return (cell + 0.5) / cells; }
    int cellAt(double age) const {
        return std::clamp(static_cast<int>(age * cells), 0, cells - 1);
    }
};

int cellEdge(const scene::Material& base, const scene::Surface& surface) {
    const scene::Texture* texture = base.colorTexture ? base.colorTexture.get()
                                                      : base.emissionTexture.get();
    if (!texture) return 32;
    return std::clamp(std::max(texture->width / surface.columns, texture->height / surface.rows), 8,
                      kMostCellEdge);
}

/// The place of a frame's point in the atlas; half a texel stays clear of the neighbours.
dvec2 atlasUv(const scene::Surface& surface, const scene::Texture& atlas, int frame, dvec2 uv) {
    const dvec2 size(static_cast<double>(atlas.width) / surface.columns,
                     static_cast<double>(atlas.height) / surface.rows);
    const dvec2 texel = glm::clamp(uv * size, dvec2(0.5), glm::max(size - 0.5, dvec2(0.5)));
    const dvec2 corner = dvec2(frame % surface.columns, frame / surface.columns) * size;
    return (corner + texel) / dvec2(atlas.width, atlas.height);
}

/// Two neighbouring frames blended, colours weighted by their coverage.
vec4 sampleFrames(const scene::Surface& surface, const std::shared_ptr<const scene::Texture>& atlas,
                  double frame, const dvec2& uv) {
    if (!atlas) return vec4(1);
    const int last = surface.columns * surface.rows - 1;
    const int first = std::clamp(static_cast<int>(std::floor(frame)), 0, last);
    const auto part = static_cast<float>(std::clamp(frame - first, 0.0, 1.0));
    const vec4 a = scene::sampleBilinear(*atlas, atlasUv(surface, *atlas, first, uv));
    const vec4 b =
        scene::sampleBilinear(*atlas, atlasUv(surface, *atlas, std::min(first + 1, last), uv));
    const float alpha = a.a + (b.a - a.a) * part;
    const vec3 sum = vec3(a) * a.a * (1 - part) + vec3(b) * b.a * part;
    return alpha > 0 ? vec4(sum / alpha, alpha) : vec4(0);
}

double frameAt(const scene::Surface& surface, double age) {
    if (!surface.frames.keys.empty()) return curveAt(surface.frames, age);
    return age * (surface.columns * surface.rows - 1);
}

scene::Material makeBillboardMaterial(const scene::Material& base, const scene::Effect& effect) {
    const scene::Surface& surface = *effect.surface;
    const Film film(surface);
    const int edge = cellEdge(base, surface);
    LookTextures textures(base, film.columns * edge, film.rows * edge);
    for (int cell = 0; cell < film.cells; ++cell) {
        const double age = film.ageOf(cell);
        const Look look = lookAt(effect, age);
        const double frame = frameAt(surface, age);
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const dvec2 uv((x + 0.5) / edge, (y + 0.5) / edge);
                const dvec2 fromMiddle = 2.0 * uv - 1.0;
                textures.set(cell % film.columns * edge + x, cell / film.columns * edge + y, look,
                             fade(effect, glm::dot(fromMiddle, fromMiddle)),
                             sampleFrames(surface, base.colorTexture, frame, uv),
                             vec3(sampleFrames(surface, base.emissionTexture, frame, uv)));
            }
    }
    return textures.material();
}

/// A particle as a surface shows it.
struct Point {
    dvec3 place{0};  // world
    double radius = 0;
    double age = 0;
    double seconds = 0;
    std::uint32_t strand = 0;
    std::uint32_t birthIndex = 0;
};

std::vector<Point> findPoints(const SurfaceParticles& p, const ParticleFrame& frame) {
    std::vector<Point> points;
    const std::vector<Particle>& particles = p.state.populations[p.population];
    const std::vector<std::uint32_t>& strands = p.state.strands[p.population];
    const auto lastTick = static_cast<std::uint32_t>(p.state.tick - 1);
    const auto since = static_cast<float>(p.sinceTick);
    const double scale = frame.radiusScale;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Particle& particle = particles[i];
        if (!shader::isShownAt(particle.life, lastTick, since)) continue;
        const float age = shader::normalisedAge(particle.life, lastTick, since);
        const float radius = shader::evaluateAppearance(p.compiled.parameters, age,
                                                        glm::length(particle.velocity))
                                 .radius;
        const dvec3 place = dvec3(particle.position) +
                            dvec3(particle.velocity) * (p.sinceTick / p.compiled.tickRate);
        points.push_back({transformPoint(frame.worldFromParticles, place), radius * scale, age,
                          age * particle.life.lifetimeTicks / p.compiled.tickRate,
                          strands.empty() ? 0 : strands[i], particle.birthIndex});
    }
    return points;
}

/// Where each ribbon of a trail ends: at its parent, with the look of a newborn.
void addParents(const SurfaceParticles& p, const ParticleFrame& frame,
                std::vector<Point>& points) {
    if (!p.compiled.isChild() || points.empty()) return;
    const auto lastTick = static_cast<std::uint32_t>(p.state.tick - 1);
    const auto since = static_cast<float>(p.sinceTick);
    const double radius = shader::evaluateAppearance(p.compiled.parameters, 0, 0).radius;
    for (const Particle& parent : p.state.populations[p.compiled.parent]) {
        if (!shader::isShownAt(parent.life, lastTick, since)) continue;
        const dvec3 place = dvec3(parent.position) +
                            dvec3(parent.velocity) * (p.sinceTick / p.compiled.tickRate);
        points.push_back({transformPoint(frame.worldFromParticles, place),
                          radius * frame.radiusScale, 0, 0, parent.birthIndex, 0});
    }
}

dvec3 towardsCamera(const scene::CameraFrame& camera, const dvec3& place) {
    return camera.type == scene::CameraType::Orthographic
               ? -camera.forward
               : glm::normalize(camera.position - place);
}

class MeshBuilder {
  public:
    explicit MeshBuilder(std::uint32_t material) {
        mMesh.name = "particles";
        mMesh.material = material;
    }

    std::uint32_t add(const dvec3& place, const dvec3& normal, const dvec2& uv) {
        if (mMesh.positions.empty()) {
            mOrigin = place;
            mMesh.worldFromObject = glm::translate(dmat4(1), place);
        }
        mMesh.positions.push_back(vec3(place - mOrigin));
        mMesh.normals.push_back(vec3(normal));
        mMesh.uvs.push_back(vec2(uv));
        return static_cast<std::uint32_t>(mMesh.positions.size() - 1);
    }

    void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        for (const std::uint32_t i : {a, b, c, a, c, d}) mMesh.indices.push_back(i);
    }

    scene::Mesh take() { return std::move(mMesh); }

  private:
    scene::Mesh mMesh;
    dvec3 mOrigin{0};
};

void addRibbon(std::span<const Point> points, const scene::CameraFrame& camera,
               MeshBuilder& builder) {
    if (points.size() < 2) return;
    dvec3 side = camera.right;
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[i];
        const dvec3 way = points[std::min(i + 1, points.size() - 1)].place -
                          points[i > 0 ? i - 1 : 0].place;
        const dvec3 view = towardsCamera(camera, point.place);
        const dvec3 across = glm::cross(view, way);
        // Along the view there is no side to turn to: the last one stays.
        if (glm::length(across) > 1e-9 * glm::length(way) + 1e-30) side = glm::normalize(across);
        const double u = (0.5 + std::clamp(point.age, 0.0, 1.0) * (kRibbonAges - 1)) / kRibbonAges;
        const double margin = 0.5 / kRibbonRows;
        const std::uint32_t left =
            builder.add(point.place + side * point.radius, view, {u, margin});
        builder.add(point.place - side * point.radius, view, {u, 1 - margin});
        if (i > 0) builder.addQuad(before, before + 1, left + 1, left);
        before = left;
    }
}

void addRibbons(std::vector<Point> points, const scene::CameraFrame& camera,
                MeshBuilder& builder) {
    // Particles stand in the order of birth; parents come last.
    std::stable_sort(points.begin(), points.end(),
                     [](const Point& a, const Point& b) { return a.strand < b.strand; });
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
        while (end < points.size() && points[end].strand == points[begin].strand) ++end;
        addRibbon(std::span(points).subspan(begin, end - begin), camera, builder);
    }
}

void addBillboard(const SurfaceParticles& particles, const Point& point, const Film& film, int edge,
                  const scene::CameraFrame& camera, MeshBuilder& builder) {
    const scene::Surface& surface = *particles.effect.surface;
    const shader::uvec4 words =
        shader::randomWords(particles.random, point.birthIndex, shader::kChannelLook);
    const auto between = [](const dvec2& range, std::uint32_t word) {
        return range.x + (range.y - range.x) * static_cast<double>(shader::unitFloat(word));
    };
    const double angle = curveAt(surface.rotation, point.age) +
                         between(surface.startRotation, words.x) +
                         between(surface.spin, words.y) * point.seconds;
    const dvec3 x = (camera.right * std::cos(angle) + camera.up * std::sin(angle)) * point.radius;
    const dvec3 y = (camera.up * std::cos(angle) - camera.right * std::sin(angle)) * point.radius;
    const int cell = film.cellAt(point.age);
    const dvec2 corner(cell % film.columns, cell / film.columns);
    const double margin = 0.5 / edge;
    const auto vertex = [&](double sx, double sy) {
        const dvec2 inCell(0.5 + sx * (0.5 - margin), 0.5 - sy * (0.5 - margin));
        return builder.add(point.place + x * sx + y * sy, -camera.forward,
                           (corner + inCell) / dvec2(film.columns, film.rows));
    };
    const std::uint32_t a = vertex(-1, -1), b = vertex(1, -1), c = vertex(1, 1), d = vertex(-1, 1);
    builder.addQuad(a, b, c, d);
}

}  // namespace

scene::Material makeSurfaceMaterial(const scene::Material& base, const scene::Effect& effect) {
    return effect.surface->type == scene::SurfaceType::Ribbon ? makeRibbonMaterial(base, effect)
                                                              : makeBillboardMaterial(base, effect);
}

scene::Mesh makeSurfaceMesh(const SurfaceParticles& particles, const ParticleFrame& frame,
                            const scene::CameraFrame& camera, std::uint32_t material) {
    MeshBuilder builder(material);
    if (particles.state.tick == 0) return builder.take();
    std::vector<Point> points = findPoints(particles, frame);
    if (particles.effect.surface->type == scene::SurfaceType::Ribbon) {
        addParents(particles, frame, points);
        addRibbons(std::move(points), camera, builder);
        return builder.take();
    }
    const Film film(*particles.effect.surface);
    // Half a texel of a cell of the usual size keeps clear of the neighbours in smaller ones too.
    for (const Point& point : points)
        if (point.radius > 0)
            addBillboard(particles, point, film, 32, camera, builder);
    return builder.take();
}

}  // namespace brume::particles
