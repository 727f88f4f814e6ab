// SPDX-License-Identifier: Apache-2.0
#include <reference/medium_integral.hpp>

#include <algorithm>

namespace brume::reference {
namespace {

/// Accepted difference between the rule and Simpson's, per panel and radiance of order 1. The
/// rule itself is some orders better (tests/reference/hard_rays_test.cpp).
constexpr double kTolerance = 1e-9;
constexpr double kShadowTolerance = 1e-8;
/// Longest panel in shadowed media, as a fraction of the scene.
constexpr double kPanelsPerScene = 64;
/// Panels with one source function per channel need no depth limit; 1e30 needs 100 halvings.
constexpr int kMaxDepth = 130;
constexpr int kMaxShadowDepth = 40;
/// Light samples per ray after which panels are accepted as they are.
constexpr int kMaxSamples = 200000;

double largest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }

template <class Value>
Value boole(const Value (&f)[5]) {
    return (7.0 * (f[0] + f[4]) + 32.0 * (f[1] + f[3]) + 12.0 * f[2]) / 90.0;
}

/// Integrals from node 0 to each node of the polynomial through five values, in units of the panel
/// (Newton-Cotes and Adams weights; exact to degree 4).
void accumulate(const double (&f)[5], double (&sums)[5]) {
    sums[0] = 0;
    sums[1] = (251 * f[0] + 646 * f[1] - 264 * f[2] + 106 * f[3] - 19 * f[4]) / 2880;
    sums[2] = (29 * f[0] + 124 * f[1] + 24 * f[2] + 4 * f[3] - f[4]) / 360;
    sums[3] = (27 * f[0] + 102 * f[1] + 72 * f[2] + 42 * f[3] - 3 * f[4]) / 320;
    sums[4] = boole(f);
    for (int i = 1; i < 5; ++i) sums[i] = std::max(sums[i], sums[i - 1]);
}

}  // namespace

bool MediumIntegral::isDark() const { return largest(mTransmittance) < 1e-16; }

void MediumIntegral::start(const scene::Ray& ray, std::span<const Piece> pieces) {
    mRay = ray;
    mPieces = pieces;
    mRadiance = dvec3(0), mTransmittance = dvec3(1);
    mSampledTo = -1, mSampleCount = 0, mAsksShadows = false;
    keepLightSamples(1);
    mIsLightConstant = mLighting.isConstantAlongRays();
    mIsUniform =
        mIsLightConstant && std::all_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
            return isAlike(piece, pieces[0]);
        });
    mWeights.clear();
    if (mIsLightConstant && !pieces.empty()) sampleLight(0, 0);
    for (const Piece& piece : pieces) {
        const dvec3& extinction = mMedia.source(piece.source).extinction;
        Weights weights{extinction.x, extinction.y, extinction.z};
        if (mIsLightConstant) setLight(weights, sourceLight(piece, 0));
        mWeights.push_back(weights);
    }
}

void MediumIntegral::pass(const SurfaceResponse& surface) {
    mRadiance += mTransmittance * surface.added;
    mTransmittance *= surface.transmittance;
}

// ---- One source function: closed form ----

void MediumIntegral::addUniform(std::uint32_t piece, double density) {
    const Weights& weights = mWeights[piece];
    for (int c = 0; c < 3; ++c) {
        const double extinction = weights[c], light = weights[3 + c], depth = extinction * density;
        const double absorbed = -std::expm1(-depth);
        // Thick: the ratio of light to extinction; thin: the light, less the little absorbed on its
        // way.
        double gain = light * density;
        if (depth > 1)
            gain = light / extinction * absorbed;
        else if (depth > 0)
            gain *= absorbed / depth;
        mRadiance[c] += mTransmittance[c] * gain;
        mTransmittance[c] *= std::exp(-depth);
    }
}

void MediumIntegral::advanceUniform(double a, double b) {
    double density = 0;
    for (const Piece& piece : mPieces) {
        const double from = std::max(a, piece.t0), to = std::min(b, piece.t1);
        if (from < to) density += piece.integrate(from, to);
    }
    if (density > 0) addUniform(0, density);
}

