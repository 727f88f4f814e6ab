// SPDX-License-Identifier: Apache-2.0
#include <app/commands/view.hpp>
#include <core/error.hpp>
#ifdef BRUME_HAS_VIEWER
#include <view/viewer.hpp>
#endif

namespace brume::app {

#ifdef BRUME_HAS_VIEWER
void runView(const ViewArguments& arguments, const Log& log) {
    if (arguments.isOffscreen && arguments.script.empty())
        throw inputError("reading options", "--offscreen", "needs --script FILE, which ends it");
    view::ViewerOptions options;
    options.scene = arguments.scene;
    options.method = arguments.method;
    options.settings = parseSettings(arguments.settings);
    options.shadow = arguments.shadow;
    if (!arguments.size.empty()) {
        const ivec2 size = parseSize(arguments.size);
        options.width = size.x;
        options.height = size.y;
    }
    options.isOffscreen = arguments.isOffscreen;
    options.script = arguments.script;
    options.shaders = arguments.shaders;
    options.device = makeDeviceOptions(arguments.device);
    checkValidation(view::runViewer(options, log), "window", log);
}
#else
void runView(const ViewArguments&, const Log&) {
    throw failure("opening a window", "",
                  "this brume was built without the viewer, which needs GLFW and Dear ImGui");
}
#endif

}  // namespace brume::app
