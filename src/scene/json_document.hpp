// SPDX-License-Identifier: Apache-2.0
// A JSON text that remembers where each key and value stood, so that every message can say so.
#pragma once

#include <core/error.hpp>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace brume::scene {

/// One-based; the column counts bytes.
struct TextPlace {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
};

/// The places of a value, of its key (members of objects only) and of all below it.
struct PlaceTree {
    TextPlace key;
    TextPlace value;
    std::map<std::string, PlaceTree, std::less<>> members;
    std::vector<PlaceTree> items;
};

/// What a JSON text may contain, and how to speak of it.
struct JsonRules {
    std::string doing;       ///< opens each message: "loading scene"
    std::string name;        ///< of the file, in messages
    bool isStrict = true;    ///< duplicate keys and numbers beyond 1e30 are errors
    bool keepPlaces = true;  ///< false saves memory where nobody will ask
    std::size_t maxBytes = std::size_t{16} << 20;
};

/// A parsed text. Comments (// and /* */) are allowed; nesting at most 64 deep.
class JsonDocument {
  public:
    /// Throws an input Error with file:line:column.
    static JsonDocument parse(const std::string& text, JsonRules rules);

    /// The text of a file named rules.name. Throws an input Error if it is missing or too long.
    static std::string readText(const JsonRules& rules);

    JsonDocument(JsonDocument&&) noexcept;
    ~JsonDocument();

    const nlohmann::json& root() const { return *mRoot; }
    const PlaceTree& places() const { return mPlaces; }
    const JsonRules& rules() const { return mRules; }

    /// "file:line:column".
    std::string where(const TextPlace& place) const;

    /// An input Error at a place.
    Error error(const TextPlace& place, const std::string& problem) const;

  private:
    JsonDocument(JsonRules rules, std::unique_ptr<nlohmann::json> root, PlaceTree places);

    JsonRules mRules;
    std::unique_ptr<nlohmann::json> mRoot;
    PlaceTree mPlaces;
};

/// At most `limit` bytes of a text from a file, fit for a one-line message.
std::string quoteForMessage(const std::string& text, std::size_t limit = 120);

}  // namespace brume::scene
