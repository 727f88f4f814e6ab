// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <gpu/upload.hpp>
#include <shadows/light_map.hpp>
#include <shadows/map_pass.hpp>
#include <shadows/shadows.hpp>

#include <algorithm>

namespace brume::shadows {
namespace {

constexpr std::uint32_t kDefaultResolution = 512, kDefaultFaceResolution = 256;
const char* const kDoing = "setting up shadows";

/// Settings that every map has, whatever its store.
struct MapSettings {
    std::uint32_t resolution = 0;
    std::uint32_t opaqueResolution = 0;
    std::uint32_t opaqueFilter = 0;
    Focus focus;
    bool isKept = false;
    bool hasCaustics = false;
};

/// Takes the maps' own settings out of those that go to the store.
MapSettings takeMapSettings(scene::Settings& settings, std::uint32_t faceCount) {
    scene::Settings own;
    for (const scene::SettingInfo& info : listMapSettings())
        if (auto node = settings.extract(std::string(info.name))) own.insert(std::move(node));
    scene::SettingsReader reader(own, kDoing);
    const auto resolution = [&](const char* key) {
        const long long fallback = faceCount == 1 ? kDefaultResolution : kDefaultFaceResolution;
        const auto value = static_cast<std::uint32_t>(reader.integer(key, fallback, 8, 4096));
        return (value + shader::kMapTileSize - 1) / shader::kMapTileSize * shader::kMapTileSize;
    };
    MapSettings map;
    map.resolution = resolution("resolution");
    map.opaqueResolution = resolution("opaqueResolution");
    map.opaqueFilter = static_cast<std::uint32_t>(reader.integer("opaqueFilter", 1, 0, 16));
    map.focus.center = {reader.number("focusX", 0, -1e9, 1e9),
                        reader.number("focusY", 0, -1e9, 1e9),
                        reader.number("focusZ", 0, -1e9, 1e9)};
    map.focus.radius = reader.number("focusRadius", 0, 0, 1e9);
    map.isKept = reader.boolean("keep", false);
    map.hasCaustics = reader.boolean("caustics", false);
    return map;
}

/// Boxes that hold everything of a choice.
Box3 boundsOf(const Casters& casters, CasterChoice choice) {
    Box3 bounds;
    if (choice != CasterChoice::Opaque) bounds.extend(casters.translucentBounds);
    if (choice != CasterChoice::Translucent) bounds.extend(casters.opaqueBounds);
    return bounds;
}

}  // namespace

std::span<const scene::SettingInfo> listMapSettings() {
    static const std::vector<scene::SettingInfo> kSettings = {
        {"resolution", "8 .. 4096 texels, multiple of 8", "512 (256 per face of a cube)",
         "edge of the map of media and glass"},
        {"opaqueResolution", "8 .. 4096 texels, multiple of 8", "512 (256 per face of a cube)",
         "edge of the map of opaque casters"},
        {"opaqueFilter", "0 .. 16 texels", "1", "radius of the tent over the opaque map"},
        {"focusX", "m", "0",
         "centre of the part of the world that a directional light's map shows"},
        {"focusY", "m", "0", "likewise"},
        {"focusZ", "m", "0", "likewise"},
        {"focusRadius", "m", "0", "how far that part reaches; 0: all casters; beyond it is light"},
        {"caustics", "true, false", "false",
         "glass gathers light where it stands across it (not with exact)"},
        {"keep", "true, false", "false", "build once and keep while the scene does not move"}};
    return kSettings;
}

Shadows::Shadows(gpu::Device& device, const Casters& casters, std::span<const scene::Light> lights,
                 const scene::Settings& overrides)
    : mDevice(&device), mCasters(casters) {
    std::uint32_t stores = 0;
    for (const scene::Light& light : lights) {
        LightMaps& maps = mLights.emplace_back();
        stores |= storeBits(light.shadow);
        if (light.shadow == "none") continue;
        scene::Settings settings = light.shadowSettings;
        for (const auto& [key, value] : overrides) settings[key] = value;
        maps.own = makeMap(light, light.shadow, settings);
        if (light.shadow != "opaque" && light.shadow != "exact" &&
            !casters.opaqueBounds.isEmpty()) {
            scene::Settings shared;
            for (const scene::SettingInfo& info : listMapSettings())
                if (const auto found = settings.find(std::string(info.name));
                    found != settings.end())
                    shared.insert(*found);
            maps.opaque = makeMap(light, "opaque", shared);
        }
    }
    if (casters.hasWholeSpheres && stores != 0)
        mShares.emplace(device, casters, static_cast<std::uint32_t>(lights.size()), stores);
}

std::unique_ptr<Shadows::Map> Shadows::makeMap(const scene::Light& light, const std::string& store,
                                               scene::Settings settings) {
    auto map = std::make_unique<Map>();
    shader::ShadowMap& data = map->data;
    data.faceCount = faceCountFor(light);
    const MapSettings own = takeMapSettings(settings, data.faceCount);
    map->isKept = own.isKept;
    if (own.hasCaustics && store == "exact")
        throw inputError(
            kDoing, "caustics",
            "not made by exact, which follows straight rays; allowed with the other stores");
    data.hasCaustics = own.hasCaustics;
    map->store = createStore(
        store, *mDevice, {mCasters.isColoured, mCasters.translucentTriangleCount > 0}, settings);
    const CasterChoice choice = store == "opaque"  ? CasterChoice::Opaque
                                : store == "exact" ? CasterChoice::All
                                                   : CasterChoice::Translucent;
    map->choice = choice;
    map->bounds = boundsOf(mCasters, choice);
    map->focus = own.focus;
    if (map->bounds.isEmpty()) return nullptr;
    data.store = map->store->info().bit;
    data.channels = mCasters.isColoured ? 3 : 1;
    data.resolution = store == "opaque" ? own.opaqueResolution : own.resolution;
    data.filterRadius = store == "opaque" ? own.opaqueFilter : 0;
    map->store->allocate(data);
    fitMap(light, map->bounds, map->focus, mCasters.origin, data.filterRadius + 2, data);
    data.spheres = mCasters.spheres->deviceAddress();
    data.boxes = mCasters.boxes->deviceAddress();
    data.volumes = mCasters.volumes->deviceAddress();
    data.triangles = mCasters.triangles->deviceAddress();
    data.materials = mCasters.materials->deviceAddress();
    map->buffer = {*mDevice, {.name = "shadow.map", .bytes = sizeof(shader::ShadowMap)}};
    map->bins = std::make_unique<CasterBins>(*mDevice, mCasters, choice, data);
    return map;
}

void Shadows::prepare(gpu::Submitter& submitter, const MeasureFunction& measure) {
    const std::vector<Map*> maps = allMaps();
    if (maps.empty()) return;
    const auto uploadMaps = [&] {
        submitter.submitAndWait("upload shadow maps", [&](gpu::Commands& commands) {
            for (Map* map : maps) gpu::upload(commands, map->buffer, std::span(&map->data, 1));
        });
    };
    uploadMaps();
    measure([&](frame::FrameBuilder& frame, frame::BufferRef spheres) {
        for (Map* map : maps) map->bins->declareCount(frame, map->buffer, spheres);
    });
    for (Map* map : maps) map->bins->allocate(map->data);
    linkOpaqueMaps();
    uploadMaps();
}

std::vector<Shadows::Map*> Shadows::allMaps() const {
    std::vector<Map*> maps;
    for (const LightMaps& light : mLights)
        for (Map* map : {light.opaque.get(), light.own.get()})
            if (map) maps.push_back(map);
    return maps;
}

void Shadows::reserve(std::uint32_t pairs) {
    for (Map* map : allMaps()) map->bins->reserve(map->data, pairs);
    linkOpaqueMaps();
}

void Shadows::fit(std::span<const scene::Light> lights, const dvec3& origin,
                  const Box3& translucentBounds) {
    mCasters.origin = origin;
    mCasters.translucentBounds = translucentBounds;
    for (std::size_t i = 0; i < mLights.size(); ++i)
        for (Map* map : {mLights[i].opaque.get(), mLights[i].own.get()}) {
            if (!map) continue;
            const Box3 bounds = boundsOf(mCasters, map->choice);
            if (!bounds.isEmpty()) map->bounds = bounds;
            fitMap(lights[i], map->bounds, map->focus, origin, map->data.filterRadius + 2,
                   map->data);
        }
}

void Shadows::recordMaps(gpu::Commands& commands, gpu::UploadRing& ring) const {
    for (const LightMaps& light : mLights)
        for (const Map* map : {light.opaque.get(), light.own.get()})
            if (map) ring.write(commands, map->buffer, std::span(&map->data, 1));
}

std::uint64_t Shadows::droppedPairs() const {
    std::uint64_t dropped = 0;
    for (const LightMaps& light : mLights)
        for (const Map* map : {light.opaque.get(), light.own.get()})
            if (map) dropped += map->bins->droppedPairs();
    return dropped;
}

bool Shadows::keepsMaps() const {
    const std::vector<Map*> maps = allMaps();
    return std::any_of(maps.begin(), maps.end(), [](const Map* map) { return map->isKept; });
}

void Shadows::invalidate() {
    for (Map* map : allMaps()) map->isBuilt = false;
}

// Once the lists' memory is known.
void Shadows::linkOpaqueMaps() {
    for (LightMaps& light : mLights) {
        if (!light.own) light.own = std::move(light.opaque);
        if (!light.own) continue;
        // A light without anything translucent before it has the opaque map alone.
        const Map* opaque = light.opaque                                    ? light.opaque.get()
                            : light.own->data.store == shader::kStoreOpaque ? light.own.get()
                                                                            : nullptr;
        if (opaque) light.own->data.opaque = opaque->buffer.deviceAddress();
    }
}

void Shadows::declare(frame::FrameBuilder& frame, frame::BufferRef spheres) {
    bool isAny = false;
    for (LightMaps& light : mLights)
        for (Map* map : {light.opaque.get(), light.own.get()}) {
            if (!map || (map->isKept && map->isBuilt)) continue;
            map->bins->declare(frame, map->buffer, spheres);
            map->store->declare(frame, {.map = &map->data,
                                        .mapBuffer = &map->buffer,
                                        .casters = &mCasters,
                                        .bins = map->bins.get(),
                                        .spheres = spheres});
            map->isBuilt = isAny = true;
        }
    // Shaders reach maps and shares by address, from any pass that lights something: writers are the
    // passes above, readers all that follow.
    const auto finish = [&](const char* name) {
        frame.addPass(name).record([](gpu::Commands& commands, const frame::PassResources&) {
            commands.memoryBarrier(
                VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_READ_BIT);
        });
    };
    if (isAny) finish("shadow.finish");
    if (!mShares) return;
    mShares->declare(frame, spheres);
    finish("shadow.finish_spheres");
}

std::vector<VkDeviceAddress> Shadows::addresses() const {
    std::vector<VkDeviceAddress> addresses;
    for (const LightMaps& light : mLights)
        addresses.push_back(light.own ? light.own->buffer.deviceAddress() : 0);
    return addresses;
}

std::map<std::string, std::uint64_t> Shadows::bytes() const {
    std::map<std::string, std::uint64_t> kinds;
    for (const LightMaps& light : mLights)
        for (const Map* map : {light.own.get(), light.opaque.get()}) {
            if (!map) continue;
            kinds["shadows"] += map->store->bytes() + map->buffer.bytes();
            kinds["shadowBins"] += map->bins->bytes();
        }
    if (mShares) kinds["shadowShares"] = mShares->bytes();
    return kinds;
}

Footprint Shadows::footprint(std::uint32_t light) const {
    Footprint footprint;
    const Map* map = mLights[light].own.get();
    if (!map) return footprint;
    const shader::ShadowMap& data = map->data;
    footprint.bytesPerTexel =
        static_cast<double>(map->store->bytes()) / static_cast<double>(texelCount(data));
    if (!data.isDirectional || data.store == shader::kStoreExact) return footprint;
    footprint.reach = 2.0 * data.extent / data.resolution * (data.filterRadius + 1);
    footprint.right = dvec3(data.right);
    footprint.up = dvec3(data.up);
    return footprint;
}

}  // namespace brume::shadows
