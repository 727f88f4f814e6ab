// SPDX-License-Identifier: Apache-2.0
// The exact renderer against formulas that can be written down.
#include <core/phase.hpp>
#include <reference/test_scene.hpp>

#include <gtest/gtest.h>

namespace brume::reference {
namespace {

constexpr double kTight = 1e-12;

void expectNear(const dvec3& actual, const dvec3& expected, double tolerance = kTight) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance) << "channel " << c;
}

TEST(ReferenceSlab, Absorbing_FollowsBeerLambert) {
    TestScene s;
    s.scene.background.radiance = dvec3(1, 2, 3);
    s.addBox(s.addMedium({0.5, 1, 20}), dvec3(-5, -5, 0), dvec3(5, 5, 2));
    const dvec3 T = glm::exp(-2.0 * dvec3(0.5, 1, 20));
    expectNear(s.trace().transmittance, T);
    expectNear(s.trace().radiance, T * s.scene.background.radiance);
    // Obliquely: longer by 1 / cos.
    const double length = glm::length(dvec3(0.3, 0.1, 1));
    expectNear(s.trace(dvec3(0, 0, -1), dvec3(0.3, 0.1, 1)).transmittance,
               glm::exp(-2.0 * length * dvec3(0.5, 1, 20)));
}

TEST(ReferenceSlab, EmittingOnly_GrowsWithLength) {
    TestScene s;
    s.addBox(s.addMedium(dvec3(0), dvec3(0), dvec3(1, 2, 3)), dvec3(-5, -5, 0), dvec3(5, 5, 2));
    expectNear(s.trace().radiance, dvec3(2, 4, 6));
}

TEST(ReferenceSlab, ThicknessFromFaintToOpaque_GivesTheSourceTimesOneMinusT) {
    for (const double extinction : {1e-10, 1e-6, 1e-3, 1.0, 30.0, 1e5, 1e30}) {
        TestScene s;
        s.addBox(s.addMedium(dvec3(extinction), dvec3(0), dvec3(extinction)), dvec3(-5, -5, 0),
                 dvec3(5, 5, 1));
        const RayResult r = s.trace();
        expectNear(r.radiance / -std::expm1(-extinction), dvec3(1));
        expectNear(r.transmittance, dvec3(std::exp(-extinction)), extinction > 100 ? 0 : kTight);
    }
}

TEST(ReferenceSolid, GlassBox_FollowsBeerLambertFromAnySide) {
    TestScene s;
    s.scene.background.radiance = dvec3(1);
    scene::Material glass;
    glass.type = scene::MaterialType::Solid, glass.absorption = dvec3(1, 0.2, 3);
    const std::uint32_t material = s.addMaterial(glass);
    s.addClosedBox(material, dvec3(-1, -1, 0), dvec3(1, 1, 2));
    expectNear(s.trace().radiance, glm::exp(-2.0 * glass.absorption));
    // From within: only what is left of it; mirrored: inside stays inside.
    expectNear(s.trace(dvec3(0.1, 0.2, 1.5)).radiance, glm::exp(-0.5 * glass.absorption));
    s.scene.meshes[0].worldFromObject = glm::scale(dmat4(1), dvec3(-1, 1, 1));
    std::vector<std::uint32_t>& indices = s.scene.meshes[0].indices;  // wound in the world
    for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
    expectNear(s.trace(dvec3(0.1, 0.2, -3)).radiance, glm::exp(-2.0 * glass.absorption));
    // Exactly through edges and corners: entered as often as left.
    for (const dvec2 xy : {dvec2(0, 0), dvec2(1, 0), dvec2(-1, -1), dvec2(1, 1), dvec2(0.5, 0.5)}) {
        const double T = s.trace(dvec3(xy, -3)).transmittance.x;
        EXPECT_TRUE(std::abs(T - std::exp(-2)) < kTight || T == 1)
            << xy.x << " " << xy.y << " " << T;
    }
}

