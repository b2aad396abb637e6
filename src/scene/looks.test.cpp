#include "scene/looks.h"

#include "scene/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

using testing::ElementsAre;

/// `name`, or `otherwise` where there is no such material.
std::string_view one_of(std::string_view name, std::string_view otherwise) {
    return find_material(name) ? name : otherwise;
}

SceneDesc small_scene() {
    SceneDesc scene;
    scene.cloths.resize(2);
    scene.cloths[0].name = "sheet";
    scene.cloths[1].name = "ball";
    scene.cloths[1].fabric_name = "silk";
    scene.colliders = {{.name = "ground", .shape = PlaneDesc{}}, {.name = "ball", .shape = SphereDesc{}}};
    return scene;
}

TEST(Looks, EveryFabricHasAMaterial) {
    for (const FabricPreset& fabric : fabric_presets()) {
        SceneCloth cloth;
        cloth.fabric_name = fabric.name;
        EXPECT_EQ(default_material(cloth).name, one_of(fabric.material, "cotton")) << fabric.name;
    }
    EXPECT_EQ(find_fabric("tshirt")->material, "jersey");
    EXPECT_EQ(find_fabric("rib-knit")->material, "ribknit");
    EXPECT_EQ(default_material(SceneCloth{.fabric_name = "silk"}).name, "silk");
    EXPECT_EQ(default_material(SceneCloth{.fabric_name = "none such"}).name, "cotton");
    EXPECT_EQ(default_material(SceneCloth{}).name, "cotton");
}

TEST(Looks, CollidersAreMatteAndPlanesAreFloors) {
    EXPECT_EQ(default_material(ColliderDesc{.shape = SphereDesc{}}).name, "matte");
    EXPECT_EQ(default_material(ColliderDesc{.shape = PlaneDesc{}}).name, one_of("floor", "matte"));
}

TEST(Looks, AreThoseOfTheSceneOrOfWhatAThingIs) {
    SceneDesc scene = small_scene();
    EXPECT_EQ(look_of(scene, "sheet").color, find_material("cotton")->material.color);
    EXPECT_EQ(look_of(scene, scene.cloths[1]).color, find_material("silk")->material.color);
    EXPECT_EQ(look_of(scene, scene.colliders[1]).color, find_material("matte")->material.color);
    EXPECT_EQ(look_of(scene, "ball").color, find_material("silk")->material.color) << "the cloth goes first";
    EXPECT_EQ(look_of(scene, "none such").color, find_material("matte")->material.color);

    scene.looks = {{.object = "ball", .preset = "velvet", .material = {.color = {1, 0, 0}}}};
    EXPECT_EQ(look_of(scene, scene.cloths[1]).color, Vec3(1, 0, 0));
    EXPECT_EQ(look_of(scene, scene.colliders[1]).color, Vec3(1, 0, 0)) << "a name that both share is for both";
    EXPECT_EQ(look_of(scene, "sheet").color, find_material("cotton")->material.color);
}

TEST(Looks, KnowTheirPictures) {
    SceneDesc scene = small_scene();
    EXPECT_TRUE(picture_files(scene).empty());
    scene.light.environment.file = "hall.hdr";
    scene.looks = {{.object = "ball", .preset = "silk", .material = {.color_map = "a.png", .normal_map = "b.png"}},
                   {.object = "sheet", .preset = "silk", .material = {.normal_map = "c.png"}}};
    std::vector<std::string> all;
    for (const PictureFile& picture : picture_files(scene)) all.push_back(picture.place + " " + picture.file);
    EXPECT_THAT(all, ElementsAre("/light/environment/file hall.hdr", "/look/ball/color_map a.png",
                                 "/look/ball/normal_map b.png", "/look/sheet/normal_map c.png"));
}

TEST(CheckLooks, WantsNamesThatThereAre) {
    SceneDesc scene = small_scene();
    scene.looks = {{.object = "ball", .preset = "silk", .material = {}}};
    EXPECT_TRUE(check_scene(scene).empty());
    scene.looks.push_back({.object = "bal", .preset = "silk", .material = {.specular = 2}});
    const Errors errors = check_scene(scene);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].message(), "/look/bal/specular: must be ≤ 1, got 2");
    EXPECT_EQ(errors[1].message(), "/look/bal: unknown cloth or collider \"bal\"; did you mean \"ball\"?");
}

TEST(CheckCamera, LooksSomewhere) {
    SceneDesc scene = small_scene();
    scene.camera = Camera{.position = {1, 1, 1}, .target = {1, 1, 1}};
    const Errors errors = check_scene(scene);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].message(), "/camera/target: must be another place than \"position\"");
    scene.camera->target.y = -1;
    EXPECT_TRUE(check_scene(scene).empty());
}

}  // namespace
}  // namespace weft
