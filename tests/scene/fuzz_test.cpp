// SPDX-License-Identifier: Apache-2.0
// Ten thousand damaged inputs per parser: each loads or gives one line of input Error.
#include "scene_test_util.hpp"

#include <scene/gltf_loader.hpp>
#include <scene/loader.hpp>

#include <random>
#include <string_view>

namespace brume::scene {
namespace {

constexpr int kInputCount = 10000;

/// Damages texts in the ways that files are damaged by disks, editors and ill will.
class Mutator {
  public:
    explicit Mutator(std::uint32_t seed) : mRandom(seed) {}

    std::size_t below(std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(mRandom);
    }

    std::string mutate(std::string text) {
        switch (below(8)) {
            case 0:
                return text.substr(0, below(text.size() + 1));
            case 1:
                return randomBytes(below(300));
            case 2:
                flipBytes(text);
                return text;
            case 3:
                text.insert(below(text.size() + 1), randomBytes(1 + below(8)));
                return text;
            case 4:
                text.erase(below(text.size()), 1 + below(20));
                return text;
            default:
                return changeTokens(text);
        }
    }

  private:
    std::string randomBytes(std::size_t count) {
        std::string bytes;
        for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(below(256));
        return bytes;
    }

    void flipBytes(std::string& text) {
        for (std::size_t i = 1 + below(6); i > 0; --i)
            text[below(text.size())] ^= static_cast<char>(1 << below(8));
    }

    static std::vector<std::string> splitTokens(const std::string& text) {
        const std::string_view punctuation = " \n\t{}[],:";
        std::vector<std::string> tokens;
        for (const char c : text) {
            const bool alone = punctuation.find(c) != std::string_view::npos;
            if (alone || tokens.empty() ||
                punctuation.find(tokens.back().back()) != std::string_view::npos)
                tokens.emplace_back();
            tokens.back() += c;
        }
        return tokens;
    }

    /// Swaps, repeats, drops or replaces a few tokens.
    std::string changeTokens(const std::string& text) {
        static const std::vector<std::string> hostile{"-1",
                                                      "0",
                                                      "1e30",
                                                      "-1e30",
                                                      "1e-30",
                                                      "1e400",
                                                      "4294967296",
                                                      "18446744073709551616",
                                                      "null",
                                                      "true",
                                                      "[]",
                                                      "{}",
                                                      "\"\"",
                                                      "\"\\u0000\"",
                                                      "NaN",
                                                      "0.5",
                                                      "2147483647",
                                                      "-2147483648",
                                                      "\"type\"",
                                                      "[1,2,3]",
                                                      "65535",
                                                      "[[[[",
                                                      "9007199254740993"};
        std::vector<std::string> tokens = splitTokens(text);
        for (std::size_t i = 1 + below(3); i > 0; --i) {
            std::string& token = tokens[below(tokens.size())];
            switch (below(4)) {
                case 0:
                    std::swap(token, tokens[below(tokens.size())]);
                    break;
                case 1:
                    token += token;
                    break;
                case 2:
                    token.clear();
                    break;
                default:
                    token = hostile[below(hostile.size())];
            }
        }
        std::string result;
        for (const std::string& token : tokens) result += token;
        return result;
    }

    std::mt19937 mRandom;
};

struct Outcome {
    int loaded = 0;
    int refused = 0;
};

/// Runs `load` and holds what it throws against the contract.
template <typename Load>
void tryOne(Load load, int index, Outcome& outcome) {
    try {
        load();
        ++outcome.loaded;
    } catch (const Error& error) {
        ++outcome.refused;
        const std::string message = error.what();
        EXPECT_EQ(error.kind(), ErrorKind::Input) << index << ": " << message;
        EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << index << ": " << message;
        EXPECT_LT(message.size(), 2000u) << index;
        // The validator's own words would mean that explainViolation() found nothing.
        EXPECT_EQ(message.find("constraint"), std::string::npos) << index << ": " << message;
    } catch (const std::exception& error) {
        ADD_FAILURE() << "input " << index << ": " << error.what();
    }
}

const char* const kEffectText =
    R"({ "version": 1, "capacity": 1000, "tickRate": 120, "medium": "smoke",
  "emitters": [ { "rate": 2000, "bursts": [ { "time": 0, "count": 500 } ], "duration": 5,
                  "shape": { "type": "sphere", "radius": 0.2 }, "speed": [0.5,1], "direction": [0,1,0],
                  "spread": 20, "lifetime": [2,4] },
                { "shape": { "type": "box", "size": [1,1,1] }, "speed": 1, "lifetime": 4 } ],
  "modules": [ { "type": "gravity", "acceleration": [0,-9.81,0] }, { "type": "drag", "rate": 0.5, "on": true } ],
  "overLife": { "radius": [[0,0.05],[1,0.3]], "density": [[0,1],[1,0]], "tint": [[0,[1,1,1]],[1,[0.5,0.5,0.5]]] },
  "profile": "smooth" })";

