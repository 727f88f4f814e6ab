// SPDX-License-Identifier: Apache-2.0
// Writes the binary files of tests/fuzz/corpus that no text editor makes:
//   build/release/bin/brume_fuzz_make_corpus tests/fuzz/corpus
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>
#include <particles/compiled_effect.hpp>
#include <particles/simulation_state.hpp>

#include <filesystem>

namespace {

openvdb::FloatGrid::Ptr makeGrid() {
    const auto grid = openvdb::FloatGrid::create();
    grid->setName("density");
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    for (int i = 0; i < 12; ++i) grid->tree().setValue({i, i % 3, -i}, 0.1f * static_cast<float>(i));
    return grid;
}

void writeVolumes(const std::filesystem::path& folder) {
    const auto half = makeGrid();
    half->setSaveFloatAsHalf(true);
    const auto vectors = openvdb::Vec3SGrid::create();
    vectors->setName("velocity");
    vectors->tree().setValue({1, 2, 3}, openvdb::Vec3s(1, 2, 3));
    openvdb::io::File file((folder / "vdb" / "grids.vdb").string());
    file.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    file.write(openvdb::GridPtrVec{half, vectors});
    nanovdb::io::writeGrid((folder / "nvdb" / "grid.nvdb").string(),
                           nanovdb::openToNanoVDB(makeGrid()), nanovdb::io::Codec::ZIP);
}

void writeState(const std::filesystem::path& folder) {
    brume::particles::SimulationState state;
    state.tick = 12;
    state.counters.resize(1);
    state.counters[0].alive = state.counters[0].born = 3;
    state.populations = {{{}, {}, {}}};
    state.strands.resize(1);
    brume::particles::writeCheckpoint(folder / "checkpoint" / "three.state", {7, 1, 0}, state);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    openvdb::initialize();
    for (const char* kind : {"vdb", "nvdb", "checkpoint"})
        std::filesystem::create_directories(std::filesystem::path(argv[1]) / kind);
    writeVolumes(argv[1]);
    writeState(argv[1]);
}
