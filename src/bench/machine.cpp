// SPDX-License-Identifier: Apache-2.0
#include <bench/machine.hpp>
#include <bench/row.hpp>
#include <bench/statistics.hpp>
#include <gpu/submitter.hpp>
#include <gpu/timer_pool.hpp>
#include <spv/bench/fill.frag.hpp>
#include <spv/common/screen.vert.hpp>

#include <algorithm>
#include <fstream>
#include <thread>

namespace brume::bench {
namespace {

constexpr std::uint64_t kCopyBytes = 32ull << 20;
constexpr std::uint32_t kWidth = 640, kHeight = 360, kLayers = 8;

/// As Linux states it; "unknown" elsewhere.
std::string findProcessor() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("model name")) {
            const std::size_t colon = line.find(": ");
            if (colon != std::string::npos) return line.substr(colon + 2);
        }
    return "unknown";
}

}  // namespace

struct Yardstick::Impl {
    explicit Impl(gpu::Device& device_)
        : device(device_),
          submitter(device),
          timers(device, "yardstick"),
          source(device, {.name = "yardstick.source", .bytes = kCopyBytes}),
          target(device, {.name = "yardstick.target", .bytes = kCopyBytes}),
          image(device, {.name = "yardstick.image",
                         .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                         .width = kWidth,
                         .height = kHeight,
                         .usage = gpu::kUsageColor}),
          fill(device, {.name = "yardstick.fill",
                        .vertexSpirv = spv::common_screen_vert,
                        .fragmentSpirv = spv::bench_fill_frag,
                        .colors = {{image.format(), gpu::Blend::premultipliedOver()}}}) {
        submitter.submitAndWait("yardstick.clear", [&](gpu::Commands& commands) {
            commands.fillBuffer(source, 0x3f800000u);
            commands.transition(image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true);
        });
        run();  // compiles, touches all pages
        copyMs.clear();
        fillMs.clear();
    }

    void record(gpu::Commands& commands) {
        timers.reset(commands);
        commands.fullBarrier();
        const std::size_t copying = timers.begin(commands, "copy");
        commands.copyBuffer(source, target, kCopyBytes);
        timers.end(commands, copying);
        commands.fullBarrier();
        const std::size_t filling = timers.begin(commands, "fill");
        commands.beginRendering(
            std::vector<gpu::ColorAttachment>{{.image = &image, .load = gpu::LoadOp::Clear}});
        commands.bindGraphics(fill);
        commands.draw(3, kLayers);
        commands.endRendering();
        timers.end(commands, filling);
    }

    double run() {
        submitter.submitAndWait("yardstick", [&](gpu::Commands& commands) { record(commands); });
        const std::vector<gpu::ScopeTime> times = timers.read();
        copyMs.push_back(times.at(0).timeMs);
        fillMs.push_back(times.at(1).timeMs);
        return copyMs.back() + fillMs.back();
    }

    gpu::Device& device;
    gpu::Submitter submitter;
    gpu::TimerPool timers;
    gpu::Buffer source, target;
    gpu::Image image;
    gpu::GraphicsPipeline fill;
    std::vector<double> copyMs, fillMs;
};

double computeRoofMs(const Machine& machine, std::uint64_t bytes, std::uint64_t fragments) {
    double roofMs = 0;
    if (machine.bytesPerSecond > 0)
        roofMs = 1e3 * static_cast<double>(bytes) / machine.bytesPerSecond;
    if (machine.fragmentsPerSecond > 0)
        roofMs = std::max(roofMs,
                          1e3 * static_cast<double>(fragments) / machine.fragmentsPerSecond);
    return roofMs;
}

Yardstick::Yardstick(gpu::Device& device) : mImpl(std::make_unique<Impl>(device)) {}
Yardstick::~Yardstick() = default;

double Yardstick::measure() { return mImpl->run(); }

Machine Yardstick::machine() const {
    const gpu::DeviceInfo& info = mImpl->device.info();
    Machine machine{.device = info.name,
                    .type = info.type,
                    .driver = info.driver,
                    .api = info.api,
                    .processor = findProcessor(),
                    .cores = static_cast<int>(std::thread::hardware_concurrency()),
                    .version = version(),
                    .commit = commit()};
    machine.samples = static_cast<int>(mImpl->copyMs.size());
    const double copyMs = percentile(mImpl->copyMs, 0.5), fillMs = percentile(mImpl->fillMs, 0.5);
    if (copyMs > 0) machine.bytesPerSecond = 2e3 * static_cast<double>(kCopyBytes) / copyMs;
    if (fillMs > 0) machine.fragmentsPerSecond = 1e3 * kWidth * kHeight * kLayers / fillMs;
    return machine;
}

}  // namespace brume::bench
