// SPDX-License-Identifier: Apache-2.0
// host_minimal [-o FILE.png] [--size WxH] [--frames N] [--start SECONDS] [--validate] [--window]
#include "smoke.hpp"
#ifdef HOST_MINIMAL_HAS_WINDOW
#include "window.hpp"
#endif

#include <cstdio>
#include <cstring>
#include <exception>

namespace {

struct Arguments {
    std::string file = "host_minimal.png";
    unsigned width = 640, height = 480;
    int frames = 30;    // in a window: 0, until it is closed
    double start = 3;  // s that the smoke has been rising before the first frame
    bool validate = false;
    bool window = false;
};

Arguments parse(int count, char** words) {
    Arguments arguments;
    bool hasFrames = false;
    for (int i = 1; i < count; ++i) {
        const bool hasValue = i + 1 < count;
        if (!std::strcmp(words[i], "--validate"))
            arguments.validate = true;
        else if (!std::strcmp(words[i], "--window"))
            arguments.window = true;
        else if (!std::strcmp(words[i], "-o") && hasValue)
            arguments.file = words[++i];
        else if (!std::strcmp(words[i], "--frames") && hasValue)
            arguments.frames = std::stoi(words[++i]), hasFrames = true;
        else if (!std::strcmp(words[i], "--start") && hasValue)
            arguments.start = std::stod(words[++i]);
        else if (std::strcmp(words[i], "--size") || !hasValue ||
                 std::sscanf(words[++i], "%ux%u", &arguments.width, &arguments.height) != 2)
            throw std::invalid_argument(std::string("unknown argument ") + words[i]);
    }
    if (arguments.window && !hasFrames) arguments.frames = 0;
    return arguments;
}

int report(const host_minimal::Renderer& renderer) {
    for (const std::string& message : renderer.messages())
        std::fprintf(stderr, "host_minimal: validation: %s\n", message.c_str());
    return renderer.messages().empty() ? 0 : 1;
}

int run(const Arguments& arguments) {
    host_minimal::Renderer renderer(arguments.width, arguments.height, arguments.validate);
    {
        Smoke smoke(renderer, HOST_MINIMAL_SCENE);
        for (int i = 0; i < arguments.frames; ++i) {
            const double time = i / 30.0;
            const VkCommandBuffer commands = renderer.beginFrame();
            renderer.drawOpaque(commands, 0.6 + time);
            smoke.record(renderer, commands, i == 0 ? arguments.start : 1 / 30.0);
            renderer.endFrame();
        }
        renderer.writePng(arguments.file);
    }
    return report(renderer);
}

#ifdef HOST_MINIMAL_HAS_WINDOW
int runInWindow(const Arguments& arguments) {
    host_minimal::Window window(arguments.width, arguments.height, "host_minimal");
    host_minimal::Renderer renderer(arguments.width, arguments.height, arguments.validate,
                                    window.extensions());
    window.attach(renderer);
    {
        Smoke smoke(renderer, HOST_MINIMAL_SCENE);
        double last = window.seconds(), step = arguments.start;
        for (int i = 0; window.isOpen() && (arguments.frames == 0 || i < arguments.frames); ++i) {
            const VkCommandBuffer commands = renderer.beginFrame();
            renderer.drawOpaque(commands, 0.6 + last);
            smoke.record(renderer, commands, step);
            window.present(renderer, commands);
            step = std::min(window.seconds() - last, 0.1);
            last = window.seconds();
        }
        renderer.waitIdle();
    }
    window.detach(renderer);
    return report(renderer);
}
#else
int runInWindow(const Arguments&) {
    throw std::runtime_error("--window: this program was built without GLFW");
}
#endif

}  // namespace

int main(int count, char** words) {
    try {
        const Arguments arguments = parse(count, words);
        return arguments.window ? runInWindow(arguments) : run(arguments);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "host_minimal: %s\n", e.what());
        return 1;
    }
}
