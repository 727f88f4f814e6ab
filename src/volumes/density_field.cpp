// SPDX-License-Identifier: Apache-2.0
#include <volumes/density_field.hpp>

#include <algorithm>

namespace brume::volumes {
namespace {

constexpr std::uint32_t kLeafItems = 4;
/// The tree halves its items at each level: so many pending nodes are enough for 2^32 of them.
constexpr std::size_t kStackSize = 64;

std::array<double, 8> cornersOf(const VolumeGrid& grid, const Brick& brick, const ivec3& cell) {
    const float* v = grid.values.data() + brick.valueOffset +
                     (static_cast<std::size_t>(cell.z) * kBrickValues + cell.y) * kBrickValues +
                     cell.x;
    constexpr int kRow = kBrickValues, kSlice = kBrickValues * kBrickValues;
    return {v[0],      v[1],          v[kRow],          v[kRow + 1],
            v[kSlice], v[kSlice + 1], v[kSlice + kRow], v[kSlice + kRow + 1]};
}

bool allZero(const std::array<double, 8>& corners) {
    return std::all_of(corners.begin(), corners.end(), [](double v) { return v == 0; });
}

/// Coefficients of the trilinear interpolant of `v` along p + u * d, p and d relative to the cell.
std::array<double, 4> cubicAlong(const std::array<double, 8>& v, const dvec3& p, const dvec3& d) {
    double line[4][2];  // after x: linear in u
    for (int i = 0; i < 4; ++i) {
        const double slope = v[2 * i + 1] - v[2 * i];
        line[i][0] = v[2 * i] + slope * p.x;
        line[i][1] = slope * d.x;
    }
    double quad[2][3];  // after y: quadratic
    for (int i = 0; i < 2; ++i) {
        const double* a = line[2 * i];
        const double s0 = line[2 * i + 1][0] - a[0], s1 = line[2 * i + 1][1] - a[1];
        quad[i][0] = a[0] + s0 * p.y;
        quad[i][1] = a[1] + s1 * p.y + s0 * d.y;
        quad[i][2] = s1 * d.y;
    }
    const double s0 = quad[1][0] - quad[0][0], s1 = quad[1][1] - quad[0][1],
                 s2 = quad[1][2] - quad[0][2];
    return {quad[0][0] + s0 * p.z, quad[0][1] + s1 * p.z + s0 * d.z,
            quad[0][2] + s2 * p.z + s1 * d.z, s2 * d.z};
}

/// One of the 8 x 8 x 8 cells; on a border the one that the ray is about to enter.
int startCell(double local, double direction) {
    double cell = std::floor(local);
    if (direction < 0 && cell == local) cell -= 1;
    return static_cast<int>(std::clamp(cell, 0.0, kBrickCells - 1.0));
}

/// Value and slope of a soft box's ramp along one axis.
struct Ramp {
    double offset, slope;
};

Ramp rampAt(double x, double lo, double hi) {
    if (x < lo) return {1 - lo, 1};
    if (x > hi) return {1 + hi, -1};
    return {1, 0};
}

/// Distances at which a ray passes the kinks of a soft box inside (t0, t1), with both ends, sorted.
int collectKinks(const ValueBox& box, const IndexRay& ray, double t0, double t1,
                 std::array<double, 14>& kinks) {
    int count = 0;
    kinks[count++] = t0;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0) continue;
        for (const double plane : {box.lo[axis], box.hi[axis]}) {
            const double t = (plane - ray.origin[axis]) / ray.direction[axis];
            if (t > t0 && t < t1) kinks[count++] = t;
        }
    }
    kinks[count++] = t1;
    std::sort(kinks.begin(), kinks.begin() + count);
    return count;
}

/// The product of three ramps along the ray over [t0, t1].
DensitySegment softSegment(const ValueBox& box, const IndexRay& ray, double t0, double t1) {
    DensitySegment segment{t0, t1, {box.value, 0, 0, 0}};
    for (int axis = 0; axis < 3; ++axis) {
        const double middle = ray.origin[axis] + 0.5 * (t0 + t1) * ray.direction[axis];
        const Ramp ramp = rampAt(middle, box.lo[axis], box.hi[axis]);
        const double a = ramp.offset + ramp.slope * (ray.origin[axis] + t0 * ray.direction[axis]);
        const double b = ramp.slope * ray.direction[axis] * (t1 - t0);
        for (int k = 3; k > 0; --k) segment.c[k] = segment.c[k] * a + segment.c[k - 1] * b;
        segment.c[0] *= a;
    }
    return segment;
}

}  // namespace

