// SPDX-License-Identifier: Apache-2.0
// Which particles are born in which tick, and when within it: a pure function of the tick, computed
// in integers, so that no birth is ever lost or doubled and any tick can be asked for.
#pragma once

#include <shaders/particles/effect.h>
#include <scene/effect.hpp>

#include <cstdint>
#include <vector>

namespace brume::particles {

/// The births of one tick, in order of their birth indices.
struct TickBirths {
    std::vector<shader::BirthBatch> batches;
    std::uint32_t count = 0;     ///< sum over the batches, at most the capacity
    std::uint32_t overflow = 0;  ///< asked for beyond that: rejected at once
};

/// A rate gives floor(rate * t) births in the first t seconds after the emitter's delay, the i-th
/// (from 0) at (i + 1) / rate; a burst at time b is born in the tick that contains b. Rates and
/// times count in millionths. Within a tick emitters follow each other, each with its bursts first.
class SpawnSchedule {
  public:
    explicit SpawnSchedule(const scene::Effect& effect);

    TickBirths at(std::uint64_t tick) const;
    /// The same into memory that is used again.
    void at(std::uint64_t tick, TickBirths& births) const;

    /// Births asked for in all ticks before `tick`: the birth index of the next one.
    std::uint64_t birthsBefore(std::uint64_t tick) const;

    /// No tick has more batches.
    std::uint32_t maxBatchesPerTick() const { return mMaxBatches; }

  private:
    struct Burst {
        std::uint64_t tick = 0;
        float remaining = 0;
        std::uint32_t count = 0;
    };
    /// A burst that repeats: occurrence j at time + j * interval.
    struct Series {
        double ticks = 0;          // time of the first
        double intervalTicks = 1;  // > 0
        std::uint64_t repeat = 0;
        std::uint32_t count = 0;
        std::uint64_t tickOf(std::uint64_t j) const;
        std::uint64_t occurrencesBefore(std::uint64_t tick) const;
    };
    struct Emitter {
        std::uint64_t rateMicro = 0;   // births per 1e6 s
        std::uint64_t delayMicro = 0;  // s / 1e6
        std::uint64_t limit = 0;       // births until the duration ends
        std::vector<Burst> bursts;     // by tick
        std::vector<std::uint64_t> burstSums;  // births of the bursts before each, and of all
        std::vector<Series> series;
        scene::Path path;
    };

    void addBursts(const Emitter& emitter, std::uint64_t tick,
                   std::vector<shader::BirthBatch>& batches) const;
    void addRate(const Emitter& emitter, std::uint64_t tick,
                 std::vector<shader::BirthBatch>& batches) const;
    std::uint64_t rateBirthsBefore(const Emitter& emitter, std::uint64_t tick) const;
    dvec3 pathAt(const Emitter& emitter, std::uint64_t tick) const;

    std::vector<Emitter> mEmitters;
    std::uint64_t mTickRateMicro = 0;
    double mTickRate = 1;
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
    std::uint64_t windowTicks() const { return mWindow; }  ///< births longer ago do not count; 0: all

  private:
    std::uint32_t mCapacity;
    std::size_t mWindow;                // ticks after which a birth is surely over; 0: never
    std::vector<std::uint32_t> mRecent;  // births of the last mWindow ticks, in a ring
    std::size_t mNext = 0;
    std::uint64_t mSum = 0;
};

}  // namespace brume::particles
