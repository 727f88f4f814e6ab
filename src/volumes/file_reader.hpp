// SPDX-License-Identifier: Apache-2.0
// Reading a binary file with every step checked against its end.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace brume::volumes {

/// The file is damaged: thrown inside the readers, which add the file's name.
class MalformedFile : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file with a large buffer, so that short reads and skips cost nothing. Throws MalformedFile
/// instead of passing the end.
class FileReader {
  public:
    /// Throws MalformedFile if the file cannot be opened or is no ordinary file.
    explicit FileReader(const std::filesystem::path& file);

    std::uint64_t size() const { return mSize; }
    std::uint64_t position() const { return mWindow + mNext; }
    std::uint64_t remaining() const { return mSize - position(); }

    void read(void* target, std::uint64_t bytes);
    void skip(std::uint64_t bytes);
    void seek(std::uint64_t position);

    template <typename T>
    T read() {
        T value;
        read(&value, sizeof(T));
        return value;
    }

    /// A 32-bit length and as many bytes; refuses more than `limit`.
    std::string readString(std::uint32_t limit);

  private:
    void require(std::uint64_t bytes) const;
    void fill();

    std::ifstream mStream;
    std::uint64_t mSize = 0;
    std::uint64_t mWindow = 0;  ///< file position of the buffer's start
    std::size_t mNext = 0;      ///< of the next byte in the buffer
    std::vector<char> mBuffer;
};

}  // namespace brume::volumes
