// SPDX-License-Identifier: Apache-2.0
// The scene that is open: loaded, reloaded when its files change, with effects as they are edited.
#pragma once

#include <core/log.hpp>
#include <render/renderer.hpp>
#include <view/effect_edit.hpp>
#include <view/file_watch.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace brume::view {

class Document {
  public:
    /// Loads the scene. Throws an Error.
    Document(std::filesystem::path file, const Log& log);

    const std::filesystem::path& file() const { return mFile; }
    /// With every effect at the time that the file says.
    const render::PreparedScene& prepared() const { return mPrepared; }
    /// Rises with every change of prepared().
    std::uint64_t revision() const { return mRevision; }
    /// Rises when the scene file was read.
    std::uint64_t loads() const { return mLoads; }

    /// Latest time of its effects, s; 0 without any.
    double homeTime() const;

    /// Reads what has changed on disk; on an error everything stays as it was. What happened as one
    /// line, or nothing. Edits that are not saved are lost where their file has changed.
    struct News {
        std::string text;
        bool isError = false;
    };
    std::optional<News> pollFiles();

    /// The files of volumes that are sequences follow the frame. Throws an Error.
    void showFrame(int frame);

    /// Counts as changed, effects included, because what draws it has changed. Throws an Error.
    void touch();

    /// Of the scene's effects, by file.
    std::vector<std::unique_ptr<EffectEdit>>& effects() { return mEffects; }
    /// Takes over what effects() say now. Throws an input Error.
    void applyEffects();

  private:
    /// `changed`: files whose edits are lost to what is on disk.
    void load(const std::vector<std::filesystem::path>& changed);
    bool isOurs(const std::filesystem::path& file) const;
    void rebuildEffects(scene::Scene& scene) const;
    void prepareKeepingVolumes(scene::Scene scene);
    std::vector<std::filesystem::path> listFiles() const;

    std::filesystem::path mFile;
    const Log& mLog;
    scene::Scene mScene;  // as loaded
    render::PreparedScene mPrepared;
    std::vector<std::unique_ptr<EffectEdit>> mEffects;
    FileWatch mWatch;
    int mFrame = 0;
    std::uint64_t mTouches = 0;
    std::uint64_t mRevision = 0, mLoads = 0;
};

/// Makes the effects' times follow the clock: each keeps its distance to the others that the file
/// gives it. `home`: the scene as in the file, at homeTime() `homeTime`.
void setTimes(scene::Scene& scene, const scene::Scene& home, double homeTime, double now);

}  // namespace brume::view
