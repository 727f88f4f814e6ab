// SPDX-License-Identifier: Apache-2.0
// Rays that break careless arithmetic: linked_list against the exact renderer.
#include <render/render_fixture.hpp>

namespace brume::test {
namespace {

using scene::Profile;

enum class Profiles { Constant, Smooth, Both };

Profile profileOf(Profiles profiles, int i) {
    if (profiles == Profiles::Both) return i % 2 ? Profile::Smooth : Profile::Constant;
    return profiles == Profiles::Smooth ? Profile::Smooth : Profile::Constant;
}

/// `count` spheres that all contain the origin, of extinctions spread over decades.
TestScene makePile(int count, double minExtinction, double maxExtinction, Profiles profiles,
                   std::uint64_t seed) {
    TestScene s(20, 20);  // four hundred rays, each through nearly all of the spheres
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const double extinction =
            minExtinction * std::pow(maxExtinction / minExtinction, random.uniform());
        const dvec3 colour = random.vector(0.5, 1);
        const std::uint32_t medium =
            s.addMedium(extinction * colour, random.vector(), extinction * random.vector(0, 0.5));
        if (i % 3 == 1) s.scene.media[medium].phase = scene::PhaseType::Rayleigh;
        if (i % 3 == 2) {
            s.scene.media[medium].phase = scene::PhaseType::HenyeyGreenstein;
            s.scene.media[medium].g = random.uniform(-0.8, 0.8);
        }
        const double radius = random.uniform(0.3, 1.3);
        s.addSphere(medium, 0.5 * radius * random.vector(-1, 1), radius, profileOf(profiles, i));
    }
    s.addDaylight();
    return s;
}

struct PileCase {
    const char* name;
    int count;
    double minExtinction, maxExtinction;
    Profiles profiles;
};

/// Its name in lists of tests, the same in every run.
void PrintTo(const PileCase& p, std::ostream* out) { *out << p.name; }

class HardRays_Pile : public RenderTest, public testing::WithParamInterface<PileCase> {};

TEST_P(HardRays_Pile, AgainstReference_IsExact) {
    const PileCase& p = GetParam();
    for (const double z : {-4.0, 0.0}) {  // from outside and from within all of them
        TestScene s = makePile(p.count, p.minExtinction, p.maxExtinction, p.profiles, 7);
        s.scene.camera.position.z = z;
        s.scene.camera.target.z = 5;
        expectExact(s, z == 0 ? "inside" : "outside");
    }
}

INSTANTIATE_TEST_SUITE_P(Suite, HardRays_Pile,
                         testing::Values(PileCase{"Faint64", 64, 1e-5, 1e-3, Profiles::Constant},
                                         PileCase{"Thin64", 64, 1e-3, 1, Profiles::Constant},
                                         PileCase{"All64", 64, 1e-3, 1e5, Profiles::Constant},
                                         PileCase{"Dense64", 64, 1e3, 1e5, Profiles::Constant},
                                         PileCase{"SmoothThin64", 64, 1e-3, 1, Profiles::Smooth},
                                         PileCase{"SmoothAll8", 8, 1e-3, 1e5, Profiles::Smooth},
                                         PileCase{"SmoothAll64", 64, 1e-3, 1e5, Profiles::Smooth},
                                         PileCase{"MixedAll64", 64, 1e-3, 1e5, Profiles::Both}),
                         [](const auto& pile) { return pile.param.name; });

class HardRays : public RenderTest {};

TEST_F(HardRays, CoincidentAndNestedBoundaries_AreExact) {
    for (const Profiles profiles : {Profiles::Constant, Profiles::Smooth, Profiles::Both}) {
        TestScene s;
        const std::uint32_t a = s.addMedium(3, 0.5, 1), b = s.addMedium(40, 0.2, 30);
        const std::uint32_t c = s.addMedium(500, 0.9, 50);
        s.addSphere(a, dvec3(0), 1, profileOf(profiles, 0));
        s.addSphere(b, dvec3(0), 1, profileOf(profiles, 1));             // the same sphere
        s.addSphere(c, dvec3(0), 0.5, profileOf(profiles, 2));           // concentric
        s.addSphere(b, dvec3(0, 0, -0.5), 0.5, profileOf(profiles, 3));  // touches from within
        s.addSphere(a, dvec3(0, 0, -1.5), 0.5, profileOf(profiles, 4));  // touches from outside
        for (int i = 0; i < 8; ++i)                                      // onion
            s.addSphere(a, dvec3(0), 1 - i / 16.0, profileOf(profiles, i), 0.1);
        s.addDaylight();
        expectExact(s, "profiles " + std::to_string(static_cast<int>(profiles)));
        s.scene.camera.position.z = -1;  // on the boundary
        expectExact(s, "boundary, profiles " + std::to_string(static_cast<int>(profiles)));
    }
}

TEST_F(HardRays, ShellsAndSheetsOfAHundredthOfAMillimetre_AreExact) {
    for (const Profiles profiles : {Profiles::Constant, Profiles::Both}) {
        TestScene s;
        const std::uint32_t a = s.addMedium(dvec3(1e5, 5e4, 2e4), dvec3(0.5), dvec3(3e4));
        const std::uint32_t b = s.addMedium(dvec3(2e4, 1e5, 1e5), dvec3(0.9), dvec3(1e4));
        for (int i = 0; i < 8; ++i)
            s.addSphere(i % 2 ? a : b, dvec3(0.1, -0.1, 0.2), 0.9 + 1e-5 * i,
                        profileOf(profiles, i));
        s.addBox(a, dvec3(-1, -1, -0.9), dvec3(1, 1, -0.9 + 1e-5));
        s.addBox(b, dvec3(-1, -1, -0.9 + 5e-6), dvec3(1, 1, -0.9 + 2e-5));
        s.addDaylight();
        expectExact(s, "profiles " + std::to_string(static_cast<int>(profiles)));
    }
}

TEST_F(HardRays, CoincidentBoxFaces_AreExact) {
    TestScene s;
    const std::uint32_t a = s.addMedium(2, 0.5, 0.5), b = s.addMedium(1e4, 0.2, 1e3);
    const std::uint32_t c = s.addMedium(dvec3(0.5, 1, 2), dvec3(0.9));
    s.addBox(a, dvec3(-1, -1, 0), dvec3(0, 1, 1));
    s.addBox(c, dvec3(0, -1, 0), dvec3(1, 1, 1));          // shares a face
    s.addBox(b, dvec3(-1, -1, 1), dvec3(1, 1, 1 + 1e-4));  // behind both, a sheet
    s.addBox(a, dvec3(-1, -1, 0), dvec3(1, 0.5, 1));       // the same faces
    s.addBox(a, dvec3(-0.5, -0.5, 0.25), dvec3(0.5, 0.5, 0.75));
    s.addSphere(c, dvec3(0, 0, 0.5), 0.5);  // touches both faces
    s.addDaylight();
    expectExact(s, "outside");
    s.scene.camera.position = dvec3(-0.25, 0.1, 0.25);  // on a face, inside others
    s.scene.camera.target = dvec3(0.1, 0.2, 1);
    expectExact(s, "inside");
}

TEST_F(HardRays, GrazingAndSlivers_AreFiniteAndExact) {
    TestScene s(64, 64);
    s.scene.camera.type = scene::CameraType::Orthographic;
    s.scene.camera.height = 2;
    // Rays pass at multiples of 1/32 from the axis: tangent to these spheres within rounding.
    const std::uint32_t dense = s.addMedium(1e3, 0, 1e3), thin = s.addMedium(1, 0.5, 0.2);
    for (int i = 1; i < 16; ++i) {
        const double gap = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-7 : -1e-7;
        s.addSphere(i % 2 ? dense : thin, dvec3(0, 0, i), (2 * i - 1) / 64.0 + gap,
                    i % 4 ? Profile::Constant : Profile::Smooth);
    }
    for (int i = 0; i < 16; ++i)  // needles between pixel centres, and slivers of overlap
        s.addBox(thin, dvec3(-0.9, i / 16.0 - 0.5, 0),
                 dvec3(0.9, i / 16.0 - 0.5 + 1e-4, 1 + 1e-5 * i));
    s.addDaylight();
    // A tangent ray may count as a hit or a miss: a chord of sqrt(8 r gap) of extinction 1e3.
    const Difference d = measure(s);
    EXPECT_EQ(d.nonFinite, 0u);
    EXPECT_LE(d.rmse, 3e-2);
    for (scene::MediumSphere& sphere : s.spheres) sphere.radius *= 1.01f;
    expectExact(s, "slivers");
}

TEST_F(HardRays, TwoThousandFaintLayers_KeepTheirSum) {
    for (const Profiles profiles : {Profiles::Constant, Profiles::Smooth}) {
        TestScene s(16, 16);
        for (int m = 0; m < 2; ++m) s.addMedium(dvec3(5e-4, 2e-4, 1e-4), dvec3(1), dvec3(1e-5));
        for (int i = 0; i < 2000; ++i)
            s.addSphere(static_cast<std::uint32_t>(i % 2), dvec3(0, 0, 0.01 * i), 1,
                        profileOf(profiles, 0));
        s.addDaylight();
        expectExact(s, "spheres");
    }
    TestScene s(16, 16);
    const std::uint32_t pane = s.addMaterial(makeThin(0.001, dvec3(0.3, 0.5, 0.9), dvec3(0.5)));
    for (int i = 0; i < 2000; ++i) s.addPane(pane, 0.01 * i, 30);
    s.addDaylight();
    expectExact(s, "panes");
}

TEST_F(HardRays, TwoThousandFaintDisjointSlabs_KeepTheirSum) {
    TestScene s(16, 16);
    const std::uint32_t medium = s.addMedium(dvec3(0.05, 0.1, 0.2), dvec3(1), dvec3(0.01));
    volumes::VolumeGrid& grid = s.addGrid(medium);
    for (int i = 0; i < 2000; ++i)
        grid.boxes.push_back(
            {dvec3(-30, -30, 0.01 * i), dvec3(30, 30, 0.01 * i + 0.005), 1, false});
    s.addDaylight();
    expectExact(s, "boxes");
}

TEST_F(HardRays, Thickness1e30_ShowsTheSource) {
    for (const Profiles profiles : {Profiles::Constant, Profiles::Smooth, Profiles::Both})
        for (const double thick : {1e12, 1e30}) {
            TestScene s(16, 16);
            const std::uint32_t a = s.addMedium(thick, 0, 0.5 * thick);
            const std::uint32_t b = s.addMedium(thick, 0.5, 0.1 * thick);
            const std::uint32_t veil = s.addMedium(0.5);
            s.addSphere(a, dvec3(0), 0.5, profileOf(profiles, 0));
            s.addSphere(b, dvec3(0), 0.5, profileOf(profiles, 0));
            s.addSphere(veil, dvec3(0, 0, -2), 1, profileOf(profiles, 1));
            s.addDaylight();
            const std::string name = std::to_string(static_cast<int>(profiles));
            expectExact(s, "outside " + name);
            s.scene.camera.position.z = 0;
            s.scene.camera.target.z = 1;
            expectExact(s, "inside " + name);
        }
}

TEST_F(HardRays, HugeDensities_AreFinite) {
    TestScene s(16, 16);
    const std::uint32_t a = s.addMedium(1e36, 0, 1e36);
    s.addBox(a, dvec3(-1, -1, 0), dvec3(1, 1, 1000));
    s.addSphere(a, dvec3(0), 0.5, Profile::Smooth, 10);
    s.addSphere(a, dvec3(1, 0, 0), 0.5, Profile::Constant, 10);
    expectExact(s, "1e37 * 1000 m");
}

TEST_F(HardRays, SmallSpheresFarAway_AreExact) {
    for (const Profiles profiles : {Profiles::Constant, Profiles::Smooth}) {
        TestScene s(32, 32);
        s.scene.camera.verticalFov = radians(0.03);
        s.scene.camera.position.z = -1000;
        const std::uint32_t medium = s.addMedium(dvec3(30, 10, 3), dvec3(0.5));
        Random random(3);
        for (int i = 0; i < 60; ++i)
            s.addSphere(medium, 0.15 * random.vector(-1, 1), 0.05, profileOf(profiles, i));
        s.addDaylight();
        expectExact(s, "profiles " + std::to_string(static_cast<int>(profiles)));
    }
}

TEST_F(HardRays, EverythingTogether_IsExact) {
    TestScene s = makePile(24, 1e-2, 20, Profiles::Both, 11);
    s.scene.image = {64, 64, 1};
    const std::uint32_t pane = s.addMaterial(makeThin(0.4, dvec3(0.3, 0.9, 0.5), dvec3(0.2)));
    s.addPane(pane, -0.5, 0.8);
    s.addPane(pane, 0.25, 0.8);
    s.addPane(pane, 0.25, 0.5);  // in the same plane
    const std::uint32_t glass = s.addMaterial(makeSolid(dvec3(1, 0.2, 0.3), dvec3(0.5)));
    const std::uint32_t amber = s.addMaterial(makeSolid(dvec3(0.1, 0.5, 2)));
    s.addMesh(scene::makeSphere(1, 32), glass, translation(dvec3(0.2, 0, 0)));
    s.addMesh(scene::makeBox(dvec3(0.7, 0.6, 0.5)), amber, translation(dvec3(0.1, 0.1, 0.1)));
    s.addMesh(scene::makeBox(dvec3(3, 3, 0.1)), s.addMaterial(makeOpaque(dvec3(0.5))),
              translation(dvec3(0, 0, 1.5)));
    // Where triangles meet in a plane or at an edge, both may see different ones.
    expectExact(s, "outside", 1e-5, 0.02);
    s.scene.camera.position = dvec3(0.1, 0.05, 0.2);  // inside both solids and most spheres
    s.scene.camera.target = dvec3(0.3, 0, 1);
    expectExact(s, "inside", 1e-5, 0.02);
}

TEST_F(HardRays, PointLightInsideMedia_IsExact) {
    for (const Profiles profiles : {Profiles::Constant, Profiles::Both}) {
        TestScene s = makePile(12, 0.05, 5, profiles, 13);
        scene::Light& light = s.addLight(scene::LightType::Point, dvec3(2, 3, 4));
        light.position = dvec3(0.1, 0.13, 0.2);
        light.radius = 0.1;
        scene::Light& spot = s.addLight(scene::LightType::Spot, dvec3(20));
        spot.position = dvec3(1, 2, -1);
        spot.direction = glm::normalize(-spot.position);
        spot.innerAngle = radians(10);
        spot.outerAngle = radians(20);
        expectExact(s, "outside");
        s.scene.camera.position.z = 0;
        s.scene.camera.target.z = 1;
        expectExact(s, "inside");
    }
}

}  // namespace
}  // namespace brume::test
