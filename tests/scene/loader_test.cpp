// SPDX-License-Identifier: Apache-2.0
#include "scene_test_util.hpp"

#include <scene/loader.hpp>
#include <scene/mesh_shapes.hpp>

namespace brume::scene {
namespace {

using test::messageOf;
using test::TempFolder;

Scene parse(const std::string& text) { return parseScene(text, "s.json", Log()); }
std::string parseMessage(const std::string& text) {
    return messageOf([&] { parse(text); });
}
/// The message for a scene of version 1 whose second line is `member`.
std::string memberMessage(const std::string& member) {
    return parseMessage("{ \"version\": 1,\n" + member + " }");
}

TEST(Scene_Minimal, VersionAlone_GivesTheDefaults) {
    const Scene scene = parse("{ \"version\": 1 }");
    EXPECT_EQ(scene.image.width, 960);
    EXPECT_EQ(scene.image.height, 540);
    EXPECT_EQ(scene.render.method, "tile");
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(scene.file.is_absolute());
}

TEST(Scene_Camera, BothTypes_AreRead) {
    const Camera camera = parse(R"({ "version": 1, // the usual one
      "camera": { "type": "perspective", "position": [0,1.2,5], "target": [0,1,0], "up": [0,2,0],
                  "verticalFov": 60, "near": 0.5 } })")
                              .camera;
    EXPECT_EQ(camera.type, CameraType::Perspective);
    EXPECT_EQ(camera.position, dvec3(0, 1.2, 5));
    EXPECT_EQ(camera.target, dvec3(0, 1, 0));
    EXPECT_NEAR(camera.verticalFov, kPi / 3, 1e-15);
    EXPECT_EQ(camera.near, 0.5);
    const Camera flat = parse(R"({ "version": 1, "camera": { "type": "orthographic",
      "position": [0,0,5], "target": [0,0,0], "height": 120 } })")
                            .camera;
    EXPECT_EQ(flat.type, CameraType::Orthographic);
    EXPECT_EQ(flat.height, 120);
}

TEST(Scene_Lights, EachType_ReadsItsKeys) {
    const auto lights = parse(R"({ "version": 1, "lights": [
      { "type": "ambient", "radiance": [0.2,0.3,0.4] },
      { "type": "directional", "direction": [0,-2,0], "irradiance": [3,2,1], "shadow": "visibility",
        "shadowSettings": { "nodes": 16, "keep": true, "focusRadius": 2.5 } },
      { "type": "point", "position": [1,2,3], "intensity": [4,5,6], "radius": 0.5 },
      { "type": "spot", "position": [1,2,3], "direction": [0,0,-1], "intensity": [7,8,9],
        "innerAngle": 10, "outerAngle": 45 } ] })")
                            .lights;
    ASSERT_EQ(lights.size(), 4u);
    EXPECT_EQ(lights[0].type, LightType::Ambient);
    EXPECT_EQ(lights[0].color, dvec3(0.2, 0.3, 0.4));
    EXPECT_EQ(lights[1].type, LightType::Directional);
    EXPECT_EQ(lights[1].direction, dvec3(0, -1, 0));
    EXPECT_EQ(lights[1].shadow, "visibility");
    EXPECT_EQ(lights[1].shadowSettings,
              (Settings{{"nodes", "16"}, {"keep", "true"}, {"focusRadius", "2.5"}}));
    EXPECT_EQ(lights[2].type, LightType::Point);
    EXPECT_EQ(lights[2].radius, 0.5);
    EXPECT_EQ(lights[2].shadow, "none");
    EXPECT_EQ(lights[3].type, LightType::Spot);
    EXPECT_EQ(lights[3].position, dvec3(1, 2, 3));
    EXPECT_NEAR(lights[3].innerAngle, radians(10), 1e-15);
    EXPECT_NEAR(lights[3].outerAngle, radians(45), 1e-15);
}

