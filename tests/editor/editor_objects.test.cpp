// Objects and their values in the editor's window.
#include "editor_fixture.h"

namespace weft::editor {
namespace {

TEST_F(EditorWindow, objects_are_added_selected_duplicated_renamed_deleted_and_all_of_it_undone) {
    DrivenEditor& e = open(empty);
    pause();
    e.click("objects/add/more");
    for (const char* kind : {"cloth", "box", "sphere", "capsule", "plane", "wind"})
        e.click(std::string("objects/add/") + kind);
    EXPECT_EQ(e.value("objects/cloths/0/select"), "sheet");
    EXPECT_EQ(e.value("objects/colliders/1/select"), "box");
    EXPECT_EQ(e.value("objects/colliders/2/select"), "ball");
    EXPECT_EQ(e.value("objects/colliders/3/select"), "capsule");
    EXPECT_EQ(e.value("objects/colliders/4/select"), "floor 2");
    EXPECT_EQ(e.value("objects/air/wind/0/select"), "on") << "what was added is selected";
    EXPECT_EQ(e.actions("change").size(), 6u);

    // By its card, and by a click in the view.
    e.click("objects/colliders/2/select");
    EXPECT_TRUE(e.shows("properties/colliders/2/name"));
    e.key("3");
    const Point ball = e.place("middle/view/gizmo/center").center();
    e.key("Escape");
    EXPECT_FALSE(e.shows("properties/colliders/2/name"));
    e.click(ball + Point{12, 24});
    EXPECT_THAT(e.names("properties/colliders/"), testing::Contains(testing::EndsWith("/name")));

    e.click("objects/colliders/2/select");
    e.key("ctrl+d");
    EXPECT_EQ(e.value("objects/colliders/5/select"), "on");
    EXPECT_EQ(e.value("properties/colliders/5/name"), "ball 2");
    e.key("F2");
    e.until("the name can be typed", [&] { return e.shows("objects/colliders/5/name"); });
    e.type("moon");
    e.key("Return");
    EXPECT_EQ(e.value("properties/colliders/5/name"), "moon");
    ASSERT_EQ(e.actions("rename").size(), 1u);
    e.key("Delete");
    EXPECT_FALSE(e.shows("objects/colliders/5/select"));
    EXPECT_EQ(e.played().document()->scene.colliders.size(), 5u);

    undo_everything();
    EXPECT_FALSE(e.shows("objects/cloths/0/select"));
    EXPECT_FALSE(e.shows("objects/colliders/1/select"));
    expect_nothing_is_left();
    e.key("ctrl+shift+z");
    EXPECT_TRUE(e.shows("objects/cloths/0/select"));
}

TEST_F(EditorWindow, values_are_typed_dragged_reset_and_reached_by_keys_alone) {
    DrivenEditor& e = open(hanging);
    pause();
    e.click("objects/cloths/0/select");
    const std::string density = "properties/cloths/0/fabric/density", preset = "properties/cloths/0/fabric/preset";
    e.scroll_to(preset, "properties/cloths/0/name");
    e.click(preset);
    ASSERT_TRUE(e.shows(preset + "/leather"));
    e.key("Escape");
    EXPECT_FALSE(e.shows(preset + "/leather"));
    ASSERT_TRUE(e.shows(preset)) << "Escape closes the list and leaves the selection";
    e.scroll_to(density, "properties/cloths/0/name");
    const double usual = e.number(density);
    e.click(density);
    e.type("0.3");
    e.key("Return");
    EXPECT_DOUBLE_EQ(e.number(density), 0.3);
    ASSERT_EQ(e.actions("change").size(), 1u);
    EXPECT_EQ(std::get<ChangeScene>(e.actions("change")[0]).edits[0].place, "/cloths/0/fabric/density");

    const Rectangle box = e.place(density);
    e.drag(box.at(0.3, 0.5), box.at(0.6, 0.5));
    EXPECT_GT(e.number(density), 0.31);
    EXPECT_EQ(e.played().history().done().size(), 2u) << "a drag is one undo step";
    e.double_click(density);
    EXPECT_DOUBLE_EQ(e.number(density), usual);
    e.key("ctrl+z");
    EXPECT_GT(e.number(density), 0.31);
    e.key("ctrl+z");
    EXPECT_DOUBLE_EQ(e.number(density), 0.3);
    e.key("ctrl+z");
    EXPECT_DOUBLE_EQ(e.number(density), usual);

    // Damping comes after density.
    const std::string damping = "properties/cloths/0/fabric/damping";
    const double before = e.number(damping);
    for (int i = 0; i < 200 && e.focused() != density; ++i) e.key("Tab");
    e.key("Tab");
    EXPECT_TRUE(e.is_focused(damping));
    e.key("Right");
    EXPECT_GT(e.number(damping), before);
    e.key("Left");
    e.key("0");
    e.key("period");
    e.key("2");
    e.key("Return");
    EXPECT_DOUBLE_EQ(e.number(damping), 0.2);
    undo_everything();
    expect_nothing_is_left();
}

TEST_F(EditorWindow, sets_of_groups_are_boxes_and_pairs_of_numbers_have_names) {
    DrivenEditor& e = open(hanging);
    pause();
    e.click("objects/cloths/0/select");
    const std::string mask = "properties/cloths/0/collision_mask";
    e.scroll_to("properties/cloths/0/more", "properties/cloths/0/name");
    e.click("properties/cloths/0/more");
    e.scroll_to(mask + "/3", "properties/cloths/0/more");
    EXPECT_EQ(e.value(mask), "all");
    e.click(mask + "/3");
    EXPECT_EQ(e.value(mask + "/3"), "off");
    EXPECT_EQ(e.value(mask), "all but 3");
    EXPECT_EQ(e.played().document()->scene.cloths[0].collision_mask, ~8u);
    // By keys: the next one.
    e.key("Right");
    e.key("space");
    EXPECT_EQ(e.played().document()->scene.cloths[0].collision_mask, ~24u);
    e.key("Delete");
    EXPECT_EQ(e.value(mask), "all");
    const std::string friction = "properties/cloths/0/fabric/friction/";
    e.scroll_to(friction + "kinetic", mask + "/3");
    EXPECT_GT(e.number(friction + "static"), e.number(friction + "kinetic"));
    e.click("objects/./select");
    EXPECT_NEAR(e.number("properties/./gravity/y"), -9.81, 0.01) << "the scene's own values";
    undo_everything();
    expect_nothing_is_left();
}

}  // namespace
}  // namespace weft::editor
