// SPDX-License-Identifier: Apache-2.0
#include <render/view.hpp>

#include <algorithm>

namespace brume::render {
namespace {

Box3 findBounds(const PreparedScene& prepared) {
    Box3 bounds;
    for (const scene::MediumSphere& sphere : prepared.spheres) {
        bounds.extend(sphere.center - dvec3(sphere.radius));
        bounds.extend(sphere.center + dvec3(sphere.radius));
    }
    for (const volumes::VolumeGrid& grid : prepared.volumes) bounds.extend(grid.worldBounds());
    for (const scene::Mesh& mesh : prepared.scene.meshes)
        for (const vec3& position : mesh.positions)
            bounds.extend(transformPoint(mesh.worldFromObject, dvec3(position)));
    return bounds;
}

}  // namespace

View makeView(const PreparedScene& prepared) {
    const scene::ImageSettings& image = prepared.scene.image;
    View view;
    scene::CameraFrame& camera = view.camera;
    camera = scene::makeCameraFrame(prepared.scene.camera, image.width * image.supersample,
                                    image.height * image.supersample);
    if (camera.type != scene::CameraType::Orthographic) return view;
    // Parallel rays may start anywhere along themselves: begin just before the scene, so that
    // distances keep their digits when the camera stands far away.
    const Box3 bounds = findBounds(prepared);
    if (bounds.isEmpty()) return view;
    const double reach = 0.5 * glm::length(bounds.size()) * 1.01 + 1e-3;
    const double middle = glm::dot(bounds.center() - camera.position, camera.forward);
    const double room = prepared.scene.effects.empty() ? reach : reach + 1000;
    const double shift = std::max(middle - room, 0.0);
    camera.position += shift * camera.forward;
    camera.near = std::max(camera.near - shift, 0.0);
    view.far = std::max(middle - shift + room, camera.near + 1);
    return view;
}

}  // namespace brume::render