const char* const kSceneText = R"({ "version": 1, // a comment
  "camera": { "type": "perspective", "position": [0,1.2,5], "target": [0,1,0], "up": [0,1,0], "verticalFov": 40, "near": 0.01 },
  "image": { "width": 96, "height": 54, "supersample": 1 },
  "background": { "environment": "sky.exr", "scale": 1 },
  "lights": [ { "type": "ambient", "radiance": [0.2,0.2,0.2] },
              { "type": "directional", "direction": [0.6,-0.7,-0.39], "irradiance": [3,3,3], "shadow": "visibility" },
              { "type": "spot", "position": [0,3,0], "direction": [0,-1,0], "intensity": [1,1,1], "innerAngle": 20, "outerAngle": 30 },
              { "type": "point", "position": [0,3,0], "intensity": [1,1,1], "radius": 0.1 } ],
  "materials": { "floor": { "type": "opaque", "albedo": [0.5,0.5,0.5], "emission": [0,0,0], "texture": "a.png" },
                 "pane": { "type": "thin", "coverage": 1, "transmission": [0.9,0.2,0.1], "reflected": [0.04,0.04,0.04], "collimation": 1, "ior": 1.5 },
                 "glass": { "type": "solid", "absorption": [1,0.2,0.2], "scattering": [0,0,0], "ior": 1.5 } },
  "media": { "smoke": { "extinction": [4,4,4], "albedo": [0.9,0.9,0.9], "phase": { "type": "henyey_greenstein", "g": 0.3 }, "emission": [0,0,0] } },
  "meshes": [ { "file": "mesh.glb" }, { "shape": "plane", "size": [10,10], "material": "floor", "transform": {} },
              { "shape": "sphere", "radius": 1, "segments": 8, "material": "glass", "transform": { "translate": [0,0,0], "rotate": [0,90,0], "scale": [1,-1,1] } } ],
  "volumes": [ { "file": "plume.vdb", "density": "density", "gridIndex": 0, "medium": "smoke", "representation": "bricks", "tolerance": 0.03 } ],
  "spheres": [ { "center": [0,1,0], "radius": 0.5, "medium": "smoke", "density": 2, "profile": "constant" } ],
  "effects": [ { "file": "e.json", "transform": {}, "seed": 7, "time": 2.0 } ],
  "render": { "method": "linked_list", "settings": { "budgetMiB": 512 } } })";

