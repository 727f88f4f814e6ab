// SPDX-License-Identifier: Apache-2.0
// One effect file under the user's hands: what can be changed about it, with units, limits and
// explanations from the schema and the module tables.
#pragma once

#include <view/json_text.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace brume::view {

/// One value of the file.
struct EffectKey {
    std::string pointer;  ///< JSON pointer; the file may not have it yet
    std::string name, unit, summary;
    std::vector<double> values;         ///< 1 to 3 numbers as they are now; empty for a word
    double lo = 0, hi = 0;              ///< of each
    bool isInteger = false;
    bool isPair = false;                ///< [low, high]; the file may have a single number
    std::vector<std::string> choices;   ///< of a word
    std::string word;
};

/// What belongs together: the effect, an emitter, a module.
struct EffectGroup {
    std::string title, summary;
    std::vector<EffectKey> keys;
};

class EffectEdit {
  public:
    /// Reads the file. Throws an input Error.
    explicit EffectEdit(std::filesystem::path file);

    const std::filesystem::path& file() const { return mFile; }
    const std::string& text() const { return mText->text(); }
    bool isChanged() const { return mText->text() != mSaved; }
    std::vector<EffectGroup> groups() const;

    /// Changes one value. Throws an input Error; then nothing has changed.
    void set(const EffectKey& key);
    /// Writes the file, whole or not at all. Throws a failure Error.
    void save();
    /// Forgets all changes and reads the file again. Throws an input Error.
    void reload();

  private:
    std::filesystem::path mFile;
    std::shared_ptr<const JsonText> mText;
    std::string mSaved;
};

}  // namespace brume::view
