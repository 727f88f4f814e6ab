// SPDX-License-Identifier: Apache-2.0
// What a host has put into a scene: from files and by calls, under ids that stay.
#pragma once

#include <brume/brume.h>
#include <core/log.hpp>
#include <host/context.hpp>
#include <render/renderer.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace brume::host {

/// "key=value key=value" of a call. Throws an input Error.
scene::Settings readSettings(const char* call, const char* text);

class Model {
  public:
    /// Reads the scene that `info` names. Throws an Error.
    Model(const Context& context, const BrumeSceneCreateInfo& info);

    const render::PreparedScene& prepared() const { return mPrepared; }
    /// Of the host's choice, of the scene, or one that hosts can use.
    const render::Options& options() const { return mOptions; }
    BrumeInside inside() const { return mInside; }

    BrumeId addMedium(const BrumeMedium& medium);
    void setMedium(BrumeId id, const BrumeMedium& medium);
    BrumeId findMedium(const char* name) const;
    /// Number `index`; 0 beyond the last.
    BrumeId light(std::uint32_t index) const {
        return index < mLightIds.size() ? mLightIds[index] : 0;
    }
    /// The place of a light among those of the shaders' array; none for ambient ones.
    std::optional<std::size_t> shaderLight(BrumeId id) const;
    BrumeId addLight(const BrumeLight& light);
    void setLight(BrumeId id, const BrumeLight& light);
    BrumeId addSpheres(BrumeId medium, std::uint32_t count, const BrumeSphere* spheres);
    void setSpheres(BrumeId id, const BrumeSphere* spheres);
    BrumeId addVolume(const BrumeVolume& volume);
    BrumeId addEffect(const BrumeEffect& effect);
    void setEffectTransform(BrumeId id, const double* worldFromEffect);
    void remove(BrumeId id);
    /// The world counts from another point now.
    void rebase(const double* newOrigin);
    /// World box that an effect's particles are taken to stay in.
    Box3 boundsOf(BrumeId id) const;

    /// Moves the clocks of all effects on.
    void step(double seconds);
    /// Reads changed files again; returns how many.
    std::uint32_t reload();

    /// Rises when the structure changes: memory and pipelines must be made anew.
    std::uint64_t structure() const { return mStructure; }
    /// Rises when values change.
    std::uint64_t values() const { return mValues; }

    /// World box of media and glass: of what stands still, and of effects as they are placed now.
    Box3 stillBounds() const;
    Box3 effectBounds() const;

  private:
    struct SphereGroup {
        BrumeId id = 0;
        std::size_t first = 0, count = 0;
    };
    void readScene(const BrumeSceneCreateInfo& info);
    void adoptScene(scene::Scene scene);
    void chooseMethod(const BrumeSceneCreateInfo& info);
    void addVolumeOf(const scene::Volume& volume);
    /// Throws an input Error for effects that hosts cannot have.
    void checkEffect(const scene::Effect& effect, const char* call) const;
    void applyBudgets();
    void moveAll(const dvec3& offset);
    void extendByEffect(Box3& bounds, std::size_t entry) const;
    void addEntries(const scene::EffectInstance& root, std::size_t at);
    void watch(const std::filesystem::path& file);
    bool hasChanged(const std::filesystem::path& file) const;
    std::uint32_t reloadEffects();
    bool reloadSceneFile();
    BrumeId nextId() { return ++mLastId; }
    std::uint32_t mediumOf(const char* call, BrumeId id) const;

    const Context* mContext;
    render::PreparedScene mPrepared;
    render::Options mOptions;
    BrumeInside mInside = BRUME_INSIDE_NOTHING;
    dvec3 mOrigin{0};  // of the world, from that of the files
    BrumeId mLastId = 0;
    std::uint64_t mRevision = 0;  // of effects
    std::uint64_t mStructure = 1, mValues = 1;
    bool mIsFromFileOnly = true;                             // nothing was added by calls
    std::vector<BrumeId> mMediumIds, mLightIds, mVolumeIds;  // parallel to the scene's
    std::vector<BrumeId> mEffectIds;                         // likewise; those of sub-emitters, too
    std::vector<double> mEffectRadii;                        // bounds, m about their origins
    std::vector<SphereGroup> mSpheres;
    std::map<std::filesystem::path, std::filesystem::file_time_type> mFiles;
};

}  // namespace brume::host
