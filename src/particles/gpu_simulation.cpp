// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <particles/gpu_simulation.hpp>

#include <algorithm>

namespace brume::particles {

GpuSimulation::GpuSimulation(gpu::Device& device, const scene::Effect& effect,
                             std::span<const EffectInstance> instances,
                             const GpuSimulationOptions& options) {
    for (CompiledEffect& compiled : compileEffect(effect)) {
        const auto population = static_cast<std::uint32_t>(mPopulations.size());
        const GpuPopulation* parent =
            compiled.isChild() ? mPopulations[compiled.parent].get() : nullptr;
        mPopulations.push_back(std::make_unique<GpuPopulation>(
            device, std::move(compiled), population, instances, options, parent));
    }
}

GpuSimulation::GpuSimulation(gpu::Device& device, const scene::Effect& effect, std::uint64_t seed,
                             std::uint32_t instance, const GpuSimulationOptions& options)
    : GpuSimulation(device, effect, std::array{EffectInstance{seed, instance}}, options) {}

void GpuSimulation::restart(std::uint64_t tick) {
    mTick = tick;
    for (const auto& population : mPopulations) population->restart(tick);
    mMustClear = true;
}

void GpuSimulation::recordAdvanceTo(gpu::Commands& commands, double seconds) {
    const double tickRate = effect().tickRate;
    const std::uint64_t target = ticksAt(seconds, tickRate);
    if (target < mTick) restart(0);
    const std::uint64_t jump = jumpTick(effect(), target);
    if (jump > mTick) restart(jump);
    recordTicks(commands, target - mTick);
    mSinceTick = tickFractionAt(seconds, tickRate);
}

void GpuSimulation::recordTicks(gpu::Commands& commands, std::uint64_t ticks) {
    mSinceTick = 0;
    if (ticks == 0) return;
    commands.beginLabel("particles.simulate");
    // Whatever read the buffers below before is done with them.
    commands.computeTransferBarrier();
    if (mMustClear)
        for (const auto& population : mPopulations) population->recordClear(commands, mTick);
    mMustClear = false;
    for (const std::uint64_t end = mTick + ticks; mTick < end;) {
        // Children follow their root tick by tick; only that knows how many fit.
        std::uint64_t most = end - mTick;
        for (const auto& population : mPopulations) {
            const TickPart& part = population->schedulePart(mTick, most);
            if (population == mPopulations.front()) most = part.ticks.size();
            population->recordUpload(commands, part);
        }
        commands.computeTransferBarrier();
        for (std::uint32_t slot = 0; slot < most; ++slot)
            for (std::size_t i = 0; i < mPopulations.size(); ++i) {
                const shader::Tick& tick = mPopulations[i]->part().ticks[slot];
                mPopulations[i]->recordTick(commands, tick, slot);
                for (const std::uint32_t child : mPopulations[i]->effect().children)
                    mPopulations[i]->recordChildren(commands, tick, slot, *mPopulations[child]);
            }
        commands.computeTransferBarrier();
        mTick += most;
    }
    commands.endLabel();
}

void GpuSimulation::recordAppearance(gpu::Commands& commands, const Appearance& appearance) {
    const GpuPopulation& population = *mPopulations[appearance.population];
    if (population.slotCount() == 0) return;
    const CompiledEffect& compiled = population.effect();
    const dmat4& m = appearance.worldFromEffect;
    shader::AppearancePush push{};
    push.axisX = vec3(dvec3(m[0]));
    push.axisY = vec3(dvec3(m[1]));
    push.axisZ = vec3(dvec3(m[2]));
    const dvec3 origin = dvec3(m[3]) - appearance.cameraPosition;
    push.origin = vec3(origin);
    push.originLo = vec3(origin - dvec3(push.origin));
    push.radiusScale = static_cast<float>(lengthScale(m));
    push.firstSphere = appearance.firstSphere;
    push.lastTick = static_cast<std::uint32_t>(mTick - 1);
    push.medium = appearance.medium;
    push.firstId = appearance.firstId;
    push.profile = static_cast<std::uint32_t>(compiled.profile);
    push.isShadowedWhole = compiled.shadowing == scene::Shadowing::Particle;
    push.instance = appearance.instance;
    push.firstSlot = appearance.instance * compiled.capacity;
    push.sinceTick = static_cast<float>(mSinceTick);
    push.sinceTickSeconds = static_cast<float>(mSinceTick / compiled.tickRate);

    commands.beginLabel("particles.appearance");
    population.recordAppearance(commands, *appearance.spheres, push);
    commands.endLabel();
}

std::vector<CompiledEffect> GpuSimulation::effects() const {
    std::vector<CompiledEffect> effects;
    for (const auto& population : mPopulations) effects.push_back(population->effect());
    return effects;
}

std::uint64_t GpuSimulation::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& population : mPopulations) sum += population->bytes();
    return sum;
}

SimulationState GpuSimulation::readState(gpu::Submitter& submitter, std::uint32_t instance) const {
    BRUME_ASSERT_LT(instance, instanceCount());
    SimulationState snapshot;
    snapshot.tick = mTick;
    for (const auto& population : mPopulations) {
        Counters counters{};
        std::vector<Particle> particles;
        std::vector<std::uint32_t> strands;
        if (!mMustClear)
            particles = population->readParticles(submitter, instance, counters, strands);
        snapshot.strands.push_back(std::move(strands));
        snapshot.populations.push_back(std::move(particles));
        snapshot.counters.push_back(counters);
    }
    return snapshot;
}

void GpuSimulation::writeState(gpu::Submitter& submitter, std::span<const SimulationState> states) {
    BRUME_ASSERT_EQ(states.size(), instanceCount());
    mTick = states[0].tick;
    mSinceTick = 0;
    for (std::uint32_t p = 0; p < mPopulations.size(); ++p) {
        mPopulations[p]->restart(mTick);
        for (std::uint32_t i = 0; i < states.size(); ++i) {
            BRUME_ASSERT_EQ(states[i].tick, mTick);
            mPopulations[p]->writeParticles(submitter, i, states[i].populations[p],
                                            states[i].strands[p], states[i].counters[p]);
        }
    }
    mMustClear = false;
}

}  // namespace brume::particles
