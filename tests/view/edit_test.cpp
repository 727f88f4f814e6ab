// SPDX-License-Identifier: Apache-2.0
// Editing effect files, watching files, reloading scenes, recording.
#include <bench/prepare.hpp>
#include <core/error.hpp>
#include <core/image_io.hpp>
#include <particles/modules/module.hpp>
#include <scene/loader.hpp>
#include <view/document.hpp>
#include <view/recorder.hpp>

#include <sys/stat.h>

#include <cstdlib>

#include "scratch_folder.hpp"

namespace brume::view {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
}

EffectKey findKey(const EffectEdit& edit, const std::string& pointer) {
    for (const EffectGroup& group : edit.groups())
        for (const EffectKey& key : group.keys)
            if (key.pointer == pointer) return key;
    ADD_FAILURE() << "no key " << pointer;
    return {};
}

TEST(JsonText_ChangedValue, LeavesAllElseInPlace) {
    const std::string text =
        "{ \"b\": [1, { \"x\": \"a,}\\\"\" }], // note\n  \"a\": 2.50, \"c\": {} }\n";
    JsonText json(text, "t.json");
    json.set("/a", 7);
    EXPECT_EQ(json.text(), replaced(text, "2.50", "7"));
    json.set("/b/1/x", "new");
    json.set("/b/0", 0.1f);
    EXPECT_EQ(json.text(),
              "{ \"b\": [0.1, { \"x\": \"new\" }], // note\n  \"a\": 7, \"c\": {} }\n");
    json.set("/c/y", {1, 2.5});
    json.set("/z", true);
    EXPECT_EQ(
        json.text(),
        "{ \"b\": [0.1, { \"x\": \"new\" }], // note\n  \"a\": 7, \"c\": { \"y\": [1, 2.5] }, "
        "\"z\": true }\n");
    EXPECT_EQ(json.root()["c"]["y"][1], 2.5);
}

TEST(JsonText_MissingPlace, IsRefused) {
    JsonText json("{ \"a\": [1] }", "t.json");
    EXPECT_THROW(json.set("/b/c", 1), Error);
    EXPECT_THROW(json.set("/a/3", 1), Error);
    EXPECT_EQ(json.text(), "{ \"a\": [1] }");
}

TEST(EffectEdit_Groups, ComeFromSchemaAndModuleTables) {
    const ScratchFolder folder;
    const EffectEdit edit(folder / "sparks.effect.json");
    const std::vector<EffectGroup> groups = edit.groups();
    ASSERT_EQ(groups.size(), 4u);  // effect, emitter, two modules
    EXPECT_EQ(groups[2].title, "gravity");
    for (const particles::Module& module : particles::modules())
        if (module.info.name == "drag") {
            EXPECT_EQ(groups[3].summary, module.info.summary);
            EXPECT_EQ(groups[3].keys.size(), module.info.keys.size());
        }
    const EffectKey rate = findKey(edit, "/modules/1/rate");
    EXPECT_EQ(rate.values, std::vector<double>{0.5});
    EXPECT_EQ(rate.unit, "1/s");
    EXPECT_FALSE(rate.summary.empty());
    const EffectKey speed = findKey(edit, "/emitters/0/speed");
    EXPECT_TRUE(speed.isPair);
    EXPECT_EQ(speed.values, (std::vector<double>{0.5, 1}));
    EXPECT_EQ(findKey(edit, "/emitters/0/rate").summary, "Particles per second");
    EXPECT_EQ(findKey(edit, "/profile").word, "smooth");
    EXPECT_TRUE(findKey(edit, "/capacity").isInteger);
}

TEST(EffectEdit_SavedChange, KeepsCommentsAndOrder) {
    const ScratchFolder folder;
    EffectEdit edit(folder / "sparks.effect.json");
    EffectKey rate = findKey(edit, "/modules/1/rate");
    rate.values = {0.75};
    edit.set(rate);
    EffectKey wind = findKey(edit, "/modules/1/wind");  // the file has none
    wind.values = {1, 0, 0.5};
    edit.set(wind);
    EXPECT_TRUE(edit.isChanged());
    EXPECT_EQ(folder.read("sparks.effect.json"), test::kSparks);
    edit.save();
    EXPECT_FALSE(edit.isChanged());
    EXPECT_EQ(folder.read("sparks.effect.json"),
              replaced(test::kSparks, "\"rate\": 0.5 }",
                       "\"rate\": 0.75,\n      \"wind\": [1, 0, 0.5] }"));
    EXPECT_FALSE(fs::exists(folder / "sparks.effect.json.part"));
}

