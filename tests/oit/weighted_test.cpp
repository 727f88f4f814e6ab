// SPDX-License-Identifier: Apache-2.0
// Weighted sums: exact where the paper says so, close elsewhere, and never overflowing.
#include <oit/layer_scenes.hpp>

#include <algorithm>
#include <fmt/format.h>

namespace brume::test {
namespace {

class Weighted : public FamilyTest {};

std::vector<double> makeDistances(int count, double from, double to) {
    std::vector<double> distances;
    for (int i = 0; i < count; ++i) distances.push_back(from + (to - from) * i / count);
    return distances;
}

TEST_F(Weighted, TwoThousandFaintLayers_LetThroughTheirProduct) {
    std::vector<double> distances = makeDistances(2000, 1, 3);
    const double expected = std::pow(1 - 0.001, 2000);
    std::vector<double> largest;
    for (const char* precision : {"packed", "half", "single", "exact"}) {
        double worst = 0;
        for (int order = 0; order < 3; ++order) {
            PaneScene s(4);
            if (order == 1) std::reverse(distances.begin(), distances.end());
            if (order == 2) std::shuffle(distances.begin(), distances.end(), std::mt19937(3));
            s.addPanes(makeThin(0.001, dvec3(0)), distances);
            const Image image = renderWith(s, "weighted", {{"precision", precision}});
            for (const vec3& pixel : image.pixels)
                worst = std::max(worst, std::abs(pixel.x - expected));
        }
        RecordProperty(precision, fmt::format("{:.2e}", worst));
        largest.push_back(worst);
    }
    EXPECT_GT(largest[0], 0.5) << "the paper's 8 bits are expected to show nothing of such layers";
    EXPECT_GT(largest[1], 1e-3) << "half precision is expected to lose faint layers";
    EXPECT_LE(largest[2], 2e-4);
    EXPECT_LE(largest[3], 1e-6);
}

TEST_F(Weighted, ColouredLayers_LetThroughTheirProductInEachChannel) {
    PaneScene s(4, dvec3(1, 2, 3));
    Random random(7);
    dvec3 expected(1, 2, 3);
    for (int i = 0; i < 40; ++i) {
        const double alpha = random.uniform(0, 0.4), distance = random.uniform(1, 3);
        const dvec3 t = random.vector();
        s.addPanes(makeThin(alpha, t), std::vector{distance});
        expected *= 1.0 - alpha + alpha * t;
    }
    for (const vec3& pixel : renderWith(s, "weighted", {{"precision", "exact"}}).pixels)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1e-6);
}

TEST_F(Weighted, TenThousandHdrLayersFromNearToFar_StayFinite) {
    std::vector<double> distances;
    for (int i = 0; i < 10'000; ++i) distances.push_back(1e-3 * std::pow(1e9, i / 10'000.0));
    for (const char* precision : {"packed", "half", "single", "exact"}) {
        PaneScene s(2);
        s.scene.camera.near = 1e-3;
        s.scene.camera.type = scene::CameraType::Perspective;
        scene::Material material = makeGlowing(0.01, dvec3(1e4));
        s.addPanes(material, distances);
        for (vec3& p : s.scene.meshes[0].positions) p = vec3(p.x * p.z, p.y * p.z, p.z);
        for (const vec3& pixel : renderWith(s, "weighted", {{"precision", precision}}).pixels) {
            EXPECT_TRUE(std::isfinite(pixel.x)) << precision;
            EXPECT_LE(pixel.x, 1.02e4) << precision;
            if (std::string(precision) == "single" || std::string(precision) == "exact") {
                EXPECT_GE(pixel.x, 0.98e4) << precision;
            }
        }
    }
}

