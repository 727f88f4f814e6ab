// SPDX-License-Identifier: Apache-2.0
// Puts the violation of a schema into words: the validator says only that there is one.
#include <scene/json_schema.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace brume::scene {
namespace {

using nlohmann::json;

std::string quoteValue(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return fmt::format("an array of {}", value.size());
    return quoteForMessage(value.dump(-1, ' ', false, json::error_handler_t::replace), 60);
}

bool isOfType(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return value.is_number();
}

/// Walks a schema and a value side by side.
class Explainer {
  public:
    explicit Explainer(const json& root) : mRoot(root) {}

    std::optional<Error> explain(const json& given, const JsonNode& node) const {
        const json& schema = resolve(given);
        if (breaksScalarRules(schema, node.json()))
            return node.error(
                fmt::format("is {}, must be {}", quoteValue(node.json()), describe(schema)));
        if (auto error = explainAnyOf(schema, node)) return error;
        if (auto error = explainParts(schema, node)) return error;
        if (node.json().is_object()) return explainObject(schema, node);
        if (node.json().is_array()) return explainArray(schema, node);
        return std::nullopt;
    }

  private:
    const json& resolve(const json& schema) const {
        const json* result = &schema;
        while (result->contains("$ref"))
            result = &mRoot.at(json::json_pointer((*result)["$ref"].get<std::string>().substr(1)));
        return *result;
    }

    static bool breaksScalarRules(const json& schema, const json& value) {
        const auto limit = [&schema](const char* key, double fallback) {
            return schema.value(key, fallback);
        };
        if (schema.contains("type") && !isOfType(value, schema["type"])) return true;
        if (schema.contains("const") && schema["const"] != value) return true;
        if (schema.contains("enum")) {
            const json& allowed = schema["enum"];
            if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) return true;
        }
        if (value.is_number()) {
            const double x = value.get<double>();
            return x < limit("minimum", -kInfinity) || x > limit("maximum", kInfinity) ||
                   x <= limit("exclusiveMinimum", -kInfinity) ||
                   x >= limit("exclusiveMaximum", kInfinity);
        }
        if (value.is_string())
            return value.get_ref<const std::string&>().size() <
                   schema.value("minLength", std::size_t{0});
        if (value.is_array())
            return value.size() < schema.value("minItems", std::size_t{0}) ||
                   value.size() > schema.value("maxItems", std::size_t(-1));
        return false;
    }

    /// What a schema allows, as the end of "must be ...".
    std::string describe(const json& given) const {
        const json& schema = resolve(given);
        if (schema.contains("const")) return quoteValue(schema["const"]);
        if (schema.contains("enum")) {
            std::vector<std::string> values;
            for (const json& value : schema["enum"]) values.push_back(quoteValue(value));
            return fmt::format("one of {}", fmt::join(values, ", "));
        }
        if (schema.contains("anyOf")) {
            std::vector<std::string> choices;
            for (const json& choice : schema["anyOf"]) choices.push_back(describe(choice));
            return fmt::format("{}", fmt::join(choices, ", or "));
        }
        const std::string type = schema.value("type", "");
        if (type == "number" || type == "integer") return describeNumber(schema, type);
        if (type == "array") return describeArray(schema);
        if (type == "string")
            return schema.contains("minLength") ? "a non-empty string" : "a string";
        return type == "boolean" ? "true or false" : "an object";
    }

    static std::string describeNumber(const json& schema, const std::string& type) {
        const std::string noun = type == "integer" ? "an integer" : "a number";
        const auto show = [&schema](const char* key) {
            return fmt::format("{}", schema[key].get<double>());
        };
        if (schema.contains("minimum") && schema.contains("maximum"))
            return noun + " from " + show("minimum") + " to " + show("maximum");
        std::vector<std::string> limits;
        if (schema.contains("minimum")) limits.push_back("of at least " + show("minimum"));
        if (schema.contains("exclusiveMinimum"))
            limits.push_back("above " + show("exclusiveMinimum"));
        if (schema.contains("maximum")) limits.push_back("at most " + show("maximum"));
        if (schema.contains("exclusiveMaximum"))
            limits.push_back("below " + show("exclusiveMaximum"));
        return fmt::format("{}{}{}", noun, limits.empty() ? "" : " ", fmt::join(limits, " and "));
    }

    std::string describeArray(const json& schema) const {
        if (schema["items"].is_array()) {
            std::vector<std::string> items;
            for (const json& item : schema["items"]) items.push_back(describe(item));
            return fmt::format("an array [{}]", fmt::join(items, ", "));
        }
        const std::size_t least = schema.value("minItems", std::size_t{0});
        const std::size_t most = schema.value("maxItems", std::size_t(-1));
        std::string count;
        if (least == most)
            count = fmt::format(" of {}", least);
        else if (most != std::size_t(-1))
            count = fmt::format(" of {} to {}", least, most);
        else if (least > 0)
            count = fmt::format(" of at least {}", least);
        return fmt::format("an array{}, each {}", count, describe(schema["items"]));
    }

    std::optional<Error> explainAnyOf(const json& schema, const JsonNode& node) const {
        if (!schema.contains("anyOf")) return std::nullopt;
        for (const json& choice : schema["anyOf"])
            if (!explain(choice, node)) return std::nullopt;
        return node.error(
            fmt::format("is {}, must be {}", quoteValue(node.json()), describe(schema)));
    }

    /// allOf and if-then-else.
    std::optional<Error> explainParts(const json& schema, const JsonNode& node) const {
        if (schema.contains("allOf"))
            for (const json& part : schema["allOf"])
                if (auto error = explain(part, node)) return error;
        if (schema.contains("if")) {
            const char* branch = explain(schema["if"], node) ? "else" : "then";
            if (schema.contains(branch)) return explain(schema[branch], node);
        }
        return std::nullopt;
    }

    std::optional<Error> explainObject(const json& schema, const JsonNode& node) const {
        const json none = json::object();
        const json& known = schema.contains("properties") ? schema["properties"] : none;
        const auto rest = schema.find("additionalProperties");
        const bool isClosed = rest != schema.end() && *rest == false;
        for (const auto& entry : node.json().items())
            if (isClosed && !known.contains(entry.key())) {
                std::vector<std::string> names;
                for (const auto& property : known.items()) names.push_back(property.key());
                return node.errorAtKey(
                    entry.key(), fmt::format("unknown key, known are {}", fmt::join(names, ", ")));
            }
        if (schema.contains("required"))
            for (const json& name : schema["required"]) {
                const auto& key = name.get_ref<const std::string&>();
                if (!node.has(key.c_str()))
                    return node.errorAtKey(
                        key, "missing" + (known.contains(key) ? ", must be " + describe(known[key])
                                                              : std::string()));
            }
        for (const auto& [key, member] : node.members()) {
            const json* part = known.contains(key) ? &known[key] : nullptr;
            if (!part && rest != schema.end() && rest->is_object()) part = &*rest;
            if (part)
                if (auto error = explain(*part, member)) return error;
        }
        return std::nullopt;
    }

    std::optional<Error> explainArray(const json& schema, const JsonNode& node) const {
        if (!schema.contains("items")) return std::nullopt;
        const json& items = schema["items"];
        const std::vector<JsonNode> values = node.items();
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (items.is_array() && i >= items.size()) break;
            if (auto error = explain(items.is_array() ? items[i] : items, values[i])) return error;
        }
        return std::nullopt;
    }

    const json& mRoot;
};

}  // namespace

std::optional<Error> explainViolation(const json& root, const JsonNode& node) {
    return Explainer(root).explain(root, node);
}

}  // namespace brume::scene
