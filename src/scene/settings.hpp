// SPDX-License-Identifier: Apache-2.0
// Named settings of a technique, from the scene file or from --set.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace brume::scene {

/// key -> value as text ("512", "true", "stratified").
using Settings = std::map<std::string, std::string>;

/// What a technique says about one of its settings.
struct SettingInfo {
    std::string_view name;
    std::string_view values;  ///< range or choices, with unit
    std::string_view defaultValue;
    std::string_view meaning;
};

/// Reads settings one by one and then complains about what nobody asked for, so that each
/// technique lists its own keys once. Throws an input Error for values that do not parse or lie
/// outside [lo, hi].
class SettingsReader {
  public:
    /// `doing` opens each message, e.g. "setting up method linked_list".
    SettingsReader(const Settings& settings, std::string doing);

    double number(const std::string& key, double fallback, double lo, double hi);
    long long integer(const std::string& key, long long fallback, long long lo, long long hi);
    bool boolean(const std::string& key, bool fallback);
    std::string choice(const std::string& key, const std::string& fallback,
                       const std::vector<std::string>& allowed);

    /// Throws if a key was given that none of the calls above asked for; the message lists those
    /// that were.
    void finish() const;

  private:
    const std::string* find(const std::string& key);

    const Settings& mSettings;
    std::string mDoing;
    std::vector<std::string> mKnown;
};

}  // namespace brume::scene