bool clipToBox(const IndexRay& ray, const dvec3& lo, const dvec3& hi, double& t0, double& t1) {
    for (int axis = 0; axis < 3; ++axis) {
        const double o = ray.origin[axis], d = ray.direction[axis];
        if (d == 0) {  // also -0: never divide, 0 * inf is not a number
            if (o < lo[axis] || o >= hi[axis]) return false;
            continue;
        }
        const double a = (lo[axis] - o) / d, b = (hi[axis] - o) / d;
        t0 = std::max(t0, std::min(a, b));
        t1 = std::min(t1, std::max(a, b));
    }
    return t0 < t1;
}

void visitBrick(const VolumeGrid& grid, const Brick& brick, const IndexRay& ray, double t0,
                double t1, const SegmentVisitor& visit) {
    const dvec3 origin = ray.origin - dvec3(brick.origin);
    const IndexRay local{origin, ray.direction};
    if (!clipToBox(local, dvec3(0), dvec3(kBrickCells), t0, t1)) return;
    ivec3 cell;
    for (int axis = 0; axis < 3; ++axis)
        cell[axis] = startCell(origin[axis] + t0 * ray.direction[axis], ray.direction[axis]);
    double t = t0;
    while (t < t1) {
        int axis = -1;
        double next = t1;
        for (int i = 0; i < 3; ++i) {
            if (ray.direction[i] == 0) continue;
            const double plane = ray.direction[i] > 0 ? cell[i] + 1 : cell[i];
            const double crossing = (plane - origin[i]) / ray.direction[i];
            if (crossing < next) next = crossing, axis = i;
        }
        if (next > t) {
            const auto corners = cornersOf(grid, brick, cell);
            const dvec3 entry = origin + t * ray.direction - dvec3(cell);
            if (!allZero(corners))
                visit({t, next, cubicAlong(corners, entry, (next - t) * ray.direction)});
            t = next;
        }
        if (axis < 0) return;
        cell[axis] += ray.direction[axis] > 0 ? 1 : -1;
        if (cell[axis] < 0 || cell[axis] >= kBrickCells) return;
    }
}

void visitBox(const ValueBox& box, const IndexRay& ray, double t0, double t1,
              const SegmentVisitor& visit) {
    const double margin = box.soft ? 1 : 0;
    if (!clipToBox(ray, box.lo - margin, box.hi + margin, t0, t1)) return;
    if (!box.soft) {
        visit({t0, t1, {box.value, 0, 0, 0}});
        return;
    }
    std::array<double, 14> kinks{};
    const int count = collectKinks(box, ray, t0, t1, kinks);
    for (int i = 1; i < count; ++i)
        if (kinks[i] > kinks[i - 1]) visit(softSegment(box, ray, kinks[i - 1], kinks[i]));
}

double sampleBrick(const VolumeGrid& grid, const Brick& brick, const dvec3& position) {
    const dvec3 local = position - dvec3(brick.origin);
    const ivec3 cell{startCell(local.x, 1), startCell(local.y, 1), startCell(local.z, 1)};
    return cubicAlong(cornersOf(grid, brick, cell), local - dvec3(cell), dvec3(0))[0];
}

double sampleBox(const ValueBox& box, const dvec3& position) {
    const double margin = box.soft ? 1 : 0;
    double value = box.value;
    for (int axis = 0; axis < 3; ++axis) {
        const double x = position[axis];
        if (!(x >= box.lo[axis] - margin && x < box.hi[axis] + margin)) return 0;
        if (!box.soft) continue;
        const Ramp ramp = rampAt(x, box.lo[axis], box.hi[axis]);
        value *= ramp.offset + ramp.slope * x;
    }
    return value;
}

DensityField::DensityField(const VolumeGrid& grid) : mGrid(&grid), mIndex(grid) {
    mItems.resize(grid.bricks.size() + grid.boxes.size());
    for (std::uint32_t i = 0; i < mItems.size(); ++i) mItems[i] = i;
    if (!mItems.empty()) build(0, static_cast<std::uint32_t>(mItems.size()));
}

