// SPDX-License-Identifier: Apache-2.0
// Lists of thin surfaces alone, which a resolve of their own composites where they are short.
#include <oit/layer_scenes.hpp>

#include <shaders/oit/linked_list/lists.h>

#include <algorithm>
#include <numeric>

namespace brume::test {
namespace {

/// Coloured panes in random order, each `perPlace` times at the same distance.
struct Stack {
    PaneScene scene{3, dvec3(0.2, 0.4, 0.6)};
    dvec3 truth;

    Stack(std::size_t count, std::size_t perPlace, unsigned seed) {
        Random random(7);
        std::vector<std::pair<double, scene::Material>> layers;
        scene::Material material;
        for (std::size_t i = 0; i < count; ++i) {
            // Of one kind at one distance: which of them is the first is no matter.
            if (i % perPlace == 0)
                material = makeGlowing(random.uniform(0.05, 0.5), random.vector(), random.vector());
            layers.emplace_back(1 + 0.01 * static_cast<double>(i / perPlace), material);
        }
        truth = scene.scene.background.radiance;
        for (std::size_t i = count; i-- > 0;) {
            const scene::Material& m = layers[i].second;
            truth = m.coverage * (m.emission + m.transmission * truth) + (1 - m.coverage) * truth;
        }
        std::mt19937 engine(seed);
        std::shuffle(layers.begin(), layers.end(), engine);
        for (const auto& [distance, m] : layers) scene.addPanes(m, std::vector{distance});
    }
};

class LinkedList : public FamilyTest {
  protected:
    void expectTruth(const Stack& stack, const scene::Settings& settings = {}) {
        const vec3 pixel = renderWith(stack.scene, "linked_list", settings).at(1, 1);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], stack.truth[c], 1e-6);
    }
};

TEST_F(LinkedList, PanesOfAnyNumber_AreComposited) {
    // Around the entries that registers hold, and around the longest list that they sort.
    for (const std::size_t count : {1u, 8u, 9u, 25u, shader::kLongestOfSurfaces,
                                    shader::kLongestOfSurfaces + 1}) {
        SCOPED_TRACE(count);
        expectTruth(Stack(count, 1, 3));
    }
}

TEST_F(LinkedList, PanesAtOneDistance_AreAllComposited) {
    for (const std::size_t perPlace : {2u, 11u}) {
        SCOPED_TRACE(perPlace);
        expectTruth(Stack(33, perPlace, 4));
    }
}

TEST_F(LinkedList, ListsPlannedOnTheDevice_AreTheSame) {
    expectTruth(Stack(20, 1, 5), {{"everyFrame", "true"}});
}

TEST_F(LinkedList, NothingTransparent_IsWhatLiesBehind) {
    TestScene scene(16, 16);
    scene.addPane(scene.addMaterial(makeOpaque(dvec3(0), dvec3(0.4))), 0);
    expectExact(scene, "wall", 1e-6, 0.2);
}

/// A wall aslant, and a pane before or behind it, closer than single precision can tell.
TEST_F(LinkedList, PaneAtAWall_IsSeenBeforeAndHiddenBehind) {
    for (const double gap : {4e-6, -4e-6}) {
        TestScene scene(24, 24);
        const dmat4 turn = glm::rotate(dmat4(1), 0.6, dvec3(1, 0.3, 0));
        scene.addMesh(scene::makePlane(dvec2(9)), scene.addMaterial(makeOpaque(dvec3(0), dvec3(0.4))), turn);
        scene.addMesh(scene::makePlane(dvec2(9)), scene.addMaterial(makeGlowing(0.5, {0.9, 0.1, 0.1})),
                      translation({0, 0, -gap}) * turn);
        SCOPED_TRACE(gap);
        expectExact(scene, gap > 0 ? "before" : "behind", 1e-6, 0.05);
    }
}

}  // namespace
}  // namespace brume::test
