// SPDX-License-Identifier: Apache-2.0
#include <particles/spawn_schedule.hpp>

#include <algorithm>
#include <cmath>

namespace brume::particles {
namespace {

constexpr double kMillion = 1e6;

std::uint64_t toMillionths(double x) {
    return static_cast<std::uint64_t>(std::llround(x * kMillion));
}

/// floor(rate * duration); durations without end give more births than anyone will wait for.
std::uint64_t birthLimit(std::uint64_t rateMicro, double duration) {
    constexpr double kEndless = 9e18;
    const long double births =
        static_cast<long double>(rateMicro) * static_cast<long double>(duration) / 1e6L;
    // A duration of 0.1 s is a little less or more than that in binary.
    return births < kEndless ? static_cast<std::uint64_t>(std::floor(births + 1e-9L))
                             : static_cast<std::uint64_t>(kEndless);
}

}  // namespace

SpawnSchedule::SpawnSchedule(const scene::Effect& effect)
    : mTickRateMicro(toMillionths(effect.tickRate)), mCapacity(effect.capacity) {
    for (const scene::Emitter& source : effect.emitters) {
        Emitter emitter;
        emitter.rateMicro = toMillionths(source.rate);
        emitter.left = birthLimit(emitter.rateMicro, source.duration);
        for (const scene::Burst& burst : source.bursts) {
            if (burst.time > source.duration || burst.count == 0) continue;
            const double ticks = burst.time * effect.tickRate;
            const double tick = std::floor(ticks + 1e-9);
            const double remaining = std::clamp(1 - (ticks - tick), 0.0, 1.0);
            emitter.bursts.push_back(
                {static_cast<std::uint64_t>(tick), static_cast<float>(remaining), burst.count});
        }
        std::stable_sort(emitter.bursts.begin(), emitter.bursts.end(),
                         [](const Burst& a, const Burst& b) { return a.tick < b.tick; });
        mMaxBatches += 1 + static_cast<std::uint32_t>(emitter.bursts.size());
        mEmitters.push_back(std::move(emitter));
    }
}

TickBirths SpawnSchedule::next() {
    TickBirths births;
    for (std::uint32_t i = 0; i < mEmitters.size(); ++i) {
        addBursts(i, births);
        addRate(i, births);
    }
    ++mTick;
    return births;
}

void SpawnSchedule::addBursts(std::uint32_t emitterIndex, TickBirths& births) {
    Emitter& emitter = mEmitters[emitterIndex];
    for (; emitter.nextBurst < emitter.bursts.size(); ++emitter.nextBurst) {
        const Burst& burst = emitter.bursts[emitter.nextBurst];
        if (burst.tick != mTick) break;
        addBatch(emitterIndex, burst.count, burst.remaining, 0, births);
    }
}

void SpawnSchedule::addRate(std::uint32_t emitterIndex, TickBirths& births) {
    Emitter& emitter = mEmitters[emitterIndex];
    if (emitter.left == 0 || emitter.rateMicro == 0) return;
    const std::uint64_t total = emitter.phase + emitter.rateMicro;
    const std::uint64_t count = std::min(total / mTickRateMicro, emitter.left);
    // Birth j of this tick (from 0) happens when phase + rate * time reaches j + 1.
    const double step =
        static_cast<double>(mTickRateMicro) / static_cast<double>(emitter.rateMicro);
    const double first = static_cast<double>(total) / static_cast<double>(emitter.rateMicro) - step;
    emitter.phase = total % mTickRateMicro;
    emitter.left -= count;
    if (count > 0)
        addBatch(emitterIndex, count, static_cast<float>(std::clamp(first, 0.0, 1.0)),
                 static_cast<float>(step), births);
}

void SpawnSchedule::addBatch(std::uint32_t emitterIndex, std::uint64_t count, float remaining,
                             float step, TickBirths& births) {
    const std::uint64_t kept = std::min<std::uint64_t>(count, mCapacity - births.count);
    if (kept > 0)
        births.batches.push_back({emitterIndex, static_cast<std::uint32_t>(mNextBirthIndex),
                                  static_cast<std::uint32_t>(kept), remaining, step});
    births.count += static_cast<std::uint32_t>(kept);
    births.overflow += static_cast<std::uint32_t>(count - kept);
    mNextBirthIndex += count;
}

AliveBound::AliveBound(std::uint32_t capacity, double longestLifetimeTicks)
    : mCapacity(capacity), mWindow(0) {
    constexpr double kLongestWindow = 1e5;  // keeps the memory small; chosen by us
    if (longestLifetimeTicks < kLongestWindow)
        mWindow = static_cast<std::size_t>(std::ceil(longestLifetimeTicks)) + 2;
}

void AliveBound::addTick(std::uint32_t births) {
    mSum += births;
    if (mWindow == 0) return;
    mRecent.push_back(births);
    if (mRecent.size() > mWindow) {
        mSum -= mRecent.front();
        mRecent.pop_front();
    }
}

std::uint32_t AliveBound::value() const {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(mSum, mCapacity));
}

}  // namespace brume::particles
