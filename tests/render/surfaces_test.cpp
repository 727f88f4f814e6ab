// SPDX-License-Identifier: Apache-2.0
// Triangles through the renderer: opaque, thin and solid, textured, mirrored, far and near.
#include <render/render_fixture.hpp>

#include <cmath>
#include <memory>

namespace brume::test {
namespace {

/// A picture of smooth colours whose alpha runs from 0 to 1, so that no edge hides in a texel.
std::shared_ptr<const scene::Texture> makeTexture(int width, int height) {
    auto texture = std::make_shared<scene::Texture>();
    texture->name = "noise";
    texture->width = width;
    texture->height = height;
    Random random(9);
    for (int i = 0; i < width * height; ++i)
        texture->texels.emplace_back(vec3(random.vector()), static_cast<float>(random.uniform()));
    return texture;
}

TestScene makeRoom(int size = 96) {
    TestScene s(size, size);
    s.scene.camera.position = dvec3(0.3, 0.9, -3.5);
    s.addMesh(scene::makePlane(dvec2(4)), s.addMaterial(makeOpaque(dvec3(0.5, 0.4, 0.3))),
              translation(dvec3(0, -0.8, 0)));
    s.addMesh(scene::makeSphere(0.5, 32), s.addMaterial(makeOpaque(dvec3(0.7), dvec3(0.1))),
              translation(dvec3(-0.4, 0, 0.3)));
    s.addDaylight();
    return s;
}

class Surfaces : public RenderTest {};

// The rasteriser snaps vertices to 1/256 pixel: pixels on edges may see another triangle.
constexpr double kEdgeShare = 5e-3;

TEST_F(Surfaces, OpaqueLambertUnderEveryLight_IsExact) {
    TestScene s = makeRoom();
    scene::Light& point = s.addLight(scene::LightType::Point, dvec3(2, 1, 0.5));
    point.position = dvec3(0.5, 0.5, -0.5);
    scene::Light& spot = s.addLight(scene::LightType::Spot, dvec3(20, 30, 40));
    spot.position = dvec3(-1, 2, -2);
    spot.direction = glm::normalize(dvec3(0.2, -0.7, 1));
    spot.innerAngle = radians(15);
    spot.outerAngle = radians(25);
    expectExact(s, "room", 2e-5, kEdgeShare);
}

TEST_F(Surfaces, TrianglesSeen_AreTheReferencesButForEdges) {
    // The bound of 2e-4 of the pixels holds for the few edges of ordinary scenes.
    TestScene s = makeRoom(256);
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.5))), -0.5, 0.7);
    const Difference d = measure(s);
    EXPECT_LE(static_cast<double>(d.excluded), 2e-4 * 256 * 256) << "of 65 536 pixels";
    EXPECT_LE(d.max, 1e-5);
    EXPECT_EQ(d.nonFinite, 0u);
}

TEST_F(Surfaces, PaneStack_IsExact) {
    TestScene s = makeRoom();
    for (int i = 0; i < 16; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const std::uint32_t pane =
            s.addMaterial(makeThin(random.uniform(), random.vector(), random.vector(0, 0.5)));
        s.addPane(pane, random.uniform(-1, 1), random.uniform(0.3, 1));
    }
    expectExact(s, "sixteen panes", 1e-5, kEdgeShare);
}

TEST_F(Surfaces, PanesInOnePlane_AreComposedInAFixedOrder) {
    TestScene s(24, 24);
    for (int i = 0; i < 8; ++i)
        s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.1 * i, 0.5, 0.9), dvec3(0.1 * i))), 0, 3);
    s.addDaylight();
    render::Renderer renderer(device(), s, {.method = "linked_list"}, log());
    const std::uint64_t hash = computeHash(renderer.renderFrame().image);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(computeHash(renderer.renderFrame().image), hash);
}

TEST_F(Surfaces, Textures_AreExact) {
    // Magnified a lot, wrapped round, of odd size; colour, alpha and emission.
    TestScene s = makeRoom();
    scene::Material cloth = makeThin(0.9, dvec3(0.6), dvec3(0.8));
    cloth.colorTexture = makeTexture(5, 3);
    cloth.emission = dvec3(0.5);
    cloth.emissionTexture = makeTexture(4, 4);
    scene::Mesh& pane = s.addPane(s.addMaterial(cloth), -0.5, 0.8);
    for (vec2& uv : pane.uvs) uv = 3.0f * uv - 1.3f;
    scene::Material painted = makeOpaque(dvec3(0.9, 0.8, 0.7), dvec3(0.2));
    painted.colorTexture = makeTexture(7, 6);
    painted.emissionTexture = makeTexture(3, 2);
    s.addMesh(scene::makeBox(dvec3(0.6)), s.addMaterial(painted),
              translation(dvec3(0.6, -0.3, 0.2)));
    expectExact(s, "textures", 1e-5, kEdgeShare);
}

