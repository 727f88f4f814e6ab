// SPDX-License-Identifier: Apache-2.0
// The one exception type of the library.
#pragma once

#include <stdexcept>
#include <string>

namespace brume {

/// Who has to act on an error.
enum class ErrorKind {
    Input,   ///< a bad argument or file: the user can mend it (command line: exit code 2)
    Failure  ///< device, memory, or input/output failed (command line: exit code 1)
};

/// An error with one line of text: "<what was being done>: <where>: <what is wrong>, <what is
/// allowed>". The library throws nothing else on purpose; it never prints, exits or aborts.
class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), mKind(kind) {}
    ErrorKind kind() const { return mKind; }

  private:
    ErrorKind mKind;
};

/// An input error. `doing`: "loading scene"; `where`: "plume.json:12:7" or an object's name (may be
/// empty); `problem`: what is wrong and what is allowed. Line breaks become spaces.
[[nodiscard]] Error inputError(const std::string& doing, const std::string& where,
                               const std::string& problem);

/// A failure that the user's input did not cause; arguments as for inputError().
[[nodiscard]] Error failure(const std::string& doing, const std::string& where,
                            const std::string& problem);

}  // namespace brume
