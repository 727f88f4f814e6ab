// SPDX-License-Identifier: Apache-2.0
// What a host sees: the same as the renderer of whole images, behind and before what it has drawn.
#include <brume/brume_vdb.h>
#include <host/host_fixture.hpp>

#include <bench/prepare.hpp>
#include <render/renderer.hpp>
#include <scene/loader.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace brume::test {
namespace {

Scene makeScene(const Context& context, const char* text, const char* method = nullptr) {
    auto info = init<BrumeSceneCreateInfo>();
    info.text = text;
    info.method = method;
    return Scene(context, info);
}

double largestDifference(const std::vector<vec4>& a, const brume::Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(double(a[i][c]) - b.pixels[i][c]));
    return largest;
}

class HostMethods : public HostTest, public ::testing::WithParamInterface<const char*> {};

std::string sceneWithShadow() {
    std::string text = kSpheresScene;
    return text.replace(text.find("[3, 3, 3] }"), 11,
                        R"([3, 3, 3], "shadow": "visibility",
                            "shadowSettings": { "resolution": "64" } })");
}

/// As kSpheresScene, with an effect at 0.5 s. (No shadow: its map's range follows the particles for
/// the renderer, which can look at them, and an estimate for hosts.)
std::string sceneWithEffect(const std::string& folder) {
    std::string text = kSpheresScene;
    std::ofstream(folder + "/puffs.effect.json") << kEffect;
    text.insert(text.rfind("}"), R"(, "effects": [ { "file": "puffs.effect.json", "time": 0.5,
        "transform": { "translate": [0, 0.5, 0.3] } } ])");
    return text;
}

TEST_P(HostMethods, SceneOfAFile_EqualsTheRenderer) {
    const std::string folder = ::testing::TempDir() + "brume_host_" + GetParam();
    std::filesystem::create_directories(folder);
    const std::string file = folder + "/scene.json";
    for (const std::string& text : {sceneWithEffect(folder), sceneWithShadow()}) {
        std::ofstream(file) << text;
        const auto prepared = bench::prepareScene(scene::loadScene(file, log()), log());
        render::Options options;
        options.method = GetParam();
        const brume::Image expected =
            render::Renderer(device(), prepared, options, log()).renderFrame().image;

        const Context context(host().contextInfo());
        Scene scene = Scene::load(context, file.c_str(), GetParam());
        for (int frame = 0; frame < 3; ++frame) {
            host().draw({0.2f, 0.3f, 0.4f}, 0);
            host().frame(context.get(), [&](VkCommandBuffer commands) {
                scene.cmdSimulate(commands, 0);
                scene.cmdRender(commands, host().view());
            });
            EXPECT_LE(largestDifference(host().read(), expected), 1e-6) << "frame " << frame;
        }
        EXPECT_EQ(host().read()[0].w, 0.25f) << "the host's alpha";
        EXPECT_EQ(scene.counters().shadowPairsDropped, 0u);
        EXPECT_GE(scene.counters().sphereSlots, 2u);
    }
}

INSTANTIATE_TEST_SUITE_P(All, HostMethods,
                         ::testing::Values("sorted", "march", "weighted", "unordered", "moment",
                                           "peel", "k_buffer", "stochastic", "tile",
                                           "linked_list"));

/// 120 spheres that fill the view: more than what is reserved before anything is known.
std::string sceneOfManySpheres() {
    std::string text = R"({ "version": 1,
        "camera": { "position": [0, 0, 5], "target": [0, 0, 0], "verticalFov": 60, "near": 0.1 },
        "image": { "width": 48, "height": 32 }, "background": { "radiance": [0.2, 0.3, 0.4] },
        "lights": [ { "type": "ambient", "radiance": [0.4, 0.5, 0.6] } ],
        "media": { "red": { "extinction": [0.01, 0.01, 0.01], "albedo": [0.9, 0.1, 0.1] },
                   "blue": { "extinction": [0.01, 0.01, 0.01], "albedo": [0.1, 0.1, 0.9] } },
        "spheres": [ )";
    for (int i = 0; i < 120; ++i)
        text += std::string(i > 0 ? ", " : "") + R"({ "center": [0.1, 0.1, )" +
                std::to_string(-0.01 * i) + R"(], "radius": 3.5, "density": 1,
                "medium": ")" +
                (i % 2 ? "red" : "blue") + R"(" })";
    return text + " ] }";
}

