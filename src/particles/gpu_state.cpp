// SPDX-License-Identifier: Apache-2.0
// The state of a GpuPopulation to the host and back: for checkpoints and for the reference.
#include <core/assert.hpp>
#include <particles/gpu_population.hpp>

#include <cstring>

namespace brume::particles {

using shader::kStateWords;

static_assert(sizeof(Particle) == kStateWords * sizeof(std::uint64_t));

Counters GpuPopulation::readCounters(gpu::Submitter& submitter) const {
    Counters sum{};
    for (const auto& totals : submitter.readBuffer<shader::TickTotals>(mTotals, mInstanceCount)) {
        sum.alive += totals.counters.alive;
        sum.born += totals.counters.born;
        sum.died += totals.counters.died;
        sum.rejected += totals.counters.rejected;
        sum.killed += totals.counters.killed;
    }
    return sum;
}

std::vector<Particle> GpuPopulation::readParticles(gpu::Submitter& submitter,
                                                   std::uint32_t instance, Counters& counters,
                                                   std::vector<std::uint32_t>& strands) const {
    strands.clear();
    submitter.read(mTotals, &counters, sizeof counters, instance * sizeof(shader::TickTotals));
    std::vector<Particle> particles(counters.alive);
    if (particles.empty()) return particles;
    const gpu::Buffer& state = mStates[mCurrent];
    const auto offsets = stateOffsets();
    const std::uint64_t first = std::uint64_t{instance} * mEffect.capacity;
    const auto read = [&]<typename T>(std::size_t array, T) {
        return submitter.readBuffer<T>(state, particles.size(), offsets[array] + first * sizeof(T));
    };
    for (std::size_t word = 0; word < kStateWords; ++word) {
        const auto words = read(word, std::uint64_t());
        for (std::size_t i = 0; i < particles.size(); ++i)
            std::memcpy(reinterpret_cast<char*>(&particles[i]) + word * sizeof words[i], &words[i],
                        sizeof words[i]);
    }
    if (mEffect.hasStrands) strands = read(kStateWords, std::uint32_t());
    return particles;
}

void GpuPopulation::writeParticles(gpu::Submitter& submitter, std::uint32_t instance,
                                   std::span<const Particle> particles,
                                   const std::vector<std::uint32_t>& strands,
                                   const Counters& counters) {
    BRUME_ASSERT_LE(particles.size(), mEffect.capacity);
    const auto offsets = stateOffsets();
    const std::uint64_t first = std::uint64_t{instance} * mEffect.capacity;
    std::array<std::vector<std::uint64_t>, kStateWords> words;
    for (const Particle& p : particles)
        for (std::size_t word = 0; word < kStateWords; ++word)
            std::memcpy(&words[word].emplace_back(),
                        reinterpret_cast<const char*>(&p) + word * sizeof(std::uint64_t),
                        sizeof(std::uint64_t));
    submitter.submitAndWait("particles.restore", [&](gpu::Commands& commands) {
        const auto write = [&]<typename T>(std::size_t array, const std::vector<T>& values) {
            commands.updateArray<T>(mStates[mCurrent], values, offsets[array] + first * sizeof(T));
        };
        for (std::size_t word = 0; word < kStateWords; ++word) write(word, words[word]);
        if (mEffect.hasStrands) write(kStateWords, strands);
        shader::TickTotals totals{};
        totals.counters = counters;
        totals.slots = slotCount();
        commands.updateBuffer(mTotals, &totals, sizeof totals, instance * sizeof totals);
        commands.computeTransferBarrier();
    });
}

}  // namespace brume::particles
