// SPDX-License-Identifier: Apache-2.0
// Every registered method, whichever they are: what it says about itself is complete, and it draws
// awkward sizes and empty scenes without a validation message.
#include <oit/method_info.hpp>
#include <render/render_fixture.hpp>

#include <set>

namespace brume::test {
namespace {

TestScene makeLittleOfEverything(int width, int height) {
    TestScene s(width, height);
    const std::uint32_t smoke = s.addMedium(dvec3(1, 2, 3), dvec3(0.5));
    s.addSphere(smoke, dvec3(0), 0.8);
    s.addSphere(smoke, dvec3(0.3), 0.5, scene::Profile::Smooth);
    s.addBox(smoke, dvec3(-1, -1, 1), dvec3(1, 1, 2));
    fillBricks(s.addGrid(smoke, glm::scale(translation(dvec3(-0.5)), dvec3(1 / 8.0))), 1, noiseAt);
    s.addPane(s.addMaterial(makeThin(0.5, dvec3(0.3, 0.6, 0.9), dvec3(0.2))), -1);
    s.addMesh(scene::makeSphere(0.5, 8), s.addMaterial(makeSolid(dvec3(1, 0.5, 0.2))));
    s.addMesh(scene::makeBox(dvec3(0.4)), s.addMaterial(makeOpaque(dvec3(0.5))),
              translation(dvec3(0, -0.5, 1)));
    s.addDaylight();
    return s;
}

class Registry : public RenderTest {
  protected:
    void expectFinite(const render::PreparedScene& scene, const std::string& method) {
        const render::Result result = render(scene, {.method = method});
        ASSERT_EQ(result.image.width, scene.scene.image.width);
        for (const vec3& pixel : result.image.pixels)
            ASSERT_TRUE(std::isfinite(pixel.x + pixel.y + pixel.z));
        EXPECT_GT(result.bytes.at("total"), 0u);
        for (const render::PassTime& pass : result.passes) EXPECT_GE(pass.timeMs, 0) << pass.name;
        for (const char* kind : {"dropped", "exhausted"}) {
            const auto counter = result.counters.find(kind);
            if (counter != result.counters.end()) {
                EXPECT_EQ(counter->second, 0u) << kind;
            }
        }
    }
};

TEST_F(Registry, EveryMethod_SaysAllAboutItself) {
    std::set<std::string_view> names;
    for (const oit::MethodInfo& info : oit::listMethods()) {
        SCOPED_TRACE(info.name);
        EXPECT_TRUE(names.insert(info.name).second);
        for (const std::string_view text :
             {info.name, info.summary, info.paper, info.passes, info.bytesPerPixel, info.limits})
            EXPECT_FALSE(text.empty());
        EXPECT_EQ(info.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"),
                  std::string_view::npos);
        for (const oit::SettingInfo& setting : info.settings) {
            EXPECT_FALSE(setting.name.empty());
            EXPECT_FALSE(setting.meaning.empty());
        }
    }
    for (const char* name : {"linked_list", "unordered", "sorted"}) EXPECT_TRUE(names.contains(name));
}

TEST_F(Registry, EveryMethod_DrawsAwkwardSizes) {
    for (const oit::MethodInfo& info : oit::listMethods())
        for (const ivec2 size : {ivec2(1, 1), ivec2(17, 9)}) {
            SCOPED_TRACE(std::string(info.name) + " " + std::to_string(size.x));
            expectFinite(makeLittleOfEverything(size.x, size.y), std::string(info.name));
        }
}

TEST_F(Registry, EveryMethod_ShowsTheBackgroundOfAnEmptyScene) {
    for (const oit::MethodInfo& info : oit::listMethods()) {
        SCOPED_TRACE(info.name);
        const TestScene s(9, 5);
        const render::Result result = render(s, {.method = std::string(info.name)});
        for (const vec3& pixel : result.image.pixels)
            EXPECT_EQ(pixel, vec3(s.scene.background.radiance));
    }
}

}  // namespace
}  // namespace brume::test
