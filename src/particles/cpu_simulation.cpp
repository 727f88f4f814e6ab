// SPDX-License-Identifier: Apache-2.0
#include <shaders/particles/spawn.h>
#include <shaders/particles/step.h>
#include <particles/cpu_simulation.hpp>

namespace brume::particles {

CpuSimulation::CpuSimulation(const scene::Effect& effect, std::uint64_t seed,
                             std::uint32_t instance)
    : mEffect(compileEffect(effect, seed, instance)), mSchedule(mEffect.schedule) {}

void CpuSimulation::step(std::uint64_t ticks) {
    for (; ticks > 0; --ticks) {
        const auto tick = static_cast<std::uint32_t>(mSchedule.tick());
        const TickBirths births = mSchedule.next();
        stepSurvivors(tick);
        appendBirths(births, tick);
        mCounters.alive = static_cast<std::uint32_t>(mParticles.size());
    }
}

void CpuSimulation::stepSurvivors(std::uint32_t tick) {
    std::size_t kept = 0;
    for (const Particle& old : mParticles) {
        if (!shader::isAlive(old.life, tick)) continue;
        Particle particle = old;
        shader::stepParticle(mEffect.parameters, mEffect.parameters.step, particle);
        mParticles[kept++] = particle;
    }
    mCounters.died += static_cast<std::uint32_t>(mParticles.size() - kept);
    mParticles.resize(kept);
}

void CpuSimulation::appendBirths(const TickBirths& births, std::uint32_t tick) {
    mCounters.born += births.count;
    mCounters.rejected += births.overflow;
    for (const shader::BirthBatch& batch : births.batches) {
        const shader::EmitterParameters& emitter = mEffect.emitters[batch.emitter];
        for (std::uint32_t i = 0; i < batch.count; ++i) {
            Particle particle =
                shader::spawnParticle(mEffect.parameters.random, emitter, batch, i, tick);
            if (!shader::isAlive(particle.life, tick)) {
                ++mCounters.died;
            } else if (mParticles.size() == mEffect.capacity) {
                --mCounters.born;
                ++mCounters.rejected;
            } else {
                shader::stepNewParticle(mEffect.parameters, mEffect.parameters.step, particle);
                mParticles.push_back(particle);
            }
        }
    }
}

void CpuSimulation::advanceTo(double seconds) {
    const std::uint64_t target = ticksAt(seconds, mEffect.tickRate);
    if (target < tick()) {
        mSchedule = mEffect.schedule;
        mParticles.clear();
        mCounters = {};
    }
    step(target - tick());
}

std::vector<scene::MediumSphere> CpuSimulation::spheres(const dmat4& worldFromEffect,
                                                        std::uint32_t medium,
                                                        std::uint32_t firstId) const {
    return makeSpheres(mEffect, mParticles, tick(), worldFromEffect, medium, firstId);
}

}  // namespace brume::particles
