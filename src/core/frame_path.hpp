// SPDX-License-Identifier: Apache-2.0
// Numbered files of a sequence: names in which a run of '#' or "%0Nd" stands for the frame number.
#pragma once

#include <filesystem>

namespace brume {

/// Whether the file's name (not its folders) holds such a place.
bool hasFrameNumber(const std::filesystem::path& pattern);

/// The file of one frame: the first such place becomes the number, with at least as many digits as
/// it says; without any, the number goes before the extension.
std::filesystem::path makeFramePath(const std::filesystem::path& pattern, int frame);

}  // namespace brume
