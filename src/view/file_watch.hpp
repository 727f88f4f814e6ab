// SPDX-License-Identifier: Apache-2.0
// Which of some files have changed since the last look.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

namespace brume::view {

class FileWatch {
  public:
    /// Watches just these, also those that do not exist: as they are now, or as they were when they
    /// were watched first.
    void watch(const std::vector<std::filesystem::path>& files);

    /// Those written, made or removed since watch() or the last call. A file is reported once it
    /// has been the same for two calls in a row, so that half-written ones are not read.
    std::vector<std::filesystem::path> takeChanged();

  private:
    struct State {
        std::filesystem::file_time_type time{};
        std::uintmax_t bytes = 0;
        bool operator==(const State&) const = default;
    };
    struct Watched {
        State known, last;
    };
    static State look(const std::filesystem::path& file);

    std::map<std::filesystem::path, Watched> mFiles;
};

}  // namespace brume::view