TEST(ReferenceSolid, BehindAnOpaqueWall_InsideIsStillKnown) {
    TestScene s;
    scene::Material glass, wall;
    glass.type = scene::MaterialType::Solid, glass.absorption = dvec3(1);
    wall.emission = dvec3(1), wall.albedo = dvec3(0);
    s.addClosedBox(s.addMaterial(glass), dvec3(-1, -1, 0), dvec3(1, 1, 2));
    s.addPane(s.addMaterial(wall), 1.25);
    expectNear(s.trace(dvec3(0, 0, 1)).radiance, dvec3(std::exp(-0.25)));
}

TEST(ReferenceSphere, ConstantDensity_FollowsTheChord) {
    TestScene s;
    s.addSphere(s.addMedium(dvec3(2)), dvec3(0.3, 0, 0), 1);
    const double chord = 2 * std::sqrt(1 - 0.09);
    expectNear(s.trace().transmittance, dvec3(std::exp(-2 * chord)));
    // Far away, small, off the origin.
    TestScene far;
    far.addSphere(far.addMedium(dvec3(100)), dvec3(1e3, 0, 0), 0.0078125);
    expectNear(far.trace(dvec3(1e3, 0.00390625, -1e3)).transmittance,
               dvec3(std::exp(-100 * 2 * 0.0078125 * std::sqrt(0.75))), 1e-10);
}

TEST(ReferenceSphere, SmoothDensity_FollowsTheChordIntegral) {
    TestScene s;
    s.addSphere(s.addMedium(dvec3(3)), dvec3(0.25, 0.5, 0), 1.5, scene::Profile::Smooth, 2);
    // Integral of (1 - r^2/R^2)^2 over the chord of half length h: 16/15 h^5 / R^4.
    const double h = std::sqrt(2.25 - 0.3125), R4 = 2.25 * 2.25;
    expectNear(s.trace().transmittance, dvec3(std::exp(-6 * 16.0 / 15 * std::pow(h, 5) / R4)));
    // From the middle of the chord: half of it.
    expectNear(s.trace(dvec3(0)).transmittance,
               dvec3(std::exp(-3 * 16.0 / 15 * std::pow(h, 5) / R4)));
}

TEST(ReferenceSphere, TwoOverlapping_AddUpSegmentBySegment) {
    TestScene s;
    const dvec3 k1(1, 2, 0.5), k2(3, 0.1, 1), j1(1, 0, 0.5), j2(0, 2, 1);
    s.addSphere(s.addMedium(k1, dvec3(0), j1), dvec3(0, 0, 0), 1);
    s.addSphere(s.addMedium(k2, dvec3(0), j2), dvec3(0, 0, 1), 1);
    s.scene.background.radiance = dvec3(0.7);
    dvec3 L(0), T(1);
    const auto pass = [&](const dvec3& k, const dvec3& j) {  // a segment of length 1
        L += T * j / k * (1.0 - glm::exp(-k));
        T *= glm::exp(-k);
    };
    pass(k1, j1), pass(k1 + k2, j1 + j2), pass(k2, j2);
    const RayResult r = s.trace();
    expectNear(r.radiance, L + 0.7 * T, 1e-11);
    expectNear(r.transmittance, T);
}

TEST(ReferenceThin, TwoPanes_FollowTheOverOperator) {
    TestScene s;
    s.scene.background.radiance = dvec3(1, 0.5, 0.25);
    scene::Material front, back;
    front.type = back.type = scene::MaterialType::Thin;
    front.coverage = 0.5, front.transmission = dvec3(0.2, 0.4, 0.6), front.emission = dvec3(0.3);
    back.coverage = 0.25, back.reflected = dvec3(0.5), back.transmission = dvec3(0.1);
    s.addPane(s.addMaterial(front), 0);
    s.addPane(s.addMaterial(back), 1);
    s.addLight(scene::LightType::Ambient, dvec3(2));
    const auto over = [](const dvec3& L, double a, const dvec3& Lr, const dvec3& t) {
        return a * (Lr + t * L) + (1 - a) * L;
    };
    const dvec3 behind = over(s.scene.background.radiance, 0.25, dvec3(0.5 * 2), dvec3(0.1));
    expectNear(s.trace(dvec3(0.1, 0.2, -3)).radiance,
               over(behind, 0.5, front.emission, front.transmission));
}

