// The part of scene files that is about images: camera, light and materials.
#include "io/scenes/read_scene.test.h"
#include "scene/materials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A scene with `keys`. The keys of its first cloth and of its second collider come last.
std::string draped(const std::string& keys, const std::string& of_sheet = "", const std::string& of_ball = "") {
    const auto more = [](const std::string& text) { return text.empty() ? text : ", " + text; };
    return R"({"weft": 1,
        "cloths": [{"name": "sheet", "fabric": "silk")" +
           more(of_sheet) + R"(}, {}, {"fabric": {"preset": "blanket", "shear": 3}}],
        "colliders": [{"name": "ground", "plane": {}}, {"sphere": {})" +
           more(of_ball) + "}]" + more(keys) + "}";
}

SceneDesc read_draped(const std::string& keys) {
    return read(draped(keys));
}

std::vector<std::string> draped_errors(const std::string& keys) {
    return errors_of(draped(keys));
}

SceneDesc read_sheet(const std::string& material) {
    return read(draped("", "\"material\": " + material));
}

std::vector<std::string> sheet_errors(const std::string& material) {
    return errors_of(draped("", "\"material\": " + material));
}

/// The material of a silk cloth whose key `material` is `text`.
Material sheet(const std::string& text) {
    return material_of(read_sheet(text).cloths[0]);
}

const Material& material(std::string_view name) {
    return find_material(name)->material;
}

TEST(SceneLook, ReadsTheCamera) {
    EXPECT_FALSE(read_draped(R"("name": "no camera")").camera);
    const SceneDesc all = read_draped(R"("camera": {"position": [1, 2, 3], "target": [4, 5, 6], "fov": 30})");
    ASSERT_TRUE(all.camera);
    EXPECT_EQ(all.camera->position, Vec3(1, 2, 3));
    EXPECT_EQ(all.camera->target, Vec3(4, 5, 6));
    EXPECT_EQ(all.camera->fov, 30);
    const SceneDesc little = read_draped(R"("camera": {"fov": 30})");
    ASSERT_TRUE(little.camera);
    EXPECT_EQ(little.camera->position, Camera().position);
}

TEST(SceneLook, ReadsTheLight) {
    const Lighting light = read_draped(R"("light": {
        "sun": {"azimuth": -90, "elevation": 20, "intensity": 2, "color": [1, 0.5, 0.25], "angular_diameter": 0.53},
        "sky": {"intensity": 0.1, "zenith": [0, 0, 1], "horizon": [0, 1, 0], "ground": [1, 0, 0]},
        "environment": {"file": "hall.hdr", "rotation": 45, "intensity": 3, "visible": false},
        "exposure": -1.5, "ambient_occlusion": 0.25})")
                               .light;
    EXPECT_EQ(light.sun.azimuth, -90);
    EXPECT_EQ(light.sun.elevation, 20);
    EXPECT_EQ(light.sun.intensity, 2);
    EXPECT_EQ(light.sun.color, Vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(light.sun.angular_diameter, 0.53f);
    EXPECT_EQ(light.sky.intensity, 0.1f);
    EXPECT_EQ(light.sky.zenith, Vec3(0, 0, 1));
    EXPECT_EQ(light.sky.horizon, Vec3(0, 1, 0));
    EXPECT_EQ(light.sky.ground, Vec3(1, 0, 0));
    EXPECT_EQ(light.environment.file, "hall.hdr");
    EXPECT_EQ(light.environment.rotation, 45);
    EXPECT_EQ(light.environment.intensity, 3);
    EXPECT_FALSE(light.environment.visible);
    EXPECT_EQ(light.exposure, -1.5f);
    EXPECT_EQ(light.ambient_occlusion, 0.25f);
}

TEST(SceneLook, ReadsMaterialsByNameAndByValue) {
    EXPECT_EQ(sheet(R"("velvet")").velvet, material("velvet").velvet);
    EXPECT_EQ(read_sheet(R"("velvet")").cloths[0].material->preset, "velvet");
    const SceneDesc s = read(
        draped("", R"("material": {"preset": "linen", "roughness": [0.2, 0.3], "weave": "satin", "thread_spacing": 0.1,
            "weave_depth": 2, "sheen_color": [0.1, 0.2, 0.3], "color_map": "a.png", "normal_map": "b.png",
            "uv_tiling": 2})",
               R"("material": {"color": [1, 0, 0]})"));
    const Material& one = material_of(s.cloths[0]);
    EXPECT_EQ(s.cloths[0].material->preset, "linen");
    EXPECT_EQ(one.color, material("linen").color);
    EXPECT_EQ(one.specular, material("linen").specular);
    EXPECT_THAT(one.roughness, ElementsAre(0.2f, 0.3f));
    EXPECT_EQ(one.weave, Weave::satin);
    EXPECT_EQ(one.thread_spacing, 0.1f);
    EXPECT_EQ(one.weave_depth, 2);
    EXPECT_EQ(one.sheen_color, Vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(one.color_map, "a.png");
    EXPECT_EQ(one.normal_map, "b.png");
    EXPECT_THAT(one.uv_tiling, ElementsAre(2, 2));
    EXPECT_FALSE(s.cloths[1].material);
    EXPECT_FALSE(s.colliders[0].material);
    EXPECT_EQ(s.colliders[1].material->preset, "matte");
    EXPECT_EQ(material_of(s.colliders[1]).color, Vec3(1, 0, 0));
    EXPECT_EQ(material_of(s.colliders[1]).specular, material("matte").specular);
}

TEST(SceneLook, BeginsWithTheMaterialOfTheFabric) {
    EXPECT_EQ(sheet("{}").roughness[0], material("silk").roughness[0]);
    EXPECT_EQ(read_sheet("{}").cloths[0].material->preset, "silk");
    const SceneDesc s = read_draped(R"("gravity": [0, 0, 0])");
    EXPECT_EQ(s.cloths[0].fabric_name, "silk");
    EXPECT_EQ(s.cloths[1].fabric_name, "cotton");
    EXPECT_EQ(s.cloths[2].fabric_name, "blanket");
    EXPECT_EQ(&material_of(s.cloths[0]), &material("silk"));
}

TEST(SceneLook, TheWeftHasTheColorOfTheWarpUnlessItIsGiven) {
    EXPECT_EQ(sheet(R"({"color": [0.5, 0, 0]})").weft_color, Vec3(0.5f, 0, 0));
    EXPECT_EQ(sheet(R"({"color": [0.5, 0, 0], "weft_color": [0, 0, 1]})").weft_color, Vec3(0, 0, 1));
    EXPECT_EQ(sheet(R"({"weft_color": [0, 0, 1]})").color, material("silk").color);
    EXPECT_EQ(sheet(R"({"thread_spacing": 1})").weft_color, material("silk").weft_color);
}

TEST(SceneLook, NamesWhatIsWrongWithTheCamera) {
    EXPECT_THAT(draped_errors(R"("camera": 3)"), ElementsAre("s.json: /camera: must be an object, got 3"));
    EXPECT_THAT(draped_errors(R"("camera": {"fov": 0})"), ElementsAre("s.json: /camera/fov: must be ≥ 1 °, got 0"));
    EXPECT_THAT(draped_errors(R"("camera": {"fov": 180})"),
                ElementsAre("s.json: /camera/fov: must be ≤ 150 °, got 180"));
    EXPECT_THAT(draped_errors(R"("camera": {"postion": [1, 2, 3]})"),
                ElementsAre("s.json: /camera/postion: unknown key \"postion\"; did you mean \"position\"?"));
    EXPECT_THAT(draped_errors(R"("camera": {"position": [1, 2, 3], "target": [1, 2, 3]})"),
                ElementsAre("s.json: /camera/target: must be another place than \"position\""));
    EXPECT_THAT(draped_errors(R"("camera": {"position": [0, 0.5, "x"], "target": [0, 0.5, 1.5]})"),
                ElementsAre("s.json: /camera/position/2: must be a number, got \"x\""));
}

TEST(SceneLook, NamesWhatIsWrongWithTheLight) {
    EXPECT_THAT(draped_errors(R"("light": [])"), ElementsAre("s.json: /light: must be an object, got a list of 0"));
    EXPECT_THAT(draped_errors(R"("light": {"sun": true})"),
                ElementsAre("s.json: /light/sun: must be an object, got true"));
    EXPECT_THAT(draped_errors(R"("light": {"exposure": 30, "sun": {"color": [1, 2, 1]}, "sky": {"intensity": -1}})"),
                ElementsAre("s.json: /light/exposure: must be ≤ 20 stops, got 30",
                            "s.json: /light/sun/color/1: must be ≤ 1, got 2" + std::string(color_hint),
                            "s.json: /light/sky/intensity: must be ≥ 0, got -1"));
    EXPECT_THAT(draped_errors(R"("light": {"environment": {"file": 3, "visible": 1}})"),
                ElementsAre("s.json: /light/environment/file: must be a text in quotes, got 3",
                            "s.json: /light/environment/visible: must be true or false, got 1"));
    EXPECT_THAT(draped_errors(R"("light": {"moon": {}})"),
                ElementsAre("s.json: /light/moon: unknown key \"moon\"; known are \"sun\", \"sky\", \"environment\", "
                            "\"exposure\" and \"ambient_occlusion\""));
}

TEST(SceneLook, NamesWhatIsWrongWithMaterials) {
    EXPECT_THAT(sheet_errors("3"),
                ElementsAre("s.json: /cloths/0/material: must be the name of a material or an object, got 3"));
    EXPECT_THAT(sheet_errors(R"("velvt")"),
                ElementsAre("s.json: /cloths/0/material: unknown material \"velvt\"; did you mean \"velvet\"?"));
    EXPECT_THAT(sheet_errors(R"({"preset": "velvt"})"),
                ElementsAre("s.json: /cloths/0/material/preset: unknown material \"velvt\"; did you mean \"velvet\"?"));
    EXPECT_THAT(sheet_errors(R"({"preset": 7})"),
                ElementsAre("s.json: /cloths/0/material/preset: must be a text in quotes, got 7"));
    EXPECT_THAT(sheet_errors(R"("wire")"),
                ElementsAre(HasSubstr("/cloths/0/material: unknown material \"wire\"; known are \"")));
    EXPECT_THAT(sheet_errors(R"({"colr": [1, 0, 0]})"),
                ElementsAre("s.json: /cloths/0/material/colr: unknown key \"colr\"; did you mean \"color\"?"));
    // An invalid color for both warp and weft is reported once.
    EXPECT_THAT(sheet_errors(R"({"color": [1, 2, 0]})"),
                ElementsAre("s.json: /cloths/0/material/color/1: must be ≤ 1, got 2" + std::string(color_hint)));
    EXPECT_THAT(sheet_errors(R"({"roughness": 0, "weave": "linen", "thread_spacing": 0})"),
                ElementsAre(HasSubstr("/cloths/0/material/weave: must be \"smooth\", \"plain\", \"twill\""),
                            "s.json: /cloths/0/material/roughness: must be ≥ 0.02, got 0",
                            "s.json: /cloths/0/material/thread_spacing: must be ≥ 0.01 mm, got 0"));
    EXPECT_THAT(errors_of(draped("", "", R"("material": {"coverage": 2})")),
                ElementsAre("s.json: /colliders/1/material/coverage: must be ≤ 1, got 2"));
    EXPECT_THAT(sheet_errors(R"("silk", "material": "velvet")"),
                ElementsAre("s.json: /cloths/0/material: appears twice in the same object"));
}

TEST(SceneLook, SaysWhereTheFormerSectionOfMaterialsWent) {
    EXPECT_THAT(draped_errors(R"("look": {"sheet": "velvet"})"),
                ElementsAre("s.json: /look: unknown key \"look\"; each cloth and each collider has a key "
                            "\"material\" now"));
}

}  // namespace
}  // namespace weft
