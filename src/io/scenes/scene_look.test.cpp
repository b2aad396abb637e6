// The part of scene files that is about pictures: camera, light and look.
#include "io/scenes/scene_file.h"
#include "scene/looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string scene(const std::string& keys) {
    return R"({"weft": 1,
        "cloths": [{"name": "sheet", "fabric": "silk"}, {}, {"fabric": {"preset": "blanket", "shear": 3}}],
        "colliders": [{"name": "ground", "plane": {}}, {"sphere": {}}], )" +
           keys + "}";
}

SceneDesc read(const std::string& keys) {
    Result<SceneDesc> result = parse_scene(scene(keys), "s.json");
    EXPECT_TRUE(result) << keys << '\n' << result.error().message();
    return result ? std::move(*result) : SceneDesc();
}

std::vector<std::string> messages(const std::string& text) {
    std::vector<std::string> all;
    if (const Result<SceneDesc> result = parse_scene(text, "s.json"); !result)
        for (const Error& error : result.errors()) all.push_back(error.message());
    return all;
}

std::vector<std::string> errors_of(const std::string& keys) {
    return messages(scene(keys));
}

/// Of a scene whose sheet looks like `look`.
Material sheet(const std::string& look) {
    return look_of(read(R"("look": {"sheet": )" + look + "}"), "sheet");
}

const Material& material(std::string_view name) {
    return find_material(name)->material;
}

TEST(SceneLook, ReadsTheCamera) {
    EXPECT_FALSE(read(R"("name": "no camera")").camera);
    const SceneDesc all = read(R"("camera": {"position": [1, 2, 3], "target": [4, 5, 6], "fov": 30})");
    ASSERT_TRUE(all.camera);
    EXPECT_EQ(all.camera->position, Vec3(1, 2, 3));
    EXPECT_EQ(all.camera->target, Vec3(4, 5, 6));
    EXPECT_EQ(all.camera->fov, 30);
    const SceneDesc little = read(R"("camera": {"fov": 30})");
    ASSERT_TRUE(little.camera);
    EXPECT_EQ(little.camera->position, Camera().position);
}

TEST(SceneLook, ReadsTheLight) {
    const Lighting light = read(R"("light": {
        "sun": {"azimuth": -90, "elevation": 20, "strength": 2, "color": [1, 0.5, 0.25], "size": 0.53},
        "sky": {"strength": 0.1, "zenith": [0, 0, 1], "horizon": [0, 1, 0], "ground": [1, 0, 0]},
        "environment": {"file": "hall.hdr", "rotation": 45, "strength": 3, "visible": false},
        "exposure": -1.5, "occlusion": 0.25})")
                               .light;
    EXPECT_EQ(light.sun.azimuth, -90);
    EXPECT_EQ(light.sun.elevation, 20);
    EXPECT_EQ(light.sun.strength, 2);
    EXPECT_EQ(light.sun.color, Vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(light.sun.size, 0.53f);
    EXPECT_EQ(light.sky.strength, 0.1f);
    EXPECT_EQ(light.sky.zenith, Vec3(0, 0, 1));
    EXPECT_EQ(light.sky.horizon, Vec3(0, 1, 0));
    EXPECT_EQ(light.sky.ground, Vec3(1, 0, 0));
    EXPECT_EQ(light.environment.file, "hall.hdr");
    EXPECT_EQ(light.environment.rotation, 45);
    EXPECT_EQ(light.environment.strength, 3);
    EXPECT_FALSE(light.environment.visible);
    EXPECT_EQ(light.exposure, -1.5f);
    EXPECT_EQ(light.occlusion, 0.25f);
}

