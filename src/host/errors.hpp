// SPDX-License-Identifier: Apache-2.0
// What goes wrong, as result codes and a line of text: nothing is thrown across the C border.
#pragma once

#include <brume/brume.h>
#include <core/error.hpp>

#include <algorithm>
#include <string>

namespace brume::host {

/// Turns the exception that is being handled into a result and keeps its text for the thread.
BrumeResult takeCurrentException() noexcept;

/// The thread's last error.
const char* lastError() noexcept;

/// Runs `work`; whatever it throws becomes a result.
template <typename Work>
BrumeResult guard(const Work& work) noexcept {
    try {
        work();
        return BRUME_SUCCESS;
    } catch (...) {
        return takeCurrentException();
    }
}

/// An input error of a call: "brumeAddLight: color: ...".
[[nodiscard]] Error refuse(const char* call, const char* where, const std::string& problem);

/// A copy of a structure of the caller's, which may be older or newer than ours.
template <typename Type>
Type readStruct(const char* call, const Type* given) {
    if (!given) throw refuse(call, "", "the structure is null");
    constexpr std::uint32_t kLargest = 1 << 16;
    if (given->structSize < sizeof(std::uint32_t) || given->structSize > kLargest)
        throw refuse(call, "structSize",
                     "it is " + std::to_string(given->structSize) + ", allowed is " +
                         std::to_string(sizeof(Type)) + "; start structures with BRUME_INIT");
    Type copy{};
    const auto* from = reinterpret_cast<const unsigned char*>(given);
    const std::size_t known = std::min<std::size_t>(given->structSize, sizeof(Type));
    std::copy_n(from, known, reinterpret_cast<unsigned char*>(&copy));
    // A newer caller's members that we do not know must ask for nothing.
    for (std::size_t i = known; i < given->structSize; ++i)
        if (from[i] != 0)
            throw refuse(call, "structSize",
                         "the structure has members that this version of the library lacks");
    copy.structSize = sizeof(Type);
    return copy;
}

}  // namespace brume::host
