// Actions without a window: each is done, undone and redone, and gives the same document and the same bits each time.
#include "editor/core/stage.h"

#include "editor/core/scene.test.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <random>

namespace weft::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void run(Stage& stage, int frames) {
    for (int i = 0; i < frames; ++i) must(stage.step());
}

// Labels: no-asan
TEST(Stage, undoes_and_redoes_every_kind_of_action_to_the_bit) {
    for (const std::uint64_t start : {0, 5}) {
        for (const Action& action : sample_actions()) {
            const std::string what = to_line({start, action});
            Stage stage = open_small();
            run(stage, static_cast<int>(start));
            const std::string before = stage.hash();
            const auto done = stage.apply(action);
            ASSERT_TRUE(done) << what << ": " << done.error().message();
            const std::string changed = stage.hash();
            if (start > 0 || !std::holds_alternative<Reset>(action)) {
                EXPECT_NE(changed, before) << what;
            }
            must(stage.apply(Undo{}));
            EXPECT_EQ(stage.hash(), before) << what;
            must(stage.apply(Redo{}));
            if (std::holds_alternative<Grab>(action)) continue;  // a jump lets go of the cloth
            EXPECT_EQ(stage.hash(), changed) << what;
            run(stage, 4);
            const std::string later = stage.hash();
            must(stage.apply(Undo{}));
            EXPECT_EQ(stage.hash(), before) << what;
            must(stage.apply(Redo{}));
            EXPECT_EQ(stage.hash(), later) << what << ": redo returns to the present before the undo";
        }
    }
}

// What the cloth does after an undo is what it would have done without the action.
TEST(Stage, goes_on_after_an_undo_as_if_nothing_had_been) {
    for (const Action& action : sample_actions()) {
        Stage changed = open_small(), plain = open_small();
        run(changed, 3), run(plain, 3);
        must(changed.apply(action));
        run(changed, 2);
        must(changed.apply(Undo{}));
        run(changed, 6), run(plain, 6);
        EXPECT_EQ(changed.hash(), plain.hash()) << to_line({3, action});
    }
}

// Labels: slow no-asan
TEST(Stage, undoes_a_thousand_random_actions) {
    const std::vector<Action> samples = sample_actions();
    Stage stage = open_small({.record = true});
    std::mt19937 random(7);
    const std::string first = stage.hash();
    std::vector<std::string> hashes{first};
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
        if (random() % 4 == 0) must(stage.step());
        const std::string before = stage.hash();
        const std::size_t steps = stage.history().done().size();
        const Action& action = samples[random() % samples.size()];
        if (stage.apply(action)) {
            if (std::holds_alternative<Grab>(action)) must(stage.apply(Release{}));  // a jump would let go of it
            ASSERT_EQ(stage.history().done().size(), steps + 1);
            hashes.push_back(before);
        } else {
            ++refused;  // an object of the action is gone, or its name is taken
            EXPECT_EQ(stage.hash(), before);
            EXPECT_EQ(stage.history().done().size(), steps);
        }
    }
    EXPECT_LT(refused, 900);
    while (!stage.history().done().empty()) {
        must(stage.apply(Undo{}));
        ASSERT_EQ(stage.hash(), hashes.back()) << hashes.size();
        hashes.pop_back();
    }
    EXPECT_EQ(stage.hash(), first);
}

TEST(Stage, takes_a_gesture_as_one_step) {
    Stage stage = open_small();
    run(stage, 2);
    const std::string before = stage.hash();
    for (const double density : {0.1, 0.2, 0.3, 0.4}) {
        must(stage.apply(change_of("/cloths/0/fabric/density", density, 9)));
        run(stage, 1);
    }
    EXPECT_EQ(stage.history().done().size(), 1u);
    must(stage.apply(change_of("/cloths/0/fabric/density", 0.5, 10)));
    EXPECT_EQ(stage.history().done().size(), 2u);
    must(stage.apply(Undo{}));
    must(stage.apply(Undo{}));
    EXPECT_EQ(stage.hash(), before);
}

