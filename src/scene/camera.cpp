// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <scene/camera.hpp>

namespace brume::scene {

Ray CameraFrame::ray(double x, double y) const {
    const double sx = (2.0 * x / width - 1.0) * extentX + centerX;
    const double sy = (1.0 - 2.0 * y / height) * extentY + centerY;
    const dvec3 offset = sx * right + sy * up;
    if (type == CameraType::Orthographic) return {position + offset, forward};
    return {position, glm::normalize(forward + offset)};
}

CameraFrame makeCameraFrame(const Camera& camera, int width, int height) {
    constexpr const char* kDoing = "setting up the camera";
    CameraFrame frame;
    frame.type = camera.type;
    frame.position = camera.position;
    frame.near = camera.near;
    frame.width = width;
    frame.height = height;

    const dvec3 view = camera.target - camera.position;
    if (!(glm::length(view) > 0))
        throw inputError(kDoing, "camera", "target equals position, they must differ");
    frame.forward = glm::normalize(view);
    const dvec3 right = glm::cross(frame.forward, camera.up);
    if (!(glm::length(right) > 1e-9 * glm::length(camera.up)))
        throw inputError(kDoing, "camera",
                         "up is zero or parallel to the view, it must point to the side of it");
    frame.right = glm::normalize(right);
    frame.up = glm::cross(frame.right, frame.forward);

    frame.extentY = camera.type == CameraType::Perspective ? std::tan(0.5 * camera.verticalFov)
                                                           : 0.5 * camera.height;
    frame.extentX = frame.extentY * width / height;
    return frame;
}

}  // namespace brume::scene
