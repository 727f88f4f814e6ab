// SPDX-License-Identifier: Apache-2.0
// Light that reaches a point: on surfaces, and scattered once by media.
#pragma once

#include <reference/occlusion.hpp>

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

    /// Is the light that media scatter towards the viewer the same all along a ray?
    bool isConstantAlongRays() const { return !mHasScattering || (!mHasPoints && !mHasShadows); }
    bool hasShadows() const { return mHasShadows; }

    /// Per class: ambient radiance + sum over lights of phase * E * T, for light leaving the point
    /// against `direction`.
    void scatter(const dvec3& position, const dvec3& direction, std::span<dvec3> perClass) const;

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

    static Arrival arrive(const scene::Light& light, const dvec3& position);
    bool castsShadows(const scene::Light& light) const;
    dvec3 transmittance(const Arrival& arrival, const dvec3& position, double tMin,
                        std::uint32_t except) const;
    /// Sum over the lights in front of a surface of E * T * weight(direction of the light).
    template <typename Weight>
    dvec3 sumLights(const SurfacePoint& point, const Weight& weight) const;

    const Occlusion& mOcclusion;
    bool mWithShadows;
    bool mHasScattering = false, mHasPoints = false, mHasShadows = false;
    dvec3 mAmbient{0};
    std::vector<scene::Light> mLights;  ///< all but ambient and black ones
    std::vector<Phase> mPhases;
    std::vector<std::uint32_t> mClassOfSource;
};

}  // namespace brume::reference