// Labels: no-asan
TEST(Stage, undoes_a_setting_alone) {
    Stage stage = open_small();
    must(stage.apply(change_of("/cloths/0/fabric/density", 0.3)));
    must(stage.apply(change_of("/gravity", Json{0, -3, 0})));
    run(stage, 5);
    const std::uint64_t first = stage.history().done().front().number;
    must(stage.apply(UndoSetting{first}));
    EXPECT_EQ(stage.frame(), 5u);
    EXPECT_FALSE(find(stage.document()->json, "/cloths/0/fabric/density"));
    EXPECT_EQ(stage.document()->scene.gravity.y, -3);
    EXPECT_FALSE(stage.apply(UndoSetting{999}));
}

TEST(Stage, keeps_documents_of_steps_whose_moments_have_no_room) {
    Stage stage = open_small({.undo_memory = 100'000});  // about one moment
    for (int i = 0; i < 6; ++i) {
        must(stage.apply(change_of("/cloths/0/fabric/density", 0.1 + i)));
        run(stage, 1);
    }
    EXPECT_FALSE(stage.history().done().front().moment);
    EXPECT_TRUE(stage.history().done().back().moment);
    EXPECT_LE(stage.history().bytes(), 200'000u);
    for (int i = 0; i < 6; ++i) must(stage.apply(Undo{}));
    EXPECT_EQ(stage.document()->json, small_document()->json);
    EXPECT_FALSE(stage.apply(Undo{}));
}

TEST(Stage, refuses_what_is_wrong_and_changes_nothing) {
    Stage stage = open_small();
    run(stage, 2);
    const std::string before = stage.hash();
    const Action wrong[] = {change_of("/cloths/0/fabric/density", -1),
                            change_of("/cloths/7/fabric/density", 1),
                            change_of("/cloths/-", Json{{"mesh", {{"file", "no such file.obj"}}}}),
                            change_of("/cloths/0/pins/-", Json{{"vertices", {99999}}}),
                            change_of("/cloths/1/name", "sheet"),
                            Rename{"/cloths/0", "cloth 1"},
                            Rename{"/cloths/9", "a"},
                            Cut{"no such cloth", {{0, 0, 0}, {1, 0, 0}}},
                            Cut{"sheet", {{5, 5, 5}, {6, 5, 5}}},
                            Cut{"cloth 1", {{-1, 1, 0}, {1, 1, 0}}},
                            Seek{77},
                            Undo{},
                            Redo{},
                            UndoSetting{3},
                            UseBackend{"abacus", 1}};
    for (const Action& action : wrong) {
        const auto done = stage.apply(action);
        ASSERT_FALSE(done) << to_line({2, action});
        EXPECT_EQ(stage.hash(), before) << to_line({2, action});
        EXPECT_TRUE(stage.history().done().empty());
    }
}

TEST(Stage, seeks_to_recorded_frames_and_continues_with_the_same_bits) {
    Stage stage = open_small();
    std::vector<std::string> hashes{stage.hash()};
    for (int i = 0; i < 20; ++i) {
        run(stage, 1);
        hashes.push_back(stage.hash());
    }
    for (const std::uint64_t frame : {0, 13, 20, 7}) {
        must(stage.apply(Seek{frame}));
        EXPECT_EQ(stage.hash(), hashes[frame]);
        EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 20}));
    }
    run(stage, 13);
    EXPECT_EQ(stage.hash(), hashes[20]);
    EXPECT_THAT(stage.timeline().stale(stage.lineage()), IsEmpty());
}

// The cloth gets room for the cut where it has fallen to.
TEST(Stage, cuts_a_cloth_that_could_not_be_cut) {
    Stage stage = open_small();
    must(stage.apply(change_of("/cloths/0/tearing", "off")));
    run(stage, 20);
    const std::string hash = stage.hash();
    const auto places = [&] {
        std::vector<Vec3> all;
        for (const Vec4& x : stage.world().world().frame().cloths[0].positions) all.push_back(x.xyz());
        return all;
    };
    const std::vector<Vec3> before = places();
    must(stage.apply(change_of("/cloths/0/tearing", "cuts")));
    EXPECT_EQ(places(), before);
    must(stage.apply(Undo{}));
    EXPECT_EQ(stage.hash(), hash);
    must(stage.apply(Redo{}));
    EXPECT_EQ(places(), before);
    const Cut cut{"sheet", {{-0.6f, 0.5f, 0.01f}, {0.1f, 0.5f, 0.01f}}, true};
    const auto line = Json::parse(to_line({0, cut}));
    const auto read = action_from(line);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->second, Action(cut));
    must(stage.apply(read->second));
    run(stage, 10);
    must(stage.apply(Cut{"sheet", {{-0.6f, 0.5f, 0.2f}, {0.1f, 0.5f, 0.2f}}, true}));
}