TEST(ReferenceOpaque, Lambert_ReflectsIrradianceOverPi) {
    TestScene s;
    scene::Material wall;
    wall.albedo = dvec3(0.5, 0.25, 1), wall.emission = dvec3(0.01);
    s.addPane(s.addMaterial(wall), 2);
    s.addLight(scene::LightType::Ambient, dvec3(0.1));
    s.addLight(scene::LightType::Directional, dvec3(3), true).direction =
        glm::normalize(dvec3(1, 0, 1));
    scene::Light& point = s.addLight(scene::LightType::Point, dvec3(7), true);
    point.position = dvec3(0, 0, -1);
    scene::Light& spot = s.addLight(scene::LightType::Spot, dvec3(100), true);
    spot.position = dvec3(0, 0, -1), spot.direction = dvec3(0, 1, 0);  // looks elsewhere
    const double illumination = 0.1 + 3 / std::sqrt(2) / kPi + 7 / 9.0 / kPi;
    expectNear(s.trace().radiance, wall.albedo * illumination + wall.emission);
    // A pane that covers half in front of the lamp takes half of it away; the ray starts behind it.
    scene::Material pane;
    pane.type = scene::MaterialType::Thin, pane.coverage = 0.5;
    s.addPane(s.addMaterial(pane), 0);
    expectNear(s.trace(dvec3(0, 0, 1)).radiance,
               wall.albedo * (0.1 + 0.5 * (illumination - 0.1)) + wall.emission);
}

/// A slab 0 < z < 1 of extinction k and albedo w, lit by a sun and seen along +z.
struct LitSlab : TestScene {
    LitSlab(double k, double w, scene::PhaseType phase, double g, bool isShadowed,
            const dvec3& direction) {
        const std::uint32_t medium = addMedium(dvec3(k), dvec3(w));
        scene.media[medium].phase = phase, scene.media[medium].g = g;
        addBox(medium, dvec3(-100, -100, 0), dvec3(100, 100, 1));
        addLight(scene::LightType::Directional, dvec3(2), isShadowed).direction =
            glm::normalize(direction);
    }
};

TEST(ReferenceSingleScattering, UnshadowedSlab_IsPhaseTimesOneMinusT) {
    const dvec3 direction(0.6, 0, 0.8);  // travels away from the viewer: backward scattering
    const double k = 1.5, w = 0.8, E = 2, base = E * w * (1 - std::exp(-k));
    const double isotropic =
        LitSlab(k, w, scene::PhaseType::Isotropic, 0, false, direction).trace().radiance.x;
    EXPECT_NEAR(isotropic, base * phaseIsotropic<double>(), kTight);
    const double rayleigh =
        LitSlab(k, w, scene::PhaseType::Rayleigh, 0, false, direction).trace().radiance.x;
    EXPECT_NEAR(rayleigh, base * phaseRayleigh(-0.8), kTight);
    const double hg =
        LitSlab(k, w, scene::PhaseType::HenyeyGreenstein, 0.7, false, direction).trace().radiance.x;
    EXPECT_NEAR(hg, base * phaseHenyeyGreenstein(-0.8, 0.7), kTight);
    EXPECT_LT(hg, isotropic);
}

TEST(ReferenceSingleScattering, ShadowedSlab_FollowsTheDoubleExponential) {
    for (const double k : {1e-3, 1.0, 10.0, 300.0}) {
        // With the view: light and view both pass z, integral of k e^(-k z (1 + 1/mu)).
        const double mu = 0.8, p = phaseIsotropic<double>();
        const double in = LitSlab(k, 1, scene::PhaseType::Isotropic, 0, true, dvec3(0.6, 0, mu))
                              .trace()
                              .radiance.x;
        EXPECT_NEAR(in, 2 * p / (1 + 1 / mu) * -std::expm1(-k * (1 + 1 / mu)), 1e-9) << k;
        // Against the view: light passes 1 - z; straight through it is k e^-k.
        const double out =
            LitSlab(k, 1, scene::PhaseType::Isotropic, 0, true, dvec3(0, 0, -1)).trace().radiance.x;
        EXPECT_NEAR(out, 2 * p * k * std::exp(-k), 1e-9) << k;
    }
}

