// SPDX-License-Identifier: Apache-2.0
// Stochastic transparency against the enumeration of all its masks, and against the reference.
#include <oit/layer_scenes.hpp>

#include <array>
#include <bit>
#include <fmt/format.h>

namespace brume::test {
namespace {

constexpr int kSamples = 4;
/// Of about a hundred comparisons in this file none may fail by chance: p = 7e-6 each.
constexpr double kLevel = 4.5;

struct FlatLayer {
    double alpha;
    dvec3 color;
};

/// Layers front to back before a background.
struct Example {
    std::vector<FlatLayer> layers;
    dvec3 background;
};

const Example kTwoLayers = {{{0.45, {1, 0, 0}}, {0.45, {0, 1, 0}}}, {0, 0, 1}};
const Example kFourLayers = {{4, FlatLayer{0.25, dvec3(1)}}, dvec3(0.25)};
const Example kBias = {{{0.25, {1, 0, 0}}, {0.25, {0, 1, 0}}}, dvec3(0)};

/// Probability of each mask of four samples.
std::array<double, 16> enumerateMasks(double alpha, bool isNaive) {
    static constexpr int kChoose[] = {1, 4, 6, 4, 1};
    std::array<double, 16> probability{};
    const double scaled = alpha * kSamples, low = std::floor(scaled);
    for (unsigned mask = 0; mask < 16; ++mask) {
        const int count = std::popcount(mask);
        if (isNaive)
            probability[mask] = std::pow(alpha, count) * std::pow(1 - alpha, kSamples - count);
        else if (count == low)
            probability[mask] = (low + 1 - scaled) / kChoose[count];
        else if (count == low + 1)
            probability[mask] = (scaled - low) / kChoose[count];
    }
    return probability;
}

/// What a pixel shows for these masks of its layers, front to back.
dvec3 estimate(const Example& example, const std::vector<unsigned>& masks, const std::string& how) {
    dvec3 sum(0);
    double weight = 0, total = 1;
    unsigned covered = 0;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        const FlatLayer& layer = example.layers[i];
        total *= 1 - layer.alpha;
        const bool onlyWinners = how == "basic" || how == "alpha";
        const double seen =
            std::popcount((onlyWinners ? masks[i] : 15u) & ~covered & 15u) / double(kSamples);
        const double w = onlyWinners ? seen : seen * layer.alpha;
        sum += w * layer.color;
        weight += w;
        covered |= masks[i];
    }
    if (how == "basic") return sum + (1 - weight) * example.background;
    if (how == "depth") return sum + total * example.background;
    return (weight > 0 ? sum * ((1 - total) / weight) : dvec3(0)) + total * example.background;
}

/// Moments of a pixel's value and of its squared error, over all masks.
struct Moments {
    dvec3 mean{0}, variance{0}, squaredError{0}, squaredErrorVariance{0};
};

dvec3 computeTruth(const Example& example) {
    dvec3 result = example.background;
    for (std::size_t i = example.layers.size(); i-- > 0;)
        result = glm::mix(result, example.layers[i].color, example.layers[i].alpha);
    return result;
}

Moments enumerate(const Example& example, const std::string& how, bool isNaive) {
    const dvec3 truth = computeTruth(example);
    dvec3 first(0), second(0), error2(0), error4(0);
    std::vector<unsigned> masks(example.layers.size());
    const auto visit = [&](auto&& self, std::size_t layer, double p) -> void {
        if (p == 0) return;
        if (layer == masks.size()) {
            const dvec3 value = estimate(example, masks, how), e = value - truth;
            first += p * value;
            second += p * value * value;
            error2 += p * e * e;
            error4 += p * e * e * e * e;
            return;
        }
        const auto probability = enumerateMasks(example.layers[layer].alpha, isNaive);
        for (unsigned mask = 0; mask < 16; ++mask) {
            masks[layer] = mask;
            self(self, layer + 1, p * probability[mask]);
        }
    };
    visit(visit, 0, 1);
    return {first, second - first * first, error2, error4 - error2 * error2};
}

class Stochastic : public FamilyTest {
  protected:
    static PaneScene makeScene(const Example& example, int size) {
        PaneScene s(size, example.background);
        for (std::size_t i = example.layers.size(); i-- > 0;)
            s.addPanes(makeGlowing(example.layers[i].alpha, example.layers[i].color),
                       std::vector{1.0 + 0.1 * double(i)});
        return s;
    }

