// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/commands/inspect.hpp>
#include <app/console.hpp>
#include <bench/prepare.hpp>
#include <fstream>
#include <render/needs.hpp>
#include <scene/loader.hpp>
#include <string>
#include <volumes/vdb_file.hpp>

namespace brume::app {
namespace {

std::string format(const dvec3& v) { return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z); }

/// The box of the cells around the active voxels, in the grid's own world.
Box3 worldBoxOf(const volumes::GridInfo& grid) {
    const Box3 index{dvec3(grid.lo), dvec3(grid.hi)};
    return transformBox(grid.worldFromIndex, index);
}

void printSanitised(const volumes::SanitiseReport& report) {
    if (report.nan + report.negative + report.infinite == 0 && !report.clippedBackground) return;
    fmt::print("  sanitised  {} NaN and {} negative set to 0, {} infinite set to {:g}{}\n",
               report.nan, report.negative, report.infinite, report.cap,
               report.clippedBackground ? "; background taken as 0" : "");
}

void printGrid(const volumes::GridInfo& grid) {
    fmt::print("grid {}[{}]: {}, {}\n", grid.name, grid.index, grid.type, grid.gridClass);
    if (grid.activeVoxels == 0) {
        fmt::print("  active     nothing\n");
    } else {
        const Box3 world = worldBoxOf(grid);
        fmt::print("  active     {} in {} and {}\n", formatCount(grid.activeVoxels, "voxel"),
                   formatCount(grid.leafCount, "leaf block"),
                   formatCount(grid.activeTileCount, "tile"));
        fmt::print("  index box  ({}, {}, {}) to ({}, {}, {})\n", grid.lo.x, grid.lo.y, grid.lo.z,
                   grid.hi.x, grid.hi.y, grid.hi.z);
        if (grid.transform != "frustum")
            fmt::print("  world box  {} to {}\n", format(world.lo), format(world.hi));
        fmt::print("  values     {:g} to {:g}\n", grid.minValue, grid.maxValue);
    }
    fmt::print("  background {:g}\n  transform  {}\n", grid.background, grid.transform);
    printSanitised(grid.sanitised);
    if (!grid.refusal.empty()) fmt::print("  no density {}\n", grid.refusal);
}

void inspectVolume(const std::filesystem::path& file) {
    const std::vector<volumes::GridInfo> grids = volumes::listGrids(file);
    fmt::print("{}: {}\n", file.string(), formatCount(grids.size(), "grid"));
    for (const volumes::GridInfo& grid : grids) printGrid(grid);
}

std::string_view nameOf(scene::LightType type) {
    switch (type) {
        case scene::LightType::Ambient:
            return "ambient";
        case scene::LightType::Directional:
            return "directional";
        case scene::LightType::Point:
            return "point";
        case scene::LightType::Spot:
            break;
    }
    return "spot";
}

std::string_view nameOf(scene::MaterialType type) {
    switch (type) {
        case scene::MaterialType::Opaque:
            return "opaque";
        case scene::MaterialType::Thin:
            return "thin";
        case scene::MaterialType::Solid:
            break;
    }
    return "solid";
}

std::string_view nameOf(scene::VolumeRepresentation representation) {
    switch (representation) {
        case scene::VolumeRepresentation::Bricks:
            return "bricks";
        case scene::VolumeRepresentation::Boxes:
            return "boxes";
        case scene::VolumeRepresentation::Particles:
            break;
    }
    return "particles";
}

double expectedBirthsPerSecond(const scene::Effect& effect) {
    double rate = 0;
    for (const scene::Emitter& emitter : effect.emitters) rate += emitter.rate;
    return rate;
}

void printEffect(const scene::Effect& effect) {
    fmt::print("  capacity   {}, {:g} ticks per second\n", formatCount(effect.capacity, "particle"),
               effect.tickRate);
    fmt::print("  emitters   {}, {:g} births per second\n", effect.emitters.size(),
               expectedBirthsPerSecond(effect));
    for (const scene::ModuleSettings& module : effect.modules)
        fmt::print("  module     {}\n", module.type);
    if (effect.surface)
        fmt::print("  surface    {} of material {}\n",
                   effect.surface->type == scene::SurfaceType::Ribbon ? "ribbon" : "billboard",
                   effect.surface->material);
    else
        fmt::print("  medium     {}, {} profile\n", effect.medium,
               effect.smoothProfile ? "smooth" : "constant");
}

void inspectEffect(const std::filesystem::path& file, const Log& log) {
    const scene::Effect effect = scene::loadEffect(file, log);
    fmt::print("{}: effect\n", file.string());
    printEffect(effect);
}

void printLook(const scene::Scene& s) {
    const bool perspective = s.camera.type == scene::CameraType::Perspective;
    fmt::print("  image      {}x{}, {}x{} samples per pixel, {} camera\n", s.image.width,
               s.image.height, s.image.supersample, s.image.supersample,
               perspective ? "perspective" : "orthographic");
    for (const scene::Light& light : s.lights)
        fmt::print("  light      {}, shadow {}\n", nameOf(light.type), light.shadow);
    for (const scene::Medium& m : s.media)
        fmt::print("  medium     {}: extinction {} 1/m, albedo {}\n", m.name, format(m.extinction),
                   format(m.albedo));
    for (const scene::Material& m : s.materials)
        fmt::print("  material   {}: {}\n", m.name, nameOf(m.type));
}

void printContent(const scene::Scene& s) {
    std::size_t triangleCount = 0;
    for (const scene::Mesh& mesh : s.meshes) triangleCount += mesh.indices.size() / 3;
    fmt::print("  meshes     {} with {}\n", s.meshes.size(),
               formatCount(triangleCount, "triangle"));
    for (const scene::Volume& v : s.volumes)
        fmt::print("  volume     {}, grid {} as {}\n", v.file.string(), v.density,
                   nameOf(v.representation));
    if (!s.spheres.empty()) fmt::print("  spheres    {}\n", s.spheres.size());
    for (const scene::EffectInstance& e : s.effects) {
        fmt::print("effect {}: seed {}, at {:g} s\n", e.file.string(), e.seed, e.time);
        printEffect(e.effect);
    }
}

void inspectScene(const std::filesystem::path& file, const Log& log) {
    const render::PreparedScene prepared = bench::prepareScene(scene::loadScene(file, log), log);
    fmt::print("{}: scene, method {}\n", file.string(), prepared.scene.render.method);
    printLook(prepared.scene);
    printContent(prepared.scene);
    fmt::print("{}", render::describe(render::findNeeds(prepared)));
}

/// Scenes have no emitters, so the word tells the two kinds of JSON file apart.
bool isEffectFile(const std::filesystem::path& file) {
    if (file.string().ends_with(".effect.json")) return true;
    std::ifstream stream(file, std::ios::binary);
    std::string head(1 << 20, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    return head.find("\"emitters\"") != std::string::npos;
}

}  // namespace

void runInspect(const InspectArguments& arguments, const Log& log) {
    const std::filesystem::path& file = arguments.file;
    if (file.extension() == ".vdb" || file.extension() == ".nvdb") return inspectVolume(file);
    if (isEffectFile(file)) return inspectEffect(file, log);
    inspectScene(file, log);
}

}  // namespace brume::app