void MediumIntegral::advance(double a, double b, std::span<const std::uint32_t> open) {
    if (open.empty() || !(a < b)) return;
    const bool hasOneSource = std::all_of(open.begin(), open.end(), [&](std::uint32_t piece) {
        return isAlike(mPieces[piece], mPieces[open[0]]);
    });
    if (isDark()) {
        dvec3 depth(0);
        for (const std::uint32_t piece : open)
            depth +=
                mMedia.source(mPieces[piece].source).extinction * mPieces[piece].integrate(a, b);
        mTransmittance *= glm::exp(-depth);
    } else if (hasOneSource && mIsLightConstant) {
        double density = 0;
        for (const std::uint32_t piece : open) density += mPieces[piece].integrate(a, b);
        addUniform(open[0], density);
    } else {
        mOpen = open;
        advancePanels(a, b);
    }
}

// ---- Mixtures and varying light: quadrature ----

void MediumIntegral::advancePanels(double a, double b) {
    const bool hadShadows = mAsksShadows;
    mAsksShadows = std::any_of(mOpen.begin(), mOpen.end(), [&](std::uint32_t piece) {
        return asksShadows(mPieces[piece]);
    });
    if (!mIsLightConstant && (mSampledTo != a || mAsksShadows != hadShadows)) sampleLight(0, a);
    double panelCount = 1;
    if (!mIsLightConstant && mAsksShadows)
        panelCount =
            std::clamp(std::ceil((b - a) / mSceneSize * kPanelsPerScene), 1.0, 2 * kPanelsPerScene);
    for (double i = 0; i < panelCount; ++i) {
        const double from = a + (b - a) * (i / panelCount);
        const double to = i + 1 < panelCount ? a + (b - a) * ((i + 1) / panelCount) : b;
        Nodes nodes{};
        for (int k = 1; k < kNodeCount; ++k)
            nodes[k] = addLightSample(k < 4 ? from + 0.25 * k * (to - from) : to);
        refine(from, to, nodes, 0);
        if (mIsLightConstant) continue;
        // The next panel begins where this one ends.
        const std::uint32_t size = mLighting.sampleSize();
        std::copy_n(mLightSamples.begin() + nodes[4] * size, size, mLightSamples.begin());
        keepLightSamples(1);
        mSampledTo = to;
    }
}

void MediumIntegral::refine(double a, double b, const Nodes& nodes, int depth) {
    const Gain gain = integrate(evaluate(a, b, nodes));
    const double scale = std::max({1.0, largest(mRadiance), largest(gain.radiance)});
    const double tolerance = mIsLightConstant ? kTolerance : kShadowTolerance;
    const int maxDepth = mIsLightConstant ? kMaxDepth : kMaxShadowDepth;
    if (gain.error > tolerance * scale && depth < maxDepth && mSampleCount < kMaxSamples &&
        a + 0.125 * (b - a) > a) {
        split(a, b, nodes, depth);
        return;
    }
    mRadiance += gain.radiance;
    mTransmittance *= gain.transmittance;
}

void MediumIntegral::split(double a, double b, const Nodes& nodes, int depth) {
    const auto kept = static_cast<std::uint32_t>(mLightSamples.size() / mLighting.sampleSize());
    const double h = b - a, middle = a + 0.5 * h;
    const auto n1 = addLightSample(a + 0.125 * h), n3 = addLightSample(a + 0.375 * h);
    const auto n5 = addLightSample(a + 0.625 * h), n7 = addLightSample(a + 0.875 * h);
    refine(a, middle, {nodes[0], n1, nodes[1], n3, nodes[2]}, depth + 1);
    refine(middle, b, {nodes[2], n5, nodes[3], n7, nodes[4]}, depth + 1);
    keepLightSamples(kept);
}