    /// z-test of mean and mean squared error of the device's pixels against the enumeration.
    void expectEnumerated(const Example& example, const std::string& how,
                          const std::string& mask = "stratified") {
        SCOPED_TRACE(how + " " + mask);
        const Moments expected = enumerate(example, how, mask == "naive");
        const dvec3 truth = computeTruth(example);
        const Image image = renderWith(makeScene(example, 64), "stochastic",
                                       {{"estimator", how}, {"mask", mask}});
        const auto count = static_cast<double>(image.pixels.size());
        dvec3 mean(0), error2(0);
        for (const vec3& pixel : image.pixels) {
            mean += dvec3(pixel) / count;
            error2 += (dvec3(pixel) - truth) * (dvec3(pixel) - truth) / count;
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c], expected.mean[c],
                        kLevel * std::sqrt(std::max(expected.variance[c], 0.0) / count) + 1e-5);
            EXPECT_NEAR(
                error2[c], expected.squaredError[c],
                kLevel * std::sqrt(std::max(expected.squaredErrorVariance[c], 0.0) / count) + 1e-6);
        }
    }
};

/// The enumeration itself, against figures printed elsewhere.
TEST(StochasticEnumeration, Examples_HaveTheirKnownMeansAndErrors) {
    const auto expectRow = [](const Example& example, const std::string& how, bool isNaive,
                              const dvec3& mean, const dvec3& rms) {
        const Moments m = enumerate(example, how, isNaive);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(m.mean[c], mean[c], 6e-5) << how;
            EXPECT_NEAR(std::sqrt(m.squaredError[c]), rms[c], 6e-5) << how;
        }
    };
    const dvec3 truth(0.45, 0.2475, 0.3025);
    expectRow(kTwoLayers, "basic", false, truth, {0.1, 0.1548, 0.1580});
    expectRow(kTwoLayers, "basic", true, truth, {0.2487, 0.2158, 0.2297});
    expectRow(kTwoLayers, "alpha", false, {0.4669, 0.2306, 0.3025}, {0.1348, 0.1348, 0});
    expectRow(kTwoLayers, "depth", false, truth, {0, 0.0450, 0});
    expectRow(kTwoLayers, "depth_alpha", false, {0.4517, 0.2458, 0.3025}, {0.0266, 0.0266, 0});
    expectRow(kFourLayers, "basic", false, dvec3(0.7627), dvec3(0.1206));
    expectRow(kFourLayers, "basic", true, dvec3(0.7627), dvec3(0.1744));
    expectRow(kFourLayers, "depth", false, dvec3(0.7627), dvec3(0.0562));
    expectRow(kFourLayers, "depth_alpha", false, dvec3(0.7627), dvec3(0));
    const Moments bias = enumerate(kBias, "alpha", false);
    EXPECT_NEAR(bias.mean.x, 0.2734, 6e-5);
    EXPECT_NEAR(bias.mean.y, 0.1641, 6e-5);
}

TEST_F(Stochastic, TwoLayers_MatchTheEnumeration) {
    for (const char* how : {"basic", "alpha", "depth", "depth_alpha"})
        expectEnumerated(kTwoLayers, how);
    expectEnumerated(kTwoLayers, "basic", "naive");
}

TEST_F(Stochastic, FourFaintLayers_MatchTheEnumeration) {
    for (const char* how : {"basic", "depth", "depth_alpha"}) expectEnumerated(kFourLayers, how);
    expectEnumerated(kFourLayers, "basic", "naive");
}

TEST_F(Stochastic, BiasOfAlphaCorrection_MatchesTheEnumeration) {
    expectEnumerated(kBias, "alpha");
    expectEnumerated(kBias, "depth_alpha");
}

