// SPDX-License-Identifier: Apache-2.0
// Method tile: exact with epsilon = 0 on everything that a ray can meet, within its bound
// otherwise; whatever the order of submission, the bands, and the tiles that need lists.
#include <render/render_fixture.hpp>

#include <algorithm>

namespace brume::test {
namespace {

using scene::Profile;

const scene::Settings kExact = {{"epsilon", "0"}};
/// What the quadrature of lists leaves at silhouettes of smooth spheres.
const double kListError = 1e-5;

/// Spheres in and around the unit cube; `sourceCount` media of different sources.
TestScene makeCloud(int count, int sourceCount, Profile profile, double radius = 0.4) {
    TestScene s(40, 40);
    Random random(11);
    for (int m = 0; m < sourceCount; ++m)
        s.addMedium(dvec3(1.5), random.vector(0.2, 1), random.vector(0, 0.3));
    for (int i = 0; i < count; ++i)
        s.addSphere(static_cast<std::uint32_t>(i % sourceCount), random.vector(-1, 1),
                    random.uniform(0.5, 1) * radius, profile, random.uniform(0.5, 2));
    s.addDaylight();
    return s;
}

/// Three spheres one behind the other, of different media.
TestScene makeRow(double radius) {
    TestScene s(40, 40);
    for (int i = 0; i < 3; ++i)
        s.addSphere(s.addMedium(dvec3(1, 2, 3) * (1.0 + i), dvec3(0.9, 0.6, 0.3), dvec3(0.1 * i)),
                    dvec3(0.1 * i, 0, i - 1), radius, i == 1 ? Profile::Smooth : Profile::Constant);
    s.scene.media[1].phase = scene::PhaseType::Rayleigh;
    s.scene.media[2].phase = scene::PhaseType::HenyeyGreenstein;
    s.scene.media[2].g = 0.7;
    s.addDaylight();
    return s;
}

class Tile : public RenderTest {
  protected:
    Tile() { mMethod = {.method = "tile", .settings = kExact}; }

