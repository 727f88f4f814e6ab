// SPDX-License-Identifier: Apache-2.0
#include <volumes/allocation_watch.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> sLargest{0};

void* watch(std::size_t bytes) noexcept {
    std::size_t seen = sLargest.load();
    while (bytes > seen && !sLargest.compare_exchange_weak(seen, bytes)) {
    }
    return std::malloc(bytes > 0 ? bytes : 1);
}

void* watchOrThrow(std::size_t bytes) {
    void* memory = watch(bytes);
    if (!memory) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return watchOrThrow(bytes); }
void* operator new[](std::size_t bytes) { return watchOrThrow(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return watch(bytes); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return watch(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace brume::volumes::test {

void resetLargestAllocation() { sLargest = 0; }
std::size_t largestAllocation() { return sLargest; }

}  // namespace brume::volumes::test

/// OpenVDB forgets nodes that it has made when a damaged chunk makes it throw; that is not ours to
/// mend.
extern "C" const char* __lsan_default_suppressions() { return "leak:openvdb"; }