TEST_F(Surfaces, TextureCoordinatesOfAnySize_ShowSomeTexel) {
    TestScene s = makeRoom();
    scene::Material cloth = makeThin(0.9, dvec3(0.6), dvec3(0.8));
    cloth.colorTexture = makeTexture(5, 3);
    scene::Mesh& pane = s.addPane(s.addMaterial(cloth), -0.5, 0.8);
    for (std::size_t i = 0; i < pane.uvs.size(); ++i)
        pane.uvs[i] = vec2(i % 2 ? 1e38f : -1e38f, i % 3 ? 1e9f : -1e20f);
    for (const char* method : {"linked_list", "weighted"}) {
        const render::Result result = render(s, {.method = method, .settings = {}});
        for (const vec3& pixel : result.image.pixels)
            ASSERT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z)) << method;
    }
}

TEST_F(Surfaces, AlphaMask_CutsTheSameHoles) {
    TestScene s = makeRoom();
    scene::Material leaf = makeThin(1, dvec3(0), dvec3(0.4, 0.8, 0.2));
    leaf.colorTexture = makeTexture(6, 6);
    leaf.alphaCutoff = 0.5;
    s.addPane(s.addMaterial(leaf), -0.5, 0.8);
    scene::Material grate = makeOpaque(dvec3(0.6));
    grate.colorTexture = makeTexture(6, 6);
    grate.alphaCutoff = 0.4;
    s.addPane(s.addMaterial(grate), 0, 0.9);
    expectExact(s, "masks", 1e-5, 1e-2);
}

TEST_F(Surfaces, MirroredAndStretchedMeshes_AreExact) {
    TestScene s = makeRoom();
    const dmat4 turn = glm::rotate(dmat4(1), 0.6, glm::normalize(dvec3(1, 2, 3)));
    const dmat4 mirror = glm::scale(turn, dvec3(-0.6, 0.9, 0.4));
    const std::uint32_t glass = s.addMaterial(makeSolid(dvec3(1, 3, 0.3), dvec3(0.5, 0.2, 0.1)));
    s.addMesh(scene::makeBox(dvec3(1)), glass, translation(dvec3(0.5, 0, -0.5)) * mirror);
    s.addMesh(scene::makeSphere(0.5, 24), glass,
              translation(dvec3(-0.6, 0.2, -0.6)) * glm::scale(dmat4(1), dvec3(1, 1, -1)));
    s.addMesh(scene::makeBox(dvec3(0.7)), s.addMaterial(makeOpaque(dvec3(0.6, 0.3, 0.3))),
              translation(dvec3(0.2, 0.8, 0.5)) * mirror);
    expectExact(s, "mirrored", 1e-5, kEdgeShare);
}

TEST_F(Surfaces, NestedSolidsAroundTheCamera_AreExact) {
    TestScene s(64, 64);
    const dvec3 colours[] = {dvec3(0.5, 0.2, 0.1), dvec3(0.1, 0.3, 0.6), dvec3(1, 1, 0.2)};
    for (int i = 0; i < 3; ++i)
        s.addMesh(scene::makeSphere(1.5 - 0.4 * i, 24),
                  s.addMaterial(makeSolid(colours[i], 0.3 * colours[i])),
                  translation(dvec3(0.1 * i, 0, 0.2 * i)));
    s.addMesh(scene::makeBox(dvec3(0.4)), s.addMaterial(makeSolid(dvec3(5))),
              translation(dvec3(-0.8, 0.2, -0.6)));  // one that the camera is not in
    s.addMesh(scene::makeBox(dvec3(4, 4, 0.1)), s.addMaterial(makeOpaque(dvec3(0.6))),
              translation(dvec3(0, 0, 0.7)));  // hides their exits
    s.addDaylight();
    for (const double z : {-4.0, -1.3, -0.7, 0.1, 0.4}) {
        s.scene.camera.position = dvec3(0.05, 0.02, z);
        s.scene.camera.target = dvec3(0.1, 0.1, 5);
        expectExact(s, "z = " + std::to_string(z), 1e-5, 1e-2);
    }
}

