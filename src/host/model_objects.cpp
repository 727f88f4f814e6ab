// SPDX-License-Identifier: Apache-2.0
// What a host adds to a scene, changes and removes by calls.
#include <host/errors.hpp>
#include <host/files.hpp>
#include <host/model.hpp>
#include <particles/budget.hpp>
#include <particles/compiled_effect.hpp>
#include <scene/loader.hpp>
#include <shadows/store_info.hpp>

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace brume::host {
namespace {

dvec3 toVector(const char* call, const char* name, const double* v, double lo, double hi) {
    for (int i = 0; i < 3; ++i)
        if (!(v[i] >= lo && v[i] <= hi))
            throw refuse(
                call, name,
                fmt::format("it is ({}, {}, {}), allowed are {} to {}", v[0], v[1], v[2], lo, hi));
    return {v[0], v[1], v[2]};
}

double toNumber(const char* call, const char* name, double v, double lo, double hi) {
    if (!(v >= lo && v <= hi))
        throw refuse(call, name, fmt::format("it is {}, allowed are {} to {}", v, lo, hi));
    return v;
}

dmat4 toTransform(const char* call, const double* given) {
    const dmat4 m = glm::make_mat4(given);
    bool isZero = true;
    for (int i = 0; i < 16; ++i) isZero = isZero && given[i] == 0;
    if (isZero) return dmat4(1);
    const double scale = particles::lengthScale(m);
    const dmat3 product = dmat3(m) * glm::transpose(dmat3(m));
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(product[i][j] - (i == j ? scale * scale : 0)) <= 1e-4 * scale * scale))
                throw refuse(call, "worldFromEffect",
                             "it shears or scales unevenly, allowed are rotation, translation and "
                             "uniform scale");
        if (!std::isfinite(m[3][i]))
            throw refuse(call, "worldFromEffect", "its translation is not finite");
    }
    return m;
}

constexpr double kHuge = 1e12;

scene::Medium toMedium(const char* call, const BrumeMedium& given) {
    scene::Medium medium;
    medium.name = given.name ? given.name : "";
    medium.extinction = toVector(call, "extinction", given.extinction, 0, kHuge);
    medium.albedo = toVector(call, "albedo", given.albedo, 0, 1);
    medium.emission = toVector(call, "emission", given.emission, 0, kHuge);
    medium.g = toNumber(call, "g", given.g, -0.999, 0.999);
    if (given.phase > BRUME_PHASE_HENYEY_GREENSTEIN)
        throw refuse(call, "phase", "it is none of BrumePhase");
    medium.phase = static_cast<scene::PhaseType>(given.phase);
    return medium;
}

scene::Light toLight(const char* call, const BrumeLight& given) {
    scene::Light light;
    if (given.type > BRUME_LIGHT_SPOT) throw refuse(call, "type", "it is none of BrumeLightType");
    light.type = static_cast<scene::LightType>(given.type);
    light.color = toVector(call, "color", given.color, 0, kHuge);
    light.position = toVector(call, "position", given.position, -kHuge, kHuge);
    if (light.type == scene::LightType::Directional || light.type == scene::LightType::Spot) {
        const dvec3 direction = toVector(call, "direction", given.direction, -kHuge, kHuge);
        if (!(glm::length(direction) > 0)) throw refuse(call, "direction", "its length is 0");
        light.direction = glm::normalize(direction);
    }
    if (light.type == scene::LightType::Spot) {
        light.outerAngle = toNumber(call, "outerAngle", given.outerAngle, 1e-6, radians(90));
        light.innerAngle = toNumber(call, "innerAngle", given.innerAngle, 0, light.outerAngle);
    }
    if (given.radius != 0) light.radius = toNumber(call, "radius", given.radius, 1e-9, kHuge);
    if (light.type != scene::LightType::Ambient && given.shadow) {
        light.shadow = given.shadow;
        light.shadowSettings = readSettings(call, given.shadowSettings);
        if (light.shadow != "none" && shadows::storeBits(light.shadow) == 0)
            throw refuse(call, "shadow",
                         fmt::format("there is no shadow store \"{}\"", light.shadow));
    }
    return light;
}

scene::MediumSphere toSphere(const char* call, const BrumeSphere& given, std::uint32_t medium) {
    scene::MediumSphere sphere;
    sphere.center = toVector(call, "center", given.center, -kHuge, kHuge);
    sphere.radius = static_cast<float>(toNumber(call, "radius", given.radius, 0, 1e9));
    sphere.density = static_cast<float>(toNumber(call, "density", given.density, 0, 1e9));
    sphere.tint = {given.tint[0], given.tint[1], given.tint[2]};
    if (sphere.tint == vec3(0)) sphere.tint = vec3(1);
    sphere.medium = medium;
    sphere.profile = given.smooth ? scene::Profile::Smooth : scene::Profile::Constant;
    return sphere;
}

