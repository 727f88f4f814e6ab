// SPDX-License-Identifier: Apache-2.0
#include <scene/mesh_shapes.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_map>

namespace brume::scene {
namespace {

/// Appends the parallelogram corner + s sideU + t sideV, s and t in [0, 1], seen from
/// sideU x sideV; v of the texture grows against sideV.
void appendQuad(Mesh& mesh, const dvec3& corner, const dvec3& sideU, const dvec3& sideV) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const vec3 normal(glm::normalize(glm::cross(sideU, sideV)));
    for (int i = 0; i < 4; ++i) {
        const double s = i == 1 || i == 2 ? 1 : 0;
        const double t = i >= 2 ? 1 : 0;
        mesh.positions.emplace_back(corner + s * sideU + t * sideV);
        mesh.normals.push_back(normal);
        mesh.uvs.emplace_back(s, 1 - t);
    }
    for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

/// A position as a key under which -0 equals 0.
struct PositionKey {
    std::array<std::uint32_t, 3> bits{};
    bool operator==(const PositionKey&) const = default;
};

PositionKey keyOf(const vec3& p) {
    PositionKey key;
    for (int axis = 0; axis < 3; ++axis) {
        const float value = p[axis] + 0.0f;
        std::memcpy(&key.bits[static_cast<std::size_t>(axis)], &value, sizeof value);
    }
    return key;
}

struct PositionHash {
    std::size_t operator()(const PositionKey& key) const {
        std::uint64_t h = 0xcbf29ce484222325u;
        for (std::uint32_t word : key.bits) h = (h ^ word) * 0x100000001b3u;
        return static_cast<std::size_t>(h ^ (h >> 29));
    }
};

}  // namespace

Mesh makePlane(const dvec2& size) {
    Mesh mesh;
    appendQuad(mesh, {-0.5 * size.x, 0, 0.5 * size.y}, {size.x, 0, 0}, {0, 0, -size.y});
    return mesh;
}

Mesh makeBox(const dvec3& size) {
    Mesh mesh;
    const dvec3 h = 0.5 * size;
    const dvec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    appendQuad(mesh, {-h.x, -h.y, h.z}, x, y);
    appendQuad(mesh, {h.x, -h.y, -h.z}, -x, y);
    appendQuad(mesh, {h.x, -h.y, h.z}, -z, y);
    appendQuad(mesh, {-h.x, -h.y, -h.z}, z, y);
    appendQuad(mesh, {-h.x, h.y, h.z}, x, -z);
    appendQuad(mesh, {-h.x, -h.y, -h.z}, x, z);
    return mesh;
}

Mesh makeSphere(double radius, int segments) {
    Mesh mesh;
    const int rows = segments / 2;
    const auto columnCount = static_cast<std::uint32_t>(segments) + 1;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= segments; ++column) {
            const double theta = kPi * row / rows;
            // The seam's two columns must be the same points to the last bit, and so must a pole's.
            const double phi = 2 * kPi * (column % segments) / segments;
            const double ring = row == 0 || row == rows ? 0 : std::sin(theta);
            const dvec3 n(ring * std::sin(phi), std::cos(theta), ring * std::cos(phi));
            mesh.positions.emplace_back(radius * n);
            mesh.normals.emplace_back(n);
            mesh.uvs.emplace_back(static_cast<double>(column) / segments,
                                  static_cast<double>(row) / rows);
        }
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < segments; ++column) {
            const std::uint32_t a =
                static_cast<std::uint32_t>(row) * columnCount + static_cast<std::uint32_t>(column);
            const std::uint32_t b = a + columnCount;
            // At the poles one of the two triangles would have no area.
            if (row + 1 < rows) mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
            if (row > 0) mesh.indices.insert(mesh.indices.end(), {a, b + 1, a + 1});
        }
    return mesh;
}

void flipWinding(Mesh& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

void placeMesh(Mesh& mesh, const dmat4& worldFromObject) {
    mesh.worldFromObject = worldFromObject;
    if (glm::determinant(dmat3(worldFromObject)) < 0) flipWinding(mesh);
}

double computeSignedVolume(const Mesh& mesh) {
    double volume = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const dvec3 a(mesh.positions[mesh.indices[i]]);
        const dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return volume;
}

std::size_t countOpenEdges(const Mesh& mesh) {
    std::unordered_map<PositionKey, std::uint32_t, PositionHash> pointOfPosition;
    std::vector<std::uint32_t> points;
    points.reserve(mesh.positions.size());
    for (const vec3& p : mesh.positions)
        points.push_back(
            pointOfPosition
                .try_emplace(keyOf(p), static_cast<std::uint32_t>(pointOfPosition.size()))
                .first->second);

    // Each directed edge as (lower point, higher point, direction); partners become neighbours.
    std::vector<std::array<std::uint32_t, 3>> edges;
    edges.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = points[mesh.indices[i + k]];
            const std::uint32_t b = points[mesh.indices[i + (k + 1) % 3]];
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 0u : 1u});
        }
    std::sort(edges.begin(), edges.end());
    std::size_t openCount = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::array<std::size_t, 2> count{};
        const std::size_t begin = i;
        while (i < edges.size() && edges[i][0] == edges[begin][0] && edges[i][1] == edges[begin][1])
            ++count[edges[i++][2]];
        if (count[0] != 1 || count[1] != 1) openCount += count[0] + count[1];
    }
    return openCount;
}

}  // namespace brume::scene
