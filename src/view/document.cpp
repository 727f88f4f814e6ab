// SPDX-License-Identifier: Apache-2.0
#include <bench/prepare.hpp>
#include <core/error.hpp>
#include <particles/compiled_effect.hpp>
#include <scene/loader.hpp>
#include <view/document.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace brume::view {
namespace {

template <typename Named>
std::uint32_t findNamed(const std::vector<Named>& list, const std::string& name, const char* what,
                        const std::filesystem::path& file) {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].name == name) return static_cast<std::uint32_t>(i);
    throw inputError("showing an effect", file.string(),
                     fmt::format("it wants the {} '{}', which the scene lacks", what, name));
}

/// The entries of one instance with another effect.
std::vector<scene::EffectInstance> makeEntries(const scene::Scene& scene,
                                               const scene::EffectInstance& root,
                                               const scene::Effect& effect) {
    std::vector<scene::EffectInstance> entries;
    for (const scene::Effect* population : particles::listPopulations(effect)) {
        scene::EffectInstance& entry = entries.emplace_back(root);
        entry.effect = *population;
        entry.isSubEmitter = entries.size() > 1;
        if (population->surface)
            entry.material =
                findNamed(scene.materials, population->surface->material, "material", root.file);
        else
            entry.medium = findNamed(scene.media, population->medium, "medium", root.file);
    }
    return entries;
}

}  // namespace

Document::Document(std::filesystem::path file, const Log& log) : mFile(std::move(file)), mLog(log) {
    load({});
}

void Document::load(const std::vector<std::filesystem::path>& changed) {
    const auto isChanged = [&](const std::filesystem::path& file) {
        return std::find(changed.begin(), changed.end(), file) != changed.end();
    };
    scene::Scene scene = scene::loadScene(mFile, mLog);
    std::vector<std::unique_ptr<EffectEdit>> effects;
    std::set<std::filesystem::path> files;
    for (const scene::EffectInstance& instance : scene.effects)
        if (!instance.file.empty() && files.insert(instance.file).second) {
            // What the user has changed and not saved stays.
            const auto known =
                std::find_if(mEffects.begin(), mEffects.end(), [&](const auto& edit) {
                    return edit->file() == instance.file && edit->isChanged() &&
                           !isChanged(instance.file);
                });
            effects.push_back(known != mEffects.end()
                                  ? std::make_unique<EffectEdit>(**known)
                                  : std::make_unique<EffectEdit>(instance.file));
        }
    std::swap(mEffects, effects);
    try {
        scene::Scene edited = scene;
        rebuildEffects(edited);
        mPrepared = bench::prepareScene(std::move(edited), mLog, mFrame);
    } catch (...) {
        std::swap(mEffects, effects);
        throw;
    }
    mScene = std::move(scene);
    mWatch.watch(listFiles());
    ++mRevision;
    ++mLoads;
}

// Edited effects in place of the files' own, and keys by which simulations go on that have not
// changed.
void Document::rebuildEffects(scene::Scene& scene) const {
    std::map<std::filesystem::path, const EffectEdit*> edits;
    for (const auto& edit : mEffects) edits[edit->file()] = edit.get();
    std::vector<scene::EffectInstance> entries;
    for (std::size_t i = 0; i < scene.effects.size(); ++i) {
        const scene::EffectInstance& root = scene.effects[i];
        if (root.isSubEmitter) continue;
        const EffectEdit* edit = edits[root.file];
        if (!edit) continue;
        const scene::Effect effect = scene::parseEffect(edit->text(), root.file, mLog);
        particles::compileEffect(effect);
        for (scene::EffectInstance& entry : makeEntries(scene, root, effect)) {
            const std::uint64_t text = std::hash<std::string>()(edit->text());
            entry.key = (text ^ mTouches * 0xd6e8feb86659fd93ull ^
                         (entries.size() + 1) * 0x9e3779b97f4a7c15ull) |
                        1;
            entries.push_back(std::move(entry));
        }
    }
    scene.effects = std::move(entries);
}

double Document::homeTime() const {
    double time = 0;
    for (const scene::EffectInstance& effect : mPrepared.scene.effects)
        time = std::max(time, effect.time);
    return time;
}

std::vector<std::filesystem::path> Document::listFiles() const {
    std::vector<std::filesystem::path> files = {mScene.file};
    for (const auto& edit : mEffects) files.push_back(edit->file());
    for (const scene::Volume& volume : mPrepared.scene.volumes) files.push_back(volume.file);
    return files;
}

// What we have saved ourselves is no news.
bool Document::isOurs(const std::filesystem::path& file) const {
    return std::any_of(mEffects.begin(), mEffects.end(), [&](const auto& edit) {
        if (edit->file() != file) return false;
        try {
            return EffectEdit(file).text() == edit->text();
        } catch (const Error&) {
            return false;
        }
    });
}

std::optional<Document::News> Document::pollFiles() {
    const std::vector<std::filesystem::path> changed = mWatch.takeChanged();
    if (changed.empty()) return std::nullopt;
    if (std::all_of(changed.begin(), changed.end(), [&](const auto& f) { return isOurs(f); }))
        return std::nullopt;
    try {
        load(changed);
    } catch (const Error& error) {
        return News{error.what(), true};
    }
    return News{fmt::format("reloaded {}", changed[0].filename().string()), false};
}

void Document::showFrame(int frame) {
    if (frame == mFrame) return;
    if (!bench::hasVolumeSequence(mScene)) {
        mFrame = frame;
        return;
    }
    scene::Scene edited = mScene;
    rebuildEffects(edited);
    mPrepared = bench::prepareScene(std::move(edited), mLog, frame);
    mFrame = frame;
    ++mRevision;
}

// Volumes may be large and have not changed.
void Document::prepareKeepingVolumes(scene::Scene scene) {
    const std::vector<scene::Volume> volumes = std::exchange(scene.volumes, {});
    render::PreparedScene prepared = bench::prepareScene(std::move(scene), mLog, mFrame);
    prepared.scene.volumes = volumes;
    prepared.volumes = std::move(mPrepared.volumes);
    prepared.spheres = std::move(mPrepared.spheres);
    mPrepared = std::move(prepared);
}

void Document::touch() {
    ++mTouches;  // new keys: simulations begin anew
    applyEffects();
}

void Document::applyEffects() {
    scene::Scene edited = mScene;
    rebuildEffects(edited);
    prepareKeepingVolumes(std::move(edited));
    ++mRevision;
}

void setTimes(scene::Scene& scene, const scene::Scene& home, double homeTime, double now) {
    for (std::size_t i = 0; i < scene.effects.size(); ++i)
        scene.effects[i].time = std::max(home.effects[i].time + now - homeTime, 0.0);
}

}  // namespace brume::view
