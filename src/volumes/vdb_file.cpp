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

/// The ordinal of the grid of that name and index.
std::size_t chooseGrid(const std::vector<GridHeading>& headings, const std::string& where,
                       const std::string& name, int gridIndex) {
    std::vector<std::size_t> matches;
    for (std::size_t i = 0; i < headings.size(); ++i)
        if (headings[i].name == name) matches.push_back(i);
    if (matches.empty())
        throw inputError(
            kDoing, where,
            fmt::format("it has no grid \"{}\", it has {}", name, listNames(headings)));
    if (gridIndex < 0 && matches.size() > 1)
        throw inputError(kDoing, where,
                         fmt::format("it has {} grids \"{}\", choose one by gridIndex: {}",
                                     matches.size(), name, listNames(headings)));
    const auto index = static_cast<std::size_t>(std::max(gridIndex, 0));
    if (index >= matches.size())
        throw inputError(kDoing, where,
                         fmt::format("gridIndex {} of grid \"{}\", 0 to {} are allowed", index,
                                     name, matches.size() - 1));
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

constexpr std::uint64_t kMaxFieldValues = std::uint64_t{1} << 25;

void loadField(scene::Effect& effect, const scene::FieldSource& source, const std::string& place) {
    std::shared_ptr<const scene::FieldValues>& field = effect.fields[source];
    if (field) return;
    const std::string where = place + ": " + source.file;
    field = withFileErrors(where, [&] {
        const auto reader = openFile(source.file);
        const std::size_t ordinal =
            chooseGrid(reader->headings(), where, source.grid, source.gridIndex);
        return std::make_shared<const scene::FieldValues>(
            reader->readField(ordinal, kMaxFieldValues));
    });
}

void loadModuleField(scene::Effect& effect, const scene::ModuleSettings& module) {
    const auto file = module.texts.find("file"), grid = module.texts.find("grid");
    if (file == module.texts.end() || grid == module.texts.end()) return;  // the module complains
    const auto index = module.values.find("gridIndex");
    const bool hasIndex = index != module.values.end() && index->second.size() == 1;
    const auto where = module.whereOf.find("file");
    loadField(effect, {file->second, grid->second, hasIndex ? static_cast<int>(index->second[0]) : -1},
              where == module.whereOf.end() ? module.where : where->second);
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
        const std::size_t ordinal = chooseGrid(
            reader->headings(), volume.file.string(), volume.density, volume.gridIndex);
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

void loadEffectFields(scene::Effect& effect) {
    for (const scene::ModuleSettings& module : effect.modules) loadModuleField(effect, module);
    for (const scene::Emitter& emitter : effect.emitters)
        for (const auto* placement : {&emitter.volume, &emitter.velocityField})
            if (*placement) loadField(effect, (*placement)->source, (*placement)->where);
    for (scene::SubEmitter& sub : effect.subEmitters) {
        auto child = std::make_shared<scene::Effect>(*sub.effect);
        loadEffectFields(*child);
        sub.effect = std::move(child);
    }
}

}  // namespace brume::volumes
