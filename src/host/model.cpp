// SPDX-License-Identifier: Apache-2.0
// Scenes from files and texts, and reading them again.
#include <host/errors.hpp>
#include <host/files.hpp>
#include <host/model.hpp>
#include <oit/method_info.hpp>
#include <particles/budget.hpp>
#include <particles/compiled_effect.hpp>
#include <render/shadow_casters.hpp>
#include <scene/loader.hpp>
#include <volumes/volume_spheres.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace brume::host {
namespace {

constexpr const char* kCreate = "brumeCreateScene";
// Without measuring first, these do not know how much memory they want.
constexpr const char* kFallbackMethod = "sorted";

double largestExtinction(const scene::Medium& medium) {
    return std::max({medium.extinction.x, medium.extinction.y, medium.extinction.z});
}

/// Methods that plan a frame from one before it, for which they wait.
bool needsMeasuring(std::string_view method) {
    return method == "tile" || method == "linked_list" || method == "march";
}

}  // namespace

scene::Settings readSettings(const char* call, const char* text) {
    scene::Settings settings;
    const std::string all = text ? text : "";
    for (std::size_t at = 0; at < all.size();) {
        const std::size_t end = std::min(all.find(' ', at), all.size());
        const std::string word = all.substr(at, end - at);
        at = end + 1;
        if (word.empty()) continue;
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0)
            throw refuse(call, "settings",
                         fmt::format("\"{}\" is no setting, allowed are words key=value", word));
        settings[word.substr(0, equals)] = word.substr(equals + 1);
    }
    return settings;
}

Model::Model(const Context& context, const BrumeSceneCreateInfo& info) : mContext(&context) {
    readScene(info);
    chooseMethod(info);
}

void Model::readScene(const BrumeSceneCreateInfo& info) {
    if (info.file && info.text) throw refuse(kCreate, "file", "both a file and a text are given");
    const ImageReading images(mContext->readers());
    if (info.file) {
        adoptScene(scene::loadScene(info.file, mContext->log()));
    } else if (info.text) {
        const std::filesystem::path folder = info.directory ? info.directory : ".";
        adoptScene(scene::parseScene(info.text, folder / "scene.json", mContext->log()));
        mPrepared.scene.file.clear();
    }
}

void Model::adoptScene(scene::Scene scene) {
    mPrepared = {};
    mPrepared.scene = std::move(scene);
    mMediumIds.clear(), mLightIds.clear(), mVolumeIds.clear();
    mEffectIds.clear(), mEffectRadii.clear(), mSpheres.clear();
    for (std::size_t i = 0; i < mPrepared.scene.media.size(); ++i) mMediumIds.push_back(nextId());
    for (std::size_t i = 0; i < mPrepared.scene.lights.size(); ++i) mLightIds.push_back(nextId());
    mPrepared.spheres = scene::makeMediumSpheres(mPrepared.scene.spheres);
    for (const scene::Volume& volume : mPrepared.scene.volumes) addVolumeOf(volume);
    if (!mPrepared.spheres.empty()) mSpheres.push_back({nextId(), 0, mPrepared.spheres.size()});
    BrumeId id = 0;
    for (const scene::EffectInstance& effect : mPrepared.scene.effects)
        if (!effect.isSubEmitter) checkEffect(effect.effect, kCreate);
    applyBudgets();
    for (scene::EffectInstance& effect : mPrepared.scene.effects) {
        if (!effect.isSubEmitter) id = nextId(), ++mRevision;
        effect.key = mRevision;
        mEffectIds.push_back(id);
        mEffectRadii.push_back(effect.isSubEmitter ? 0 : estimateReach(effect.effect));
        if (!effect.file.empty()) watch(effect.file);
    }
    if (!mPrepared.scene.file.empty()) watch(mPrepared.scene.file);
    moveAll(-mOrigin);
    ++mStructure;
}

void Model::addVolumeOf(const scene::Volume& volume) {
    mVolumeIds.push_back(nextId());
    volumes::VolumeGrid grid = readVolume(mContext->readers(), volume,
                                          largestExtinction(mPrepared.scene.media[volume.medium]));
    if (volume.representation == scene::VolumeRepresentation::Particles) {
        volumes::SphereOptions options;
        options.medium = volume.medium;
        options.firstId = static_cast<std::uint32_t>(mPrepared.spheres.size());
        const auto spheres = volumes::convertToSpheres(grid, options);
        mPrepared.spheres.insert(mPrepared.spheres.end(), spheres.begin(), spheres.end());
        volumes::VolumeGrid empty;
        empty.worldFromIndex = grid.worldFromIndex;
        grid = std::move(empty);
    }
    mPrepared.volumes.push_back(std::move(grid));
}

