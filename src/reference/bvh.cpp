// SPDX-License-Identifier: Apache-2.0
#include <reference/bvh.hpp>

#include <algorithm>
#include <numeric>

namespace brume::reference {
namespace {

constexpr int kBinCount = 16;
constexpr std::uint32_t kLeafSize = 4;
constexpr int kMedianDepth = 60;  // below it splits at the median bound the depth

double halfArea(const Box3& box) {
    if (box.isEmpty()) return 0;
    const dvec3 s = box.size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

Box3 pad(Box3 box) {
    const dvec3 margin =
        4e-15 * glm::max(glm::abs(box.lo), glm::abs(box.hi)) + dvec3(1e-15) * box.size();
    box.lo -= margin, box.hi += margin;
    return box;
}

}  // namespace

struct Bvh::Builder {
    std::span<const Box3> boxes;
    std::vector<dvec3> centers;
    std::vector<Node>& nodes;
    std::vector<std::uint32_t>& order;

    struct Split {
        int axis = 0;
        std::uint32_t middle = 0;
    };

    void build(std::uint32_t nodeIndex, std::uint32_t first, std::uint32_t last, int depth) {
        Box3 box, centerBox;
        for (std::uint32_t i = first; i < last; ++i) {
            box.extend(boxes[order[i]]);
            centerBox.extend(centers[order[i]]);
        }
        nodes[nodeIndex].box = pad(box);
        if (last - first <= kLeafSize) {
            nodes[nodeIndex].first = first, nodes[nodeIndex].count = last - first;
            return;
        }
        const Split split = chooseSplit(first, last, centerBox, depth);
        const auto child = static_cast<std::uint32_t>(nodes.size());
        nodes.resize(nodes.size() + 2);
        nodes[nodeIndex].first = child, nodes[nodeIndex].axis = split.axis;
        build(child, first, split.middle, depth + 1);
        build(child + 1, split.middle, last, depth + 1);
    }

    Split chooseSplit(std::uint32_t first, std::uint32_t last, const Box3& centerBox, int depth) {
        const dvec3 size = centerBox.size();
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (size[i] > size[axis]) axis = i;
        if (depth < kMedianDepth && size[axis] > 0) {
            const std::uint32_t middle = splitByArea(first, last, centerBox, axis);
            if (middle > first && middle < last) return {axis, middle};
        }
        const std::uint32_t middle = first + (last - first) / 2;
        std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                         [&](std::uint32_t a, std::uint32_t b) {
                             return std::pair(centers[a][axis], a) < std::pair(centers[b][axis], b);
                         });
        return {axis, middle};
    }

    std::uint32_t splitByArea(std::uint32_t first, std::uint32_t last, const Box3& centerBox,
                              int axis) {
        const double lo = centerBox.lo[axis], scale = kBinCount / (centerBox.hi[axis] - lo);
        const auto bin = [&](std::uint32_t i) {
            return std::clamp(static_cast<int>((centers[i][axis] - lo) * scale), 0, kBinCount - 1);
        };
        Box3 binBox[kBinCount];
        int binCount[kBinCount] = {};
        for (std::uint32_t i = first; i < last; ++i) {
            const int b = bin(order[i]);
            binBox[b].extend(boxes[order[i]]), ++binCount[b];
        }
        double cost[kBinCount] = {};  // of splitting before the bin
        Box3 left, right;
        for (int b = 1, n = 0; b < kBinCount; ++b) {
            left.extend(binBox[b - 1]), n += binCount[b - 1];
            cost[b] += n * halfArea(left);
        }
        for (int b = kBinCount - 1, n = 0; b > 0; --b) {
            right.extend(binBox[b]), n += binCount[b];
            cost[b] += n * halfArea(right);
        }
        const auto best = static_cast<int>(std::min_element(cost + 1, cost + kBinCount) - cost);
        const auto middle = std::partition(order.begin() + first, order.begin() + last,
                                           [&](std::uint32_t i) { return bin(i) < best; });
        return static_cast<std::uint32_t>(middle - order.begin());
    }
};

Bvh::Bvh(std::span<const Box3> boxes) : mOrder(boxes.size()) {
    if (boxes.empty()) return;
    std::iota(mOrder.begin(), mOrder.end(), 0u);
    mNodes.reserve(boxes.size());
    mNodes.resize(1);
    Builder builder{boxes, {}, mNodes, mOrder};
    builder.centers.reserve(boxes.size());
    for (const Box3& box : boxes) builder.centers.push_back(box.center());
    builder.build(0, 0, static_cast<std::uint32_t>(boxes.size()), 0);
}

}  // namespace brume::reference
