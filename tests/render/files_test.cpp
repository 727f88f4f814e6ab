// SPDX-License-Identifier: Apache-2.0
// Real and hostile volume files through the renderer: the right image or one line that says why
// not.
#include <render/render_fixture.hpp>
#include <volumes/vdb_file.hpp>

#include <fmt/format.h>

namespace brume::test {
namespace {

std::filesystem::path dataPath(const char* folder) {
    return std::filesystem::path(BRUME_SHARED_DATA_DIR) / folder;
}

std::vector<std::filesystem::path> listFiles(const char* folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(dataPath(folder)))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The whole volume in an image, coloured and lit, of optical depths around 1 to 100.
TestScene makeView(volumes::VolumeGrid grid) {
    TestScene s(32, 32);
    const Box3 bounds = grid.worldBounds();
    const double size = bounds.isEmpty() ? 1 : glm::length(bounds.size());
    const dvec3 center = bounds.isEmpty() ? dvec3(0) : bounds.center();
    s.addMedium(dvec3(10, 20, 30) / size, dvec3(0.9, 0.6, 0.3));
    s.scene.volumes.resize(1);
    s.volumes.push_back(std::move(grid));
    s.scene.camera.position = center + size * dvec3(0.4, 0.5, -1.1);
    s.scene.camera.target = center;
    s.addDaylight();
    return s;
}

class Files : public RenderTest {
  protected:
    /// Every grid of a file that is a density, by its name and index.
    void checkFile(const std::filesystem::path& file) {
        SCOPED_TRACE(file.filename().string());
        std::vector<volumes::GridInfo> grids;
        if (!expectOneLine([&] { grids = volumes::listGrids(file); })) return;
        for (const volumes::GridInfo& info : grids) {
            scene::Volume volume;
            volume.file = file;
            volume.density = info.name;
            volume.gridIndex = info.index;
            volumes::VolumeGrid grid;
            const bool isLoaded =
                expectOneLine([&] { grid = volumes::loadVolume(volume, 1, Log()); });
            EXPECT_EQ(isLoaded, info.refusal.empty()) << info.name << ": " << info.refusal;
            if (isLoaded)
                expectExact(makeView(std::move(grid)),
                            fmt::format("{} {} {}", file.stem().string(), info.name, info.index));
        }
    }

    /// Whether `action` throws nothing; else it must be an input error of one line.
    bool expectOneLine(const std::function<void()>& action) {
        try {
            action();
            return true;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            return false;
        }
    }

    void checkFolder(const char* folder) {
        if (!std::filesystem::exists(dataPath(folder)))
            GTEST_SKIP() << "needs " << dataPath(folder);
        for (const std::filesystem::path& file : listFiles(folder)) checkFile(file);
    }
};

TEST_F(Files, Hard_AreRightOrRefused) { checkFolder("hard"); }
TEST_F(Files, Vdb_AreRight) { checkFolder("vdb"); }
TEST_F(Files, Nvdb_AreRight) { checkFolder("nvdb"); }

}  // namespace
}  // namespace brume::test
