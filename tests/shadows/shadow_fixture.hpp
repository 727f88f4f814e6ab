// SPDX-License-Identifier: Apache-2.0
// Shadow maps asked at points and compared with the exact transmittance.
#pragma once

#include <render/render_fixture.hpp>

#include <string>
#include <vector>

namespace brume::test {

/// How far a store is from the exact transmittance at points, over all channels.
struct ProbeError {
    double rms = 0, max = 0, bias = 0;
    std::uint64_t outOfRange = 0;  ///< not in [0, 1], or not finite
};

class ShadowTest : public RenderTest {
  protected:
    /// What the first light's map says at the points. `settings`: of the maps.
    std::vector<vec3> probe(const render::PreparedScene& scene, std::span<const dvec3> points,
                            const scene::Settings& settings = {});
    /// The exact transmittance from each point to the first light.
    std::vector<dvec3> computeExact(const render::PreparedScene& scene,
                                    std::span<const dvec3> points) const;
    ProbeError measureError(const render::PreparedScene& scene, std::span<const dvec3> points,
                            const scene::Settings& settings = {});
};

/// `count` points evenly in a box.
std::vector<dvec3> scatterPoints(std::uint64_t seed, int count, const dvec3& lo, const dvec3& hi);

/// A sun with that shadow; the first light of the scene.
scene::Light& addSun(TestScene& scene, const std::string& shadow,
                     const dvec3& direction = {0.3, -0.9, 0.2});

}  // namespace brume::test
