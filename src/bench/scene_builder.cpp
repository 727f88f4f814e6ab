// SPDX-License-Identifier: Apache-2.0
#include <bench/scene_builder.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brume::bench {
namespace {

/// Optical depths along the sun's rays, by summing spheres into cells.
class LightGrid {
  public:
    LightGrid(std::span<const scene::Sphere> spheres, double extinction) {
        for (const scene::Sphere& sphere : spheres) {
            mBounds.extend(sphere.center - dvec3(sphere.radius));
            mBounds.extend(sphere.center + dvec3(sphere.radius));
        }
        mCell = std::max({mBounds.size().x, mBounds.size().y, mBounds.size().z}) / kCells;
        for (const scene::Sphere& sphere : spheres) add(sphere, extinction);
    }

    double transmittance(const dvec3& from, const dvec3& towardsLight) const {
        double depth = 0;
        for (int step = 1; step < 2 * kCells; ++step) {
            const dvec3 at = from + towardsLight * (mCell * step);
            if (glm::any(glm::lessThan(at, mBounds.lo)) ||
                glm::any(glm::greaterThan(at, mBounds.hi)))
                break;
            depth += mDensity[indexOf(at)] * mCell;
        }
        return std::exp(-depth);
    }

  private:
    static constexpr int kCells = 48;

    ivec3 cellOf(const dvec3& at) const {
        return glm::clamp(ivec3((at - mBounds.lo) / mCell), ivec3(0), ivec3(kCells - 1));
    }
    std::size_t indexOf(const dvec3& at) const {
        const ivec3 cell = cellOf(at);
        return (static_cast<std::size_t>(cell.z) * kCells + cell.y) * kCells + cell.x;
    }
    /// The means of the cells, by points a cell apart.
    void add(const scene::Sphere& sphere, double extinction) {
        const int reach = static_cast<int>(std::ceil(sphere.radius / mCell));
        double sum = 0;
        const auto visit = [&](auto&& use) {
            for (int z = -reach; z <= reach; ++z)
                for (int y = -reach; y <= reach; ++y)
                    for (int x = -reach; x <= reach; ++x) {
                        const dvec3 offset = dvec3(x, y, z) * mCell;
                        const double r2 = glm::dot(offset, offset) / (sphere.radius * sphere.radius);
                        if (r2 < 1) use(offset, (1 - r2) * (1 - r2));
                    }
        };
        visit([&](const dvec3&, double weight) { sum += weight; });
        // A smooth sphere holds 32/105 of the volume of its ball.
        const double whole = extinction * sphere.density * (32.0 / 105) * 4 / 3 *
                             std::numbers::pi * std::pow(sphere.radius / mCell, 3);
        visit([&](const dvec3& offset, double weight) {
            mDensity[indexOf(sphere.center + offset)] += whole * weight / sum;
        });
    }

    Box3 mBounds;
    double mCell = 1;
    std::vector<double> mDensity = std::vector<double>(std::size_t{kCells} * kCells * kCells);
};

double hashAt(const ivec3& cell) {
    std::uint32_t h = 0x9e3779b9u * static_cast<std::uint32_t>(cell.x) ^
                      0x85ebca6bu * static_cast<std::uint32_t>(cell.y) ^
                      0xc2b2ae35u * static_cast<std::uint32_t>(cell.z);
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return static_cast<double>(h ^ h >> 15) / 0xffffffffu * 2 - 1;
}

}  // namespace

double noiseAt(const dvec3& at) {
    const dvec3 low = glm::floor(at), f = at - low, s = f * f * (3.0 - 2.0 * f);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const dvec3 w = glm::mix(1.0 - s, s, dvec3(step));
        sum += w.x * w.y * w.z * hashAt(ivec3(low) + step);
    }
    return sum;
}

dmat4 place(const dvec3& at, double yawDegrees, double pitchDegrees) {
    dmat4 m = glm::translate(dmat4(1), at);
    m = glm::rotate(m, radians(yawDegrees), dvec3(0, 1, 0));
    return glm::rotate(m, radians(pitchDegrees), dvec3(1, 0, 0));
}