class HostLists : public HostTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(HostLists, BeyondTheReservedMemory_SaySoAndGrowWhenPrepared) {
    const std::string file = ::testing::TempDir() + "brume_host_lists_" + GetParam() + ".json";
    std::ofstream(file) << sceneOfManySpheres();
    const auto prepared = bench::prepareScene(scene::loadScene(file, log()), log());
    render::Options options;
    options.method = GetParam();
    const brume::Image expected =
        render::Renderer(device(), prepared, options, log()).renderFrame().image;

    const Context context(host().contextInfo());
    Scene scene = Scene::load(context, file.c_str(), GetParam());
    scene.prepare(host().view());
    const auto renderFrame = [&] {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        host().frame(context.get(),
                     [&](VkCommandBuffer commands) { scene.cmdRender(commands, host().view()); });
        return largestDifference(host().read(), expected);
    };
    // Of 120 faint layers the nearest stay: right but for what the others would have hidden.
    const double error = renderFrame();
    EXPECT_GT(error, 1e-3);
    EXPECT_LT(error, 0.3);
    const BrumeCounters few = scene.counters();
    EXPECT_GT(few.methodDropped, 0u);
    EXPECT_GE(few.methodBytesWanted, 4u * 120 * 24) << "pairs with 24 tiles";
    int growths = 0;
    while (scene.counters().methodDropped > 0 && growths < 4) {
        scene.prepare(host().view());
        ++growths;
        renderFrame();
    }
    EXPECT_LE(growths, 3);
    EXPECT_LE(renderFrame(), 1e-6);
    EXPECT_EQ(scene.counters().methodDropped, 0u);
    EXPECT_GT(scene.counters().sceneBytes, few.sceneBytes);
}

INSTANTIATE_TEST_SUITE_P(All, HostLists, ::testing::Values("tile", "linked_list"));

/// A camera that looks along -z at a sphere of constant density, half behind an opaque wall.
struct DepthCase {
    const char* name;
    double near, far;
    bool isReversed;
    bool isOrthographic;
    int x, y, width, height;  // viewport
    float minDepth, maxDepth;
};

class HostDepths : public HostTest, public ::testing::WithParamInterface<DepthCase> {};

double depthAt(const BrumeView& view, double distance) {
    const double* m = view.clipFromView;
    const double z = -distance;
    const double ndc = (m[10] * z + m[14]) / (m[11] * z + m[15]);
    return view.minDepth + (view.maxDepth - view.minDepth) * ndc;
}

TEST_P(HostDepths, WallThroughASphere_HidesWhatIsBehind) {
    const DepthCase& c = GetParam();
    constexpr double kDistance = 5, kRadius = 1.5, kSigma = 0.8;
    BrumeView view = host().view({0, 0, kDistance});
    setPerspective(view.clipFromView, 2, double(c.width) / std::abs(c.height), c.near, c.far,
                   c.isReversed);
    if (c.isOrthographic) {
        std::fill_n(view.clipFromView, 16, 0.0);
        view.clipFromView[0] = 0.5;
        view.clipFromView[5] = -0.5;
        const double range = c.far - c.near;
        view.clipFromView[10] = c.isReversed ? 1 / range : -1 / range;
        view.clipFromView[14] = c.isReversed ? c.far / range : -c.near / range;
        view.clipFromView[15] = 1;
    }
    view.x = c.x, view.y = c.y, view.width = c.width, view.height = c.height;
    view.minDepth = c.minDepth, view.maxDepth = c.maxDepth;

    const Context context(host().contextInfo());
    Scene scene = makeScene(context, R"({ "version": 1,
        "media": { "ink": { "extinction": [0.8, 0.8, 0.8], "albedo": [0, 0, 0] } },
        "spheres": [ { "center": [0, 0, 0], "radius": 1.5, "medium": "ink", "density": 1 } ] })",
                            "sorted");
    const int top = std::min(c.y, c.y + c.height), height = std::abs(c.height);
    const auto transmittanceWithWallAt = [&](double distance) {
        // Beyond the far plane: nothing opaque at all.
        host().draw(vec3(1), static_cast<float>(depthAt(view, distance)));
        BrumeView now = view;
        now.color.layout = host().color.layout();
        now.depth.layout = host().depth.layout();
        host().frame(context.get(),
                     [&](VkCommandBuffer commands) { scene.cmdRender(commands, now); });
        const std::vector<vec4> pixels = host().read();
        for (int y = 0; y < int(host().size.height); ++y)
            for (int x = 0; x < int(host().size.width); ++x) {
                const bool isInside = x >= c.x && x < c.x + c.width && y >= top && y < top + height;
                if (isInside) continue;
                EXPECT_EQ(pixels[y * host().size.width + x].x, 1) << x << ", " << y;
            }
        return pixels[(top + height / 2) * host().size.width + c.x + c.width / 2].x;
    };
    // The ray of the pixel beside the centre; its chord is all but the diameter.
    const double pixel = c.isOrthographic ? 2.0 / c.width : 0.0;
    const double half = std::sqrt(kRadius * kRadius - pixel * pixel);
    const auto expected = [&](double length) { return std::exp(-kSigma * length); };
    EXPECT_NEAR(transmittanceWithWallAt(kDistance - 2), 1, 1e-6) << "before the sphere";
    EXPECT_NEAR(transmittanceWithWallAt(kDistance), expected(half), 2e-2) << "in its middle";
    EXPECT_NEAR(transmittanceWithWallAt(kDistance + 1), expected(half + 1), 2e-2);
    EXPECT_NEAR(transmittanceWithWallAt(kDistance + 2), expected(2 * half), 2e-2) << "behind it";
}