TEST_F(Weighted, OneLayerOfAnyKind_IsExact) {
    const auto check = [&](const char* name, const auto& add) {
        SCOPED_TRACE(name);
        TestScene s(24, 24);
        s.addDaylight();
        add(s);
        const Image expected = renderReferenceOf(s), actual = renderWith(s, "weighted");
        EXPECT_LE(computeRmse(actual, expected), 1e-5);
    };
    const dvec3 red(0.3, 1, 2);
    check("smooth sphere", [&](TestScene& s) {
        s.addSphere(s.addMedium(red, dvec3(0.5, 0.9, 0.1)), dvec3(0), 1, scene::Profile::Smooth);
    });
    check("glow without absorption", [&](TestScene& s) {
        s.addSphere(s.addMedium(dvec3(0), dvec3(0), red), dvec3(0), 1);
    });
    check("box", [&](TestScene& s) {
        s.addBox(s.addMedium(red, dvec3(0.5)), dvec3(-1, -0.5, -0.3), dvec3(0.5, 1, 0.9));
    });
    check("pane", [&](TestScene& s) {
        s.addPane(s.addMaterial(makeThin(0.7, dvec3(0.9, 0.5, 0), dvec3(0.3))), 0.2, 4);
    });
    check("solid", [&](TestScene& s) {
        s.addMesh(scene::makeSphere(6, 24), s.addMaterial(makeSolid(0.1 * red, 0.1 * red)));
    });
}

TEST_F(Weighted, MixedScene_IsCloserThanUnordered) {
    const TestScene s = makeMixedScene(48);
    const Image expected = renderReferenceOf(s);
    const double weighted = computeRmse(renderWith(s, "weighted"), expected);
    const double unordered = computeRmse(renderWith(s, "unordered"), expected);
    RecordProperty("rmse", fmt::format("weighted {:.3e} unordered {:.3e}", weighted, unordered));
    EXPECT_LE(weighted, 0.06);
    EXPECT_LT(weighted, 0.6 * unordered);
}

TEST_F(Weighted, Targets_AreOnlyWhatTheSceneNeeds) {
    PaneScene grey(16), red(16);
    const std::vector<double> one = {1};
    grey.addPanes(makeThin(0.5, dvec3(0)), one);
    red.addPanes(makeThin(1, dvec3(1, 0.2, 0.1)), one);
    const auto bits = [&](const TestScene& s, const scene::Settings& settings) {
        return countTargetBits(s, "weighted", settings, "oit.weighted");
    };
    EXPECT_EQ(bits(grey, {{"precision", "packed"}}), 72);
    EXPECT_EQ(bits(grey, {{"precision", "half"}}), 80);
    EXPECT_EQ(bits(grey, {}), 160 + 16) << "16 for which pixels are touched";
    EXPECT_EQ(bits(grey, {{"precision", "exact"}}), 192 + 16);
    // Colours, diffusion and refraction: all of the model.
    EXPECT_EQ(bits(red, {{"precision", "packed"}, {"refraction", "true"}}),
              device().canBlend(VK_FORMAT_R8G8_SNORM) ? 112 : 128);
    EXPECT_EQ(bits(red, {{"precision", "half"}}), 128);
    EXPECT_EQ(bits(red, {{"precision", "half"}, {"refraction", "true"}}), 192);
    EXPECT_EQ(bits(red, {{"precision", "exact"}}), 384 + 16);
}

/// A pane of the given collimation, and `gap` behind it an opaque plane that is bright on the right.
PaneScene makeFrosted(double collimation, double gap) {
    PaneScene s(64, dvec3(0));
    scene::Material frosted = makeThin(1, dvec3(1));
    frosted.collimation = collimation;
    s.addPanes(frosted, std::vector{1.0});
    s.addPanes(makeOpaque(dvec3(0), dvec3(1)), std::vector{1 + gap});
    for (vec3& p : s.scene.meshes[1].positions) p.x = std::max(p.x, 0.f);
    s.addPanes(makeOpaque(dvec3(0), dvec3(0)), std::vector{1 + gap});
    for (vec3& p : s.scene.meshes[2].positions) p.x = std::min(p.x, 0.f);
    return s;
}

