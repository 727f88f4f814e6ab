// SPDX-License-Identifier: Apache-2.0
#include <scene/gltf_loader.hpp>
#include <scene/json_schema.hpp>
#include <scene/loader.hpp>
#include <scene/loader_parts.hpp>
#include <scene/mesh_shapes.hpp>
#include <scene/texture.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <text/scene.schema.json.hpp>

namespace brume::scene {
namespace {

JsonRules rulesFor(const std::filesystem::path& file) {
    JsonRules rules;
    rules.doing = "loading scene";
    rules.name = file.string();
    return rules;
}

const JsonSchema& compiledSchema() {
    static const JsonSchema schema(sceneSchema());
    return schema;
}

/// Indices by name, and the error that lists the names.
class NameTable {
  public:
    explicit NameTable(const char* kind) : mKind(kind) {}

    void add(const std::string& name) {
        mIndexOf.emplace(name, static_cast<std::uint32_t>(mIndexOf.size()));
    }

    const std::uint32_t* find(const std::string& name) const {
        const auto it = mIndexOf.find(name);
        return it == mIndexOf.end() ? nullptr : &it->second;
    }

    /// "no medium "smok", known are fog, smoke".
    std::string describeMissing(const std::string& name) const {
        std::vector<std::string> names;
        for (const auto& entry : mIndexOf) names.push_back(quoteForMessage(entry.first, 60));
        return fmt::format("no {} \"{}\", {}", mKind, quoteForMessage(name, 60),
                           names.empty() ? "the scene has none"
                                         : fmt::format("known are {}", fmt::join(names, ", ")));
    }

    std::uint32_t resolve(const JsonNode& node) const {
        const std::uint32_t* index = find(node.text());
        if (!index) throw node.error(describeMissing(node.text()));
        return *index;
    }

  private:
    const char* mKind;
    std::map<std::string, std::uint32_t> mIndexOf;
};

/// Reads the parts of a scene in the order of their references.
class SceneReader {
  public:
    SceneReader(const JsonNode& root, const std::filesystem::path& file, const Log& log)
        : mRoot(root), mLog(log) {
        mScene.file = std::filesystem::absolute(file).lexically_normal();
    }

    Scene read() {
        if (mRoot.has("camera")) mScene.camera = readCamera(mRoot["camera"]);
        if (mRoot.has("image")) mScene.image = readImageSettings(mRoot["image"]);
        if (mRoot.has("background")) readBackground(mRoot["background"]);
        for (const JsonNode& node : mRoot.items("lights")) mScene.lights.push_back(readLight(node));
        if (mRoot.has("materials")) readMaterials(mRoot["materials"]);
        if (mRoot.has("media")) readMedia(mRoot["media"]);
        for (const JsonNode& node : mRoot.items("meshes")) readMesh(node);
        for (const JsonNode& node : mRoot.items("volumes")) readVolume(node);
        for (const JsonNode& node : mRoot.items("spheres")) readSphere(node);
        for (const JsonNode& node : mRoot.items("effects")) readEffectInstance(node);
        if (mRoot.has("render")) mScene.render = readRenderSettings(mRoot["render"]);
        return std::move(mScene);
    }

  private:
    /// The absolute path that a value names, which must exist.
    std::filesystem::path existingFile(const JsonNode& node) const {
        const std::filesystem::path path = filePath(node);
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(path, ignored))
            throw node.error("no such file: " + quoteForMessage(path.string(), 400));
        return path;
    }

    std::filesystem::path filePath(const JsonNode& node) const {
        return (mScene.file.parent_path() / node.text()).lexically_normal();
    }

    std::shared_ptr<const Texture> readTexture(const JsonNode& node) {
        const std::filesystem::path path = existingFile(node);
        std::shared_ptr<const Texture>& texture = mTextures[path];
        if (!texture) texture = loadTexture(path);
        return texture;
    }

    void readBackground(const JsonNode& node) {
        Background& background = mScene.background;
        node.read("radiance", background.radiance);
        node.read("scale", background.scale);
        if (!node.has("environment")) return;
        const JsonNode environment = node["environment"];
        const std::string extension = filePath(environment).extension().string();
        if (extension != ".hdr" && extension != ".exr")
            throw environment.error("unknown extension, allowed are .hdr and .exr");
        background.environment = readTexture(environment);
    }

    void readMaterials(const JsonNode& node) {
        for (const auto& [name, value] : node.members()) {
            Material material = readMaterial(value);
            material.name = name;
            if (value.has("texture")) material.colorTexture = readTexture(value["texture"]);
            if (value.has("emissionTexture"))
                material.emissionTexture = readTexture(value["emissionTexture"]);
            mScene.materials.push_back(std::move(material));
            mMaterials.add(name);
        }
    }

    void readMedia(const JsonNode& node) {
        for (const auto& [name, value] : node.members()) {
            Medium medium = readMedium(value);
            medium.name = name;
            mScene.media.push_back(std::move(medium));
            mMedia.add(name);
        }
    }

    void readMesh(const JsonNode& node) {
        if (!node.has("shape")) return readMeshFile(node);
        Mesh mesh = readShape(node);
        mesh.material = mMaterials.resolve(node["material"]);
        if (mScene.materials[mesh.material].type == MaterialType::Solid &&
            node["shape"].text() == "plane")
            throw node["material"].error(
                "a solid material on a plane, which is not closed; must be opaque or thin");
        addMesh(node, std::move(mesh));
    }

    void addMesh(const JsonNode& node, Mesh mesh) {
        constexpr std::size_t kMaxVertices = std::size_t{1} << 24;
        mVertexCount += mesh.positions.size();
        if (mVertexCount > kMaxVertices)
            throw node.error(
                fmt::format("the scene has {} vertices up to here, at most {} are "
                            "allowed",
                            mVertexCount, kMaxVertices));
        mScene.meshes.push_back(std::move(mesh));
    }

