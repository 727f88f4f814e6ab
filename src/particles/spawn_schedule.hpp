// SPDX-License-Identifier: Apache-2.0
// Which particles are born in which tick, and when within it; in integers, so that no birth is ever
// lost or doubled.
#pragma once

#include <shaders/particles/effect.h>
#include <scene/effect.hpp>

#include <cstdint>
#include <deque>
#include <vector>

namespace brume::particles {

/// The births of one tick, in order of their birth indices.
struct TickBirths {
    std::vector<shader::BirthBatch> batches;
    std::uint32_t count = 0;     ///< sum over the batches, at most the capacity
    std::uint32_t overflow = 0;  ///< asked for beyond that: rejected at once
};

/// Walks through the ticks of an effect. A rate gives floor(rate * t) births in the first t
/// seconds, the i-th (from 0) at (i + 1) / rate; a burst at time b is born in the tick that
/// contains b. Rates and times count in millionths. Within a tick emitters follow each other, each
/// with its bursts first.
class SpawnSchedule {
  public:
    explicit SpawnSchedule(const scene::Effect& effect);

    std::uint64_t tick() const { return mTick; }  ///< that next() will give
    TickBirths next();

    /// No tick has more batches.
    std::uint32_t maxBatchesPerTick() const { return mMaxBatches; }

  private:
    struct Burst {
        std::uint64_t tick = 0;
        float remaining = 0;
        std::uint32_t count = 0;
    };
    struct Emitter {
        std::uint64_t rateMicro = 0;  // births per 1e6 s
        std::uint64_t phase = 0;      // (rate * ticks so far) mod tick rate, in millionths
        std::uint64_t left = 0;       // births until the duration ends
        std::vector<Burst> bursts;    // by tick
        std::size_t nextBurst = 0;
    };

    void addBursts(std::uint32_t emitterIndex, TickBirths& births);
    void addRate(std::uint32_t emitterIndex, TickBirths& births);
    void addBatch(std::uint32_t emitterIndex, std::uint64_t count, float remaining, float step,
                  TickBirths& births);

    std::vector<Emitter> mEmitters;
    std::uint64_t mTickRateMicro = 0;
    std::uint64_t mTick = 0;
    std::uint64_t mNextBirthIndex = 0;
    std::uint32_t mCapacity = 0;
    std::uint32_t mMaxBatches = 0;
};

/// How many particles can be alive at most, from births and the longest lifetime alone; for a
/// caller that cannot look.
class AliveBound {
  public:
    AliveBound(std::uint32_t capacity, double longestLifetimeTicks);

    void addTick(std::uint32_t births);
    std::uint32_t value() const;

  private:
    std::uint32_t mCapacity;
    std::size_t mWindow;                // ticks after which a birth is surely over; 0: never
    std::deque<std::uint32_t> mRecent;  // births per tick within the window
    std::uint64_t mSum = 0;
};

}  // namespace brume::particles
