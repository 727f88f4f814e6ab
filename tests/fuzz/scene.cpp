// SPDX-License-Identifier: Apache-2.0
#include <fuzz/target.hpp>
#include <scene/loader.hpp>

void brume::fuzz::parse(Bytes bytes) {
    scene::parseScene(textOf(bytes), "/nowhere/scene.json", Log());
}
