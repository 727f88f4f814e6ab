// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <shaders/particles/appearance.h>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

#include <cmath>
#include <map>

namespace brume::particles {
namespace {

constexpr double kDistance = 50;
constexpr std::uint32_t kCount = 20000;

scene::Effect thinnedEffect(double least = 0.01) {
    scene::Effect effect = burstEffect(kCount);
    effect.thinning = {kDistance, least};
    return effect;
}

/// All particles at the origin, seen from a distance.
std::vector<scene::MediumSphere> seenFrom(const CpuSimulation& simulation, double distance,
                                          bool hasDistance = true) {
    return simulation.spheres(dmat4(1), 0, 0, 0, Viewer{{0, 0, distance}, hasDistance});
}

TEST(Thinning, KeptShare_IsTheMeanOfTheKeptParts) {
    for (const float edge : {1.3333f, 1.2f, 1.0f, 0.9f, 0.3f, 0.01f}) {
        double sum = 0;
        constexpr int kRanks = 100000;
        for (int i = 0; i < kRanks; ++i)
            sum += shader::keptPart(edge, (static_cast<float>(i) + 0.5f) / kRanks);
        EXPECT_NEAR(sum / kRanks, shader::keptShare(edge), 1e-5) << edge;
    }
}

TEST(Thinning, Near_ChangesNothing) {
    CpuSimulation simulation(thinnedEffect(), 1);
    simulation.step(1);
    const auto plain = simulation.spheres(dmat4(1), 0, 0);
    for (const auto& near : {seenFrom(simulation, 0.9 * kDistance), seenFrom(simulation, 1e5, false)}) {
        ASSERT_EQ(near.size(), plain.size());
        for (std::size_t i = 0; i < plain.size(); ++i) {
            ASSERT_FLOAT_EQ(near[i].radius, plain[i].radius);
            ASSERT_NEAR(near[i].density, plain[i].density, 1e-5);
        }
    }
}

TEST(Thinning, FarAway_KeepsOpticalDepthInExpectationWithFewerParticles) {
    CpuSimulation simulation(thinnedEffect(), 1);
    simulation.step(1);
    // Seen from one side, a sphere's optical depth times its area.
    const auto depthOf = [](const std::vector<scene::MediumSphere>& spheres) {
        double sum = 0;
        for (const scene::MediumSphere& s : spheres) sum += double{s.density} * std::pow(s.radius, 3);
        return sum;
    };
    const double all = depthOf(simulation.spheres(dmat4(1), 0, 0));
    for (const double distance : {55.0, 70.0, 100.0, 200.0, 400.0}) {
        const auto spheres = seenFrom(simulation, distance);
        const double share = std::pow(kDistance / distance, 2);
        EXPECT_NEAR(static_cast<double>(spheres.size()), kCount * std::min(4 * share / 3, 1.0),
                    4 * std::sqrt(kCount * share));
        // Five standard deviations of the number that is kept.
        EXPECT_NEAR(depthOf(spheres) / all, 1, 5 / std::sqrt(kCount * share)) << distance;
    }
    EXPECT_NEAR(static_cast<double>(seenFrom(simulation, 1e6).size()), kCount * 0.01 / 0.875, 80);
}

TEST(Thinning, WithGrowingDistance_NothingPops) {
    CpuSimulation simulation(thinnedEffect(), 1);
    simulation.step(1);
    const auto depthsAt = [&](double distance) {
        std::map<std::uint32_t, double> depths;
        for (const scene::MediumSphere& s : seenFrom(simulation, distance))
            depths[s.id] = double{s.density} * s.radius;
        return depths;
    };
    std::map<std::uint32_t, double> before = depthsAt(45);
    const double whole = before.begin()->second;
    for (double distance = 45; distance < 300; distance *= 1.007) {
        const std::map<std::uint32_t, double> now = depthsAt(distance);
        for (const auto& [id, depth] : now) {
            // Who is there farther away was there nearer by.
            ASSERT_TRUE(before.contains(id)) << distance;
            ASSERT_LE(depth, before[id] * (1 + 1e-5));
        }
        for (const auto& [id, depth] : before) {
            const auto found = now.find(id);
            const double after = found == now.end() ? 0 : found->second;
            ASSERT_LT(depth - after, 0.07 * whole) << distance;
        }
        before = now;
    }
}

}  // namespace
}  // namespace brume::particles