TEST_F(Stochastic, AlphaBelowAnyTable_IsNotLost) {
    const double alpha = 1.0 / 5000;
    const Example faint = {{{alpha, dvec3(1)}}, dvec3(0)};
    const Image image =
        renderWith(makeScene(faint, 256), "stochastic", {{"estimator", "basic"}});
    // A pixel shows 1/4 with probability 4 alpha.
    const double deviation = std::sqrt(4 * alpha) / 4 / 256;
    EXPECT_NEAR(computeMean(image).x, alpha, kLevel * deviation);
    EXPECT_GT(computeMean(image).x, 0);
}

TEST_F(Stochastic, EverySampleCount_IsUnbiased) {
    for (const char* samples : {"1", "2", "8", "32", "64"}) {
        const Image image = renderWith(makeScene(kTwoLayers, 64), "stochastic",
                                       {{"estimator", "basic"}, {"samples", samples}});
        const dvec3 mean = computeMean(image), truth = computeTruth(kTwoLayers);
        // Stratified samples vary less than coins.
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean[c], truth[c],
                        kLevel * std::sqrt(truth[c] * (1 - truth[c]) / std::stod(samples)) / 64)
                << samples << " samples";
    }
}

TEST_F(Stochastic, OverlappingSmoke_IsUnbiased) {
    const TestScene s = makeSmoke(32, 10);
    const Image truth = renderReferenceOf(s);
    for (const char* how : {"basic", "depth"}) expectUnbiased(s, {{"estimator", how}}, truth, 1e-5);
}

TEST_F(Stochastic, ErrorOnSmoke_FallsWithTheSamples) {
    TestScene s = makeSmoke(32, 10);
    s.scene.meshes.clear();  // whose edges differ between rasteriser and ray caster
    const Image expected = renderReferenceOf(s);
    for (const char* how : {"basic", "depth_alpha"}) {
        const auto measureError = [&](const char* samples) {
            return computeRmse(
                renderWith(s, "stochastic", {{"estimator", how}, {"samples", samples}}), expected);
        };
        const double few = measureError("4"), many = measureError("64");
        for (const char* samples : {"8", "16", "32"})
            RecordProperty(std::string(how) + samples,
                           fmt::format("{:.3e}", measureError(samples)));
        // Independent samples give -1/2, strata of one layer -1.
        const double slope = std::log(many / few) / std::log(16.0);
        RecordProperty(how, fmt::format("{:.3e} {:.3e} slope {:.2f}", few, many, slope));
        EXPECT_LE(slope, -0.4) << how;
        EXPECT_GE(slope, -1.1) << how;
    }
}

TEST_F(Stochastic, Supersamples_ShareOneMask) {
    // Four places with four samples each are as good as one place with a mask of sixteen.
    const auto measureError = [&](int supersample, const char* samples) {
        PaneScene s = makeScene(kTwoLayers, 48);
        s.scene.image.supersample = supersample;
        const Image image =
            renderWith(s, "stochastic", {{"estimator", "basic"}, {"samples", samples}});
        Image truth = image;
        std::fill(truth.pixels.begin(), truth.pixels.end(), vec3(computeTruth(kTwoLayers)));
        return computeRmse(image, truth);
    };
    const double four = measureError(1, "4"), sixteen = measureError(1, "16"),
                 shared = measureError(2, "4");
    RecordProperty("rmse", fmt::format("{:.3e} {:.3e} {:.3e}", four, sixteen, shared));
    EXPECT_NEAR(shared, sixteen, 0.1 * sixteen);
    EXPECT_LT(shared, 0.45 * four) << "four masks of their own would give a half";
}

TEST_F(Stochastic, Adaptive_ReachesTheErrorAskedForWithFewerSamples) {
    TestScene s = makeSmoke(32, 10);
    s.scene.meshes.clear();
    const Image expected = renderReferenceOf(s);
    for (const char* how : {"basic", "depth_alpha"}) {
        for (const double error : {0.02, 0.01}) {
            const render::Result result = render(
                s, {.method = "stochastic",
                    .settings = {{"estimator", how}, {"error", fmt::format("{}", error)}}});
            const double rmse = computeRmse(result.image, expected);
            const double taken = static_cast<double>(result.counters.at("samplesTaken")) / 1024;
            RecordProperty(fmt::format("{}_{}", how, error),
                           fmt::format("rmse {:.3e}, {:.0f} samples, {} above", rmse, taken,
                                       result.counters.at("pixelsAboveError")));
            EXPECT_LE(rmse, error) << how;
            EXPECT_LE(taken, 128) << how << ": half of what all would take";
        }
    }
}