INSTANTIATE_TEST_SUITE_P(
    All, HostDepths,
    ::testing::Values(
        DepthCase{"reversed_infinite", 0.1, 0, true, false, 0, 0, 48, 32, 0, 1},
        DepthCase{"infinite", 0.1, 0, false, false, 0, 0, 48, 32, 0, 1},
        DepthCase{"conventional", 0.5, 50, false, false, 0, 0, 48, 32, 0, 1},
        DepthCase{"reversed", 0.5, 50, true, false, 8, 4, 30, 20, 0, 1},
        DepthCase{"viewport_turned_over", 0.5, 50, false, false, 6, 28, 32, -24, 0, 1},
        DepthCase{"part_of_the_range", 0.5, 50, true, false, 0, 0, 48, 32, 0.25f, 0.75f},
        DepthCase{"orthographic", 0.5, 20, false, true, 0, 0, 48, 32, 0, 1},
        DepthCase{"orthographic_reversed", 0.5, 20, true, true, 4, 4, 40, 24, 0, 1}),
    [](const auto& tested) { return std::string(tested.param.name); });

// A mirror image in y is what a negative height asks for.
TEST_F(HostTest, NegativeHeight_TurnsTheImageOver) {
    const Context context(host().contextInfo());
    Scene scene = makeScene(context, kSpheresScene, "sorted");
    const auto renderWith = [&](bool isTurned) {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        BrumeView view = host().view();
        if (isTurned) view.y = view.height, view.height = -view.height;
        host().frame(context.get(),
                     [&](VkCommandBuffer commands) { scene.cmdRender(commands, view); });
        return host().read();
    };
    const std::vector<vec4> upright = renderWith(false), turned = renderWith(true);
    const std::size_t w = host().size.width, h = host().size.height;
    double largest = 0, spread = 0;
    for (std::size_t i = 0; i < w * h; ++i) {
        const std::size_t mirror = (h - 1 - i / w) * w + i % w;
        largest = std::max(largest, std::abs(double(upright[i].x) - turned[mirror].x));
        spread = std::max(spread, std::abs(double(upright[i].x) - turned[i].x));
    }
    EXPECT_LE(largest, 1e-5);
    EXPECT_GT(spread, 1e-2);
}

/// Part of the image through a projection of its own, which is off-centre then.
struct PartCase {
    const char* name;
    bool isOrthographic, isTurned;
};

class HostParts : public HostTest, public ::testing::WithParamInterface<PartCase> {};

