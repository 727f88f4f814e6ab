// SPDX-License-Identifier: Apache-2.0
#include <volumes/box_decomposition.hpp>
#include <volumes/brick_index.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

namespace brume::volumes {
namespace {

constexpr int kBrickLevel = 3;  ///< 2^3 cells per edge
constexpr int kTopLevel = 31;

/// Of the density over an octree node.
struct Stats {
    double lo = 0, hi = 0;          ///< least and greatest density
    double loMean = 0, hiMean = 0;  ///< least and greatest mean of a cell
    double mean = 0;
};

struct CoordLess {
    bool operator()(const ivec3& a, const ivec3& b) const {
        return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x);
    }
};

/// One level above the bricks: nodes by coordinate (cell index >> level).
using Level = std::map<ivec3, Stats, CoordLess>;

Stats combine(const Stats* children) {
    Stats sum = children[0];
    sum.mean = 0;
    for (int i = 0; i < 8; ++i) {
        sum.lo = std::min(sum.lo, children[i].lo);
        sum.hi = std::max(sum.hi, children[i].hi);
        sum.loMean = std::min(sum.loMean, children[i].loMean);
        sum.hiMean = std::max(sum.hiMean, children[i].hiMean);
        sum.mean += children[i].mean / 8;
    }
    return sum;
}

/// Children of a node lie together: child number is (z & 1) * 4 + (y & 1) * 2 + (x & 1).
std::size_t mortonOf(const ivec3& c) {
    std::size_t code = 0;
    for (int bit = 0; bit < kBrickLevel; ++bit)
        for (int axis = 0; axis < 3; ++axis)
            code |= static_cast<std::size_t>((c[axis] >> bit) & 1) << (3 * bit + axis);
    return code;
}

/// Statistics of one brick at all of its levels.
class BrickPyramid {
  public:
    BrickPyramid(const VolumeGrid& grid, const Brick& brick) {
        const float* values = grid.values.data() + brick.valueOffset;
        for (int k = 0; k < kBrickCells; ++k)
            for (int j = 0; j < kBrickCells; ++j)
                for (int i = 0; i < kBrickCells; ++i)
                    mStats[0][mortonOf({i, j, k})] = cellStats(values, i, j, k);
        for (int level = 1; level <= kBrickLevel; ++level)
            for (std::size_t n = 0; n < mStats[0].size() >> (3 * level); ++n)
                mStats[level][n] = combine(&mStats[level - 1][8 * n]);
    }

    /// Node of a level at cell coordinates relative to the brick, divided by the node's edge.
    const Stats& at(int level, const ivec3& node) const { return mStats[level][mortonOf(node)]; }
    const Stats& top() const { return mStats[kBrickLevel][0]; }

  private:
    static Stats cellStats(const float* values, int i, int j, int k) {
        Stats corners[8];
        for (int c = 0; c < 8; ++c) {
            const int at =
                ((k + (c >> 2)) * kBrickValues + j + ((c >> 1) & 1)) * kBrickValues + i + (c & 1);
            const double v = values[at];
            corners[c] = {v, v, v, v, v};
        }
        Stats cell = combine(corners);
        cell.loMean = cell.hiMean = cell.mean;
        return cell;
    }

    std::array<std::array<Stats, kBrickCells * kBrickCells * kBrickCells>, kBrickLevel + 1> mStats;
};

ivec3 halve(const ivec3& c) { return {c.x >> 1, c.y >> 1, c.z >> 1}; }

/// The octree above the bricks, up to the level whose nodes all touch the origin.
std::vector<Level> buildLevels(const VolumeGrid& grid) {
    std::vector<Level> levels(1);
    for (const Brick& brick : grid.bricks) {
        const ivec3 coord{brick.origin.x >> 3, brick.origin.y >> 3, brick.origin.z >> 3};
        levels[0][coord] = BrickPyramid(grid, brick).top();
    }
    for (int level = kBrickLevel; level < kTopLevel && levels.back().size() > 1; ++level) {
        Level next;
        const Level& below = levels.back();
        for (const auto& [coord, stats] : below) {
            const ivec3 parent = halve(coord);
            if (next.count(parent)) continue;
            Stats children[8];
            for (int c = 0; c < 8; ++c) {
                const auto found = below.find(2 * parent + ivec3(c & 1, (c >> 1) & 1, c >> 2));
                if (found != below.end()) children[c] = found->second;
            }
            next[parent] = combine(children);
        }
        levels.push_back(std::move(next));
    }
    return levels;
}

struct Span {
    double lo, hi;     ///< along one axis
    double deviation;  ///< greatest of |density - mean| in the box
};

class Decomposer {
  public:
    Decomposer(VolumeGrid& grid, double extinctionMax, double tolerance)
        : mGrid(grid), mIndex(grid), mExtinction(extinctionMax), mTolerance(tolerance) {
        for (int axis = 0; axis < 3; ++axis)
            mEdge = std::max(mEdge, glm::length(dvec3(grid.worldFromIndex[axis])));
    }

