// Selection, groups, brush and anchors in the editor's window, driven by mouse and keys alone.
#include "editor_fixture.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace weft::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A sheet of 11 × 11 vertices, upright before the camera. Vertex 0 is at the upper left, 120 at the lower right.
std::string front_scene(const std::string& more = R"("pins": [{"vertices": [0, 10]}])",
                        const std::string& colliders = "") {
    return R"({ "weft": 1, "solver": {"substeps": 4},
        "cloths": [{"name": "sheet", "mesh": {"grid": {"size": [1, 1], "resolution": [11, 11]}}, "fabric": "cotton",
                    "transform": {"position": [0, 1, 0], "rotation": [90, 0, 0]}, )" +
           more + R"(}], "colliders": [)" + colliders + R"(],
        "camera": {"position": [0, 1, 3], "target": [0, 1, 0], "fov": 30} })";
}

class TouchWindow : public EditorWindow {
  protected:
    /// Opens the scene and waits at its first frame.
    DrivenEditor& start(const std::string& scene) {
        const auto file = folder.write("scene.json", scene);
        editor.emplace(DrivenEditor::Start{.folder = folder.path() / "run", .arguments = {file.string()}});
        editor->key("space");
        editor->until("the run is paused", [&] { return !editor->plays(); });
        editor->key("r");
        editor->settle();
        first_steps = editor->played().history().done().size();
        return *editor;
    }
    /// The pixel of a place of the sheet at rest: from 0 to 10 across and down, in vertices.
    Point at(double across, double down) {
        const Rectangle view = editor->place("middle/view/view");
        const double scale = view.height / 2 / (3 * std::tan(15 * std::numbers::pi / 180));
        return view.center() + Point{(across - 5) / 10, (down - 5) / 10} * scale;
    }
    std::string chosen() { return editor->value("properties/tool/pin"); }
    Json cloth() { return editor->played().document()->json["cloths"][0]; }
    std::size_t steps() { return editor->played().history().done().size() - first_steps; }
    void draw(const std::vector<Point>& line) {
        editor->point_at(line.front());
        editor->press();
        for (std::size_t i = 1; i < line.size(); ++i) editor->move(line[i]);
        editor->release();
    }
    void expect_nothing_is_left() {
        undo_everything();
        EditorWindow::expect_nothing_is_left();
    }
    void pick(const std::string& name, const std::string& value) {
        editor->click(name);
        editor->click(name + "/" + value);
        EXPECT_EQ(editor->value(name), value);
    }

    std::size_t first_steps = 0;
};

TEST_F(TouchWindow, vertices_are_chosen_by_click_box_lasso_and_neighbors) {
    DrivenEditor& e = start(front_scene());
    e.click("toolbar/select");
    e.click(at(2, 2));
    EXPECT_EQ(chosen(), "Pin 1");
    e.hold("shift");
    e.click(at(4, 2));
    EXPECT_EQ(chosen(), "Pin 2");
    e.click(at(4, 2));
    EXPECT_EQ(chosen(), "Pin 2") << "Shift adds";
    e.drag(at(5.5, 5.5), at(7.5, 7.5));
    EXPECT_EQ(chosen(), "Pin 6");
    e.let_go("shift");
    e.hold("ctrl");
    e.drag(at(5.5, 5.5), at(6.5, 7.5));
    EXPECT_EQ(chosen(), "Pin 4");
    e.let_go("ctrl");
    e.key("7");
    draw({at(-0.5, -0.5), at(3, -0.5), at(-0.5, 3)});
    EXPECT_EQ(chosen(), "Pin 6") << "a triangle of 3 + 2 + 1";
    e.key("ctrl+equal");
    const int grown = std::stoi(chosen().substr(4));
    EXPECT_GT(grown, 9);
    e.key("ctrl+minus");
    const int shrunk = std::stoi(chosen().substr(4));
    EXPECT_GE(shrunk, 6);
    EXPECT_LT(shrunk, grown);
    e.key("ctrl+i");
    EXPECT_EQ(chosen(), "Pin " + std::to_string(121 - shrunk));
    e.key("ctrl+a");
    EXPECT_EQ(chosen(), "Pin 121");
    e.click("properties/tool/boundary");
    EXPECT_EQ(chosen(), "Pin 40");
    e.key("ctrl+shift+a");
    EXPECT_EQ(chosen(), "Pin 0");
    EXPECT_FALSE(e.is_enabled("properties/tool/grow"));
    EXPECT_EQ(steps(), 0u) << "a selection changes nothing";
}

