// SPDX-License-Identifier: Apache-2.0
// host_minimal [-o FILE.png] [--size WxH] [--frames N] [--start SECONDS] [--validate]
#include "smoke.hpp"

#include <cstdio>
#include <cstring>
#include <exception>

namespace {

struct Arguments {
    std::string file = "host_minimal.png";
    unsigned width = 640, height = 480;
    int frames = 30;
    double start = 3;  // s that the smoke has been rising before the first frame
    bool validate = false;
};

Arguments parse(int count, char** words) {
    Arguments arguments;
    for (int i = 1; i < count; ++i) {
        const bool hasValue = i + 1 < count;
        if (!std::strcmp(words[i], "--validate"))
            arguments.validate = true;
        else if (!std::strcmp(words[i], "-o") && hasValue)
            arguments.file = words[++i];
        else if (!std::strcmp(words[i], "--frames") && hasValue)
            arguments.frames = std::stoi(words[++i]);
        else if (!std::strcmp(words[i], "--start") && hasValue)
            arguments.start = std::stod(words[++i]);
        else if (std::strcmp(words[i], "--size") || !hasValue ||
                 std::sscanf(words[++i], "%ux%u", &arguments.width, &arguments.height) != 2)
            throw std::invalid_argument(std::string("unknown argument ") + words[i]);
    }
    return arguments;
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
    for (const std::string& message : renderer.messages())
        std::fprintf(stderr, "host_minimal: validation: %s\n", message.c_str());
    return renderer.messages().empty() ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
    try {
        return run(parse(count, words));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "host_minimal: %s\n", e.what());
        return 1;
    }
}
