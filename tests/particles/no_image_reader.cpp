// SPDX-License-Identifier: Apache-2.0
// The image reader of tests whose scenes have no images: see BRUME_OWN_IMAGE_READER.
#include <core/error.hpp>
#include <core/image_io.hpp>

namespace brume {

std::vector<vec4> readRgba(const std::filesystem::path& file, int&, int&) {
    throw inputError("reading image", file.string(), "these tests have no image reader");
}

std::vector<vec4> readRgba(const std::vector<unsigned char>&, const std::string& name, int&, int&) {
    throw inputError("reading image", name, "these tests have no image reader");
}

}  // namespace brume