TEST_F(TouchWindow, hidden_vertices_are_chosen_on_request) {
    DrivenEditor& e = start(front_scene(R"("pins": [{"vertices": [0, 10]}])",
                                        R"({"name": "ball", "sphere": {"radius": 0.18},
                                            "transform": {"position": [0, 1, 0.4]}})"));
    e.key("2");
    e.drag(at(-1, -1), at(11, 11));
    const int seen = std::stoi(chosen().substr(4));
    EXPECT_LT(seen, 121);
    EXPECT_GT(seen, 80);
    e.key("t");
    e.drag(at(-1, -1), at(11, 11));
    EXPECT_EQ(chosen(), "Pin 121");
}

TEST_F(TouchWindow, groups_are_made_renamed_changed_pinned_and_deleted) {
    DrivenEditor& e = start(front_scene());
    const std::string tool = "properties/tool/";
    e.key("7");
    draw({at(-0.5, -0.5), at(2.5, -0.5), at(2.5, 0.5), at(-0.5, 0.5)});
    ASSERT_EQ(chosen(), "Pin 3");
    // The name is typed without waiting for its field.
    e.at_once([&] {
        e.click(tool + "group_new");
        e.key("ctrl+a");
        e.type("corner");
        e.key("Return");
    });
    e.settle();
    EXPECT_EQ(cloth()["groups"], Json::parse(R"([{"name": "corner", "vertices": [0, 1, 2]}])"));
    EXPECT_EQ(steps(), 2u);
    EXPECT_EQ(e.value(tool + "group"), "corner");
    e.key("p");
    EXPECT_EQ(cloth()["pins"][1], (Json{{"group", "corner"}})) << "a pin of a group names it";
    e.key("2");
    e.click(at(3, 3));
    e.click(tool + "group_add");
    EXPECT_EQ(cloth()["groups"][0]["vertices"], (Json{0, 1, 2, 36}));
    e.key("ctrl+shift+a");
    e.click(tool + "group_choose");
    EXPECT_EQ(chosen(), "Pin 4");
    e.click(at(1, 0));
    e.click(tool + "group_subtract");
    EXPECT_EQ(cloth()["groups"][0]["vertices"], (Json{0, 2, 36}));
    e.click(tool + "group_delete");
    EXPECT_FALSE(cloth().contains("groups"));
    EXPECT_EQ(cloth()["pins"][1], (Json{{"vertices", {0, 2, 36}}})) << "the pin stays";
    expect_nothing_is_left();
}

TEST_F(TouchWindow, the_brush_paints_pins_with_a_mirror) {
    DrivenEditor& e = start(front_scene());
    const std::string tool = "properties/tool/";
    e.click("toolbar/brush");
    EXPECT_EQ(e.value(tool + "kind"), "Pins");
    pick(tool + "mirror", "x");
    e.point_at(at(5, 5));
    const double radius = e.number(tool + "radius");
    e.key("bracketright");
    EXPECT_NEAR(e.number(tool + "radius"), 1.2 * radius, 0.01 * radius);
    e.key("bracketleft");
    EXPECT_NEAR(e.number(tool + "radius"), radius, 0.01 * radius);
    EXPECT_EQ(e.value("middle/view/brush"), "free");
    e.drag(at(1, 3), at(1, 6));
    EXPECT_EQ(steps(), 1u) << "a stroke is one step";
    const Json pins = cloth()["pins"];
    ASSERT_EQ(pins.size(), 1u);
    std::vector<std::uint32_t> on;
    for (const Json& one : pins[0]["vertices"]) on.push_back(one);
    for (const std::uint32_t v : {34u, 42u, 45u, 53u, 67u, 75u}) EXPECT_THAT(on, testing::Contains(v));
    for (const std::uint32_t v : on) EXPECT_THAT(on, testing::Contains(v / 11 * 11 + (10 - v % 11))) << v;
    e.point_at(at(1, 4));
    EXPECT_EQ(e.value("middle/view/brush"), "pinned");
    e.hold("ctrl");
    e.drag(at(1, 3), at(1, 6));
    e.let_go("ctrl");
    EXPECT_EQ(cloth()["pins"], Json::parse(R"([{"vertices": [0, 10]}])"));
    // Esc takes the stroke back.
    e.point_at(at(4, 4));
    e.press();
    e.move(at(6, 6));
    e.key("Escape");
    e.release();
    EXPECT_EQ(steps(), 2u);
    expect_nothing_is_left();
}