TEST_F(Stochastic, Adaptive_TakesSamplesWhereTheNoiseIs) {
    // The left half is empty, the right one has layers that hide each other.
    PaneScene s = makeScene(kTwoLayers, 32);
    for (scene::Mesh& mesh : s.scene.meshes)
        for (vec3& position : mesh.positions) position.x = std::max(position.x, 0.0f);
    const render::Result result = render(
        s, {.method = "stochastic",
            .settings = {{"estimator", "basic"}, {"error", "0.001"}, {"samples", "64"}}});
    // Sixteen to a pass; empty pixels end after two.
    EXPECT_NEAR(static_cast<double>(result.counters.at("samplesTaken")), 512 * (32 + 64), 512 * 4);
    EXPECT_GT(result.counters.at("pixelsAboveError"), 400u);
}

TEST_F(Stochastic, Filter_TakesNoiseOutAndLeavesTheBackgroundSharp) {
    TestScene s = makeSmoke(64, 10);
    s.scene.meshes.clear();
    const Image expected = renderReferenceOf(s);
    const auto measureError = [&](const char* filter) {
        return computeRmse(renderWith(s, "stochastic", {{"samples", "4"}, {"filter", filter}}),
                           expected);
    };
    const double plain = measureError("0"), filtered = measureError("2");
    RecordProperty("rmse", fmt::format("{:.3e} {:.3e}", plain, filtered));
    EXPECT_LE(filtered, 0.75 * plain);
}

TEST_F(Stochastic, SettingsThatContradict_AreRefused) {
    const TestScene s = makeSmoke(8, 2);
    EXPECT_THROW(renderWith(s, "stochastic", {{"estimator", "basic"}, {"filter", "2"}}), Error);
    EXPECT_THROW(renderWith(s, "stochastic", {{"error", "0.01"}, {"samples", "16"}}), Error);
}

TEST_F(Stochastic, SeedPrimitive_KeepsTheNoiseOfWhatMoves) {
    const auto renderAt = [&](double distance, const char* seed) {
        PaneScene s(16, dvec3(0));
        s.addPanes(makeGlowing(0.4, dvec3(1)), std::vector{distance});
        return renderWith(s, "stochastic", {{"estimator", "basic"}, {"seed", seed}});
    };
    EXPECT_EQ(computeRmse(renderAt(1, "primitive"), renderAt(1.37, "primitive")), 0);
    EXPECT_EQ(computeRmse(renderAt(1, "object"), renderAt(1.37, "object")), 0);
    EXPECT_GT(computeRmse(renderAt(1, "depth"), renderAt(1.37, "depth")), 0.1);
}

TEST_F(Stochastic, SeedObject_LetsItsOwnLayersHideEachOther) {
    const std::vector<double> distances = {1, 1.2};
    PaneScene s(32, dvec3(0));
    s.addPanes(makeGlowing(0.5, dvec3(1)), distances);
    const auto meanWith = [&](const char* seed) {
        return computeMean(
                   renderWith(s, "stochastic", {{"estimator", "basic"}, {"seed", seed}}))
            .x;
    };
    EXPECT_NEAR(meanWith("object"), 0.5, 0.01) << "equal masks: the second layer adds nothing";
    EXPECT_NEAR(meanWith("primitive"), 0.75, 0.03);
}

TEST_F(Stochastic, MixedScene_ComesCloseWithManySamples) {
    const TestScene s = makeMixedScene(32);
    const double rmse =
        computeRmse(renderWith(s, "stochastic", {{"samples", "64"}}), renderReferenceOf(s));
    RecordProperty("rmse", fmt::format("{:.3e}", rmse));
    EXPECT_LE(rmse, 0.025);
}

}  // namespace
}  // namespace brume::test