scene::Mesh makeLathe(std::span<const dvec2> profile, int segments) {
    scene::Mesh mesh;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const dvec2 a = profile[i], b = profile[i + 1], along = b - a;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k <= segments; ++k) {
            const double angle = 2 * std::numbers::pi * (k % segments) / segments;
            const dvec3 out(std::sin(angle), 0, std::cos(angle));
            const dvec3 normal = glm::normalize(out * along.y - dvec3(0, along.x, 0));
            for (const dvec2& p : {a, b}) {
                mesh.positions.emplace_back(out * p.x + dvec3(0, p.y, 0));
                mesh.normals.emplace_back(normal);
                mesh.uvs.emplace_back(double(k) / segments, p.y);
            }
            if (k == segments) break;
            const std::uint32_t at = first + 2 * static_cast<std::uint32_t>(k);
            for (const std::uint32_t corner : {0u, 2u, 1u, 1u, 2u, 3u})
                mesh.indices.push_back(at + corner);
        }
    }
    return mesh;
}

scene::Mesh makeRod(const dvec3& from, const dvec3& to, double radius) {
    const double length = glm::length(to - from);
    const dvec2 profile[] = {{0, 0}, {radius, 0}, {radius, length}, {0, length}};
    scene::Mesh mesh = makeLathe(profile, 16);
    const dvec3 up = (to - from) / length;
    const dvec3 side = glm::normalize(
        glm::cross(std::abs(up.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), up));
    const dmat3 turn(side, up, glm::cross(side, up));
    for (vec3& p : mesh.positions) p = vec3(turn * dvec3(p) + from);
    for (vec3& n : mesh.normals) n = vec3(turn * dvec3(n));
    return mesh;
}

std::shared_ptr<const scene::Texture> paintTexture(const std::string& name, int width, int height,
                                                   const PaintFunction& colour) {
    auto texture = std::make_shared<scene::Texture>();
    texture->name = name;
    texture->width = width;
    texture->height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            texture->texels.emplace_back(colour((x + 0.5) / width, (y + 0.5) / height));
    return texture;
}

Builder::Builder(const dvec3& eye, const dvec3& target, double fovDegrees) {
    scene.image = {640, 360, 1};
    scene.camera.position = eye;
    scene.camera.target = target;
    scene.camera.verticalFov = radians(fovDegrees);
}

void Builder::addSky(const dvec3& zenith, const dvec3& horizon, const dvec3& ground) {
    addDaylight(scene);
    const dvec3 sun = -scene.lights.back().direction;
    scene.background.environment = paintTexture("sky", 128, 64, [&](double u, double v) {
        const double azimuth = (u - 0.5) * 2 * std::numbers::pi, polar = v * std::numbers::pi;
        const dvec3 d(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                      -std::sin(polar) * std::cos(azimuth));
        const dvec3 sky = glm::mix(horizon, zenith, std::pow(std::max(d.y, 0.0), 0.6));
        const dvec3 earth = glm::mix(horizon, ground, std::min(1.0, -6 * d.y));
        const double glow = std::pow(std::max(glm::dot(d, sun), 0.0), 64.0);
        return dvec4(d.y > 0 ? sky + 2 * glow * dvec3(1, 0.9, 0.7) : earth, 1);
    });
}

void Builder::addFloor(double size, double edge, const std::array<dvec3, 2>& colours,
                       std::span<const dvec3> feet) {
    scene::Material flags;
    flags.albedo = dvec3(1);
    flags.colorTexture = paintTexture("floor", 1024, 1024, [&](double u, double v) {
        const dvec2 at = (dvec2(u, v) - 0.5) * size;
        const ivec2 flag(glm::floor(at / edge));
        const dvec2 inside = glm::abs(glm::fract(at / edge) - 0.5);
        dvec3 colour = colours[static_cast<std::size_t>((flag.x + flag.y) & 1)];
        colour *= 1 + 0.12 * hashAt({flag, 7}) + 0.06 * noiseAt({at * 9.0, 0.5});
        if (std::max(inside.x, inside.y) > 0.5 - 0.012 / edge) colour *= 0.5;
        for (const dvec3& foot : feet) {
            const double r = glm::length(at - dvec2(foot.x, foot.y)) / foot.z;
            colour *= 1 - 0.75 * std::exp(-r * r);
        }
        return dvec4(colour, 1);
    });
    addMesh(scene::makePlane(dvec2(size)), add(flags));
}