TEST_F(Surfaces, OrthographicCameraFarAway_IsExact) {
    for (const double distance : {5.0, 1e3, 1e6}) {
        TestScene s = makeRoom();
        const std::uint32_t medium = s.addMedium(dvec3(1, 2, 3), dvec3(0.5));
        s.addSphere(medium, dvec3(0.5, 0, 0), 0.6);
        s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.5, 0.2, 0.9))), -0.5, 0.7);
        s.scene.camera.type = scene::CameraType::Orthographic;
        s.scene.camera.height = 3;
        s.scene.camera.position = distance * glm::normalize(dvec3(0.1, 0.3, -1));
        expectExact(s, "distance " + std::to_string(distance), 1e-5, kEdgeShare);
    }
}

TEST_F(Surfaces, SceneFarFromTheOrigin_IsExact) {
    TestScene s = makeRoom();
    const dvec3 away(1e5, -2e5, 3e5);
    const std::uint32_t medium = s.addMedium(dvec3(1, 2, 3), dvec3(0.5));
    s.addSphere(medium, dvec3(0.5, 0, 0), 0.6, scene::Profile::Smooth);
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.5, 0.2, 0.9))), -0.5, 0.7);
    for (scene::Mesh& mesh : s.scene.meshes)
        mesh.worldFromObject = translation(away) * mesh.worldFromObject;
    for (scene::MediumSphere& sphere : s.spheres) sphere.center += away;
    s.scene.camera.position += away;
    s.scene.camera.target += away;
    expectExact(s, "far origin", 1e-5, kEdgeShare);
}

TEST_F(Surfaces, NearPlane_CutsWhatTheReferenceCuts) {
    TestScene s(32, 32);
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.5))), -3, 3);
    s.addPane(s.addMaterial(makeOpaque(dvec3(0.5), dvec3(0.2))), -2.5, 0.2);
    s.addMesh(scene::makeSphere(2, 24), s.addMaterial(makeSolid(dvec3(0.5))),
              translation(dvec3(0, 0, -2.5)));
    const std::uint32_t medium = s.addMedium(1);
    s.addSphere(medium, dvec3(0, 0, -3), 1.2);  // around the camera: not cut
    s.addDaylight();
    for (const double near : {1e-3, 0.999, 1.001, 1.6}) {
        s.scene.camera.near = near;
        expectExact(s, "near " + std::to_string(near), 1e-5, 1e-2);
    }
    s.scene.camera.type = scene::CameraType::Orthographic;
    s.scene.camera.height = 2;
    for (const double near : {1e-3, 1.001}) {
        s.scene.camera.near = near;
        expectExact(s, "orthographic, near " + std::to_string(near), 1e-5, 1e-2);
    }
}

TEST_F(Surfaces, Supersampling_AveragesSamples) {
    TestScene s = makeRoom(32);
    s.scene.image.supersample = 3;
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.5, 0.2, 0.9))), -0.5, 0.7);
    expectExact(s, "3 x 3", 1e-5, 3e-2);
}

TEST_F(Surfaces, Environment_IsExact) {
    TestScene s(64, 64);
    auto sky = std::make_shared<scene::Texture>(*makeTexture(16, 8));
    s.scene.background.environment = sky;
    s.scene.background.scale = 2;
    s.scene.camera.verticalFov = radians(120);
    for (const dvec3 target : {dvec3(0), dvec3(0, 4, -4.1), dvec3(-5, 1, -8)}) {
        s.scene.camera.target = target;
        expectExact(s, "sky", 2e-5);
    }
}

TEST_F(Surfaces, DegenerateTriangles_AreIgnored) {
    TestScene s = makeRoom(32);
    scene::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 1, 0}, {0.5, 0.5, 0}, {0, 0, 0}};
    mesh.normals.assign(4, vec3(0, 0, -1));
    mesh.uvs.assign(4, vec2(0));
    mesh.indices = {0, 1, 2, 0, 3, 1, 0, 0, 0};
    s.addMesh(mesh, s.addMaterial(makeThin(1, dvec3(0))));
    s.addMesh(mesh, s.addMaterial(makeOpaque(dvec3(0.5))));
    expectExact(s, "degenerate", 1e-5, kEdgeShare);
}

}  // namespace
}  // namespace brume::test