TEST_F(TouchWindow, resistance_is_painted_while_the_cloth_runs) {
    DrivenEditor& e = start(front_scene(R"("tearing": "split", "pins": [{"vertices": [0, 10]}])"));
    const std::string tool = "properties/tool/";
    e.key("8");
    pick(tool + "kind", "Resistance");
    pick(tool + "mirror", "x");
    e.key("space");
    e.until("some frames", [&] { return e.frame() > 5; });
    const std::uint64_t before = e.frame();
    e.drag(at(2, 4), at(3, 4));
    EXPECT_GT(e.frame(), before);
    ASSERT_EQ(e.actions("change").size(), 1u);
    const std::vector<Edit> edits = std::get<ChangeScene>(e.actions("change")[0]).edits;
    ASSERT_EQ(edits.size(), 1u);
    EXPECT_EQ(edits[0].place, "/cloths/0/resistance/-");
    e.key("space");
    e.until("the run is paused", [&] { return !e.plays(); });
    e.settle();
    EXPECT_GT(e.frame(), before) << "it has not started again";
    const Json painted = cloth()["resistance"][0];
    ASSERT_EQ(painted["vertices"].size(), painted["factors"].size());
    double least = 1;
    for (const Json& factor : painted["factors"]) least = std::min(least, factor.get<double>());
    EXPECT_NEAR(least, 0.1, 0.05);
    expect_nothing_is_left();
}

TEST_F(TouchWindow, anchors_wait_until_they_are_applied) {
    DrivenEditor& e = start(front_scene());
    const std::string tool = "properties/tool/";
    e.click("toolbar/anchors");
    EXPECT_FALSE(e.is_enabled(tool + "apply"));
    e.click(at(3, 3));
    e.click(at(7, 3));
    e.click(at(5, 8));
    e.click(at(5, 8));
    e.click(at(0, 0));
    EXPECT_EQ(e.value(tool + "pending"), "2 to pin, 1 to let go");
    EXPECT_EQ(steps(), 0u);
    e.click(tool + "discard");
    EXPECT_FALSE(e.is_enabled(tool + "apply"));
    e.click(at(3, 3));
    e.click(at(0, 0));
    e.click(tool + "apply");
    EXPECT_EQ(steps(), 1u);
    EXPECT_EQ(cloth()["pins"], Json::parse(R"([{"vertices": [10, 36]}])"));
    e.click(at(6, 6));
    e.point_at(at(5, 5));
    e.key("Return");
    EXPECT_EQ(cloth()["pins"], Json::parse(R"([{"vertices": [10, 36, 72]}])"));
    e.click(tool + "live");
    e.click(at(8, 8));
    EXPECT_EQ(steps(), 3u);
    EXPECT_EQ(cloth()["pins"][0]["vertices"].size(), 4u);
    // Chosen vertices become anchors too.
    e.click(tool + "live");
    e.key("2");
    e.drag(at(3.5, 3.5), at(5.5, 5.5));
    e.key("9");
    e.click(tool + "add_chosen");
    EXPECT_EQ(e.value(tool + "pending"), "4 to pin, 0 to let go");
    e.key("Escape");
    EXPECT_THAT(e.value(tool + "pending"), StartsWith("Click"));
    expect_nothing_is_left();
}

}  // namespace
}  // namespace weft::editor