TEST(Scene_MaterialsAndMedia, AllKeys_AreRead) {
    const Scene scene = parse(R"({ "version": 1,
      "materials": { "floor": { "type": "opaque", "albedo": [0.1,0.2,0.3], "emission": [1,2,3] },
        "pane": { "type": "thin", "coverage": 0.5, "transmission": [0.9,0.2,0.1],
                  "reflected": [0.04,0.05,0.06], "collimation": 0.7, "ior": 1.3, "roughness": 0.2 },
        "glass": { "type": "solid", "absorption": [1,0.2,0.3], "scattering": [4,5,6], "ior": 1.6 } },
      "media": { "smoke": { "extinction": [4,5,6], "albedo": [0.9,0.8,0.7], "emission": [1,2,3],
                            "phase": { "type": "henyey_greenstein", "g": -0.3 } },
                 "air": { "extinction": [1,1,1], "phase": { "type": "rayleigh" } } } })");
    ASSERT_EQ(scene.materials.size(), 3u);  // in the order of their names
    const Material &floor = scene.materials[0], &glass = scene.materials[1],
                   &pane = scene.materials[2];
    EXPECT_EQ(floor.name, "floor");
    EXPECT_EQ(floor.albedo, dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(floor.emission, dvec3(1, 2, 3));
    EXPECT_EQ(pane.type, MaterialType::Thin);
    EXPECT_EQ(pane.coverage, 0.5);
    EXPECT_EQ(pane.transmission, dvec3(0.9, 0.2, 0.1));
    EXPECT_EQ(pane.reflected, dvec3(0.04, 0.05, 0.06));
    EXPECT_EQ(pane.collimation, 0.7);
    EXPECT_EQ(pane.ior, 1.3);
    EXPECT_EQ(pane.roughness, 0.2);
    EXPECT_EQ(glass.type, MaterialType::Solid);
    EXPECT_EQ(glass.absorption, dvec3(1, 0.2, 0.3));
    EXPECT_EQ(glass.scattering, dvec3(4, 5, 6));
    ASSERT_EQ(scene.media.size(), 2u);
    EXPECT_EQ(scene.media[0].phase, PhaseType::Rayleigh);
    EXPECT_EQ(scene.media[1].name, "smoke");
    EXPECT_EQ(scene.media[1].extinction, dvec3(4, 5, 6));
    EXPECT_EQ(scene.media[1].emission, dvec3(1, 2, 3));
    EXPECT_EQ(scene.media[1].g, -0.3);
}

TEST(Scene_Shapes, SizesAndTransforms_AreApplied) {
    const Scene scene = parse(R"({ "version": 1, "materials": { "m": { "type": "opaque" } },
      "meshes": [ { "shape": "plane", "size": [10,20], "material": "m", "transform": {} },
        { "shape": "box", "size": [1,2,3], "material": "m",
          "transform": { "translate": [5,6,7], "rotate": [90,90,0], "scale": [2,1,1] } },
        { "shape": "sphere", "radius": 2, "segments": 8, "material": "m", "transform": { "scale": -3 } } ] })");
    ASSERT_EQ(scene.meshes.size(), 3u);
    EXPECT_EQ(scene.meshes[0].worldFromObject, dmat4(1));
    // Scale, then about X, then about Y, then translate: x -> 2x -> 2x -> -2z.
    const dmat4& m = scene.meshes[1].worldFromObject;
    EXPECT_LT(glm::length(transformPoint(m, {1, 0, 0}) - dvec3(5, 6, 5)), 1e-12);
    EXPECT_LT(glm::length(transformPoint(m, {0, 1, 0}) - dvec3(6, 6, 7)), 1e-12);
    EXPECT_LT(glm::length(transformPoint(m, {0, 0, 1}) - dvec3(5, 5, 7)), 1e-12);
    EXPECT_LT(computeSignedVolume(scene.meshes[2]), 0);  // the mirror turns it outside in the world
    EXPECT_EQ(scene.meshes[2].indices.size(), 3u * 8 * 2 * 3);
}

