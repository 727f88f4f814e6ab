// SPDX-License-Identifier: Apache-2.0
// Bounding volume hierarchy in double precision over boxes of anything.
#pragma once

#include <core/math.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace brume::reference {

/// A ray prepared for slab tests. The direction need not have unit length.
struct SlabRay {
    dvec3 origin;
    dvec3 inverseDirection;

    SlabRay(const dvec3& o, const dvec3& d) : origin(o), inverseDirection(1.0 / d) {}
};

/// Binary tree split by the binned surface area heuristic (Wald 2007). Boxes are padded by a few
/// ulps, so that rounding in the slab test loses nothing.
class Bvh {
  public:
    Bvh() = default;
    explicit Bvh(std::span<const Box3> boxes);

    bool isEmpty() const { return mNodes.empty(); }
    /// Bounds of everything; empty if isEmpty().
    Box3 bounds() const { return isEmpty() ? Box3{} : mNodes[0].box; }

    /// Calls visit(index) for each box (and some more) that the ray meets in [tMin, tMax]. tMax is
    /// read again at every node: a visitor that lowers it prunes.
    template <class Visit>
    void visit(const SlabRay& ray, double tMin, const double& tMax, Visit&& visit) const {
        if (isEmpty() || !meets(mNodes[0].box, ray, tMin, tMax)) return;
        std::array<std::uint32_t, kMaxDepth + 2> stack;
        int top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = mNodes[stack[--top]];
            if (node.count > 0) {
                for (std::uint32_t i = 0; i < node.count; ++i) visit(mOrder[node.first + i]);
                continue;
            }
            // The child that the ray enters first is visited first.
            std::uint32_t near = node.first, far = node.first + 1;
            if (ray.inverseDirection[node.axis] < 0) std::swap(near, far);
            if (meets(mNodes[far].box, ray, tMin, tMax)) stack[top++] = far;
            if (meets(mNodes[near].box, ray, tMin, tMax)) stack[top++] = near;
        }
    }

  private:
    static constexpr int kMaxDepth = 96;

    struct Node {
        Box3 box;
        std::uint32_t first = 0;  ///< leaf: into mOrder; else left child, the right one follows it
        std::uint32_t count = 0;  ///< of a leaf; 0: inner node
        int axis = 0;
    };
    struct Builder;

    static bool meets(const Box3& box, const SlabRay& ray, double tMin, double tMax) {
        for (int axis = 0; axis < 3; ++axis) {
            const double inverse = ray.inverseDirection[axis];
            double t0 = (box.lo[axis] - ray.origin[axis]) * inverse;
            double t1 = (box.hi[axis] - ray.origin[axis]) * inverse;
            if (t0 > t1) std::swap(t0, t1);
            // Written so that NaN (0 * infinity) changes nothing.
            if (t0 > tMin) tMin = t0;
            if (t1 < tMax) tMax = t1;
        }
        return tMin <= tMax;
    }

    std::vector<Node> mNodes;
    std::vector<std::uint32_t> mOrder;
};

}  // namespace brume::reference