void Model::chooseMethod(const BrumeSceneCreateInfo& info) {
    const scene::RenderSettings& own = mPrepared.scene.render;
    mOptions.settings = readSettings(kCreate, info.settings);
    mOptions.hostLayers = info.hostLayers != 0;
    if (mOptions.hostLayers) {
        mOptions.method = info.method ? info.method : "weighted";
        for (const char* key : {"precision", "depthPower", "weightDistance"})
            if (mOptions.method != "weighted" || mOptions.settings.contains(key))
                throw refuse(
                    kCreate, "hostLayers",
                    fmt::format("with method {} and a setting {}, allowed is weighted with "
                                "its default weights",
                                mOptions.method, key));
    } else if (info.method) {
        mOptions.method = info.method;
    } else if (needsMeasuring(own.method)) {
        mOptions.method = kFallbackMethod;
    } else {
        mOptions.method = own.method;
        if (!info.settings) mOptions.settings = own.settings;
    }
    mInside = info.inside;
    if (mInside != BRUME_INSIDE_NOTHING && mOptions.method != "sorted" &&
        mOptions.method != "unordered")
        throw refuse(kCreate, "inside",
                     fmt::format("method {} needs images of its own, allowed are sorted and "
                                 "unordered",
                                 mOptions.method));
    std::string allowed;
    bool isKnown = false;
    for (const oit::MethodInfo& method : oit::listMethods()) {
        if (needsMeasuring(method.name)) continue;
        allowed += (allowed.empty() ? "" : ", ") + std::string(method.name);
        isKnown = isKnown || method.name == mOptions.method;
    }
    if (!isKnown)
        throw refuse(kCreate, "method",
                     fmt::format("\"{}\" is none that works within a host's frame, allowed are {}",
                                 mOptions.method, allowed));
}

void Model::watch(const std::filesystem::path& file) {
    std::error_code ignored;
    mFiles[file] = std::filesystem::last_write_time(file, ignored);
}

bool Model::hasChanged(const std::filesystem::path& file) const {
    const auto found = mFiles.find(file);
    if (found == mFiles.end()) return false;
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    return !error && time != found->second;
}

std::uint32_t Model::reload() {
    const bool isSceneNew = mIsFromFileOnly && reloadSceneFile();
    return reloadEffects() + (isSceneNew ? 1 : 0);
}

// Effects keep their clocks, so far as both files have them.
bool Model::reloadSceneFile() {
    const std::filesystem::path file = mPrepared.scene.file;
    if (file.empty() || !hasChanged(file)) return false;
    const ImageReading images(mContext->readers());
    scene::Scene scene = scene::loadScene(file, mContext->log());
    std::vector<scene::EffectInstance> before = mPrepared.scene.effects;
    render::PreparedScene kept = std::move(mPrepared);
    try {
        adoptScene(std::move(scene));
    } catch (...) {
        mPrepared = std::move(kept);
        throw;
    }
    std::vector<scene::EffectInstance>& now = mPrepared.scene.effects;
    for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i)
        if (now[i].file == before[i].file) now[i].time = before[i].time;
    return true;
}

std::uint32_t Model::reloadEffects() {
    // Read everything first: on an error nothing changes.
    std::map<std::filesystem::path, scene::Effect> fresh;
    for (const scene::EffectInstance& effect : mPrepared.scene.effects)
        if (!effect.isSubEmitter && !effect.file.empty() && !fresh.contains(effect.file) &&
            hasChanged(effect.file)) {
            scene::Effect read = scene::loadEffect(effect.file, mContext->log());
            checkEffect(read, "brumeReloadScene");
            fresh.emplace(effect.file, std::move(read));
        }
    for (const auto& [file, effect] : fresh) {
        for (std::size_t i = 0; i < mPrepared.scene.effects.size(); ++i) {
            scene::EffectInstance root = mPrepared.scene.effects[i];
            if (root.isSubEmitter || root.file != file) continue;
            const BrumeId id = mEffectIds[i];
            const auto isOurs = [&](BrumeId other) { return other == id; };
            const auto count = static_cast<std::size_t>(
                std::count_if(mEffectIds.begin(), mEffectIds.end(), isOurs));
            const auto erase = [&](auto& values) {
                values.erase(values.begin() + i, values.begin() + i + count);
            };
            erase(mPrepared.scene.effects);
            erase(mEffectIds);
            erase(mEffectRadii);
            root.effect = effect;
            root.key = ++mRevision;
            addEntries(root, i);
            for (std::size_t k = 0; k < particles::listPopulations(effect).size(); ++k)
                mEffectIds[i + k] = id;
        }
        watch(file);
    }
    if (!fresh.empty()) ++mStructure;
    return static_cast<std::uint32_t>(fresh.size());
}

Box3 Model::stillBounds() const { return render::findTranslucentBounds(mPrepared); }

Box3 Model::effectBounds() const {
    Box3 bounds;
    for (std::size_t i = 0; i < mPrepared.scene.effects.size(); ++i) {
        if (!mPrepared.scene.effects[i].isSubEmitter) extendByEffect(bounds, i);
    }
    return bounds;
}

void Model::extendByEffect(Box3& bounds, std::size_t entry) const {
    const dmat4& worldFromEffect = mPrepared.scene.effects[entry].worldFromEffect;
    const dvec3 origin(worldFromEffect[3]);
    const double reach = mEffectRadii[entry] * particles::lengthScale(worldFromEffect);
    bounds.extend(origin - dvec3(reach));
    bounds.extend(origin + dvec3(reach));
}

}  // namespace brume::host
