// SPDX-License-Identifier: Apache-2.0
// From pixels to rays: the one definition that every renderer follows.
#pragma once

#include <scene/scene.hpp>

namespace brume::scene {

struct Ray {
    dvec3 origin;     ///< world
    dvec3 direction;  ///< unit; distances along it are in metres
};

/// Orthonormal camera frame of an image of width x height samples.
/// Perspective: direction = normalize(forward + sx right + sy up); orthographic: origin =
/// position + sx right + sy up, direction = forward; with sx = (2x/width - 1) extentX
/// + centerX, sy = (1 - 2y/height) extentY + centerY and (x, y) from the top-left corner, pixel centres at + 1/2.
struct CameraFrame {
    CameraType type = CameraType::Perspective;
    dvec3 position, right, up, forward;
    double extentX = 1, extentY = 1;  ///< half size of the image plane (perspective: at distance 1)
    double centerX = 0, centerY = 0;  ///< where the axis does not go through the image's middle
    double near = 0.01;
    int width = 1, height = 1;

    Ray ray(double x, double y) const;
};

/// Throws an input Error if target equals position or up is parallel to the view.
CameraFrame makeCameraFrame(const Camera& camera, int width, int height);

}  // namespace brume::scene