TEST(ReferenceSingleScattering, ShadowOfAnOpaqueEdge_DarkensItsPartOfTheRay) {
    LitSlab s(1, 1, scene::PhaseType::Isotropic, 0, true, dvec3(0, -1, 0));
    s.volumes[0].boxes[0].lo.y = -0.001, s.volumes[0].boxes[0].hi.y = 0.001;
    scene::Material wall;
    s.addClosedBox(s.addMaterial(wall), dvec3(-1, 1, 0.3), dvec3(1, 2, 0.55));
    const double k = 1, T = std::exp(-k * 0.001), p = phaseIsotropic<double>();
    const double lit = std::exp(-0.0) - std::exp(-0.3) + std::exp(-0.55) - std::exp(-1.0);
    EXPECT_NEAR(s.trace().radiance.x, 2 * p * T * lit, 1e-7);
}

TEST(ReferenceSingleScattering, PointLightInThinAir_FollowsTheArcTangent) {
    // Faint medium, no absorption to speak of: integral of I / (d^2 + z^2) dz.
    TestScene s;
    s.addBox(s.addMedium(dvec3(1e-9), dvec3(1)), dvec3(-100, -100, 0), dvec3(100, 100, 10));
    scene::Light& light = s.addLight(scene::LightType::Point, dvec3(1e9));
    for (const double d : {2.0, 0.05, 1e-3}) {
        light.position = dvec3(d, 0, 4), light.radius = 1e-6;
        const double expected =
            phaseIsotropic<double>() / d * (std::atan(6 / d) + std::atan(4 / d));
        EXPECT_NEAR(s.trace().radiance.x / expected, 1, 1e-8) << d;
    }
    // Straight through the light: constant inside its radius, 1 / z^2 outside.
    light.position = dvec3(0, 0, 4), light.radius = 0.5;
    const double expected = phaseIsotropic<double>() * (4 + 1 / 0.5 - 1 / 4.0 + 1 / 0.5 - 1 / 6.0);
    EXPECT_NEAR(s.trace().radiance.x / expected, 1, 1e-8);
}

TEST(ReferenceTransmittance, SegmentThroughEverything_Multiplies) {
    TestScene s;
    scene::Material pane, glass, wall;
    pane.type = scene::MaterialType::Thin, pane.coverage = 0.5, pane.transmission = dvec3(0.5);
    glass.type = scene::MaterialType::Solid, glass.absorption = dvec3(0.3);
    s.addBox(s.addMedium(dvec3(0.1)), dvec3(-5, -5, 0), dvec3(5, 5, 2));
    s.addPane(s.addMaterial(pane), 3);
    s.addClosedBox(s.addMaterial(glass), dvec3(-1, -1, 4), dvec3(1, 1, 6));
    s.addPane(s.addMaterial(wall), 8);
    const auto T = [&](double z) {
        return transmittance(s.input(), dvec3(0.1, 0.3, -1), dvec3(0.1, 0.3, z)).x;
    };
    EXPECT_NEAR(T(-0.5), 1, 0);
    EXPECT_NEAR(T(1), std::exp(-0.1), kTight);
    EXPECT_NEAR(T(3.5), std::exp(-0.2) * 0.75, kTight);
    EXPECT_NEAR(T(5), std::exp(-0.5) * 0.75, kTight);
    EXPECT_NEAR(T(7), std::exp(-0.8) * 0.75, kTight);
    EXPECT_EQ(T(9), 0);
}

}  // namespace
}  // namespace brume::reference