// The recorded frames after it were pulled, and those of the new run are not.
TEST(Stage, begins_a_branch_when_a_run_goes_on_without_the_pull) {
    Stage stage = open_small();
    run(stage, 2);
    must(stage.apply(Grab{"sheet", {40, {0.25f, 0.25f, 0.5f}}, {0.3f, 1, 0.2f}, 5}));
    run(stage, 6);
    must(stage.apply(Release{}));
    run(stage, 2);
    must(stage.apply(Seek{5}));
    EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 10}));
    run(stage, 1);
    EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 6}));
    EXPECT_THAT(stage.timeline().stale(stage.lineage()), ElementsAre(FrameRange{7, 10}));
}

TEST(Stage, keeps_the_frames_before_an_edit_and_marks_the_rest_as_stale) {
    Stage stage = open_small();
    run(stage, 20);
    must(stage.apply(Seek{8}));
    must(stage.apply(change_of("/cloths/0/fabric/density", 0.5)));
    EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 8}));
    EXPECT_THAT(stage.timeline().stale(stage.lineage()), ElementsAre(FrameRange{9, 20}));
    run(stage, 4);
    EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 12}));
    EXPECT_THAT(stage.timeline().stale(stage.lineage()), ElementsAre(FrameRange{13, 20}));
    const std::string with_edit = stage.hash();

    // Back before the edit: the frame of then, and from there on the document of now.
    must(stage.apply(Seek{5}));
    EXPECT_EQ(stage.document()->scene.cloths[0].fabric.body.density, 0.5f);
    EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 12}));
    must(stage.apply(Seek{12}));
    EXPECT_EQ(stage.hash(), with_edit);
    must(stage.apply(Seek{5}));
    run(stage, 1);
    EXPECT_EQ(stage.world().scene().cloths[0].fabric.body.density, 0.5f);
    EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 6}));

    // Undo returns to before the run that followed the edit.
    must(stage.apply(Undo{}));
    EXPECT_EQ(stage.frame(), 8u);
    EXPECT_EQ(stage.document()->json, small_document()->json);
}

// Frames of before an object was added can be shown, and the object is there when the run goes on.
TEST(Stage, seeks_across_a_change_of_objects) {
    Stage stage = open_small();
    run(stage, 4);
    const std::string then = stage.world().world().state_hash();
    run(stage, 2);
    must(stage.apply(change_of("/cloths/-", Json{{"mesh", {{"grid", {{"resolution", {5, 5}}}}}}})));
    run(stage, 2);
    must(stage.apply(Seek{4}));
    EXPECT_EQ(stage.world().world().state_hash(), then);
    EXPECT_EQ(stage.world().world().cloth_count(), 2u);
    run(stage, 1);
    EXPECT_EQ(stage.world().world().cloth_count(), 3u);
}

TEST(Stage, resets_to_a_new_world_of_its_document) {
    Stage stage = open_small();
    run(stage, 5);
    must(stage.apply(change_of("/cloths/0/fabric", "denim")));
    must(stage.apply(change_of("/colliders/0/transform/position", Json{0, 0.2, 0})));
    run(stage, 3);
    must(stage.apply(Reset{}));
    EXPECT_EQ(stage.frame(), 0u);
    run(stage, 6);
    auto fresh = Stage::open(stage.document(), {.simulation = {.backend = "cpu"}});
    ASSERT_TRUE(fresh);
    run(*fresh, 6);
    EXPECT_EQ(stage.hash(), fresh->hash());
    EXPECT_THAT(stage.timeline().valid(stage.lineage()), ElementsAre(FrameRange{0, 6}));
}

// The document of the editor, edited before the first frame, gives the run of its file.
TEST(Stage, simulates_what_weft_run_simulates) {
    Stage stage = open_small();
    for (const Action& action : sample_actions())
        if (std::holds_alternative<ChangeScene>(action)) (void)stage.apply(action);
    auto fresh = Stage::open(stage.document(), {.simulation = {.backend = "cpu"}});
    ASSERT_TRUE(fresh);
    run(stage, 5), run(*fresh, 5);
    EXPECT_EQ(stage.hash(), fresh->hash());
}