/// Standard deviation in pixels of the step along the middle row.
double measureEdge(const Image& image) {
    double sum = 0, mean = 0, square = 0;
    for (int x = 0; x + 1 < image.width; ++x) {
        const double step = image.at(x + 1, image.height / 2).x - image.at(x, image.height / 2).x;
        sum += step;
        mean += step * x;
        square += step * x * x;
    }
    return std::sqrt(std::max(square / sum - mean * mean / (sum * sum), 0.0));
}

TEST_F(Weighted, Diffusion_GrowsWithTheGapBehindThePane) {
    const scene::Settings settings = {{"diffusionWidth", "0.15"}, {"diffusionTaps", "0"}};
    EXPECT_LT(measureEdge(renderWith(makeFrosted(1, 1), "weighted", settings)), 0.01);
    double last = measureEdge(renderWith(makeFrosted(0, 1e-3), "weighted", settings));
    EXPECT_LT(last, 0.3) << "an object that touches the pane";
    for (const double gap : {0.1, 0.5, 5.0}) {
        // Eq. 7: 32 pixels per metre times the width times the reach; cut off at two deviations.
        const double deviation = 32 * 0.15 * (1 - 1 / (1 + gap / 0.5));
        const double edge = measureEdge(renderWith(makeFrosted(0, gap), "weighted", settings));
        EXPECT_GT(edge, last);
        EXPECT_NEAR(edge, 0.9 * deviation, 0.15 * deviation + 0.1) << "gap " << gap;
        last = edge;
    }
}

TEST_F(Weighted, SpiralGather_IsCloseToTheWholeDisk) {
    const PaneScene s = makeFrosted(0, 1);
    const auto gather = [&](const char* taps) {
        return renderWith(s, "weighted", {{"diffusionWidth", "0.15"}, {"diffusionTaps", taps}});
    };
    const Image disk = gather("0");
    const double few = computeRmse(gather("24"), disk), many = computeRmse(gather("256"), disk);
    RecordProperty("rmse", fmt::format("24 taps {:.3e} 256 taps {:.3e}", few, many));
    EXPECT_LE(few, 0.03);
    EXPECT_LE(many, 0.01);
}

/// Panes of the given index of refraction, tilted, before a ramp of radiance.
PaneScene makeRefracting(double ior, int count) {
    PaneScene s(32, dvec3(0));
    scene::Material pane = makeThin(1, dvec3(1));
    pane.ior = ior;
    const std::uint32_t material = s.addMaterial(pane);
    for (int i = 0; i < count; ++i)
        s.addMesh(scene::makePlane(dvec2(9)), material,
                  translation(dvec3(0, 0, 4 + 0.1 * i)) *
                      glm::rotate(dmat4(1), radians(-60), dvec3(1, 0, 0)));
    // Horizontal stripes of growing radiance.
    for (int i = 0; i < 16; ++i) {
        s.addPanes(makeOpaque(dvec3(0), dvec3(i / 16.0)), std::vector{12.0});
        for (vec3& p : s.scene.meshes.back().positions)
            p.y = static_cast<float>(-1 + (i + (p.y > 0 ? 1 : 0)) / 8.0);
    }
    return s;
}

TEST_F(Weighted, Refraction_FollowsSnellAndDoesNotPileUp) {
    const scene::Settings on = {{"refraction", "true"}};
    const Image plain = renderWith(makeRefracting(1.5, 1), "weighted");
    const Image matched = renderWith(makeRefracting(1, 1), "weighted", on);
    const Image bent = renderWith(makeRefracting(1.5, 1), "weighted", on);
    const Image twice = renderWith(makeRefracting(1.5, 2), "weighted", on);
    EXPECT_EQ(computeRmse(matched, plain), 0) << "equal indices bend nothing";
    EXPECT_LE(computeRmse(twice, bent), 1e-6) << "offsets are averaged";
    // Incidence of 30 degrees: bent towards the normal by 30 - asin(sin 30 / 1.5) = 10.53 degrees;
    // over 2 m of depth 0.372 m, 5.95 pixels of 1/16 m.
    const int shift = 6;
    double same = 0, flipped = 0;
    for (int y = shift; y < 32 - shift; ++y) {
        same += std::abs(bent.at(16, y).x - plain.at(16, y - shift).x);
        flipped += std::abs(bent.at(16, y).x - plain.at(16, y + shift).x);
    }
    EXPECT_LE(std::min(same, flipped) / 20, 1.0 / 16);
    EXPECT_GE(std::max(same, flipped) / 20, 4.0 / 16);
}

