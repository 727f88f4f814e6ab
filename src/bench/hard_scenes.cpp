// SPDX-License-Identifier: Apache-2.0
#include <bench/hard_builder.hpp>
#include <bench/hard_scenes.hpp>
#include <core/error.hpp>

#include <algorithm>

namespace brume::bench {
namespace {

/// 1 - exp(-x) in single precision is 19 % off at x = 1e-7; what the medium scatters would be too.
NamedScene makeThin() {
    HardBuilder b;
    b.scene.lights.back().color = dvec3(1e7);
    b.addBall(b.addMedium(5e-8, dvec3(0.6, 0.8, 1)), dvec3(0), 1);
    return b.named("hard_thin");
}

/// Optical depths up to 1e30: the source's radiance and nothing behind, no infinity times zero.
NamedScene makeThick() {
    HardBuilder b;
    b.addBall(b.addMedium(1, dvec3(0.9, 0.5, 0.2)), {-0.6, 0, 0}, 0.5, 1e30);
    b.addBall(b.addMedium(1, dvec3(0.9, 0.5, 0.2)), {0.6, 0, 0}, 0.5, 1e4);
    return b.named("hard_thick");
}

/// Running sums that are taken apart again leave a residual: NaN in most rays of the paper's.
NamedScene makeCancellation() {
    HardBuilder b;
    const std::uint32_t smoke = b.addMedium(0.7, dvec3(0.9, 0.8, 0.7));
    for (int i = 0; i < 8; ++i) b.addBall(smoke, dvec3(0), 1);
    return b.named("hard_cancellation");
}

/// A residual of 1e-2 per metre would hide most of what lies behind a hundred metres of nothing.
NamedScene makeFreeSpace() {
    HardBuilder b;
    const std::uint32_t dense = b.addMedium(2000, dvec3(0.9)), thin = b.addMedium(0.001, dvec3(0.9));
    for (int i = 0; i < 12; ++i)
        b.addBall(i % 2 ? thin : dense, {-1 + 0.18 * i, 0.9, 0}, 0.3, i % 2 ? 1 : 0.001);
    b.addBall(b.addMedium(0.02, dvec3(0.9)), {0, 0, -120}, 40);
    return b.named("hard_free_space");
}

/// b^2 - c loses most hits of a sphere of 1 cm at 100 m.
NamedScene makeFarAndSmall() {
    HardBuilder b(dvec3(0, 0, 100), dvec3(0));
    b.scene.camera.verticalFov = radians(0.05);
    const std::uint32_t smoke = b.addMedium(100, dvec3(0.9, 0.6, 0.3));
    for (int i = 0; i < 9; ++i)
        b.addBall(smoke, {0.022 * (i % 3 - 1), 0.022 * (i / 3 - 1), 0}, 0.01);
    return b.named("hard_far_and_small");
}

/// Everything 10 000 km from the origin.
NamedScene makeFarOrigin() {
    const dvec3 far(1e7, -1e7, 1e7);
    HardBuilder b(far + dvec3(0, 0, 4), far);
    const std::uint32_t smoke = b.addMedium(1.5, dvec3(0.9, 0.6, 0.3));
    b.addBall(smoke, far + dvec3(-0.3, 0, 0), 0.6);
    b.addSphere(smoke, far + dvec3(0.3, 0, 0), 0.6, 1);
    return b.named("hard_far_origin");
}

/// Open at the start, and the near halves are behind the camera.
NamedScene makeCameraInside() {
    HardBuilder b(dvec3(0, 0, 0), dvec3(0, 0, -1));
    const std::uint32_t smoke = b.addMedium(0.3, dvec3(0.9, 0.6, 0.3));
    b.addBall(smoke, dvec3(0), 2);
    b.addBall(smoke, {0.5, 0, 0.5}, 1);
    b.addSphere(smoke, {0, 0.4, -0.5}, 1.2, 1);
    return b.named("hard_camera_inside");
}

NamedScene makeOverlap() {
    HardBuilder b;
    b.addBall(b.addMedium(2, dvec3(0.95, 0.2, 0.1)), {-0.25, 0, 0.1}, 0.8);
    b.addBall(b.addMedium(1.5, dvec3(0.1, 0.3, 0.95)), {0.25, 0, -0.1}, 0.8);
    b.addSphere(b.addMedium(4, dvec3(0.2, 0.9, 0.2)), {0, 0.3, 0.2}, 0.6, 1);
    return b.named("hard_overlap");
}

/// The same balls twice: sort keys tie, and intervals of length zero lie between.
NamedScene makeCoincident() {
    HardBuilder b;
    const std::uint32_t smoke = b.addMedium(0.8, dvec3(0.9, 0.6, 0.3));
    for (int i = 0; i < 3; ++i) {
        b.addBall(smoke, {-0.4, 0, 0}, 0.6);
        b.addBall(smoke, {0.4, 0, 0}, 0.6);
        b.addBall(smoke, {0.8, 0, 0}, 0.2);
    }
    return b.named("hard_coincident");
}

/// Opaque things end media before their exits come.
NamedScene makeOpaqueClip() {
    HardBuilder b;
    const std::uint32_t wall = b.addOpaque({0.5, 0.3, 0.2});
    b.addPane(wall, {1.1, 4}, {-0.5, 0, 0}, 35);
    const std::uint32_t smoke = b.addMedium(1.2, dvec3(0.9, 0.8, 0.7));
    b.addBall(smoke, dvec3(0), 1);
    b.addSphere(smoke, {0.2, 0.2, -0.4}, 0.9, 1);
    return b.named("hard_opaque_clip");
}

/// Albedo 1 in a white world stays white, however the balls overlap.
NamedScene makeFurnace() {
    HardBuilder b;
    b.scene.background.radiance = dvec3(1);
    b.scene.lights.back().color = dvec3(1);
    Random random(31);
    const std::uint32_t white = b.addMedium(2, dvec3(1));
    for (int i = 0; i < 20; ++i)
        b.addBall(white, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                  random.uniform(0.2, 0.7), random.uniform(0.1, 3));
    return b.named("hard_furnace");
}

/// Two thousand layers of coverage 1/1000: eight bits see none of them, sixteen few.
NamedScene makeFaintLayers() {
    HardBuilder b;
    b.scene.image = {16, 16, 1};
    const std::uint32_t veil = b.addThin(0.001, dvec3(0), dvec3(0.6));
    scene::Mesh all;
    for (int i = 0; i < 2000; ++i) {
        scene::Mesh pane = scene::makePlane(dvec2(4));
        scene::placeMesh(pane, place({0, 0, -0.001 * i}, 0, 90));
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (std::size_t v = 0; v < pane.positions.size(); ++v) {
            all.positions.emplace_back(pane.worldFromObject * dvec4(pane.positions[v], 1));
            all.normals.emplace_back(0, 0, 1);
            all.uvs.push_back(pane.uvs[v]);
        }
        for (const std::uint32_t index : pane.indices) all.indices.push_back(first + index);
    }
    b.addMesh(std::move(all), veil, dmat4(1));
    return b.named("hard_faint_layers");
}

/// Each channel has its own transmittance.
NamedScene makeColouredPanes() {
    HardBuilder b;
    const dvec3 colours[] = {{0.9, 0.3, 0.2}, {0.3, 0.8, 0.4}, {0.4, 0.5, 0.9}};
    for (int i = 0; i < 3; ++i)
        b.addPane(b.addThin(0.7, colours[i], dvec3(0)), dvec2(2.2), {0.3 * i - 0.3, 0, -0.5 * i});
    return b.named("hard_coloured_panes");
}

/// A hundred near layers whose weights half floats cannot sum.
NamedScene makeBrightLayers() {
    HardBuilder b;
    b.scene.lights.back().color = dvec3(300);
    for (int i = 0; i < 40; ++i)
        b.addPane(b.addThin(0.02, dvec3(0), dvec3(0.003)), dvec2(4), {0, 0, 3.9 - 0.01 * i});
    return b.named("hard_bright_layers");
}

/// Layers of two colours, each right before the other: only their order tells.
NamedScene makeOrder() {
    HardBuilder b;
    const std::uint32_t red = b.addThin(0.5, dvec3(0), {0.9, 0.1, 0.1});
    const std::uint32_t blue = b.addThin(0.5, dvec3(0), {0.1, 0.1, 0.9});
    for (const int i : {1, 2, 0}) {  // neither order of submission is right
        b.addPane(i % 2 ? red : blue, {1.5, 3}, {-0.75, 0, 0.2 * i});
        b.addPane(i % 2 ? blue : red, {1.5, 3}, {0.75, 0, 0.2 * i});
    }
    return b.named("hard_order");
}

NamedScene makeManyLayers() {
    HardBuilder b;
    b.scene.image = {24, 24, 1};
    for (int i = 0; i < 64; ++i) {
        const double hue = 0.1 * i;
        b.addPane(b.addThin(0.06, dvec3(0),
                            0.5 + 0.4 * dvec3(std::cos(hue), std::cos(hue - 2), std::cos(hue + 2))),
                  dvec2(6), {0, 0, -0.05 * ((i * 29) % 64)});
    }
    return b.named("hard_many_layers");
}

/// Rays along faces, their directions with components of zero.
NamedScene makeGrazing() {
    HardBuilder b(dvec3(0, 0, 4), dvec3(0));
    b.scene.camera.type = scene::CameraType::Orthographic;
    b.scene.camera.height = 3;
    b.addMesh(scene::makeBox(dvec3(1.0)), b.addGlass({1.5, 0.5, 0.2}, -1), place({0.01, 0.013, 0}));
    b.addBall(b.addMedium(1, dvec3(0.8)), {-1, 0.9, 0}, 0.4);
    return b.named("hard_grazing");
}

/// The eye in glass, which a wall cuts: the ray leaves what it has never entered, behind the wall.
NamedScene makeEyeInGlass() {
    HardBuilder b(dvec3(0, 0, 0.3), dvec3(0, 0, -1));
    b.addMesh(scene::makeBox(dvec3(4)), b.addGlass(dvec3(0.4), -1), place({0.1, 0.2, 0}));
    b.addPane(b.addOpaque({0.5, 0.3, 0.2}), {1.5, 3}, {-1, 0, -1}, 20);
    b.addBall(b.addMedium(1.5, dvec3(0.9, 0.6, 0.3)), {0.4, 0, -1}, 0.5);
    return b.named("hard_eye_in_glass");
}

/// Glass in smoke, smoke in glass: surfaces and intervals share one order.
NamedScene makeNested() {
    HardBuilder b;
    b.addMesh(scene::makeSphere(0.7, 24), b.addGlass({0.8, 0.3, 0.2}, -1), place({0.1, 0, 0}));
    const std::uint32_t smoke = b.addMedium(1.5, dvec3(0.9, 0.6, 0.3));
    b.addBall(smoke, {0.1, 0.05, 0}, 0.4);
    b.addBall(smoke, {-0.3, 0, 0.2}, 1);
    b.addPane(b.addThin(0.5, dvec3(0.6), {0.1, 0.3, 0.1}), dvec2(1.2), {0, 0, 0.1}, 20);
    return b.named("hard_nested");
}

/// Nearly all light goes straight on: the phase function is 4e4 there and must not overflow.
NamedScene makeForwardPeak() {
    HardBuilder b;
    b.addSun(dvec3(0, 0, 1), dvec3(1e-5));
    const std::uint32_t fog = b.addMedium(1, dvec3(0.9));
    b.scene.media[fog].phase = scene::PhaseType::HenyeyGreenstein;
    b.scene.media[fog].g = 0.999;
    b.addBall(fog, dvec3(0), 1);
    return b.named("hard_forward_peak");
}

/// Nearly all light comes straight back, and a phase function that is zero nowhere.
NamedScene makeBackwardPeak() {
    HardBuilder b;
    b.addSun(dvec3(0, 0, -1), dvec3(1e-5));
    const std::uint32_t fog = b.addMedium(1, dvec3(0.9)), air = b.addMedium(1, dvec3(0.3, 0.5, 0.9));
    b.scene.media[fog].phase = scene::PhaseType::HenyeyGreenstein;
    b.scene.media[fog].g = -0.999;
    b.scene.media[air].phase = scene::PhaseType::Rayleigh;
    b.addBall(fog, {-0.7, 0, 0}, 0.6);
    b.addBall(air, {0.7, 0, 0}, 0.6);
    return b.named("hard_backward_peak");
}

/// Light that the medium makes itself, where it is all but transparent.
NamedScene makeEmission() {
    HardBuilder b;
    b.addBall(b.addEmitter(1e-6, {0.2, 0.1, 0.05}), {-0.4, 0, 0}, 0.7);
    b.addBall(b.addEmitter(0, {0.05, 0.1, 0.2}), {0.4, 0, 0}, 0.7);
    return b.named("hard_emission");
}

const oit::MethodInfo& findMethod(const std::string& word) {
    const std::string name = word.substr(0, word.find(':'));
    for (const oit::MethodInfo& info : oit::listMethods())
        if (info.name == name) return info;
    throw inputError("judging a hard case", "method " + word, "unknown");
}

using W = oit::Weakness;
const std::vector<HardCase> kCases = {
    {"hard_thin", "optical depth 1e-7 of very bright smoke", {}, 1e-5, &makeThin},
    {"hard_thick", "optical depths of 1e4 and 1e30", {W::Thick}, 1e-5, &makeThick},
    {"hard_cancellation", "eight equal intervals: sums that must end at zero", {W::LostLayers}, 1e-5, &makeCancellation},
    {"hard_free_space", "dense and thin balls before 100 m of nothing", {}, 1e-5, &makeFreeSpace},
    {"hard_far_and_small", "balls of 1 cm at 100 m", {}, 2e-4, &makeFarAndSmall},
    {"hard_far_origin", "1e7 m from the origin", {W::Profile}, 1e-5, &makeFarOrigin},
    {"hard_camera_inside", "the camera in three media", {W::Profile}, 1e-5, &makeCameraInside},
    {"hard_overlap", "three media of different light in one place", {W::Overlap, W::Order, W::Profile}, 1e-5, &makeOverlap},
    {"hard_coincident", "every ball three times", {W::LostLayers}, 1e-5, &makeCoincident},
    {"hard_opaque_clip", "media that go on behind a wall", {W::Profile}, 1e-5, &makeOpaqueClip},
    {"hard_furnace", "albedo 1 in a white world", {W::LostLayers, W::Thick}, 1e-5, &makeFurnace},
    {"hard_faint_layers", "2 000 layers of coverage 1/1000", {W::LostLayers}, 1e-5, &makeFaintLayers},
    {"hard_coloured_panes", "coloured glass, three layers", {W::Colour}, 1e-5, &makeColouredPanes},
    {"hard_bright_layers", "40 bright layers close to the camera", {W::LostLayers}, 1e-5, &makeBrightLayers},
    {"hard_order", "red before blue beside blue before red", {W::Order, W::Surfaces}, 1e-5, &makeOrder},
    {"hard_many_layers", "64 layers of all hues", {W::Order, W::ManyLayers, W::Surfaces}, 1e-5, &makeManyLayers},
    {"hard_grazing", "rays along the faces of a solid", {W::Colour}, 1e-5, &makeGrazing},
    {"hard_eye_in_glass", "the eye in glass that a wall cuts", {W::Overlap, W::Order}, 1e-5, &makeEyeInGlass},
    {"hard_nested", "smoke in glass in smoke, and a pane", {W::Order, W::Overlap, W::Surfaces, W::Colour}, 1e-5, &makeNested},
    {"hard_forward_peak", "phase function with g = 0.999", {}, 1e-5, &makeForwardPeak},
    {"hard_backward_peak", "phase functions with g = -0.999, and Rayleigh's", {}, 1e-5, &makeBackwardPeak},
    {"hard_emission", "emission without extinction", {W::Emission}, 1e-5, &makeEmission},
    {"hard_sheared_volume", "voxels mirrored and sheared", {W::Profile}, 1e-5, &makeShearedVolume},
    {"hard_sheet_volume", "a sheet one voxel thick", {W::Profile}, 1e-5, &makeSheetVolume},
    {"hard_dynamic_range", "voxels over twelve decades", {W::Profile, W::Thick}, 1e-4, &makeDynamicRange},
    {"hard_empty_volume", "a volume without a voxel", {}, 1e-5, &makeEmptyVolume},
    {"hard_huge_tile", "voxels in a tile of 4096 cubed", {W::Profile}, 1e-5, &makeHugeTile},
    {"hard_far_voxels", "voxels two million apart", {W::Profile}, 1e-5, &makeFarVoxels},
    {"hard_tiny_voxels", "voxels of 20 micrometres", {W::Profile}, 1e-5, &makeTinyVolume},
};

}  // namespace

std::span<const HardCase> listHardCases() { return kCases; }

std::vector<NamedScene> makeHardScenes(std::string_view name) {
    std::vector<NamedScene> scenes;
    for (const HardCase& hard : kCases)
        if (name == "hard" || name == hard.name) scenes.push_back(hard.make());
    return scenes;
}

Verdict judgeHardCase(const std::string& method, const HardCase& hard, const ErrorMetrics& error) {
    constexpr double kNoisyBias = 0.01;
    const oit::MethodInfo& info = findMethod(method);
    if (error.nonFinite > 0) return Verdict::Wrong;
    const bool isExact = info.exactness == oit::Exactness::Exact || method == "tile:epsilon=0";
    if (error.max <= (isExact ? hard.tolerance : kHardTolerance)) return Verdict::Right;
    const auto maySay = [&](oit::Weakness weakness) {
        return std::find(info.weaknesses.begin(), info.weaknesses.end(), weakness) !=
               info.weaknesses.end();
    };
    if (std::any_of(hard.demands.begin(), hard.demands.end(), maySay)) return Verdict::Said;
    const bool isNoise = maySay(oit::Weakness::Noise) && std::abs(error.bias) <= kNoisyBias;
    return isNoise ? Verdict::Said : Verdict::Wrong;
}

}  // namespace brume::bench
