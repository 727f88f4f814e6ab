// SPDX-License-Identifier: Apache-2.0
// The contract of a fuzz target: any bytes are loaded, or refused by an input Error of one line. The
// same sources make a libFuzzer program (preset `fuzz`) and a test that replays tests/fuzz/corpus.
#pragma once

#include <core/error.hpp>

#include <unistd.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace brume::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// What a target's file defines: gives the bytes to its parser. Throws what the parser throws.
void parse(Bytes bytes);

inline std::string textOf(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Parses; anything but success and an input Error of one line ends the program.
inline void runOne(Bytes bytes) {
    try {
        parse(bytes);
    } catch (const Error& error) {
        const std::string text = error.what();
        if (error.kind() == ErrorKind::Input && text.find_first_of("\n\r") == std::string::npos)
            return;
        std::fprintf(stderr, "not an input error of one line: %s\n", text.c_str());
        std::abort();
    }
}

/// A file with these bytes, for parsers that read files; gone with the object.
class TempFile {
  public:
    TempFile(Bytes bytes, const char* extension)
        : mPath(std::filesystem::temp_directory_path() /
                ("brume_fuzz_" + std::to_string(::getpid()) + extension)) {
        std::ofstream(mPath, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
    ~TempFile() {
        std::error_code ignored;
        std::filesystem::remove(mPath, ignored);
    }
    TempFile(const TempFile&) = delete;
    TempFile& operator=(const TempFile&) = delete;
    const std::filesystem::path& path() const { return mPath; }

  private:
    std::filesystem::path mPath;
};

}  // namespace brume::fuzz