/// The place of an id among others. Throws an input Error.
std::size_t placeOf(const std::vector<BrumeId>& ids, BrumeId id, const char* call,
                    const char* kind) {
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (id == 0 || found == ids.end())
        throw refuse(call, "id", fmt::format("the scene has no {} with id {}", kind, id));
    return static_cast<std::size_t>(found - ids.begin());
}

}  // namespace

std::uint32_t Model::mediumOf(const char* call, BrumeId id) const {
    return static_cast<std::uint32_t>(placeOf(mMediumIds, id, call, "medium"));
}

BrumeId Model::addMedium(const BrumeMedium& medium) {
    mPrepared.scene.media.push_back(toMedium("brumeAddMedium", medium));
    mMediumIds.push_back(nextId());
    mIsFromFileOnly = false;
    ++mStructure;
    return mMediumIds.back();
}

void Model::setMedium(BrumeId id, const BrumeMedium& medium) {
    constexpr const char* kCall = "brumeSetMedium";
    scene::Medium& target = mPrepared.scene.media[mediumOf(kCall, id)];
    scene::Medium fresh = toMedium(kCall, medium);
    fresh.name = target.name;
    // Pipelines are made for grey or for coloured media, and for those that scatter.
    const auto isGrey = [](const dvec3& v) { return v.x == v.y && v.y == v.z; };
    const auto scatters = [](const scene::Medium& m) { return m.extinction * m.albedo != dvec3(0); };
    if (isGrey(fresh.extinction) != isGrey(target.extinction) ||
        scatters(fresh) != scatters(target))
        ++mStructure;
    target = std::move(fresh);
    ++mValues;
}

BrumeId Model::findMedium(const char* name) const {
    for (std::size_t i = 0; name && i < mMediumIds.size(); ++i)
        if (mPrepared.scene.media[i].name == name) return mMediumIds[i];
    return 0;
}

BrumeId Model::addLight(const BrumeLight& light) {
    mPrepared.scene.lights.push_back(toLight("brumeAddLight", light));
    mLightIds.push_back(nextId());
    mIsFromFileOnly = false;
    ++mStructure;
    return mLightIds.back();
}

void Model::setLight(BrumeId id, const BrumeLight& light) {
    constexpr const char* kCall = "brumeSetLight";
    scene::Light& target = mPrepared.scene.lights[placeOf(mLightIds, id, kCall, "light")];
    scene::Light fresh = toLight(kCall, light);
    if (fresh.type != target.type) throw refuse(kCall, "type", "it differs from the light's");
    fresh.shadow = target.shadow;
    fresh.shadowSettings = target.shadowSettings;
    target = std::move(fresh);
    ++mValues;
}

std::optional<std::size_t> Model::shaderLight(BrumeId id) const {
    const std::size_t place = placeOf(mLightIds, id, "brumeGetShadow", "light");
    const auto& lights = mPrepared.scene.lights;
    if (lights[place].type == scene::LightType::Ambient) return std::nullopt;
    return static_cast<std::size_t>(
        std::count_if(lights.begin(), lights.begin() + place,
                      [](const auto& l) { return l.type != scene::LightType::Ambient; }));
}

BrumeId Model::addSpheres(BrumeId medium, std::uint32_t count, const BrumeSphere* spheres) {
    constexpr const char* kCall = "brumeAddSpheres";
    const std::uint32_t index = mediumOf(kCall, medium);
    if (count == 0 || !spheres) throw refuse(kCall, "count", "there are no spheres");
    std::vector<scene::MediumSphere> added;
    for (std::uint32_t i = 0; i < count; ++i) {
        added.push_back(toSphere(kCall, spheres[i], index));
        added.back().id = static_cast<std::uint32_t>(mPrepared.spheres.size() + i);
    }
    mSpheres.push_back({nextId(), mPrepared.spheres.size(), count});
    mPrepared.spheres.insert(mPrepared.spheres.end(), added.begin(), added.end());
    mIsFromFileOnly = false;
    ++mStructure;
    return mSpheres.back().id;
}

