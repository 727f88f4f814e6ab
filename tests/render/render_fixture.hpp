// SPDX-License-Identifier: Apache-2.0
// Scenes made in code, rendered on the device under validation and compared with the reference.
#pragma once

#include <gpu/gpu_fixture.hpp>
#include <reference/reference.hpp>
#include <render/renderer.hpp>
#include <scene/mesh_shapes.hpp>

#include <functional>
#include <random>

namespace brume::test {

/// A scene under construction. The camera stands at (0, 0, -4) and looks along +z.
struct TestScene : render::PreparedScene {
    explicit TestScene(int width = 48, int height = 48);

    std::uint32_t addMedium(const dvec3& extinction, const dvec3& albedo = dvec3(0),
                            const dvec3& emission = dvec3(0));
    std::uint32_t addMedium(double extinction, double albedo = 0, double emission = 0) {
        return addMedium(dvec3(extinction), dvec3(albedo), dvec3(emission));
    }
    scene::MediumSphere& addSphere(std::uint32_t medium, const dvec3& center, double radius,
                                   scene::Profile profile = scene::Profile::Constant,
                                   double density = 1);
    volumes::VolumeGrid& addGrid(std::uint32_t medium, const dmat4& worldFromIndex = dmat4(1));
    /// A homogeneous box lo <= x <= hi in the world.
    void addBox(std::uint32_t medium, const dvec3& lo, const dvec3& hi, float value = 1);
    std::uint32_t addMaterial(const scene::Material& material);
    scene::Mesh& addMesh(scene::Mesh mesh, std::uint32_t material,
                         const dmat4& worldFromObject = dmat4(1));
    /// A square in the plane z that faces the camera.
    scene::Mesh& addPane(std::uint32_t material, double z, double halfSize = 1);
    scene::Light& addLight(scene::LightType type, const dvec3& color);
    /// Ambient light and a sun.
    void addDaylight();
};

scene::Material makeThin(double coverage, const dvec3& transmission,
                         const dvec3& reflected = dvec3(0));
scene::Material makeSolid(const dvec3& absorption, const dvec3& scattering = dvec3(0));
scene::Material makeOpaque(const dvec3& albedo, const dvec3& emission = dvec3(0));

dmat4 translation(const dvec3& offset);

/// Fills a grid with one brick per 8^3 cells of [0, 8 bricks)^3 from a function of the index.
void fillBricks(volumes::VolumeGrid& grid, int bricks,
                const std::function<float(const ivec3&)>& value);

/// Values in [0, 1], a share of them 0, the same wherever they are asked for.
float noiseAt(const ivec3& index);

/// Uniform numbers that do not depend on the standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : mEngine(seed) {}
    double uniform(double lo = 0, double hi = 1) {
        return lo + (hi - lo) * static_cast<double>(mEngine() >> 11) * 0x1p-53;
    }
    dvec3 vector(double lo = 0, double hi = 1) {
        const double x = uniform(lo, hi), y = uniform(lo, hi);
        return {x, y, uniform(lo, hi)};
    }

  private:
    std::mt19937_64 mEngine;
};

/// How far a method is from the reference.
struct Difference {
    double max = 0, rmse = 0;
    std::uint64_t nonFinite = 0;
    std::uint64_t excluded = 0;  ///< pixels in which both saw different triangles
    double largest = 0;          ///< radiance of the reference
    ivec2 worst{0};              ///< pixel of `max`
};

class RenderTest : public GpuTest {
  protected:
    // A test renders several times with one device, as the command line does; making pipelines
    // anew each time would take longer than all else.
    RenderTest() { mKeepsPipelines = true; }
    render::Result render(const render::PreparedScene& scene,
                          render::Options options = {.method = "linked_list"});
    std::uint64_t hashOf(const render::PreparedScene& scene, const scene::Settings& settings = {});

    reference::Result renderReference(const render::PreparedScene& scene) const;

    /// Renders with mMethod and the reference. Checks that nothing was lost.
    Difference measure(const render::PreparedScene& scene);
    Difference measure(const render::PreparedScene& scene, const reference::Result& expected);

    /// measure(), and: finite, at most `maxError`; different triangles in at most `excludedShare`
    /// of the pixels. Prints the figures as a record of the test.
    void expectExact(const render::PreparedScene& scene, const std::string& name,
                     double maxError = 1e-5, double excludedShare = 0);

    render::Options mMethod{.method = "linked_list"};  ///< what measure() and expectExact() test
    bool mWithShadows = false;  ///< in the reference
};

}  // namespace brume::test
