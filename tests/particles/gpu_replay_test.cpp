// SPDX-License-Identifier: Apache-2.0
// The proof that every run on the GPU gives the bits of the twin: each module, each sub-emitter and
// all of them at once. Without the validation layer, which takes most of the time and watches the
// same shaders in gpu_simulation_test.cpp. scripts/prove_simulation runs the last test longer.
#include <gtest/gtest.h>
#include <particles/cpu_simulation.hpp>
#include <particles/gpu_simulation.hpp>
#include <particles/modules/module.hpp>

#include "effects.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>

namespace brume::particles {
namespace {

std::uint64_t numberFromEnvironment(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

class GpuReplayTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        sDevice = gpu::Device::create({}, Log());
        sSubmitter = std::make_unique<gpu::Submitter>(*sDevice);
    }
    static void TearDownTestSuite() {
        sSubmitter.reset();
        sDevice.reset();
    }

    static gpu::Device& device() { return *sDevice; }

    static void runTicks(GpuSimulation& simulation, std::uint64_t ticks) {
        // Long command buffers only cost memory.
        for (std::uint64_t left = ticks; left > 0;) {
            const std::uint64_t now = std::min<std::uint64_t>(left, 500);
            sSubmitter->submitAndWait(
                "ticks", [&](gpu::Commands& commands) { simulation.recordTicks(commands, now); });
            left -= now;
        }
    }

    static void restart(GpuSimulation& simulation) {
        sSubmitter->submitAndWait(
            "restart", [&](gpu::Commands& commands) { simulation.recordAdvanceTo(commands, 0); });
    }

    /// Particle by particle, in their order.
    static void expectSame(const GpuSimulation& gpu, const CpuSimulation& cpu) {
        const SimulationState state = gpu.readState(*sSubmitter);
        for (std::uint32_t p = 0; p < cpu.populationCount(); ++p) {
            SCOPED_TRACE(testing::Message() << "population " << p);
            const std::vector<Particle>&got = state.populations[p], &wanted = cpu.particles(p);
            ASSERT_EQ(got.size(), wanted.size());
            for (std::size_t i = 0; i < got.size(); ++i)
                ASSERT_EQ(std::memcmp(&got[i], &wanted[i], sizeof(Particle)), 0)
                    << "particle " << i;
            EXPECT_EQ(std::memcmp(&state.counters[p], &cpu.counters(p), sizeof(Counters)), 0);
        }
        EXPECT_EQ(state.hash(), cpu.hash());
    }

    static void expectSameAfter(const scene::Effect& effect, std::uint64_t ticks) {
        GpuSimulation gpu(device(), effect, 1);
        CpuSimulation cpu(effect, 1);
        runTicks(gpu, ticks);
        cpu.step(ticks);
        expectSame(gpu, cpu);
    }

