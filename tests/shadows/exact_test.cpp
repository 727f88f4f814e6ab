// SPDX-License-Identifier: Apache-2.0
// Shadow store `exact` against the reference in double precision.
#include <reference/reference.hpp>
#include <shadows/shadow_fixture.hpp>

namespace brume::test {
namespace {

/// Smooth and constant spheres, bricks, a box of gas, two panes, a glass ball and an opaque plank.
void addEverything(TestScene& s) {
    const std::uint32_t smoke = s.addMedium(dvec3(1.5, 2, 2.5), dvec3(0.8));
    const std::uint32_t haze = s.addMedium(0.6);
    Random random(7);
    for (int i = 0; i < 20; ++i)
        s.addSphere(i % 2 ? smoke : haze, random.vector(-1, 1), random.uniform(0.1, 0.5),
                    i % 3 ? scene::Profile::Smooth : scene::Profile::Constant);
    volumes::VolumeGrid& grid =
        s.addGrid(smoke, glm::rotate(glm::scale(translation(dvec3(-0.6)), dvec3(0.08, 0.07, 0.09)),
                                     0.3, dvec3(0, 1, 0)));
    fillBricks(grid, 2, noiseAt);
    s.addBox(haze, dvec3(-0.9, -0.4, -0.9), dvec3(-0.2, 0.3, 0.9));
    s.addPane(s.addMaterial(makeThin(0.8, dvec3(0.9, 0.3, 0.1))), 0.2, 0.6);
    s.addPane(s.addMaterial(makeThin(1, dvec3(0.2, 0.8, 0.6))), -0.3, 0.4);
    s.addMesh(scene::makeSphere(0.4, 16), s.addMaterial(makeSolid(dvec3(0.5, 1, 2))),
              translation(dvec3(0.4, 0.3, 0.1)));
    s.addMesh(scene::makeBox(dvec3(0.5, 0.05, 0.3)), s.addMaterial(makeOpaque(dvec3(0.5))),
              translation(dvec3(-0.5, 0.7, 0)));
}

class ShadowExact : public ShadowTest {
  protected:
    /// Points in all of the scene. A ray within rounding of an edge may pass it on either side.
    void expectExact(const TestScene& s) {
        const std::vector<dvec3> points = scatterPoints(11, 3000, dvec3(-1.2), dvec3(1.2));
        const std::vector<vec3> values = probe(s, points);
        const std::vector<dvec3> exact = computeExact(s, points);
        int wrong = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const dvec3 d = glm::abs(dvec3(values[i]) - exact[i]);
            if (!(std::max({d.x, d.y, d.z}) <= 1e-5)) ++wrong;
        }
        EXPECT_LE(wrong, 1);
    }
};

TEST_F(ShadowExact, Directional_EqualsReference) {
    TestScene s;
    addSun(s, "exact");
    addEverything(s);
    expectExact(s);
}

TEST_F(ShadowExact, PointLightInTheMiddle_EqualsReference) {
    TestScene s;
    s.addLight(scene::LightType::Point, dvec3(1)).shadow = "exact";
    s.scene.lights[0].position = dvec3(0.05, -0.1, -0.6);
    addEverything(s);
    expectExact(s);
}

TEST_F(ShadowExact, Spot_EqualsReference) {
    TestScene s;
    scene::Light& spot = s.addLight(scene::LightType::Spot, dvec3(1));
    spot.shadow = "exact";
    spot.position = dvec3(1, 3, -1);
    spot.direction = glm::normalize(-spot.position);
    spot.innerAngle = radians(30);
    spot.outerAngle = radians(45);
    addEverything(s);
    expectExact(s);
}

TEST_F(ShadowExact, LitImage_EqualsReference) {
    TestScene s(16, 16);
    s.addLight(scene::LightType::Ambient, dvec3(0.2));
    scene::Light sun = addSun(s, "exact");
    const std::uint32_t smoke = s.addMedium(dvec3(1, 2, 3), dvec3(0.9));
    s.addSphere(smoke, dvec3(0, 0.4, 0), 0.5, scene::Profile::Smooth);
    s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeOpaque(dvec3(0.6))),
              translation(dvec3(0, -0.7, 0)));
    const render::Result actual = render(s, {.triangleHashes = true});
    const reference::Result expected = reference::render({s.scene, s.volumes, s.spheres});
    double largest = 0;
    for (std::size_t i = 0; i < expected.image.pixels.size(); ++i) {
        if (actual.triangles[i] != expected.triangles[i]) continue;
        const dvec3 d = glm::abs(dvec3(actual.image.pixels[i]) - dvec3(expected.image.pixels[i]));
        largest = std::max({largest, d.x, d.y, d.z});
    }
    EXPECT_LE(largest, 1e-4);
    EXPECT_EQ(actual.counters.at("exhausted"), 0u);
}

}  // namespace
}  // namespace brume::test
