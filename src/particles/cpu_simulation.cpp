// SPDX-License-Identifier: Apache-2.0
#include <shaders/particles/children.h>
#include <core/assert.hpp>
#include <particles/cpu_simulation.hpp>

#include <algorithm>
#include <utility>

namespace brume::particles {

CpuSimulation::CpuSimulation(const scene::Effect& effect, std::uint64_t seed,
                             std::uint32_t instance, const scene::Placement& placement)
    : mSpace(placement, effect.tickRate) {
    std::vector<CompiledEffect> populations = compileEffect(effect);
    requireReplayable(populations, "simulating on the CPU");
    for (CompiledEffect& compiled : populations) {
        Population& population = mPopulations.emplace_back(Population{.effect = compiled});
        population.instance = instanceParameters(
            seed, instance, static_cast<std::uint32_t>(mPopulations.size() - 1));
        mSpace.setAxes(population.instance);
    }
}

void CpuSimulation::step(std::uint64_t ticks) {
    for (; ticks > 0; --ticks) {
        // Parents come before their children, which are born in the same tick.
        for (Population& population : mPopulations) stepPopulation(population);
        ++mTick;
    }
    mSinceTick = 0;
}

void CpuSimulation::stepPopulation(Population& population) {
    const bool isWorld = population.effect.isWorldSpace();
    const shader::TickFields fields =
        tickFields(population.effect, mTick, isWorld ? mSpace.shiftAt(mTick) : dvec3(0));
    TickBirths births = population.effect.isChild() ? std::exchange(population.asked, {})
                                                    : population.effect.schedule.at(mTick);
    if (isWorld) {
        const vec3 rebase(mSpace.rebaseAt(mTick));
        for (Particle& particle : population.particles) particle.position -= rebase;
        if (!population.effect.isChild())
            for (shader::BirthBatch& batch : births.batches) mSpace.place(batch, mTick);
    }
    stepSurvivors(population, fields);
    appendBirths(population, fields, births);
    population.counters.alive = static_cast<std::uint32_t>(population.particles.size());
}

void CpuSimulation::follow(Population& population, const shader::TickFields& fields, bool isBirth,
                           bool survives, Particle& particle) {
    const CompiledEffect& effect = population.effect;
    const shader::ParticleTick event = shader::followTick(
        effect.parameters, effect.fieldValues.data(), effect.parameters.step, fields, population.instance.noiseSeed,
        static_cast<std::uint32_t>(mTick), isBirth, survives, particle);
    for (std::uint32_t k = 0; k < effect.subEmitterCount; ++k) {
        shader::BirthBatch batch = shader::childrenOf(effect.parameters.subEmitters[k],
                                                      population.instance.random, event);
        if (batch.count == 0) continue;
        Population& child = mPopulations[effect.children[k]];
        const std::uint32_t asked = child.asked.count + child.asked.overflow;
        batch.first = asked;
        batch.firstBirthIndex = child.counters.born + child.counters.rejected + asked;
        const std::uint32_t kept =
            std::min(batch.count, child.effect.capacity - child.asked.count);
        child.asked.count += kept;
        child.asked.overflow += batch.count - kept;
        batch.count = kept;
        child.asked.batches.push_back(batch);
    }
}

void CpuSimulation::stepSurvivors(Population& population, const shader::TickFields& fields) {
    const auto tick = static_cast<std::uint32_t>(mTick);
    std::vector<Particle>& particles = population.particles;
    const bool hasStrands = population.effect.hasStrands;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Particle& old = particles[i];
        const bool survives = shader::isAlive(old.life, tick);
        if (!survives && population.effect.subEmitterCount == 0) continue;
        Particle particle = old;
        follow(population, fields, false, survives, particle);
        if (!survives) continue;
        population.counters.killed += particle.life.lifetimeTicks == shader::kNotFinite;
        if (hasStrands) population.strands[kept] = population.strands[i];
        particles[kept++] = particle;
    }
    if (hasStrands) population.strands.resize(kept);
    population.counters.died += static_cast<std::uint32_t>(particles.size() - kept);
    particles.resize(kept);
}

