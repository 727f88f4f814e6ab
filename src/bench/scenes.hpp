// SPDX-License-Identifier: Apache-2.0
// Scenes made in code, on which methods are compared.
#pragma once

#include <core/log.hpp>
#include <render/renderer.hpp>
#include <scene/scene.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brume::bench {

/// A built-in scene, or a family of them that is measured together.
struct SceneInfo {
    std::string_view name;
    std::string_view summary;
};

std::span<const SceneInfo> listScenes();

struct NamedScene {
    std::string name;
    scene::Scene scene;
    int layerCount = 0;  ///< full-screen layers, for layer-pixels per second; else 0
    /// Fields made in code, beside those that the scene loads.
    std::vector<std::pair<scene::Volume, volumes::VolumeGrid>> volumes = {};
};

/// prepareScene(), with the fields made in code.
render::PreparedScene prepareNamed(const NamedScene& named, const Log& log);

/// The scenes of that name; empty if there is none. `layers` and `hard` are several; any
/// `layers_<count>_<width>x<height>` and `spheres_<count>_<radius>`, `mixed_<count>_<radius>` with
/// counts such as 500, 10k, 1m is one.
std::vector<NamedScene> makeScenes(std::string_view name);

/// `layerCount` full-screen thin surfaces in shuffled order: the test of tables 1 and 2 in Barta,
/// Kovacs, "Order Independent Transparency with Per-Pixel Linked Lists", 2011.
scene::Scene makeLayers(int layerCount, int width, int height);

/// `count` spheres of constant density that each cover the whole 1280x720 image and overlap; total
/// optical depth about 3.
scene::Scene makeNestedSpheres(int count);

/// `count` spheres of constant density, each `radiusPixels` wide on a 1280x720 image, at random
/// places and distances; optical depth 0.4 through each centre. They take turns in `mediumCount`
/// media of different albedos.
scene::Scene makeSpheres(int count, double radiusPixels, int mediumCount = 1);

/// 1 000 spheres of triangles with coverage one half, 10 x 10 x 10 of them, at 1280x720: the scene of
/// public samples of order-independent transparency. About 4 million fragments, up to 20 layers.
scene::Scene makeMeshSpheres();

/// Three coloured panes, one over the other, across a sun overhead that casts shadows.
scene::Scene makeShadowPanes();

/// `count` discs of radius 0.12 whose coverage falls off to their rims, of many colours, at random
/// places in a cube of 2 m under the same sun.
scene::Scene makeShadowDiscs(int count);

}  // namespace brume::bench
