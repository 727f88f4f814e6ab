// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bench/flip.hpp>
#include <cmath>
#include <core/assert.hpp>

namespace brume::bench {
namespace {

// Constants of the paper: exponents q_c and q_f, redistribution p_c and p_t, detector width w in
// degrees.
constexpr double kColorExponent = 0.7;
constexpr double kFeatureExponent = 0.5;
constexpr double kRedistributionKnee = 0.4;
constexpr double kRedistributionValue = 0.95;
constexpr double kDetectorWidth = 0.082;

/// One channel's contrast sensitivity: a1, b1, a2, b2 of the paper's table 1 (no second term: a2 =
/// 0).
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivities = {{
    {1, 0.0047, 0, 1e-5},      // achromatic
    {1, 0.0053, 0, 1e-5},      // red-green
    {34.1, 0.04, 13.5, 0.025}  // blue-yellow
}};

/// CIE XYZ from linear sRGB with white point D65, and its white.
const dmat3 kXyzFromRgb =
    glm::transpose(dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,
                         2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,
                         1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
const dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const dvec3 kWhite = kXyzFromRgb * dvec3(1);

dvec3 opponentFromRgb(const dvec3& rgb) {
    const dvec3 xyz = kXyzFromRgb * rgb / kWhite;
    return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

dvec3 rgbFromOpponent(const dvec3& yCxCz) {
    const double y = (yCxCz.x + 16) / 116;
    return kRgbFromXyz * (kWhite * dvec3(yCxCz.y / 500 + y, y, y - yCxCz.z / 200));
}

double labCurve(double x) {
    constexpr double kDelta = 6.0 / 29;
    return x > kDelta * kDelta * kDelta ? std::cbrt(x) : x / (3 * kDelta * kDelta) + 4.0 / 29;
}

/// L*a*b* with the Hunt effect: colourfulness grows with luminance.
dvec3 huntLabFromRgb(const dvec3& rgb) {
    const dvec3 xyz = kXyzFromRgb * rgb / kWhite;
    const double x = labCurve(xyz.x), y = labCurve(xyz.y), z = labCurve(xyz.z);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double hyab(const dvec3& a, const dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

using Kernel = std::vector<float>;  // odd length, centred

/// One channel of an image.
struct Plane {
    int width, height;
    std::vector<float> values;

    Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h) {}
    float* row(int y) { return values.data() + static_cast<std::size_t>(y) * width; }
    const float* row(int y) const { return values.data() + static_cast<std::size_t>(y) * width; }
};

/// Convolves the rows; pixels beyond the border repeat it.
Plane convolveRows(const Plane& in, const Kernel& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane out(in.width, in.height);
    std::vector<float> padded(in.width + 2 * radius);
    for (int y = 0; y < in.height; ++y) {
        const float* source = in.row(y);
        for (int x = 0; x < in.width + 2 * radius; ++x)
            padded[x] = source[std::clamp(x - radius, 0, in.width - 1)];
        float* target = out.row(y);
        for (std::size_t tap = 0; tap < kernel.size(); ++tap)
            for (int x = 0; x < in.width; ++x) target[x] += kernel[tap] * padded[x + tap];
    }
    return out;
}

Plane convolveColumns(const Plane& in, const Kernel& kernel) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane out(in.width, in.height);
    for (int y = 0; y < in.height; ++y) {
        float* target = out.row(y);
        for (int tap = -radius; tap <= radius; ++tap) {
            const float* source = in.row(std::clamp(y + tap, 0, in.height - 1));
            const float weight = kernel[tap + radius];
            for (int x = 0; x < in.width; ++x) target[x] += weight * source[x];
        }
    }
    return out;
}

/// exp(-pi^2 d^2 / b) at d = x / pixelsPerDegree for x in [-radius, radius]; returns its sum.
double sampleGaussian(double b, double pixelsPerDegree, int radius, std::vector<double>& weights) {
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) {
        const double d = x / pixelsPerDegree;
        weights.push_back(std::exp(-kPi * kPi * d * d / b));
        sum += weights.back();
    }
    return sum;
}

/// Adds `share` times the plane blurred by the normalised kernel to `sum`.
void addBlurred(const Plane& in, const std::vector<double>& weights, double total, double share,
                Plane& sum) {
    Kernel kernel;
    for (double w : weights) kernel.push_back(static_cast<float>(w / total));
    const Plane blurred = convolveColumns(convolveRows(in, kernel), kernel);
    for (std::size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] += static_cast<float>(share) * blurred.values[i];
}

/// The filter a1 sqrt(pi/b1) exp(-pi^2 z/b1) + a2 sqrt(pi/b2) exp(-pi^2 z/b2), normalised to sum 1.
Plane filterByContrastSensitivity(const Plane& in, const Sensitivity& s, double pixelsPerDegree) {
    constexpr double kWidest = 0.04;  // the largest b of all channels sets the radius of all
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixelsPerDegree));
    std::vector<double> first, second;
    const double sum1 = sampleGaussian(s.b1, pixelsPerDegree, radius, first);
    const double sum2 = sampleGaussian(s.b2, pixelsPerDegree, radius, second);
    const double weight1 = s.a1 * std::sqrt(kPi / s.b1) * sum1 * sum1;
    const double weight2 = s.a2 * std::sqrt(kPi / s.b2) * sum2 * sum2;
    Plane out(in.width, in.height);
    addBlurred(in, first, sum1, weight1 / (weight1 + weight2), out);
    if (weight2 > 0) addBlurred(in, second, sum2, weight2 / (weight1 + weight2), out);
    return out;
}

using Opponent = std::array<Plane, 3>;

Opponent toOpponent(const Image& image) {
    Opponent planes = {Plane(image.width, image.height), Plane(image.width, image.height),
                       Plane(image.width, image.height)};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const dvec3 color = opponentFromRgb(glm::clamp(dvec3(image.pixels[i]), 0.0, 1.0));
        for (int c = 0; c < 3; ++c) planes[c].values[i] = static_cast<float>(color[c]);
    }
    return planes;
}

