// SPDX-License-Identifier: Apache-2.0
// How the library speaks: to a callback of its caller, never to a stream.
#pragma once

#include <functional>
#include <string>

namespace brume {

enum class LogLevel { Debug, Info, Warning, Error };

/// A message sink that is passed by reference to whatever may have something to say. An empty one
/// swallows everything. Calls come from the thread that called the library.
class Log {
  public:
    using Callback = std::function<void(LogLevel, const std::string& message)>;

    Log() = default;
    explicit Log(Callback callback) : mCallback(std::move(callback)) {}

    void debug(const std::string& message) const { write(LogLevel::Debug, message); }
    void info(const std::string& message) const { write(LogLevel::Info, message); }
    void warning(const std::string& message) const { write(LogLevel::Warning, message); }
    void error(const std::string& message) const { write(LogLevel::Error, message); }
    void write(LogLevel level, const std::string& message) const;

  private:
    Callback mCallback;
};

}  // namespace brume
