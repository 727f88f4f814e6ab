// SPDX-License-Identifier: Apache-2.0
#include <volumes/allocation_watch.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> sLargest{0};

void* watch(std::size_t bytes) {
    std::size_t seen = sLargest.load();
    while (bytes > seen && !sLargest.compare_exchange_weak(seen, bytes)) {
    }
    void* memory = std::malloc(bytes > 0 ? bytes : 1);
    if (!memory) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return watch(bytes); }
void* operator new[](std::size_t bytes) { return watch(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace brume::volumes::test {

void resetLargestAllocation() { sLargest = 0; }
std::size_t largestAllocation() { return sLargest; }

}  // namespace brume::volumes::test
