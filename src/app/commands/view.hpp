// SPDX-License-Identifier: Apache-2.0
// `brume view`: a scene in a window.
#pragma once

#include <app/session.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace brume::app {

struct ViewArguments {
    std::filesystem::path scene;
    std::string method;  ///< empty: the scene's
    std::string shadow;  ///< for all lights; empty: the scene's
    std::vector<std::string> settings;  ///< "key=value"
    std::string size;                   ///< of the window, "WxH"; empty: 1280x720
    std::filesystem::path shaders;  ///< folder to watch; empty: none
    std::filesystem::path script;
    bool isOffscreen = false;
    DeviceArguments device;
};

/// Throws a failure Error where the program was built without its libraries.
void runView(const ViewArguments& arguments, const Log& log);

}  // namespace brume::app