void DensityField::boundsOf(std::uint32_t item, dvec3& lo, dvec3& hi) const {
    if (item < mGrid->bricks.size()) {
        lo = dvec3(mGrid->bricks[item].origin);
        hi = lo + static_cast<double>(kBrickCells);
        return;
    }
    const ValueBox& box = mGrid->boxes[item - mGrid->bricks.size()];
    const double margin = box.soft ? 1 : 0;
    lo = box.lo - margin;
    hi = box.hi + margin;
}

void DensityField::build(std::uint32_t begin, std::uint32_t end) {
    const auto number = static_cast<std::uint32_t>(mNodes.size());
    Node node{dvec3(kInfinity), dvec3(-kInfinity), begin, end - begin};
    for (std::uint32_t i = begin; i < end; ++i) {
        dvec3 lo, hi;
        boundsOf(mItems[i], lo, hi);
        node.lo = glm::min(node.lo, lo);
        node.hi = glm::max(node.hi, hi);
    }
    mNodes.push_back(node);
    if (end - begin <= kLeafItems) return;
    const dvec3 size = node.hi - node.lo;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto center = [&](std::uint32_t item) {
        dvec3 lo, hi;
        boundsOf(item, lo, hi);
        return lo[axis] + hi[axis];
    };
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(mItems.begin() + begin, mItems.begin() + middle, mItems.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return center(a) < center(b); });
    build(begin, middle);
    mNodes[number].count = 0;
    mNodes[number].first = static_cast<std::uint32_t>(mNodes.size());
    build(middle, end);
}

void DensityField::visitItems(
    const IndexRay& ray, double t0, double t1,
    const std::function<void(std::uint32_t, double, double)>& visit) const {
    if (mNodes.empty()) return;
    std::array<std::uint32_t, kStackSize> stack;
    std::size_t pending = 0;
    stack[pending++] = 0;
    while (pending > 0) {
        const std::uint32_t number = stack[--pending];
        const Node& node = mNodes[number];
        double a = t0, b = t1;
        if (!clipToBox(ray, node.lo, node.hi, a, b)) continue;
        if (node.count == 0) {
            stack[pending++] = node.first;
            stack[pending++] = number + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            dvec3 lo, hi;
            boundsOf(mItems[i], lo, hi);
            double enter = t0, leave = t1;
            if (clipToBox(ray, lo, hi, enter, leave)) visit(mItems[i], enter, leave);
        }
    }
}

void DensityField::visitRay(const IndexRay& ray, double t0, double t1,
                            const SegmentVisitor& visit) const {
    visitItems(ray, t0, t1, [&](std::uint32_t item, double a, double b) {
        if (item < mGrid->bricks.size())
            visitBrick(*mGrid, mGrid->bricks[item], ray, a, b, visit);
        else
            visitBox(mGrid->boxes[item - mGrid->bricks.size()], ray, a, b, visit);
    });
}

double DensityField::opticalDepth(const IndexRay& ray, double t0, double t1) const {
    double sum = 0;
    visitRay(ray, t0, t1, [&](const DensitySegment& segment) { sum += segment.opticalDepth(); });
    return sum;
}

double DensityField::sample(const dvec3& p) const {
    double sum = mGrid->boxes.empty() ? 0 : sampleBoxes(p);
    const dvec3 cell = glm::floor(p);
    constexpr double kLimit = 2147483647.0;
    if (mGrid->bricks.empty() || !glm::all(glm::lessThan(glm::abs(cell), dvec3(kLimit))))
        return sum;
    const std::uint32_t brick = mIndex.findCell(ivec3(cell));
    if (brick != BrickIndex::kNone) sum += sampleBrick(*mGrid, mGrid->bricks[brick], p);
    return sum;
}

double DensityField::sampleBoxes(const dvec3& p) const {
    double sum = 0;
    std::array<std::uint32_t, kStackSize> stack;
    std::size_t pending = 0;
    stack[pending++] = 0;
    while (pending > 0) {
        const std::uint32_t number = stack[--pending];
        const Node& node = mNodes[number];
        if (!glm::all(glm::lessThanEqual(node.lo, p)) || !glm::all(glm::lessThanEqual(p, node.hi)))
            continue;
        if (node.count == 0) {
            stack[pending++] = node.first;
            stack[pending++] = number + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            if (mItems[i] >= mGrid->bricks.size())
                sum += sampleBox(mGrid->boxes[mItems[i] - mGrid->bricks.size()], p);
    }
    return sum;
}

double sampleDensity(const VolumeGrid& grid, const dvec3& indexPosition) {
    return DensityField(grid).sample(indexPosition);
}

}  // namespace brume::volumes
