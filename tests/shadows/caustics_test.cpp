// SPDX-License-Identifier: Apache-2.0
// Caustics by density: the shadow of glass against McGuire and Mara 2016, eq. 10 to 12, in double
// precision.
#include <core/error.hpp>
#include <shadows/shadow_fixture.hpp>

namespace brume::test {
namespace {

/// Share of light behind glass that lets `transmittance` through without caustics.
double transmittanceWithCaustics(double transmittance, double ior, double cosine) {
    const double s = std::clamp((ior - 1) / 2, 0.0, 1.0);
    if (s == 0) return transmittance;
    const double g = 2 * (1 - std::pow(cosine, 128 * s * s)) - 1;
    return 1 - std::min((1 + g * std::pow(s, 0.2)) * (1 - transmittance), 1.0);
}

/// A pane of coverage 0.6, transmission 0.3, tilted against a sun from above.
TestScene makePane(const std::string& shadow, double degrees, double ior) {
    TestScene s;
    addSun(s, shadow, dvec3(0, -1, 0));
    scene::Material material = makeThin(0.6, dvec3(0.3));
    material.ior = ior;
    s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(material),
              glm::rotate(dmat4(1), radians(degrees), dvec3(1, 0, 0)));
    return s;
}

TestScene makeBall(const std::string& shadow, double ior) {
    TestScene s;
    addSun(s, shadow, dvec3(0, -1, 0));
    scene::Material material = makeSolid(dvec3(0.5));
    material.ior = ior;
    s.addMesh(scene::makeSphere(1, 128), s.addMaterial(material));
    return s;
}

const scene::Settings kCaustics{{"caustics", "true"}};
const std::vector<dvec3> kBelow = scatterPoints(8, 300, dvec3(-0.4, -3, -0.4), dvec3(0.4, -2.9, 0.4));

class Caustics : public ShadowTest {};

TEST_F(Caustics, BehindTiltedPane_EqualTheEquations) {
    for (const double ior : {1.3, 2.4})
        for (const double degrees : {0.0, 25.0, 70.0}) {
            SCOPED_TRACE(testing::Message() << "ior " << ior << ", " << degrees << " degrees");
            const double expected =
                transmittanceWithCaustics(1 - 0.6 * 0.7, ior, std::cos(radians(degrees)));
            for (const vec3& t : probe(makePane("total", degrees, ior), kBelow, kCaustics))
                ASSERT_NEAR(t.x, expected, 2e-4);
        }
}

TEST_F(Caustics, BehindBall_EqualTheEquations) {
    const TestScene s = makeBall("total", 1.5);
    const std::vector<vec3> seen = probe(s, kBelow, kCaustics);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const double aside2 = kBelow[i].x * kBelow[i].x + kBelow[i].z * kBelow[i].z;
        const double cosine = std::sqrt(1 - aside2);
        const double expected = transmittanceWithCaustics(std::exp(-0.5 * 2 * cosine), 1.5, cosine);
        // The ball has 128 segments, the map 512 texels.
        EXPECT_NEAR(seen[i].x, expected, 4e-3);
    }
}

TEST_F(Caustics, HigherIndex_GathersMoreLightInTheMiddle) {
    const std::vector<dvec3> middle{dvec3(0.01, -3, 0.01)}, rim{dvec3(0.9, -3, 0.01)};
    double lastMiddle = 0, lastRim = 1;
    for (const double ior : {1.0, 1.3, 1.5}) {
        const TestScene s = makeBall("total", ior);
        const double inMiddle = probe(s, middle, kCaustics)[0].x;
        const double atRim = probe(s, rim, kCaustics)[0].x;
        EXPECT_GT(inMiddle, lastMiddle + 0.03);
        EXPECT_LE(atRim, lastRim);
        lastMiddle = inMiddle;
        lastRim = atRim;
    }
}

TEST_F(Caustics, StochasticMaps_AgreeWithTheTotal) {
    for (const char* store : {"stochastic", "stochastic_vsm"}) {
        SCOPED_TRACE(store);
        scene::Settings settings{{"caustics", "true"}, {"samples", "8"}};
        if (store == std::string("stochastic")) settings["alphaCorrection"] = "false";
        double mean = 0, expected = 0;
        for (const vec3& t : probe(makeBall(store, 1.5), kBelow, settings)) mean += t.x;
        for (const vec3& t : probe(makeBall("total", 1.5), kBelow, kCaustics)) expected += t.x;
        EXPECT_NEAR(mean / expected, 1.0, 0.02);
    }
}

TEST_F(Caustics, NotAskedFor_ChangeNothing) {
    const std::vector<vec3> with = probe(makePane("total", 30, 1.0), kBelow, kCaustics);
    const std::vector<vec3> without = probe(makePane("total", 30, 1.0), kBelow);
    for (std::size_t i = 0; i < with.size(); ++i) EXPECT_NEAR(with[i].x, without[i].x, 1e-6);
    for (const vec3& t : probe(makePane("total", 30, 1.5), kBelow)) EXPECT_NEAR(t.x, 0.58, 1e-6);
}

TEST_F(Caustics, WithExact_AreRefused) {
    try {
        probe(makePane("exact", 0, 1.5), kBelow, kCaustics);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("caustics"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace brume::test
