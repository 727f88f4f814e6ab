// SPDX-License-Identifier: Apache-2.0
// What must not change the image: splitting, order, units, halving a density, memory, repetition;
// and bounds that always hold.
#include <render/render_fixture.hpp>

#include <algorithm>

namespace brume::test {
namespace {

using scene::Profile;

/// Spheres of three media, half of them smooth, in and around the unit cube.
TestScene makeCrowd(int count, std::uint64_t seed, const dvec3& albedo = dvec3(0.3, 0.5, 0.9)) {
    TestScene s(40, 40);
    Random random(seed);
    for (int m = 0; m < 3; ++m)
        s.addMedium(random.vector() * std::pow(10, m - 1), albedo, dvec3(0.3 * random.uniform()));
    s.scene.media[1].phase = scene::PhaseType::Rayleigh;
    for (int i = 0; i < count; ++i) {
        const double radius = random.uniform(0.1, 0.6);
        s.addSphere(static_cast<std::uint32_t>(i % 3), random.vector(-1, 1), radius,
                    i % 2 ? Profile::Smooth : Profile::Constant, random.uniform(1, 2));
        if (i % 5 == 0) s.spheres.back().tint = vec3(1, 0.5, 0.25);
    }
    s.addDaylight();
    return s;
}

/// The crowd with a pane, a solid and a volume.
TestScene makeEverything() {
    TestScene s = makeCrowd(40, 1);
    const std::uint32_t pane = s.addMaterial(makeThin(0.7, dvec3(0.4, 0.5, 0.9), dvec3(0.3)));
    s.addPane(pane, -0.4, 0.7);
    s.addPane(pane, 0.4, 0.7);
    s.addMesh(scene::makeSphere(0.8, 16), s.addMaterial(makeSolid(dvec3(1, 0.5, 0.2))));
    fillBricks(s.addGrid(1, glm::scale(translation(dvec3(-0.5)), dvec3(1 / 16.0))), 2, noiseAt);
    return s;
}

double maxDifference(const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const vec3 d = glm::abs(a.pixels[i] - b.pixels[i]);
        largest = std::max({largest, double(d.x), double(d.y), double(d.z)});
    }
    return largest;
}

class Invariant : public RenderTest {
  protected:
    void expectSame(const render::PreparedScene& a, const render::PreparedScene& b,
                    double tolerance) {
        EXPECT_LE(maxDifference(render(a).image, render(b).image), tolerance);
    }
};

TEST_F(Invariant, BoxSplitInTwo_ChangesNothing) {
    const auto make = [](bool isSplit) {
        TestScene s(40, 40);
        s.scene.camera.position = dvec3(2, 1.5, -3);
        const std::uint32_t medium = s.addMedium(dvec3(0.5, 1, 4), dvec3(0.8), dvec3(0.1));
        if (isSplit) {
            s.addBox(medium, dvec3(-1), dvec3(0.125, 1, 1));
            s.addBox(medium, dvec3(0.125, -1, -1), dvec3(1));
        } else {
            s.addBox(medium, dvec3(-1), dvec3(1));
        }
        s.addSphere(medium, dvec3(0.3), 0.7);
        s.addDaylight();
        return s;
    };
    expectSame(make(false), make(true), 2e-6);
}

TEST_F(Invariant, SegmentsSplitByInvisibleBoundaries_ChangeNothing) {
    const TestScene s = makeCrowd(30, 3);
    TestScene split = s;
    const std::uint32_t nothing = split.addMedium(0);
    for (int i = 0; i < 30; ++i)
        split.addSphere(nothing, dvec3(0.1, 0.1, 0.1 * i - 1.5), 0.7, Profile::Smooth);
    const std::uint32_t glass = split.addMaterial(makeThin(0, dvec3(0)));
    for (int i = 0; i < 9; ++i) split.addPane(glass, 0.25 * i - 1);
    expectSame(s, split, 1e-5);
}

TEST_F(Invariant, OrderOfSubmission_GivesTheSameBits) {
    const TestScene s = makeEverything();
    const std::uint64_t hash = hashOf(s);
    for (const char* seed : {"1", "2", "3", "99999999999"})
        EXPECT_EQ(hashOf(s, {{"shuffle", seed}}), hash) << seed;
    // Submitted in another order by the caller.
    TestScene reversed = s;
    std::reverse(reversed.spheres.begin(), reversed.spheres.end());
    EXPECT_EQ(hashOf(reversed), hash);
}

TEST_F(Invariant, OrderOfEqualSpheres_GivesTheSameBits) {
    // All begin at the same distances; media and tints differ.
    TestScene s(24, 24);
    Random random(4);
    for (int i = 0; i < 40; ++i) {
        const std::uint32_t medium = s.addMedium(random.vector(), random.vector());
        s.addSphere(medium, dvec3(0), 1, i % 4 ? Profile::Constant : Profile::Smooth).tint =
            vec3(random.vector());
    }
    s.addDaylight();
    for (const bool isConstant : {false, true}) {
        if (isConstant)
            for (scene::MediumSphere& sphere : s.spheres) sphere.profile = Profile::Constant;
        const std::uint64_t hash = hashOf(s);
        for (const char* seed : {"5", "6", "7"}) EXPECT_EQ(hashOf(s, {{"shuffle", seed}}), hash);
    }
}

TEST_F(Invariant, OrderOfMeshes_ChangesNothing) {
    TestScene s = makeEverything();
    TestScene reversed = s;
    std::reverse(reversed.scene.meshes.begin(), reversed.scene.meshes.end());
    expectSame(s, reversed, 2e-6);
}

TEST_F(Invariant, WhiteFurnace_ReturnsOne) {
    TestScene s = makeCrowd(60, 6, dvec3(1));
    for (scene::Medium& medium : s.scene.media) medium.emission = dvec3(0);
    for (scene::MediumSphere& sphere : s.spheres) sphere.tint = vec3(1);
    s.scene.lights.resize(1);
    s.scene.lights[0].color = s.scene.background.radiance = dvec3(1);
    const dvec3 t(0.4, 0.5, 0.6);
    s.addPane(s.addMaterial(makeThin(0.7, t, 1.0 - t)), -0.3);
    s.addMesh(scene::makeBox(dvec3(0.8)), s.addMaterial(makeSolid(dvec3(0), dvec3(3, 2, 1))));
    s.addMesh(scene::makeBox(dvec3(3, 0.3, 3)), s.addMaterial(makeOpaque(dvec3(1))),
              translation(dvec3(0, -1, 0)));
    fillBricks(s.addGrid(0, glm::scale(dmat4(1), dvec3(0.1))), 1, noiseAt);
    for (const double z : {-4.0, 0.1}) {
        s.scene.camera.position.z = z;
        s.scene.camera.target.z = 2;
        const Image image = render(s).image;
        EXPECT_LE(maxDifference(image, Image(image.width, image.height, vec3(1))), 5e-6);
    }
}

TEST_F(Invariant, LengthsTimesK_ExtinctionOverK_ChangeNothing) {
    const TestScene s = makeCrowd(30, 4);
    for (const double k : {1.0 / 1024, 1024.0, 3.7}) {
        TestScene scaled = s;
        for (scene::Medium& medium : scaled.scene.media)
            medium.extinction /= k, medium.emission /= k;
        for (scene::MediumSphere& sphere : scaled.spheres)
            sphere.center *= k, sphere.radius *= static_cast<float>(k);
        scaled.scene.camera.position *= k;
        expectSame(s, scaled, k == 3.7 ? 1e-5 : 1e-6);
    }
}

TEST_F(Invariant, TwoHalfDensities_EqualOne) {
    TestScene s = makeCrowd(30, 5);
    fillBricks(s.addGrid(1, glm::scale(translation(dvec3(-0.5)), dvec3(1 / 8.0))), 1, noiseAt);
    TestScene halves = s;
    for (scene::MediumSphere& sphere : halves.spheres) sphere.density *= 0.5f;
    const auto count = halves.spheres.size();
    for (std::size_t i = 0; i < count; ++i) {
        scene::MediumSphere copy = halves.spheres[i];
        copy.id = static_cast<std::uint32_t>(count + i);
        halves.spheres.push_back(copy);
    }
    for (float& value : halves.volumes[0].values) value *= 0.5f;
    halves.volumes.push_back(halves.volumes[0]);
    halves.scene.volumes.push_back(halves.scene.volumes[0]);
    expectSame(s, halves, 3e-6);
}

TEST_F(Invariant, Transmittance_IsBetweenZeroAndOne) {
    TestScene s = makeCrowd(80, 8, dvec3(0));
    for (scene::Medium& medium : s.scene.media) medium.emission = dvec3(0);
    s.scene.lights.clear();
    s.scene.background.radiance = dvec3(1);  // the image is the transmittance
    Image last(s.scene.image.width, s.scene.image.height, vec3(1));
    for (const std::size_t count : {0u, 20u, 50u, 80u}) {
        TestScene part = s;
        part.spheres.resize(count);
        const Image image = render(part).image;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                ASSERT_GE(image.pixels[i][c], 0);
                ASSERT_LE(image.pixels[i][c], last.pixels[i][c] * (1 + 1e-6f));
            }
        last = image;
    }
}

