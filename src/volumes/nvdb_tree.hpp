// SPDX-License-Identifier: Apache-2.0
// The tree of a grid in a .nvdb file. Every offset is checked before it is followed, because NanoVDB
// itself follows them blindly; so the nodes are read here and not through its accessors.
#pragma once

#include <volumes/file_reader.hpp>
#include <volumes/grid_reader.hpp>

#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>

namespace brume::volumes {

[[noreturn]] inline void throwDamagedNvdb(const std::string& what) {
    throw MalformedFile("the file is damaged: " + what);
}

/// Owns a grid's bytes, aligned as its nodes expect, and hands out parts of it by checked offset.
class NvdbBuffer {
  public:
    explicit NvdbBuffer(std::uint64_t bytes)
        : mBytes(bytes),
          mData(static_cast<char*>(
              std::aligned_alloc(kAlignment, (bytes + kAlignment - 1) / kAlignment * kAlignment))) {
        if (!mData) throw std::bad_alloc();
    }

    char* data() { return mData.get(); }
    std::uint64_t size() const { return mBytes; }

    /// The T at a byte offset, with `extra` bytes behind it.
    template <typename T>
    const T& at(std::uint64_t offset, std::uint64_t extra = 0) const {
        if (offset % kAlignment != 0 || sizeof(T) > mBytes || extra > mBytes - sizeof(T) ||
            offset > mBytes - sizeof(T) - extra)
            throwDamagedNvdb(fmt::format("a node at offset {} of {}", offset, mBytes));
        return *reinterpret_cast<const T*>(mData.get() + offset);
    }

  private:
    static constexpr std::uint64_t kAlignment = 32;
    struct Free {
        void operator()(char* p) const { std::free(p); }
    };
    std::uint64_t mBytes;
    std::unique_ptr<char, Free> mData;
};

/// Reads the voxels, tiles and their statistics of one grid of floats of any precision. False where
/// its values are of another type, and nothing is read.
bool readNvdbTree(nanovdb::GridType type, const NvdbBuffer& buffer, LoadedGrid& loaded);

}  // namespace brume::volumes
