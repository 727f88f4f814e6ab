// SPDX-License-Identifier: Apache-2.0
// What several commands' options say.
#pragma once

#include <core/math.hpp>
#include <scene/settings.hpp>

#include <string>
#include <vector>

namespace brume::app {

/// "1280x720" to a size in [1, 16384]. Throws an input Error.
ivec2 parseSize(const std::string& text);

/// "key=value" words to settings. Throws an input Error.
scene::Settings parseSettings(const std::vector<std::string>& words);

}  // namespace brume::app
