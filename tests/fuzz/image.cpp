// SPDX-License-Identifier: Apache-2.0
// Images inside of glTF files: PNG and JPEG.
#include <core/image_io.hpp>
#include <fuzz/target.hpp>

void brume::fuzz::parse(Bytes bytes) {
    int width = 0, height = 0;
    readRgba({bytes.begin(), bytes.end()}, "image", width, height);
}
