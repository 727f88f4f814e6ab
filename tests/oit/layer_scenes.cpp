// SPDX-License-Identifier: Apache-2.0
#include <oit/layer_scenes.hpp>
#include <reference/reference.hpp>

#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace brume::test {

PaneScene::PaneScene(int size, const dvec3& background) : TestScene(size, size) {
    scene.camera.type = scene::CameraType::Orthographic;
    scene.camera.position = dvec3(0);
    scene.camera.target = dvec3(0, 0, 1);
    scene.camera.height = 2;
    scene.camera.near = 1e-4;
    scene.background.radiance = background;
}

void PaneScene::addPanes(const scene::Material& material, std::span<const double> distances) {
    scene::Mesh mesh;
    for (const double distance : distances) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const vec2 corner : {vec2(-3, -3), vec2(3, -3), vec2(3, 3), vec2(-3, 3)}) {
            mesh.positions.emplace_back(corner, distance);
            mesh.normals.emplace_back(0, 0, -1);
            mesh.uvs.emplace_back(0, 0);
        }
        for (const std::uint32_t i : {0u, 2u, 1u, 0u, 3u, 2u}) mesh.indices.push_back(first + i);
    }
    addMesh(std::move(mesh), addMaterial(material));
}

scene::Material makeGlowing(double coverage, const dvec3& radiance, const dvec3& transmission) {
    scene::Material material = makeThin(coverage, transmission);
    material.emission = radiance;
    return material;
}

TestScene makeSmoke(int size, int sphereCount) {
    TestScene s(size, size);
    s.addDaylight();
    const std::uint32_t white = s.addMedium(3, 0.9), brown = s.addMedium(2, 0.3);
    Random random(4);
    for (int i = 0; i < sphereCount; ++i)
        s.addSphere(i % 2 ? white : brown, random.vector(-0.7, 0.7), random.uniform(0.3, 0.6),
                    scene::Profile::Smooth);
    s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeOpaque(dvec3(0.5, 0.4, 0.3))),
              translation(dvec3(0, -0.6, 0)));
    return s;
}

TestScene makeMixedScene(int size) {
    TestScene s = makeSmoke(size, 8);
    const std::uint32_t red = s.addMedium(dvec3(0.5, 2, 3), dvec3(0.6, 0.2, 0.1));
    s.addSphere(red, dvec3(-0.5, 0.5, 0.4), 0.4);
    s.addBox(red, dvec3(0.2, -0.6, -0.5), dvec3(0.7, 0, 0));
    s.addPane(s.addMaterial(makeThin(1, dvec3(0.9, 0.3, 0.2), dvec3(0.1))), 0.5, 0.6);
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0), dvec3(0.2, 0.7, 0.3))), -0.8, 0.3);
    s.addMesh(scene::makeSphere(0.35, 16),
              s.addMaterial(makeSolid(dvec3(0.4, 2, 2), dvec3(0.2, 0.1, 0.1))),
              translation(dvec3(0.5, 0.5, -0.3)));
    return s;
}

Image renderReferenceOf(const render::PreparedScene& scene) {
    return reference::render({scene.scene, scene.volumes, scene.spheres}, {.shadows = false}).image;
}

double computeRmse(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const dvec3 d = dvec3(a.pixels[i]) - dvec3(b.pixels[i]);
        sum += glm::dot(d, d);
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels.size())));
}

dvec3 computeMean(const Image& image) {
    dvec3 sum(0);
    for (const vec3& pixel : image.pixels) sum += dvec3(pixel);
    return sum / static_cast<double>(image.pixels.size());
}

Image FamilyTest::renderWith(const render::PreparedScene& scene, const std::string& method,
                             const scene::Settings& settings) {
    return render(scene, {.method = method, .settings = settings}).image;
}

void FamilyTest::expectUnbiased(const render::PreparedScene& scene, scene::Settings settings,
                                const Image& truth, double rounding) {
    constexpr int kPatterns = 12;
    const dvec3 expected = computeMean(truth);
    dvec3 sum(0), square(0);
    for (int pattern = 0; pattern < kPatterns; ++pattern) {
        settings["pattern"] = std::to_string(pattern);
        const dvec3 mean = computeMean(renderWith(scene, "stochastic", settings));
        sum += mean;
        square += mean * mean;
    }
    const dvec3 mean = sum / double(kPatterns);
    const dvec3 variance = glm::max(square / double(kPatterns) - mean * mean, dvec3(0));
    for (int c = 0; c < 3; ++c) {
        const double deviation = std::sqrt(variance[c] / (kPatterns - 1));
        RecordProperty(fmt::format("{}_{}", settings["estimator"], c),
                       fmt::format("{:+.2e} of {:.2e}", mean[c] - expected[c], deviation));
        // Eleven degrees of freedom, p = 1e-4 on each side.
        EXPECT_NEAR(mean[c], expected[c], 5.45 * deviation + rounding) << settings["estimator"];
    }
}

double FamilyTest::countTargetBits(const render::PreparedScene& scene, const std::string& method,
                                   const scene::Settings& settings, const std::string& prefix) {
    render::Renderer renderer(device(), scene, {.method = method, .settings = settings}, log());
    std::istringstream lines(renderer.explain());
    double bytes = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::vector<std::string> list;
        for (std::string word; words >> word;) list.push_back(word);
        // "<name>  <format> <size>  <bytes> bytes ..."
        for (std::size_t i = 2; i < list.size() && list[0].starts_with(prefix); ++i)
            if (list[i].starts_with("bytes")) bytes += std::stod(list[i - 1]);
    }
    return 8 * bytes / (scene.scene.image.width * scene.scene.image.height);
}

}  // namespace brume::test
