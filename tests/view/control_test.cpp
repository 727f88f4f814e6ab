// SPDX-License-Identifier: Apache-2.0
// Camera, clock and preview: what the viewer does with input and time.
#include <gtest/gtest.h>

#include <view/camera_control.hpp>
#include <view/preview_scale.hpp>
#include <view/timeline.hpp>

namespace brume::view {
namespace {

scene::Camera camera() {
    scene::Camera camera;
    camera.position = {0, 0, 4};
    return camera;
}

TEST(CameraControl_Orbit, KeepsTargetAndDistance) {
    CameraControl control(camera());
    EXPECT_TRUE(control.apply({.turn = {300, 120}}));  // 90 degrees to the side, 36 up
    const dvec3 position = control.camera().position;
    EXPECT_NEAR(glm::length(position), 4, 1e-12);
    EXPECT_EQ(control.camera().target, dvec3(0));
    EXPECT_NEAR(position.y, 4 * std::sin(radians(36)), 1e-12);
    EXPECT_NEAR(position.x, -4 * std::cos(radians(36)), 1e-12);
    EXPECT_NEAR(position.z, 0, 1e-12);
}

TEST(CameraControl_Orbit, NeverPassesThePole) {
    CameraControl control(camera());
    for (int i = 0; i < 50; ++i) control.apply({.turn = {13, 100}});
    EXPECT_NEAR(control.camera().position.y, 4 * std::cos(radians(1)), 1e-9);
    EXPECT_GT(glm::length(glm::cross(control.camera().position, control.camera().up)), 1e-3);
}

TEST(CameraControl_Shift, MovesThePictureWithTheMouse) {
    CameraControl control(camera());
    control.apply({.shift = {10, 0}, .viewHeight = 100});
    // 100 pixels are 2 * 4 * tan(20 deg) m at the target; the picture goes right, the camera left.
    const double perPixel = 8 * std::tan(radians(20)) / 100;
    EXPECT_NEAR(control.camera().target.x, -10 * perPixel, 1e-12);
    EXPECT_NEAR(control.camera().position.x, -10 * perPixel, 1e-12);
    EXPECT_NEAR(control.camera().position.z, 4, 1e-12);
}

TEST(CameraControl_Zoom, ScalesTheDistance) {
    CameraControl control(camera());
    control.apply({.zoom = 2});
    EXPECT_NEAR(control.camera().position.z, 4 * 0.88 * 0.88, 1e-12);
    control.reset();
    EXPECT_EQ(control.camera(), camera());
}

TEST(CameraControl_ZoomOrthographic, ScalesTheHeight) {
    scene::Camera flat = camera();
    flat.type = scene::CameraType::Orthographic;
    flat.height = 10;
    CameraControl control(flat);
    control.apply({.zoom = 1});
    EXPECT_NEAR(control.camera().height, 8.8, 1e-12);
    EXPECT_EQ(control.camera().position, flat.position);
}

TEST(CameraControl_Fly, MovesAndLooksAround) {
    CameraControl control(camera());
    control.mode = CameraMode::Fly;
    control.speed = 2;
    EXPECT_TRUE(control.apply({.move = {0, 0, 1}, .seconds = 0.5}));
    EXPECT_NEAR(control.camera().position.z, 3, 1e-12);
    control.apply({.turn = {300, 0}});  // to the right: +x
    const dvec3 view = glm::normalize(control.camera().target - control.camera().position);
    EXPECT_NEAR(view.x, 1, 1e-12);
    EXPECT_NEAR(control.camera().position.z, 3, 1e-12);
    EXPECT_FALSE(control.apply({.seconds = 1}));
}

TEST(Timeline_Playing, RunsAsTheClockAndLoops) {
    Timeline timeline(0, 1);
    EXPECT_FALSE(timeline.advance(0.05));
    timeline.toggle();
    EXPECT_TRUE(timeline.advance(0.05));
    EXPECT_DOUBLE_EQ(timeline.now(), 0.05);
    timeline.seek(0.98);
    timeline.advance(0.05);
    EXPECT_NEAR(timeline.now(), 0.03, 1e-12);
    timeline.isLooping = false;
    timeline.seek(0.98);
    timeline.advance(0.05);
    EXPECT_EQ(timeline.now(), 1);
    EXPECT_FALSE(timeline.isPlaying);
}

TEST(Timeline_SlowPictures, SlowTimeDown) {
    Timeline timeline(0, 10);
    timeline.toggle();
    timeline.advance(3);
    EXPECT_DOUBLE_EQ(timeline.now(), 0.1);
    timeline.showsEveryFrame = true;
    timeline.seek(0);
    timeline.advance(3);
    EXPECT_EQ(timeline.frame(), 1);
}

TEST(Timeline_Steps, HitEveryFrame) {
    Timeline timeline(0, 10);
    timeline.frameRate = 30;
    for (int frame = 1; frame < 300; ++frame) {
        timeline.step(1);
        ASSERT_EQ(timeline.frame(), frame);
    }
    timeline.step(-400);
    EXPECT_EQ(timeline.now(), 0);
}

TEST(PreviewScale_SlowPictures, GetCoarserWhileMovingOnly) {
    PreviewScale scale;
    scale.budgetMs = 50;
    EXPECT_EQ(scale.choose(true), 1);  // nothing is known yet
    scale.addPicture(1, 180);
    EXPECT_EQ(scale.choose(true), 2);  // 180 / 4 fits
    EXPECT_EQ(scale.choose(false), 1);
    scale.addPicture(2, 120);  // it did not
    EXPECT_EQ(scale.choose(true), 4);
    scale.isEnabled = false;
    EXPECT_EQ(scale.choose(true), 1);
}

TEST(PreviewScale_FastPictures, GetFinerAgain) {
    PreviewScale scale;
    scale.budgetMs = 50;
    scale.addPicture(1, 1000);
    EXPECT_EQ(scale.choose(true), 8);
    for (int i = 0; i < 10; ++i) scale.addPicture(8, 1);
    for (int i = 0; i < 10; ++i) scale.addPicture(1, 40);
    EXPECT_EQ(scale.choose(true), 1);
}

}  // namespace
}  // namespace brume::view
