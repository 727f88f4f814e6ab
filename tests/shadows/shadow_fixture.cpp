// SPDX-License-Identifier: Apache-2.0
#include <reference/tracer.hpp>
#include <shadows/shadow_fixture.hpp>

namespace brume::test {

std::vector<vec3> ShadowTest::probe(const render::PreparedScene& scene,
                                    std::span<const dvec3> points,
                                    const scene::Settings& settings) {
    render::Options options{.method = "unordered", .settings = {{"shadow.resolution", "256"}}};
    for (const auto& [key, value] : settings) options.settings["shadow." + key] = value;
    return render::Renderer(device(), scene, options, log()).probeShadows(0, points).values;
}

std::vector<dvec3> ShadowTest::computeExact(const render::PreparedScene& scene,
                                            std::span<const dvec3> points) const {
    const reference::Input input{scene.scene, scene.volumes, scene.spheres};
    const reference::Tracer tracer(input);
    const scene::Light& light = scene.scene.lights.front();
    std::vector<dvec3> exact;
    for (const dvec3& point : points)
        exact.push_back(tracer.transmittance(point, light.type == scene::LightType::Directional
                                                        ? point - 1e4 * light.direction
                                                        : light.position));
    return exact;
}

ProbeError ShadowTest::measureError(const render::PreparedScene& scene,
                                    std::span<const dvec3> points,
                                    const scene::Settings& settings) {
    const std::vector<vec3> values = probe(scene, points, settings);
    const std::vector<dvec3> exact = computeExact(scene, points);
    ProbeError error;
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double value = values[i][c], d = value - exact[i][c];
            if (!(value >= 0 && value <= 1)) ++error.outOfRange;
            sum += d * d;
            error.bias += d / (3.0 * static_cast<double>(points.size()));
            error.max = std::max(error.max, std::abs(d));
        }
    error.rms = std::sqrt(sum / (3.0 * static_cast<double>(points.size())));
    return error;
}

std::vector<dvec3> scatterPoints(std::uint64_t seed, int count, const dvec3& lo, const dvec3& hi) {
    Random random(seed);
    std::vector<dvec3> points;
    for (int i = 0; i < count; ++i) points.push_back(lo + (hi - lo) * random.vector());
    return points;
}

scene::Light& addSun(TestScene& scene, const std::string& shadow, const dvec3& direction) {
    scene::Light& light = scene.addLight(scene::LightType::Directional, dvec3(3));
    light.direction = glm::normalize(direction);
    light.shadow = shadow;
    return light;
}

}  // namespace brume::test
