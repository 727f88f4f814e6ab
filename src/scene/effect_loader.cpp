// SPDX-License-Identifier: Apache-2.0
#include <scene/json_schema.hpp>
#include <scene/loader.hpp>
#include <scene/loader_parts.hpp>

#include <nlohmann/json.hpp>
#include <text/effect.schema.json.hpp>

namespace brume::scene {
namespace {

JsonRules rulesFor(const std::filesystem::path& file) {
    JsonRules rules;
    rules.doing = "loading effect";
    rules.name = file.string();
    return rules;
}

const JsonSchema& compiledSchema() {
    static const JsonSchema schema(effectSchema());
    return schema;
}

void readShape(const JsonNode& node, Emitter& emitter) {
    const std::string type = node["type"].text();
    emitter.shape = type == "sphere" ? EmitterShape::Sphere
                    : type == "box"  ? EmitterShape::Box
                    : type == "disc" ? EmitterShape::Disc
                                     : EmitterShape::Point;
    node.read("position", emitter.position);
    node.read("radius", emitter.radius);
    node.read("size", emitter.size);
    if (node.has("normal")) emitter.normal = node["normal"].unitVec3();
}

Emitter readEmitter(const JsonNode& node) {
    Emitter emitter;
    node.read("rate", emitter.rate);
    for (const JsonNode& item : node.items("bursts")) {
        Burst burst;
        item.read("time", burst.time);
        item.read("count", burst.count);
        emitter.bursts.push_back(burst);
    }
    node.read("duration", emitter.duration);
    if (node.has("shape")) readShape(node["shape"], emitter);
    if (node.has("speed")) emitter.speed = node["speed"].range();
    if (node.has("direction")) emitter.direction = node["direction"].unitVec3();
    node.readRadians("spread", emitter.spread);
    emitter.lifetime = node["lifetime"].range();
    return emitter;
}

ModuleSettings readModule(const JsonNode& node) {
    ModuleSettings module;
    module.where = node.where();
    for (const auto& [key, value] : node.members()) {
        if (key == "type") {
            module.type = value.text();
            continue;
        }
        module.whereOf[key] = value.where();
        if (value.json().is_string())
            module.texts[key] = value.text();
        else if (value.json().is_boolean())
            module.values[key] = {value.json().get<bool>() ? 1.0 : 0.0};
        else if (value.json().is_array())
            module.values[key] = value.json().get<std::vector<double>>();
        else
            module.values[key] = {value.number()};
    }
    return module;
}

double readCurveValue(const JsonNode& node, double*) { return node.number(); }
dvec3 readCurveValue(const JsonNode& node, dvec3*) { return node.vec3(); }

template <typename T>
void readCurve(const JsonNode& parent, const char* key, Curve<T>& curve) {
    if (!parent.has(key)) return;
    curve.keys.clear();
    for (const JsonNode& item : parent[key].items()) {
        const std::vector<JsonNode> pair = item.items();
        const double age = pair[0].number();
        if (!curve.keys.empty() && !(age > curve.keys.back().first))
            throw pair[0].error("is not above the age before it, ages must rise");
        curve.keys.emplace_back(age, readCurveValue(pair[1], static_cast<T*>(nullptr)));
    }
}

}  // namespace

const char* effectSchema() { return text::effect_schema_json; }

Effect readEffect(const JsonNode& root) {
    Effect effect;
    root.read("capacity", effect.capacity);
    root.read("tickRate", effect.tickRate);
    root.read("medium", effect.medium);
    for (const JsonNode& item : root.items("emitters"))
        effect.emitters.push_back(readEmitter(item));
    for (const JsonNode& item : root.items("modules")) effect.modules.push_back(readModule(item));
    if (root.has("overLife")) {
        const JsonNode node = root["overLife"];
        readCurve(node, "radius", effect.radius);
        readCurve(node, "density", effect.density);
        readCurve(node, "tint", effect.tint);
    }
    effect.smoothProfile = root.has("profile") && root["profile"].text() == "smooth";
    return effect;
}

Effect parseEffect(const std::string& text, const std::filesystem::path& file, const Log& log) {
    const JsonDocument document = JsonDocument::parse(text, rulesFor(file));
    compiledSchema().validate(document);
    Effect effect = readEffect(JsonNode(document));
    log.debug("effect " + file.string() + ": " + std::to_string(effect.emitters.size()) +
              " emitters, " + std::to_string(effect.modules.size()) + " modules");
    return effect;
}

Effect loadEffect(const std::filesystem::path& file, const Log& log) {
    return parseEffect(JsonDocument::readText(rulesFor(file)), file, log);
}

}  // namespace brume::scene
