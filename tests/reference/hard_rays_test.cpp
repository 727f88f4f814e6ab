// SPDX-License-Identifier: Apache-2.0
// Rays that break careless arithmetic, against closed forms and an independent integration in
// extended precision.
#include <reference/test_scene.hpp>

#include <gtest/gtest.h>

#include <random>

namespace brume::reference {
namespace {

constexpr double kAccuracy = 1e-7;

bool isFinite(const RayResult& r) {
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(r.radiance[c]) || !(r.transmittance[c] >= 0 && r.transmittance[c] <= 1))
            return false;
    return true;
}

/// Density of a sphere at distance t along +z from `origin`, from the position and not from the
/// chord.
long double densityAt(const scene::MediumSphere& sphere, const dvec3& origin, long double t) {
    const long double x = static_cast<long double>(origin.x) - sphere.center.x;
    const long double y = static_cast<long double>(origin.y) - sphere.center.y;
    const long double z = static_cast<long double>(origin.z) + t - sphere.center.z;
    const long double R = sphere.radius, q = 1 - (x * x + y * y + z * z) / (R * R);
    if (q <= 0) return 0;
    return sphere.density * (sphere.profile == scene::Profile::Smooth ? q * q : 1);
}

/// Integrates channel 0 of the spheres of a scene without lights along +z.
BruteForce integrateSpheres(const TestScene& s, const dvec3& origin, int steps) {
    std::vector<double> breaks{0};
    for (const scene::MediumSphere& sphere : s.spheres) {
        const double x = origin.x - sphere.center.x, y = origin.y - sphere.center.y;
        const double half2 = double(sphere.radius) * sphere.radius - x * x - y * y;
        if (half2 <= 0) continue;
        for (const double t : {-std::sqrt(half2), std::sqrt(half2)})
            if (sphere.center.z + t > origin.z) breaks.push_back(sphere.center.z + t - origin.z);
    }
    BruteForce sum;
    sum.integrate(
        [&](long double t) {
            Local local;
            for (const scene::MediumSphere& sphere : s.spheres) {
                const scene::Medium& medium = s.scene.media[sphere.medium];
                const long double density = densityAt(sphere, origin, t);
                local.extinction += density * medium.extinction.x;
                local.light += density * medium.emission.x * sphere.tint.x;
            }
            return local;
        },
        breaks, steps);
    return sum;
}

/// `count` spheres around the z axis, all of which contain the point (0, 0, 1).
TestScene makePile(int count, double minExtinction, double maxExtinction, bool withSmooth,
                   std::uint32_t seed) {
    TestScene s;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit;
    for (int i = 0; i < count; ++i) {
        const double extinction =
            minExtinction * std::pow(maxExtinction / minExtinction, unit(random));
        const std::uint32_t medium =
            s.addMedium(dvec3(extinction), dvec3(0), dvec3(extinction * unit(random)));
        const double radius = 0.3 + unit(random);
        const dvec3 offset =
            0.5 * radius *
            dvec3(unit(random) - 0.5, unit(random) - 0.5, 1.5 * (unit(random) - 0.5));
        s.addSphere(medium, dvec3(0, 0, 1) + offset, radius,
                    withSmooth && i % 2 ? scene::Profile::Smooth : scene::Profile::Constant);
    }
    return s;
}

struct PileCase {
    int count;
    double minExtinction, maxExtinction;
    bool withSmooth;
};

/// Its name in lists of tests, the same in every run.
void PrintTo(const PileCase& p, std::ostream* out) {
    *out << p.count << " from " << p.minExtinction << " to " << p.maxExtinction
         << (p.withSmooth ? " smooth" : "");
}

class ReferenceHardRay_Pile : public testing::TestWithParam<PileCase> {};

TEST_P(ReferenceHardRay_Pile, AgainstBruteForce_AgreesTo1e7) {
    const PileCase& p = GetParam();
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        const TestScene s = makePile(p.count, p.minExtinction, p.maxExtinction, p.withSmooth, seed);
        for (const double z : {-3.0, 0.9}) {  // from outside and from within
            const dvec3 origin(0.01, 0.02, z);
            const RayResult r = s.trace(origin);
            const BruteForce truth = integrateSpheres(s, origin, p.count > 20 ? 4000 : 20000);
            EXPECT_TRUE(isFinite(r));
            EXPECT_NEAR(r.radiance.x, static_cast<double>(truth.radiance), kAccuracy) << seed;
            EXPECT_NEAR(r.transmittance.x, static_cast<double>(truth.transmittance), kAccuracy);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Suite, ReferenceHardRay_Pile,
                         testing::Values(PileCase{2, 0.1, 10, true}, PileCase{8, 1e-3, 1e2, true},
                                         PileCase{8, 1e-3, 1e5, true},
                                         PileCase{64, 1e-3, 1e5, false},
                                         PileCase{64, 1e-3, 1, true},
                                         PileCase{64, 1e-3, 1e5, true}));

TEST(ReferenceHardRay, CoincidentAndNestedBoundaries_AgreeWithBruteForce) {
    TestScene s;
    const std::uint32_t a = s.addMedium(dvec3(3), dvec3(0), dvec3(1));
    const std::uint32_t b = s.addMedium(dvec3(40), dvec3(0), dvec3(30));
    const std::uint32_t c = s.addMedium(dvec3(500), dvec3(0), dvec3(50));
    using scene::Profile;
    s.addSphere(a, dvec3(0, 0, 2), 1, Profile::Smooth);
    s.addSphere(b, dvec3(0, 0, 2), 1, Profile::Smooth);    // the same sphere
    s.addSphere(c, dvec3(0, 0, 2), 0.5, Profile::Smooth);  // concentric
    s.addSphere(b, dvec3(0, 0, 1.5), 0.5);                 // touches from within
    s.addSphere(a, dvec3(0, 0, 3.5), 0.5);                 // touches from outside
    for (const double x : {0.0, 0.1, 0.49, 0.999}) {
        const RayResult r = s.trace(dvec3(x, 0, -1));
        const BruteForce truth = integrateSpheres(s, dvec3(x, 0, -1), 50000);
        EXPECT_NEAR(r.radiance.x, static_cast<double>(truth.radiance), kAccuracy) << x;
        EXPECT_NEAR(r.transmittance.x, static_cast<double>(truth.transmittance), kAccuracy) << x;
    }
}

TEST(ReferenceHardRay, GrazingAndSlivers_AreFiniteAndContinuous) {
    TestScene s;
    const std::uint32_t medium = s.addMedium(dvec3(1e3), dvec3(0), dvec3(1e3));
    s.addSphere(medium, dvec3(0, 0, 2), 1);
    for (const double gap : {0.0, 1e-16, 1e-12, 1e-8, -1e-16, -1e-12, -1e-8}) {
        const RayResult r = s.trace(dvec3(1 + gap, 0, 0));
        const double chord = gap < 0 ? 2 * std::sqrt(-gap * (2 + gap)) : 0;
        EXPECT_TRUE(isFinite(r));
        EXPECT_NEAR(r.transmittance.x, std::exp(-1e3 * chord), 1e-4 * (gap > -1e-14) + 1e-6);
        EXPECT_NEAR(r.radiance.x + r.transmittance.x, 1, 1e-12);
    }
    // Two boxes that overlap by 1e-9.
    TestScene boxes;
    const std::uint32_t thick = boxes.addMedium(dvec3(1e8), dvec3(0), dvec3(1e8));
    const std::uint32_t thin = boxes.addMedium(dvec3(1), dvec3(0), dvec3(0.5));
    boxes.addBox(thick, dvec3(-1, -1, 1), dvec3(1, 1, 1 + 1e-8));
    boxes.addBox(thin, dvec3(-1, -1, 1 + 9e-9), dvec3(1, 1, 2));
    const RayResult r = boxes.trace(dvec3(0));
    EXPECT_NEAR(r.transmittance.x, std::exp(-1.0 - 1.0), 1e-7);
    EXPECT_NEAR(r.radiance.x, 1 - std::exp(-1.0) + std::exp(-1.0) * 0.5 * (1 - std::exp(-1.0)),
                1e-7);
}

TEST(ReferenceHardRay, TwoThousandFaintLayers_KeepTheirSum) {
    TestScene s;
    scene::Material pane;
    pane.type = scene::MaterialType::Thin, pane.coverage = 0.001, pane.emission = dvec3(1);
    const std::uint32_t material = s.addMaterial(pane);
    for (int i = 0; i < 2000; ++i) s.addPane(material, 0.01 * i);
    const RayResult r = s.trace(dvec3(0.1, 0.3, -1));
    EXPECT_NEAR(r.transmittance.x, std::pow(0.999, 2000), 1e-13);
    EXPECT_NEAR(r.radiance.x, 1 - std::pow(0.999, 2000), 1e-13);
    // The same of spheres with optical depth 1e-10 each, in two media.
    TestScene faint;
    for (int m = 0; m < 2; ++m) faint.addMedium(dvec3(5e-11), dvec3(0), dvec3(5e-11 * (m + 1)));
    for (int i = 0; i < 2000; ++i)
        faint.addSphere(static_cast<std::uint32_t>(i % 2), dvec3(0, 0, 0.01 * i), 1);
    EXPECT_NEAR(faint.trace().radiance.x / 3e-7, 1, 1e-6);
    EXPECT_NEAR((1 - faint.trace().transmittance.x) / 2e-7, 1, 1e-6);
}

TEST(ReferenceHardRay, Thickness1e30_ShowsTheSource) {
    TestScene s;
    const std::uint32_t thick = s.addMedium(dvec3(1e30), dvec3(0), dvec3(0.5e30));
    const std::uint32_t other = s.addMedium(dvec3(1e30), dvec3(0), dvec3(1e30));
    s.scene.background.radiance = dvec3(1);
    s.addSphere(thick, dvec3(0, 0, 0), 1);
    EXPECT_NEAR(s.trace().radiance.x, 0.5, 1e-15);
    EXPECT_EQ(s.trace().transmittance.x, 0);
    // A half of each from the start on: the mean of the two sources; also from the inside.
    s.addSphere(other, dvec3(0, 0, 0), 1);
    EXPECT_NEAR(s.trace().radiance.x, 0.75, 1e-12);
    EXPECT_NEAR(s.trace(dvec3(0)).radiance.x, 0.75, 1e-12);
    for (scene::MediumSphere& sphere : s.spheres) sphere.profile = scene::Profile::Smooth;
    EXPECT_NEAR(s.trace().radiance.x, 0.75, 1e-9);
    // Behind something faint: e^-1 of it.
    s.addSphere(s.addMedium(dvec3(0.5)), dvec3(0, 0, -5), 1);
    EXPECT_NEAR(s.trace().radiance.x, 0.75 * std::exp(-1), 1e-9);
    EXPECT_TRUE(isFinite(s.trace()));
}

TEST(ReferenceHardRay, SmoothMixtureOf1e30_TakesTheRatioAtTheRim) {
    // Both start at once: near the rim the densities are as (2 s cos / R)^2, so as 1 / R^2.
    TestScene s;
    s.addSphere(s.addMedium(dvec3(1e30), dvec3(0), dvec3(1e30)), dvec3(0, 0, 1), 1,
                scene::Profile::Smooth);
    s.addSphere(s.addMedium(dvec3(1e30)), dvec3(0, 0, 2), 2, scene::Profile::Smooth);
    EXPECT_NEAR(s.trace(dvec3(0, 0, -1)).radiance.x, 1 / (1 + 0.25), kAccuracy);
}

TEST(ReferenceHardRay, OpenMesh_FillsTheRestOfTheRay) {
    TestScene s;
    scene::Material glass;
    glass.type = scene::MaterialType::Solid, glass.absorption = dvec3(1),
    glass.scattering = dvec3(1);
    s.addPane(s.addMaterial(glass), 0);  // entered and never left
    s.addLight(scene::LightType::Ambient, dvec3(1));
    s.scene.background.radiance = dvec3(9);
    EXPECT_NEAR(s.trace().radiance.x, 0.5, 1e-12);
    EXPECT_EQ(s.trace().transmittance.x, 0);
}

TEST(ReferenceHardRay, BricksMixedWithSpheres_AgreeWithBruteForce) {
    TestScene s;
    const std::uint32_t a = s.addMedium(dvec3(2), dvec3(0), dvec3(0.5));
    const std::uint32_t b = s.addMedium(dvec3(5), dvec3(0), dvec3(4));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit;
    std::vector<float> values(17 * 17 * 17);
    for (float& value : values) value = unit(random) < 0.3f ? 0 : unit(random);
    const auto at = [&](const ivec3& i) { return values[(i.z * 17 + i.y) * 17 + i.x]; };
    dmat4 shear(0.1);  // sheared and mirrored
    shear[1][0] = 0.03, shear[2][2] = -0.1, shear[3] = dvec4(-0.8, -0.8, 0.8, 1);
    fillBricks(s.addGrid(a, shear), 2, at);
    s.addSphere(b, dvec3(0.1, 0, 0), 0.6, scene::Profile::Smooth);
    const dvec3 origin(0.05, 0.11, -2);
    const dmat4 index = glm::inverse(shear);
    const auto local = [&](long double t) {
        const dvec3 world(origin.x, origin.y, double(origin.z + t));
        const dvec3 p = transformPoint(index, world);
        long double density = 0;
        if (glm::all(glm::greaterThanEqual(p, dvec3(0))) && glm::all(glm::lessThan(p, dvec3(16)))) {
            const ivec3 cell(glm::floor(p));
            const dvec3 f = p - dvec3(cell);
            for (int k = 0; k < 8; ++k) {
                const ivec3 bit(k & 1, k >> 1 & 1, k >> 2);
                const dvec3 w = glm::mix(1.0 - f, f, dvec3(bit));
                density += w.x * w.y * w.z * at(cell + bit);
            }
        }
        const long double sphere = densityAt(s.spheres[0], origin, t);
        return Local{2 * density + 5 * sphere, 0.5L * density + 4 * sphere};
    };
    std::vector<double> breaks;
    for (int i = 0; i <= 4000; ++i) breaks.push_back(i * 0.001);
    BruteForce truth;
    truth.integrate(local, breaks, 100);
    const RayResult r = s.trace(origin);
    EXPECT_NEAR(r.radiance.x, static_cast<double>(truth.radiance), kAccuracy);
    EXPECT_NEAR(r.transmittance.x, static_cast<double>(truth.transmittance), kAccuracy);
}

TEST(ReferenceHardRay, ShadowsInBricksAndSpheres_AgreeWithFineSteps) {
    TestScene s;
    const std::uint32_t fog = s.addMedium(dvec3(0.05), dvec3(1));
    const std::uint32_t smoke = s.addMedium(dvec3(2), dvec3(0.9));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit;
    std::vector<float> values(9 * 9 * 9);
    for (float& value : values) value = unit(random);
    fillBricks(s.addGrid(smoke, glm::translate(dmat4(1), dvec3(-4, 1, 2))), 1,
               [&](const ivec3& i) { return values[(i.z * 9 + i.y) * 9 + i.x]; });
    s.addBox(fog, dvec3(-20, -20, 0), dvec3(20, 20, 12));
    // Small and dense: shadows far narrower than a panel.
    s.addSphere(smoke, dvec3(0, 3, 1.234), 0.02, scene::Profile::Constant, 100);
    s.addSphere(smoke, dvec3(0.01, -2, 7.77), 0.05, scene::Profile::Smooth, 100);
    s.addLight(scene::LightType::Directional, dvec3(3), true).direction =
        glm::normalize(dvec3(0.02, -1, 0.1));
    scene::Light& spot = s.addLight(scene::LightType::Spot, dvec3(40), true);
    spot.position = dvec3(0, -4, 7.5), spot.direction = dvec3(0, 1, 0);
    spot.innerAngle = 0.3, spot.outerAngle = 0.9;
    const Tracer tracer = s.tracer();
    const scene::Ray ray{dvec3(0), dvec3(0, 0, 1)};
    constexpr int kSteps = 60000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double t = 12.0 * (i + 0.5) / kSteps;
        const dvec3 p(0, 0, t), fromSpot = p - spot.position;
        const double distance2 = glm::dot(fromSpot, fromSpot);
        const double cosine = fromSpot.y / std::sqrt(distance2);
        const double ramp =
            std::clamp((cosine - std::cos(0.9)) / (std::cos(0.3) - std::cos(0.9)), 0.0, 1.0);
        const double sun = 3 * tracer.transmittance(p, p - 100.0 * s.scene.lights[0].direction).x;
        const double lamp = 40 * ramp * ramp / distance2 * tracer.transmittance(p, spot.position).x;
        sum += 0.05 * (sun + lamp) * std::exp(-0.05 * t) * (12.0 / kSteps) / (4 * kPi);
    }
    EXPECT_NEAR(tracer.integrateRay(ray).radiance.x, sum, 1e-6);
}

}  // namespace
}  // namespace brume::reference