    render::Result renderTile(const render::PreparedScene& scene,
                              const scene::Settings& settings = kExact) {
        return render(scene, {.method = "tile", .settings = settings});
    }
    /// How many tiles were left to lists.
    std::uint64_t countListTiles(const render::PreparedScene& scene) {
        return renderTile(scene).counters.at("tilesLists");
    }
};

TEST_F(Tile, SpheresOfOneSource_AreExactWithoutLists) {
    for (const Profile profile : {Profile::Constant, Profile::Smooth}) {
        TestScene s = makeCloud(60, 1, profile);
        expectExact(s, "outside");
        EXPECT_EQ(countListTiles(s), 0u);
        s.scene.camera.position = dvec3(0.1, 0.2, -0.1);
        s.scene.camera.target = dvec3(1, 0, 1);
        expectExact(s, "inside");
        s.scene.camera.type = scene::CameraType::Orthographic;
        s.scene.camera.height = 2;
        s.scene.media[0].extinction = dvec3(1, 2, 4);
        expectExact(s, "orthographic, coloured");
        EXPECT_EQ(countListTiles(s), 0u);
    }
}

TEST_F(Tile, MediumThatOnlyGlows_IsExact) {
    TestScene s = makeCloud(20, 1, Profile::Smooth);
    s.scene.media[0].extinction = dvec3(0, 1, 0);
    s.scene.media[0].emission = dvec3(1, 0, 2);
    expectExact(s, "one source");
    TestScene row = makeRow(0.4);
    row.scene.media[1].extinction = dvec3(0);
    expectExact(row, "row");
}

TEST_F(Tile, SpheresOneBehindTheOther_AreExactWithoutLists) {
    TestScene s = makeRow(0.45);
    expectExact(s, "grey and coloured");
    EXPECT_EQ(countListTiles(s), 0u);
    for (scene::Medium& medium : s.scene.media) medium.extinction = dvec3(3);
    expectExact(s, "grey");
}

TEST_F(Tile, ConstantSpheresThatMix_AreExactWithoutLists) {
    TestScene s = makeCloud(60, 3, Profile::Constant);
    s.spheres[7].tint = vec3(1, 0.5, 0.2);
    expectExact(s, "outside");
    EXPECT_EQ(countListTiles(s), 0u);
    EXPECT_GT(renderTile(s).counters.at("tilesMixed"), 0u);
    for (scene::Medium& medium : s.scene.media) medium.extinction *= dvec3(1, 2, 4);
    s.scene.camera.position = dvec3(0.1, 0.2, -0.1);
    s.scene.camera.target = dvec3(1, 0, 1);
    expectExact(s, "inside, coloured");
    s.scene.camera.type = scene::CameraType::Orthographic;
    s.scene.camera.height = 2;
    expectExact(s, "orthographic");
    // Farther out of order than the largest window puts right.
    TestScene pile = makeCloud(160, 3, Profile::Constant, 3);
    pile.scene.image = {24, 24, 1};
    expectExact(pile, "more than a hundred at a time");
    EXPECT_GT(countListTiles(pile), 0u);
}

TEST_F(Tile, WithoutOverlap_SpheresAreTakenAsOneBehindTheOther) {
    const scene::Settings plain = {{"epsilon", "0"}, {"overlap", "false"}};
    mMethod.settings = plain;
    expectExact(makeRow(0.4), "apart");
    const TestScene mixture = makeCloud(60, 3, Profile::Smooth);
    const render::Result result = renderTile(mixture, plain);
    EXPECT_EQ(result.counters.at("tilesMixed") + result.counters.at("tilesLists"), 0u);
    EXPECT_EQ(result.errorBound, std::nullopt);
    const Difference difference = measure(mixture);
    EXPECT_EQ(difference.nonFinite, 0u);
    EXPECT_GT(difference.rmse, 1e-4) << "that they mix is lost";
}

TEST_F(Tile, SpheresOfTwoSourcesThatOverlap_GetListsAndAreExact) {
    TestScene s = makeRow(0.6);
    expectExact(s, "row");
    const std::uint64_t listTiles = countListTiles(s);
    EXPECT_GT(listTiles, 0u);
    EXPECT_LT(listTiles, 25u) << "of 25 tiles; those at the corners see nothing";
    expectExact(makeCloud(40, 3, Profile::Smooth), "smooth cloud", kListError);
}

TEST_F(Tile, TintOfASphere_IsASourceOfItsOwn) {
    TestScene s = makeCloud(60, 1, Profile::Constant);
    s.spheres[7].tint = vec3(1, 0.5, 0.2);
    const auto counters = renderTile(s).counters;
    EXPECT_GT(counters.at("tilesMixed"), 0u);
    expectExact(s, "one of sixty");
}

TEST_F(Tile, SurfacesAndOpaqueMeshes_AreExact) {
    TestScene s = makeCloud(30, 1, Profile::Smooth);
    s.addMesh(scene::makeBox(dvec3(0.8)), s.addMaterial(makeOpaque(dvec3(0.5))),
              translation(dvec3(0.3, 0.2, 0.1)));
    expectExact(s, "opaque box", 1e-5, 1e-2);
    EXPECT_EQ(countListTiles(s), 0u);
    TestScene glass = s;
    glass.addPane(glass.addMaterial(makeThin(0.7, dvec3(0.4, 0.5, 0.9), dvec3(0.3))), -0.4, 0.5);
    glass.addMesh(scene::makeSphere(0.5, 16), glass.addMaterial(makeSolid(dvec3(1, 0.5, 0.2))),
                  translation(dvec3(0.6, -0.6, 0)));
    expectExact(glass, "pane and solid", kListError, 1e-2);
    EXPECT_GT(countListTiles(glass), 0u);
    EXPECT_LT(countListTiles(glass), 25u);
}

TEST_F(Tile, VolumesOfOneSource_AreExactWithoutLists) {
    TestScene s = makeCloud(10, 1, Profile::Smooth);
    fillBricks(s.addGrid(0, glm::scale(translation(dvec3(-0.5)), dvec3(1 / 16.0))), 2, noiseAt);
    s.addBox(0, dvec3(-1, -1, 0), dvec3(1, 0, 1), 0.3f);
    s.addGrid(0, glm::scale(dmat4(1), dvec3(0.1))).boxes = {{dvec3(-4), dvec3(3), 0.7f, true}};
    expectExact(s, "outside");
    EXPECT_EQ(countListTiles(s), 0u);
    EXPECT_GT(renderTile(s).counters.at("tilesVolumes"), 0u);
    s.scene.camera.position = dvec3(0.05, -0.1, 0.12);
    s.scene.camera.target = dvec3(1, 0.3, 1);
    expectExact(s, "inside");
    s.scene.camera.type = scene::CameraType::Orthographic;
    s.scene.camera.height = 2;
    expectExact(s, "orthographic");
    s.addMedium(dvec3(1), dvec3(0.5));
    s.scene.volumes[1].medium = 1;
    expectExact(s, "a box of another medium");
    EXPECT_GT(countListTiles(s), 0u);
}

TEST_F(Tile, VolumesInLampLight_AreExactWithoutLists) {
    TestScene s(32, 32);
    s.addMedium(dvec3(1, 2, 4), dvec3(0.9, 0.5, 0.2), dvec3(0.2));
    s.scene.media[0].phase = scene::PhaseType::HenyeyGreenstein;
    s.scene.media[0].g = 0.5;
    fillBricks(s.addGrid(0, glm::scale(translation(dvec3(-0.8)), dvec3(0.1))), 2, noiseAt);
    s.addDaylight();
    s.addLight(scene::LightType::Point, dvec3(3, 2, 1)).position = dvec3(0.1, 0.2, -0.15);
    s.scene.lights.back().radius = 0.05;
    expectExact(s, "outside");
    EXPECT_EQ(countListTiles(s), 0u);
    EXPECT_GT(renderTile(s).counters.at("tilesVolumes"), 0u);
    s.scene.camera.position = dvec3(0.05, -0.1, 0.12);
    s.scene.camera.target = dvec3(1, 0.3, 1);
    expectExact(s, "inside");
    EXPECT_EQ(countListTiles(s), 0u);
    s.addBox(0, dvec3(-1), dvec3(1), 0.3f);
    expectExact(s, "with a box across the bricks");
    EXPECT_GT(countListTiles(s), 0u);
}

TEST_F(Tile, PointLight_IsExact) {
    TestScene s = makeCloud(20, 1, Profile::Constant);
    s.addLight(scene::LightType::Point, dvec3(3)).position = dvec3(0.2, 0.3, -1.5);
    expectExact(s, "point light");
}

TEST_F(Tile, MediaBehindAWall_AreNotListed) {
    TestScene s(48, 48);
    s.addDaylight();
    const std::uint32_t smoke = s.addMedium(2, 0.8);
    for (int i = 0; i < 20; ++i) s.addSphere(smoke, dvec3(0.1 * i - 1, 0, 1), 0.5);
    s.addBox(s.addMedium(2, 0.5), dvec3(-1, -1, 1.5), dvec3(1, 1, 2.5));
    const auto countPairs = [&] { return render(s, mMethod).counters.at("pairs"); };
    const std::uint64_t all = countPairs();
    const std::uint32_t wall = s.addMaterial(makeOpaque(dvec3(0.5)));
    s.addPane(wall, 1.2, 9);
    EXPECT_LT(countPairs(), all) << "the box stands behind the wall, not all spheres do";
    expectExact(s, "wall between", 1e-5, 0.01);
    s.addPane(wall, -1, 9);
    EXPECT_EQ(countPairs(), 0u);
    expectExact(s, "wall before", 1e-5, 0.01);
}

TEST_F(Tile, MediaOfNegligibleDepth_AreNotListed) {
    TestScene s(16, 16);
    s.addDaylight();
    const std::uint32_t smoke = s.addMedium(1, 0.8);
    const std::uint32_t glow = s.addMedium(dvec3(0), dvec3(0), dvec3(1e-12));
    s.addSphere(smoke, dvec3(0), 0.5, Profile::Constant, 1e-7);
    const std::uint64_t thin = render(s, mMethod).counters.at("pairs");
    EXPECT_GT(thin, 0u) << "a strong light shows it";
    s.addSphere(smoke, dvec3(0), 0.5, Profile::Constant, 1e-10);
    EXPECT_EQ(render(s, mMethod).counters.at("pairs"), thin);
    s.addSphere(glow, dvec3(0), 0.5);
    EXPECT_EQ(render(s, mMethod).counters.at("pairs"), 2 * thin) << "glows";
    expectExact(s, "all three");
}

TEST_F(Tile, NothingToSee_IsTheBackground) {
    TestScene s(17, 9);
    expectExact(s, "empty");
    s.addSphere(s.addMedium(1), dvec3(0, 0, -9), 1);  // behind the camera
    expectExact(s, "behind the camera");
    s.addSphere(0, dvec3(0), -1);
    s.addSphere(0, dvec3(0), 1, Profile::Constant, 0);
    expectExact(s, "no radius, no density");
}

TEST_F(Tile, OrderOfSubmissionAndRepetition_GiveTheSameBits) {
    TestScene mixed = makeCloud(80, 3, Profile::Smooth);
    mixed.addPane(mixed.addMaterial(makeThin(0.7, dvec3(0.4, 0.5, 0.9), dvec3(0.3))), -0.4, 0.5);
    for (const TestScene& s : {makeCloud(200, 1, Profile::Constant), mixed}) {
        render::Renderer renderer(device(), s, mMethod, log());
        const std::uint64_t hash = computeHash(renderer.renderFrame().image);
        for (int i = 0; i < 99; ++i) EXPECT_EQ(computeHash(renderer.renderFrame().image), hash);
        for (const char* seed : {"1", "2", "3"})
            EXPECT_EQ(computeHash(renderTile(s, {{"epsilon", "0"}, {"shuffle", seed}}).image), hash)
                << seed;
        TestScene reversed = s;
        std::reverse(reversed.spheres.begin(), reversed.spheres.end());
        EXPECT_EQ(computeHash(renderTile(reversed).image), hash);
    }
}

TEST_F(Tile, Bands_GiveTheSameBits) {
    TestScene s = makeCloud(250, 3, Profile::Constant, 3);
    for (scene::Medium& medium : s.scene.media) medium.extinction = dvec3(0.01);
    const render::Result whole = renderTile(s);
    const render::Result bands = renderTile(s, {{"epsilon", "0"}, {"budgetMiB", "1"}});
    EXPECT_EQ(whole.counters.at("bands"), 1u);
    EXPECT_GT(bands.counters.at("bands"), 2u);
    EXPECT_EQ(bands.counters.at("dropped"), 0u);
    EXPECT_EQ(computeHash(bands.image), computeHash(whole.image));
}

// As within a host's frame: no count is known before.
TEST_F(Tile, EveryFramePlannedOnTheDevice_GivesTheSameBits) {
    TestScene surfaces = makeCloud(80, 3, Profile::Smooth);
    surfaces.addPane(surfaces.addMaterial(makeThin(0.7, dvec3(0.4, 0.5, 0.9), dvec3(0.3))), -0.4,
                     0.5);
    const TestScene scenes[] = {makeCloud(200, 1, Profile::Constant),
                                makeCloud(60, 3, Profile::Constant), makeRow(0.45), surfaces};
    for (const TestScene& s : scenes) {
        const render::Result measured = renderTile(s);
        const render::Result planned = renderTile(s, {{"epsilon", "0"}, {"everyFrame", "true"}});
        EXPECT_EQ(planned.counters.at("dropped"), 0u);
        for (const char* key : {"pairs", "tilesMixed", "tilesLists"})
            EXPECT_EQ(planned.counters.at(key), measured.counters.at(key)) << key;
        EXPECT_EQ(computeHash(planned.image), computeHash(measured.image));
    }
}

class TileEarlyStop : public Tile {
  protected:
    void expectWithinBound(const TestScene& s, double mostPerEpsilon) {
        const render::Result exact = renderTile(s);
        EXPECT_EQ(exact.errorBound, 0.0);
        for (const double epsilon : {1.0 / 1024, 0.2}) {
            const render::Result result = renderTile(s, {{"epsilon", std::to_string(epsilon)}});
            EXPECT_GT(result.counters.at("stopped"), 0u);
            double largest = 0;
            for (std::size_t i = 0; i < exact.image.pixels.size(); ++i) {
                const vec3 d = glm::abs(exact.image.pixels[i] - result.image.pixels[i]);
                largest = std::max({largest, double(d.x), double(d.y), double(d.z)});
            }
            EXPECT_GT(largest, 0);
            ASSERT_TRUE(result.errorBound);
            EXPECT_LE(largest, *result.errorBound + 1e-5) << "rounding aside";
            EXPECT_LE(*result.errorBound, mostPerEpsilon * epsilon) << "worth knowing";
        }
    }
};

TEST_F(TileEarlyStop, WithoutLists_StaysWithinTheBoundThatItReports) {
    TestScene spheres = makeCloud(200, 1, Profile::Constant);
    spheres.scene.media[0].extinction = dvec3(6);
    TestScene row = makeRow(0.45);
    for (scene::Medium& medium : row.scene.media) medium.extinction = dvec3(40, 30, 20);
    for (scene::MediumSphere& sphere : row.spheres) sphere.tint = vec3(1, 3, 2);
    TestScene volume(32, 32);
    volume.addMedium(60, 0.5, 3);
    fillBricks(volume.addGrid(0, glm::scale(translation(dvec3(-0.8)), dvec3(0.1))), 2, noiseAt);
    volume.addDaylight();
    TestScene lamp = volume;
    lamp.addLight(scene::LightType::Point, dvec3(3)).position = dvec3(-1, -2, -1.5);
    lamp.scene.lights.back().radius = 0.5;
    for (const TestScene& s : {spheres, row, volume, lamp}) {
        EXPECT_EQ(countListTiles(s), 0u);
        expectWithinBound(s, 100);
    }
}

/// Lists stop where all that can still come is less than epsilon.
TEST_F(TileEarlyStop, OfLists_StaysWithinEpsilon) {
    TestScene constant = makeCloud(300, 2, Profile::Constant);
    for (scene::Medium& medium : constant.scene.media) medium.extinction = dvec3(8);
    constant.addPane(constant.addMaterial(makeThin(1, dvec3(0.8, 0.6, 0.9), dvec3(0.2))), 0.3);
    TestScene smooth = makeCloud(300, 3, Profile::Smooth);
    for (scene::Medium& medium : smooth.scene.media) medium.extinction = dvec3(10, 8, 12);
    smooth.addLight(scene::LightType::Point, dvec3(3)).position = dvec3(-1, -2, -1.5);
    smooth.scene.lights.back().radius = 0.5;
    for (const TestScene& s : {constant, smooth}) {
        EXPECT_GT(countListTiles(s), 0u);
        expectWithinBound(s, 1.0001);
    }
}

TEST_F(TileEarlyStop, MediaThatGlowWithoutAbsorbing_AreNeverCutOff) {
    TestScene s = makeCloud(100, 2, Profile::Smooth);
    s.scene.media[0].extinction = dvec3(8);
    s.scene.media[1] = {};
    s.scene.media[1].extinction = dvec3(0);
    s.scene.media[1].emission = dvec3(2);
    mMethod.settings = {{"epsilon", "0.2"}};
    expectExact(s, "glow behind smoke");
}

TEST_F(Tile, Memory_IsFourBytesPerPairAndNothingPerPixel) {
    for (const int size : {64, 256}) {
        TestScene s = makeCloud(200, 1, Profile::Constant);
        s.scene.image = {size, size, 1};
        const render::Result result = renderTile(s);
        const std::uint64_t pairs = result.counters.at("pairs");
        const std::uint64_t tiles = static_cast<std::uint64_t>(size / 8) * (size / 8);
        const std::uint64_t perTile = 2 * 3 * 4 + 2 * 4, perSphere = 56 + 8 + 8 + 16;
        EXPECT_EQ(result.bytes.count("lists"), 0u);
        EXPECT_GT(pairs, tiles);
        const std::string text =
            render::Renderer(device(), s, mMethod, log()).explain();
        EXPECT_NE(text.find("methodPerPixel       0.00\n"), std::string::npos) << text;
        EXPECT_NE(text.find("perPair              4.00\n"), std::string::npos) << text;
        EXPECT_LE(result.bytes.at("pairs") + result.bytes.at("bins") + result.bytes.at("tiles"),
                  4 * pairs + perTile * tiles + perSphere * 200 + (1 << 16));
    }
}

}  // namespace
}  // namespace brume::test