TEST(Scene_VolumesSpheresRender, AllKeys_AreRead) {
    const Scene scene = parse(R"({ "version": 1,
      "media": { "a": { "extinction": [1,1,1] }, "b": { "extinction": [1,1,1] } },
      "image": { "width": 96, "height": 128, "supersample": 4 },
      "background": { "radiance": [1,2,3] },
      "volumes": [ { "file": "sub/../plume.vdb", "density": "soot", "gridIndex": 2, "medium": "b",
                     "representation": "boxes", "tolerance": 0.5, "transform": { "scale": 2 } },
                   { "file": "x.nvdb", "medium": "a", "representation": "particles" } ],
      "spheres": [ { "center": [0,1,0], "radius": 0.5, "medium": "b", "density": 2, "profile": "smooth" } ],
      "render": { "method": "tile", "settings": { "budgetMiB": 512, "ratio": 0.25, "fast": true, "mode": "x" } } })");
    EXPECT_EQ(scene.image.width, 96);
    EXPECT_EQ(scene.image.supersample, 4);
    EXPECT_EQ(scene.background.radiance, dvec3(1, 2, 3));
    ASSERT_EQ(scene.volumes.size(), 2u);
    const Volume& volume = scene.volumes[0];
    EXPECT_EQ(volume.file, std::filesystem::current_path() / "plume.vdb");
    EXPECT_EQ(volume.density, "soot");
    EXPECT_EQ(volume.gridIndex, 2);
    EXPECT_EQ(volume.medium, 1u);
    EXPECT_EQ(volume.representation, VolumeRepresentation::Boxes);
    EXPECT_EQ(volume.tolerance, 0.5);
    EXPECT_EQ(volume.worldFromFile[1][1], 2);
    EXPECT_EQ(scene.volumes[1].gridIndex, -1);
    EXPECT_EQ(scene.volumes[1].representation, VolumeRepresentation::Particles);
    ASSERT_EQ(scene.spheres.size(), 1u);
    EXPECT_EQ(scene.spheres[0].profile, Profile::Smooth);
    EXPECT_EQ(scene.spheres[0].density, 2);
    EXPECT_EQ(scene.render.method, "tile");
    EXPECT_EQ(scene.render.settings,
              (Settings{{"budgetMiB", "512"}, {"fast", "true"}, {"mode", "x"}, {"ratio", "0.25"}}));
}

TEST(Scene_Files, EffectTextureAndEnvironment_AreLoaded) {
    const TempFolder folder;
    writeImage(folder / "sky.exr", Image(4, 2, vec3(3)));
    folder.write("a.png", test::makePngBytes(4));
    folder.write("e.json", R"({"version":1,"medium":"fog","emitters":[{"lifetime":1}]})");
    folder.write("s.json", R"({ "version": 1, "media": { "fog": { "extinction": [1,1,1] } },
      "background": { "environment": "sky.exr", "scale": 0.5 },
      "materials": { "m": { "type": "opaque", "texture": "a.png" } },
      "effects": [ { "file": "e.json", "transform": { "translate": [1,2,3] }, "seed": 7, "time": 2.5,
                     "path": [[0,[0,0,0]],[2,[4,0,0]]] } ], "particleBudget": 777 })");
    const Scene scene = loadScene(folder / "s.json", Log());
    ASSERT_TRUE(scene.background.environment);
    EXPECT_EQ(scene.background.environment->texels[0], vec4(3, 3, 3, 1));
    EXPECT_EQ(scene.background.scale, 0.5);
    ASSERT_TRUE(scene.materials[0].colorTexture);
    EXPECT_NEAR(scene.materials[0].colorTexture->texels[0].z, 0.5, 0.01);
    ASSERT_EQ(scene.effects.size(), 1u);
    EXPECT_EQ(scene.effects[0].seed, 7u);
    EXPECT_EQ(scene.effects[0].time, 2.5);
    EXPECT_EQ(scene.effects[0].medium, 0u);
    EXPECT_EQ(scene.effects[0].worldFromEffect[3], dvec4(1, 2, 3, 1));
    EXPECT_EQ(scene.effects[0].placed()[3], dvec4(5, 2, 3, 1));
    EXPECT_EQ(scene.effects[0].placement().at(0.5)[3], dvec4(2, 2, 3, 1));
    EXPECT_EQ(scene.particleBudget, 777u);
}

