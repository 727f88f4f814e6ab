// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <oit/stochastic_settings.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace brume::oit::stochastic {
namespace {

/// Two passes of 16 are the fewest that have a variance.
constexpr std::uint32_t kLeastAdaptive = 32;

template <std::size_t N>
std::uint32_t indexOf(const std::string& word, const char* const (&words)[N]) {
    return static_cast<std::uint32_t>(std::find(words, words + N, word) - words);
}

}  // namespace

Settings readSettings(const scene::Settings& given) {
    scene::SettingsReader reader(given, "setting up method stochastic");
    Settings s;
    s.error = static_cast<float>(reader.number("error", 0, 0, 1));
    s.samples = static_cast<std::uint32_t>(
        std::stoul(reader.choice("samples", s.isAdaptive() ? "256" : "4",
                                 {"1", "2", "4", "8", "16", "32", "64", "128", "256", "512",
                                  "1024"})));
    s.isNaive = reader.choice("mask", "stratified", {"naive", "stratified"}) == "naive";
    // In the order of kEstimator... and kSeed...
    static constexpr const char* kEstimators[] = {"basic", "alpha", "depth", "depth_alpha"};
    static constexpr const char* kSeeds[] = {"primitive", "object", "depth"};
    s.estimator = indexOf(
        reader.choice("estimator", "depth_alpha", {"basic", "alpha", "depth", "depth_alpha"}),
        kEstimators);
    s.seed = indexOf(reader.choice("seed", "primitive", {"primitive", "object", "depth"}), kSeeds);
    s.pattern = static_cast<std::uint32_t>(reader.integer("pattern", 0, 0, 0xffffffffll));
    s.filter = static_cast<std::uint32_t>(reader.integer("filter", 0, 0, 16));
    reader.finish();
    if (s.filter > 0 && s.estimator == shader::kEstimatorBasic)
        throw inputError("setting up method stochastic", "estimator 'basic'",
                         "cannot be filtered: its background is noise too; take depth_alpha");
    if (s.isAdaptive() && s.samples < kLeastAdaptive)
        throw inputError("setting up method stochastic",
                         fmt::format("samples {}", s.samples),
                         fmt::format("with 'error' they are the most that a pixel gets: at least {}",
                                     kLeastAdaptive));
    return s;
}

const MethodInfo& info() {
    static const MethodInfo kInfo{
        .name = "stochastic",
        .summary = "Each layer stops light in a random set of samples; right in expectation, also "
                   "where media overlap.",
        .paper = "Enderton, Sintorn, Shirley, Luebke: Stochastic Transparency, 2011",
        .exactness = Exactness::Approximate,
        .passes = "2 raster per 16 samples (8 with colours) + 1 resolve",
        .bytesPerPixel = "34 + 4 S, S <= 16 samples in a pass; 50 + 12 S, S <= 8 with colours; "
                         "adaptive: 50 more, 66 with colours; filter: 14 more",
        .limits = "noise; bricks and boxes count as homogeneous inside",
        .weaknesses = {Weakness::Noise, Weakness::Profile, Weakness::Emission},
        .settings = {{"samples", "1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024", "4",
                      "per pixel; with an error at most, and 256 if not given"},
                     {"error", "0..1", "0",
                      "standard error (relative above 1) that ends a pixel; 0: all get all samples"},
                     {"filter", "0..16 pixels", "0",
                      "radius of a cross-bilateral filter against noise"},
                     {"mask", "naive, stratified", "stratified",
                      "samples chosen each by itself, or as even shares"},
                     {"estimator", "basic, alpha, depth, depth_alpha", "depth_alpha",
                      "basic and depth are unbiased, *alpha corrects the total"},
                     {"seed", "primitive, object, depth", "primitive", "what the noise sticks to"},
                     {"pattern", "0..4294967295", "0", "which noise"}}};
    return kInfo;
}

}  // namespace brume::oit::stochastic