MediumIntegral::Panel MediumIntegral::evaluate(double a, double b, const Nodes& nodes) const {
    Panel panel;
    panel.length = b - a;
    double t[kNodeCount];
    for (int k = 0; k < kNodeCount; ++k) t[k] = k < 4 ? a + 0.25 * k * panel.length : b;
    for (const std::uint32_t index : mOpen) {
        double density[kNodeCount];
        mPieces[index].densities(t, density);
        Weights weights = mWeights[index];
        for (int k = 0; k < kNodeCount; ++k) {
            if (!mIsLightConstant) setLight(weights, sourceLight(mPieces[index], nodes[k]));
            for (int i = 0; i < kWeightCount; ++i) panel.sums[k][i] += density[k] * weights[i];
        }
    }
    return panel;
}

MediumIntegral::Gain MediumIntegral::integrate(const Panel& panel) const {
    Gain gain;
    const double h = panel.length;
    for (int c = 0; c < 3; ++c) {
        double sigma[kNodeCount], light[kNodeCount], tau[kNodeCount], rest[kNodeCount];
        for (int k = 0; k < kNodeCount; ++k)
            sigma[k] = panel.sums[k][c], light[k] = panel.sums[k][3 + c];
        accumulate(sigma, tau);
        const double depth = h * tau[4];
        const double reference = tau[4] > 0 ? boole(light) / tau[4] : 0;
        double variation = 0;  // of the source function
        for (int k = 0; k < kNodeCount; ++k) {
            const double difference = light[k] - reference * sigma[k];
            if (sigma[k] > 0) variation = std::max(variation, std::abs(difference) / sigma[k]);
            rest[k] = difference * std::exp(-h * tau[k]);
        }
        double fine = h * boole(rest);
        double error = std::abs(fine - h / 6 * (rest[0] + 4 * rest[2] + rest[4]));
        if (depth > 1) {
            // The nodes of a thick panel miss where the light comes from, and their rounding errors
            // grow with the depth; but the integral cannot exceed the variation of the source.
            fine = std::clamp(fine, -variation, variation);
            error = variation;
        }
        gain.radiance[c] = mTransmittance[c] * (fine - reference * std::expm1(-depth));
        gain.transmittance[c] = std::exp(-depth);
        gain.error = std::max(gain.error, mTransmittance[c] * error);
    }
    return gain;
}

// ---- Light along the ray ----

bool MediumIntegral::isAlike(const Piece& a, const Piece& b) const {
    return a.source == b.source && (a.sphere == b.sphere || !mLighting.hasWholeShadows());
}

bool MediumIntegral::asksShadows(const Piece& piece) const {
    return mLighting.hasShadows() && piece.sphere == kNoSphere &&
           mMedia.source(piece.source).scattering != dvec3(0);
}

dvec3 MediumIntegral::sourceLight(const Piece& piece, std::uint32_t lightSample) const {
    const Source& source = mMedia.source(piece.source);
    const std::uint32_t size = mLighting.sampleSize();
    const std::uint32_t phaseClass = mLighting.classOf(piece.source);
    const std::span sample = std::span(mLightSamples).subspan(lightSample * size, size);
    if (source.scattering == dvec3(0)) return source.emission;
    const bool isWhole = mLighting.hasWholeShadows() && piece.sphere != kNoSphere;
    const dvec3 light = isWhole ? mLighting.onSphere(piece.sphere, phaseClass, sample)
                                : sample[phaseClass];
    return source.emission + source.scattering * light;
}

void MediumIntegral::keepLightSamples(std::uint32_t count) {
    mLightSamples.resize(static_cast<std::size_t>(count) * mLighting.sampleSize());
}

void MediumIntegral::sampleLight(std::uint32_t index, double t) {
    const std::uint32_t size = mLighting.sampleSize();
    mLighting.scatter(mRay.origin + t * mRay.direction, mRay.direction, mAsksShadows,
                      std::span(mLightSamples).subspan(index * size, size));
    ++mSampleCount;
}

std::uint32_t MediumIntegral::addLightSample(double t) {
    if (mIsLightConstant) return 0;
    const auto index = static_cast<std::uint32_t>(mLightSamples.size() / mLighting.sampleSize());
    keepLightSamples(index + 1);
    sampleLight(index, t);
    return index;
}

}  // namespace brume::reference
