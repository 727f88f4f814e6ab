// SPDX-License-Identifier: Apache-2.0
// Glass that mirrors: energy, Fresnel's equations, and every method alike.
#include <oit/layer_scenes.hpp>

#include <fmt/format.h>

namespace brume::test {
namespace {

scene::Material makeMirroring(scene::Material material, double roughness, double ior = 1.5) {
    material.roughness = roughness;
    material.ior = ior;
    return material;
}

class Glass : public FamilyTest {};

TEST_F(Glass, WhiteFurnace_ReturnsOne) {
    // Transmission, reflection and mirror together lose nothing, at any angle.
    TestScene s(24, 24);
    s.scene.background.radiance = dvec3(1);
    s.addLight(scene::LightType::Ambient, dvec3(1));
    s.addPane(s.addMaterial(makeMirroring(makeThin(0.8, dvec3(0.7, 0.2, 1), dvec3(0.3, 0.8, 0)),
                                          0.3)),
              -1, 2);
    s.addMesh(scene::makeSphere(0.9, 24),
              s.addMaterial(makeMirroring(makeSolid(dvec3(0)), 0)), translation(dvec3(0.1)));
    for (const vec3& pixel : renderReferenceOf(s).pixels) EXPECT_NEAR(pixel.x, 1, 1e-6);
    for (const vec3& pixel : renderWith(s, "linked_list").pixels)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], 1, 1e-5);
}

TEST_F(Glass, Pane_MirrorsWhatFresnelSays) {
    // Perpendicular: F = ((n - 1) / (n + 1))^2 = 0.04, of a pane 2 F / (1 + F).
    PaneScene s(2, dvec3(1));
    s.addPanes(makeMirroring(makeThin(1, dvec3(0.5)), 0), std::vector{1.0});
    const double mirrored = 0.08 / 1.04;
    EXPECT_NEAR(renderWith(s, "linked_list").at(0, 0).x, mirrored + (1 - mirrored) * 0.5, 1e-5);
    EXPECT_NEAR(renderWith(s, "weighted").at(0, 0).x, mirrored + (1 - mirrored) * 0.5, 1e-5);
}

TEST_F(Glass, GrazingAngles_TransmitLess) {
    const auto transmitted = [&](double tilt) {
        PaneScene s(2, dvec3(0));
        s.addMesh(scene::makePlane(dvec2(200)),
                  s.addMaterial(makeMirroring(makeThin(1, dvec3(1)), 0)),
                  translation(dvec3(0, 0, 60)) *
                      glm::rotate(dmat4(1), radians(-90 + tilt), dvec3(1, 0, 0)));
        s.addPanes(makeOpaque(dvec3(0), dvec3(1)), std::vector{900.0});
        return renderWith(s, "linked_list").at(0, 0).x;
    };
    const float straight = transmitted(0), steep = transmitted(60), grazing = transmitted(80);
    EXPECT_NEAR(straight, 1 - 0.08 / 1.04, 1e-5);
    EXPECT_LT(steep, straight - 0.05);
    EXPECT_LT(grazing, steep - 0.2);
}

/// Shiny panes and balls among smoke under a sun and a lamp.
TestScene makeShiny(int size) {
    TestScene s(size, size);
    s.addDaylight();
    scene::Light& lamp = s.addLight(scene::LightType::Point, dvec3(3, 2, 1));
    lamp.position = dvec3(1, 1.5, -2);
    s.addSphere(s.addMedium(2, 0.8), dvec3(0.2, 0, 0.6), 0.7, scene::Profile::Smooth);
    s.addPane(s.addMaterial(makeMirroring(makeThin(1, dvec3(0.8, 0.5, 0.3), dvec3(0.1)), 0.4)),
              -0.6, 0.6);
    s.addMesh(scene::makeSphere(0.5, 32),
              s.addMaterial(makeMirroring(makeSolid(dvec3(0.5, 2, 1)), 0.3, 1.4)),
              translation(dvec3(0.5, -0.3, 0)));
    return s;
}

TEST_F(Glass, ShinyScene_IsExactInLinkedList) {
    expectExact(makeShiny(48), "shiny", 1e-4, 1e-2);
}

TEST_F(Glass, ShinyScene_ChangesEveryMethodAlike) {
    const TestScene s = makeShiny(16);
    TestScene matt = s;
    for (scene::Material& material : matt.scene.materials) material.roughness = -1;
    const dvec3 expected = computeMean(renderReferenceOf(s)) - computeMean(renderReferenceOf(matt));
    EXPECT_GT(glm::length(expected), 0.01);
    // Without order a mirror may hide behind what it stands before.
    for (const char* method : {"unordered", "sorted", "weighted", "stochastic", "moment", "peel",
                               "k_buffer", "tile"}) {
        const dvec3 change =
            computeMean(renderWith(s, method)) - computeMean(renderWith(matt, method));
        RecordProperty(method, fmt::format("{:.3e} of {:.3e}", glm::length(change - expected),
                                           glm::length(expected)));
        EXPECT_LT(glm::length(change - expected), 0.5 * glm::length(expected)) << method;
    }
}

}  // namespace
}  // namespace brume::test
