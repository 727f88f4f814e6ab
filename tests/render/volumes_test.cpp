// SPDX-License-Identifier: Apache-2.0
// Volumes through linked_list: bricks, tiles and boxes in every position of grid and camera.
#include <render/render_fixture.hpp>

#include <fmt/format.h>

namespace brume::test {
namespace {

/// Index to world: a cube of `cells` cells becomes the cube [-1, 1]^3.
dmat4 centred(int cells) { return glm::scale(translation(dvec3(-1)), dvec3(2.0 / cells)); }

/// Two bricks per edge of noise in a coloured medium.
TestScene makeNoise(const dmat4& placement = dmat4(1), int size = 48) {
    TestScene s(size, size);
    const std::uint32_t medium = s.addMedium(dvec3(1, 2, 4), dvec3(0.9, 0.5, 0.2), dvec3(0.2));
    fillBricks(s.addGrid(medium, placement * centred(16)), 2, noiseAt);
    s.addDaylight();
    return s;
}

class Volumes : public RenderTest {};

TEST_F(Volumes, Bricks_AreExact) {
    TestScene s = makeNoise();
    expectExact(s, "in front");
    s.scene.camera.position = dvec3(2, 1.5, -1.7);
    expectExact(s, "askew");
    s.scene.camera.position = dvec3(0.123, -0.21, 0.31);
    s.scene.camera.target = dvec3(1, 0.3, 0.2);
    expectExact(s, "inside a brick");
    s.scene.camera.position = dvec3(0, 0, -0.5);  // in the plane between bricks
    s.scene.camera.target = dvec3(0, 0, 1);
    expectExact(s, "between bricks");
    s.scene.camera.position = dvec3(0, 0, -300);
    s.scene.camera.target = dvec3(0);
    s.scene.camera.verticalFov = radians(0.5);
    // Distances of 300 m are known to 1.5e-5 m, a quarter per mille of a cell.
    expectExact(s, "far away", 2e-4);
}

TEST_F(Volumes, DenseBricks_AreExact) {
    for (const double extinction : {1e-4, 1e2, 1e5, 1e30}) {
        TestScene s = makeNoise();
        s.scene.media[0].extinction = extinction * dvec3(1, 0.5, 0.25);
        s.scene.media[0].emission = extinction * dvec3(0.1, 0.2, 0.3);
        expectExact(s, "extinction " + std::to_string(extinction));
    }
}

TEST_F(Volumes, ShearRotationMirrorAndStretch_AreExact) {
    dmat4 shear(1);
    shear[1][0] = 0.4;
    shear[2][1] = -0.3;
    const dmat4 turn = glm::rotate(dmat4(1), 0.7, glm::normalize(dvec3(1, 2, 3)));
    expectExact(makeNoise(shear), "shear");
    expectExact(makeNoise(turn), "rotation");
    expectExact(makeNoise(glm::scale(dmat4(1), dvec3(-1, 1, 1))), "mirror");
    expectExact(makeNoise(turn * shear * glm::scale(dmat4(1), dvec3(1, -0.5, 0.25))), "all");
    TestScene s = makeNoise(glm::scale(dmat4(1), dvec3(1, -1, 1)));
    const dmat4 boxes = turn * shear * glm::scale(dmat4(1), dvec3(-0.05));
    s.addGrid(0, boxes).boxes = {{dvec3(-3), dvec3(2, 4, 5), 0.7f, false},
                                 {dvec3(-1, -8, -2), dvec3(4, -4, 9), 0.5f, true}};
    expectExact(s, "boxes as well");
}

TEST_F(Volumes, AxisParallelRaysAlongVoxelPlanes_AreExact) {
    // Orthographic rays through the centres of 32 pixels per unit run in planes of voxels.
    for (const dvec3 axis : {dvec3(0, 0, 1), dvec3(0, 0, -1), dvec3(1, 0, 0), dvec3(0, -1, 0)}) {
        TestScene s = makeNoise(dmat4(1), 32);
        s.scene.camera.type = scene::CameraType::Orthographic;
        s.scene.camera.height = 2.5;  // 5 / 64 m per pixel: 5 / 8 cells
        const dvec3 half = dvec3(1.25 / 32);
        s.scene.camera.position = -3.0 * axis + (1.0 - glm::abs(axis)) * half;
        s.scene.camera.target = s.scene.camera.position + axis;
        s.scene.camera.up = std::abs(axis.y) > 0 ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
        s.addGrid(0, centred(8)).boxes = {{dvec3(1), dvec3(3), 0.5f, false},
                                          {dvec3(3, 1, 1), dvec3(6, 3, 3), 0.25f, false},
                                          {dvec3(2), dvec3(5), 0.5f, true}};
        expectExact(s, fmt::format("axis {} {} {}", axis.x, axis.y, axis.z));
    }
}

TEST_F(Volumes, SoftTiles_AreExact) {
    TestScene s;
    const std::uint32_t medium = s.addMedium(dvec3(1, 2, 4), dvec3(0.5), dvec3(0.2));
    volumes::VolumeGrid& grid = s.addGrid(medium, centred(16));
    grid.boxes = {{dvec3(0), dvec3(7), 1, true},
                  {dvec3(8, 0, 0), dvec3(15, 7, 7), 0.5f, true},
                  {dvec3(4, 8, 4), dvec3(4, 15, 4), 3, true},  // one voxel thick
                  {dvec3(10), dvec3(10), 20, true}};           // a single voxel
    s.addDaylight();
    expectExact(s, "in front");
    s.scene.camera.position = dvec3(-0.5, -0.4, -0.45);
    s.scene.camera.target = dvec3(1);
    expectExact(s, "inside");
    // A tile as large as files may have, with the camera in it.
    s.volumes[0].boxes = {{dvec3(-4096), dvec3(-1), 0.01f, true},
                          {dvec3(0), dvec3(4095), 0.02f, true}};
    expectExact(s, "4096^3");
}

TEST_F(Volumes, TwoVolumesSpheresPaneAndSolid_AreExact) {
    TestScene s = makeNoise(dmat4(1), 64);
    const std::uint32_t other = s.addMedium(dvec3(3, 1, 0.5), dvec3(0.7), dvec3(0));
    s.scene.media[other].phase = scene::PhaseType::HenyeyGreenstein;
    s.scene.media[other].g = 0.6;
    const dmat4 turn = glm::rotate(dmat4(1), 0.5, glm::normalize(dvec3(3, 2, 1)));
    fillBricks(s.addGrid(other, turn * centred(24)), 3, noiseAt);
    s.addSphere(0, dvec3(0.3, 0.2, -0.5), 0.6, scene::Profile::Smooth, 2);
    s.addSphere(other, dvec3(-0.3, 0.2, 0.3), 0.7);
    s.addPane(s.addMaterial(makeThin(0.8, dvec3(0.2, 0.9, 0.4), dvec3(0.1))), 0, 0.7);
    s.addMesh(scene::makeSphere(0.7, 24), s.addMaterial(makeSolid(dvec3(0.5, 0.1, 1), dvec3(0.2))),
              translation(dvec3(0.3, -0.3, 0.2)));
    s.addMesh(scene::makeBox(dvec3(0.5)), s.addMaterial(makeOpaque(dvec3(0.5))),
              translation(dvec3(-0.5, -0.5, 0.4)) * turn);
    expectExact(s, "outside", 1e-5, 2e-3);
    s.scene.camera.position = dvec3(0.25, -0.2, 0.11);
    s.scene.camera.target = dvec3(-1, 0, 0.5);
    expectExact(s, "inside", 1e-5, 2e-3);
}

TEST_F(Volumes, PointLightInsideBricks_IsExact) {
    TestScene s = makeNoise(dmat4(1), 32);
    scene::Light& light = s.addLight(scene::LightType::Point, dvec3(3, 2, 1));
    light.position = dvec3(0.1, 0.2, -0.15);
    light.radius = 0.05;
    expectExact(s, "point");
}

TEST_F(Volumes, EmptyGrids_AreNothing) {
    TestScene s(8, 8);
    s.addGrid(s.addMedium(1));
    expectExact(s, "one empty grid");
    s.addSphere(0, dvec3(0), 0.5);
    fillBricks(s.addGrid(0), 1, [](const ivec3&) { return 0.0f; });
    expectExact(s, "a brick of zeros");
}

}  // namespace
}  // namespace brume::test
