// SPDX-License-Identifier: Apache-2.0
// `brume view`: the window around the Stage.
#pragma once

#include <core/log.hpp>
#include <gpu/device.hpp>
#include <view/pane.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace brume::view {

struct ViewerOptions {
    std::filesystem::path scene;
    std::string method;  ///< empty: the scene's
    scene::Settings settings;
    std::string shadow;            ///< of all lights; empty: as the scene says
    int width = 1280, height = 720;  ///< of the window
    bool isOffscreen = false;        ///< no window: an image, for scripts
    std::filesystem::path shaders;   ///< see Stage::watchShaders(); empty: none
    std::filesystem::path script;    ///< see Script; without a window its end is the viewer's
    gpu::DeviceOptions device;
};

/// Shows the scene until the window is closed. Returns the validation messages, if the device
/// validates. Throws an Error.
std::vector<std::string> runViewer(const ViewerOptions& options, const Log& log);

}  // namespace brume::view
