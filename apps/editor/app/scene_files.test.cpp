#include "editor/app/scene_files.h"

#include "editor/core/action_log.h"
#include "editor/core/scene.test.h"
#include "io/scenes/scene_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

namespace weft::editor {
namespace {

using testing::HasSubstr;
using namespace nlohmann::literals;

constexpr const char* small_scene = R"(// A sheet on a ball.
{
  "weft": 1,
  "cloths": [
    { "name": "sheet", "mesh": { "grid": { "resolution": [5, 5] } },   // small
      "fabric": "silk" }, /* and one
                             without a name */
    { "mesh": { "grid": { "size": [0.50, 1e0] } } }
  ],
  "colliders": [ { "plane": {} }, { "sphere": { "radius": 0.20 } } ] // ground and ball
}
)";

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::string read(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

DocumentPtr open(const std::filesystem::path& file) {
    auto document = open_document(file);
    EXPECT_TRUE(document) << document.error().message();
    return *document;
}

Edit set(const char* place, Json value) {
    return {place, std::move(value)};
}
Edit removed(const char* place) {
    return {place, {}};
}

DocumentPtr with(const DocumentPtr& document, const std::vector<Edit>& edits) {
    auto next = edited(*document, edits);
    EXPECT_TRUE(next) << next.error().message();
    return *next;
}

std::string replaced(std::string text, const std::string& old, const std::string& now) {
    EXPECT_THAT(text, HasSubstr(old));
    return text.replace(text.find(old), old.size(), now);
}

/// Opens the small scene, edits it and saves it.
class SavedText : public testing::Test {
  protected:
    SavedText() { write(file, small_scene); }

    std::string after(const std::vector<Edit>& edits) {
        write(file, small_scene);
        const DocumentPtr document = with(open(file), edits);
        const auto saved = save_document(*document, file);
        EXPECT_TRUE(saved) << saved.error().message();
        EXPECT_EQ((*saved)->text, read(file));
        EXPECT_TRUE(open(file)->scene == document->scene);
        return read(file);
    }

    ScratchFolder folder;
    std::filesystem::path file = folder / "scene.json";
};

TEST_F(SavedText, stays_without_a_change) {
    EXPECT_EQ(after({}), small_scene);
    EXPECT_EQ(after({set("/cloths/0/fabric/density", 0.3), set("/cloths/0/fabric", "silk")}), small_scene);
}

TEST_F(SavedText, differs_only_where_the_scene_does) {
    EXPECT_EQ(after({set("/cloths/0/fabric/density", 0.3f)}),
              replaced(small_scene, "\"silk\"", "{ \"preset\": \"silk\", \"density\": 0.3 }"));
    EXPECT_EQ(after({set("/gravity", Json{0, -1, 0})}),
              replaced(small_scene, "] // ground and ball", "], // ground and ball\n  \"gravity\": [0, -1, 0]"));
    EXPECT_EQ(after({set("/colliders/1/transform/position", Json{0, 0.1f, 0})}),
              replaced(small_scene, "0.20 } }", "0.20 }, \"transform\": { \"position\": [0, 0.1, 0] } }"));
    EXPECT_EQ(after({removed("/colliders/1")}), replaced(small_scene, ", { \"sphere\": { \"radius\": 0.20 } }", ""));
}

TEST_F(SavedText, has_no_names_that_only_the_editor_gave) {
    EXPECT_EQ(after({set("/cloths/1/name", "curtain")}),
              replaced(small_scene, "1e0] } } }", "1e0] } }, \"name\": \"curtain\" }"));
    EXPECT_EQ(after({set("/cloths/0/pins/-", R"({"vertices": [0], "attach": "collider 1"})"_json)}),
              replaced(replaced(small_scene, "0.20 } }", "0.20 }, \"name\": \"collider 1\" }"), "\"silk\" }",
                       "\"silk\", \"pins\": [{ \"attach\": \"collider 1\", \"vertices\": [0] }] }"));
}

TEST_F(SavedText, has_no_such_names_after_a_removal_and_a_second_save) {
    const std::string left = replaced(replaced(small_scene, "{ \"plane\": {} }, ", ""), "0.20 } }", "0.25 } }");
    const DocumentPtr removed_one = with(open(file), {removed("/colliders/0")});
    const auto saved = save_document(*removed_one, file);
    ASSERT_TRUE(saved) << saved.error().message();
    const DocumentPtr next = with(saved_in(*removed_one, file, *saved), {set("/colliders/0/sphere/radius", 0.25f)});
    EXPECT_EQ(next->scene.colliders[0].name, "collider 1") << "as it was called all the time";
    const auto again = save_document(*next, file);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(read(file), left);
    // A name that the user gives stays.
    const DocumentPtr named = with(saved_in(*next, file, *again), {set("/colliders/0/name", "ball")});
    ASSERT_TRUE(save_document(*named, file));
    EXPECT_THAT(read(file), HasSubstr("\"ball\""));
}

TEST_F(SavedText, goes_on_from_what_was_saved) {
    const DocumentPtr first = open(file), second = with(first, {set("/gravity", Json{0, -1, 0})});
    const auto saved = save_document(*second, file);
    ASSERT_TRUE(saved);
    EXPECT_FALSE(save_document(*second, file)) << "the file is not that of the document";
    const auto again = save_document(*saved_in(*first, file, *saved), file);  // after undo
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(read(file), small_scene);
}

TEST_F(SavedText, does_not_replace_a_file_that_has_changed) {
    const DocumentPtr document = with(open(file), {set("/gravity", Json{0, -1, 0})});
    const std::string other = replaced(small_scene, "silk", "wool");
    write(file, other);
    EXPECT_TRUE(changed_on_disk(*document, file));
    const auto saved = save_document(*document, file);
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().message(), HasSubstr("scene.json: has changed on disk since it was opened"));
    EXPECT_EQ(read(file), other);
    EXPECT_TRUE(save_document(*document, folder / "other.json"));
    EXPECT_TRUE(save_document(*document, file, true));
    EXPECT_THAT(read(file), HasSubstr("silk"));
    std::filesystem::remove(file);
    EXPECT_TRUE(save_document(*document, file)) << "nothing is lost";
}

TEST_F(SavedText, keeps_comments_after_a_crash) {
    const DocumentPtr document = with(open(file), {set("/cloths/0/fabric", "wool")});
    { const auto log = ActionLog::create(folder / "log", {document}); }
    const auto log = read_log(folder / "log");
    ASSERT_TRUE(log);
    ASSERT_TRUE(save_document(*log->head.document, file));
    EXPECT_EQ(read(file), replaced(small_scene, "silk", "wool"));
}

TEST_F(SavedText, of_another_folder_finds_the_same_files) {
    write(folder / "a.obj", "");
    write(file, R"({ "weft": 1, "cloths": [{ "mesh": { "file": "a.obj" } } /* ours */] })");
    std::filesystem::create_directories(folder / "sub");
    const DocumentPtr document = open(file);
    const auto other = folder / "sub" / "scene.json";
    const auto saved = save_document(*document, other);
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_EQ(read(other), R"({ "weft": 1, "cloths": [{ "mesh": { "file": "../a.obj" } } /* ours */] })");
    ASSERT_TRUE(save_document(*saved_in(*document, other, *saved), other)) << "and again";
    EXPECT_EQ(read(other), (*saved)->text);
}

TEST_F(SavedText, of_a_scene_without_a_file_is_written_anew) {
    const auto saved = save_document(*first_document(), file, true);
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_TRUE(open(file)->scene == first_document()->scene);
    // Without a cloth too: one can be added later.
    ASSERT_TRUE(save_document(*new_document(), folder / "none.json"));
    EXPECT_TRUE(open(folder / "none.json")->scene == new_document()->scene) << read(folder / "none.json");
    ASSERT_TRUE(save_document(*with(open(folder / "scene.json"), {removed("/cloths/0")}), folder / "bare.json"));
    EXPECT_TRUE(open(folder / "bare.json")->scene.cloths.empty());
}

TEST(SavedScenes, come_back_after_random_changes) {
    ScratchFolder folder;
    const auto file = folder / "scene.json";
    const std::vector<std::vector<Edit>> changes{
        {},
        {set("/gravity", Json{0, -3.7f, 0})},
        {set("/solver/substeps", 7)},
        {set("/cloths/0/fabric/density", 0.21f)},
        {set("/cloths/0/material/roughness", 0.7f)},
        {set("/cloths/0/name", "renamed cloth")},
        {removed("/cloths/0/fabric"), removed("/light")},
        {set("/colliders/-", R"({"sphere": {"radius": 0.2}, "name": "new ball"})"_json)},
        {set("/cloths/-", R"({"mesh": {"grid": {"resolution": [5, 6]}}, "fabric": "denim"})"_json)},
        {set("/cloths/0/transform/position", Json{1, 2.1f, 0.1f}), set("/camera/fov", 33)},
        {set("/air/wind", R"([{"velocity": [3, 0, 0]}])"_json)}};
    std::size_t saves = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(WEFT_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".json") continue;
        SCOPED_TRACE(entry.path().string());
        const std::string text = read(entry.path());
        for (std::size_t i = 0; i < changes.size(); ++i) {
            write(file, text);
            DocumentPtr document = open(file);
            for (const std::size_t k : {i, (i * 5 + saves) % changes.size()})
                if (auto next = edited(*document, changes[k])) document = *next;
            const auto saved = save_document(*document, file);
            ASSERT_TRUE(saved) << saved.error().message();
            EXPECT_TRUE(open(file)->scene == document->scene) << read(file);
            const std::string head = text.substr(0, text.find('{'));
            EXPECT_TRUE(read(file).starts_with(head)) << "the comment at the top";
            if (document->json == open(entry.path())->json) {
                EXPECT_EQ(read(file), text);
            }
            ++saves;
        }
    }
    EXPECT_GT(saves, 300u);
}

}  // namespace
}  // namespace weft::editor
