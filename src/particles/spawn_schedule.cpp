// SPDX-License-Identifier: Apache-2.0
#include <particles/spawn_schedule.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace brume::particles {
namespace {

constexpr double kMillion = 1e6;
constexpr std::int64_t kMillionSquared = 1'000'000'000'000;
constexpr double kTickSlack = 1e-9;  // times in files are not exact in binary

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

std::uint64_t SpawnSchedule::Series::tickOf(std::uint64_t j) const {
    return static_cast<std::uint64_t>(
        std::floor(ticks + static_cast<double>(j) * intervalTicks + kTickSlack));
}

std::uint64_t SpawnSchedule::Series::occurrencesBefore(std::uint64_t tick) const {
    const double guess = (static_cast<double>(tick) - ticks) / intervalTicks;
    std::uint64_t j = guess > 2 ? static_cast<std::uint64_t>(guess) - 2 : 0;
    j = std::min(j, repeat);
    while (j < repeat && tickOf(j) < tick) ++j;
    return j;
}

SpawnSchedule::SpawnSchedule(const scene::Effect& effect)
    : mTickRateMicro(toMillionths(effect.tickRate)),
      mTickRate(effect.tickRate),
      mCapacity(effect.capacity) {
    for (const scene::Emitter& source : effect.emitters) {
        Emitter emitter;
        emitter.rateMicro = toMillionths(source.rate);
        emitter.delayMicro = toMillionths(source.delay);
        emitter.limit = birthLimit(emitter.rateMicro, source.duration);
        emitter.path = source.path;
        mMaxBatches += 1;
        for (const scene::Burst& burst : source.bursts) {
            if (burst.time > source.duration || burst.count == 0) continue;
            const double ticks = (source.delay + burst.time) * effect.tickRate;
            if (burst.repeat > 1 && burst.interval > 0) {
                const double last = std::floor((source.duration - burst.time) / burst.interval);
                const auto repeat = static_cast<std::uint64_t>(
                    std::min<double>(burst.repeat, last + 1));
                const double interval = burst.interval * effect.tickRate;
                emitter.series.push_back({ticks, interval, repeat, burst.count});
                mMaxBatches += static_cast<std::uint32_t>(
                    std::min<double>(static_cast<double>(repeat), std::ceil(1 / interval) + 1));
                continue;
            }
            const double tick = std::floor(ticks + kTickSlack);
            const double remaining = std::clamp(1 - (ticks - tick), 0.0, 1.0);
            emitter.bursts.push_back(
                {static_cast<std::uint64_t>(tick), static_cast<float>(remaining), burst.count});
            mMaxBatches += 1;
        }
        std::stable_sort(emitter.bursts.begin(), emitter.bursts.end(),
                         [](const Burst& a, const Burst& b) { return a.tick < b.tick; });
        emitter.burstSums = {0};
        for (const Burst& burst : emitter.bursts)
            emitter.burstSums.push_back(emitter.burstSums.back() + burst.count);
        mEmitters.push_back(std::move(emitter));
    }
}

std::uint64_t SpawnSchedule::rateBirthsBefore(const Emitter& emitter, std::uint64_t tick) const {
    // floor(rate (tick / tickRate - delay)), everything in millionths.
    using Wide = __int128;
    const Wide amount = Wide(emitter.rateMicro) * tick * kMillionSquared -
                        Wide(emitter.rateMicro) * emitter.delayMicro * mTickRateMicro;
    if (amount <= 0) return 0;
    const Wide births = amount / (Wide(mTickRateMicro) * kMillionSquared);
    return births < Wide(emitter.limit) ? static_cast<std::uint64_t>(births) : emitter.limit;
}

std::uint64_t SpawnSchedule::birthsBefore(std::uint64_t tick) const {
    std::uint64_t sum = 0;
    for (const Emitter& emitter : mEmitters) {
        const auto burst = std::lower_bound(
            emitter.bursts.begin(), emitter.bursts.end(), tick,
            [](const Burst& a, std::uint64_t value) { return a.tick < value; });
        sum += emitter.burstSums[static_cast<std::size_t>(burst - emitter.bursts.begin())];
        for (const Series& series : emitter.series)
            sum += series.occurrencesBefore(tick) * series.count;
        sum += rateBirthsBefore(emitter, tick);
    }
    return sum;
}

TickBirths SpawnSchedule::at(std::uint64_t tick) const {
    TickBirths births;
    at(tick, births);
    return births;
}

void SpawnSchedule::at(std::uint64_t tick, TickBirths& births) const {
    births.batches.clear();
    births.count = births.overflow = 0;
    std::uint64_t index = birthsBefore(tick);
    for (std::uint32_t i = 0; i < mEmitters.size(); ++i) {
        const Emitter& emitter = mEmitters[i];
        const std::size_t first = births.batches.size();
        addBursts(emitter, tick, births.batches);
        addRate(emitter, tick, births.batches);
        if (births.batches.size() == first) continue;
        const dvec3 end = pathAt(emitter, tick + 1);
        const dvec3 motion = end - pathAt(emitter, tick);
        for (std::size_t b = first; b < births.batches.size(); ++b) {
            shader::BirthBatch& batch = births.batches[b];
            batch.emitter = i;
            batch.strand = i;
            batch.firstBirthIndex = static_cast<std::uint32_t>(index);
            index += batch.count;
            const std::uint32_t kept = std::min(batch.count, mCapacity - births.count);
            births.overflow += batch.count - kept;
            batch.count = kept;
            batch.first = births.count;
            batch.offset = vec3(end);
            batch.motion = vec3(motion);
            births.count += kept;
        }
    }
    std::erase_if(births.batches, [](const auto& batch) { return batch.count == 0; });
}

void SpawnSchedule::addBursts(const Emitter& emitter, std::uint64_t tick,
                              std::vector<shader::BirthBatch>& batches) const {
    auto burst =
        std::lower_bound(emitter.bursts.begin(), emitter.bursts.end(), tick,
                         [](const Burst& a, std::uint64_t value) { return a.tick < value; });
    for (; burst != emitter.bursts.end() && burst->tick == tick; ++burst) {
        shader::BirthBatch batch{};
        batch.count = burst->count;
        batch.remaining = burst->remaining;
        batches.push_back(batch);
    }
    for (const Series& series : emitter.series)
        for (std::uint64_t j = series.occurrencesBefore(tick);
             j < series.repeat && series.tickOf(j) == tick; ++j) {
            const double time = series.ticks + static_cast<double>(j) * series.intervalTicks;
            shader::BirthBatch batch{};
            batch.count = series.count;
            batch.remaining = static_cast<float>(
                std::clamp(1 - (time - static_cast<double>(tick)), 0.0, 1.0));
            batches.push_back(batch);
        }
}

void SpawnSchedule::addRate(const Emitter& emitter, std::uint64_t tick,
                            std::vector<shader::BirthBatch>& batches) const {
    const std::uint64_t before = rateBirthsBefore(emitter, tick);
    const std::uint64_t after = rateBirthsBefore(emitter, tick + 1);
    if (after == before) return;
    // Birth j (from 0) happens at delay + (j + 1) / rate; what is left of the tick then, exactly.
    using Wide = __int128;
    const Wide left = Wide(emitter.rateMicro) * (tick + 1) * kMillionSquared -
                      Wide(emitter.rateMicro) * emitter.delayMicro * mTickRateMicro -
                      Wide(before + 1) * mTickRateMicro * kMillionSquared;
    const double rate = static_cast<double>(emitter.rateMicro);
    const double first = static_cast<double>(left) / (rate * static_cast<double>(kMillionSquared));
    shader::BirthBatch batch{};
    batch.count = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(after - before, std::numeric_limits<std::uint32_t>::max()));
    batch.remaining = static_cast<float>(std::clamp(first, 0.0, 1.0));
    batch.remainingStep = static_cast<float>(static_cast<double>(mTickRateMicro) / rate);
    batches.push_back(batch);
}

dvec3 SpawnSchedule::pathAt(const Emitter& emitter, std::uint64_t tick) const {
    return scene::offsetAt(emitter.path, static_cast<double>(tick) / mTickRate);
}

AliveBound::AliveBound(std::uint32_t capacity, double longestLifetimeTicks)
    : mCapacity(capacity), mWindow(0) {
    constexpr double kLongestWindow = 1e5;  // keeps the memory small; chosen by us
    if (longestLifetimeTicks < kLongestWindow)
        mWindow = static_cast<std::size_t>(std::ceil(longestLifetimeTicks)) + 2;
    mRecent.resize(mWindow);
}

void AliveBound::addTick(std::uint32_t births) {
    mSum += births;
    if (mWindow == 0) return;
    mSum -= std::exchange(mRecent[mNext], births);
    mNext = (mNext + 1) % mWindow;
}

std::uint32_t AliveBound::value() const {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(mSum, mCapacity));
}

}  // namespace brume::particles
