// SPDX-License-Identifier: Apache-2.0
#include <reference/lighting.hpp>

#include <core/phase.hpp>
#include <reference/roots.hpp>
#include <reference/surface_response.hpp>

#include <algorithm>

namespace brume::reference {
namespace {

/// A surface does not shadow itself or what it touches within this distance (times the size of the
/// coordinates).
constexpr double kContactDistance = 1e-10;

double computeSpotFactor(const scene::Light& light, const dvec3& travel) {
    const double inner = std::cos(light.innerAngle), outer = std::cos(light.outerAngle);
    const double cosine = glm::dot(travel, light.direction);
    if (!(inner > outer)) return cosine >= outer ? 1 : 0;
    const double s = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    return s * s;
}

double evaluatePhase(scene::PhaseType type, double g, double cosTheta) {
    switch (type) {
        case scene::PhaseType::Isotropic:
            return phaseIsotropic<double>();
        case scene::PhaseType::Rayleigh:
            return phaseRayleigh(cosTheta);
        case scene::PhaseType::HenyeyGreenstein:
            break;
    }
    return phaseHenyeyGreenstein(cosTheta, g);
}

}  // namespace

Lighting::Lighting(const scene::Scene& scene, const MediaSet& media, const Occlusion& occlusion,
                   bool withShadows)
    : mMedia(media), mOcclusion(occlusion), mWithShadows(withShadows) {
    for (const scene::Light& light : scene.lights) {
        if (light.type == scene::LightType::Ambient) mAmbient += light.color;
        if (light.type == scene::LightType::Ambient || light.color == dvec3(0)) continue;
        mLights.push_back(light);
        mHasPoints = mHasPoints || light.type != scene::LightType::Directional;
        mHasShadows = mHasShadows || castsShadows(light);
    }
    for (std::uint32_t i = 0; i < media.sourceCount(); ++i) {
        const Source& source = media.source(i);
        const bool hasG = source.phase == scene::PhaseType::HenyeyGreenstein;
        const Phase phase{source.phase, hasG ? source.g : 0};
        const auto found = std::find(mPhases.begin(), mPhases.end(), phase);
        mClassOfSource.push_back(static_cast<std::uint32_t>(found - mPhases.begin()));
        if (found == mPhases.end()) mPhases.push_back(phase);
        mHasScattering = mHasScattering || source.scattering != dvec3(0);
    }
    if (!hasWholeShadows()) return;
    mShares.resize(media.sphereCount() * mLights.size());
    mHasShares = std::make_unique<std::once_flag[]>(media.sphereCount());
}

bool Lighting::castsShadows(const scene::Light& light) const {
    return mWithShadows && light.shadow != "none";
}

Lighting::Arrival Lighting::arrive(const scene::Light& light, const dvec3& position) {
    if (light.type == scene::LightType::Directional) return {light.color, light.direction};
    const dvec3 fromLight = position - light.position;
    const double distance = glm::length(fromLight);
    const dvec3 travel = distance > 0 ? fromLight / distance : light.direction;
    const double d = std::max(distance, light.radius);
    const double factor =
        light.type == scene::LightType::Spot ? computeSpotFactor(light, travel) : 1.0;
    return {light.color * (factor / (d * d)), travel, distance};
}

dvec3 Lighting::transmittance(const Arrival& arrival, const dvec3& position, double tMin,
                              std::uint32_t except) const {
    if (!(arrival.distance > 0)) return dvec3(1);
    return mOcclusion.transmittance({position, -arrival.travel}, tMin, arrival.distance, except);
}

void Lighting::scatter(const dvec3& position, const dvec3& direction, bool withShadows,
                       std::span<dvec3> sample) const {
    const std::size_t classes = classCount();
    std::fill_n(sample.begin(), classes, mAmbient);
    std::fill(sample.begin() + static_cast<std::ptrdiff_t>(classes), sample.end(), dvec3(0));
    for (std::size_t l = 0; l < mLights.size(); ++l) {
        const scene::Light& light = mLights[l];
        const Arrival arrival = arrive(light, position);
        if (arrival.irradiance == dvec3(0)) continue;
        const dvec3 share = withShadows && castsShadows(light)
                                ? transmittance(arrival, position, 0, kNoTriangle)
                                : dvec3(1);
        const double cosTheta = std::clamp(-glm::dot(arrival.travel, direction), -1.0, 1.0);
        for (std::size_t i = 0; i < classes; ++i) {
            const dvec3 scattered =
                evaluatePhase(mPhases[i].first, mPhases[i].second, cosTheta) * arrival.irradiance;
            sample[i] += scattered * share;
            if (hasWholeShadows()) sample[classes + i * mLights.size() + l] = scattered;
        }
    }
}

dvec3 Lighting::onSphere(std::uint32_t sphere, std::uint32_t phaseClass,
                         std::span<const dvec3> sample) const {
    const std::span<const dvec3> shares = sharesOf(sphere);
    dvec3 sum = mAmbient;
    for (std::size_t l = 0; l < mLights.size(); ++l)
        sum += shares[l] * sample[classCount() + phaseClass * mLights.size() + l];
    return sum;
}

std::span<const dvec3> Lighting::sharesOf(std::uint32_t sphere) const {
    const std::span<dvec3> shares(&mShares[sphere * mLights.size()], mLights.size());
    std::call_once(mHasShares[sphere], [&] {
        const dvec3 center = mMedia.sphereCenter(sphere);
        const double radius = mMedia.sphereRadius(sphere);
        for (std::size_t l = 0; l < mLights.size(); ++l) {
            shares[l] = dvec3(1);
            if (!castsShadows(mLights[l])) continue;
            const Arrival middle = arrive(mLights[l], center);
            const dvec3 front = center - std::min(radius, middle.distance) * middle.travel;
            shares[l] = transmittance(arrive(mLights[l], front), front, 0, kNoTriangle);
        }
    });
    return shares;
}

template <typename Weight>
dvec3 Lighting::sumLights(const SurfacePoint& point, const Weight& weight) const {
    const dvec3 size = glm::max(dvec3(1), glm::abs(point.position));
    const double tMin = kContactDistance * std::max({size.x, size.y, size.z});
    dvec3 sum(0);
    for (const scene::Light& light : mLights) {
        const Arrival arrival = arrive(light, point.position);
        const double cosine = -glm::dot(point.normal, arrival.travel);
        if (!(cosine > 0) || arrival.irradiance == dvec3(0)) continue;
        const dvec3 visible = castsShadows(light)
                                  ? transmittance(arrival, point.position, tMin, point.triangle)
                                  : dvec3(1);
        sum += visible * arrival.irradiance * weight(arrival.travel);
    }
    return sum;
}

dvec3 Lighting::illuminate(const SurfacePoint& point) const {
    return mAmbient + sumLights(point, [&](const dvec3& travel) {
               return -glm::dot(point.normal, travel) / kPi;
           });
}

dvec3 Lighting::highlights(const SurfacePoint& point, const dvec3& direction) const {
    return sumLights(point, [&](const dvec3& travel) {
        return highlight(point.normal, -direction, -travel, *point.material);
    });
}

void Lighting::collectBreaks(const scene::Ray& ray, std::vector<double>& breaks) const {
    for (const scene::Light& light : mLights) {
        if (castsShadows(light)) mOcclusion.collectShadowEdges(ray, light, breaks);
        if (light.type == scene::LightType::Directional) continue;
        const dvec3 o = ray.origin - light.position;
        const double closest = -glm::dot(o, ray.direction), o2 = glm::dot(o, o);
        breaks.push_back(closest);
        appendRoots(1, -closest, o2 - light.radius * light.radius, breaks);
        if (light.type != scene::LightType::Spot) continue;
        // The cones |o + t d| cos = (o + t d) . axis.
        const double oa = glm::dot(o, light.direction);
        const double da = glm::dot(ray.direction, light.direction);
        for (const double angle : {light.innerAngle, light.outerAngle}) {
            const double c2 = std::cos(angle) * std::cos(angle);
            appendRoots(da * da - c2, oa * da + c2 * closest, oa * oa - c2 * o2, breaks);
        }
    }
}

}  // namespace brume::reference
