// SPDX-License-Identifier: Apache-2.0
// Checks a document against a JSON Schema.
#pragma once

#include <scene/json_node.hpp>

#include <memory>
#include <optional>

namespace brume::scene {

/// A schema (draft 7) that is ready to check documents. Immutable, usable from several threads.
class JsonSchema {
  public:
    /// `text`: the schema; throws AssertionError if it is broken.
    explicit JsonSchema(const char* text);
    ~JsonSchema();

    /// Throws an input Error that names the first offending key and what is allowed there.
    void validate(const JsonDocument& document) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

/// Where and how a value breaks a schema, in words; `root` is the whole schema, in which references
/// are looked up. Nothing if it keeps to the schema, or breaks it in a keyword not used in
/// docs/schema.
std::optional<Error> explainViolation(const nlohmann::json& root, const JsonNode& node);

}  // namespace brume::scene
