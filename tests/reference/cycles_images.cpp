// SPDX-License-Identifier: Apache-2.0
#include <core/image_io.hpp>
#include <reference/cycles_images.hpp>
#include <volumes/vdb_file.hpp>

namespace brume::test {
namespace {

std::filesystem::path dataPath(const char* file) {
    return std::filesystem::path(BRUME_SHARED_DATA_DIR) / file;
}

struct Rows {
    int first, count;
};

// The middle one of each `bands` bands of four rows; of one, all rows at once.
std::vector<Rows> pickRows(int height, int bands) {
    if (bands == 1) return {{0, height}};
    std::vector<Rows> rows;
    for (int first = bands / 2 * 4; first + 4 <= height; first += bands * 4)
        rows.push_back({first, 4});
    return rows;
}

// Looks at these rows of the image that Cycles' camera took, as an image of their own.
void setCamera(scene::Scene& scene, const CyclesImage& cycles, const Image& image, Rows rows,
               double zFront) {
    const double pixel = cycles.view.scale / std::max(image.width, image.height);
    const double below = rows.first + 0.5 * rows.count - 0.5 * image.height;
    scene.image = {image.width, rows.count, cycles.supersample};
    scene.camera.type = scene::CameraType::Orthographic;
    scene.camera.position =
        dvec3(cycles.view.centerX, cycles.view.centerY - below * pixel, zFront);
    scene.camera.target = scene.camera.position - dvec3(0, 0, 1);
    scene.camera.height = pixel * rows.count;
}

void appendRows(Image& image, const Image& from, Rows rows) {
    image.width = from.width;
    image.height += rows.count;
    const auto begin = from.pixels.begin() + rows.first * from.width;
    image.pixels.insert(image.pixels.end(), begin, begin + rows.count * from.width);
}

double computeRmse(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const dvec3 difference = dvec3(a.pixels[i]) - dvec3(b.pixels[i]);
        sum += glm::dot(difference, difference);
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels.size())));
}

}  // namespace

bool haveCyclesImages() { return std::filesystem::exists(cyclesImages()); }

std::filesystem::path cyclesImages() { return dataPath("reference"); }

CyclesDifference compareWithCycles(
    const CyclesImage& cycles, const scene::Medium& medium, const dvec3& background,
    const std::vector<scene::Light>& lights, int bands,
    const std::function<Image(const scene::Scene&, const std::vector<volumes::VolumeGrid>&)>&
        render) {
    const Image whole = readImage(dataPath(cycles.image));
    scene::Scene scene;
    scene.media = {medium};
    scene.lights = lights;
    scene.background.radiance = background;
    scene.volumes.resize(1);
    scene.volumes[0].file = dataPath(cycles.view.volume);
    const std::vector<volumes::VolumeGrid> grids{
        volumes::loadVolume(scene.volumes[0], medium.extinction.x, Log())};
    Image actual, expected;
    for (const Rows rows : pickRows(whole.height, bands)) {
        setCamera(scene, cycles, whole, rows, grids[0].worldBounds().hi.z + 1);
        appendRows(actual, render(scene, grids), {0, rows.count});
        appendRows(expected, whole, rows);
    }
    return {computeRmse(actual, expected),
            computeRmse(downsample(actual, 4), downsample(expected, 4))};
}

}  // namespace brume::test
