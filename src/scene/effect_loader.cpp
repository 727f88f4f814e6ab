// SPDX-License-Identifier: Apache-2.0
#include <scene/gltf_loader.hpp>
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

/// Where an effect is read from.
struct EffectPlace {
    std::filesystem::path file;                ///< absolute
    std::vector<std::filesystem::path> files;  ///< it and those above it
    const Log& log;
};

Effect readEffect(const JsonNode& root, const EffectPlace& place);

/// The absolute path that a value names, which must exist.
std::filesystem::path existingFile(const JsonNode& node, const EffectPlace& place) {
    const auto path = (place.file.parent_path() / node.text()).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        throw node.error("no such file: " + quoteForMessage(path.string(), 400));
    return path;
}

const JsonSchema& compiledSchema() {
    static const JsonSchema schema(effectSchema());
    return schema;
}

EmitterShape shapeNamed(const std::string& name) {
    static const std::map<std::string, EmitterShape> shapes = {
        {"point", EmitterShape::Point}, {"line", EmitterShape::Line},
        {"disc", EmitterShape::Disc},   {"ring", EmitterShape::Ring},
        {"sphere", EmitterShape::Sphere}, {"box", EmitterShape::Box},
        {"cone", EmitterShape::Cone},   {"mesh", EmitterShape::Mesh},
        {"volume", EmitterShape::Volume}};
    return shapes.at(name);
}

/// The triangles of all meshes of a file, scaled, in effect space.
std::shared_ptr<const std::vector<EmitterTriangle>> readTriangles(const JsonNode& node,
                                                                  const EffectPlace& place) {
    const std::filesystem::path file = existingFile(node["file"], place);
    double scale = 1;
    node.read("scale", scale);
    auto triangles = std::make_shared<std::vector<EmitterTriangle>>();
    for (const Mesh& mesh : loadGltf(file, place.log).meshes) {
        const dmat4 map = glm::scale(dmat4(1), dvec3(scale)) * mesh.worldFromObject;
        const auto corner = [&](std::size_t i) {
            return transformPoint(map, dvec3(mesh.positions[mesh.indices[i]]));
        };
        const bool isMirrored = glm::determinant(dmat3(map)) < 0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            triangles->push_back({corner(i), corner(isMirrored ? i + 2 : i + 1),
                                  corner(isMirrored ? i + 1 : i + 2)});
    }
    if (triangles->empty())
        throw node["file"].error("has no triangles, a mesh with triangles is allowed");
    return triangles;
}

/// A grid and where it lies; `position` and `strength` are optional.
FieldPlacement readPlacement(const JsonNode& node, const EffectPlace& place) {
    FieldPlacement field;
    field.source.file = existingFile(node["file"], place).string();
    field.source.grid = node["grid"].text();
    node.read("gridIndex", field.source.gridIndex);
    node.read("position", field.position);
    node.read("scale", field.scale);
    node.read("strength", field.strength);
    field.where = node["file"].where();
    return field;
}

void readShape(const JsonNode& node, const EffectPlace& place, Emitter& emitter) {
    emitter.shape = shapeNamed(node["type"].text());
    node.read("position", emitter.position);
    node.read("radius", emitter.radius);
    node.read("innerRadius", emitter.innerRadius);
    node.read("height", emitter.height);
    node.read("size", emitter.size);
    if (node.has("innerRadius") && emitter.innerRadius > emitter.radius)
        throw node["innerRadius"].error("is above 'radius', at most that is allowed");
    if (node.has("normal")) emitter.normal = node["normal"].unitVec3();
    if (node.has("births")) emitter.fromSurface = node["births"].text() == "surface";
    if (emitter.shape == EmitterShape::Line) {
        emitter.position = node["from"].vec3();
        emitter.size = node["to"].vec3() - emitter.position;
    }
    if (emitter.shape == EmitterShape::Mesh) emitter.triangles = readTriangles(node, place);
    if (emitter.shape == EmitterShape::Volume) {
        emitter.volume = readPlacement(node, place);
        emitter.volume->position = dvec3(0);  // births are relative to the emitter's
    }
}