void Model::setSpheres(BrumeId id, const BrumeSphere* spheres) {
    constexpr const char* kCall = "brumeSetSpheres";
    const auto group = std::find_if(mSpheres.begin(), mSpheres.end(),
                                    [&](const SphereGroup& g) { return g.id == id; });
    if (group == mSpheres.end())
        throw refuse(kCall, "id", fmt::format("the scene has no spheres with id {}", id));
    if (!spheres) throw refuse(kCall, "spheres", "it is null");
    for (std::size_t i = 0; i < group->count; ++i) {
        scene::MediumSphere& target = mPrepared.spheres[group->first + i];
        scene::MediumSphere fresh = toSphere(kCall, spheres[i], target.medium);
        fresh.id = target.id;
        if (fresh.profile != target.profile) ++mStructure;
        target = fresh;
    }
    ++mValues;
}

BrumeId Model::addVolume(const BrumeVolume& volume) {
    constexpr const char* kCall = "brumeAddVolume";
    const BrumeDensity density = readStruct(kCall, volume.density);
    scene::Volume entry;
    entry.medium = mediumOf(kCall, volume.medium);
    volumes::VolumeGrid grid = makeGrid(density, kCall, "density");
    mPrepared.volumes.push_back(std::move(grid));
    mPrepared.scene.volumes.push_back(entry);
    mVolumeIds.push_back(nextId());
    mIsFromFileOnly = false;
    ++mStructure;
    return mVolumeIds.back();
}

BrumeId Model::addEffect(const BrumeEffect& given) {
    constexpr const char* kCall = "brumeAddEffect";
    if (!given.file == !given.text)
        throw refuse(kCall, "file", "either a file or a text must be given");
    scene::EffectInstance root;
    if (given.file) {
        root.file = std::filesystem::absolute(given.file).lexically_normal();
        root.effect = scene::loadEffect(root.file, mContext->log());
    } else {
        root.effect = scene::parseEffect(given.text, "effect.json", mContext->log());
    }
    checkEffect(root.effect, kCall);
    root.worldFromEffect = toTransform(kCall, given.worldFromEffect);
    root.seed = given.seed;
    root.time = toNumber(kCall, "time", given.time, 0, 1e9);
    const BrumeId medium = given.medium ? given.medium : findMedium(root.effect.medium.c_str());
    if (medium == 0)
        throw refuse(kCall, "medium",
                     fmt::format("the scene has no medium \"{}\", which the effect names",
                                 root.effect.medium));
    root.medium = mediumOf(kCall, medium);
    const double radius = toNumber(kCall, "boundsRadius", given.boundsRadius, 0, 1e9);
    root.key = ++mRevision;
    const std::size_t at = mPrepared.scene.effects.size();
    addEntries(root, at);
    applyBudgets();
    const BrumeId id = nextId();
    for (std::size_t i = at; i < mEffectIds.size(); ++i) mEffectIds[i] = id;
    if (radius > 0) mEffectRadii[at] = radius;
    if (!root.file.empty()) watch(root.file);
    mIsFromFileOnly = false;
    ++mStructure;
    return id;
}

// The instance and its sub-emitters, each before its own; sub-emitters of calls have its medium
// unless the scene knows theirs.
void Model::addEntries(const scene::EffectInstance& root, std::size_t at) {
    std::vector<scene::EffectInstance> entries;
    for (const scene::Effect* effect : particles::listPopulations(root.effect)) {
        scene::EffectInstance& entry = entries.emplace_back(root);
        entry.isSubEmitter = entries.size() > 1;
        if (!entry.isSubEmitter) continue;
        entry.effect = *effect;
        if (const BrumeId medium = findMedium(effect->medium.c_str()))
            entry.medium = mediumOf("brumeAddEffect", medium);
    }
    std::vector<double> radii(entries.size());
    radii[0] = estimateReach(root.effect);
    mEffectRadii.insert(mEffectRadii.begin() + at, radii.begin(), radii.end());
    mEffectIds.insert(mEffectIds.begin() + at, entries.size(), BrumeId{0});
    mPrepared.scene.effects.insert(mPrepared.scene.effects.begin() + at, entries.begin(),
                                   entries.end());
}

void Model::setEffectTransform(BrumeId id, const double* worldFromEffect) {
    constexpr const char* kCall = "brumeSetEffectTransform";
    placeOf(mEffectIds, id, kCall, "effect");
    if (!worldFromEffect) throw refuse(kCall, "worldFromEffect", "it is null");
    const dmat4 transform = toTransform(kCall, worldFromEffect);
    for (std::size_t i = 0; i < mEffectIds.size(); ++i)
        if (mEffectIds[i] == id) mPrepared.scene.effects[i].worldFromEffect = transform;
}

