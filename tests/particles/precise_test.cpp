// SPDX-License-Identifier: Apache-2.0
// Bit identity rests on every float operation of the step being marked as not to be fused or
// reordered; a forgotten `precise` would go unnoticed on a device that does neither.
#include <gtest/gtest.h>
#include <spv/particles/count.comp.hpp>
#include <spv/particles/step.comp.hpp>

#include <set>
#include <span>

namespace brume {
namespace {

// The SPIR-V specification, version 1.6, section 3.49.
constexpr std::uint32_t kOpDecorate = 71, kNoContraction = 42;
const std::set<std::uint32_t> kFloatArithmetic = {127, 129, 131, 133,
                                                  142};  // neg, add, sub, mul, vector times scalar
const std::set<std::uint32_t> kInexact = {136, 140, 141, 148};  // div, rem, mod, dot

void expectPrecise(std::span<const std::uint32_t> spirv) {
    std::set<std::uint32_t> exact;
    std::size_t arithmetic = 0;
    for (std::size_t i = 5; i < spirv.size(); i += spirv[i] >> 16u) {
        const std::uint32_t op = spirv[i] & 0xffffu;
        if (op == kOpDecorate && spirv[i + 2] == kNoContraction) exact.insert(spirv[i + 1]);
        EXPECT_FALSE(kInexact.count(op)) << "operation " << op << " at word " << i;
        if (!kFloatArithmetic.count(op) || op == 127) continue;
        ++arithmetic;
        EXPECT_TRUE(exact.count(spirv[i + 2])) << "operation " << op << " at word " << i;
    }
    EXPECT_GT(arithmetic, 0u);
}

TEST(Shaders, StepAndCount_HaveOnlyPreciseArithmetic) {
    expectPrecise(spv::particles_step_comp);
    expectPrecise(spv::particles_count_comp);
}

}  // namespace
}  // namespace brume