class Determinism : public RenderTest {};

TEST_F(Determinism, TwentyRenders_GiveTheSameBits) {
    const TestScene s = makeEverything();
    render::Renderer renderer(device(), s, {.method = "linked_list"}, log());
    const std::uint64_t hash = computeHash(renderer.renderFrame().image);
    for (int i = 0; i < 18; ++i) EXPECT_EQ(computeHash(renderer.renderFrame().image), hash);
    EXPECT_EQ(hashOf(s), hash);
}

TEST_F(Determinism, Bands_GiveTheSameBits) {
    // Lists of more than 2 MiB: some 45 intervals on each of 9 216 pixels.
    TestScene s(96, 96);
    Random random(12);
    for (int m = 0; m < 3; ++m) s.addMedium(0.1 * random.vector(), dvec3(0.8));
    for (int i = 0; i < 300; ++i)
        s.addSphere(static_cast<std::uint32_t>(i % 3), 2.0 * random.vector(-1, 1), 0.8,
                    Profile::Constant);
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.3, 0.6, 0.9))), 0, 2);
    s.addDaylight();
    const render::Result whole = render(s);
    EXPECT_EQ(whole.counters.at("bands"), 1u);
    for (const bool isSmooth : {false, true}) {
        if (isSmooth) s.spheres[0].profile = Profile::Smooth;
        const render::Result plain = render(s);
        const render::Result bands = render(s, {.method = "linked_list", .settings = {{"budgetMiB", "1"}}});
        EXPECT_GT(bands.counters.at("bands"), 2u);
        for (const char* key : {"stored", "surfaces", "longestList"})
            EXPECT_EQ(bands.counters.at(key), plain.counters.at(key)) << key;
        EXPECT_EQ(bands.counters.at("dropped"), 0u);
        EXPECT_LT(bands.bytes.at("lists"), plain.bytes.at("lists"));
        EXPECT_LE(bands.bytes.at("lists"), std::uint64_t{1} << 20);
        EXPECT_EQ(computeHash(bands.image), computeHash(plain.image));
    }
}