Burst readBurst(const JsonNode& node) {
    Burst burst;
    node.read("time", burst.time);
    node.read("count", burst.count);
    node.read("repeat", burst.repeat);
    burst.interval = 1;
    node.read("interval", burst.interval);
    return burst;
}

std::vector<std::pair<double, dvec3>> readPath(const std::vector<JsonNode>& items) {
    std::vector<std::pair<double, dvec3>> path;
    for (const JsonNode& item : items) {
        const std::vector<JsonNode> pair = item.items();
        if (!path.empty() && !(pair[0].number() > path.back().first))
            throw pair[0].error("is not above the time before it, times must rise");
        path.emplace_back(pair[0].number(), pair[1].vec3());
    }
    return path;
}

Emitter readEmitter(const JsonNode& node, const EffectPlace& place) {
    Emitter emitter;
    node.read("rate", emitter.rate);
    for (const JsonNode& item : node.items("bursts")) emitter.bursts.push_back(readBurst(item));
    node.read("delay", emitter.delay);
    node.read("duration", emitter.duration);
    if (node.has("shape")) readShape(node["shape"], place, emitter);
    emitter.path = readPath(node.items("path"));
    node.read("inherit", emitter.inherit);
    if (node.has("speed")) emitter.speed = node["speed"].range();
    if (node.has("direction")) emitter.direction = node["direction"].unitVec3();
    if (node.has("velocity")) {
        const std::string name = node["velocity"].text();
        emitter.velocity = name == "radial"   ? EmitterVelocity::Radial
                           : name == "normal" ? EmitterVelocity::Normal
                                              : EmitterVelocity::Direction;
    }
    if (node.has("velocityField"))
        emitter.velocityField = readPlacement(node["velocityField"], place);
    node.readRadians("spread", emitter.spread);
    emitter.lifetime = node["lifetime"].range();
    return emitter;
}