/// What the eye makes of the colours: filtered, then in a perceptually uniform space.
std::vector<dvec3> perceivedColors(const Opponent& image, double pixelsPerDegree) {
    Opponent filtered = image;
    for (int c = 0; c < 3; ++c)
        filtered[c] = filterByContrastSensitivity(image[c], kSensitivities[c], pixelsPerDegree);
    std::vector<dvec3> colors(image[0].values.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const dvec3 yCxCz(filtered[0].values[i], filtered[1].values[i], filtered[2].values[i]);
        colors[i] = huntLabFromRgb(glm::clamp(rgbFromOpponent(yCxCz), 0.0, 1.0));
    }
    return colors;
}

/// HyAB distance raised to q_c and mapped so that most of [0, 1] serves the smaller differences.
double colorDifference(const dvec3& a, const dvec3& b) {
    static const double kLargest =
        std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColorExponent);
    const double knee = kRedistributionKnee * kLargest;
    const double difference = std::pow(hyab(a, b), kColorExponent);
    if (difference < knee) return kRedistributionValue / knee * difference;
    return kRedistributionValue +
           (difference - knee) / (kLargest - knee) * (1 - kRedistributionValue);
}

/// 1-D derivative-of-Gaussian kernels whose positive and negative weights sum to +1 and -1.
struct DetectorKernels {
    Kernel smooth, edge, point;
};

Kernel normaliseBySign(const std::vector<double>& weights) {
    double positive = 0, negative = 0;
    for (double w : weights) (w > 0 ? positive : negative) += std::abs(w);
    Kernel kernel;
    for (double w : weights)
        kernel.push_back(static_cast<float>(w / (w > 0 ? positive : negative)));
    return kernel;
}

DetectorKernels makeDetectorKernels(double pixelsPerDegree) {
    const double deviation = 0.5 * kDetectorWidth * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    std::vector<double> smooth, edge, point;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2 * deviation * deviation));
        smooth.push_back(g);
        edge.push_back(x == 0 ? -0.0 : -x * g);
        point.push_back((x * x / (deviation * deviation) - 1) * g);
    }
    return {normaliseBySign(smooth), normaliseBySign(edge), normaliseBySign(point)};
}

/// Strengths of edges and of points in the achromatic channel, scaled to [0, 1].
std::array<std::vector<float>, 2> detectFeatures(const Plane& achromatic,
                                                 const DetectorKernels& kernels) {
    Plane y = achromatic;
    for (float& v : y.values) v = (v + 16) / 116;
    const Plane smoothColumns = convolveColumns(y, kernels.smooth);
    const Plane smoothRows = convolveRows(y, kernels.smooth);
    std::array<std::vector<float>, 2> strengths;
    for (int feature = 0; feature < 2; ++feature) {
        const Kernel& derivative = feature == 0 ? kernels.edge : kernels.point;
        const Plane dx = convolveRows(smoothColumns, derivative);
        const Plane dy = convolveColumns(smoothRows, derivative);
        for (std::size_t i = 0; i < dx.values.size(); ++i)
            strengths[feature].push_back(std::hypot(dx.values[i], dy.values[i]));
    }
    return strengths;
}

double featureDifference(double edges, double edgesReference, double points,
                         double pointsReference) {
    const double difference =
        std::max(std::abs(edges - edgesReference), std::abs(points - pointsReference));
    return std::pow(difference / std::numbers::sqrt2, kFeatureExponent);
}

}  // namespace

std::vector<float> computeFlip(const Image& test, const Image& reference, double pixelsPerDegree) {
    BRUME_ASSERT_EQ(test.width, reference.width);
    BRUME_ASSERT_EQ(test.height, reference.height);
    const Opponent opponent = toOpponent(test), opponentReference = toOpponent(reference);
    const auto colors = perceivedColors(opponent, pixelsPerDegree);
    const auto colorsReference = perceivedColors(opponentReference, pixelsPerDegree);
    const DetectorKernels kernels = makeDetectorKernels(pixelsPerDegree);
    const auto features = detectFeatures(opponent[0], kernels);
    const auto featuresReference = detectFeatures(opponentReference[0], kernels);

    std::vector<float> flip(test.pixels.size());
    for (std::size_t i = 0; i < flip.size(); ++i) {
        const double color = colorDifference(colors[i], colorsReference[i]);
        const double feature = featureDifference(features[0][i], featuresReference[0][i],
                                                 features[1][i], featuresReference[1][i]);
        flip[i] = static_cast<float>(std::clamp(std::pow(color, 1 - feature), 0.0, 1.0));
    }
    return flip;
}

}  // namespace brume::bench