TEST_F(Determinism, ListsPlannedOnTheDevice_GiveTheSameBits) {
    TestScene s(40, 24);
    Random random(12);
    for (int m = 0; m < 3; ++m) s.addMedium(0.1 * random.vector(), dvec3(0.8));
    for (int i = 0; i < 700; ++i)
        s.addSphere(static_cast<std::uint32_t>(i % 3), 2.0 * random.vector(-1, 1), 0.8,
                    i == 0 ? Profile::Smooth : Profile::Constant);
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.3, 0.6, 0.9))), 0, 2);
    s.addDaylight();
    const render::Result measured = render(s);
    for (const char* budget : {"1024", "1"}) {
        const render::Result planned =
            render(s, {.method = "linked_list",
                       .settings = {{"everyFrame", "true"}, {"budgetMiB", budget}}});
        for (const char* key : {"stored", "surfaces", "longestList", "dropped"})
            EXPECT_EQ(planned.counters.at(key), measured.counters.at(key)) << key;
        EXPECT_EQ(computeHash(planned.image), computeHash(measured.image)) << budget << " MiB";
    }
}

TEST_F(Determinism, BudgetBelowOneTile_IsAnInputError) {
    TestScene s(8, 8);
    const std::uint32_t medium = s.addMedium(1e-3);
    for (int i = 0; i < 2500; ++i) s.addSphere(medium, dvec3(0, 0, 1e-3 * i), 5);
    try {
        render(s, {.method = "linked_list", .settings = {{"budgetMiB", "1"}}});
        FAIL() << "2 500 intervals of 8 bytes on 64 pixels are more than 1 MiB";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    EXPECT_EQ(render(s, {.method = "linked_list", .settings = {{"budgetMiB", "2"}}}).counters.at("dropped"), 0u);
}

TEST_F(Determinism, MediaOnOneTileByTheThousands_AreAllStored) {
    // More than a device's limit of loop iterations per invocation could visit naively.
    TestScene s(8, 8);
    s.scene.camera.position.z = -8;
    const std::uint32_t medium = s.addMedium(dvec3(2e-5, 1e-5, 3e-5), dvec3(0.5));
    Random random(3);
    for (int i = 0; i < 12000; ++i)
        s.addSphere(medium, random.vector(-1, 1) * dvec3(0.01, 0.01, 1), 4);
    s.addDaylight();
    const render::Result result = render(s);
    EXPECT_EQ(result.counters.at("stored"), 12000u * 64);
    EXPECT_EQ(result.counters.at("dropped"), 0u);
    EXPECT_EQ(result.counters.at("longestList"), 12000u);
    expectExact(s, "12 000 layers");
}

}  // namespace
}  // namespace brume::test
