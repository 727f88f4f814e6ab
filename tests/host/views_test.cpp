// SPDX-License-Identifier: Apache-2.0
// Views of hosts: projections, ranges of depth, viewports, parts of an image.
#include <host/host_fixture.hpp>

#include <cmath>

namespace brume::test {
namespace {

/// A camera that looks along -z at a sphere of constant density, half behind an opaque wall.
struct DepthCase {
    const char* name;
    double near, far;
    bool isReversed;
    bool isOrthographic;
    int x, y, width, height;  // viewport
    float minDepth, maxDepth;
};

/// Its name in lists of tests, the same in every run.
void PrintTo(const DepthCase& c, std::ostream* out) { *out << c.name; }

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
    Scene scene = makeSceneOfText(context, R"({ "version": 1,
        "media": { "ink": { "extinction": [0.8, 0.8, 0.8], "albedo": [0, 0, 0] } },
        "spheres": [ { "center": [0, 0, 0], "radius": 1.5, "medium": "ink", "density": 1 } ] })",
                                  "sorted");
    const int top = std::min(c.y, c.y + c.height), height = std::abs(c.height);
    const auto transmittanceWithWallAt = [&](double distance) {
        // Beyond the far plane: nothing opaque at all.
        host().draw(vec3(1), static_cast<float>(depthAt(view, distance)));
        const std::vector<vec4> pixels = host().render(context, scene, view);
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
    Scene scene = makeSceneOfText(context, kSpheresScene, "sorted");
    const auto renderWith = [&](bool isTurned) {
        BrumeView view = host().view();
        if (isTurned) view.y = view.height, view.height = -view.height;
        host().draw(kBackdrop, 0);
        return host().render(context, scene, view);
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

/// Its name in lists of tests, the same in every run.
void PrintTo(const PartCase& c, std::ostream* out) { *out << c.name; }

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
        Scene scene = makeSceneOfText(context, text.c_str(), method);
        Scene other = makeSceneOfText(context, text.c_str(), method);
        const auto renderWith = [&](Scene& used, const BrumeView& view) {
            host().draw(kBackdrop, 0);
            return host().render(context, used, view);
        };
        const std::vector<vec4> expected = renderWith(scene, whole), seen = renderWith(other, part);
        int wrong = 0, drawn = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const std::size_t x = i % 48, y = i / 48;
            const bool isInside = x >= 18 && x < 42 && y >= 4 && y < 20;
            const vec3 right = isInside ? vec3(expected[i]) : kBackdrop;
            const vec3 off = glm::abs(vec3(seen[i]) - right);
            drawn += isInside && glm::distance(right, kBackdrop) > 0.02f;
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

}  // namespace
}  // namespace brume::test
