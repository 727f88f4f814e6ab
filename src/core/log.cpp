// SPDX-License-Identifier: Apache-2.0
#include <core/log.hpp>

namespace brume {

void Log::write(LogLevel level, const std::string& message) const {
    if (mCallback) mCallback(level, message);
}

}  // namespace brume