TEST(SceneLook, ReadsMaterialsByNameAndByValue) {
    const SceneDesc s = read(R"("look": {
        "sheet": "velvet",
        "cloth 1": {"material": "silk", "roughness": [0.2, 0.3], "weave": "satin", "thread": 0.1, "relief": 2,
                    "sheen_color": [0.1, 0.2, 0.3], "color_map": "a.png", "normal_map": "b.png", "map_repeat": 2},
        "collider 1": {"color": [1, 0, 0]}})");
    ASSERT_EQ(s.looks.size(), 3u);
    EXPECT_EQ(look_of(s, "sheet").velvet, material("velvet").velvet);
    const Material one = look_of(s, s.cloths[1]);
    EXPECT_EQ(one.color, material("silk").color);
    EXPECT_EQ(one.specular, material("silk").specular);
    EXPECT_THAT(one.roughness, ElementsAre(0.2f, 0.3f));
    EXPECT_EQ(one.weave, Weave::satin);
    EXPECT_EQ(one.thread, 0.1f);
    EXPECT_EQ(one.relief, 2);
    EXPECT_EQ(one.sheen_color, Vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(one.color_map, "a.png");
    EXPECT_EQ(one.normal_map, "b.png");
    EXPECT_THAT(one.map_repeat, ElementsAre(2, 2));
    EXPECT_EQ(look_of(s, s.colliders[1]).color, Vec3(1, 0, 0));
    EXPECT_EQ(look_of(s, s.colliders[1]).specular, material("matte").specular);
    for (const SceneLook& look : s.looks) {
        const std::string wanted = look.object == "sheet" ? "velvet" : look.object == "cloth 1" ? "silk" : "matte";
        EXPECT_EQ(look.preset, wanted) << look.object;
    }
}

TEST(SceneLook, BeginsWithTheMaterialOfTheFabric) {
    EXPECT_EQ(sheet("{}").roughness[0], material("silk").roughness[0]);
    EXPECT_EQ(read(R"("look": {"sheet": {}})").looks.at(0).preset, "silk");
    const SceneDesc s = read(R"("gravity": [0, 0, 0])");
    EXPECT_EQ(s.cloths[0].fabric_name, "silk");
    EXPECT_EQ(s.cloths[1].fabric_name, "cotton");
    EXPECT_EQ(s.cloths[2].fabric_name, "blanket");
    EXPECT_TRUE(s.looks.empty());
    EXPECT_EQ(look_of(s, "sheet").color, material("silk").color);
}

TEST(SceneLook, TheWeftHasTheColorOfTheWarpUnlessItIsGiven) {
    EXPECT_EQ(sheet(R"({"color": [0.5, 0, 0]})").weft_color, Vec3(0.5f, 0, 0));
    EXPECT_EQ(sheet(R"({"color": [0.5, 0, 0], "weft_color": [0, 0, 1]})").weft_color, Vec3(0, 0, 1));
    EXPECT_EQ(sheet(R"({"weft_color": [0, 0, 1]})").color, material("silk").color);
    EXPECT_EQ(sheet(R"({"thread": 1})").weft_color, material("silk").weft_color);
}

TEST(SceneLook, NamesWhatIsWrongWithTheCamera) {
    EXPECT_THAT(errors_of(R"("camera": 3)"), ElementsAre("s.json: /camera: must be an object, got 3"));
    EXPECT_THAT(errors_of(R"("camera": {"fov": 0})"), ElementsAre("s.json: /camera/fov: must be ≥ 1 °, got 0"));
    EXPECT_THAT(errors_of(R"("camera": {"fov": 180})"), ElementsAre("s.json: /camera/fov: must be ≤ 150 °, got 180"));
    EXPECT_THAT(errors_of(R"("camera": {"postion": [1, 2, 3]})"),
                ElementsAre("s.json: /camera/postion: unknown key \"postion\"; did you mean \"position\"?"));
    EXPECT_THAT(errors_of(R"("camera": {"position": [1, 2, 3], "target": [1, 2, 3]})"),
                ElementsAre("s.json: /camera/target: must be another place than \"position\""));
    EXPECT_THAT(errors_of(R"("camera": {"position": [0, 0.5, "x"], "target": [0, 0.5, 1.5]})"),
                ElementsAre("s.json: /camera/position/2: must be a number, got \"x\""));
}

TEST(SceneLook, NamesWhatIsWrongWithTheLight) {
    EXPECT_THAT(errors_of(R"("light": [])"), ElementsAre("s.json: /light: must be an object, got a list of 0"));
    EXPECT_THAT(errors_of(R"("light": {"sun": true})"), ElementsAre("s.json: /light/sun: must be an object, got true"));
    EXPECT_THAT(errors_of(R"("light": {"exposure": 30, "sun": {"color": [1, 2, 1]}, "sky": {"strength": -1}})"),
                ElementsAre("s.json: /light/exposure: must be ≤ 20 stops, got 30",
                            "s.json: /light/sun/color/1: must be ≤ 1, got 2",
                            "s.json: /light/sky/strength: must be ≥ 0, got -1"));
    EXPECT_THAT(errors_of(R"("light": {"environment": {"file": 3, "visible": 1}})"),
                ElementsAre("s.json: /light/environment/file: must be a text in quotes, got 3",
                            "s.json: /light/environment/visible: must be true or false, got 1"));
    EXPECT_THAT(errors_of(R"("light": {"moon": {}})"),
                ElementsAre("s.json: /light/moon: unknown key \"moon\"; known are \"sun\", \"sky\", \"environment\", "
                            "\"exposure\" and \"occlusion\""));
}

