// SPDX-License-Identifier: Apache-2.0
#include <particles/instance_space.hpp>

#include <cmath>

namespace brume::particles {
namespace {

constexpr double kStep = 16;  // m, of the origin; floats of that size count in 1e-6 m; chosen by us

}  // namespace

ParticleFrame::ParticleFrame(const dmat4& worldFromEffect)
    : worldFromParticles(worldFromEffect), radiusScale(lengthScale(worldFromEffect)) {}

double lengthScale(const dmat4& transform) {
    return std::cbrt(std::fabs(glm::determinant(dmat3(transform))));
}

InstanceSpace::InstanceSpace(const scene::Placement& placement, double tickRate)
    : mTickRate(tickRate),
      mGiven(placement.worldFromObject),
      mBegin(dvec3(placement.at(0)[3])),
      mPath(placement.path) {
    // Relative, so that the same way gives the same bits wherever it begins.
    const dvec3 first = scene::offsetAt(mPath, 0);
    for (auto& key : mPath) key.second -= first;
}

dvec3 InstanceSpace::wayAt(std::uint64_t tick) const {
    const double seconds = static_cast<double>(tick) / mTickRate;
    return scene::offsetAt(mPath, seconds) + scene::offsetAt(mHosts, seconds);
}

dvec3 InstanceSpace::shiftAt(std::uint64_t tick) const {
    return glm::round(wayAt(tick) / kStep) * kStep;
}

dvec3 InstanceSpace::rebaseAt(std::uint64_t tick) const {
    return tick > 0 ? shiftAt(tick) - shiftAt(tick - 1) : dvec3(0);
}

void InstanceSpace::place(shader::BirthBatch& batch, std::uint64_t tick) const {
    const dmat3 linear(mGiven);
    const dvec3 end = wayAt(tick + 1);
    batch.offset = vec3(linear * dvec3(batch.offset) + (end - shiftAt(tick)));
    batch.motion = vec3(linear * dvec3(batch.motion) + (end - wayAt(tick)));
}

void InstanceSpace::setAxes(shader::InstanceParameters& parameters) const {
    parameters.axisX = vec3(dvec3(mGiven[0]));
    parameters.axisY = vec3(dvec3(mGiven[1]));
    parameters.axisZ = vec3(dvec3(mGiven[2]));
}

ParticleFrame InstanceSpace::frameAt(std::uint64_t ticks) const {
    ParticleFrame frame;
    const dvec3 shift = ticks > 0 ? shiftAt(ticks - 1) : dvec3(0);
    frame.worldFromParticles = glm::translate(dmat4(1), mBegin + shift);
    frame.radiusScale = lengthScale(mGiven);
    return frame;
}

bool InstanceSpace::moveTo(const dmat4& worldFromEffect, std::uint64_t from, std::uint64_t to) {
    if (worldFromEffect == mGiven) return false;
    const double begin = static_cast<double>(from) / mTickRate;
    const double end = static_cast<double>(std::max(to, from + 1)) / mTickRate;
    // What the origin of the last tick follows from stays.
    const double before = begin - 1 / mTickRate;
    const dvec3 there = scene::offsetAt(mHosts, before), here = scene::offsetAt(mHosts, begin);
    const dvec3 last = mHosts.empty() ? dvec3(0) : mHosts.back().second;
    mHosts = {{before, there},
              {begin, here},
              {end, last + dvec3(worldFromEffect[3] - mGiven[3])}};
    const bool isTurned = dmat3(worldFromEffect) != dmat3(mGiven);
    mGiven = worldFromEffect;
    return isTurned;
}

void InstanceSpace::rebase(const dvec3& newOrigin) {
    mBegin -= newOrigin;
    mGiven[3] -= dvec4(newOrigin, 0);
}

}  // namespace brume::particles
