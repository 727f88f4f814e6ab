// SPDX-License-Identifier: Apache-2.0
#include <view/camera_control.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace brume::view {
namespace {

constexpr double kRadiansPerPixel = radians(0.3);
constexpr double kNearestToPole = radians(1);  // so that up never lies along the view
constexpr double kZoomPerNotch = 0.88;

/// Turns an arm about `up` and then towards or away from it, never over the pole.
dvec3 turnArm(const dvec3& arm, const dvec3& up, const dvec2& angles) {
    const dvec3 pole = glm::normalize(up);
    const dvec3 around = dvec3(glm::rotate(dmat4(1), angles.x, pole) * dvec4(arm, 0));
    const dvec3 side = glm::cross(pole, around);
    if (!(glm::length(side) > 0)) return around;
    const double fromPole =
        std::acos(std::clamp(glm::dot(glm::normalize(around), pole), -1.0, 1.0));
    const double wanted =
        std::clamp(fromPole + angles.y, kNearestToPole, kPi - kNearestToPole);
    return dvec3(glm::rotate(dmat4(1), wanted - fromPole, glm::normalize(side)) *
                 dvec4(around, 0));
}

}  // namespace

CameraControl::CameraControl(const scene::Camera& camera) { setHome(camera); }

void CameraControl::setHome(const scene::Camera& camera) {
    mHome = mCamera = camera;
    speed = std::max(0.5 * glm::length(camera.target - camera.position), 1e-6);
}

bool CameraControl::apply(const CameraInput& input) {
    const bool isTurned = input.turn != dvec2(0), isShifted = input.shift != dvec2(0);
    const bool isFlying = mode == CameraMode::Fly;
    const bool isMoved = isFlying && input.move != dvec3(0) && input.seconds > 0;
    if (isTurned) isFlying ? look(input.turn) : orbit(input.turn);
    if (isShifted) shift(input.shift, input.viewHeight);
    if (isMoved) {
        const dvec3 forward = glm::normalize(mCamera.target - mCamera.position);
        const dvec3 right = glm::normalize(glm::cross(forward, mCamera.up));
        const dvec3 way = input.move.x * right + input.move.y * glm::normalize(mCamera.up) +
                          input.move.z * forward;
        mCamera.position += speed * input.seconds * way;
        mCamera.target += speed * input.seconds * way;
    }
    if (input.zoom == 0) return isTurned || isShifted || isMoved;
    if (isFlying) {
        speed = std::clamp(speed * std::pow(1.2, input.zoom), 1e-6, 1e9);
        return isTurned || isShifted || isMoved;
    }
    zoom(input.zoom);
    return true;
}

void CameraControl::orbit(const dvec2& turn) {
    const dvec3 arm = mCamera.position - mCamera.target;
    mCamera.position =
        mCamera.target + turnArm(arm, mCamera.up, -kRadiansPerPixel * turn);
}

void CameraControl::look(const dvec2& turn) {
    const dvec3 arm = mCamera.target - mCamera.position;
    mCamera.target = mCamera.position +
                     turnArm(arm, mCamera.up, kRadiansPerPixel * dvec2(-turn.x, turn.y));
}

void CameraControl::shift(const dvec2& pixels, double viewHeight) {
    const dvec3 arm = mCamera.target - mCamera.position;
    const double worldHeight = mCamera.type == scene::CameraType::Orthographic
                                   ? mCamera.height
                                   : 2 * glm::length(arm) * std::tan(0.5 * mCamera.verticalFov);
    const dvec3 right = glm::normalize(glm::cross(arm, mCamera.up));
    const dvec3 up = glm::normalize(glm::cross(right, arm));
    const dvec3 way = (-pixels.x * right + pixels.y * up) * (worldHeight / viewHeight);
    mCamera.position += way;
    mCamera.target += way;
}

void CameraControl::zoom(double notches) {
    const double factor = std::pow(kZoomPerNotch, notches);
    if (mCamera.type == scene::CameraType::Orthographic) {
        mCamera.height = std::clamp(mCamera.height * factor, 1e-6, 1e9);
        return;
    }
    const dvec3 arm = mCamera.position - mCamera.target;
    const double wanted = std::clamp(glm::length(arm) * factor, 1e-6, 1e9);
    mCamera.position = mCamera.target + glm::normalize(arm) * wanted;
}

}  // namespace brume::view
