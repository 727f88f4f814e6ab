// SPDX-License-Identifier: Apache-2.0
// The contract of a simulation module: what it is called in effect files, its settings, and what it
// adds to a step. A module is modules/<name>.{hpp,cpp}, for a field also
// shaders/particles/modules/<name>.h (the step, compiled by both sides), and one line
// particle_module(<name>) in CMakeLists.txt.
#pragma once

#include <shaders/particles/effect.h>
#include <shaders/particles/modules/collide_depth.h>
#include <core/math.hpp>
#include <particles/fields.hpp>
#include <scene/effect.hpp>

#include <optional>
#include <string>
#include <vector>

namespace brume::particles {

/// One setting: a number, a vector of three, or one word of several.
struct ModuleKey {
    std::string name;
    std::string unit;  ///< "1" for pure numbers, "word" for words
    std::string summary;
    std::vector<double> fallback;  ///< size 1 or 3; all components lie in [lo, hi]
    double lo = 0;
    double hi = 0;
    bool isInteger = false;
    bool isDirection = false;           ///< a vector of any length but zero; made a unit vector
    std::vector<std::string> choices;   ///< the words allowed, the default first; else empty
    bool isText = false;                ///< any text, required: a file, or a name in it
};

struct ModuleInfo {
    std::string name;  ///< "type" in effect files
    std::string summary;
    bool isReplayable = true;  ///< same bits on every device
    std::vector<ModuleKey> keys;
};

/// The settings of one use of a module, checked against its keys; missing ones have their defaults.
class ModuleValues {
  public:
    /// Throws an input Error at `settings.where` for an unknown key, a wrong size or a value out of
    /// range.
    ModuleValues(const ModuleInfo& info, const scene::ModuleSettings& settings);

    double number(const std::string& key) const { return mValues.at(key)[0]; }
    dvec3 vector(const std::string& key) const;
    /// Position among the key's choices.
    std::uint32_t choice(const std::string& key) const { return mChoices.at(key); }
    const std::string& text(const std::string& key) const { return mTexts.at(key); }
    /// What the keys of withFieldKeys() say.
    scene::FieldPlacement field() const;
    const std::string& where() const { return mWhere; }

  private:
    void set(const ModuleInfo& info, const ModuleKey& key, const std::vector<double>& value,
             const std::string& where);

    std::map<std::string, std::vector<double>> mValues;
    std::map<std::string, std::uint32_t> mChoices;
    std::map<std::string, std::string> mTexts;
    std::string mWhere;
    std::string mFileWhere;
};

/// What the modules of an effect add up to. Drag rates add; the wind is their mean, weighted by
/// rate.
struct ModuleSums {
    dvec3 acceleration{0};                           ///< m/s^2
    double dragRate = 0;                             ///< 1/s
    dvec3 dragRateTimesWind{0};                      ///< m/s^2
    std::vector<dvec3> noiseDrifts;                  ///< m/s, of each curl_noise
    shader::EffectParameters* parameters = nullptr;  ///< takes the fields
    const scene::Effect* effect = nullptr;           ///< for its grids
    FieldPacker* fields = nullptr;                   ///< takes the values of grids
    std::optional<shader::DepthCollider> depthCollider;
    std::string depthColliderWhere;                  ///< in the effect's file
};

/// The keys of a module that samples a grid of a VDB file, before its own.
std::vector<ModuleKey> withFieldKeys(std::vector<ModuleKey> keys);

/// Throws an input Error if `count` modules are all that an effect can have of this kind.
void checkModuleCount(const ModuleValues& values, const char* kind, std::uint32_t count);

/// The next free element of one of the arrays of EffectParameters. Throws an input Error if the
/// effect has too many modules of this kind.
template <typename T>
T& appendModule(const ModuleValues& values, const char* kind, std::uint32_t& count,
                T (&array)[shader::kMaxModulesPerType]) {
    checkModuleCount(values, kind, count);
    return array[count++];
}

/// Any two unit vectors orthogonal to the unit vector `axis` and to each other.
void makeFrame(const dvec3& axis, dvec3& tangent, dvec3& bitangent);

/// A module as the registry knows it. `add` may throw an input Error at values.where().
struct Module {
    ModuleInfo info;
    void (*add)(const ModuleValues& values, ModuleSums& sums);
};

/// All modules in the order of CMakeLists.txt.
const std::vector<Module>& modules();

/// Adds up the modules of an effect. Throws an input Error naming the place for unknown modules
/// (listing the known ones).
void addModules(const std::vector<scene::ModuleSettings>& settings, ModuleSums& sums);

}  // namespace brume::particles
