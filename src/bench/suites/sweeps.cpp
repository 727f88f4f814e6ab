// SPDX-License-Identifier: Apache-2.0
// How time and error grow with the size of a thing, on logarithmic axes, with the fitted exponents.
#include <bench/suites/sweep.hpp>

#include <fmt/format.h>

#include <cmath>

namespace brume::bench {
namespace {

Sweep sweepParticles(bool isFull) {
    Sweep sweep{"particles", "spheres of 4 pixels radius", {"tile", "linked_list", "weighted"}, {}};
    const std::vector<int> counts =
        isFull ? std::vector<int>{1'000, 3'000, 10'000, 30'000, 100'000, 300'000, 1'000'000}
               : std::vector<int>{1'000, 4'000, 16'000};
    for (const int count : counts)
        sweep.stops.push_back({double(count), "spheres_" + formatCount(count) + "_4",
                               isFull ? ivec2(1280, 720) : ivec2(320, 180)});
    return sweep;
}

Sweep sweepLayers(bool isFull) {
    Sweep sweep{"layers", "full-screen layers", {"tile", "linked_list", "weighted", "moment"}, {}};
    const ivec2 size = isFull ? ivec2(640, 360) : ivec2(160, 90);
    for (int layers = 2; layers <= (isFull ? 256 : 64); layers *= isFull ? 2 : 4)
        sweep.stops.push_back(
            {double(layers), fmt::format("layers_{}_{}x{}", layers, size.x, size.y), size});
    return sweep;
}

Sweep sweepResolution(bool isFull) {
    Sweep sweep{"resolution", "pixels", {"tile", "linked_list", "weighted"}, {}};
    const std::vector<int> heights = isFull ? std::vector<int>{360, 720, 1080, 1440, 2160}
                                            : std::vector<int>{90, 180, 360};
    for (const int height : heights) {
        const ivec2 size(height * 16 / 9, height);
        sweep.stops.push_back({double(size.x) * size.y,
                               isFull ? "spheres_10k_15" : "spheres_1k_48", size});
    }
    return sweep;
}

Sweep sweepSamples(bool isFull) {
    Sweep sweep{"samples", "samples per pixel", {"stochastic"}, {}, {Figure::Ms, Figure::Rmse}};
    for (int samples = 1; samples <= (isFull ? 64 : 16); samples *= isFull ? 2 : 4)
        sweep.stops.push_back({double(samples), "mixed", isFull ? ivec2(640, 360) : ivec2(96, 54),
                               {}, {}, fmt::format(":samples={}", samples)});
    return sweep;
}

Sweep sweepShadowTexels(bool isFull) {
    Sweep sweep{"shadow texels", "texels per edge of the map", {"tile"}, {},
                {Figure::Ms, Figure::Rmse}};
    for (int texels = 64; texels <= (isFull ? 1024 : 256); texels *= 2)
        sweep.stops.push_back({double(texels), "smoke_and_glass",
                               isFull ? ivec2(320, 180) : ivec2(64, 36), "visibility",
                               {{"shadow.resolution", std::to_string(texels)},
                                {"shadow.opaqueResolution", std::to_string(texels)}}});
    return sweep;
}

Sweep sweepTolerance(bool isFull) {
    Sweep sweep{"tolerance", "tolerance of boxes for voxels, thousandths", {"tile"}, {},
                {Figure::Ms, Figure::Rmse}};
    for (int thousandths = 10; thousandths <= 640; thousandths *= isFull ? 2 : 4)
        sweep.stops.push_back({double(thousandths), fmt::format("boxes_{}", thousandths),
                               isFull ? ivec2(320, 180) : ivec2(96, 54), {}, {}, {}, "boxes_0"});
    return sweep;
}

Sweep sweepEpsilon(bool isFull) {
    Sweep sweep{"epsilon", "transmittance at which a pixel stops", {"tile"}, {},
                {Figure::Ms, Figure::Rmse}};
    for (int power = -4; power >= -16; power -= isFull ? 2 : 4)
        sweep.stops.push_back({std::exp2(power), isFull ? "mixed_10k_64" : "mixed_1k_64",
                               isFull ? ivec2(640, 360) : ivec2(160, 90), {}, {},
                               fmt::format(":epsilon={}", std::exp2(power))});
    return sweep;
}

std::vector<Sweep> makeSweeps(Scale scale) {
    const bool isFull = scale == Scale::Full;
    return {sweepParticles(isFull),    sweepLayers(isFull),    sweepResolution(isFull),
            sweepSamples(isFull),      sweepShadowTexels(isFull), sweepTolerance(isFull),
            sweepEpsilon(isFull)};
}

std::vector<Plan> plan(Scale scale) { return planSweeps(makeSweeps(scale)); }

Findings read(std::span<const Measurement> rows, Scale scale) {
    return readSweeps(makeSweeps(scale), rows);
}

}  // namespace

extern const Suite kSweepsSuite = {"sweeps", "time and error by particles, layers, pixels, samples, "
                                             "shadow texels, tolerance and epsilon",
                                   &plan, &read};

}  // namespace brume::bench
