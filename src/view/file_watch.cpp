// SPDX-License-Identifier: Apache-2.0
#include <view/file_watch.hpp>

namespace brume::view {

FileWatch::State FileWatch::look(const std::filesystem::path& file) {
    std::error_code isMissing;
    State state;
    state.time = std::filesystem::last_write_time(file, isMissing);
    if (isMissing) return {};
    state.bytes = std::filesystem::file_size(file, isMissing);
    return state;
}

void FileWatch::watch(const std::vector<std::filesystem::path>& files) {
    std::map<std::filesystem::path, Watched> watched;
    for (const std::filesystem::path& file : files) {
        if (const auto known = mFiles.find(file); known != mFiles.end()) {
            watched.insert(*known);
            continue;
        }
        const State state = look(file);
        watched[file] = {state, state};
    }
    mFiles = std::move(watched);
}

std::vector<std::filesystem::path> FileWatch::takeChanged() {
    std::vector<std::filesystem::path> changed;
    for (auto& [file, watched] : mFiles) {
        const State now = look(file);
        const bool isSettled = now == watched.last;
        watched.last = now;
        if (!isSettled || now == watched.known) continue;
        watched.known = now;
        changed.push_back(file);
    }
    return changed;
}

}  // namespace brume::view
