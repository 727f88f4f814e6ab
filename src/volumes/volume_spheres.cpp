// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <volumes/volume_spheres.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::volumes {
namespace {

constexpr int kBlockCells = 2;
/// Integral of (1 - r^2/R^2)^2 over the ball of radius R, divided by R^3.
constexpr double kSmoothBall = 32 * kPi / 105;

/// Integral of the density over a block, in cells, and its first moment in index space.
struct Lump {
    double mass = 0;
    dvec3 moment{0};
};

/// Weights the integral of a trilinear interpolant over `kBlockCells` cells gives to its corners.
constexpr double kCornerWeight[kBlockCells + 1] = {0.5, 1.0, 0.5};
/// Integral of x times the hat functions of the corners over [0, 2].
constexpr double kCornerMoment[kBlockCells + 1] = {1.0 / 6, 1.0, 5.0 / 6};

/// Exact integrals over the block of cells that starts at the brick's cell `first`.
Lump lumpOf(const float* values, const ivec3& first) {
    Lump lump;
    for (int k = 0; k <= kBlockCells; ++k)
        for (int j = 0; j <= kBlockCells; ++j)
            for (int i = 0; i <= kBlockCells; ++i) {
                const int at =
                    ((first.z + k) * kBrickValues + first.y + j) * kBrickValues + first.x + i;
                const double value = values[at];
                const double x = kCornerWeight[i], y = kCornerWeight[j], z = kCornerWeight[k];
                lump.mass += value * x * y * z;
                lump.moment += value * dvec3(kCornerMoment[i] * y * z, x * kCornerMoment[j] * z,
                                             x * y * kCornerMoment[k]);
            }
    return lump;
}

/// Integral of a box's profile along one axis over [a, b], and its first moment.
dvec2 integrateAxis(const ValueBox& box, int axis, double a, double b) {
    if (!box.soft) {
        const double x0 = std::max(a, box.lo[axis]), x1 = std::min(b, box.hi[axis]);
        return x1 > x0 ? dvec2(x1 - x0, 0.5 * (x1 * x1 - x0 * x0)) : dvec2(0);
    }
    const double lo = box.lo[axis], hi = box.hi[axis];
    const double kinks[4] = {lo - 1, lo, hi, hi + 1}, heights[4] = {0, 1, 1, 0};
    dvec2 sum(0);
    for (int i = 0; i < 3; ++i) {
        const double x0 = std::max(a, kinks[i]), x1 = std::min(b, kinks[i + 1]);
        if (x1 <= x0) continue;
        const double slope = (heights[i + 1] - heights[i]) / (kinks[i + 1] - kinks[i]);
        const double y0 = heights[i] + slope * (x0 - kinks[i]);
        const double length = x1 - x0, y1 = y0 + slope * length;
        const double area = 0.5 * length * (y0 + y1);
        sum += dvec2(area, x0 * area + length * length * (y0 / 6 + y1 / 3));
    }
    return sum;
}

class Converter {
  public:
    Converter(const VolumeGrid& grid, const SphereOptions& options)
        : mGrid(grid), mOptions(options) {
        const double cell = std::abs(glm::determinant(dmat3(grid.worldFromIndex)));
        mCellVolume = cell;
        mRadius = options.radiusFactor * kBlockCells * std::cbrt(cell);
    }

    std::vector<scene::MediumSphere> run() {
        for (const Brick& brick : mGrid.bricks) addBrick(brick);
        for (const ValueBox& box : mGrid.boxes) addBox(box);
        return std::move(mSpheres);
    }

  private:
    void addBrick(const Brick& brick) {
        for (int k = 0; k < kBrickCells; k += kBlockCells)
            for (int j = 0; j < kBrickCells; j += kBlockCells)
                for (int i = 0; i < kBrickCells; i += kBlockCells) {
                    Lump lump = lumpOf(mGrid.values.data() + brick.valueOffset, {i, j, k});
                    lump.moment += lump.mass * dvec3(brick.origin + ivec3(i, j, k));
                    add(lump);
                }
    }

    void addBox(const ValueBox& box) {
        const double margin = box.soft ? 1 : 0;
        const dvec3 lo = glm::floor((box.lo - margin) / 2.0) * 2.0;
        const dvec3 blocks = glm::ceil((box.hi + margin - lo) / 2.0);
        const double count = blocks.x * blocks.y * blocks.z;
        if (count > static_cast<double>(mOptions.maxSpheres)) refuse(count);
        for (double z = lo.z; z < box.hi.z + margin; z += kBlockCells)
            for (double y = lo.y; y < box.hi.y + margin; y += kBlockCells)
                for (double x = lo.x; x < box.hi.x + margin; x += kBlockCells) {
                    const dvec2 a = integrateAxis(box, 0, x, x + kBlockCells);
                    const dvec2 b = integrateAxis(box, 1, y, y + kBlockCells);
                    const dvec2 c = integrateAxis(box, 2, z, z + kBlockCells);
                    add({box.value * a.x * b.x * c.x,
                         static_cast<double>(box.value) *
                             dvec3(a.y * b.x * c.x, a.x * b.y * c.x, a.x * b.x * c.y)});
                }
    }

    void add(const Lump& lump) {
        if (!(lump.mass > 0)) return;
        if (mSpheres.size() >= mOptions.maxSpheres)
            refuse(static_cast<double>(mOptions.maxSpheres) + 1);
        scene::MediumSphere sphere;
        sphere.center = transformPoint(mGrid.worldFromIndex, lump.moment / lump.mass);
        sphere.radius = static_cast<float>(mRadius);
        sphere.density = static_cast<float>(lump.mass * mCellVolume /
                                            (kSmoothBall * mRadius * mRadius * mRadius));
        sphere.medium = mOptions.medium;
        sphere.id = mOptions.firstId + static_cast<std::uint32_t>(mSpheres.size());
        sphere.profile = scene::Profile::Smooth;
        sphere.shadowing = scene::Shadowing::Particle;
        mSpheres.push_back(sphere);
    }

    [[noreturn]] void refuse(double count) const {
        throw inputError("converting volume to particles", mGrid.name,
                         fmt::format("{:.0f} or more spheres are needed, at most {} are made; use "
                                     "representation bricks or boxes",
                                     count, mOptions.maxSpheres));
    }

    const VolumeGrid& mGrid;
    const SphereOptions& mOptions;
    double mCellVolume = 1;
    double mRadius = 1;
    std::vector<scene::MediumSphere> mSpheres;
};

}  // namespace

std::vector<scene::MediumSphere> convertToSpheres(const VolumeGrid& grid,
                                                  const SphereOptions& options) {
    return Converter(grid, options).run();
}

}  // namespace brume::volumes
