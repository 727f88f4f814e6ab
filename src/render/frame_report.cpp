// SPDX-License-Identifier: Apache-2.0
#include <render/frame_report.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::render {

std::vector<PassTime> collectPasses(const frame::FrameBuilder& frame,
                                    const std::vector<gpu::ScopeTime>& times) {
    std::vector<PassTime> passes;
    for (const gpu::ScopeTime& scope : times) {
        const auto same = std::find_if(passes.begin(), passes.end(),
                                       [&](const PassTime& p) { return p.name == scope.name; });
        if (same != passes.end()) {
            same->timeMs += scope.timeMs;
            same->fragments += scope.fragments;
        } else {
            passes.push_back({scope.name, scope.timeMs, 0, scope.fragments});
        }
    }
    const std::map<std::string, std::uint64_t> bytesByPass = frame.passBytes();
    for (PassTime& pass : passes)
        if (const auto found = bytesByPass.find(pass.name); found != bytesByPass.end())
            pass.bytes = found->second;
    return passes;
}

double sumFrameMs(const std::vector<PassTime>& passes) {
    double sum = 0;
    for (const PassTime& pass : passes)
        if (!pass.name.starts_with("render.triangles") && !pass.name.ends_with("_read") &&
            pass.name != "render.composite")
            sum += pass.timeMs;
    return sum;
}

std::string describeMethodBytes(const frame::FrameDescription& frame,
                                const std::map<std::string, std::uint64_t>& bytes,
                                const std::map<std::string, std::uint64_t>& counters,
                                std::uint64_t pixelCount) {
    const auto lists = bytes.find("pairs"), pairs = counters.find("pairs");
    if (lists == bytes.end() || pairs == counters.end()) return {};
    std::uint64_t targets = 0;
    for (const frame::TargetDescription& target : frame.targets)
        if (target.isTransient && target.name.starts_with("oit.")) targets += target.bytes;
    for (const char* kind : {"lists", "listOffsets", "listStates"})
        if (const auto held = bytes.find(kind); held != bytes.end()) targets += held->second;
    const auto line = [](const char* name, std::uint64_t count, std::uint64_t parts) {
        const double share = static_cast<double>(count) / static_cast<double>(parts);
        return fmt::format("  {:<20} {:.2f}\n", name, share);
    };
    return line("methodPerPixel", targets, pixelCount) +
           line("perPair", lists->second, std::max<std::uint64_t>(pairs->second, 1));
}

}  // namespace brume::render