TEST(EffectEdit_RefusedValue, ChangesNothing) {
    const ScratchFolder folder;
    EffectEdit edit(folder / "sparks.effect.json");
    EffectKey lifetime = findKey(edit, "/emitters/0/lifetime");
    lifetime.values = {-1, -1};
    EXPECT_THROW(edit.set(lifetime), Error);
    EXPECT_EQ(edit.text(), test::kSparks);
}

/// The clock of some file systems is coarse: a change of size is seen at once.
TEST(FileWatch_ChangedFile, IsReportedOnceWhenItRests) {
    const ScratchFolder folder;
    FileWatch watch;
    watch.watch({folder / "scene.json", folder / "later.json"});
    EXPECT_TRUE(watch.takeChanged().empty());
    folder.write("scene.json", "longer than nothing");
    EXPECT_TRUE(watch.takeChanged().empty());  // may still be written
    EXPECT_EQ(watch.takeChanged(), std::vector<fs::path>{folder / "scene.json"});
    EXPECT_TRUE(watch.takeChanged().empty());
    folder.write("later.json", "{}");
    watch.takeChanged();
    EXPECT_EQ(watch.takeChanged(), std::vector<fs::path>{folder / "later.json"});
}

/// Twice: a changed file must rest.
std::optional<Document::News> poll(Document& document) {
    document.pollFiles();
    return document.pollFiles();
}

TEST(Document_BadScene, IsToldAndTheLastGoodOneStays) {
    const ScratchFolder folder;
    const Log log;
    Document document(folder / "scene.json", log);
    const std::uint64_t revision = document.revision();
    EXPECT_EQ(document.homeTime(), 1.5);
    folder.write("scene.json", replaced(test::kScene, "\"lights\"", "\"lihgts\""));
    const auto news = poll(document);
    ASSERT_TRUE(news);
    EXPECT_TRUE(news->isError);
    EXPECT_NE(news->text.find("scene.json:5:"), std::string::npos) << news->text;
    EXPECT_EQ(news->text.find('\n'), std::string::npos);
    EXPECT_EQ(document.revision(), revision);
    EXPECT_EQ(document.prepared().scene.lights.size(), 2u);
    folder.write("scene.json", replaced(test::kScene, "\"time\": 1.5", "\"time\": 2.25"));
    const auto good = poll(document);
    ASSERT_TRUE(good);
    EXPECT_FALSE(good->isError) << good->text;
    EXPECT_EQ(document.homeTime(), 2.25);
}

TEST(Document_ChangedEffect, IsReloadedAndBadOnesAreNot) {
    const ScratchFolder folder;
    const Log log;
    Document document(folder / "scene.json", log);
    const std::uint64_t key = document.prepared().scene.effects[0].key;
    folder.write("sparks.effect.json", replaced(test::kSparks, "\"rate\": 40", "\"rate\": 400"));
    ASSERT_TRUE(poll(document));
    EXPECT_EQ(document.prepared().scene.effects[0].effect.emitters[0].rate, 400);
    EXPECT_NE(document.prepared().scene.effects[0].key, key);
    folder.write("sparks.effect.json", replaced(test::kSparks, "\"rate\": 40", "\"rate\": -400"));
    const auto news = poll(document);
    ASSERT_TRUE(news);
    EXPECT_TRUE(news->isError);
    EXPECT_EQ(document.prepared().scene.effects[0].effect.emitters[0].rate, 400);
    EXPECT_NE(document.effects()[0]->text().find("\"rate\": 400"), std::string::npos);
}

// Ribbons of sub-emitters have the material that they ask for, as in `brume render`.
TEST(Document_SubEmitters, KeepTheirMaterialsAndMedia) {
    const ScratchFolder folder;
    folder.write("trail.effect.json", R"({ "version": 1, "capacity": 100, "tickRate": 30,
      "surface": { "type": "ribbon", "material": "pane" }, "emitters": [ { "lifetime": 0.3 } ],
      "overLife": { "radius": [[0, 0.04], [1, 0.01]] } })");
    folder.write("sparks.effect.json",
                 replaced(test::kSparks, "\"modules\"",
                          "\"subEmitters\": [ { \"on\": \"way\", \"effect\": "
                          "\"trail.effect.json\", \"rate\": 40 } ],\n  \"modules\""));
    const Log log;
    const Document document(folder / "scene.json", log);
    const scene::Scene& shown = document.prepared().scene;
    const scene::Scene rendered =
        bench::prepareScene(scene::loadScene(folder / "scene.json", log), log).scene;
    ASSERT_EQ(shown.effects.size(), 2u);
    EXPECT_EQ(shown.effects[0].medium, rendered.effects[0].medium);
    const std::uint32_t material = shown.effects[1].material;
    EXPECT_EQ(material, rendered.effects[1].material);
    EXPECT_EQ(shown.materials.at(material).type, scene::MaterialType::Thin);
    EXPECT_EQ(shown.materials[material].transmission, dvec3(0.9, 0.2, 0.1));
}