TEST(Scene_Errors, EachFault_IsNamedAtItsPlace) {
    const std::string start = "loading scene: s.json:2:";
    EXPECT_EQ(parseMessage("{\n}"),
              "loading scene: s.json:1:1: key \"version\": missing, must be 1");
    EXPECT_EQ(parseMessage("{\"version\": 2}"),
              "loading scene: s.json:1:13: key \"version\": is 2, must be 1");
    EXPECT_EQ(parseMessage("[]"), "loading scene: s.json:1:1: is an array of 0, must be an object");
    EXPECT_EQ(memberMessage("\"cmera\": {}"),
              start +
                  "1: key \"cmera\": unknown key, known are $schema, background, camera, effects, "
                  "image, lights, materials, media, meshes, particleBudget, render, spheres, version, "
                  "volumes");
    EXPECT_EQ(memberMessage("\"image\": { \"width\": 0 }"),
              start + "21: key \"image.width\": is 0, must be an integer from 1 to 16384");
    EXPECT_EQ(memberMessage("\"image\": { \"width\": 9.5 }"),
              start + "21: key \"image.width\": is 9.5, must be an integer from 1 to 16384");
    EXPECT_EQ(
        memberMessage("\"camera\": { \"position\": [0,0,1], \"target\": [0,0,0], \"fov\": 3 }"),
        start +
            "53: key \"camera.fov\": unknown key, known are near, position, target, type, up, "
            "verticalFov");
    EXPECT_EQ(memberMessage("\"camera\": { \"position\": [0,0,1] }"),
              start + "11: key \"camera.target\": missing, must be an array of 3, each a number");
    EXPECT_EQ(memberMessage("\"camera\": { \"position\": [0,0,1], \"target\": [0,0,1] }"),
              start + "11: key \"camera\": target equals position, they must differ");
    EXPECT_EQ(memberMessage("\"lights\": [ { \"type\": \"ambient\", \"radiance\": [1,-1,1] } ]"),
              start + "49: key \"lights[0].radiance[1]\": is -1, must be a number of at least 0");
    EXPECT_EQ(memberMessage("\"lights\": [ { \"type\": \"lamp\" } ]"),
              start +
                  "23: key \"lights[0].type\": is \"lamp\", must be one of \"ambient\", "
                  "\"directional\", \"point\", \"spot\"");
    EXPECT_EQ(
        memberMessage("\"lights\": [ { \"type\": \"spot\", \"position\": [0,0,0], \"direction\": "
                      "[0,0,1], \"intensity\": [1,1,1], \"innerAngle\": 40 } ]"),
        start +
            "110: key \"lights[0].innerAngle\": innerAngle 40 is above outerAngle 30, must be at "
            "most that");
    EXPECT_EQ(
        memberMessage("\"materials\": { \"m\": { \"type\": \"opaque\", \"ior\": 1 } }"),
        start +
            "41: key \"materials.m.ior\": unknown key, known are albedo, alphaCutoff, emission, "
            "emissionTexture, texture, type");
    EXPECT_EQ(memberMessage(
                  "\"meshes\": [ { \"shape\": \"box\", \"size\": [1,1,1], \"material\": \"m\" } ]"),
              start + "60: key \"meshes[0].material\": no material \"m\", the scene has none");
    EXPECT_EQ(
        memberMessage(
            "\"media\": { \"fog\": { \"extinction\": [1,1,1] } }, \"spheres\": [ { \"center\": "
            "[0,0,0], \"radius\": 1, \"medium\": \"frog\" } ]"),
        start + "105: key \"spheres[0].medium\": no medium \"frog\", known are fog");
    EXPECT_EQ(
        memberMessage("\"background\": { \"radiance\": [0,0,0], \"environment\": \"sky.hdr\" }"),
        start + "17: key \"background.radiance\": unknown key, known are environment, scale");
}

TEST(Scene_Errors, MissingFiles_AreNamedAtTheirKey) {
    const std::string folder = std::filesystem::current_path().string();
    EXPECT_EQ(
        memberMessage("\"meshes\": [ { \"file\": \"no.glb\" } ]"),
        "loading scene: s.json:2:23: key \"meshes[0].file\": no such file: " + folder + "/no.glb");
    EXPECT_EQ(memberMessage("\"background\": { \"environment\": \"sky.jpg\" }"),
              "loading scene: s.json:2:32: key \"background.environment\": unknown extension, "
              "allowed are "
              ".hdr and .exr");
    EXPECT_EQ(messageOf([] { loadScene("/nowhere/s.json", Log()); }),
              "loading scene: /nowhere/s.json: no such file");
    EXPECT_EQ(messageOf([] { loadScene("/tmp", Log()); }), "loading scene: /tmp: no such file");
}

