// SPDX-License-Identifier: Apache-2.0
// What the command says on the terminal: messages, progress, formatted numbers.
#pragma once

#include <chrono>
#include <core/log.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace brume::app {

/// Sends warnings and errors to stderr, each as one line; with `verbose` everything.
Log makeConsoleLog(bool verbose);

/// Writes "brume: <message>" to stderr as one line, without control characters.
void printError(const std::string& message);

/// A line "what 42 %" on stderr while work takes longer than a second; silent unless stderr is a
/// terminal. The destructor wipes it.
class Progress {
  public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(double fraction);
    std::function<void(double)> callback();

  private:
    std::string mWhat;
    std::chrono::steady_clock::time_point mStart;
    bool mIsTerminal = false;
    int mShownPercent = -1;
};

/// "12.3 MiB"
std::string formatBytes(std::uint64_t bytes);

/// "stored 123, dropped 0"
std::string formatCounters(const std::map<std::string, std::uint64_t>& counters);

/// "1 triangle", "2 triangles"
std::string formatCount(std::uint64_t count, const std::string& noun);

}  // namespace brume::app
