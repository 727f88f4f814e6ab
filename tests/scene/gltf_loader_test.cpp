// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/gltf_loader.hpp>
#include <scene/mesh_shapes.hpp>

#include <algorithm>

namespace brume::scene {
namespace {

using test::GlbBuilder;
using test::messageOf;

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::vector<float> kQuad{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const char* const kScene = "\"scenes\":[{\"nodes\":[0]}],\"scene\":0";

GltfContent parse(const std::vector<unsigned char>& bytes, const Log& log = Log()) {
    return parseGltf(bytes, "a.glb", log);
}

/// One triangle with `material` (the inside of a JSON object).
GltfContent parseMaterial(const std::string& material, const Log& log = Log()) {
    GlbBuilder glb;
    glb.addFloats(kTriangle, 3);
    return parse(glb.build("\"nodes\":[{\"mesh\":0}],\"materials\":[{" + material +
                           "}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                           "\"material\":0}]}]," +
                           kScene),
                 log);
}

/// One primitive over four points, with `keys` after its attributes.
GltfContent parsePrimitive(GlbBuilder& glb, const std::string& attributes,
                           const std::string& keys) {
    return parse(
        glb.build("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{" +
                  attributes + "}" + keys + "}]}]," + kScene));
}

TEST(Gltf_Primitive, WithoutIndicesAndNormals_IsAFlatTriangle) {
    GlbBuilder glb;
    glb.addFloats(kTriangle, 3);
    const GltfContent content = parsePrimitive(glb, "\"POSITION\":0", "");
    ASSERT_EQ(content.meshes.size(), 1u);
    const Mesh& mesh = content.meshes[0];
    EXPECT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(mesh.normals[0], vec3(0, 0, 1));
    EXPECT_EQ(mesh.uvs.size(), 3u);
    ASSERT_EQ(content.materials.size(), 1u);
    EXPECT_EQ(content.materials[mesh.material].albedo, dvec3(1));
}

TEST(Gltf_Primitive, StripAndFan_BecomeTriangles) {
    for (const auto& [mode, expected] :
         {std::pair(5, std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}),
          std::pair(6, std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0})}) {
        GlbBuilder glb;
        glb.addFloats(kQuad, 3);
        glb.addFloats({0, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 2}, 3);
        const GltfContent content =
            parsePrimitive(glb, "\"POSITION\":0,\"NORMAL\":1", ",\"mode\":" + std::to_string(mode));
        ASSERT_EQ(content.meshes.size(), 1u);
        EXPECT_EQ(content.meshes[0].indices, expected);
        // Unit, and the one without length taken from its triangles.
        if (mode == 5) {
            for (const vec3& n : content.meshes[0].normals) EXPECT_EQ(n, vec3(0, 0, 1));
        }
    }
}

TEST(Gltf_Primitive, SparseAndQuantizedAccessors_AreRead) {
    GlbBuilder glb;
    const std::uint16_t where[] = {1};
    const float what[] = {5, 6, 7};
    const int indexView = glb.addView(where, sizeof where);
    const int valueView = glb.addView(what, sizeof what);
    glb.addAccessor(
        -1, 5126, 3, "VEC3",
        ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":" + std::to_string(indexView) +
            ",\"componentType\":5123},\"values\":{\"bufferView\":" + std::to_string(valueView) +
            "}}");
    const std::uint8_t uvs[] = {0, 255, 51, 102, 255, 0};
    glb.addAccessor(glb.addView(uvs, sizeof uvs), 5121, 3, "VEC2", ",\"normalized\":true");
    const GltfContent content = parsePrimitive(glb, "\"POSITION\":0,\"TEXCOORD_0\":1", "");
    EXPECT_EQ(content.meshes[0].positions[1], vec3(5, 6, 7));
    EXPECT_EQ(content.meshes[0].positions[2], vec3(0));
    EXPECT_NEAR(content.meshes[0].uvs[1].x, 0.2, 1e-7);
    EXPECT_NEAR(content.meshes[0].uvs[1].y, 0.4, 1e-7);
}

TEST(Gltf_Nodes, TransformsMultiply_AndMirrorsFlipTheWinding) {
    GlbBuilder glb;
    glb.addFloats(kTriangle, 3);
    glb.addIndices({0, 1, 2});
    const GltfContent content = parse(glb.build(
        "\"nodes\":[{\"children\":[1,2],\"translation\":[1,2,3]},"
        "{\"mesh\":0,\"rotation\":[0,0,0.7071067811865476,0.7071067811865476],\"scale\":[2,2,2]},"
        "{\"mesh\":0,\"matrix\":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 4,0,0,1]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]," +
        std::string(kScene)));
    ASSERT_EQ(content.meshes.size(), 2u);
    const dmat4& m = content.meshes[0].worldFromObject;
    EXPECT_LT(glm::length(transformPoint(m, {1, 0, 0}) - dvec3(1, 4, 3)), 1e-12);
    EXPECT_EQ(content.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(content.meshes[1].worldFromObject[3], dvec4(5, 2, 3, 1));
    EXPECT_EQ(content.meshes[1].indices, (std::vector<std::uint32_t>{0, 2, 1}));
}

TEST(Gltf_Material, AlphaModes_GiveOpaqueCutAndThin) {
    const std::string pbr =
        "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.1,0.2,0.3,0.4],"
        "\"roughnessFactor\":0.5}";
    const Material opaque = parseMaterial(pbr).materials[0];
    EXPECT_EQ(opaque.type, MaterialType::Opaque);
    EXPECT_EQ(opaque.albedo, dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(opaque.roughness, 0.5);
    EXPECT_LT(opaque.alphaCutoff, 0);
    EXPECT_EQ(opaque.coverage, 1);
    const Material mask = parseMaterial(pbr + ",\"alphaMode\":\"MASK\"").materials[0];
    EXPECT_EQ(mask.type, MaterialType::Opaque);
    EXPECT_EQ(mask.alphaCutoff, 0.5);
    const Material blend = parseMaterial(pbr + ",\"alphaMode\":\"BLEND\"").materials[0];
    EXPECT_EQ(blend.type, MaterialType::Thin);
    EXPECT_EQ(blend.coverage, 0.4);
    EXPECT_EQ(blend.reflected, dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(blend.transmission, dvec3(0));
}

TEST(Gltf_Material, TransmissionAndVolume_GiveThinAndSolidGlass) {
    const std::string pbr = "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,1,0.25,1]}";
    const Material thin =
        parseMaterial(pbr +
                      ",\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":"
                      "0.75},\"KHR_materials_ior\":{\"ior\":1.33}}")
            .materials[0];
    EXPECT_EQ(thin.type, MaterialType::Thin);
    EXPECT_EQ(thin.coverage, 1);
    EXPECT_EQ(thin.transmission, dvec3(0.375, 0.75, 0.1875));
    EXPECT_EQ(thin.reflected, dvec3(0.125, 0.25, 0.0625));
    EXPECT_EQ(thin.ior, 1.33);
    const std::string glass =
        "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
        "\"KHR_materials_volume\":{\"thicknessFactor\":1";
    const Material solid =
        parseMaterial(glass + ",\"attenuationColor\":[0.1,0.5,1],\"attenuationDistance\":2}}")
            .materials[0];
    EXPECT_EQ(solid.type, MaterialType::Solid);
    EXPECT_NEAR(solid.absorption.x, -std::log(0.1) / 2, 1e-15);
    EXPECT_NEAR(solid.absorption.y, -std::log(0.5) / 2, 1e-15);
    EXPECT_EQ(solid.absorption.z, 0);
    const Material clear =
        parseMaterial(glass + ",\"attenuationColor\":[0.1,0.5,1]}}").materials[0];
    EXPECT_EQ(clear.absorption, dvec3(0));
}

TEST(Gltf_Material, EmissionStrength_Multiplies) {
    const Material material = parseMaterial(
                                  "\"emissiveFactor\":[1,0.5,0],\"extensions\":{"
                                  "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":10}}")
                                  .materials[0];
    EXPECT_EQ(material.emission, dvec3(10, 5, 0));
}

TEST(Gltf_Textures, EmbeddedPng_IsDecodedAndItsTransformApplied) {
    GlbBuilder glb;
    glb.addFloats(kTriangle, 3);
    glb.addFloats({0, 0, 1, 0, 0, 1}, 2);
    const std::string png = test::makePngBytes(4);
    const int view = glb.addView(png.data(), png.size());
    const GltfContent content = parse(glb.build(
        "\"nodes\":[{\"mesh\":0}],\"images\":[{\"mimeType\":\"image/png\",\"bufferView\":" +
        std::to_string(view) +
        "}],\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":{"
        "\"baseColorTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"offset\":["
        "0.5,0],"
        "\"scale\":[2,3],\"rotation\":1.5707963267948966}}}}}],\"meshes\":[{\"primitives\":[{"
        "\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"material\":0}]}]," +
        std::string(kScene)));
    ASSERT_TRUE(content.materials[0].colorTexture);
    EXPECT_EQ(content.materials[0].colorTexture->width, 4);
    EXPECT_NEAR(content.materials[0].colorTexture->texels[5].x, 0.125, 0.01);
    EXPECT_LT(glm::length(content.meshes[0].uvs[1] - vec2(0.5f, 2)), 1e-6f);
    EXPECT_LT(glm::length(content.meshes[0].uvs[2] - vec2(-2.5f, 0)), 1e-6f);
}

TEST(Gltf_Ignored, UnknownExtensions_AreWarnedOfOnce) {
    std::vector<std::string> warnings;
    const Log log([&](LogLevel level, const std::string& text) {
        if (level == LogLevel::Warning) warnings.push_back(text);
    });
    GlbBuilder glb;
    glb.addFloats(kTriangle, 3);
    const std::string rest =
        "\"nodes\":[{\"mesh\":0},{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{"
        "\"POSITION\":0}"
        "}]}],\"scenes\":[{\"nodes\":[0,1]}]";
    parse(glb.build("\"extensionsUsed\":[\"KHR_materials_sheen\",\"KHR_lights_punctual\"]," + rest),
          log);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0], "a.glb: ignored: KHR_lights_punctual, KHR_materials_sheen");
    EXPECT_NE(
        messageOf([&] {
            parse(glb.build("\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]," + rest));
        }).find("requires the extension KHR_draco_mesh_compression, supported are"),
        std::string::npos);
}

TEST(Gltf_Errors, BrokenFiles_AreNamedInOneLine) {
    const auto expectError = [](const std::vector<unsigned char>& bytes, const std::string& part) {
        const std::string message = messageOf([&] { parse(bytes); });
        EXPECT_EQ(message.substr(0, 13), "loading mesh:") << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    const auto withMesh = [](GlbBuilder& glb, const std::string& primitive) {
        return glb.build("\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{" + primitive +
                         "}]}]," + kScene);
    };
    GlbBuilder good;
    good.addFloats(kTriangle, 3);
    std::vector<unsigned char> bytes = withMesh(good, "\"attributes\":{\"POSITION\":0}");
    EXPECT_NO_THROW(parse(bytes));
    for (std::size_t size = 0; size < bytes.size(); ++size)
        expectError({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}, "a.glb");
    expectError(withMesh(good, "\"attributes\":{\"POSITION\":7}"), "accessors[7]: no such element");
    expectError(withMesh(good, "\"attributes\":{}"), "POSITION");
    GlbBuilder nan;
    nan.addFloats({0, 0, 0, 1, NAN, 0, 0, 1, 0}, 3);
    expectError(withMesh(nan, "\"attributes\":{\"POSITION\":0}"),
                "accessors[0]: element 1 is not a finite number");
    GlbBuilder index;
    index.addFloats(kTriangle, 3);
    index.addIndices({0, 1, 3});
    expectError(withMesh(index, "\"attributes\":{\"POSITION\":0},\"indices\":1"), "vertex index 3");
    GlbBuilder range;
    range.addAccessor(range.addView(kTriangle.data(), 36), 5126, 4, "VEC3");
    expectError(withMesh(range, "\"attributes\":{\"POSITION\":0}"),
                "accessors[0]: 4 elements from byte 0 do not fit");
    expectError(
        good.build("\"nodes\":[{\"children\":[1]},{\"children\":[0]}]," + std::string(kScene)),
        "nodes[0]: reached twice");
    expectError(good.build("\"nodes\":[{\"extras\":" + std::string(80, '[') + std::string(80, ']') +
                           "}]," + kScene),
                "nested more than 64 deep");
    expectError(good.build("\"nodes\":[{\"scale\":[1,2]}]," + std::string(kScene)),
                "nodes[0]: a transform of 2 numbers, must be 3");
}

struct SharedFile {
    const char* name;
    std::size_t meshCount, materialCount;
    MaterialType someType;
};

TEST(Gltf_SharedFiles, Load_HasPlausibleContent) {
    const SharedFile files[] = {{"AttenuationTest.glb", 23, 18, MaterialType::Solid},
                                {"TransmissionRoughnessTest.glb", 9, 9, MaterialType::Solid},
                                {"SunglassesKhronos.glb", 8, 5, MaterialType::Thin},
                                {"glass-table.glb", 5, 3, MaterialType::Thin}};
    for (const SharedFile& expected : files) {
        const std::filesystem::path file = test::sharedData() / "gltf" / expected.name;
        BRUME_SKIP_WITHOUT(file);
        const GltfContent content = loadGltf(file, Log());
        EXPECT_EQ(content.meshes.size(), expected.meshCount) << expected.name;
        EXPECT_EQ(content.materials.size(), expected.materialCount) << expected.name;
        EXPECT_TRUE(std::any_of(content.materials.begin(), content.materials.end(),
                                [&](const Material& m) { return m.type == expected.someType; }));
        for (const Mesh& mesh : content.meshes) {
            ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
            ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
            ASSERT_LT(mesh.material, content.materials.size());
            for (const vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
            if (content.materials[mesh.material].type == MaterialType::Solid) {
                EXPECT_EQ(countOpenEdges(mesh), 0u) << mesh.name;
                EXPECT_GT(computeSignedVolume(mesh), 0) << mesh.name;
            }
        }
    }
}

TEST(Gltf_SharedFiles, AttenuationTest_HasTheStatedAbsorption) {
    const std::filesystem::path file = test::sharedData() / "gltf/AttenuationTest.glb";
    BRUME_SKIP_WITHOUT(file);
    const GltfContent content = loadGltf(file, Log());
    const auto half =
        std::find_if(content.materials.begin(), content.materials.end(),
                     [](const Material& m) { return m.name == "R5_Attenuation_2.0"; });
    ASSERT_NE(half, content.materials.end());
    EXPECT_NEAR(half->absorption.x, -std::log(0.1) / 0.5, 1e-12);
    EXPECT_NEAR(half->absorption.z, -std::log(0.9) / 0.5, 1e-12);
}

}  // namespace
}  // namespace brume::scene