TEST(Document_EditedEffect, ShowsAtOnceAndSavingIsNoNews) {
    const ScratchFolder folder;
    const Log log;
    Document document(folder / "scene.json", log);
    EffectEdit& edit = *document.effects()[0];
    EffectKey rate = findKey(edit, "/emitters/0/rate");
    rate.values = {80};
    edit.set(rate);
    document.applyEffects();
    EXPECT_EQ(document.prepared().scene.effects[0].effect.emitters[0].rate, 80);
    EXPECT_EQ(document.prepared().spheres.size(), 1u);
    edit.save();
    EXPECT_FALSE(poll(document));
    // Another file's change leaves what is not saved.
    rate.values = {90};
    edit.set(rate);
    folder.write("scene.json", std::string(test::kScene) + "\n");
    EXPECT_TRUE(poll(document));
    EXPECT_EQ(document.prepared().scene.effects[0].effect.emitters[0].rate, 90);
}

TEST(Recorder_Sequence, IsNumbered) {
    const ScratchFolder folder;
    Recorder recorder(folder / "new/f_###.png", 24);
    recorder.add(Image(4, 2, vec3(0.5)), 7);
    recorder.add(Image(4, 2, vec3(0.25f)), 8);
    recorder.finish();
    EXPECT_EQ(recorder.count(), 2);
    EXPECT_NEAR(readImage(folder / "new/f_007.png").at(3, 1).x, 0.5, 0.01);
    EXPECT_TRUE(fs::exists(folder / "new/f_008.png"));
}

TEST(Recorder_UnknownKind, IsRefused) { EXPECT_THROW(Recorder("film.txt", 24), Error); }

/// Puts a program called ffmpeg into the PATH, and nothing else.
class PathScope {
  public:
    PathScope(const ScratchFolder& folder, const std::string& program)
        : mBefore(std::getenv("PATH")) {
        if (!program.empty()) {
            folder.write("ffmpeg", "#!/bin/sh\nPATH=/usr/bin:/bin\n" + program);
            chmod((folder / "ffmpeg").c_str(), 0755);
        }
        setenv("PATH", (folder / "").c_str(), 1);
    }
    ~PathScope() { setenv("PATH", mBefore.c_str(), 1); }

  private:
    std::string mBefore;
};

// Whatever the program, it must be given whole pictures and the words that ffmpeg wants.
TEST(Recorder_Film, GivesWholePicturesToFfmpeg) {
    const ScratchFolder folder;
    const PathScope path(folder,
                         "echo \"$@\" > \"$(dirname \"$0\")/words\"\nfor last; do :; done\n"
                         "cat > \"$last\"\n");
    ASSERT_TRUE(hasFfmpeg());
    Recorder recorder(folder / "film.mp4", 25);
    const Image image(6, 4, vec3(1.0f, 0.0f, 0.25f));
    for (int i = 0; i < 3; ++i) recorder.add(image, i);
    EXPECT_THROW(recorder.add(Image(5, 4), 3), Error);
    recorder.finish();
    const std::string film = folder.read("film.mp4");
    ASSERT_EQ(film.size(), 3u * 6 * 4 * 3);
    EXPECT_EQ(static_cast<unsigned char>(film[0]), encodeSrgb8(image)[0]);
    const std::string words = folder.read("words");
    EXPECT_NE(words.find("-pix_fmt rgb24 -s 6x4 -r 25 -i -"), std::string::npos) << words;
}

TEST(Recorder_FailingFfmpeg, IsToldAndItsFileRemoved) {
    const ScratchFolder folder;
    const PathScope path(folder, "cat > /dev/null\nexit 3\n");
    Recorder recorder(folder / "film.mp4", 25);
    recorder.add(Image(2, 2), 0);
    EXPECT_THROW(recorder.finish(), Error);
    const PathScope without(folder, "");
    fs::remove(folder / "ffmpeg");
    EXPECT_FALSE(hasFfmpeg());
    EXPECT_THROW(Recorder(folder / "film.mp4", 25), Error);
}

}  // namespace
}  // namespace brume::view
