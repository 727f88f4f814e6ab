// SPDX-License-Identifier: Apache-2.0
// From a host's matrices and viewport to the camera of a frame.
#pragma once

#include <render/gpu_scene.hpp>

#include <shaders/render/backdrop.h>

namespace brume::render {

/// As the host draws its opaque scene.
struct HostView {
    dmat4 viewFromWorld{1};  ///< rigid
    dmat4 clipFromView{1};   ///< perspective or orthographic, also off-centre
    int x = 0, y = 0;  ///< viewport, pixels; a negative height turns the image over, as VkViewport
    int width = 0, height = 0;
    double minDepth = 0, maxDepth = 1;  ///< of the viewport
    bool isLeftHanded = false;          ///< orthographic only: the view looks along +z
};

/// The camera of the view, and how its depth buffer is read: conventional, reversed and infinite
/// ranges follow from the matrix. Throws an input Error that names what is not supported.
View makeView(const HostView& host, shader::BackdropPush& push);

}  // namespace brume::render
