// SPDX-License-Identifier: Apache-2.0
// The volume rendering equation along one ray: radiance gained and transmittance left.
//
// Between two neighbouring events the densities are polynomials of degree <= 4, so optical depths
// are exact (Boole's rule). With S the ratio of emitted to extinguished light,
//   integral j e^-tau dt = S_ref (1 - e^-tau) + integral (j - S_ref sigma) e^-tau dt,
// where the second term vanishes when all open media share one S; else it is integrated over
// panels that are halved until the rule agrees with Simpson's and no panel that matters is thick.
// Source: Barta and Kovács 2011, section 3.5, with sums instead of quotients.
// Limits: a shadow narrower than a quarter panel (kPanelsPerScene) may be missed.
#pragma once

#include <reference/lighting.hpp>
#include <reference/surface_response.hpp>

#include <array>
#include <span>
#include <vector>

namespace brume::reference {

/// Front to back along one ray after another; keeps its buffers between rays. Not thread-safe.
class MediumIntegral {
  public:
    /// `sceneSize`: length beyond which nothing is (shadows are looked for at a fraction of it).
    MediumIntegral(const MediaSet& media, const Lighting& lighting, double sceneSize)
        : mMedia(media), mLighting(lighting), mSceneSize(sceneSize) {}

    /// Begins a ray through `pieces`, which must stay until its end.
    void start(const scene::Ray& ray, std::span<const Piece> pieces);

    /// All pieces have one source function, constant along the ray: then any [a, b] may be passed
    /// with advanceUniform().
    bool isUniform() const { return mIsUniform; }
    void advanceUniform(double a, double b);
    /// Passes [a, b], inside which just the pieces `open` are open and no other begins or ends.
    void advance(double a, double b, std::span<const std::uint32_t> open);
    /// Passes a surface.
    void pass(const SurfaceResponse& surface);

    dvec3 radiance() const { return mRadiance; }
    dvec3 transmittance() const { return mTransmittance; }
    /// Is what lies behind too faint to matter (1e-16)?
    bool isDark() const;

  private:
    static constexpr int kNodeCount = 5;
    using Nodes = std::array<std::uint32_t, kNodeCount>;  ///< of a panel: indices of light samples
    /// Extinction (3 channels) and emitted plus scattered light (3), per unit density or per metre.
    static constexpr int kWeightCount = 6;
    using Weights = std::array<double, kWeightCount>;
    /// Sums over the open pieces at the nodes, per metre.
    struct Panel {
        double length = 0;
        double sums[kNodeCount][kWeightCount] = {};
    };
    struct Gain {
        dvec3 radiance{0};
        dvec3 transmittance{1};
        double error = 0;  ///< estimated, of the radiance
    };

    void addUniform(std::uint32_t piece, double density);
    void advancePanels(double a, double b);
    void refine(double a, double b, const Nodes& nodes, int depth);
    void split(double a, double b, const Nodes& nodes, int depth);
    Panel evaluate(double a, double b, const Nodes& nodes) const;
    Gain integrate(const Panel& panel) const;

    static void setLight(Weights& weights, const dvec3& light) {
        for (int c = 0; c < 3; ++c) weights[3 + c] = light[c];
    }
    /// Do two pieces have the same light, and the same shadows?
    bool isAlike(const Piece& a, const Piece& b) const;
    /// Is a piece shadowed at each place?
    bool asksShadows(const Piece& piece) const;
    dvec3 sourceLight(const Piece& piece, std::uint32_t lightSample) const;
    std::uint32_t addLightSample(double t);
    void sampleLight(std::uint32_t index, double t);
    void keepLightSamples(std::uint32_t count);

    const MediaSet& mMedia;
    const Lighting& mLighting;
    double mSceneSize;

    scene::Ray mRay{};
    std::span<const Piece> mPieces;
    std::span<const std::uint32_t> mOpen;
    std::vector<Weights> mWeights;     ///< per piece; the light only where it is constant
    std::vector<dvec3> mLightSamples;  ///< sampleSize each; sample 0 is at mSampledTo
    double mSampledTo = 0;
    int mSampleCount = 0;  ///< taken on this ray
    bool mIsUniform = false, mIsLightConstant = false;
    bool mAsksShadows = false;  ///< the samples have shadows
    dvec3 mRadiance{0}, mTransmittance{1};
};

}  // namespace brume::reference
