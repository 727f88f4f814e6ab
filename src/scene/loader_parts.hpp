// SPDX-License-Identifier: Apache-2.0
// The parts of a scene file that name nothing else: validated JSON to one struct each.
#pragma once

#include <scene/json_node.hpp>
#include <scene/scene.hpp>

namespace brume::scene {

Camera readCamera(const JsonNode& node);  ///< throws an input Error for a camera that sees nothing
ImageSettings readImageSettings(const JsonNode& node);
Light readLight(const JsonNode& node);
Material readMaterial(const JsonNode& node);  ///< without its textures
Medium readMedium(const JsonNode& node);
RenderSettings readRenderSettings(const JsonNode& node);

/// The member "transform" of a node: translate * rotateZ * rotateY * rotateX * scale; identity if
/// it has none.
dmat4 readTransform(const JsonNode& parent);

/// The member "path" of a node: [seconds, [x, y, z]], ...; empty if it has none.
Path readPath(const JsonNode& parent);

/// The mesh of a member "shape", placed by its transform.
Mesh readShape(const JsonNode& node);

}  // namespace brume::scene
