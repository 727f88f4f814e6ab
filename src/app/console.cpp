// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <app/console.hpp>
#include <cmath>
#include <cstdio>

namespace brume::app {

Log makeConsoleLog(bool verbose) {
    return Log([verbose](LogLevel level, const std::string& message) {
        switch (level) {
            case LogLevel::Error:
                printError(message);
                break;
            case LogLevel::Warning:
                printError("warning: " + message);
                break;
            case LogLevel::Info:
            case LogLevel::Debug:
                if (verbose) printError(message);
        }
    });
}

void printError(const std::string& message) {
    std::string line = "brume: " + message;
    // Names from hostile files may hold line breaks or terminal commands.
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    fmt::print(stderr, "{}\n", line);
}

Progress::Progress(std::string what)
    : mWhat(std::move(what)),
      mStart(std::chrono::steady_clock::now()),
      mIsTerminal(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (mShownPercent >= 0) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double fraction) {
    if (!mIsTerminal || std::chrono::steady_clock::now() - mStart < std::chrono::seconds(1)) return;
    const int percent = static_cast<int>(std::lround(100 * std::clamp(fraction, 0.0, 1.0)));
    if (percent == mShownPercent) return;
    mShownPercent = percent;
    fmt::print(stderr, "\r{} {} %\033[K", mWhat, percent);
    std::fflush(stderr);
}

std::function<void(double)> Progress::callback() {
    return [this](double fraction) { update(fraction); };
}

std::string formatBytes(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    double value = static_cast<double>(bytes);
    const char* unit = "B";
    for (const char* next : {"KiB", "MiB", "GiB"}) {
        if (value < 1024) break;
        value /= 1024;
        unit = next;
    }
    return fmt::format("{:.1f} {}", value, unit);
}

std::string formatCounters(const std::map<std::string, std::uint64_t>& counters) {
    std::string text;
    for (const auto& [name, count] : counters)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
    return text;
}

std::string formatCount(std::uint64_t count, const std::string& noun) {
    if (count == 1) return "1 " + noun;
    const bool isSibilant = noun.ends_with("s") || noun.ends_with("sh");
    if (noun.ends_with("um")) return fmt::format("{} {}a", count, noun.substr(0, noun.size() - 2));
    return fmt::format("{} {}{}", count, noun, isSibilant ? "es" : "s");
}

}  // namespace brume::app
