#include "editor/core/action_log.h"

#include "editor/core/scene.test.h"

#include <gmock/gmock.h>

#include <fstream>

namespace weft::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Actions, are_read_as_they_were_written) {
    std::vector<Action> all = sample_actions();
    all.insert(all.end(),
               {Grab{"sheet", {3, {0.2f, 0.3f, 0.5f}}, {1, 2, 3}, 5}, MoveGrab{{0.1f, 2, 3}}, Release{}, Seek{4},
                Undo{}, Redo{}, UndoSetting{3}, UseBackend{"vulkan", 1}, Saved{"/a/b.json", "{}"}, Advance{20}});
    for (const Action& action : all) {
        const std::string line = to_line({12, action});
        const auto read = action_from(Json::parse(line));
        ASSERT_TRUE(read) << line << read.error().message();
        EXPECT_EQ(read->first, 12u);
        EXPECT_TRUE(read->second == action) << line;
    }
}

std::string problem_of(const char* line) {
    const auto read = action_from(Json::parse(line));
    EXPECT_FALSE(read) << line;
    return read ? "" : read.error().message();
}

TEST(Actions, that_are_wrong_are_named) {
    EXPECT_THAT(problem_of("3"), HasSubstr("must be an object such as"));
    EXPECT_THAT(problem_of("{}"), HasSubstr("do: is missing"));
    EXPECT_THAT(problem_of(R"({"do": "chnge"})"), HasSubstr("did you mean \"change\"?"));
    EXPECT_THAT(problem_of(R"({"do": "seek"})"), HasSubstr("frame: is missing; it must be a whole number"));
    EXPECT_THAT(problem_of(R"({"do": "seek", "frame": -1})"), HasSubstr("frame: must be a whole number"));
    EXPECT_THAT(problem_of(R"({"do": "move_grab", "to": [1, 2]})"), HasSubstr("to: must be three numbers"));
    EXPECT_THAT(problem_of(R"({"do": "change", "edits": [{}]})"), HasSubstr("must have a \"place\""));
    EXPECT_THAT(problem_of(R"({"do": "undo", "at": "x"})"), HasSubstr("at: must be a whole number"));
}

TEST(Logs, played_again_end_in_the_same_state) {
    ScratchFolder folder;
    Stage stage = open_small();
    auto log = ActionLog::create(folder / "a" / "session.weftlog", {stage.document(), "cpu", 1});
    ASSERT_TRUE(log) << log.error().message();
    int count = 0;
    for (const Action& action : sample_actions()) {
        const std::uint64_t at = stage.frame();
        if (stage.apply(action)) log->add({at, action});
        if (++count % 3 == 0) must(stage.step());
        if (count % 7 != 0) continue;
        for (const Action& more :
             {Action(Undo{}), Action(Seek{1}), Action(change_of("/gravity", Json{0, -count, 0}))}) {
            const std::uint64_t then = stage.frame();
            must(stage.apply(more));
            log->add({then, more});
        }
    }
    must(stage.step());
    const auto crashed = read_log(log->file());
    ASSERT_TRUE(crashed) << crashed.error().message();
    EXPECT_FALSE(crashed->complete);
    log->finish(stage.frame());
    const auto read = read_log(log->file());
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->complete);
    auto again = open_stage(read->head, {});
    ASSERT_TRUE(again);
    must(play(*again, read->actions, read->end));
    EXPECT_EQ(again->hash(), stage.hash());
}

TEST(Logs, of_a_session_that_was_killed_lack_at_most_the_last_action) {
    ScratchFolder folder;
    Stage stage = open_small();
    const auto file = folder / "session-1-999999999.weftlog";
    auto log = ActionLog::create(file, {stage.document(), "cpu", 1});
    ASSERT_TRUE(log);
    log->add({0, change_of("/gravity", Json{0, 0, 0})});
    std::ofstream(file, std::ios::app) << R"({"at":3,"do":"cha)";
    const auto read = read_log(file);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->actions.size(), 1u);
    EXPECT_THAT(abandoned_logs(folder.path()), ElementsAre(file));
    log->finish(0);
}

TEST(Logs, know_what_was_saved) {
    ScratchFolder folder;
    const auto file = folder / "scene.json";
    Stage stage = open_small();
    auto log = ActionLog::create(folder / "session-86400-999999999.weftlog", {stage.document(), "cpu", 1});
    ASSERT_TRUE(log);
    const auto act = [&](const Action& action) {
        must(stage.apply(action));
        log->add({stage.frame(), action});
    };
    act(change_of("/gravity", Json{0, -1, 0}));
    const std::string text = stage.document()->json.dump();
    act(Saved{file.string(), text});
    const Json saved = stage.document()->json;
    EXPECT_EQ(stage.history().done().size(), 1u) << "it is no step";
    act(change_of("/gravity", Json{0, -2, 0}));
    act(Undo{});
    act(Undo{});
    const auto read = read_log(log->file());
    ASSERT_TRUE(read);
    auto again = open_stage(read->head, {});
    must(play(*again, read->actions, read->end));
    ASSERT_TRUE(again->saved());
    EXPECT_EQ(again->saved()->file, file);
    EXPECT_EQ(again->saved()->text->text, text);
    EXPECT_EQ(again->saved()->json, saved);
    EXPECT_NE(again->document()->json, saved) << "the change before it is undone";

    const LogSummary summary = summary_of(log->file());
    EXPECT_EQ(summary.actions, 5u);
    EXPECT_THAT(summary.time, HasSubstr("1970-01-0"));
    EXPECT_GT(summary.bytes, 100u);
    EXPECT_EQ(summary_of(folder / "none").actions, 0u);
}

TEST(Logs, of_this_process_and_of_ended_sessions_are_not_abandoned) {
    ScratchFolder folder;
    const LogHead head{small_document()};
    auto mine = ActionLog::create(new_log_file(folder.path()), head);
    auto ended = ActionLog::create(folder / "session-1-999999999.weftlog", head);
    ASSERT_TRUE(mine && ended);
    ended->finish(3);
    EXPECT_THAT(abandoned_logs(folder.path()), IsEmpty());
    EXPECT_THAT(abandoned_logs(folder / "none"), IsEmpty());
}

TEST(Logs, that_are_damaged_name_the_line) {
    ScratchFolder folder;
    const auto with = [&](const std::string& text) {
        std::ofstream(folder / "log") << text;
        const auto read = read_log(folder / "log");
        EXPECT_FALSE(read) << text;
        return read ? "" : read.error().message();
    };
    const std::string head = Json{{"weft_log", 1}, {"scene", small_document()->json}}.dump() + "\n";
    EXPECT_THAT(with(""), HasSubstr("log: is empty"));
    EXPECT_THAT(with("{}\n"), HasSubstr("log:1: is not a log"));
    EXPECT_THAT(with(head + "nonsense\n{}\n"), HasSubstr("log:2: is not JSON"));
    EXPECT_THAT(with(head + "{\"do\": 3}\n"), HasSubstr("log:2: do: must be text"));
    EXPECT_THAT(with(R"({"weft_log": 1, "scene": {"weft": 1, "cloths": [{"mesh": 3}]}})"), HasSubstr("/cloths/0/mesh"));
    EXPECT_FALSE(read_log(folder / "missing"));
    EXPECT_THAT(ActionLog::create("/proc/no/log", {small_document()}).error().message(), HasSubstr("/proc/no"));
}

}  // namespace
}  // namespace weft::editor
