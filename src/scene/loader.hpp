// SPDX-License-Identifier: Apache-2.0
// Scene and effect files: JSON, checked against docs/schema, to structs.
#pragma once

#include <core/log.hpp>
#include <scene/scene.hpp>

namespace brume::scene {

/// Reads a scene and everything it names except volumes (their paths are checked when they are
/// loaded): effects, glTF meshes, textures, environment. Throws an input Error with
/// file:line:column.
Scene loadScene(const std::filesystem::path& file, const Log& log);

/// The same from text; `file` gives the folder of relative paths and the name in messages.
Scene parseScene(const std::string& text, const std::filesystem::path& file, const Log& log);

Effect loadEffect(const std::filesystem::path& file, const Log& log);
Effect parseEffect(const std::string& text, const std::filesystem::path& file, const Log& log);

/// The JSON Schemas the files are checked against (the text of docs/schema/*.json, embedded at
/// build time).
const char* sceneSchema();
const char* effectSchema();

}  // namespace brume::scene
