// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/mesh_shapes.hpp>

namespace brume::scene {
namespace {

/// Largest deviation of a triangle's normal from its vertices' normals.
double worstNormalAngle(const Mesh& mesh) {
    double worst = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        const dvec3 n = glm::normalize(glm::cross(b - a, c - a));
        for (std::size_t k = 0; k < 3; ++k)
            worst = std::max(
                worst,
                std::acos(std::min(1.0, glm::dot(n, dvec3(mesh.normals[mesh.indices[i + k]])))));
    }
    return worst;
}

TEST(Shape_Box, AnySize_IsClosedWithItsVolume) {
    const Mesh mesh = makeBox({2, 3, 0.5});
    EXPECT_EQ(mesh.indices.size(), 36u);
    EXPECT_EQ(countOpenEdges(mesh), 0u);
    EXPECT_NEAR(computeSignedVolume(mesh), 3.0, 1e-6);
    EXPECT_LT(worstNormalAngle(mesh), 1e-6);
}

TEST(Shape_Sphere, AnySegmentCount_IsClosedWithSmoothNormals) {
    for (int segments : {4, 6, 10, 64, 256}) {
        const Mesh mesh = makeSphere(1.5, segments);
        EXPECT_EQ(countOpenEdges(mesh), 0u) << segments;
        EXPECT_EQ(mesh.positions.size(), mesh.normals.size());
        EXPECT_EQ(mesh.positions.size(), mesh.uvs.size());
        const double full = 4.0 / 3.0 * kPi * 1.5 * 1.5 * 1.5;
        const double volume = computeSignedVolume(mesh);
        EXPECT_GT(volume, 0.2 * full) << segments;
        EXPECT_LT(volume, full);
        if (segments == 256) {
            EXPECT_NEAR(volume, full, 1e-3 * full);
        }
        for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
            EXPECT_NEAR(glm::length(mesh.positions[v]), 1.5, 1e-6);
            EXPECT_NEAR(glm::dot(mesh.positions[v], mesh.normals[v]), 1.5, 1e-6);
        }
        EXPECT_LT(worstNormalAngle(mesh), 7.0 / segments);
    }
}

TEST(Shape_Plane, SeenFromAbove_IsCounterClockwise) {
    const Mesh mesh = makePlane({4, 2});
    EXPECT_EQ(mesh.indices.size(), 6u);
    EXPECT_LT(worstNormalAngle(mesh), 1e-6);
    for (std::size_t v = 0; v < 4; ++v) {
        EXPECT_EQ(mesh.normals[v], vec3(0, 1, 0));
        EXPECT_EQ(std::abs(mesh.positions[v].x), 2.0f);
        EXPECT_EQ(std::abs(mesh.positions[v].z), 1.0f);
    }
    EXPECT_EQ(countOpenEdges(mesh), 4u);
}

TEST(Shape_Mirrored, WorldVolume_StaysPositive) {
    for (const dvec3 scale : {dvec3(1, 1, 1), dvec3(-1, 2, 3), dvec3(-1, -1, 1), dvec3(-2)}) {
        Mesh mesh = makeSphere(1, 16);
        placeMesh(mesh, glm::scale(glm::translate(dmat4(1), dvec3(5, 0, 0)), scale));
        Mesh world = mesh;
        for (vec3& p : world.positions) p = vec3(transformPoint(mesh.worldFromObject, dvec3(p)));
        EXPECT_GT(computeSignedVolume(world), 0.5);
        EXPECT_EQ(countOpenEdges(world), 0u);
    }
}

TEST(Mesh_OpenEdges, MissingAndFlippedTriangles_AreCounted) {
    Mesh mesh = makeBox(dvec3(1));
    std::swap(mesh.indices[0], mesh.indices[1]);
    EXPECT_EQ(countOpenEdges(mesh), 6u);
    mesh.indices.erase(mesh.indices.begin(), mesh.indices.begin() + 3);
    EXPECT_EQ(countOpenEdges(mesh), 3u);
}

}  // namespace
}  // namespace brume::scene