    void readMeshFile(const JsonNode& node) {
        const std::filesystem::path path = existingFile(node["file"]);
        const auto [cached, isNew] = mMeshFiles.try_emplace(path);
        MeshFile& file = cached->second;
        if (isNew) file.content = loadGltf(path, mLog);
        const dmat4 transform = readTransform(node);
        for (Mesh mesh : file.content.meshes) {
            if (node.has("material"))
                mesh.material = mMaterials.resolve(node["material"]);
            else
                mesh.material += firstMaterial(file);
            if (glm::determinant(dmat3(transform)) < 0) flipWinding(mesh);
            mesh.worldFromObject = transform * mesh.worldFromObject;
            warnIfNotClosed(mesh);
            addMesh(node, std::move(mesh));
        }
    }

    void readVolume(const JsonNode& node) {
        Volume volume;
        volume.file = filePath(node["file"]);
        node.read("frameOffset", volume.frameOffset);
        node.read("density", volume.density);
        node.read("gridIndex", volume.gridIndex);
        volume.medium = mMedia.resolve(node["medium"]);
        if (node.has("representation")) {
            const std::string name = node["representation"].text();
            volume.representation = name == "boxes"       ? VolumeRepresentation::Boxes
                                    : name == "particles" ? VolumeRepresentation::Particles
                                                          : VolumeRepresentation::Bricks;
        }
        node.read("tolerance", volume.tolerance);
        volume.worldFromFile = readTransform(node);
        mScene.volumes.push_back(std::move(volume));
    }

    void readSphere(const JsonNode& node) {
        Sphere sphere;
        node.read("center", sphere.center);
        node.read("radius", sphere.radius);
        sphere.medium = mMedia.resolve(node["medium"]);
        node.read("density", sphere.density);
        if (node.has("profile") && node["profile"].text() == "smooth")
            sphere.profile = Profile::Smooth;
        if (node.has("shadowing") && node["shadowing"].text() == "particle")
            sphere.shadowing = Shadowing::Particle;
        mScene.spheres.push_back(sphere);
    }

    void readEffectInstance(const JsonNode& node) {
        EffectInstance instance;
        instance.file = existingFile(node["file"]);
        instance.effect = loadEffect(instance.file, mLog);
        instance.worldFromEffect = readTransform(node);
        node.read("seed", instance.seed);
        node.read("time", instance.time);
        node.read("start", instance.start);
        node.read("timeScale", instance.timeScale);
        node.read("loop", instance.loop);
        node.read("prewarm", instance.prewarm);
        addEffect(node, std::move(instance));
    }

    /// The instance, then its sub-emitters, each before its own.
    void addEffect(const JsonNode& node, EffectInstance instance) {
        if (instance.effect.surface) {
            const std::string& name = instance.effect.surface->material;
            const std::uint32_t* material = mMaterials.find(name);
            if (!material)
                throw node["file"].error("the effect wants a material that the scene lacks: " +
                                         mMaterials.describeMissing(name));
            if (mScene.materials[*material].type != MaterialType::Thin)
                throw node["file"].error("the effect's surface has the material " +
                                         quoteForMessage(name, 200) +
                                         ", which is not thin, thin ones are allowed");
            instance.material = *material;
        } else {
            const std::uint32_t* medium = mMedia.find(instance.effect.medium);
            if (!medium)
                throw node["file"].error("the effect wants a medium that the scene lacks: " +
                                         mMedia.describeMissing(instance.effect.medium));
            instance.medium = *medium;
        }
        mScene.effects.push_back(instance);
        instance.isSubEmitter = true;
        const std::vector<SubEmitter> subEmitters = instance.effect.subEmitters;
        for (const SubEmitter& sub : subEmitters) {
            instance.effect = *sub.effect;
            addEffect(node, instance);
        }
    }

    struct MeshFile {
        GltfContent content;
        std::optional<std::uint32_t> firstMaterial;  ///< in the scene, once its materials are there
    };

    /// Adds the file's materials to the scene when the first mesh needs them.
    std::uint32_t firstMaterial(MeshFile& file) {
        if (!file.firstMaterial) {
            file.firstMaterial = static_cast<std::uint32_t>(mScene.materials.size());
            for (const Material& material : file.content.materials)
                mScene.materials.push_back(material);
        }
        return *file.firstMaterial;
    }

    void warnIfNotClosed(const Mesh& mesh) const {
        if (mScene.materials[mesh.material].type != MaterialType::Solid) return;
        const std::size_t openCount = countOpenEdges(mesh);
        if (openCount > 0)
            mLog.warning(
                fmt::format("mesh {}: its material is solid, but it is not closed ({} open "
                            "edges): where a ray enters through a hole it shows no glass",
                            mesh.name, openCount));
    }

    JsonNode mRoot;
    const Log& mLog;
    Scene mScene;
    std::size_t mVertexCount = 0;
    NameTable mMaterials{"material"};
    NameTable mMedia{"medium"};
    std::map<std::filesystem::path, std::shared_ptr<const Texture>> mTextures;
    std::map<std::filesystem::path, MeshFile> mMeshFiles;
};

}  // namespace

const char* sceneSchema() { return text::scene_schema_json; }

Scene parseScene(const std::string& text, const std::filesystem::path& file, const Log& log) {
    const JsonDocument document = JsonDocument::parse(text, rulesFor(file));
    compiledSchema().validate(document);
    return SceneReader(JsonNode(document), file, log).read();
}

Scene loadScene(const std::filesystem::path& file, const Log& log) {
    return parseScene(JsonDocument::readText(rulesFor(file)), file, log);
}

}  // namespace brume::scene
