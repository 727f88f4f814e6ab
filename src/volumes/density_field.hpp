// SPDX-License-Identifier: Apache-2.0
// Exact queries of a volume on the CPU: density at a point, and along a ray as cubic pieces.
#pragma once

#include <volumes/brick_index.hpp>
#include <volumes/volume_grid.hpp>

#include <array>
#include <functional>
#include <vector>

namespace brume::volumes {

/// A ray in index space: origin + t * direction. Transform a world ray with inverse(worldFromIndex)
/// and do not normalise, then t stays the world distance.
struct IndexRay {
    dvec3 origin{0};
    dvec3 direction{0};
};

/// Density along a piece of a ray: c[0] + c[1] u + c[2] u^2 + c[3] u^3 with u = (t - t0) / (t1 -
/// t0). Exact: a trilinear interpolant along a straight line inside one cell is a cubic.
struct DensitySegment {
    double t0 = 0, t1 = 0;
    std::array<double, 4> c{0, 0, 0, 0};

    double density(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
    /// Integral of the density over t from t0 to the point u.
    double opticalDepth(double u = 1) const {
        return (t1 - t0) * u * (c[0] + u * (c[1] / 2 + u * (c[2] / 3 + u * c[3] / 4)));
    }
};

using SegmentVisitor = std::function<void(const DensitySegment&)>;

/// The pieces of `ray` in [t0, t1] inside one brick, cell by cell from near to far; cells of zeros
/// are left out.
void visitBrick(const VolumeGrid& grid, const Brick& brick, const IndexRay& ray, double t0,
                double t1, const SegmentVisitor& visit);

/// The pieces inside one box (soft: up to seven), from near to far.
void visitBox(const ValueBox& box, const IndexRay& ray, double t0, double t1,
              const SegmentVisitor& visit);

/// Density of one brick at an index position inside it.
double sampleBrick(const VolumeGrid& grid, const Brick& brick, const dvec3& position);

/// Density of one box; 0 outside.
double sampleBox(const ValueBox& box, const dvec3& position);

/// Search structure over the bricks and boxes of one grid, which must outlive it.
class DensityField {
  public:
    explicit DensityField(const VolumeGrid& grid);

    const VolumeGrid& grid() const { return *mGrid; }

    /// Density at an index position.
    double sample(const dvec3& indexPosition) const;

    /// Calls `visit` for every piece of the ray in [t0, t1] with density. Pieces of one brick or
    /// box come from near to far; those of different ones in no stated order, and pieces of boxes
    /// may overlap others: densities add up.
    void visitRay(const IndexRay& ray, double t0, double t1, const SegmentVisitor& visit) const;

    /// Integral of the density over t in [t0, t1], to rounding.
    double opticalDepth(const IndexRay& ray, double t0, double t1) const;

    /// Calls `visit(item, t0, t1)` for every brick (item < bricks.size()) and box (item -
    /// bricks.size()) whose bounds the ray meets, with the interval inside them, in no stated
    /// order.
    void visitItems(const IndexRay& ray, double t0, double t1,
                    const std::function<void(std::uint32_t, double, double)>& visit) const;

  private:
    struct Node {
        dvec3 lo{0}, hi{0};
        std::uint32_t first =
            0;  ///< leaf: into mItems; inner node: its right child (the left one follows it)
        std::uint32_t count = 0;  ///< 0 for an inner node
    };

    double sampleBoxes(const dvec3& p) const;
    void build(std::uint32_t begin, std::uint32_t end);
    void boundsOf(std::uint32_t item, dvec3& lo, dvec3& hi) const;

    const VolumeGrid* mGrid;
    BrickIndex mIndex;
    std::vector<std::uint32_t> mItems;  ///< bricks, then boxes
    std::vector<Node> mNodes;
};

/// Density at an index position: convenience for single queries; use a DensityField for many.
double sampleDensity(const VolumeGrid& grid, const dvec3& indexPosition);

/// Narrows [t0, t1] to the part of the ray inside the box; false if nothing is left. A ray along a
/// face belongs to the box of which that is the lower face, so neighbours never both count it.
bool clipToBox(const IndexRay& ray, const dvec3& lo, const dvec3& hi, double& t0, double& t1);

}  // namespace brume::volumes
