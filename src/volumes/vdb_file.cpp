// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <volumes/box_decomposition.hpp>
#include <volumes/file_reader.hpp>
#include <volumes/grid_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace brume::volumes {
namespace {

constexpr const char* kDoing = "loading volume";

/// Runs `work` and turns whatever it throws into an input error that names the file.
template <typename Work>
auto withFileErrors(const std::filesystem::path& file, const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw inputError(kDoing, file.string(), "it needs more memory than there is");
    } catch (const std::length_error&) {
        throw inputError(kDoing, file.string(), "it needs more memory than there is");
    } catch (const std::exception& e) {
        throw inputError(kDoing, file.string(), e.what());
    }
}

std::unique_ptr<GridReader> openFile(const std::filesystem::path& file) {
    const auto start = FileReader(file).size() < 8 ? 0 : FileReader(file).read<std::uint64_t>();
    constexpr std::uint64_t kNanoVdb = 0x304244566f6e614e;  // "NanoVDB0"
    return start == kNanoVdb || file.extension() == ".nvdb" ? openNvdb(file) : openVdb(file);
}

std::string describeTransform(const dmat4& m) {
    double offDiagonal = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i != j) offDiagonal = std::max(offDiagonal, std::abs(m[i][j]));
    std::string text = "affine";
    if (offDiagonal == 0 && m[0][0] == m[1][1] && m[1][1] == m[2][2])
        text = fmt::format("uniform scale {}", m[0][0]);
    else if (offDiagonal == 0)
        text = fmt::format("scale {} {} {}", m[0][0], m[1][1], m[2][2]);
    return glm::determinant(dmat3(m)) < 0 ? text + ", mirrored" : text;
}

std::string quote(const GridHeading& heading) {
    return fmt::format("\"{}\"[{}] ({})", heading.name, heading.index, heading.type);
}

std::string listNames(const std::vector<GridHeading>& headings) {
    std::string list;
    for (const GridHeading& heading : headings) list += (list.empty() ? "" : ", ") + quote(heading);
    return list.empty() ? "none" : list;
}

/// The ordinal of the grid that the volume means.
std::size_t chooseGrid(const std::vector<GridHeading>& headings, const scene::Volume& volume) {
    std::vector<std::size_t> matches;
    for (std::size_t i = 0; i < headings.size(); ++i)
        if (headings[i].name == volume.density) matches.push_back(i);
    const std::string where = volume.file.string();
    if (matches.empty())
        throw inputError(
            kDoing, where,
            fmt::format("it has no grid \"{}\", it has {}", volume.density, listNames(headings)));
    if (volume.gridIndex < 0 && matches.size() > 1)
        throw inputError(kDoing, where,
                         fmt::format("it has {} grids \"{}\", choose one by gridIndex: {}",
                                     matches.size(), volume.density, listNames(headings)));
    const auto index = static_cast<std::size_t>(std::max(volume.gridIndex, 0));
    if (index >= matches.size())
        throw inputError(kDoing, where,
                         fmt::format("gridIndex {} of grid \"{}\", 0 to {} are allowed", index,
                                     volume.density, matches.size() - 1));
    return matches[index];
}

void warn(const scene::Volume& volume, const SanitiseReport& report, double background,
          const Log& log) {
    const std::string where =
        fmt::format("{}: grid \"{}\": ", volume.file.string(), volume.density);
    if (report.nan > 0)
        log.warning(where +
                    fmt::format("{} voxels that are not numbers were set to 0", report.nan));
    if (report.negative > 0)
        log.warning(where + fmt::format("{} negative voxels were set to 0", report.negative));
    if (report.infinite > 0)
        log.warning(where +
                    fmt::format("{} infinite voxels were set to {}", report.infinite, report.cap));
    if (report.clippedBackground)
        log.warning(where + fmt::format("the background is {}; it is taken as 0 outside the active "
                                        "voxels",
                                        background));
}

}  // namespace

std::vector<GridInfo> listGrids(const std::filesystem::path& file) {
    return withFileErrors(file, [&] {
        const auto reader = openFile(file);
        std::vector<GridInfo> grids;
        for (std::size_t i = 0; i < reader->headings().size(); ++i) {
            LoadedGrid loaded = reader->read(i);
            loaded.info.sanitised = sanitise(loaded.field);
            if (loaded.info.transform.empty())
                loaded.info.transform = describeTransform(loaded.info.worldFromIndex);
            grids.push_back(std::move(loaded.info));
        }
        return grids;
    });
}

VolumeGrid loadVolume(const scene::Volume& volume, double extinctionMax, const Log& log) {
    return withFileErrors(volume.file, [&] {
        const auto reader = openFile(volume.file);
        const std::size_t ordinal = chooseGrid(reader->headings(), volume);
        LoadedGrid loaded = reader->read(ordinal);
        if (!loaded.info.refusal.empty())
            throw inputError(
                kDoing, volume.file.string(),
                "grid " + quote(reader->headings()[ordinal]) + ": " + loaded.info.refusal);
        const std::string name =
            fmt::format("{}: grid \"{}\"", volume.file.string(), volume.density);
        VolumeGrid grid = buildVolume(std::move(loaded.field), name,
                                      volume.worldFromFile * loaded.info.worldFromIndex);
        grid.name = volume.density;
        warn(volume, grid.report, loaded.info.background, log);
        if (volume.representation == scene::VolumeRepresentation::Boxes)
            convertToBoxes(grid, extinctionMax, volume.tolerance);
        return grid;
    });
}

}  // namespace brume::volumes
