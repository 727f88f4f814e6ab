// SPDX-License-Identifier: Apache-2.0
// Parts of the scene as the shaders have them: in single precision, relative to an origin.
#pragma once

#include <scene/camera.hpp>
#include <scene/medium_sphere.hpp>
#include <scene/scene.hpp>

#include <shaders/common/frame.h>
#include <shaders/common/mesh.h>
#include <shaders/common/sphere.h>

namespace brume::render {

/// Its shadow map is still to be set.
shader::LightData makeLight(const scene::Light& light, const dvec3& origin);
shader::MediumData makeMedium(const scene::Medium& medium);
shader::MaterialData makeMaterial(const scene::Material& material);
/// `index`: among all spheres, for its shares of light.
shader::SphereData makeSphere(const scene::MediumSphere& sphere, std::size_t index,
                              const dvec3& origin);

/// As shaders/common/frame.h says.
struct ImagePlane {
    dvec3 corner, pixelRight, pixelDown;
};
ImagePlane makeImagePlane(const scene::CameraFrame& camera);

}  // namespace brume::render
