// SPDX-License-Identifier: Apache-2.0
// Light that reaches a point: on surfaces, and scattered once by media.
#pragma once

#include <reference/occlusion.hpp>

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace brume::reference {

/// The scene's lights. What it is made from must outlive it.
class Lighting {
  public:
    Lighting(const scene::Scene& scene, const MediaSet& media, const Occlusion& occlusion,
             bool withShadows);

    /// Media with one phase function scatter alike and form a class.
    std::uint32_t classCount() const { return static_cast<std::uint32_t>(mPhases.size()); }
    std::uint32_t classOf(std::uint32_t source) const { return mClassOfSource[source]; }

    /// Is the light that media scatter towards the viewer the same all along a ray (for each sphere
    /// that is shadowed as a whole)?
    bool isConstantAlongRays() const {
        return !mHasScattering || (!mHasPoints && !(mHasShadows && mMedia.hasSampledMedia()));
    }
    bool hasShadows() const { return mHasShadows; }
    /// Are there spheres with shadows of their own?
    bool hasWholeShadows() const { return mHasShadows && mMedia.hasWholeSpheres(); }

    /// Of a sample: per class the light at a place; with whole shadows also, per class and light,
    /// that light without its shadow.
    std::uint32_t sampleSize() const {
        return classCount() * (hasWholeShadows() ? 1 + lightCount() : 1);
    }
    /// Fills a sample: per class ambient radiance + sum over lights of phase * E * T, for light
    /// leaving the point against `direction`. Without `withShadows` T is 1.
    void scatter(const dvec3& position, const dvec3& direction, bool withShadows,
                 std::span<dvec3> sample) const;
    /// The light of a sample on a sphere that is shadowed as a whole. Thread-safe.
    dvec3 onSphere(std::uint32_t sphere, std::uint32_t phaseClass,
                   std::span<const dvec3> sample) const;

    /// Ambient radiance + sum over lights of E * T * cos / pi.
    dvec3 illuminate(const SurfacePoint& point) const;

    /// Sum over lights of E * T * highlight(), towards the viewer against `direction`.
    dvec3 highlights(const SurfacePoint& point, const dvec3& direction) const;

    /// Appends the distances along a ray at which light is not smooth or has its peak; edges of
    /// shadows only while few things cast them.
    void collectBreaks(const scene::Ray& ray, std::vector<double>& breaks) const;

  private:
    using Phase = std::pair<scene::PhaseType, double>;
    /// Light that arrives at a point if nothing is in the way.
    struct Arrival {
        dvec3 irradiance{0};
        dvec3 travel{0};  ///< direction of the light, unit length
        double distance = kInfinity;
    };

    std::uint32_t lightCount() const { return static_cast<std::uint32_t>(mLights.size()); }
    /// Per light T at the front of a sphere: at the point nearest to the light.
    std::span<const dvec3> sharesOf(std::uint32_t sphere) const;
    static Arrival arrive(const scene::Light& light, const dvec3& position);
    bool castsShadows(const scene::Light& light) const;
    dvec3 transmittance(const Arrival& arrival, const dvec3& position, double tMin,
                        std::uint32_t except) const;
    /// Sum over the lights in front of a surface of E * T * weight(direction of the light).
    template <typename Weight>
    dvec3 sumLights(const SurfacePoint& point, const Weight& weight) const;

    const MediaSet& mMedia;
    const Occlusion& mOcclusion;
    bool mWithShadows;
    bool mHasScattering = false, mHasPoints = false, mHasShadows = false;
    dvec3 mAmbient{0};
    std::vector<scene::Light> mLights;  ///< all but ambient and black ones
    std::vector<Phase> mPhases;
    std::vector<std::uint32_t> mClassOfSource;
    mutable std::vector<dvec3> mShares;  ///< per sphere and light, once asked for
    std::unique_ptr<std::once_flag[]> mHasShares;
};

}  // namespace brume::reference