    static std::unique_ptr<gpu::Device> sDevice;
    static std::unique_ptr<gpu::Submitter> sSubmitter;
};

std::unique_ptr<gpu::Device> GpuReplayTest::sDevice;
std::unique_ptr<gpu::Submitter> GpuReplayTest::sSubmitter;

TEST(ReplayedEffect, UsesEveryReplayableModule) {
    std::set<std::string> used;
    for (const scene::ModuleSettings& module : fullEffect().modules) used.insert(module.type);
    for (const Module& module : modules())
        EXPECT_EQ(used.count(module.info.name), module.info.isReplayable ? 1u : 0u)
            << module.info.name;
}

TEST_F(GpuReplayTest, EachModuleAlone_GivesTheBitsOfTheTwin) {
    std::map<std::string, std::vector<scene::ModuleSettings>> byType;
    for (const scene::ModuleSettings& module : fullEffect().modules)
        byType[module.type].push_back(module);
    for (const auto& [type, modules] : byType) {
        SCOPED_TRACE(type);
        scene::Effect effect = fullEffect(500);
        effect.subEmitters.clear();
        // Gravity and drag bring particles to colliders.
        effect.modules.resize(2);
        if (type != "gravity" && type != "drag")
            effect.modules.insert(effect.modules.end(), modules.begin(), modules.end());
        expectSameAfter(effect, 70);
    }
}

TEST_F(GpuReplayTest, EachSubEmitterAlone_GivesTheBitsOfTheTwin) {
    for (const scene::SubEmitter& sub : fullEffect(500).subEmitters) {
        scene::Effect effect = fullEffect(500);
        effect.modules.resize(2);
        effect.modules.push_back(moduleSettings("collide_plane"));
        effect.subEmitters = {sub};
        SCOPED_TRACE(static_cast<int>(sub.trigger));
        expectSameAfter(effect, 100);
        CpuSimulation cpu(effect, 1);
        cpu.step(100);
        EXPECT_GT(cpu.counters(1).born, 100u);
    }
}

TEST_F(GpuReplayTest, Everything_GivesTheBitsOfTheTwin) {
    GpuSimulation gpu(device(), fullEffect(), 8);
    CpuSimulation cpu(fullEffect(), 8);
    for (const int ticks : {1, 20, 100}) {
        runTicks(gpu, static_cast<std::uint64_t>(ticks));
        cpu.step(static_cast<std::uint64_t>(ticks));
        expectSame(gpu, cpu);
    }
    for (std::uint32_t p = 0; p < cpu.populationCount(); ++p)
        EXPECT_GT(cpu.counters(p).alive, 50u) << p;
}

TEST_F(GpuReplayTest, EveryModuleInEveryRunAndWorkgroupSize_GivesTheHashOfTheTwin) {
    const std::uint64_t ticks = numberFromEnvironment("BRUME_PROOF_TICKS", 200);
    const std::uint64_t runs = numberFromEnvironment("BRUME_PROOF_RUNS", 4);
    constexpr std::uint32_t kSizes[] = {64, 7, 32, 128, 256};
    const std::uint64_t sizeCount = std::min<std::uint64_t>(runs, runs < 10 ? 2 : 5);
    const scene::Effect effect = fullEffect(40);
    CpuSimulation cpu(effect, 21);
    cpu.step(ticks);
    for (std::uint64_t s = 0; s < sizeCount; ++s) {
        GpuSimulation gpu(device(), effect, 21, 0, {.workgroupSize = kSizes[s]});
        for (std::uint64_t run = s; run < runs; run += sizeCount) {
            restart(gpu);
            runTicks(gpu, ticks);
            const SimulationState state = gpu.readState(*sSubmitter);
            EXPECT_EQ(state.hash(), cpu.hash()) << "workgroups of " << kSizes[s];
            std::printf("%llu ticks in workgroups of %u: hash %016llx, twin %016llx\n",
                        static_cast<unsigned long long>(ticks), kSizes[s],
                        static_cast<unsigned long long>(state.hash()),
                        static_cast<unsigned long long>(cpu.hash()));
            std::fflush(stdout);
        }
    }
    for (std::uint32_t p = 0; p < cpu.populationCount(); ++p)
        if (ticks >= 200) {
            EXPECT_GT(cpu.counters(p).born, 5u) << p;
        }
}

TEST_F(GpuReplayTest, HundredThousandAt500MetresPerSecond_NonePassesAThinPlane) {
    scene::Effect effect = burstEffect(100000, 500, {1, -1, 0.2});
    effect.emitters[0].position = {0, 3, 0};
    effect.emitters[0].spread = 0.6;
    effect.modules = {moduleSettings("gravity"), moduleSettings("collide_plane")};
    GpuSimulation gpu(device(), effect, 1);
    runTicks(gpu, 20);
    const SimulationState state = gpu.readState(*sSubmitter);
    ASSERT_EQ(state.counters[0].alive, 100000u);
    std::size_t passed = 0, bounced = 0;
    for (const Particle& p : state.populations[0]) {
        passed += p.position.y < 0;
        bounced += p.velocity.y > 0;
    }
    EXPECT_EQ(passed, 0u);
    EXPECT_GT(bounced, 99000u);
    CpuSimulation cpu(effect, 1);
    cpu.step(20);
    expectSame(gpu, cpu);
}

TEST_F(GpuReplayTest, TwentyRuns_GiveTheSameHash) {
    CpuSimulation cpu(busyEffect(), 5);
    cpu.step(60);
    for (int fresh = 0; fresh < 2; ++fresh) {
        GpuSimulation gpu(device(), busyEffect(), 5);
        for (int run = 0; run < 10; ++run) {
            restart(gpu);
            runTicks(gpu, 60);
            EXPECT_EQ(gpu.readState(*sSubmitter).hash(), cpu.hash());
        }
    }
}

TEST_F(GpuReplayTest, AnyWorkgroupAndChunkSize_GiveTheSameBits) {
    CpuSimulation cpu(busyEffect(), 2);
    cpu.step(150);
    for (const GpuSimulationOptions options :
         {GpuSimulationOptions{1, 64}, {7, 64}, {64, 4096}, {256, 5}, {256, 1}}) {
        SCOPED_TRACE(testing::Message() << options.workgroupSize << " x " << options.chunkSize);
        GpuSimulation gpu(device(), busyEffect(), 2, 0, options);
        runTicks(gpu, 150);
        expectSame(gpu, cpu);
    }
}

TEST_F(GpuReplayTest, CapacitiesAroundChunkBorders_GiveTheBitsOfTheTwin) {
    for (const std::uint32_t capacity : {1u, 2u, 127u, 128u, 129u, 1000u}) {
        GpuSimulation gpu(device(), busyEffect(capacity), 2, 0, {.chunkSize = 64});
        CpuSimulation cpu(busyEffect(capacity), 2);
        runTicks(gpu, 130);
        cpu.step(130);
        EXPECT_GT(cpu.counters().rejected, 0u);
        expectSame(gpu, cpu);
    }
}

}  // namespace
}  // namespace brume::particles
