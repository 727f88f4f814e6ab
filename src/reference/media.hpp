// SPDX-License-Identifier: Apache-2.0
// Everything that fills space: soft spheres, volume grids and the inside of solid meshes, as pieces
// of polynomial density along a ray.
#pragma once

#include <reference/bvh.hpp>
#include <reference/reference.hpp>
#include <scene/camera.hpp>
#include <volumes/density_field.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace brume::reference {

/// Optical properties per unit density, tint included. Media with equal properties share one.
struct Source {
    dvec3 extinction{0};
    dvec3 scattering{0};
    dvec3 emission{0};
    scene::PhaseType phase = scene::PhaseType::Isotropic;
    double g = 0;
};

/// No sphere, or one that asks for shadows at each place.
inline constexpr std::uint32_t kNoSphere = ~0u;

/// The density of one medium over [t0, t1] of a ray: a polynomial of degree 0, 3 or 4.
struct Piece {
    enum class Kind : std::uint8_t { Constant, Smooth, Cubic };

    double t0 = 0, t1 = 0;
    double c[4] =
        {};  ///< value; scale, entry and exit of the chord; coefficients in (t - t0) / (t1 - t0)
    std::uint32_t source = 0;
    Kind kind = Kind::Constant;
    std::uint32_t sphere = kNoSphere;  ///< that is shadowed as a whole

    /// Factored where it has zeros, so that it is precise relative to itself near the rim of a
    /// sphere.
    double density(double t) const {
        switch (kind) {
            case Kind::Constant:
                return c[0];
            case Kind::Smooth: {
                const double q = (t - c[1]) * (c[2] - t);
                return c[0] * q * q;
            }
            case Kind::Cubic:
                break;
        }
        const double u = (t - t0) / (t1 - t0);
        return std::max(0.0, c[0] + u * (c[1] + u * (c[2] + u * c[3])));
    }

    /// The density at five distances.
    void densities(const double (&t)[5], double (&result)[5]) const {
        if (kind == Kind::Smooth) {
            for (int k = 0; k < 5; ++k) {
                const double q = (t[k] - c[1]) * (c[2] - t[k]);
                result[k] = c[0] * q * q;
            }
        } else {
            for (int k = 0; k < 5; ++k) result[k] = density(t[k]);
        }
    }

    /// Integral of the density over [a, b], which lies in [t0, t1]: Boole's rule, exact to
    /// degree 5.
    double integrate(double a, double b) const {
        const double h = b - a;
        if (kind == Kind::Constant) return c[0] * h;
        const double ends = density(a) + density(b), middle = density(a + 0.5 * h);
        if (kind == Kind::Cubic) return h / 6 * (ends + 4 * middle);
        const double quarters = density(a + 0.25 * h) + density(a + 0.75 * h);
        return h / 90 * (7 * ends + 32 * quarters + 12 * middle);
    }
};

/// The scene's media. Not the solids' shapes, which are triangles, only their properties.
class MediaSet {
  public:
    /// What `input` refers to must outlive the set. Throws an input Error if its parts do not
    /// belong together.
    explicit MediaSet(const Input& input);

    const Source& source(std::uint32_t index) const { return mSources[index]; }
    std::uint32_t sourceCount() const { return static_cast<std::uint32_t>(mSources.size()); }
    /// What fills a solid mesh; one of Scene::materials.
    std::uint32_t sourceOfMaterial(const scene::Material& material) const;

    Box3 bounds() const;

    /// Appends the pieces of spheres and grids in [0, tMax], in no stated order.
    void collect(const scene::Ray& ray, double tMax, std::vector<Piece>& pieces) const;
    /// Optical depth of spheres and grids in [0, tMax].
    dvec3 opticalDepth(const scene::Ray& ray, double tMax) const;

    std::size_t sphereCount() const { return mSpheres.size(); }
    dvec3 sphereCenter(std::uint32_t sphere) const { return mSpheres[sphere].center; }
    double sphereRadius(std::uint32_t sphere) const { return mSpheres[sphere].radius; }
    /// Does some sphere that scatters ask for shadows as a whole?
    bool hasWholeSpheres() const { return mHasWholeSpheres; }
    /// Does some medium that scatters ask for shadows at each place?
    bool hasSampledMedia() const { return mHasSampledMedia; }
    /// Appends where a ray enters and leaves the shadows of the spheres (and of their mirror
    /// images).
    void collectShadowEdges(const scene::Ray& ray, const scene::Light& light,
                            std::vector<double>& distances) const;

  private:
    struct SphereShape {
        dvec3 center;
        double radius, density;
        std::uint32_t source;
        scene::Profile profile;
        bool isWhole;
    };
    struct Grid {
        std::unique_ptr<volumes::DensityField> field;
        dvec3 offset;          ///< world position of index 0
        dmat3 indexFromWorld;  ///< linear part
        std::uint32_t source;
    };

    std::uint32_t addSource(const Source& source);
    std::uint32_t sourceOfMedium(std::uint32_t medium, const char* what) const;
    bool scatters(std::uint32_t source) const { return mSources[source].scattering != dvec3(0); }
    void addSpheres(const Input& input);
    void addGrids(const Input& input);
    static bool makePiece(const SphereShape& sphere, const scene::Ray& ray, double tMax,
                          Piece& piece);
    static volumes::IndexRay toIndexSpace(const Grid& grid, const scene::Ray& ray);

    std::vector<Source> mSources;
    std::vector<std::uint32_t> mMaterialSources;  ///< parallel to Scene::materials
    std::vector<std::uint32_t> mMediumSources;    ///< parallel to Scene::media
    std::span<const scene::Material> mMaterials;
    std::vector<SphereShape> mSpheres;
    Bvh mSphereTree;
    std::vector<Grid> mGrids;
    Box3 mGridBounds;
    bool mHasWholeSpheres = false, mHasSampledMedia = false;
};

}  // namespace brume::reference