void CpuSimulation::appendBirths(Population& population, const shader::TickFields& fields,
                                 const TickBirths& births) {
    const auto tick = static_cast<std::uint32_t>(mTick);
    const CompiledEffect& effect = population.effect;
    Counters& counters = population.counters;
    counters.born += births.count;
    counters.rejected += births.overflow;
    for (const shader::BirthBatch& batch : births.batches)
        for (std::uint32_t i = 0; i < batch.count; ++i) {
            Particle particle =
                shader::spawnFromBatch(effect.parameters, effect.fieldValues.data(),
                                       effect.triangles.data(), population.instance,
                                       effect.emitters[batch.emitter], batch, i, tick);
            const bool survives = shader::isAlive(particle.life, tick);
            const bool isFull = population.particles.size() == effect.capacity;
            if (!isFull && (survives || effect.subEmitterCount > 0))
                follow(population, fields, true, survives, particle);
            if (!survives) {
                ++counters.died;
            } else if (isFull) {
                --counters.born;
                ++counters.rejected;
            } else {
                counters.killed += particle.life.lifetimeTicks == shader::kNotFinite;
                population.particles.push_back(particle);
                if (effect.hasStrands) population.strands.push_back(batch.strand);
            }
        }
}

void CpuSimulation::restart() {
    mTick = 0;
    for (Population& population : mPopulations) {
        population.particles.clear();
        population.strands.clear();
        population.counters = {};
        population.asked = {};
    }
}

void CpuSimulation::jump(std::uint64_t target) {
    const std::uint64_t tick = jumpTick(effect(), target, mTick);
    if (tick <= mTick) return;
    restart();
    mTick = tick;
    Counters& counters = mPopulations[0].counters;
    counters.born = static_cast<std::uint32_t>(effect().schedule.birthsBefore(tick));
    counters.died = counters.born;
}

void CpuSimulation::advanceTo(double seconds) {
    const double tickRate = effect().tickRate;
    const std::uint64_t target = ticksAt(seconds, tickRate);
    if (target < mTick) restart();
    jump(target);
    step(target - mTick);
    mSinceTick = tickFractionAt(seconds, tickRate);
}

std::uint64_t CpuSimulation::hash() const { return state().hash(); }

SimulationState CpuSimulation::state() const {
    SimulationState state;
    state.tick = mTick;
    for (const Population& population : mPopulations) {
        state.populations.push_back(population.particles);
        state.strands.push_back(population.strands);
        state.counters.push_back(population.counters);
    }
    return state;
}

void CpuSimulation::restore(const SimulationState& state) {
    BRUME_ASSERT_EQ(state.populations.size(), mPopulations.size());
    mTick = state.tick;
    mSinceTick = 0;
    for (std::size_t i = 0; i < mPopulations.size(); ++i) {
        mPopulations[i].particles = state.populations[i];
        mPopulations[i].strands = state.strands[i];
        mPopulations[i].counters = state.counters[i];
        mPopulations[i].asked = {};
    }
}

ParticleFrame CpuSimulation::frame(const dmat4& worldFromEffect) const {
    return effect().isWorldSpace() ? mSpace.frameAt(mTick) : ParticleFrame(worldFromEffect);
}

std::vector<scene::MediumSphere> CpuSimulation::spheres(const ParticleFrame& frame,
                                                        std::uint32_t medium,
                                                        std::uint32_t firstId,
                                                        std::uint32_t population,
                                                        const std::optional<Viewer>& viewer) const {
    return makeSpheres(effect(population), particles(population), mTick, mSinceTick, frame, medium,
                       firstId, mPopulations[population].instance.random, viewer);
}

}  // namespace brume::particles