    void run() {
        mLevels = buildLevels(mGrid);
        const int top = static_cast<int>(mLevels.size()) - 1;
        for (const auto& [coord, stats] : mLevels.back()) visitNode(top, coord, stats);
        mGrid.opticalDepthBound = boundOpticalDepth();
        mGrid.bricks = {};
        mGrid.values = {};
        mGrid.boxes.insert(mGrid.boxes.end(), mBoxes.begin(), mBoxes.end());
    }

  private:
    bool isFine(const Stats& stats, int level) const {
        const double edge = mEdge * std::ldexp(1.0, level);
        return (stats.hiMean - stats.loMean) * mExtinction * edge <= mTolerance;
    }

    void emit(const ivec3& node, int level, const Stats& stats) {
        if (!(stats.mean > 0)) return;
        const double edge = std::ldexp(1.0, level);
        const dvec3 lo = dvec3(node) * edge;
        mBoxes.push_back({lo, lo + edge, static_cast<float>(stats.mean), false});
        mDeviations.push_back(std::max(stats.hi - stats.mean, stats.mean - stats.lo));
    }

    /// `above`: levels above the bricks.
    void visitNode(int above, const ivec3& coord, const Stats& stats) {
        if (isFine(stats, kBrickLevel + above)) return emit(coord, kBrickLevel + above, stats);
        if (above == 0) {
            const BrickPyramid pyramid(mGrid, mGrid.bricks[mIndex.find(coord)]);
            return splitInBrick(pyramid, kBrickLevel, ivec3(0), coord * kBrickCells);
        }
        const Level& below = mLevels[above - 1];
        for (int c = 0; c < 8; ++c) {
            const auto found = below.find(2 * coord + ivec3(c & 1, (c >> 1) & 1, c >> 2));
            if (found != below.end()) visitNode(above - 1, found->first, found->second);
        }
    }

    void splitInBrick(const BrickPyramid& pyramid, int level, const ivec3& node,
                      const ivec3& origin) {
        for (int c = 0; c < 8; ++c) {
            const ivec3 child = 2 * node + ivec3(c & 1, (c >> 1) & 1, c >> 2);
            const Stats& stats = pyramid.at(level - 1, child);
            if (level == 1 || isFine(stats, level - 1))
                emit(child + origin / (1 << (level - 1)), level - 1, stats);
            else
                splitInBrick(pyramid, level - 1, child, origin);
        }
    }

    /// Integral along an axis of the greatest deviation of any box there.
    double integrateGreatest(int axis) const {
        std::vector<std::tuple<double, bool, double>> events;  // position, opens, deviation
        for (std::size_t i = 0; i < mBoxes.size(); ++i) {
            if (mDeviations[i] == 0) continue;
            events.emplace_back(mBoxes[i].lo[axis], true, mDeviations[i]);
            events.emplace_back(mBoxes[i].hi[axis], false, mDeviations[i]);
        }
        std::sort(events.begin(), events.end());
        std::multiset<double> open;
        double sum = 0, last = 0;
        for (const auto& [position, opens, deviation] : events) {
            if (!open.empty()) sum += (position - last) * *open.rbegin();
            last = position;
            if (opens)
                open.insert(deviation);
            else
                open.erase(open.find(deviation));
        }
        return sum;
    }

    /// A straight ray moves fastest in index space along one axis. While that index grows by dx,
    /// the ray is in a slab where no box deviates more than the greatest one there, and its world
    /// length is at most dx * |M v| with |v_i| <= 1 and v_axis = 1, greatest at a corner. So the
    /// sum over slabs, for the worst axis, bounds |delta tau| of every ray.
    double boundOpticalDepth() const {
        double bound = 0;
        for (int axis = 0; axis < 3; ++axis) {
            double stretch = 0;
            for (int corner = 0; corner < 4; ++corner) {
                dvec3 v(1);
                if (corner & 1) v[(axis + 1) % 3] = -1;
                if (corner & 2) v[(axis + 2) % 3] = -1;
                stretch = std::max(stretch, glm::length(transformVector(mGrid.worldFromIndex, v)));
            }
            bound = std::max(bound, stretch * integrateGreatest(axis));
        }
        return bound;
    }

    VolumeGrid& mGrid;
    BrickIndex mIndex;
    std::vector<Level> mLevels;
    double mExtinction;
    double mTolerance;
    double mEdge = 0;  ///< longest world edge of a cell
    std::vector<ValueBox> mBoxes;
    std::vector<double> mDeviations;  ///< parallel to mBoxes
};

}  // namespace

void convertToBoxes(VolumeGrid& grid, double extinctionMax, double tolerance) {
    if (grid.bricks.empty()) return;
    Decomposer(grid, extinctionMax, tolerance).run();
}

}  // namespace brume::volumes
