// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <core/error.hpp>
#include <particles/simulation_state.hpp>

#include <cstring>
#include <fstream>

namespace brume::particles {
namespace {

constexpr char kMagic[8] = {'b', 'r', 'u', 'm', 'e', 'p', 't', '1'};
constexpr std::uint64_t kHashStart = 0xcbf29ce484222325u;

/// What the file begins with; little-endian, as every device that Brume runs on.
struct Header {
    char magic[8];
    std::uint64_t effect, seed, tick;
    std::uint32_t instance, populationCount;
};

std::uint64_t hashBytes(std::uint64_t hash, const void* data, std::size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ byte[i]) * 0x100000001b3u;
    return hash;
}

template <typename T>
std::uint64_t hashArray(std::uint64_t hash, const std::vector<T>& values) {
    return hashBytes(hash, values.data(), values.size() * sizeof(T));
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& problem) {
    throw inputError("reading a checkpoint", file.string(), problem);
}

template <typename T>
void readInto(std::ifstream& stream, const std::filesystem::path& file, T* target,
              std::size_t count) {
    if (!stream.read(reinterpret_cast<char*>(target),
                     static_cast<std::streamsize>(count * sizeof(T))))
        refuse(file, "the file ends early, a file written by --checkpoint allowed");
}

}  // namespace

std::uint64_t SimulationState::hash() const {
    std::uint64_t hash = kHashStart;
    for (const std::vector<Particle>& particles : populations)
        hash = hashParticles(particles, tick, hash);
    for (const std::vector<std::uint32_t>& population : strands) hash = hashArray(hash, population);
    return hash;
}

std::uint64_t fingerprintOf(const std::vector<CompiledEffect>& populations) {
    std::uint64_t hash = kHashStart;
    for (const CompiledEffect& effect : populations) {
        // Everything before the appearance is motion.
        hash = hashBytes(hash, &effect.parameters,
                         offsetof(shader::EffectParameters, appearance));
        hash = hashArray(hash, effect.emitters);
        hash = hashArray(hash, effect.triangles);
        hash = hashArray(hash, effect.fieldValues);
        hash = hashBytes(hash, &effect.hasStrands, sizeof effect.hasStrands);
        hash = hashArray(hash, effect.noiseDrifts);
        hash = hashBytes(hash, &effect.capacity, sizeof effect.capacity);
        hash = hashBytes(hash, &effect.tickRate, sizeof effect.tickRate);
        // Births at a few times stand for the schedule.
        for (const std::uint64_t tick : {1u, 17u, 1000u, 1000003u}) {
            const std::uint64_t births = effect.schedule.birthsBefore(tick);
            hash = hashBytes(hash, &births, sizeof births);
        }
    }
    return hash;
}

std::uint64_t fingerprintOf(const std::vector<CompiledEffect>& populations,
                            const scene::Placement& placement) {
    std::uint64_t hash = fingerprintOf(populations);
    if (!populations[0].isWorldSpace()) return hash;
    hash = hashBytes(hash, &placement.worldFromObject, sizeof placement.worldFromObject);
    for (const auto& [seconds, offset] : placement.path) {
        hash = hashBytes(hash, &seconds, sizeof seconds);
        hash = hashBytes(hash, &offset, sizeof offset);
    }
    return hash;
}

void writeCheckpoint(const std::filesystem::path& file, const CheckpointKey& key,
                     const SimulationState& state) {
    const std::filesystem::path temporary = file.string() + ".part";
    {
        std::ofstream stream(temporary, std::ios::binary);
        const auto write = [&](const void* data, std::size_t bytes) {
            stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
        };
        Header header{{}, key.effect, key.seed, state.tick, key.instance,
                      static_cast<std::uint32_t>(state.populations.size())};
        std::memcpy(header.magic, kMagic, sizeof kMagic);
        write(&header, sizeof header);
        for (std::size_t i = 0; i < state.populations.size(); ++i) {
            write(&state.counters[i], sizeof(Counters));
            write(state.populations[i].data(), state.populations[i].size() * sizeof(Particle));
            write(state.strands[i].data(), state.strands[i].size() * sizeof(std::uint32_t));
        }
        const std::uint64_t hash = state.hash();
        write(&hash, sizeof hash);
        stream.close();
        if (!stream) throw failure("writing a checkpoint", file.string(), "could not be written");
    }
    std::error_code error;
    std::filesystem::rename(temporary, file, error);
    if (error) throw failure("writing a checkpoint", file.string(), error.message());
}

SimulationState readCheckpoint(const std::filesystem::path& file, const CheckpointKey& key,
                               const std::vector<CompiledEffect>& populations) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse(file, "cannot be opened, a file written by --checkpoint allowed");
    Header header{};
    readInto(stream, file, &header, 1);
    if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0)
        refuse(file, "is no checkpoint, a file written by --checkpoint allowed");
    if (header.effect != key.effect || header.populationCount != populations.size())
        refuse(file, "belongs to another effect, one written for this effect allowed");
    if (header.seed != key.seed || header.instance != key.instance)
        refuse(file, fmt::format("has seed {} and instance {}, {} and {} allowed", header.seed,
                                 header.instance, key.seed, key.instance));
    SimulationState state;
    state.tick = header.tick;
    for (const CompiledEffect& effect : populations) {
        Counters counters{};
        readInto(stream, file, &counters, 1);
        if (counters.alive > effect.capacity)
            refuse(file, fmt::format("has {} particles alive, at most {} allowed", counters.alive,
                                     effect.capacity));
        std::vector<Particle> particles(counters.alive);
        readInto(stream, file, particles.data(), particles.size());
        std::vector<std::uint32_t> strands(effect.hasStrands ? counters.alive : 0);
        readInto(stream, file, strands.data(), strands.size());
        state.strands.push_back(std::move(strands));
        state.counters.push_back(counters);
        state.populations.push_back(std::move(particles));
    }
    std::uint64_t hash = 0;
    readInto(stream, file, &hash, 1);
    if (hash != state.hash())
        refuse(file, "its hash does not fit its particles, an undamaged file allowed");
    return state;
}

}  // namespace brume::particles
