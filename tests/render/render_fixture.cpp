// SPDX-License-Identifier: Apache-2.0
#include <render/render_fixture.hpp>

#include <fmt/format.h>

namespace brume::test {

TestScene::TestScene(int width, int height) {
    scene.image = {width, height, 1};
    scene.camera.position = dvec3(0, 0, -4);
    scene.camera.target = dvec3(0);
    scene.background.radiance = dvec3(0.3, 0.5, 0.7);
}

std::uint32_t TestScene::addMedium(const dvec3& extinction, const dvec3& albedo,
                                   const dvec3& emission) {
    scene::Medium medium;
    medium.extinction = extinction;
    medium.albedo = albedo;
    medium.emission = emission;
    scene.media.push_back(medium);
    return static_cast<std::uint32_t>(scene.media.size() - 1);
}

scene::MediumSphere& TestScene::addSphere(std::uint32_t medium, const dvec3& center, double radius,
                                          scene::Profile profile, double density) {
    scene::MediumSphere sphere;
    sphere.center = center;
    sphere.radius = static_cast<float>(radius);
    sphere.density = static_cast<float>(density);
    sphere.medium = medium;
    sphere.id = static_cast<std::uint32_t>(spheres.size());
    sphere.profile = profile;
    return spheres.emplace_back(sphere);
}

volumes::VolumeGrid& TestScene::addGrid(std::uint32_t medium, const dmat4& worldFromIndex) {
    scene.volumes.emplace_back().medium = medium;
    volumes.emplace_back().worldFromIndex = worldFromIndex;
    return volumes.back();
}

void TestScene::addBox(std::uint32_t medium, const dvec3& lo, const dvec3& hi, float value) {
    addGrid(medium).boxes.push_back({lo, hi, value, false});
}

std::uint32_t TestScene::addMaterial(const scene::Material& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

scene::Mesh& TestScene::addMesh(scene::Mesh mesh, std::uint32_t material,
                                const dmat4& worldFromObject) {
    mesh.material = material;
    scene::placeMesh(mesh, worldFromObject);
    return scene.meshes.emplace_back(std::move(mesh));
}

scene::Mesh& TestScene::addPane(std::uint32_t material, double z, double halfSize) {
    // The plane faces +y; turned about x it faces -z.
    const dmat4 turn = glm::rotate(dmat4(1), radians(-90), dvec3(1, 0, 0));
    return addMesh(scene::makePlane(dvec2(2 * halfSize)), material,
                   translation(dvec3(0, 0, z)) * turn);
}

scene::Light& TestScene::addLight(scene::LightType type, const dvec3& color) {
    scene::Light light;
    light.type = type;
    light.color = color;
    return scene.lights.emplace_back(light);
}

void TestScene::addDaylight() {
    addLight(scene::LightType::Ambient, dvec3(0.3, 0.4, 0.5));
    addLight(scene::LightType::Directional, dvec3(3, 2.5, 2)).direction =
        glm::normalize(dvec3(0.6, -0.7, 0.39));
}

scene::Material makeThin(double coverage, const dvec3& transmission, const dvec3& reflected) {
    scene::Material material;
    material.type = scene::MaterialType::Thin;
    material.coverage = coverage;
    material.transmission = transmission;
    material.reflected = reflected;
    return material;
}

scene::Material makeSolid(const dvec3& absorption, const dvec3& scattering) {
    scene::Material material;
    material.type = scene::MaterialType::Solid;
    material.absorption = absorption;
    material.scattering = scattering;
    return material;
}

scene::Material makeOpaque(const dvec3& albedo, const dvec3& emission) {
    scene::Material material;
    material.albedo = albedo;
    material.emission = emission;
    return material;
}

dmat4 translation(const dvec3& offset) { return glm::translate(dmat4(1), offset); }

void fillBricks(volumes::VolumeGrid& grid, int bricks,
                const std::function<float(const ivec3&)>& value) {
    using namespace volumes;
    for (int i = 0; i < bricks * bricks * bricks; ++i) {
        Brick brick;
        brick.origin = kBrickCells * ivec3(i % bricks, i / bricks % bricks, i / bricks / bricks);
        brick.valueOffset = static_cast<std::uint32_t>(grid.values.size());
        for (int k = 0; k < kBrickValueCount; ++k) {
            const ivec3 at(k % kBrickValues, k / kBrickValues % kBrickValues,
                           k / kBrickValues / kBrickValues);
            grid.values.push_back(value(brick.origin + at));
            brick.maxValue = std::max(brick.maxValue, grid.values.back());
        }
        grid.bricks.push_back(brick);
    }
}

float noiseAt(const ivec3& index) {
    const auto seed = static_cast<std::uint64_t>((index.x * 1000 + index.y) * 1000 + index.z);
    Random random(seed * 2654435761u + 12345);
    const double value = random.uniform(-0.4, 1);
    return static_cast<float>(std::max(value, 0.0));
}

render::Result RenderTest::render(const render::PreparedScene& scene, render::Options options) {
    render::Renderer renderer(device(), scene, options, log());
    return renderer.renderFrame();
}

std::uint64_t RenderTest::hashOf(const render::PreparedScene& scene,
                                 const scene::Settings& settings) {
    return computeHash(render(scene, {.method = "linked_list", .settings = settings}).image);
}

reference::Result RenderTest::renderReference(const render::PreparedScene& scene) const {
    return reference::render({scene.scene, scene.volumes, scene.spheres}, {.shadows = mWithShadows});
}

Difference RenderTest::measure(const render::PreparedScene& scene) {
    return measure(scene, renderReference(scene));
}

Difference RenderTest::measure(const render::PreparedScene& scene,
                               const reference::Result& expected) {
    render::Options options = mMethod;
    options.triangleHashes = true;
    const render::Result actual = render(scene, options);
    EXPECT_EQ(actual.counters.at("dropped"), 0u);
    EXPECT_EQ(actual.counters.at("exhausted"), 0u);

    Difference difference;
    double sum = 0;
    for (std::size_t i = 0; i < expected.image.pixels.size(); ++i) {
        if (actual.triangles[i] != expected.triangles[i]) {
            ++difference.excluded;
            continue;
        }
        const dvec3 a(actual.image.pixels[i]), b(expected.image.pixels[i]);
        if (!std::isfinite(a.x + a.y + a.z) || !std::isfinite(b.x + b.y + b.z)) {
            ++difference.nonFinite;
            continue;
        }
        const dvec3 d = glm::abs(a - b);
        const double largest = std::max({d.x, d.y, d.z});
        sum += glm::dot(d, d);
        difference.largest = std::max({difference.largest, b.x, b.y, b.z});
        if (largest <= difference.max) continue;
        difference.max = largest;
        difference.worst = ivec2(static_cast<int>(i) % expected.image.width,
                                 static_cast<int>(i) / expected.image.width);
    }
    difference.rmse = std::sqrt(sum / (3.0 * static_cast<double>(expected.image.pixels.size())));
    return difference;
}

void RenderTest::expectExact(const render::PreparedScene& scene, const std::string& name,
                             double maxError, double excludedShare) {
    SCOPED_TRACE(name);
    const Difference d = measure(scene);
    const double pixels = scene.scene.image.width * scene.scene.image.height;
    RecordProperty(name,
                   fmt::format("max {:.2e} rmse {:.2e} excluded {}", d.max, d.rmse, d.excluded));
    EXPECT_EQ(d.nonFinite, 0u);
    EXPECT_LE(d.max, maxError) << fmt::format("at ({}, {}), radiances up to {:.3g}, rmse {:.2e}",
                                              d.worst.x, d.worst.y, d.largest, d.rmse);
    EXPECT_LE(static_cast<double>(d.excluded), std::ceil(excludedShare * pixels));
}

}  // namespace brume::test
