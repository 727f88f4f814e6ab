// SPDX-License-Identifier: Apache-2.0
// How the particles of all instances become spheres, in one dispatch per population.
#include <core/assert.hpp>
#include <particles/gpu_simulation.hpp>

namespace brume::particles {
namespace {

shader::AppearancePlace makePlace(const GpuSimulation::Appearance& appearance,
                                  const dvec3& cameraPosition) {
    const dmat4& m = appearance.frame.worldFromParticles;
    const dvec3 origin = dvec3(m[3]) - cameraPosition;
    shader::AppearancePlace place{};
    place.axisX = vec3(dvec3(m[0]));
    place.axisY = vec3(dvec3(m[1]));
    place.axisZ = vec3(dvec3(m[2]));
    place.origin = vec3(origin);
    place.originLo = roundingOf(origin);
    place.radiusScale = static_cast<float>(appearance.frame.radiusScale);
    place.firstSphere = appearance.firstSphere;
    place.medium = appearance.medium;
    place.firstId = appearance.firstId;
    return place;
}

}  // namespace

void GpuSimulation::recordAppearance(gpu::Commands& commands, std::uint32_t population,
                                     const Viewer& viewer,
                                     std::span<const Appearance> appearances,
                                     const gpu::Buffer& spheres) {
    BRUME_ASSERT_EQ(appearances.size(), instanceCount());
    if (slotCount(population) == 0) return;
    mAppearancePlaces.clear();
    for (const Appearance& appearance : appearances)
        mAppearancePlaces.push_back(makePlace(appearance, viewer.position));
    const CompiledEffect& compiled = effect(population);
    shader::AppearanceFrame frame{};
    frame.instances = instanceCount();
    frame.capacity = compiled.capacity;
    frame.lastTick = static_cast<std::uint32_t>(mTick - 1);
    frame.sinceTick = static_cast<float>(mSinceTick);
    frame.sinceTickSeconds = static_cast<float>(mSinceTick / compiled.tickRate);
    frame.isShadowedWhole = compiled.shadowing == scene::Shadowing::Particle;
    frame.distanceScale = viewer.hasDistance ? 1.0f : 0.0f;
    frame.profile = static_cast<std::uint32_t>(compiled.profile);
    commands.beginLabel("particles.appearance");
    mPopulations[population]->recordAppearance(commands, spheres, frame, mAppearancePlaces);
    commands.endLabel();
}

void GpuPopulation::recordAppearance(gpu::Commands& commands, const gpu::Buffer& spheres,
                                     const shader::AppearanceFrame& frame,
                                     std::span<const shader::AppearancePlace> places) const {
    // What has read the places before is done with them.
    commands.computeTransferBarrier();
    commands.updateArray<shader::AppearanceFrame>(mAppearanceData, {&frame, 1});
    commands.updateArray(mAppearanceData, places, sizeof frame);
    commands.computeTransferBarrier();
    bindAll(commands, mAppearance);
    commands.bind(shader::kBindingParticleSpheres, spheres);
    commands.dispatchThreads(std::uint64_t{slotCount()} * mInstanceCount, mWorkgroupSize);
    commands.computeBarrier();
}

}  // namespace brume::particles