void Model::remove(BrumeId id) {
    bool isFound = false;
    const auto eraseAt = [&](auto& values, std::size_t i) { values.erase(values.begin() + i); };
    for (std::size_t i = mLightIds.size(); id && i-- > 0;)
        if (mLightIds[i] == id) {
            eraseAt(mLightIds, i), eraseAt(mPrepared.scene.lights, i);
            isFound = true;
        }
    for (std::size_t i = mVolumeIds.size(); id && i-- > 0;)
        if (mVolumeIds[i] == id) {
            eraseAt(mVolumeIds, i), eraseAt(mPrepared.scene.volumes, i);
            eraseAt(mPrepared.volumes, i);
            isFound = true;
        }
    for (std::size_t i = mEffectIds.size(); id && i-- > 0;)
        if (mEffectIds[i] == id) {
            eraseAt(mEffectIds, i), eraseAt(mEffectRadii, i);
            eraseAt(mPrepared.scene.effects, i);
            isFound = true;
        }
    for (std::size_t g = mSpheres.size(); id && g-- > 0;) {
        if (mSpheres[g].id != id) continue;
        const auto first = mPrepared.spheres.begin() + mSpheres[g].first;
        mPrepared.spheres.erase(first, first + mSpheres[g].count);
        for (std::size_t later = g + 1; later < mSpheres.size(); ++later)
            mSpheres[later].first -= mSpheres[g].count;
        eraseAt(mSpheres, g);
        for (std::size_t i = 0; i < mPrepared.spheres.size(); ++i)
            mPrepared.spheres[i].id = static_cast<std::uint32_t>(i);
        isFound = true;
    }
    if (!isFound)
        throw refuse(
            "brumeRemove", "id",
            fmt::format("the scene has no light, spheres, volume or effect with id {}", id));
    applyBudgets();
    mIsFromFileOnly = false;
    ++mStructure;
}

void Model::checkEffect(const scene::Effect& effect, const char* call) const {
    particles::requireReplayable(particles::compileEffect(effect), call);
    for (const scene::Effect* one : particles::listPopulations(effect))
        if (one->surface)
            mContext->log().warning(
                fmt::format("{}: ribbons and billboards are not shown in a host's frame, particles "
                            "with a medium are",
                            call));
}

void Model::applyBudgets() {
    const particles::BudgetCut cut = particles::applyBudgets(mPrepared.scene);
    particles::warnOfCut(cut, mPrepared.scene, mContext->log());
    // Simulations of another capacity begin anew and catch up.
    for (const std::size_t root : cut.changed) {
        ++mRevision;
        for (std::size_t i = root; i < mPrepared.scene.effects.size(); ++i) {
            if (i > root && !mPrepared.scene.effects[i].isSubEmitter) break;
            mPrepared.scene.effects[i].key = mRevision;
        }
    }
}

void Model::rebase(const double* newOrigin) {
    constexpr const char* kCall = "brumeRebaseScene";
    if (!newOrigin) throw refuse(kCall, "newOrigin", "it is null");
    const dvec3 origin(toNumber(kCall, "newOrigin", newOrigin[0], -1e12, 1e12),
                       toNumber(kCall, "newOrigin", newOrigin[1], -1e12, 1e12),
                       toNumber(kCall, "newOrigin", newOrigin[2], -1e12, 1e12));
    mOrigin += origin;
    moveAll(-origin);
    ++mValues;
}

void Model::moveAll(const dvec3& offset) {
    scene::Scene& scene = mPrepared.scene;
    const auto move = [&](dmat4& transform) { transform[3] += dvec4(offset, 0); };
    for (scene::Light& light : scene.lights) light.position += offset;
    for (scene::Mesh& mesh : scene.meshes) move(mesh.worldFromObject);
    for (scene::EffectInstance& effect : scene.effects) move(effect.worldFromEffect);
    for (volumes::VolumeGrid& grid : mPrepared.volumes) move(grid.worldFromIndex);
    for (scene::MediumSphere& sphere : mPrepared.spheres) sphere.center += offset;
}

Box3 Model::boundsOf(BrumeId id) const {
    Box3 bounds;
    const std::size_t i = placeOf(mEffectIds, id, "brumeGetEffectBounds", "effect");
    extendByEffect(bounds, i);
    return bounds;
}

void Model::step(double seconds) {
    toNumber("brumeCmdSimulate", "seconds", seconds, 0, 1e6);
    for (scene::EffectInstance& effect : mPrepared.scene.effects) effect.time += seconds;
}

}  // namespace brume::host
