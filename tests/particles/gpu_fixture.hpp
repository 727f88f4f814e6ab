// SPDX-License-Identifier: Apache-2.0
// What tests of the simulator on the GPU share.
#pragma once

#include <gtest/gtest.h>
#include <particles/cpu_simulation.hpp>
#include <particles/gpu_simulation.hpp>

#include <cstring>

namespace brume::particles {

/// A device with validation; a message fails the test.
class GpuSimulationTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        sDevice = gpu::Device::create({.device = {},
                                       .validate = true,
                                       .synchronizationValidation = true,
                                       .pipelineCacheFile = {},
                                       .keepPipelines = true},
                                      Log());
        sSubmitter = std::make_unique<gpu::Submitter>(*sDevice);
    }
    static void TearDownTestSuite() {
        sSubmitter.reset();
        sDevice.reset();
    }
    void TearDown() override {
        for (const std::string& message : sDevice->validationMessages()) ADD_FAILURE() << message;
    }

    gpu::Device& device() { return *sDevice; }

    void runTicks(GpuSimulation& simulation, std::uint64_t ticks) {
        sSubmitter->submitAndWait(
            "ticks", [&](gpu::Commands& commands) { simulation.recordTicks(commands, ticks); });
    }

    /// Names the first particle that differs.
    void expectSame(const GpuSimulation& gpu, const CpuSimulation& cpu) {
        const SimulationState snapshot = gpu.readState(*sSubmitter);
        EXPECT_EQ(snapshot.tick, cpu.tick());
        for (std::uint32_t p = 0; p < cpu.populationCount(); ++p) {
            SCOPED_TRACE(testing::Message() << "population " << p);
            const Counters &a = snapshot.counters[p], &b = cpu.counters(p);
            EXPECT_EQ(a.alive, b.alive);
            EXPECT_EQ(a.born, b.born);
            EXPECT_EQ(a.died, b.died);
            EXPECT_EQ(a.rejected, b.rejected);
            EXPECT_EQ(a.killed, b.killed);
            EXPECT_LE(a.alive, gpu.slotCount(p));
            expectSame(snapshot.populations[p], cpu.particles(p));
        }
        EXPECT_EQ(snapshot.hash(), cpu.hash());
    }

    static void expectSame(const std::vector<Particle>& got, const std::vector<Particle>& wanted) {
        ASSERT_EQ(got.size(), wanted.size());
        for (std::size_t i = 0; i < got.size(); ++i) {
            const Particle &p = got[i], &q = wanted[i];
            ASSERT_EQ(std::memcmp(&p, &q, sizeof p), 0)
                << "particle " << i << ", birth " << p.birthIndex << " and " << q.birthIndex
                << ", position " << p.position.x << " " << p.position.y << " " << p.position.z
                << " and " << q.position.x << " " << q.position.y << " " << q.position.z
                << ", velocity " << p.velocity.x << " " << p.velocity.y << " " << p.velocity.z
                << " and " << q.velocity.x << " " << q.velocity.y << " " << q.velocity.z
                << ", lifetime " << p.life.lifetimeTicks << " and " << q.life.lifetimeTicks;
        }
    }

    static inline std::unique_ptr<gpu::Device> sDevice;
    static inline std::unique_ptr<gpu::Submitter> sSubmitter;
};

}  // namespace brume::particles
