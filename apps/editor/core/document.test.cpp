#include "editor/core/document.h"

#include "editor/core/scene.test.h"

#include <gmock/gmock.h>

namespace weft::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Json after(const char* before, const Edit& edit) {
    Json json = Json::parse(before);
    const auto done = apply(json, edit);
    EXPECT_TRUE(done) << done.error().message();
    return json;
}

TEST(Edits, set_append_insert_keys_and_remove) {
    EXPECT_EQ(after(R"({"a": 1})", {"/a", 2}), Json::parse(R"({"a": 2})"));
    EXPECT_EQ(after(R"({"a": {}})", {"/a/b", true}), Json::parse(R"({"a": {"b": true}})"));
    EXPECT_EQ(after(R"({})", {"/a/-/b", 1}), Json::parse(R"({"a": [{"b": 1}]})"));
    EXPECT_EQ(after(R"({"a": [1, 2, 3]})", {"/a/1", {}}), Json::parse(R"({"a": [1, 3]})"));
    EXPECT_EQ(after(R"({"a": 1, "b": 2})", {"/a", {}}), Json::parse(R"({"b": 2})"));
    EXPECT_EQ(after(R"({"a": {"x/y~z": 1}})", {"/a/x~1y~0z", 2}), Json::parse(R"({"a": {"x/y~z": 2}})"));
    EXPECT_EQ(after(R"({"a": 1})", {"", Json::object()}), Json::object());
}

TEST(Edits, make_an_object_of_a_name_that_stands_for_one) {
    EXPECT_EQ(after(R"({"fabric": "silk"})", {"/fabric/density", 0.1}),
              Json::parse(R"({"fabric": {"preset": "silk", "density": 0.1}})"));
    EXPECT_EQ(after(R"({"material": "velvet"})", {"/material/roughness", 1}),
              Json::parse(R"({"material": {"preset": "velvet", "roughness": 1}})"));
    EXPECT_EQ(after(R"({"motion": "static"})", {"/motion/keys/-/time", 1}),
              Json::parse(R"({"motion": {"keys": [{"time": 1}]}})"));
}

TEST(Edits, fail_at_places_that_cannot_be) {
    for (const char* place : {"/a/b", "/list/7", "/list/x", "a", "/list/1/2"}) {
        Json json = Json::parse(R"({"a": 3, "list": [1, 2]})");
        const auto done = apply(json, {place, 1});
        ASSERT_FALSE(done) << place;
        EXPECT_EQ(done.error().where, place);
    }
    Json json = Json::parse(R"({"list": [1]})");
    EXPECT_FALSE(apply(json, {"/list/1", {}}));
    EXPECT_FALSE(apply(json, {"", {}}));
}

TEST(Documents, name_all_objects) {
    const DocumentPtr document = small_document();
    EXPECT_EQ(*find(document->json, "/cloths/1/name"), "cloth 1");
    EXPECT_EQ(*find(document->json, "/colliders/1/name"), "collider 1");
    const auto without = edited(*document, std::vector<Edit>{{"/cloths/0", {}}});
    ASSERT_TRUE(without);
    EXPECT_EQ((*without)->scene.cloths[0].name, "cloth 1") << "a name does not move to another cloth";
}

TEST(Documents, may_lose_all_cloths) {
    const DocumentPtr document = small_document();
    const auto empty = edited(*document, std::vector<Edit>{{"/cloths/1", {}}, {"/cloths/0", {}}});
    ASSERT_TRUE(empty) << empty.error().message();
    EXPECT_TRUE((*empty)->scene.cloths.empty());
    EXPECT_TRUE(edited(**empty, std::vector<Edit>{{"/cloths/-", Json::object()}}));
}

TEST(Documents, report_all_problems_of_an_edit) {
    const auto wrong =
        edited(*small_document(), std::vector<Edit>{{"/cloths/0/fabric/density", -1}, {"/solver/substep", 3}});
    ASSERT_FALSE(wrong);
    std::string all;
    for (const Error& error : wrong.errors()) all += error.message() + "\n";
    EXPECT_THAT(all, HasSubstr("/cloths/0/fabric/density: must be > 0 kg/m², got -1"));
    EXPECT_THAT(all, HasSubstr("did you mean \"substeps\""));
}

std::string places(const char* from, const char* to) {
    std::string text;
    for (const Edit& edit : difference(Json::parse(from), Json::parse(to))) text += edit.place + " ";
    return text;
}

TEST(Differences, name_the_places_that_differ) {
    EXPECT_EQ(places(R"({"a": 1, "b": 2})", R"({"a": 1, "b": 3})"), "/b ");
    EXPECT_EQ(places(R"({"a": [1, 2]})", R"({"a": [1, 3]})"), "/a ");
    EXPECT_EQ(places(R"({"a": [{"x": 1}, {"x": 2}]})", R"({"a": [{"x": 1}, {"x": 3}]})"), "/a/1/x ");
    EXPECT_EQ(places(R"({"a": [{"x": 1}, {"x": 2}]})", R"({"a": [{"x": 2}]})"), "/a/0 ");
    EXPECT_EQ(places(R"({"a": [{"x": 1}]})", R"({"a": [{"x": 1}, {"x": 2}]})"), "/a/- ");
    EXPECT_EQ(places(R"({"a": 1})", R"({})"), "/a ");
}

TEST(Differences, lead_from_one_scene_to_any_other) {
    std::vector<Json> scenes{small_document()->json};
    for (const Action& action : sample_actions()) {
        const auto* change = std::get_if<ChangeScene>(&action);
        if (!change) continue;
        const auto next = edited(*small_document(), change->edits);
        ASSERT_TRUE(next) << next.error().message();
        scenes.push_back((*next)->json);
    }
    for (const Json& from : scenes) {
        for (const Json& to : scenes) {
            Json json = from;
            for (const Edit& edit : difference(from, to)) ASSERT_TRUE(apply(json, edit)) << edit.place;
            EXPECT_EQ(json, to);
        }
    }
}

TEST(Numbers, are_the_shortest_of_their_float) {
    EXPECT_EQ(number(0.1f).dump(), "0.1");
    EXPECT_EQ(number(3).dump(), "3");
    EXPECT_EQ(number(1e-7f).dump(), "1e-07");
}

}  // namespace
}  // namespace weft::editor
