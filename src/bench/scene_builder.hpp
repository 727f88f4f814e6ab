// SPDX-License-Identifier: Apache-2.0
// Parts from which the built-in scenes are put together.
#pragma once

#include <bench/scene_parts.hpp>
#include <scene/mesh_shapes.hpp>

#include <array>
#include <functional>
#include <memory>
#include <span>

namespace brume::bench {

dmat4 place(const dvec3& at, double yawDegrees = 0, double pitchDegrees = 0);

/// A surface of revolution about +Y through points (radius, height), from bottom to top; smooth
/// across the circle, flat along the profile.
scene::Mesh makeLathe(std::span<const dvec2> profile, int segments);
/// A rod from `from` to `to`.
scene::Mesh makeRod(const dvec3& from, const dvec3& to, double radius);

/// `colour(u, v)` with u and v in [0, 1): linear, with alpha.
using PaintFunction = std::function<dvec4(double u, double v)>;
std::shared_ptr<const scene::Texture> paintTexture(const std::string& name, int width, int height,
                                                   const PaintFunction& colour);

/// Smooth noise in [-1, 1] with features of size 1.
double noiseAt(const dvec3& at);

/// Smoke that is lit as if it cast shadows on itself: media of one extinction that differ in how
/// bright they are, so that every method sees the same light without a shadow map.
struct ShadedSmoke {
    static constexpr std::uint32_t kShades = 8;
    std::uint32_t firstMedium = 0;
    std::size_t firstSphere = 0;
};

/// A scene under construction, seen from +z.
struct Builder {
    scene::Scene scene;

    Builder(const dvec3& eye, const dvec3& target, double fovDegrees);

    /// The same daylight as addDaylight(), and a sky to go with it: from `horizon` up to `zenith`.
    void addSky(const dvec3& zenith, const dvec3& horizon, const dvec3& ground);
    /// Flags of `colours` by turns on the ground, `edge` metres wide; darker under `feet` (x, z,
    /// radius), where things stand.
    void addFloor(double size, double edge, const std::array<dvec3, 2>& colours,
                  std::span<const dvec3> feet);

    std::uint32_t add(const scene::Material& material);
    std::uint32_t addOpaque(const dvec3& albedo, const dvec3& emission = dvec3(0));
    std::uint32_t addThin(double coverage, const dvec3& transmission, const dvec3& reflected,
                          double collimation = 1);
    /// Thin glass that mirrors.
    std::uint32_t addShiny(const dvec3& transmission);
    std::uint32_t addGlass(const dvec3& absorption, double roughness);
    std::uint32_t addMedium(double extinction, const dvec3& albedo);

    void addMesh(scene::Mesh mesh, std::uint32_t material, const dmat4& transform = dmat4(1));
    /// A rectangle that faces +z.
    void addPane(std::uint32_t material, const dvec2& size, const dvec3& at, double yaw = 0);
    void addBox(std::uint32_t material, const dvec3& size, const dvec3& at, double yaw = 0);
    /// Four bars around such a rectangle.
    void addFrame(std::uint32_t material, const dvec2& size, double bar, const dvec3& at,
                  double yaw = 0);

    void addSphere(std::uint32_t medium, const dvec3& center, double radius, double density);
    /// Smoke whose spheres follow by addSphere(smoke.firstMedium, ...); shadeSmoke() ends it.
    ShadedSmoke beginSmoke(double extinction, const dvec3& albedo);
    void shadeSmoke(const ShadedSmoke& smoke);

    void addPoint(const dvec3& position, const dvec3& intensity);
    void addAmbient(const dvec3& radiance);
};

}  // namespace brume::bench
