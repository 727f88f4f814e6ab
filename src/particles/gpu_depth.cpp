// SPDX-License-Identifier: Apache-2.0
// Collision with the depth of a picture, after each tick.
#include <core/assert.hpp>
#include <particles/gpu_simulation.hpp>

#include <algorithm>

namespace brume::particles {
namespace {

shader::DepthPlace makePlace(const dmat4& worldFromEffect, const dvec3& cameraPosition) {
    const dmat3 linear(worldFromEffect), inverse = glm::inverse(linear);
    return {.axisX = vec3(linear[0]),
            .axisY = vec3(linear[1]),
            .axisZ = vec3(linear[2]),
            .origin = vec3(dvec3(worldFromEffect[3]) - cameraPosition),
            .inverseX = vec3(inverse[0]),
            .inverseY = vec3(inverse[1]),
            .inverseZ = vec3(inverse[2]),
            .scale = static_cast<float>(lengthScale(worldFromEffect))};
}

}  // namespace

bool GpuSimulation::wantsSceneDepth() const {
    return std::any_of(mPopulations.begin(), mPopulations.end(), [](const auto& population) {
        return population->effect().depthCollider.has_value();
    });
}

void GpuSimulation::recordSceneDepth(gpu::Commands& commands, const SceneDepth& depth,
                                     std::span<const dmat4> worldFromEffect) {
    BRUME_ASSERT_EQ(worldFromEffect.size(), instanceCount());
    std::vector<shader::DepthPlace> places;
    for (const dmat4& transform : worldFromEffect)
        places.push_back(makePlace(transform, depth.camera.position));
    commands.computeTransferBarrier();
    for (const auto& population : mPopulations)
        population->recordSceneDepth(commands, depth, places);
    commands.computeTransferBarrier();
}

void GpuPopulation::recordSceneDepth(gpu::Commands& commands, const SceneDepth& depth,
                                     std::span<const shader::DepthPlace> places) {
    if (!mEffect.depthCollider) return;
    mSceneDepth = depth;
    const scene::CameraFrame& camera = depth.camera;
    const shader::DepthCollision collision{
        .collider = *mEffect.depthCollider,
        .restSpeed = mEffect.parameters.step.restSpeed,
        .instances = mInstanceCount,
        .capacity = mEffect.capacity,
        .right = vec3(camera.right),
        .extentX = static_cast<float>(camera.extentX),
        .up = vec3(camera.up),
        .extentY = static_cast<float>(camera.extentY),
        .forward = vec3(camera.forward),
        .isOrthographic = camera.type == scene::CameraType::Orthographic,
        .size = {static_cast<std::uint32_t>(camera.width),
                 static_cast<std::uint32_t>(camera.height)}};
    commands.updateArray<shader::DepthCollision>(mDepthCollision, {&collision, 1});
    commands.updateArray(mDepthCollision, places, sizeof collision);
}

void GpuPopulation::recordDepthCollision(gpu::Commands& commands, std::uint32_t slots) {
    if (!mSceneDepth || slots == 0) return;
    bindAll(commands, mCollideDepth);
    commands.bind(shader::kBindingSceneDepth, *mSceneDepth->distance, *mSceneDepth->sampler);
    commands.dispatchThreads(std::uint64_t{slots} * mInstanceCount, mWorkgroupSize);
    commands.computeBarrier();
}

}  // namespace brume::particles
