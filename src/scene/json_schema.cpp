// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <scene/json_schema.hpp>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace brume::scene {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

struct JsonSchema::Impl {
    nlohmann::json json;
    valijson::Schema compiled;
};

JsonSchema::JsonSchema(const char* text) : mImpl(std::make_unique<Impl>()) {
    try {
        mImpl->json = nlohmann::json::parse(text);
        valijson::SchemaParser(valijson::SchemaParser::kDraft7)
            .populateSchema(Adapter(mImpl->json), mImpl->compiled);
    } catch (const std::exception& exception) {
        throw AssertionError(exception.what());
    }
}

JsonSchema::~JsonSchema() = default;

void JsonSchema::validate(const JsonDocument& document) const {
    // Without a list of results the validator stops at the first fault, however large the file.
    valijson::Validator validator;
    if (validator.validate(mImpl->compiled, Adapter(document.root()), nullptr)) return;
    const JsonNode root(document);
    if (const std::optional<Error> error = explainViolation(mImpl->json, root)) throw *error;
    valijson::ValidationResults results;
    validator.validate(mImpl->compiled, Adapter(document.root()), &results);
    throw root.error(results.numErrors() > 0 ? results.begin()->description : "breaks the schema");
}

}  // namespace brume::scene
