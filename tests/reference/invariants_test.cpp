// SPDX-License-Identifier: Apache-2.0
// What must not change the image: splitting, order, units, halving a density; and bounds that
// always hold.
#include <core/error.hpp>
#include <reference/test_scene.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace brume::reference {
namespace {

/// Spheres of three media (one smooth) crowded around the z axis, some with tints.
TestScene makeCrowd(int count, std::uint32_t seed, const dvec3& albedo = dvec3(0.3, 0.5, 0.9)) {
    TestScene s;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit;
    for (int m = 0; m < 3; ++m)
        s.addMedium(dvec3(unit(random), unit(random), unit(random)) * std::pow(10, m - 1), albedo,
                    dvec3(unit(random)));
    s.scene.media[1].phase = scene::PhaseType::Rayleigh;
    for (int i = 0; i < count; ++i) {
        const dvec3 center(unit(random) - 0.5, unit(random) - 0.5, 4 * unit(random));
        s.addSphere(static_cast<std::uint32_t>(i % 3), center, 0.2 + 0.6 * unit(random),
                    i % 2 ? scene::Profile::Smooth : scene::Profile::Constant, 1 + unit(random));
        if (i % 5 == 0) s.spheres.back().tint = vec3(1, 0.5, 0.25);
    }
    s.addLight(scene::LightType::Ambient, dvec3(0.4));
    s.addLight(scene::LightType::Directional, dvec3(2, 1, 0.5));
    s.scene.background.radiance = dvec3(0.2, 0.6, 1);
    return s;
}

void expectSame(const RayResult& a, const RayResult& b, double tolerance) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a.radiance[c], b.radiance[c], tolerance);
        EXPECT_NEAR(a.transmittance[c], b.transmittance[c], tolerance);
    }
}

/// Runs a check on a few rays that are not parallel to anything.
template <class Check>
void forRays(Check&& check) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-0.3, 0.3);
    for (int i = 0; i < 20; ++i)
        check(dvec3(unit(random), unit(random), i % 4 ? -3 : 1.5),
              glm::normalize(dvec3(unit(random), unit(random), 1)));
}

TEST(ReferenceInvariant, OrderOfSubmission_ChangesNothing) {
    const TestScene s = makeCrowd(40, 1);
    TestScene shuffled = s;
    std::shuffle(shuffled.spheres.begin(), shuffled.spheres.end(), std::mt19937(5));
    forRays([&](const dvec3& o, const dvec3& d) {
        expectSame(s.trace(o, d), shuffled.trace(o, d), 1e-13);
    });
}

TEST(ReferenceInvariant, TwoHalfDensities_EqualOne) {
    const TestScene s = makeCrowd(40, 2);
    TestScene halves = s;
    for (scene::MediumSphere& sphere : halves.spheres) sphere.density *= 0.5f;
    halves.spheres.insert(halves.spheres.end(), halves.spheres.begin(), halves.spheres.end());
    forRays([&](const dvec3& o, const dvec3& d) {
        expectSame(s.trace(o, d), halves.trace(o, d), 1e-11);
    });
}

TEST(ReferenceInvariant, SplitByInvisibleBoundaries_ChangesNothing) {
    const TestScene s = makeCrowd(30, 3);
    TestScene split = s;
    const std::uint32_t nothing = split.addMedium(dvec3(0));
    for (int i = 0; i < 50; ++i)
        split.addSphere(nothing, dvec3(0.1, 0.1, 0.1 * i), 0.7, scene::Profile::Smooth);
    scene::Material glass;
    glass.type = scene::MaterialType::Thin, glass.coverage = 0;
    const std::uint32_t material = split.addMaterial(glass);
    for (int i = 0; i < 9; ++i) split.addPane(material, 0.5 * i);
    forRays([&](const dvec3& o, const dvec3& d) {
        expectSame(s.trace(o, d), split.trace(o, d), 1e-9);
    });
}

TEST(ReferenceInvariant, LengthsTimesK_ExtinctionOverK_ChangeNothing) {
    const TestScene s = makeCrowd(30, 4);
    for (const double k : {1.0 / 1024, 1024.0}) {
        TestScene scaled = s;
        for (scene::Medium& medium : scaled.scene.media)
            medium.extinction /= k, medium.emission /= k;
        for (scene::MediumSphere& sphere : scaled.spheres)
            sphere.center *= k, sphere.radius *= static_cast<float>(k);
        forRays([&](const dvec3& o, const dvec3& d) {
            expectSame(s.trace(o, d), scaled.trace(k * o, d), 1e-12);
        });
    }
}