TEST_P(HostParts, OffCentreProjection_ShowsThatPartOfTheWhole) {
    std::string text = kSpheresScene;
    text.insert(text.rfind("}"), R"(, "materials": {
        "pane": { "type": "thin", "transmission": [0.9, 0.3, 0.2], "reflected": [0.1, 0.1, 0.1] },
        "box": { "type": "opaque" } },
        "meshes": [ { "shape": "plane", "size": [2, 2], "material": "pane",
                      "transform": { "rotate": [80, 20, 0], "translate": [0.4, 0.3, 1] } },
                    { "shape": "box", "size": [0.8, 0.8, 0.8], "material": "box",
                      "transform": { "rotate": [20, 30, 0], "translate": [-0.5, -0.4, 0.6] } } ])");
    const Context context(host().contextInfo());
    host().draw({0.2f, 0.3f, 0.4f}, 0);
    BrumeView whole = host().view();
    if (GetParam().isOrthographic) {
        double* m = whole.clipFromView;
        std::fill_n(m, 16, 0.0);
        m[0] = 0.3, m[5] = -0.45, m[10] = 0.05, m[14] = 1, m[15] = 1;  // z from 0 to -20, reversed
    }
    if (GetParam().isTurned) whole.y = whole.height, whole.height = -whole.height;
    // Pixels 18 to 42 and 4 to 20 of 48 x 32, the middle of which is at 1/4, -1/4 of the clip
    // space.
    BrumeView part = whole;
    part.x = 18, part.y = 4, part.width = 24, part.height = 16;
    double middleY = -0.25;
    if (GetParam().isTurned) part.y = 20, part.height = -16, middleY = 0.25;
    for (int column = 0; column < 4; ++column) {
        double* m = part.clipFromView + 4 * column;
        m[0] = 2 * (m[0] - 0.25 * m[3]);
        m[1] = 2 * (m[1] - middleY * m[3]);
    }
    for (const char* method : {"sorted", "weighted"}) {
        Scene scene = makeScene(context, text.c_str(), method);
        Scene other = makeScene(context, text.c_str(), method);
        const auto renderWith = [&](Scene& used, const BrumeView& view) {
            host().draw({0.2f, 0.3f, 0.4f}, 0);
            host().frame(context.get(),
                         [&](VkCommandBuffer commands) { used.cmdRender(commands, view); });
            return host().read();
        };
        const std::vector<vec4> expected = renderWith(scene, whole), seen = renderWith(other, part);
        int wrong = 0, drawn = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const std::size_t x = i % 48, y = i / 48;
            const bool isInside = x >= 18 && x < 42 && y >= 4 && y < 20;
            const vec3 blank(0.2f, 0.3f, 0.4f), right = isInside ? vec3(expected[i]) : blank;
            const vec3 off = glm::abs(vec3(seen[i]) - right);
            drawn += isInside && glm::distance(right, blank) > 0.02f;
            wrong += std::max({off.x, off.y, off.z}) > 2e-5f;
        }
        EXPECT_LE(wrong, 4) << method << ": pixels, at edges that are snapped to sub-pixels";
        EXPECT_GT(drawn, 100) << method;
    }
}

