// SPDX-License-Identifier: Apache-2.0
// From where a frame is seen.
#pragma once

#include <render/renderer.hpp>
#include <scene/camera.hpp>

namespace brume::render {

/// Where a frame is seen from.
struct View {
    scene::CameraFrame camera;  ///< of the samples; may stand in front of the scene's (orthographic)
    double far = 1e6;           ///< m; depth range of an orthographic camera
};

/// The view of the scene's own camera.
View makeView(const PreparedScene& scene);

}  // namespace brume::render
