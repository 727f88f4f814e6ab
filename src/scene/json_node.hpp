// SPDX-License-Identifier: Apache-2.0
// Reading a validated JSON document: values with their paths and places.
#pragma once

#include <core/math.hpp>
#include <scene/json_document.hpp>

#include <string>
#include <utility>
#include <vector>

namespace brume::scene {

/// One value of a document, which must outlive it. The functions expect what the schema promised:
/// a wrong type throws AssertionError, never an input Error.
class JsonNode {
  public:
    explicit JsonNode(const JsonDocument& document);

    const nlohmann::json& json() const { return *mValue; }
    const std::string& path() const { return mPath; }  ///< "lights[2].radiance"; empty: the root
    std::string where() const { return mDocument->where(mPlaces->value); }
    TextPlace place() const { return mPlaces->value; }

    bool has(const char* key) const;
    JsonNode operator[](const std::string& key) const;   ///< a member that exists
    std::vector<JsonNode> items() const;                 ///< of an array
    std::vector<JsonNode> items(const char* key) const;  ///< of a member; empty if absent
    std::vector<std::pair<std::string, JsonNode>> members() const;  ///< of an object

    double number() const;
    std::string text() const;
    dvec2 vec2() const;
    dvec3 vec3() const;
    dvec3 unitVec3() const;  ///< throws an input Error for zero
    dvec2 range() const;     ///< a number or [low, high]; throws an input Error unless low <= high

    /// Overwrite `value` with the member `key` where there is one.
    void read(const char* key, double& value) const;
    void read(const char* key, int& value) const;
    void read(const char* key, std::uint32_t& value) const;
    void read(const char* key, std::uint64_t& value) const;
    void read(const char* key, std::string& value) const;
    void read(const char* key, dvec3& value) const;
    void readRadians(const char* key, double& value) const;  ///< from degrees

    /// An input Error at this value: `file:line:column: key "path": problem`.
    Error error(const std::string& problem) const;
    /// The same at the key of a member, for keys that should not be there.
    Error errorAtKey(const std::string& key, const std::string& problem) const;

  private:
    JsonNode(const JsonDocument& document, const nlohmann::json& value, const PlaceTree& places,
             std::string path);

    const JsonDocument* mDocument;
    const nlohmann::json* mValue;
    const PlaceTree* mPlaces;
    std::string mPath;
};

}  // namespace brume::scene
