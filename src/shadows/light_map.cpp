// SPDX-License-Identifier: Apache-2.0
#include <shadows/light_map.hpp>

#include <algorithm>

namespace brume::shadows {
namespace {

/// Sizes are powers of this: casters that move a little keep the size of their map.
const double kSizeStep = std::exp2(1.0 / 8);
/// Steps that light on media is followed in, along the width of a map.
constexpr double kStepsPerMap = 128;

struct Axes {
    dvec3 right, up, forward;
};

Axes makeAxes(const dvec3& forward) {
    const dvec3 reference = std::abs(forward.y) < 0.99 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
    const dvec3 right = glm::normalize(glm::cross(forward, reference));
    return {right, glm::cross(right, forward), forward};
}

void setAxes(const Axes& axes, shader::ShadowMap& map) {
    map.right = vec3(axes.right);
    map.up = vec3(axes.up);
    map.forward = vec3(axes.forward);
}

void fitDirectional(const Axes& axes, const Box3& bounds, const Focus& focus, const dvec3& origin,
                    std::uint32_t border, shader::ShadowMap& map) {
    Box3 box;
    for (int c = 0; c < 8; ++c) {
        const dvec3 p(c & 1 ? bounds.hi.x : bounds.lo.x, c & 2 ? bounds.hi.y : bounds.lo.y,
                      c & 4 ? bounds.hi.z : bounds.lo.z);
        box.extend(dvec3(glm::dot(p, axes.right), glm::dot(p, axes.up), glm::dot(p, axes.forward)));
    }
    if (focus.radius > 0) {
        const dvec2 at(glm::dot(focus.center, axes.right), glm::dot(focus.center, axes.up));
        for (int i = 0; i < 2; ++i) {
            box.lo[i] = std::min(std::max(box.lo[i], at[i] - focus.radius), box.hi[i]);
            box.hi[i] = std::max(std::min(box.hi[i], at[i] + focus.radius), box.lo[i]);
        }
    }
    const dvec3 size = box.size(), center = box.center();
    const double widest = std::max({size.x, size.y, 1e-6 * size.z, 1e-12});
    const double inner = static_cast<double>(map.resolution) - 2.0 * (border + 1.0);
    const double needed = 0.5 * widest * map.resolution / std::max(inner, 1.0);
    const double extent = std::pow(kSizeStep, std::ceil(std::log(needed) / std::log(kSizeStep)));
    const double texel = 2 * extent / map.resolution;
    const double margin = 1e-3 * std::max(size.z, 1e-3 * extent);
    const dvec3 at(std::round(center.x / texel) * texel, std::round(center.y / texel) * texel,
                   box.lo.z - margin);
    map.origin = vec3(axes.right * at.x + axes.up * at.y + axes.forward * at.z - origin);
    map.extent = static_cast<float>(extent);
    map.begin = 0;
    map.end = static_cast<float>(size.z + 2 * margin);
    const double longest = focus.radius > 0 ? widest : std::max(widest, size.z);
    map.stepLength = static_cast<float>(longest / kStepsPerMap);
}

/// Distances from a point to a box.
std::pair<double, double> rangeOf(const Box3& bounds, const dvec3& point) {
    const dvec3 outside = glm::max(glm::max(bounds.lo - point, point - bounds.hi), dvec3(0));
    const dvec3 farthest = glm::max(glm::abs(bounds.lo - point), glm::abs(bounds.hi - point));
    return {glm::length(outside), glm::length(farthest)};
}

}  // namespace

std::uint32_t faceCountFor(const scene::Light& light) {
    if (light.type == scene::LightType::Directional) return 1;
    return light.type == scene::LightType::Spot && light.outerAngle <= kWidestSingleFace ? 1 : 6;
}

void fitMap(const scene::Light& light, const Box3& bounds, const Focus& focus, const dvec3& origin,
            std::uint32_t border, shader::ShadowMap& map) {
    const bool isDirectional = light.type == scene::LightType::Directional;
    map.isDirectional = isDirectional;
    map.faceCount = faceCountFor(light);
    const Axes axes = map.faceCount == 1 ? makeAxes(light.direction) : makeAxes(dvec3(0, 0, 1));
    setAxes(axes, map);
    if (isDirectional) return fitDirectional(axes, bounds, focus, origin, border, map);

    const double tangent = map.faceCount == 1 ? std::tan(light.outerAngle) : 1.0;
    const double inner = std::max(map.resolution - 2.0 * border, 1.0);
    map.origin = vec3(light.position - origin);
    map.extent = static_cast<float>(tangent * map.resolution / inner);
    const auto [nearest, farthest] = rangeOf(bounds, light.position);
    map.begin = static_cast<float>(0.999 * nearest);
    map.end = static_cast<float>(1.001 * farthest + 1e-6);
    const dvec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    map.stepLength = static_cast<float>(
        (focus.radius > 0 ? std::min(2 * focus.radius, longest) : longest) / kStepsPerMap);
}

}  // namespace brume::shadows