TEST(Stage, goes_on_with_other_threads_without_a_change) {
    Stage stage = open_small(), plain = open_small();
    run(stage, 3), run(plain, 8);
    must(stage.apply(UseBackend{"cpu", 2}));
    EXPECT_EQ(stage.world().world().backend().threads(), 2u);
    run(stage, 5);
    EXPECT_EQ(stage.hash(), plain.hash());
    must(stage.apply(Seek{2}));
    run(stage, 6);
    EXPECT_EQ(stage.hash(), plain.hash());
}

TEST(Timelines, keep_older_frames_on_disk) {
    ScratchFolder folder;
    Stage stage = open_small({.timeline = {.memory = 150'000, .folder = folder.path()}});
    std::vector<std::string> hashes{stage.hash()};
    for (int i = 0; i < 12; ++i) {
        run(stage, 1);
        hashes.push_back(stage.hash());
    }
    EXPECT_GT(stage.timeline().bytes_on_disk(), 100'000u);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "the file has no name";
    for (std::uint64_t frame = 0; frame <= 12; ++frame) {
        must(stage.apply(Seek{frame}));
        EXPECT_EQ(stage.hash(), hashes[frame]);
    }
    EXPECT_THAT(stage.timeline().note(), IsEmpty());
    const std::size_t on_disk = stage.timeline().bytes_on_disk();
    must(stage.apply(Seek{0}));
    run(stage, 12);
    EXPECT_LT(stage.timeline().bytes_on_disk(), on_disk + 60'000) << "places in the file are used again";
}

TEST(Timelines, drop_the_oldest_frames_without_a_disk) {
    Stage stage = open_small({.timeline = {.memory = 200'000, .folder = "/no/such/folder"}});
    run(stage, 12);
    EXPECT_THAT(stage.timeline().note(), HasSubstr("cannot be kept on disk (/no/such/folder: No such file"));
    EXPECT_TRUE(stage.timeline().contains(0));
    EXPECT_FALSE(stage.timeline().contains(1));
    EXPECT_TRUE(stage.timeline().contains(12));
    EXPECT_FALSE(stage.apply(Seek{1}));
    must(stage.apply(Seek{12}));
    must(stage.apply(Reset{}));
}

#ifdef WEFT_VULKAN
// While the scene is opened, and at each of a few submits in a row: while a frame runs, and while its result is read.
// Labels: no-asan long
TEST(Stages, go_on_on_the_cpu_when_the_device_is_lost) {
    bool in_frame = false;
    for (const int submits : {40, 60, 61, 62, 63, 64, 65}) {
        if (submits > 61 && in_frame && !std::getenv("WEFT_LONG_TESTS")) continue;  // each takes seconds
        SCOPED_TRACE(submits);
        ::setenv("WEFT_LOSE_DEVICE", std::to_string(submits).c_str(), 1);
        auto opened = Stage::open(small_document(), {.simulation = {.backend = "vulkan"}});
        ::unsetenv("WEFT_LOSE_DEVICE");
        ASSERT_TRUE(opened) << opened.error().message();
        Stage stage = std::move(*opened);
        const bool lost_at_once = stage.world().world().backend().name() == "cpu";
        EXPECT_EQ(lost_at_once, submits == 40);
        std::vector<std::string> notes;
        for (int i = 0; i < 60 && notes.empty(); ++i) {
            must(stage.step());
            notes = stage.take_notes();
        }
        ASSERT_EQ(notes.size(), 1u);
        EXPECT_THAT(notes[0], testing::AnyOf(HasSubstr("the CPU goes on from frame " + std::to_string(stage.frame())),
                                             HasSubstr("the CPU begins again at frame 0")));
        in_frame = in_frame || notes[0].find("VK_ERROR_DEVICE_LOST") != std::string::npos;
        EXPECT_EQ(stage.world().world().backend().name(), "cpu");
        const std::uint64_t frame = stage.frame();
        must(stage.apply(change_of("/gravity", Json{0, -1, 0})));
        must(stage.step());
        EXPECT_EQ(stage.frame(), frame + 1);
        must(stage.apply(Undo{}));
        EXPECT_EQ(stage.frame(), frame);
    }
    EXPECT_TRUE(in_frame);
}
#endif

}  // namespace
}  // namespace weft::editor