TEST_F(Weighted, LowResolution_KeepsEdgesBeforeOpaqueGeometry) {
    TestScene s = makeSmoke(64, 12);
    s.addMesh(scene::makeBox(dvec3(0.4, 1.2, 0.1)), s.addMaterial(makeOpaque(dvec3(0), dvec3(2))),
              translation(dvec3(0.1, 0, -0.75)));
    const Image full = renderWith(s, "weighted");
    for (const auto& [factor, bound] : {std::pair{"2", 0.012}, std::pair{"4", 0.03}}) {
        const Image low = renderWith(s, "weighted", {{"lowResolution", factor}});
        const double rmse = computeRmse(low, full);
        RecordProperty(std::string("rmse_") + factor, fmt::format("{:.3e}", rmse));
        EXPECT_LE(rmse, bound);
        // The column stands before the smoke: its edge neither darkens nor spreads.
        double worst = 0;
        for (int y = 20; y < 44; ++y)
            for (int x = 28; x < 42; ++x)
                worst = std::max<double>(worst, std::abs(low.at(x, y).x - full.at(x, y).x));
        EXPECT_LE(worst, 0.15) << factor;
    }
}

TEST_F(Weighted, PaperFormats_CostAccuracy) {
    const TestScene s = makeMixedScene(48);
    const Image single = renderWith(s, "weighted");
    const double packed = computeRmse(renderWith(s, "weighted", {{"precision", "packed"}}), single),
                 half = computeRmse(renderWith(s, "weighted", {{"precision", "half"}}), single);
    RecordProperty("rmse", fmt::format("packed {:.2e} half {:.2e}", packed, half));
    EXPECT_LE(packed, 1e-2);
    EXPECT_LE(half, 0.2 * packed);
}

/// Methods that blend with "over" have the same setting.
TEST_F(Weighted, LowResolutionOfOtherMethods_IsTheSame) {
    TestScene s = makeSmoke(64, 12);
    s.addPane(s.addMaterial(makeThin(0.6, dvec3(0), dvec3(0.2, 0.5, 0.8))), -1, 0.5);
    for (const char* method : {"unordered", "sorted"}) {
        const Image full = renderWith(s, method);
        const double half = computeRmse(renderWith(s, method, {{"lowResolution", "2"}}), full),
                     quarter = computeRmse(renderWith(s, method, {{"lowResolution", "4"}}), full);
        RecordProperty(method, fmt::format("{:.2e} {:.2e}", half, quarter));
        EXPECT_LE(half, 0.012) << method;
        EXPECT_LE(quarter, 0.03) << method;
        EXPECT_GT(half, 0) << method;
    }
}

TEST_F(Weighted, GlassBesideLowResolutionSmoke_StaysSharp) {
    TestScene s(64, 64);
    s.addDaylight();
    s.addPane(s.addMaterial(makeThin(1, dvec3(0.1, 0.9, 0.2), dvec3(0.1))), 0, 0.5);
    const Image full = renderWith(s, "weighted");
    s.addSphere(s.addMedium(1e-6), dvec3(0), 1);  // smoke that is hardly there
    EXPECT_LE(computeRmse(renderWith(s, "weighted", {{"lowResolution", "4"}}), full), 1e-5);
}

}  // namespace
}  // namespace brume::test
