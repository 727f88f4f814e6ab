// SPDX-License-Identifier: Apache-2.0
#include <render/effect_particles.hpp>

namespace brume::render {

using frame::Access;

std::uint32_t firstParticleId(std::size_t effect) {
    return static_cast<std::uint32_t>(effect + 1) << 24;
}

EffectParticles::EffectParticles(gpu::Submitter& submitter, const PreparedScene& prepared)
    : mPrepared(&prepared) {
    std::uint32_t instance = 0;
    for (const scene::EffectInstance& effect : prepared.scene.effects) {
        mSimulations.push_back(std::make_unique<particles::GpuSimulation>(
            submitter.device(), effect.effect, effect.seed, instance++));
        submitter.submitAndWait("simulate " + effect.file.filename().string(),
                                [&](gpu::Commands& commands) {
                                    mSimulations.back()->recordAdvanceTo(commands, effect.time);
                                });
    }
}

void EffectParticles::declare(frame::FrameBuilder& frame, const GpuScene& scene,
                              frame::BufferRef spheres) const {
    if (mSimulations.empty()) return;
    frame.addPass("particles.appearance")
        .readsWrites(spheres, Access::ComputeWrite)
        .record([this, &scene, spheres](gpu::Commands& commands,
                                        const frame::PassResources& resources) {
            for (std::size_t i = 0; i < mSimulations.size(); ++i) {
                const scene::EffectInstance& effect = mPrepared->scene.effects[i];
                mSimulations[i]->recordAppearance(commands,
                                                  {.worldFromEffect = effect.worldFromEffect,
                                                   .cameraPosition = scene.camera().position,
                                                   .medium = effect.medium,
                                                   .firstId = firstParticleId(i),
                                                   .spheres = &resources.buffer(spheres),
                                                   .firstSphere = scene.firstEffectSphere(i)});
            }
        });
}

std::vector<scene::MediumSphere> EffectParticles::readSpheres(gpu::Submitter& submitter) const {
    std::vector<scene::MediumSphere> spheres;
    for (std::size_t i = 0; i < mSimulations.size(); ++i) {
        const scene::EffectInstance& effect = mPrepared->scene.effects[i];
        const auto snapshot = mSimulations[i]->readState(submitter);
        const auto shown =
            particles::makeSpheres(mSimulations[i]->effect(), snapshot.particles, snapshot.tick,
                                   effect.worldFromEffect, effect.medium, firstParticleId(i));
        spheres.insert(spheres.end(), shown.begin(), shown.end());
    }
    return spheres;
}

std::uint64_t EffectParticles::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& simulation : mSimulations) sum += simulation->bytes();
    return sum;
}

}  // namespace brume::render