TEST(ReferenceInvariant, WhiteFurnace_ReturnsOne) {
    TestScene s = makeCrowd(60, 6, dvec3(1));
    for (scene::Medium& medium : s.scene.media) medium.emission = dvec3(0);
    for (scene::MediumSphere& sphere : s.spheres) sphere.tint = vec3(1);
    s.scene.lights.resize(1);
    s.scene.lights[0].color = s.scene.background.radiance = dvec3(1);
    scene::Material pane, glass;
    pane.type = scene::MaterialType::Thin, pane.coverage = 0.7;
    pane.transmission = dvec3(0.4, 0.5, 0.6), pane.reflected = 1.0 - pane.transmission;
    s.addPane(s.addMaterial(pane), 2);
    glass.type = scene::MaterialType::Solid, glass.scattering = dvec3(3, 2, 1);
    s.addClosedBox(s.addMaterial(glass), dvec3(-0.5, -0.5, 1), dvec3(0.5, 0.5, 2.5));
    fillBricks(s.addGrid(0), 1, [](const ivec3& i) { return 0.1f * static_cast<float>(i.x); });
    forRays([&](const dvec3& o, const dvec3& d) {
        const dvec3 L = s.trace(o, d).radiance;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(L[c], 1, 1e-12);
    });
}

TEST(ReferenceInvariant, Transmittance_FallsFromOneToZero) {
    const TestScene s = makeCrowd(60, 7);
    const Tracer tracer = s.tracer();
    forRays([&](const dvec3& o, const dvec3& d) {
        dvec3 last(1);
        for (int i = 0; i <= 40; ++i) {
            const dvec3 T = tracer.transmittance(o, o + 0.2 * i * d);
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(T[c], last[c] + 1e-13);
                EXPECT_GE(T[c], 0);
            }
            last = T;
        }
        // The view ray sees the same.
        const dvec3 whole = tracer.integrateRay({o, d}).transmittance;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(whole[c], last[c], 1e-12);
    });
}

TEST(ReferenceInvariant, CameraInside_SeesTheRestOfTheRay) {
    // What the camera sees from p is what it sees from further back, without the part in front of
    // p.
    const TestScene s = makeCrowd(40, 8);
    const Tracer tracer = s.tracer();
    forRays([&](const dvec3& o, const dvec3& d) {
        TestScene screened = s;  // an opaque wall at p; vertices are float
        const dvec3 p = o + (static_cast<float>(o.z + 1.1) - o.z) / d.z * d;
        const RayResult whole = tracer.integrateRay({o, d}), rest = tracer.integrateRay({p, d});
        scene::Material black;
        black.albedo = dvec3(0);
        screened.addPane(screened.addMaterial(black), p.z);
        const RayResult front = screened.trace(o, d);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(whole.radiance[c],
                        front.radiance[c] + front.transmittance[c] * rest.radiance[c], 1e-9);
            EXPECT_NEAR(whole.transmittance[c], front.transmittance[c] * rest.transmittance[c],
                        1e-12);
        }
    });
}

TEST(ReferenceRender, SameInput_GivesTheSameBitsAndTriangles) {
    TestScene s = makeCrowd(50, 9);
    scene::Material pane;
    pane.type = scene::MaterialType::Thin, pane.coverage = 0.5;
    s.addPane(s.addMaterial(pane), 1.5, 0.3);
    s.addPane(s.addMaterial({}), 3, 0.5);
    s.scene.camera.position = dvec3(0, 0, -4), s.scene.camera.target = dvec3(0);
    s.scene.image = {40, 30, 2};
    const Result a = render(s.input()), b = render(s.input());
    EXPECT_EQ(computeHash(a.image), computeHash(b.image));
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.triangles[0], 0u);
    EXPECT_NE(a.triangles[15 * 40 + 20], 0u);
}

TEST(ReferenceRender, EveryThirdPixel_IsThatOfTheWholeImage) {
    TestScene s = makeCrowd(20, 4);
    s.addPane(s.addMaterial({}), 3, 0.5);
    s.scene.camera.position = dvec3(0, 0, -4), s.scene.camera.target = dvec3(0);
    s.scene.image = {16, 11, 1};
    const Result whole = render(s.input()), few = render(s.input(), {.every = 3});
    ASSERT_EQ(ivec2(few.image.width, few.image.height), ivec2(6, 4));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            const int wholeX = std::min(3 * x + 1, 15), wholeY = std::min(3 * y + 1, 10);
            EXPECT_EQ(few.image.at(x, y), whole.image.at(wholeX, wholeY));
            EXPECT_EQ(few.triangles[6 * y + x], whole.triangles[16 * wholeY + wholeX]);
        }
    const Options none{.every = 0};
    EXPECT_THROW(render(s.input(), none), Error);
}

TEST(ReferenceRender, TrianglesNearerThanNear_AreNotSeen) {
    TestScene s;
    scene::Material wall;
    wall.emission = dvec3(1);
    s.addPane(s.addMaterial(wall), 1);
    s.scene.camera.position = dvec3(0, 0, 0), s.scene.camera.target = dvec3(0, 0, 1);
    s.scene.image = {3, 3, 1};
    s.scene.camera.near = 0.999;
    EXPECT_EQ(render(s.input()).image.at(0, 0).x, 1);
    s.scene.camera.near = 1.001;  // view depth, not distance: the corners vanish with the middle
    EXPECT_EQ(render(s.input()).image.at(0, 0).x, 0);
    EXPECT_EQ(render(s.input()).image.at(1, 1).x, 0);
}

}  // namespace
}  // namespace brume::reference
