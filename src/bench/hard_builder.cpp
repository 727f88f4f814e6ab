// SPDX-License-Identifier: Apache-2.0
#include <bench/hard_builder.hpp>

namespace brume::bench {

HardBuilder::HardBuilder(const dvec3& eye, const dvec3& target) : Builder(eye, target, 40) {
    constexpr int kSize = 48;
    scene.image = {kSize, kSize, 1};
    scene.background.radiance = dvec3(0.2, 0.3, 0.4);
    addAmbient(dvec3(0.5));
}

std::uint32_t HardBuilder::addEmitter(double extinction, const dvec3& emission) {
    const std::uint32_t medium = addMedium(extinction, dvec3(0));
    scene.media[medium].emission = emission;
    return medium;
}

void HardBuilder::addBall(std::uint32_t medium, const dvec3& center, double radius, double density) {
    addSphere(medium, center, radius, density);
    scene.spheres.back().profile = scene::Profile::Constant;
}

void HardBuilder::addSun(const dvec3& direction, const dvec3& irradiance) {
    scene::Light sun;
    sun.type = scene::LightType::Directional;
    sun.direction = direction;
    sun.color = irradiance;
    scene.lights.push_back(sun);
}

}  // namespace brume::bench