ModuleSettings readModule(const JsonNode& node, const EffectPlace& place) {
    ModuleSettings module;
    module.where = node.where();
    for (const auto& [key, value] : node.members()) {
        if (key == "type") {
            module.type = value.text();
            continue;
        }
        module.whereOf[key] = value.where();
        if (value.json().is_string())
            module.texts[key] =
                key == "file" ? existingFile(value, place).string() : value.text();
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

/// `what`: "age" or "speed".
template <typename T>
void readCurve(const JsonNode& parent, const char* key, const std::string& what, Curve<T>& curve) {
    if (!parent.has(key)) return;
    curve.keys.clear();
    for (const JsonNode& item : parent[key].items()) {
        const std::vector<JsonNode> pair = item.items();
        const double x = pair[0].number();
        if (!curve.keys.empty() && !(x > curve.keys.back().first))
            throw pair[0].error("is not above the " + what + " before it, " + what + "s must rise");
        curve.keys.emplace_back(x, readCurveValue(pair[1], static_cast<T*>(nullptr)));
    }
}

/// A sub-emitter with the effect that it names; a file that leads back to itself is an error.
SubEmitter readSubEmitter(const JsonNode& node, const EffectPlace& place) {
    SubEmitter sub;
    sub.where = node.where();
    const std::string on = node["on"].text();
    sub.trigger = on == "birth"       ? SubEmitterTrigger::Birth
                  : on == "collision" ? SubEmitterTrigger::Collision
                  : on == "way"       ? SubEmitterTrigger::Way
                                      : SubEmitterTrigger::Death;
    if (node.has("count")) sub.count = node["count"].range();
    node.read("rate", sub.rate);
    const JsonNode name = node["effect"];
    const std::filesystem::path file = existingFile(name, place);
    for (const std::filesystem::path& above : place.files)
        if (above == file)
            throw name.error("leads back to an effect that it comes from, " +
                             quoteForMessage(file.filename().string(), 200) +
                             ", effects below each other must differ");
    const JsonDocument document =
        JsonDocument::parse(JsonDocument::readText(rulesFor(file)), rulesFor(file));
    compiledSchema().validate(document);
    EffectPlace below{file, place.files, place.log};
    below.files.push_back(file);
    sub.effect = std::make_shared<const Effect>(readEffect(JsonNode(document), below));
    return sub;
}

dvec2 readRadianRange(const JsonNode& node, const char* key) {
    return node.has(key) ? node[key].range() * (kPi / 180) : dvec2(0);
}

Surface readSurface(const JsonNode& node) {
    Surface surface;
    if (node["type"].text() == "billboard") surface.type = SurfaceType::Billboard;
    surface.material = node["material"].text();
    node.read("columns", surface.columns);
    node.read("rows", surface.rows);
    readCurve(node, "frames", "age", surface.frames);
    for (const auto& [age, frame] : surface.frames.keys)
        if (frame > surface.columns * surface.rows - 1)
            throw node["frames"].error("has a frame beyond the last, 0 to columns * rows - 1 allowed");
    readCurve(node, "rotation", "age", surface.rotation);
    for (auto& key : surface.rotation.keys) key.second *= kPi / 180;
    surface.startRotation = readRadianRange(node, "startRotation");
    surface.spin = readRadianRange(node, "spin");
    return surface;
}

Effect readEffect(const JsonNode& root, const EffectPlace& place) {
    Effect effect;
    root.read("capacity", effect.capacity);
    root.read("tickRate", effect.tickRate);
    root.read("medium", effect.medium);
    if (root.has("surface")) effect.surface = readSurface(root["surface"]);
    if (effect.medium.empty() && !effect.surface)
        throw root.error("has neither 'medium' nor 'surface', one of them is needed");
    for (const JsonNode& item : root.items("emitters"))
        effect.emitters.push_back(readEmitter(item, place));
    for (const JsonNode& item : root.items("modules")) 
        effect.modules.push_back(readModule(item, place));
    for (const JsonNode& item : root.items("subEmitters"))
        effect.subEmitters.push_back(readSubEmitter(item, place));
    if (root.has("overLife")) {
        const JsonNode node = root["overLife"];
        readCurve(node, "radius", "age", effect.radius);
        readCurve(node, "density", "age", effect.density);
        readCurve(node, "tint", "age", effect.tint);
        readCurve(node, "temperature", "age", effect.temperature);
    }
    if (root.has("bySpeed")) {
        readCurve(root["bySpeed"], "radius", "speed", effect.radiusBySpeed);
        readCurve(root["bySpeed"], "density", "speed", effect.densityBySpeed);
    }
    effect.smoothProfile = root.has("profile") && root["profile"].text() == "smooth";
    if (root.has("shadowing") && root["shadowing"].text() == "sample")
        effect.shadowing = Shadowing::Sample;
    return effect;
}

}  // namespace

const char* effectSchema() { return text::effect_schema_json; }

Effect parseEffect(const std::string& text, const std::filesystem::path& file, const Log& log) {
    const JsonDocument document = JsonDocument::parse(text, rulesFor(file));
    compiledSchema().validate(document);
    const std::filesystem::path absolute = std::filesystem::absolute(file).lexically_normal();
    Effect effect = readEffect(JsonNode(document), {absolute, {absolute}, log});
    log.debug("effect " + file.string() + ": " + std::to_string(effect.emitters.size()) +
              " emitters, " + std::to_string(effect.modules.size()) + " modules");
    return effect;
}

Effect loadEffect(const std::filesystem::path& file, const Log& log) {
    return parseEffect(JsonDocument::readText(rulesFor(file)), file, log);
}

}  // namespace brume::scene
