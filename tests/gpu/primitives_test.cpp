// SPDX-License-Identifier: Apache-2.0
// Prefix sum and radix sort against the standard library, on sizes around their chunks.
#include <gpu/gpu_fixture.hpp>
#include <gpu/radix_sort.hpp>
#include <gpu/upload.hpp>

#include <algorithm>
#include <numeric>
#include <random>

namespace brume::test {
namespace {

constexpr std::uint32_t kSizes[] = {1, 2, 63, 64, 65, 255, 256, 257, 1023, 4097, 100'003, 1'000'000};

std::vector<std::uint32_t> makeValues(std::uint32_t count, std::uint32_t mask) {
    std::mt19937 random(count);
    std::vector<std::uint32_t> values(count);
    for (std::uint32_t& value : values) value = static_cast<std::uint32_t>(random()) & mask;
    return values;
}

using PrefixSumTest = GpuTest;

TEST_F(PrefixSumTest, EverySize_EqualsExclusiveScan) {
    const gpu::PrefixSum prefixSum(device());
    // 2^32 overflows on the way: sums are modulo 2^32.
    for (const std::uint32_t mask : {1u, 0xffu, 0xffffffffu})
        for (const std::uint32_t count : kSizes) {
            const auto input = makeValues(count, mask);
            gpu::Buffer values;
            const gpu::Buffer sums(device(), {.name = "sums",
                                              .bytes = 4ull * gpu::PrefixSum::sumCount(count)});
            submit([&](gpu::Commands& commands) {
                values = gpu::makeBuffer(commands, "values", input);
                commands.computeBarrier();
                prefixSum.record(commands, values.deviceAddress(), count, sums.deviceAddress());
            });
            std::vector<std::uint32_t> expected(count);
            std::exclusive_scan(input.begin(), input.end(), expected.begin(), 0u);
            ASSERT_EQ(submitter().readBuffer<std::uint32_t>(values, count), expected) << count;
            const auto total = submitter().readBuffer<std::uint32_t>(
                sums, 1, 4ull * gpu::PrefixSum::totalIndex(count));
            EXPECT_EQ(total[0], expected.back() + input.back()) << count;
        }
}

using RadixSortTest = GpuTest;

TEST_F(RadixSortTest, EverySize_EqualsStableSort) {
    for (const std::uint32_t mask : {0xffffffffu, 0x80000700u})  // few distinct keys: is it stable?
        for (const std::uint32_t count : kSizes) {
            // The small ones also with arrays that are called too large to be bound.
            const std::uint64_t maxBound = mask != ~0u && count < 5000 ? 1024 : ~std::uint64_t{0};
            const gpu::RadixSort sort(device(), "sort", count, maxBound);
            const auto keys = makeValues(count, mask);
            std::vector<std::uint32_t> order(count);
            std::iota(order.begin(), order.end(), 0u);
            gpu::Buffer keyBuffer, valueBuffer;
            submit([&](gpu::Commands& commands) {
                keyBuffer = gpu::makeBuffer(commands, "keys", keys);
                valueBuffer = gpu::makeBuffer(commands, "values", order);
                commands.computeBarrier();
                sort.record(commands, keyBuffer, valueBuffer, count);
            });
            std::stable_sort(order.begin(), order.end(),
                             [&](auto a, auto b) { return keys[a] < keys[b]; });
            ASSERT_EQ(submitter().readBuffer<std::uint32_t>(valueBuffer, count), order) << count;
            const auto sorted = submitter().readBuffer<std::uint32_t>(keyBuffer, count);
            for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(sorted[i], keys[order[i]]);
        }
}

}  // namespace
}  // namespace brume::test