std::uint32_t Builder::add(const scene::Material& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t Builder::addOpaque(const dvec3& albedo, const dvec3& emission) {
    scene::Material m;
    m.albedo = albedo;
    m.emission = emission;
    return add(m);
}

std::uint32_t Builder::addThin(double coverage, const dvec3& transmission, const dvec3& reflected,
                               double collimation) {
    scene::Material m;
    m.type = scene::MaterialType::Thin;
    m.coverage = coverage;
    m.transmission = transmission;
    m.reflected = reflected;
    m.collimation = collimation;
    return add(m);
}

std::uint32_t Builder::addShiny(const dvec3& transmission) {
    scene::Material m;
    m.type = scene::MaterialType::Thin;
    m.transmission = transmission;
    m.roughness = 0.08;
    return add(m);
}

std::uint32_t Builder::addGlass(const dvec3& absorption, double roughness) {
    scene::Material m;
    m.type = scene::MaterialType::Solid;
    m.absorption = absorption;
    m.roughness = roughness;
    return add(m);
}

std::uint32_t Builder::addMedium(double extinction, const dvec3& albedo) {
    scene::Medium medium;
    medium.extinction = dvec3(extinction);
    medium.albedo = albedo;
    scene.media.push_back(medium);
    return static_cast<std::uint32_t>(scene.media.size() - 1);
}

void Builder::addMesh(scene::Mesh mesh, std::uint32_t material, const dmat4& transform) {
    mesh.material = material;
    scene::placeMesh(mesh, transform);
    scene.meshes.push_back(std::move(mesh));
}

void Builder::addPane(std::uint32_t material, const dvec2& size, const dvec3& at, double yaw) {
    addMesh(scene::makePlane(size), material, place(at, yaw, 90));
}

void Builder::addBox(std::uint32_t material, const dvec3& size, const dvec3& at, double yaw) {
    addMesh(scene::makeBox(size), material, place(at, yaw));
}

void Builder::addFrame(std::uint32_t material, const dvec2& size, double bar, const dvec3& at,
                       double yaw) {
    const dmat4 frame = place(at, yaw);
    const auto addBar = [&](const dvec3& extent, const dvec3& offset) {
        addMesh(scene::makeBox(extent), material, frame * place(offset));
    };
    for (const double side : {-0.5, 0.5}) {
        addBar({bar, size.y + bar, bar}, {side * size.x, 0, 0});
        addBar({size.x - bar, bar, bar}, {0, side * size.y, 0});
    }
}

void Builder::addSphere(std::uint32_t medium, const dvec3& center, double radius, double density) {
    scene.spheres.push_back({center, radius, medium, density, scene::Profile::Smooth});
}

ShadedSmoke Builder::beginSmoke(double extinction, const dvec3& albedo) {
    const ShadedSmoke smoke{static_cast<std::uint32_t>(scene.media.size()), scene.spheres.size()};
    for (std::uint32_t shade = 0; shade < ShadedSmoke::kShades; ++shade)
        addMedium(extinction, albedo * (1 - 0.75 * shade / (ShadedSmoke::kShades - 1)));
    return smoke;
}

void Builder::shadeSmoke(const ShadedSmoke& smoke) {
    const std::span spheres = std::span(scene.spheres).subspan(smoke.firstSphere);
    const LightGrid grid(spheres, scene.media[smoke.firstMedium].extinction.x);
    const dvec3 towardsLight = -scene.lights.back().direction;
    for (scene::Sphere& sphere : spheres) {
        const double shade = (1 - grid.transmittance(sphere.center, towardsLight)) *
                             (ShadedSmoke::kShades - 1);
        sphere.medium = smoke.firstMedium + static_cast<std::uint32_t>(shade + 0.5);
    }
}

void Builder::addPoint(const dvec3& position, const dvec3& intensity) {
    scene::Light light;
    light.type = scene::LightType::Point;
    light.position = position;
    light.color = intensity;
    light.radius = 0.1;
    scene.lights.push_back(light);
}

void Builder::addAmbient(const dvec3& radiance) {
    scene::Light light;
    light.color = radiance;
    scene.lights.push_back(light);
}

}  // namespace brume::bench
