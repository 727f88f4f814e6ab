// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/camera.hpp>

namespace brume::scene {
namespace {

using test::messageOf;

void expectNear(const dvec3& a, const dvec3& b, double tolerance = 1e-14) {
    EXPECT_LE(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

Camera lookAlongMinusZ(CameraType type) {
    Camera camera;
    camera.type = type;
    camera.position = {1, 2, 3};
    camera.target = {1, 2, -7};
    return camera;
}

TEST(Camera_Perspective, CentreAndEdges_FollowTheFieldOfView) {
    Camera camera = lookAlongMinusZ(CameraType::Perspective);
    camera.verticalFov = radians(90);
    const CameraFrame frame = makeCameraFrame(camera, 200, 100);
    expectNear(frame.ray(100, 50).direction, {0, 0, -1});
    expectNear(frame.ray(100, 0).direction, glm::normalize(dvec3(0, 1, -1)));
    expectNear(frame.ray(200, 50).direction, glm::normalize(dvec3(2, 0, -1)));
    expectNear(frame.ray(0, 100).direction, glm::normalize(dvec3(-2, -1, -1)));
    expectNear(frame.ray(17, 3).origin, {1, 2, 3});
}

TEST(Camera_Orthographic, PixelCentre_LiesWhereTheImagePlaneSays) {
    Camera camera = lookAlongMinusZ(CameraType::Orthographic);
    camera.height = 120;
    const CameraFrame frame = makeCameraFrame(camera, 96, 128);
    const double pixel = 120.0 / 128;
    const Ray ray = frame.ray(10 + 0.5, 20 + 0.5);
    expectNear(ray.direction, {0, 0, -1});
    expectNear(ray.origin, {1 + (10.5 - 48) * pixel, 2 - (20.5 - 64) * pixel, 3}, 1e-12);
}

TEST(Camera_Frame, TiltedUp_IsOrthonormalAndRightHanded) {
    Camera camera;
    camera.position = {1, 1.2, 5};
    camera.target = {0, 7, -2};
    camera.up = {0.3, 2, 0.1};
    const CameraFrame f = makeCameraFrame(camera, 3, 5);
    expectNear(glm::cross(f.right, f.up), -f.forward, 1e-14);
    EXPECT_NEAR(glm::dot(f.up, f.forward), 0, 1e-15);
    EXPECT_GT(glm::dot(f.up, camera.up), 0);
}

TEST(Camera_Degenerate, TargetAtPositionOrUpAlongView_IsAnInputError) {
    Camera camera;
    camera.target = camera.position;
    EXPECT_EQ(messageOf([&] { makeCameraFrame(camera, 1, 1); }),
              "setting up the camera: camera: target equals position, they must differ");
    camera.target = camera.position + dvec3(0, 3, 0);
    EXPECT_NE(messageOf([&] { makeCameraFrame(camera, 1, 1); }).find("parallel"),
              std::string::npos);
}

}  // namespace
}  // namespace brume::scene