INSTANTIATE_TEST_SUITE_P(All, HostParts,
                         ::testing::Values(PartCase{"perspective", false, false},
                                           PartCase{"perspective_turned_over", false, true},
                                           PartCase{"orthographic", true, false}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_F(HostTest, ObjectsByCalls_EqualThoseOfAFile) {
    const Context context(host().contextInfo());
    Scene fromFile = makeScene(context, kSpheresScene, "sorted");
    Scene byCalls(context, init<BrumeSceneCreateInfo>());
    auto medium = init<BrumeMedium>();
    medium.name = "smoke";
    std::fill_n(medium.extinction, 3, 1.5);
    medium.albedo[0] = 0.9, medium.albedo[1] = 0.8, medium.albedo[2] = 0.7;
    BrumeId smoke = 0, lamp = 0, spheres = 0, effect = 0;
    check(brumeAddMedium(byCalls.get(), &medium, &smoke));
    EXPECT_EQ(brumeFindMedium(byCalls.get(), "smoke"), smoke);
    EXPECT_EQ(brumeFindMedium(byCalls.get(), "fog"), 0u);
    auto ambient = init<BrumeLight>();
    ambient.color[0] = 0.4, ambient.color[1] = 0.5, ambient.color[2] = 0.6;
    check(brumeAddLight(byCalls.get(), &ambient, nullptr));
    auto sun = init<BrumeLight>();
    sun.type = BRUME_LIGHT_DIRECTIONAL;
    std::fill_n(sun.color, 3, 1.0);
    sun.direction[0] = 0.6, sun.direction[1] = -0.7, sun.direction[2] = -0.4;
    check(brumeAddLight(byCalls.get(), &sun, &lamp));
    BrumeSphere list[2] = {};
    list[0] = {{-0.4, 0.1, 0}, 1.1f, 0.7f, {}, 1};
    list[1] = {{5, 5, 5}, 1.2f, 0.5f, {}, 1};
    check(brumeAddSpheres(byCalls.get(), smoke, 2, list, &spheres));
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(byCalls.get(), &puffs, &effect));
    const auto render = [&](Scene& scene) {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        host().frame(context.get(), [&](VkCommandBuffer commands) {
            scene.cmdSimulate(commands, 0.1);
            scene.cmdRender(commands, host().view());
        });
        return host().read();
    };
    EXPECT_NE(render(byCalls), render(fromFile));
    EXPECT_EQ(byCalls.counters().effects, 1u);

    // Changed and removed, both are the same.
    std::fill_n(sun.color, 3, 3.0);
    check(brumeSetLight(byCalls.get(), lamp, &sun));
    list[1].center[0] = 0.6, list[1].center[1] = -0.2, list[1].center[2] = -0.5;
    check(brumeSetSpheres(byCalls.get(), spheres, list));
    check(brumeRemove(byCalls.get(), effect));
    EXPECT_EQ(render(byCalls), render(fromFile));
    EXPECT_EQ(brumeRemove(byCalls.get(), effect), BRUME_ERROR_INVALID_ARGUMENT);
}

// A full-grown effect goes on where it was when something else is added.
TEST_F(HostTest, AddingAnEffect_KeepsTheOthersRunning) {
    const Context context(host().contextInfo());
    Scene scene = makeScene(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    const auto step = [&](double seconds) {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        host().frame(context.get(), [&](VkCommandBuffer commands) {
            scene.cmdSimulate(commands, seconds);
            scene.cmdRender(commands, host().view());
        });
        return host().read();
    };
    step(0.5);
    const std::vector<vec4> before = step(0.5);
    puffs.worldFromEffect[0] = puffs.worldFromEffect[5] = puffs.worldFromEffect[10] = 1;
    puffs.worldFromEffect[13] = 100;  // out of sight
    puffs.worldFromEffect[15] = 1;
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    EXPECT_EQ(step(0), before);
    EXPECT_EQ(scene.counters().ticksBehind, 0u);
}

TEST_F(HostTest, MaxTicksPerFrame_IsCaughtUpLater) {
    auto info = host().contextInfo();
    info.maxTicksPerFrame = 20;
    const Context context(info);
    Scene scene = makeScene(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    host().draw({0.2f, 0.3f, 0.4f}, 0);
    std::vector<std::uint64_t> behind;
    for (int i = 0; i < 4; ++i) {
        host().frame(context.get(), [&](VkCommandBuffer commands) {
            scene.cmdSimulate(commands, i == 0 ? 1 : 0);
            scene.cmdRender(commands, host().view());
        });
        behind.push_back(scene.counters().ticksBehind);
    }
    EXPECT_EQ(behind, (std::vector<std::uint64_t>{40, 20, 0, 0}));
}

TEST_F(HostTest, ReloadedEffect_ReachesLiveInstances) {
    const std::string folder = ::testing::TempDir() + "brume_host_reload";
    std::filesystem::create_directories(folder);
    const std::string file = folder + "/puffs.effect.json";
    std::ofstream(file) << kEffect;
    const Context context(host().contextInfo());
    Scene scene = makeScene(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.file = file.c_str();
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    const auto step = [&](double seconds) {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        host().frame(context.get(), [&](VkCommandBuffer commands) {
            scene.cmdSimulate(commands, seconds);
            scene.cmdRender(commands, host().view());
        });
        return host().read();
    };
    step(0.5);
    const std::vector<vec4> before = step(0.1);
    EXPECT_EQ(scene.reload(), 0u);
    const auto write = [&](const std::string& text) {
        std::ofstream(file) << text;
        std::filesystem::last_write_time(
            file, std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
    };
    write("{ \"version\": 1, \"capacty\": 3 }");
    EXPECT_THROW(scene.reload(), ApiError);
    EXPECT_NE(std::string(brumeLastError()).find("capacty"), std::string::npos);
    EXPECT_EQ(step(0), before) << "after a bad file";
    std::string text = kEffect;
    text.replace(text.find("[1, 0.4]"), 8, "[1, 1.4]");
    write(text);
    EXPECT_EQ(scene.reload(), 1u);
    EXPECT_NE(step(0), before);

    // As if it had always been so.
    Scene fresh = makeScene(context, kSpheresScene, "sorted");
    check(brumeAddEffect(fresh.get(), &puffs, nullptr));
    const std::vector<vec4> after = step(0);
    host().draw({0.2f, 0.3f, 0.4f}, 0);
    host().frame(context.get(), [&](VkCommandBuffer commands) {
        fresh.cmdSimulate(commands, 0.6);
        fresh.cmdRender(commands, host().view());
    });
    EXPECT_EQ(host().read(), after);
}

TEST_F(HostTest, VolumeOfAFile_IsReadByTheHost) {
    const std::string folder = ::testing::TempDir() + "brume_host_volume";
    std::filesystem::create_directories(folder);
    const std::string file = folder + "/scene.json";
    std::ofstream(file) << R"({ "version": 1,
        "camera": { "position": [0, 0, 5], "target": [0, 0, 0], "verticalFov": 60, "near": 0.1 },
        "image": { "width": 48, "height": 32 }, "background": { "radiance": [0.2, 0.3, 0.4] },
        "lights": [ { "type": "ambient", "radiance": [0.4, 0.5, 0.6] } ],
        "media": { "smoke": { "extinction": [2, 2, 2], "albedo": [0.9, 0.8, 0.7] } },
        "volumes": [ { "file": ")"
                        << BRUME_SOURCE_DIR
                        << R"(/demos/plume/fire.vdb", "density": "density", "medium": "smoke",
                        "transform": { "translate": [0, -1, 0] } } ] })";
    auto info = host().contextInfo();
    EXPECT_THROW(Scene::load(Context(info), file.c_str()), ApiError) << "nobody reads volumes";
    info.readVolume = brumeReadVdb;
    const Context context(info);
    Scene scene = Scene::load(context, file.c_str(), "sorted");
    host().draw({0.2f, 0.3f, 0.4f}, 0);
    host().frame(context.get(),
                 [&](VkCommandBuffer commands) { scene.cmdRender(commands, host().view()); });
    EXPECT_GT(scene.counters().boxes, 10u);
    const auto prepared = bench::prepareScene(scene::loadScene(file, log()), log());
    render::Options options;
    options.method = "sorted";
    const brume::Image expected =
        render::Renderer(device(), prepared, options, log()).renderFrame().image;
    EXPECT_LE(largestDifference(host().read(), expected), 1e-6);

    auto density = init<BrumeDensity>();
    EXPECT_EQ(brumeReadVdb(nullptr, file.c_str(), "density", -1, &density),
              BRUME_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(brumeVdbLastError()).find("scene.json"), std::string::npos);
}

// A thousand kilometres away, and then counted from there: the same picture, and the effect goes
// on.
TEST_F(HostTest, RebasedScene_ShowsTheSame) {
    const Context context(host().contextInfo());
    Scene scene = makeScene(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;
    BrumeId id = 0;
    check(brumeAddEffect(scene.get(), &puffs, &id));
    const auto step = [&](double seconds, const dvec3& position) {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        host().frame(context.get(), [&](VkCommandBuffer commands) {
            scene.cmdSimulate(commands, seconds);
            scene.cmdRender(commands, host().view(position));
        });
        return host().read();
    };
    const dvec3 home(0, 0, 5), away(1048576, -2097152, 524288);  // sums that floats keep
    const std::vector<vec4> before = step(0.5, home);
    double lo[3], hi[3], movedLo[3], movedHi[3];
    check(brumeGetEffectBounds(scene.get(), id, lo, hi));
    check(brumeRebaseScene(scene.get(), &away.x));
    const auto expectSame = [&](const std::vector<vec4>& now) {
        for (std::size_t i = 0; i < now.size(); ++i)
            ASSERT_LT(glm::length(now[i] - before[i]), 1e-5) << i;
    };
    expectSame(step(0, home - away));
    check(brumeGetEffectBounds(scene.get(), id, movedLo, movedHi));
    for (int i = 0; i < 3; ++i) {
        EXPECT_LT(lo[i], hi[i]);
        EXPECT_EQ(movedLo[i], lo[i] - away[i]);
        EXPECT_EQ(movedHi[i], hi[i] - away[i]);
    }
    const dvec3 back = -away;
    check(brumeRebaseScene(scene.get(), &back.x));
    expectSame(step(0, home));
    EXPECT_NE(step(0.2, home), before);
    EXPECT_EQ(brumeRebaseScene(scene.get(), nullptr), BRUME_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(brumeGetEffectBounds(scene.get(), id + 1000, lo, hi), BRUME_ERROR_INVALID_ARGUMENT);
}

TEST_F(HostTest, BudgetOfARemovedEffect_GoesToTheOneThatWasCut) {
    const Context context(host().contextInfo());
    std::string text = kSpheresScene;
    text.insert(1, R"( "particleBudget": 300,)");
    Scene scene = makeScene(context, text.c_str(), "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = kEffect;  // wants 200
    BrumeId first = 0;
    check(brumeAddEffect(scene.get(), &puffs, &first));
    check(brumeAddEffect(scene.get(), &puffs, nullptr));
    const auto countSlots = [&] {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        host().frame(context.get(), [&](VkCommandBuffer commands) {
            scene.cmdSimulate(commands, 0.1);
            scene.cmdRender(commands, host().view());
        });
        return scene.counters().sphereSlots;
    };
    EXPECT_EQ(countSlots(), 2 + 300u);
    check(brumeRemove(scene.get(), first));
    EXPECT_EQ(countSlots(), 2 + 200u);
    EXPECT_EQ(scene.counters().ticksBehind, 0u);
}

TEST_F(HostTest, EffectsThatNeedAPicture_AreRefusedAtTheirModule) {
    const Context context(host().contextInfo());
    Scene scene = makeScene(context, kSpheresScene, "sorted");
    auto puffs = init<BrumeEffect>();
    puffs.text = R"({ "version": 1, "medium": "smoke", "emitters": [ { "rate": 9, "lifetime": 1 } ],
      "modules": [ { "type": "collide_depth" } ] })";
    EXPECT_EQ(brumeAddEffect(scene.get(), &puffs, nullptr), BRUME_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(brumeLastError()).find("effect.json:2:20: module 'collide_depth'"),
              std::string::npos)
        << brumeLastError();
}

TEST_F(HostTest, VolumeByACall_IsSeen) {
    const Context context(host().contextInfo());
    Scene scene = makeScene(context, kSpheresScene, "sorted");
    std::vector<float> values(9 * 9 * 9, 1.5f);
    const std::int32_t origin[3] = {0, 0, 0};
    auto density = init<BrumeDensity>();
    density.brickCount = 1;
    density.origins = origin;
    density.values = values.data();
    for (int i = 0; i < 3; ++i) density.worldFromIndex[5 * i] = 0.2;
    density.worldFromIndex[15] = 1;
    auto volume = init<BrumeVolume>();
    volume.medium = brumeFindMedium(scene.get(), "smoke");
    volume.density = &density;
    const auto render = [&] {
        host().draw({0.2f, 0.3f, 0.4f}, 0);
        host().frame(context.get(),
                     [&](VkCommandBuffer commands) { scene.cmdRender(commands, host().view()); });
        return host().read();
    };
    const std::vector<vec4> before = render();
    BrumeId id = 0;
    check(brumeAddVolume(scene.get(), &volume, &id));
    EXPECT_NE(render(), before);
    EXPECT_EQ(scene.counters().boxes, 1u);
    check(brumeRemove(scene.get(), id));
    EXPECT_EQ(render(), before);
    const std::int32_t crooked[3] = {0, 3, 0};
    density.origins = crooked;
    EXPECT_EQ(brumeAddVolume(scene.get(), &volume, nullptr), BRUME_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace brume::test