TEST(Scene_Ranges, JustOutside_IsRefused) {
    const std::string fog = "\"media\":{\"fog\":{\"extinction\":[1,1,1]";
    for (const std::string& member : std::vector<std::string>{
             "\"image\":{\"height\":16385}",
             "\"image\":{\"supersample\":17}",
             "\"camera\":{\"position\":[0,0,1],\"target\":[0,0,0],\"near\":0}",
             "\"camera\":{\"position\":[0,0,1],\"target\":[0,0,0],\"verticalFov\":180}",
             "\"camera\":{\"position\":[0,0,1],\"target\":[0,0,0],\"up\":[0,0,1]}",
             "\"camera\":{\"type\":\"orthographic\",\"position\":[0,0,1],\"target\":[0,0,0]}",
             fog + ",\"albedo\":[1,1,1.01]}}",
             fog + ",\"emission\":[0,0,-1]}}",
             fog + ",\"phase\":{\"type\":\"henyey_greenstein\",\"g\":0.9991}}}",
             fog + ",\"phase\":{\"type\":\"isotropic\",\"g\":0.5}}}",
             "\"media\":{\"fog\":{\"extinction\":[1,-0.1,1]}}",
             "\"materials\":{\"m\":{\"type\":\"thin\",\"coverage\":1.1}}",
             "\"materials\":{\"m\":{\"type\":\"solid\",\"absorption\":[0,0,-1]}}",
             "\"materials\":{\"m\":{\"type\":\"solid\",\"ior\":0.9}}",
             "\"materials\":{\"m\":{}}",
             fog + "}},\"spheres\":[{\"center\":[0,0,0],\"radius\":0,\"medium\":\"fog\"}]",
             fog + "}},\"spheres\":[{\"center\":[0,0,0],\"radius\":1,\"medium\":\"fog\","
                   "\"density\":-1}]",
             fog + "}},\"spheres\":[{\"center\":[0,0],\"radius\":1,\"medium\":\"fog\"}]",
             fog + "}},\"volumes\":[{\"file\":\"a\",\"medium\":\"fog\",\"tolerance\":0}]",
             fog +
                 "}},\"volumes\":[{\"file\":\"a\",\"medium\":\"fog\",\"transform\":{\"scale\":0}}]",
             fog + "}},\"volumes\":[{\"file\":\"a\",\"medium\":\"fog\",\"transform\":{\"scale\":[1,"
                   "0,1]}}]",
             fog + "}},\"volumes\":[{\"file\":\"\",\"medium\":\"fog\"}]",
             "\"materials\":{\"m\":{\"type\":\"solid\"}},\"meshes\":[{\"shape\":\"plane\",\"size\":"
             "[1,1],"
             "\"material\":\"m\"}]",
             "\"materials\":{\"m\":{\"type\":\"opaque\"}},\"meshes\":[{\"shape\":\"sphere\","
             "\"radius\":1,"
             "\"segments\":5,\"material\":\"m\"}]",
             "\"meshes\":[{}]",
             "\"render\":{\"settings\":{\"a\":[1]}}",
             "\"background\":{\"scale\":1}"}) {
        const std::string message = memberMessage(member);
        EXPECT_EQ(message.substr(0, 24), "loading scene: s.json:2:") << member << " " << message;
    }
}

TEST(Scene_Effects, UnknownMedium_IsNamedWithTheKnownOnes) {
    const TempFolder folder;
    folder.write("e.json", R"({"version":1,"medium":"fog","emitters":[]})");
    const std::string message = messageOf([&] {
        parseScene(
            "{\"version\":1,\"media\":{\"mist\":{\"extinction\":[1,1,1]}},\n"
            "\"effects\":[{\"file\":\"e.json\"}]}",
            folder / "s.json", Log());
    });
    EXPECT_NE(
        message.find(":2:20: key \"effects[0].file\": the effect wants a medium that the scene "
                     "lacks: no medium \"fog\", known are mist"),
        std::string::npos)
        << message;
}

}  // namespace
}  // namespace brume::scene
