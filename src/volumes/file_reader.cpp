// SPDX-License-Identifier: Apache-2.0
#include <volumes/file_reader.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::volumes {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;

}  // namespace

FileReader::FileReader(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw MalformedFile("there is no such file");
    mStream.open(file, std::ios::binary);
    mSize = std::filesystem::file_size(file, error);
    if (!mStream || error) throw MalformedFile("the file cannot be opened");
}

void FileReader::require(std::uint64_t bytes) const {
    if (bytes > remaining())
        throw MalformedFile(fmt::format(
            "the file is damaged or cut short: {} bytes are needed at byte {}, {} are left", bytes,
            position(), remaining()));
}

void FileReader::fill() {
    mWindow += mNext;
    mNext = 0;
    mBuffer.resize(
        static_cast<std::size_t>(std::min<std::uint64_t>(kBufferBytes, mSize - mWindow)));
    mStream.seekg(static_cast<std::streamoff>(mWindow));
    mStream.read(mBuffer.data(), static_cast<std::streamsize>(mBuffer.size()));
    if (!mStream) throw MalformedFile(fmt::format("the file cannot be read at byte {}", mWindow));
}

void FileReader::read(void* target, std::uint64_t bytes) {
    require(bytes);
    auto* to = static_cast<char*>(target);
    while (bytes > 0) {
        if (mNext >= mBuffer.size()) fill();
        const auto part =
            static_cast<std::size_t>(std::min<std::uint64_t>(bytes, mBuffer.size() - mNext));
        std::memcpy(to, mBuffer.data() + mNext, part);
        mNext += part;
        to += part;
        bytes -= part;
    }
}

void FileReader::skip(std::uint64_t bytes) {
    require(bytes);
    seek(position() + bytes);
}

void FileReader::seek(std::uint64_t position) {
    if (position > mSize)
        throw MalformedFile(fmt::format(
            "the file is damaged or cut short: it points to byte {} of {}", position, mSize));
    if (position >= mWindow && position <= mWindow + mBuffer.size()) {
        mNext = static_cast<std::size_t>(position - mWindow);
        return;
    }
    mWindow = position;
    mNext = 0;
    mBuffer.clear();
}

std::string FileReader::readString(std::uint32_t limit) {
    const auto length = read<std::uint32_t>();
    if (length > limit)
        throw MalformedFile(fmt::format("a name of {} bytes at byte {}, at most {} are allowed",
                                        length, position(), limit));
    std::string text(length, '\0');
    read(text.data(), length);
    return text;
}

}  // namespace brume::volumes
