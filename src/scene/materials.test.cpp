#include "scene/materials.h"

#include "scene/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

using testing::ElementsAre;

/// `name`, or `otherwise` if there is no such material.
std::string_view one_of(std::string_view name, std::string_view otherwise) {
    return find_material(name) ? name : otherwise;
}

SceneDesc small_scene() {
    SceneDesc scene;
    scene.cloths.resize(2);
    scene.cloths[0].name = "sheet";
    scene.cloths[1].name = "ball";
    scene.cloths[1].fabric_name = "silk";
    scene.colliders = {ColliderDesc{.name = "ground", .shape = PlaneDesc{}},
                       ColliderDesc{.name = "ball", .shape = SphereDesc{}}};
    return scene;
}

TEST(Materials, every_fabric_has_one) {
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

TEST(Materials, of_colliders_are_matte_and_of_planes_floor) {
    EXPECT_EQ(default_material(ColliderDesc{.shape = SphereDesc{}}).name, "matte");
    EXPECT_EQ(default_material(ColliderDesc{.shape = PlaneDesc{}}).name, one_of("floor", "matte"));
}

TEST(Materials, are_those_of_the_scene_or_of_what_an_object_is) {
    SceneDesc scene = small_scene();
    EXPECT_EQ(&material_of(scene.cloths[0]), &find_material("cotton")->material);
    EXPECT_EQ(&material_of(scene.cloths[1]), &find_material("silk")->material);
    EXPECT_EQ(&material_of(scene.colliders[1]), &find_material("matte")->material);

    scene.cloths[1].material = {.preset = "velvet", .values = {.color = {1, 0, 0}}};
    EXPECT_EQ(material_of(scene.cloths[1]).color, Vec3(1, 0, 0));
    EXPECT_EQ(&material_of(scene.colliders[1]), &find_material("matte")->material) << "the collider has the same name";
}

TEST(Materials, list_their_image_files) {
    SceneDesc scene = small_scene();
    EXPECT_TRUE(picture_files(scene).empty());
    scene.light.environment.file = "hall.hdr";
    scene.cloths[1].material = {.preset = "silk", .values = {.color_map = "a.png", .normal_map = "b.png"}};
    scene.colliders[0].material = {.preset = "silk", .values = {.normal_map = "c.png"}};
    std::vector<std::string> all;
    for (const PictureFile& picture : picture_files(scene)) all.push_back(picture.place + " " + picture.file);
    EXPECT_THAT(all, ElementsAre("/light/environment/file hall.hdr", "/cloths/1/material/color_map a.png",
                                 "/cloths/1/material/normal_map b.png", "/colliders/0/material/normal_map c.png"));
}

TEST(Materials, are_checked_where_they_are_given) {
    SceneDesc scene = small_scene();
    scene.cloths[0].material = {.preset = "silk", .values = {}};
    EXPECT_TRUE(check_scene(scene).empty());
    scene.cloths[1].material = {.preset = "silk", .values = {.specular = 2}};
    scene.colliders[1].material = {.preset = "silk", .values = {.coverage = -1}};
    const Errors errors = check_scene(scene);
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].message(), "/cloths/1/material/specular: must be ≤ 1, got 2");
    EXPECT_EQ(errors[1].message(), "/colliders/1/material/coverage: must be ≥ 0.05, got -1");
}

TEST(Materials, colors_from_0_to_255_are_answered_with_the_conversion) {
    SceneDesc scene = small_scene();
    scene.cloths[0].material = {.preset = "silk", .values = {.color = {200, 0.5f, -1}}};
    scene.light.sky.zenith = {0, 0, 255};
    const Errors errors = check_scene(scene);
    ASSERT_EQ(errors.size(), 3u);
    const std::string hint = "; colors are linear RGB from 0 to 1: for values from 0 to 255, use (value / 255)^2.2";
    EXPECT_EQ(errors[0].message(), "/cloths/0/material/color/0: must be ≤ 1, got 200" + hint);
    EXPECT_EQ(errors[1].message(), "/cloths/0/material/color/2: must be ≥ 0, got -1");
    EXPECT_EQ(errors[2].message(), "/light/sky/zenith/2: must be ≤ 1, got 255" + hint);
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
