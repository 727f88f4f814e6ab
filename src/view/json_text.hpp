// SPDX-License-Identifier: Apache-2.0
// A JSON text whose values can be changed in place: comments, order, unknown members and layout of
// everything else stay as their author left them.
#pragma once

#include <scene/json_document.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace brume::view {

class JsonText {
  public:
    /// `name`: of the file, in messages. Throws an input Error for a text that is not JSON.
    JsonText(std::string text, std::string name);

    const std::string& text() const { return mText; }
    const nlohmann::json& root() const { return mDocument->root(); }

    /// Replaces the value at a JSON pointer ("/modules/0/strength"), or adds the last member of the
    /// pointer to its object. Throws an input Error where the object does not exist.
    void set(const std::string& pointer, const nlohmann::json& value);

  private:
    void replaceText(std::string text);
    std::size_t offsetOf(const scene::TextPlace& place) const;
    std::size_t endOfValue(std::size_t start) const;
    std::size_t skipBlank(std::size_t at) const;
    void addMember(const scene::PlaceTree& object, const std::string& key,
                   const std::string& value);

    std::string mText, mName;
    std::optional<scene::JsonDocument> mDocument;  // of the text
};

/// On one line as people write it: "[1, 2.5]", numbers with at most 6 digits.
std::string writeJson(const nlohmann::json& value);

}  // namespace brume::view
