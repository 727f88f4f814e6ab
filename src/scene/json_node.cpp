// SPDX-License-Identifier: Apache-2.0
#include <core/assert.hpp>
#include <scene/json_node.hpp>

#include <nlohmann/json.hpp>

namespace brume::scene {
namespace {

template <typename T>
T convert(const nlohmann::json& value) {
    try {
        return value.get<T>();
    } catch (const nlohmann::json::exception& exception) {
        throw AssertionError(exception.what());
    }
}

}  // namespace

JsonNode::JsonNode(const JsonDocument& document)
    : JsonNode(document, document.root(), document.places(), "") {}

JsonNode::JsonNode(const JsonDocument& document, const nlohmann::json& value,
                   const PlaceTree& places, std::string path)
    : mDocument(&document), mValue(&value), mPlaces(&places), mPath(std::move(path)) {}

bool JsonNode::has(const char* key) const { return mValue->is_object() && mValue->contains(key); }

JsonNode JsonNode::operator[](const std::string& key) const {
    const auto value = mValue->find(key);
    const auto places = mPlaces->members.find(key);
    if (value == mValue->end() || places == mPlaces->members.end())
        throw AssertionError("no member " + key);
    const std::string shown = quoteForMessage(key, 60);
    return {*mDocument, *value, places->second, mPath.empty() ? shown : mPath + "." + shown};
}

std::vector<JsonNode> JsonNode::items() const {
    std::vector<JsonNode> result;
    for (std::size_t i = 0; i < mPlaces->items.size(); ++i)
        result.push_back(JsonNode(*mDocument, (*mValue)[i], mPlaces->items[i],
                                  mPath + "[" + std::to_string(i) + "]"));
    return result;
}

std::vector<JsonNode> JsonNode::items(const char* key) const {
    return has(key) ? (*this)[key].items() : std::vector<JsonNode>();
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
    std::vector<std::pair<std::string, JsonNode>> result;
    for (const auto& entry : mPlaces->members)
        result.emplace_back(entry.first, (*this)[entry.first]);
    return result;
}

double JsonNode::number() const { return convert<double>(*mValue); }
std::string JsonNode::text() const { return convert<std::string>(*mValue); }

dvec2 JsonNode::vec2() const {
    const auto values = convert<std::vector<double>>(*mValue);
    BRUME_ASSERT_EQ(values.size(), 2u);
    return {values[0], values[1]};
}

dvec3 JsonNode::vec3() const {
    const auto values = convert<std::vector<double>>(*mValue);
    BRUME_ASSERT_EQ(values.size(), 3u);
    return {values[0], values[1], values[2]};
}

dvec3 JsonNode::unitVec3() const {
    const dvec3 value = vec3();
    // Through the largest component, so that neither 1e-200 nor 1e30 is lost when squared.
    const double largest =
        glm::max(glm::max(std::abs(value.x), std::abs(value.y)), std::abs(value.z));
    if (!(largest > 0)) throw error("is zero, must be a direction of any length but zero");
    return glm::normalize(value / largest);
}

dvec2 JsonNode::range() const {
    if (mValue->is_number()) return dvec2(number());
    const dvec2 value = vec2();
    if (value.x > value.y) throw error("is [high, low], must be [low, high]");
    return value;
}

void JsonNode::read(const char* key, double& value) const {
    if (has(key)) value = (*this)[key].number();
}
void JsonNode::read(const char* key, int& value) const {
    if (has(key)) value = convert<int>((*mValue)[key]);
}
void JsonNode::read(const char* key, std::uint32_t& value) const {
    if (has(key)) value = convert<std::uint32_t>((*mValue)[key]);
}
void JsonNode::read(const char* key, std::uint64_t& value) const {
    if (has(key)) value = convert<std::uint64_t>((*mValue)[key]);
}
void JsonNode::read(const char* key, std::string& value) const {
    if (has(key)) value = (*this)[key].text();
}
void JsonNode::read(const char* key, dvec3& value) const {
    if (has(key)) value = (*this)[key].vec3();
}
void JsonNode::readRadians(const char* key, double& value) const {
    if (has(key)) value = radians((*this)[key].number());
}

Error JsonNode::error(const std::string& problem) const {
    return mDocument->error(mPlaces->value,
                            mPath.empty() ? problem : "key \"" + mPath + "\": " + problem);
}

Error JsonNode::errorAtKey(const std::string& key, const std::string& problem) const {
    const auto found = mPlaces->members.find(key);
    const std::string shown = quoteForMessage(key, 60);
    return mDocument->error(
        found == mPlaces->members.end() ? mPlaces->value : found->second.key,
        "key \"" + (mPath.empty() ? shown : mPath + "." + shown) + "\": " + problem);
}

}  // namespace brume::scene
