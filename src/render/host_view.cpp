// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <render/host_view.hpp>

#include <fmt/format.h>

#include <cmath>

namespace brume::render {
namespace {

Error refuse(const std::string& problem) { return inputError("reading the view", "", problem); }

dvec3 rowOf(const dmat4& m, int row) { return {m[0][row], m[1][row], m[2][row]}; }

void checkRigid(const dmat4& viewFromWorld) {
    const dmat3 rotation(viewFromWorld);
    const dmat3 product = rotation * glm::transpose(rotation);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) < 1e-4))
                throw refuse(
                    "viewFromWorld scales or shears, allowed are rotations with a translation");
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(viewFromWorld[3][i]))
            throw refuse("viewFromWorld has a translation that is not finite");
}

void checkProjection(const dmat4& p) {
    const double scale = std::abs(p[0][0]) + std::abs(p[1][1]);
    // Off-centre: in perspective with depth, else everywhere the same.
    const bool isOrthographic = p[2][3] == 0;
    const glm::dvec4 &shift = isOrthographic ? p[3] : p[2], &other = isOrthographic ? p[2] : p[3];
    const double skew =
        std::abs(p[1][0]) + std::abs(p[0][1]) + std::abs(other.x) + std::abs(other.y);
    if (!(scale > 0) || p[0][0] == 0 || p[1][1] == 0 || !std::isfinite(scale))
        throw refuse("clipFromView has no field of view");
    if (!(skew <= 1e-9 * scale))
        throw refuse(
            "clipFromView is skewed, allowed are perspective and orthographic projections");
    if (!std::isfinite(shift.x) || !std::isfinite(shift.y))
        throw refuse("clipFromView is shifted by what is not finite");
    if (p[2][3] != 0 && p[3][3] != 0)
        throw refuse("clipFromView is neither perspective nor orthographic");
}

}  // namespace

View makeView(const HostView& host, shader::BackdropPush& push) {
    checkRigid(host.viewFromWorld);
    const dmat4& p = host.clipFromView;
    checkProjection(p);
    if (host.width < 1 || host.height == 0 || host.x < 0 || host.y < 0 ||
        host.y + std::min(host.height, 0) < 0)
        throw refuse(
            fmt::format("the viewport {}x{} at {}, {} is empty or begins outside the image",
                        host.width, host.height, host.x, host.y));
    const bool isOrthographic = p[2][3] == 0;
    // Along which view z the camera looks, and by what clip w grows with depth.
    const double towards = isOrthographic ? (host.isLeftHanded ? 1 : -1) : (p[2][3] > 0 ? 1 : -1);
    const double w = isOrthographic ? std::abs(p[3][3]) : std::abs(p[2][3]);

    View view;
    scene::CameraFrame& camera = view.camera;
    camera.type = isOrthographic ? scene::CameraType::Orthographic : scene::CameraType::Perspective;
    const dmat3 rotation(host.viewFromWorld);
    camera.position = -(glm::transpose(rotation) * dvec3(host.viewFromWorld[3]));
    camera.right = glm::normalize(rowOf(host.viewFromWorld, 0)) * (p[0][0] > 0 ? 1.0 : -1.0);
    // Vulkan's clip y grows downwards in the image.
    const bool isUpright = (p[1][1] < 0) == (host.height > 0);
    camera.up = glm::normalize(rowOf(host.viewFromWorld, 1)) * (isUpright ? 1.0 : -1.0);
    camera.forward = glm::normalize(rowOf(host.viewFromWorld, 2)) * towards;
    camera.extentX = w / std::abs(p[0][0]);
    camera.extentY = w / std::abs(p[1][1]);
    // The axis meets the image plane where the clip coordinates are those of the shift alone.
    const dvec2 shift = isOrthographic ? dvec2(p[3]) : dvec2(p[2]) * towards;
    camera.centerX = -shift.x / std::abs(p[0][0]);
    camera.centerY = shift.y / std::abs(p[1][1]) * (host.height > 0 ? 1.0 : -1.0);
    camera.width = host.width;
    camera.height = std::abs(host.height);

    // Clip z = a D + b and w = c D + e at view depth D; the viewport scales their quotient.
    const double e = isOrthographic ? p[3][3] : 0, c = isOrthographic ? 0 : p[2][3] * towards;
    const double range = host.maxDepth - host.minDepth;
    if (range == 0) throw refuse("the viewport's depth range is empty");
    const double a = p[2][2] * towards * range + host.minDepth * c;
    const double b = p[3][2] * range + host.minDepth * e;
    const double slope = (a * e - b * c) / range;  // of the depth before the viewport
    if (!(slope != 0)) throw refuse("clipFromView has no depth");
    const double farDepth = slope > 0 ? host.maxDepth : host.minDepth;
    const double nearDepth = slope > 0 ? host.minDepth : host.maxDepth;
    const auto depthAt = [&](double d) { return (b - d * e) / (d * c - a); };
    camera.near = std::max(depthAt(nearDepth), isOrthographic ? 0.0 : 1e-6);
    if (isOrthographic) view.far = depthAt(farDepth);
    push = {.a = static_cast<float>(a),
            .b = static_cast<float>(b),
            .c = static_cast<float>(c),
            .e = static_cast<float>(e),
            .farDepth = static_cast<float>(farDepth),
            .offsetX = static_cast<std::uint32_t>(host.x),
            .offsetY = static_cast<std::uint32_t>(host.y + std::min(host.height, 0))};
    return view;
}

}  // namespace brume::render
