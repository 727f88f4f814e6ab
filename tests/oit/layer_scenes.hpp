// SPDX-License-Identifier: Apache-2.0
// Scenes and measures that the tests of approximate methods share.
#pragma once

#include <render/render_fixture.hpp>

#include <span>
#include <string>
#include <vector>

namespace brume::test {

/// Full-screen panes in one mesh per material: `depths` are distances from an orthographic camera.
struct PaneScene : TestScene {
    explicit PaneScene(int size = 8, const dvec3& background = dvec3(1));
    /// Panes of one material at the given distances, drawn in their order.
    void addPanes(const scene::Material& material, std::span<const double> distances);
};

/// A thin surface that sends `radiance` whatever the light.
scene::Material makeGlowing(double coverage, const dvec3& radiance,
                            const dvec3& transmission = dvec3(0));

/// Overlapping smooth spheres of two colours before an opaque floor, all within the image.
TestScene makeSmoke(int size, int sphereCount);

/// Every kind of thing that a method must take, in one scene.
TestScene makeMixedScene(int size);

Image renderReferenceOf(const render::PreparedScene& scene);
double computeRmse(const Image& a, const Image& b);
dvec3 computeMean(const Image& image);

class FamilyTest : public RenderTest {
  protected:
    Image renderWith(const render::PreparedScene& scene, const std::string& method,
                     const scene::Settings& settings = {});
    /// Student's t-test of method stochastic's mean over twelve patterns against that of `truth`.
    /// `rounding`: by how much both may differ beside noise.
    void expectUnbiased(const render::PreparedScene& scene, scene::Settings settings,
                        const Image& truth, double rounding);
    /// Bits per pixel of the targets whose names begin with `prefix`, as --explain lists them.
    double countTargetBits(const render::PreparedScene& scene, const std::string& method,
                           const scene::Settings& settings, const std::string& prefix);
};

}  // namespace brume::test
