// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <core/error.hpp>
#include <particles/cpu_simulation.hpp>

#include "effects.hpp"

#include <unistd.h>

namespace brume::particles {
namespace {

/// A file name of this process that disappears with the object.
struct TempFile {
    std::filesystem::path path = std::filesystem::temp_directory_path() /
                                 ("brume_checkpoint_" + std::to_string(::getpid()));
    ~TempFile() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
};

TEST(Checkpoint, FileAndBack_GoesOnWithTheSameBits) {
    const TempFile file;
    const auto populations = compileEffect(fullEffect(200));
    const CheckpointKey key{fingerprintOf(populations), 5, 3};
    CpuSimulation simulation(fullEffect(200), 5, 3);
    simulation.step(70);
    writeCheckpoint(file.path, key, simulation.state());
    CpuSimulation other(fullEffect(200), 5, 3);
    other.restore(readCheckpoint(file.path, key, populations));
    EXPECT_EQ(other.hash(), simulation.hash());
    simulation.step(60);
    other.step(60);
    EXPECT_EQ(other.hash(), simulation.hash());
    EXPECT_EQ(other.counters(2).born, simulation.counters(2).born);
}

TEST(Checkpoint, ForeignOrDamagedFile_IsRefused) {
    const TempFile file;
    const auto populations = compileEffect(busyEffect(200));
    const CheckpointKey key{fingerprintOf(populations), 5, 0};
    CpuSimulation simulation(busyEffect(200), 5);
    simulation.step(70);
    writeCheckpoint(file.path, key, simulation.state());
    const auto expectRefused = [&](const CheckpointKey& wanted, const char* part) {
        try {
            readCheckpoint(file.path, wanted, populations);
            ADD_FAILURE() << "no error; expected: " << part;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input);
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    };
    scene::Effect changed = busyEffect(200);
    changed.emitters[0].rate = 701;
    expectRefused({fingerprintOf(compileEffect(changed)), 5, 0}, "belongs to another effect");
    expectRefused({key.effect, 6, 0}, "has seed 5 and instance 0, 6 and 0 allowed");
    const auto bytes = std::filesystem::file_size(file.path);
    for (const auto length : {bytes - 1, bytes / 2, std::uintmax_t{20}, std::uintmax_t{0}}) {
        std::filesystem::resize_file(file.path, length);
        expectRefused(key, "the file ends early");
    }
}

}  // namespace
}  // namespace brume::particles