TEST(SceneLook, NamesWhatIsWrongWithLooks) {
    EXPECT_THAT(errors_of(R"("look": ["velvet"])"), ElementsAre("s.json: /look: must be an object, got a list of 1"));
    EXPECT_THAT(errors_of(R"("look": {"sheet": 3})"),
                ElementsAre("s.json: /look/sheet: must be the name of a material or an object, got 3"));
    EXPECT_THAT(errors_of(R"("look": {"sheet": "velvt"})"),
                ElementsAre("s.json: /look/sheet: unknown material \"velvt\"; did you mean \"velvet\"?"));
    EXPECT_THAT(errors_of(R"("look": {"sheet": {"material": "velvt"}})"),
                ElementsAre("s.json: /look/sheet/material: unknown material \"velvt\"; did you mean \"velvet\"?"));
    EXPECT_THAT(errors_of(R"("look": {"sheet": {"material": 7}})"),
                ElementsAre("s.json: /look/sheet/material: must be a text in quotes, got 7"));
    EXPECT_THAT(errors_of(R"("look": {"sheet": "wire"})"),
                ElementsAre(HasSubstr("/look/sheet: unknown material \"wire\"; known are \"")));
    EXPECT_THAT(errors_of(R"("look": {"shet": "velvet"})"),
                ElementsAre("s.json: /look/shet: unknown cloth or collider \"shet\"; did you mean \"sheet\"?"));
    EXPECT_THAT(errors_of(R"("look": {"cloth 0": "velvet"})"),
                ElementsAre("s.json: /look/cloth 0: unknown cloth or collider \"cloth 0\"; did you mean \"cloth 1\"?"));
    EXPECT_THAT(errors_of(R"("look": {"a/b": {}})"),
                ElementsAre("s.json: /look/a~1b: unknown cloth or collider \"a/b\"; known are \"sheet\", \"cloth 1\", "
                            "\"cloth 2\", \"ground\" and \"collider 1\""));
    EXPECT_THAT(errors_of(R"("look": {"sheet": {"colr": [1, 0, 0]}})"),
                ElementsAre("s.json: /look/sheet/colr: unknown key \"colr\"; did you mean \"color\"?"));
    // One color for warp and weft is one problem.
    EXPECT_THAT(errors_of(R"("look": {"sheet": {"color": [1, 2, 0]}})"),
                ElementsAre("s.json: /look/sheet/color/1: must be ≤ 1, got 2"));
    EXPECT_THAT(errors_of(R"("look": {"sheet": {"roughness": 0, "weave": "linen", "thread": 0}})"),
                ElementsAre(HasSubstr("/look/sheet/weave: must be \"smooth\", \"plain\", \"twill\""),
                            "s.json: /look/sheet/roughness: must be ≥ 0.02, got 0",
                            "s.json: /look/sheet/thread: must be ≥ 0.01 mm, got 0"));
    EXPECT_THAT(errors_of(R"("look": {"sheet": "silk", "sheet": "velvet"})"),
                ElementsAre("s.json: /look/sheet: stands twice in the same object"));
}

TEST(SceneLook, IsSilentAboutNamesThatCouldNotBeRead) {
    EXPECT_THAT(messages(R"({"weft": 1, "cloths": [{"name": 5}], "look": {"5": "silk"}})"),
                ElementsAre("s.json: /cloths/0/name: must be a text in quotes, got 5"));
    EXPECT_THAT(messages(R"({"weft": 1, "cloths": [{}], "colliders": {}, "look": {"ball": "silk"}})"),
                ElementsAre("s.json: /colliders: must be a list, got an object"));
    EXPECT_THAT(messages(R"({"weft": 1, "cloths": [{"tethers": "of"}], "look": {"ball": "silk"}})").size(), 2u);
}

TEST(SceneLook, ListsNoHundredsOfNames) {
    std::string cloths = "{}";
    for (int i = 0; i < 500; ++i) cloths += ", {}";
    const auto result =
        parse_scene(R"({"weft": 1, "cloths": [)" + cloths + R"(], "look": {"ball": "silk"}})", "s.json");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().what, "unknown cloth or collider \"ball\"");
}

}  // namespace
}  // namespace weft