/// A small glTF file that uses most of what the loader reads.
test::GlbBuilder makeGlbParts(std::string& members) {
    test::GlbBuilder glb;
    glb.addFloats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, 3);
    glb.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    glb.addFloats({0, 0, 1, 0, 0, 1, 1, 1}, 2);
    glb.addIndices({0, 1, 2, 2, 1, 3});
    const std::uint16_t where[] = {1};
    const float what[] = {5, 6, 7};
    const int indexView = glb.addView(where, sizeof where);
    const int valueView = glb.addView(what, sizeof what);
    glb.addAccessor(
        0, 5126, 4, "VEC3",
        ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":" + std::to_string(indexView) +
            ",\"componentType\":5123},\"values\":{\"bufferView\":" + std::to_string(valueView) +
            "}}");
    const std::string png = test::makePngBytes(4);
    const int view = glb.addView(png.data(), png.size());
    members =
        "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1,2],\"translation\":["
        "1,2,3],"
        "\"rotation\":[0,0,0,1],\"scale\":[1,1,-1]},{\"mesh\":0},{\"mesh\":1,\"matrix\":[1,0,0,0,0,"
        "1,0,0,0,0,"
        "1,0,0,0,0,1]}],\"images\":[{\"mimeType\":\"image/png\",\"bufferView\":" +
        std::to_string(view) +
        "}],\"textures\":[{\"source\":0}],\"materials\":[{\"name\":\"a\",\"alphaMode\":\"MASK\","
        "\"alphaCutoff\":0.5,\"emissiveFactor\":[1,1,1],\"emissiveTexture\":{\"index\":0},"
        "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,1,1],\"baseColorTexture\":{\"index\":"
        "0,"
        "\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0],\"scale\":[2,3],"
        "\"rotation\":1}}}}},"
        "{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},\"KHR_"
        "materials_volume\":"
        "{\"thicknessFactor\":1,\"attenuationColor\":[0.1,0.5,1],\"attenuationDistance\":2},"
        "\"KHR_materials_ior\":{\"ior\":1.4}}}],\"meshes\":[{\"name\":\"m\",\"primitives\":[{"
        "\"attributes\":{"
        "\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2},\"indices\":3,\"material\":0}]},{"
        "\"primitives\":[{"
        "\"attributes\":{\"POSITION\":4},\"mode\":5,\"material\":1}]}],\"extensionsUsed\":["
        "\"KHR_materials_ior\"]";
    return glb;
}

TEST(Fuzz_Effect, DamagedTexts_LoadOrGiveOneLine) {
    Mutator mutator(20240601);
    Outcome outcome;
    parseEffect(kEffectText, "e.json", Log());
    for (int i = 0; i < kInputCount; ++i) {
        const std::string text = mutator.mutate(kEffectText);
        tryOne([&] { parseEffect(text, "e.json", Log()); }, i, outcome);
    }
    EXPECT_GT(outcome.refused, kInputCount / 2);
    EXPECT_GT(outcome.loaded, kInputCount / 50);
}

TEST(Fuzz_Scene, DamagedTexts_LoadOrGiveOneLine) {
    const test::TempFolder folder;
    writeImage(folder / "sky.exr", Image(4, 2, vec3(1)));
    folder.write("a.png", test::makePngBytes(4));
    folder.write("e.json", kEffectText);
    std::string members;
    const auto glb = makeGlbParts(members).build(members);
    folder.write("mesh.glb", std::string(glb.begin(), glb.end()));
    const std::filesystem::path file = folder / "s.json";
    parseScene(kSceneText, file, Log());
    Mutator mutator(20240602);
    Outcome outcome;
    for (int i = 0; i < kInputCount; ++i) {
        const std::string text = mutator.mutate(kSceneText);
        tryOne([&] { parseScene(text, file, Log()); }, i, outcome);
    }
    EXPECT_GT(outcome.refused, kInputCount / 2);
    EXPECT_GT(outcome.loaded, kInputCount / 50);
}

TEST(Fuzz_Glb, DamagedFiles_LoadOrGiveOneLine) {
    std::string members;
    test::GlbBuilder glb = makeGlbParts(members);
    const std::string json = glb.json(members);
    const auto whole = test::GlbBuilder::pack(json, glb.binary());
    parseGltf(whole, "a.glb", Log());
    Mutator mutator(20240603);
    Outcome outcome;
    for (int i = 0; i < kInputCount; ++i) {
        std::vector<unsigned char> bytes;
        const std::size_t kind = mutator.below(4);
        if (kind == 0) {
            const std::string damaged = mutator.mutate({whole.begin(), whole.end()});
            bytes.assign(damaged.begin(), damaged.end());
        } else if (kind == 1) {  // only the data
            bytes = test::GlbBuilder::pack(json, mutator.mutate(glb.binary()));
        } else {  // only the description, so that it gets past the header
            bytes = test::GlbBuilder::pack(mutator.mutate(json), glb.binary());
        }
        tryOne([&] { parseGltf(bytes, "a.glb", Log()); }, i, outcome);
    }
    EXPECT_GT(outcome.refused, kInputCount / 4);
    EXPECT_GT(outcome.loaded, kInputCount / 50);
}

}  // namespace
}  // namespace brume::scene
