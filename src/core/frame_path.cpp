// SPDX-License-Identifier: Apache-2.0
#include <core/frame_path.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace brume {
namespace {

/// Where in `name` the number goes, and how many digits it has at least.
struct Slot {
    std::size_t begin = std::string::npos;
    std::size_t length = 0;
    int digits = 4;
};

Slot findHashes(const std::string& name) {
    const std::size_t begin = name.find('#');
    if (begin == std::string::npos) return {};
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    return {begin, end - begin, static_cast<int>(std::min<std::size_t>(end - begin, 20))};
}

/// "%d" or "%0Nd" with one digit N; the name never reaches a printf.
Slot findPercent(const std::string& name) {
    for (std::size_t i = name.find('%'); i != std::string::npos; i = name.find('%', i + 1)) {
        if (name.compare(i, 2, "%d") == 0) return {i, 2, 1};
        if (i + 3 < name.size() && name[i + 1] == '0' && name[i + 3] == 'd' &&
            std::isdigit(static_cast<unsigned char>(name[i + 2])))
            return {i, 4, name[i + 2] - '0'};
    }
    return {};
}

Slot findSlot(const std::string& name) {
    const Slot hashes = findHashes(name);
    return hashes.begin != std::string::npos ? hashes : findPercent(name);
}

}  // namespace

bool hasFrameNumber(const std::filesystem::path& pattern) {
    return findSlot(pattern.filename().string()).begin != std::string::npos;
}

std::filesystem::path makeFramePath(const std::filesystem::path& pattern, int frame) {
    std::string name = pattern.filename().string();
    Slot slot = findSlot(name);
    if (slot.begin == std::string::npos) {
        const std::string stem = pattern.stem().string();
        name = fmt::format("{}_{}", stem, name.substr(stem.size()));
        slot = {stem.size() + 1, 0, 4};
    }
    name.replace(slot.begin, slot.length, fmt::format("{:0{}}", frame, slot.digits));
    return pattern.parent_path() / name;
}

}  // namespace brume
