// SPDX-License-Identifier: Apache-2.0
#include <fuzz/target.hpp>
#include <scene/gltf_loader.hpp>

void brume::fuzz::parse(Bytes bytes) {
    scene::parseGltf({bytes.begin(), bytes.end()}, "/nowhere/mesh.glb", Log());
}
