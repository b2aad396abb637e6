#include "editor/app/objects.h"

#include "editor/app/gizmo_tool.h"
#include "editor/app/property_tables.h"
#include "editor/app/scene_files.h"
#include "editor/core/scene.test.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace weft::editor {
namespace {

using testing::Contains;
using testing::ElementsAre;

TEST(Objects, can_all_be_added_duplicated_and_removed) {
    for (const AddableObject& one : addable_objects()) {
        const std::string file = one.name == "mesh" || one.name == "solid" ? "bunny.obj" : "";
        const auto added = addition(*small_document(), one.name, file);
        ASSERT_TRUE(added) << one.name << added.error().message();
        const auto with = edited(*small_document(), added->edits);
        ASSERT_TRUE(with) << one.name << ": " << with.error().message();
        ASSERT_TRUE(find((*with)->json, added->place)) << one.name;
        EXPECT_TRUE(is_object(added->place));
        const auto without = edited(**with, removal(**with, added->place));
        ASSERT_TRUE(without) << without.error().message();
        if (one.name != "wind" && one.name != "stitch") {
            EXPECT_EQ((*without)->json, small_document()->json) << one.name;
        }
        if (one.name == "stitch") continue;  // needs other vertices
        const auto copy = duplication(**with, added->place);
        ASSERT_TRUE(copy) << one.name;
        EXPECT_TRUE(edited(**with, copy->edits)) << one.name;
    }
    EXPECT_FALSE(addition(*small_document(), "teapot"));
    EXPECT_FALSE(addition(*new_document(), "stitch")) << "there is no cloth to stitch";
}

// Whatever refers to an object goes with it, so that the scene stays valid.
TEST(Objects, leave_no_references_behind) {
    const DocumentPtr document = small_document();
    const auto without_ball = edited(*document, removal(*document, "/colliders/0"));
    ASSERT_TRUE(without_ball) << without_ball.error().message();
    EXPECT_EQ((*without_ball)->scene.cloths[0].pins.size(), 2u) << "the pin stays where it is";
    const auto stitched = edited(*document, addition(*document, "stitch")->edits);
    ASSERT_TRUE(stitched);
    const auto without_cloth = edited(**stitched, removal(**stitched, "/cloths/1"));
    ASSERT_TRUE(without_cloth) << without_cloth.error().message();
    EXPECT_TRUE((*without_cloth)->scene.stitches.empty());
}

TEST(Properties, know_every_value_of_a_scene) {
    std::vector<std::string> places{"", "/solver", "/light", "/light/sun", "/camera"};
    const DocumentPtr document = small_document();
    for (const char* place : {"/cloths/0", "/cloths/0/fabric", "/cloths/0/mesh/grid", "/cloths/0/material",
                              "/colliders/0", "/colliders/0/sphere", "/colliders/0/transform"})
        places.push_back(place);
    for (const std::string& place : places) {
        const PropertyGroup group = properties_of(*document, place);
        EXPECT_FALSE(group.values.empty()) << place;
        std::vector<Property> all = group.values;
        all.insert(all.end(), group.seldom.begin(), group.seldom.end());
        for (const Property& property : all) {
            if (property.parameter->required) continue;
            const auto value = value_of(*document, place, property);
            ASSERT_TRUE(value) << place << '/' << property.key();
            // The default of every value can be written and read.
            const auto usual = default_of(property);
            if (!usual || (usual->is_string() && usual->get<std::string>().empty())) continue;
            const std::vector<Edit> edits{{place + "/" + std::string(property.key()), *usual}};
            const auto with = edited(*document, edits);
            EXPECT_TRUE(with) << place << '/' << property.key() << ": " << usual->dump()
                              << (with ? "" : with.error().message());
        }
    }
}

TEST(Properties, take_defaults_from_the_preset) {
    const DocumentPtr document = small_document();
    const auto density = [&](const std::string& place) {
        for (const Property& property : properties_of(*document, place).values)
            if (property.key() == "density") return default_of(property)->get<double>();
        return 0.0;
    };
    EXPECT_NE(density("/cloths/0/fabric"), density("/cloths/1/fabric")) << "silk and cotton";
}

TEST(Properties, of_a_cloth_begin_with_what_is_changed_often) {
    const PropertyGroup group = properties_of(*small_document(), "/cloths/0");
    std::vector<std::string> values, seldom, children;
    for (const Property& property : group.values) values.emplace_back(property.key());
    for (const Property& property : group.seldom) seldom.emplace_back(property.key());
    for (const ChildProperty& child : group.children) children.emplace_back(child.key());
    EXPECT_THAT(values, ElementsAre("name", "self_collision", "tearing"));
    EXPECT_THAT(seldom, Contains("collision_mask"));
    ASSERT_GE(children.size(), 5u);
    children.resize(5);
    EXPECT_THAT(children, ElementsAre("fabric", "transform", "mesh", "material", "pins"));
}

TEST(Properties, show_the_alternative_that_an_object_has) {
    const DocumentPtr document = small_document();
    const auto children = [&](const char* place) {
        std::vector<std::string> keys;
        for (const ChildProperty& child : properties_of(*document, place).children) keys.emplace_back(child.key());
        return keys;
    };
    EXPECT_THAT(children("/cloths/0/mesh"), ElementsAre("grid"));
    EXPECT_THAT(children("/colliders/0"), Contains("sphere"));
    EXPECT_THAT(children("/colliders/0"), testing::Not(Contains("box")));
}

TEST(Properties, of_a_wind_are_those_of_its_kind) {
    const auto document = edited(*small_document(), addition(*small_document(), "wind")->edits);
    ASSERT_TRUE(document);
    const auto keys = [](const Document& of) {
        std::vector<std::string> all;
        for (const Property& property : properties_of(of, "/air/wind/0").values) all.emplace_back(property.key());
        return all;
    };
    const auto jet = edited(**document, std::vector<Edit>{{"/air/wind/0/kind", "jet"}});
    ASSERT_TRUE(jet);
    EXPECT_THAT(keys(**jet), Contains("diameter"));
    EXPECT_THAT(keys(**document), testing::Not(Contains("diameter")));
}

TEST(Properties, new_elements_of_lists_are_valid) {
    for (const char* list : {"/cloths/0/pins", "/air/wind", "/stitches", "/cloths/0/cuts", "/cloths/0/pins/0/motion"}) {
        const auto value = new_element(*small_document(), list);
        ASSERT_TRUE(value) << list;
        const auto with = edited(*small_document(), std::vector<Edit>{{std::string(list) + "/-", *value}});
        EXPECT_TRUE(with) << list << (with ? "" : with.error().message());
    }
}

TEST(SceneFiles, of_the_program_are_valid) {
    EXPECT_EQ(first_document()->scene.cloths.size(), 1u);
    EXPECT_TRUE(new_document()->scene.cloths.empty());
    EXPECT_GT(gallery().size(), 10u);
    for (const GalleryScene& scene : gallery()) EXPECT_TRUE(open_document(scene.file)) << scene.file;
}

TEST(SceneFiles, are_saved_and_read_as_the_same_scene) {
    ScratchFolder folder;
    for (const GalleryScene& scene : gallery()) {
        const auto document = open_document(scene.file);
        ASSERT_TRUE(document);
        const auto file = folder / (scene.name + ".json");
        const auto saved = save_document(**document, file);
        ASSERT_TRUE(saved) << saved.error().message();
        const auto again = open_document(file);
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_EQ((*again)->scene.cloths.size(), (*document)->scene.cloths.size());
        EXPECT_TRUE((*again)->scene.solver == (*document)->scene.solver);
        EXPECT_TRUE((*again)->scene.air == (*document)->scene.air);
    }
    EXPECT_FALSE(save_document(*small_document(), "/proc/no/scene.json"));
    EXPECT_TRUE(save_document(*new_document(), folder / "empty.json")) << "a cloth can be added later";
}

TEST(Objects, a_mesh_begins_above_what_is_there) {
    const Bounds mesh{{1, -0.5f, 0}, {2, 0.5f, 2}};
    EXPECT_EQ(place_above(mesh, {}), Vec3{}) << "nothing to fall on";
    const Vec3 on_floor = place_above(mesh, {.objects = {}, .floor = 0.25f});
    EXPECT_EQ(on_floor.x, 0);
    EXPECT_EQ(on_floor.z, 0);
    EXPECT_NEAR(on_floor.y - 0.5f, 0.35f, 1e-3f) << "its lowest point";
    const Room room{.objects = {{-1, 0, 3}, {1, 1.5f, 4}}, .floor = 0.0f};
    const Vec3 above = place_above(mesh, room);
    EXPECT_NEAR(above.x + 1.5f, 0, 1e-3f) << "the middle over the middle";
    EXPECT_NEAR(above.z + 1, 3.5f, 1e-3f);
    EXPECT_NEAR(above.y - 0.5f, 1.6f, 1e-3f);
    EXPECT_EQ(place_above({}, room), Vec3{});
    const auto added = addition(*new_document(), "mesh", "shirt.obj", above);
    ASSERT_TRUE(added);
    EXPECT_EQ((*added->edits[0].value)["transform"]["position"][1], Json(2.1));
}

TEST(Objects, amounts_are_typed_as_one_number_or_as_many_as_the_handle_has) {
    using testing::ElementsAre;
    using testing::IsEmpty;
    EXPECT_THAT(typed_numbers("0.25", "m", 1), ElementsAre(0.25));
    EXPECT_THAT(typed_numbers("0,25", "m", 1), ElementsAre(0.25));
    EXPECT_THAT(typed_numbers("5 mm", "m", 1), ElementsAre(0.005));
    EXPECT_THAT(typed_numbers("0.1, -0.2", "m", 2), ElementsAre(0.1, -0.2));
    EXPECT_THAT(typed_numbers("0,1; 2", "m", 2), ElementsAre(0.1, 2));
    EXPECT_THAT(typed_numbers("1; 2; 3", "m", 3), ElementsAre(1, 2, 3));
    EXPECT_THAT(typed_numbers("1; 2; 3", "m", 2), IsEmpty());
    EXPECT_THAT(typed_numbers("1", "m", 2), IsEmpty());
    EXPECT_THAT(typed_numbers("", "m", 1), IsEmpty());
    EXPECT_THAT(typed_numbers("3 kg", "m", 1), IsEmpty());
    EXPECT_THAT(typed_numbers("1/0", "m", 1), IsEmpty());
}

TEST(Objects, that_are_added_have_colors_of_their_own) {
    DocumentPtr document = small_document();
    std::set<std::string> colors;
    for (const char* const kind : {"cloth", "cloth", "cloth", "sphere", "box", "capsule"}) {
        const auto added = addition(*document, kind);
        ASSERT_TRUE(added);
        auto next = edited(*document, added->edits);
        ASSERT_TRUE(next) << next.error().message();
        document = *next;
        const Json* color = find(document->json, added->place + "/material/color");
        ASSERT_TRUE(color) << kind;
        EXPECT_TRUE(colors.insert(color->dump()).second) << kind << " has the color of another one";
    }
    const auto plain = addition(*document, "mesh", "a.obj"), painted = addition(*document, "mesh", "a.obj", {}, true);
    EXPECT_TRUE(plain->edits[0].value->contains("material"));
    EXPECT_FALSE(painted->edits[0].value->contains("material"));
}

}  // namespace
}  // namespace weft::editor
