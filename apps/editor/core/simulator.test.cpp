#include "editor/core/simulator.h"

#include "editor/core/scene.test.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

namespace weft::editor {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

std::string hash_of(Simulator& simulator) {
    std::string hash;
    simulator.run([&](Stage& stage) { hash = stage.hash(); });
    simulator.finish();
    return hash;
}

TEST(Simulator, carries_out_what_is_posted_in_order) {
    Simulator simulator(open_small(), {});
    std::uint64_t last = 0;
    for (const Action& action : sample_actions()) last = simulator.post(action);
    last = simulator.post(Advance{3});
    simulator.finish();
    EXPECT_EQ(simulator.newest()->acknowledged, last);
    EXPECT_EQ(simulator.newest()->frame, 3u);
    Stage stage = open_small();
    for (const Action& action : sample_actions()) (void)stage.apply(action);
    must(stage.apply(Advance{3}));
    EXPECT_EQ(hash_of(simulator), stage.hash());
}

TEST(Simulator, publishes_nothing_after_a_look) {
    Simulator simulator(open_small(), {});
    simulator.finish();
    const auto before = simulator.newest();
    std::uint64_t frame = 1;
    simulator.look([&](const Stage& stage) { frame = stage.frame(); });
    simulator.finish();
    EXPECT_EQ(frame, 0u);
    EXPECT_EQ(simulator.newest(), before);
}

TEST(Simulator, plays_and_pauses) {
    Simulator simulator(open_small(), {});
    simulator.set_speed(0);
    simulator.play(true);
    while (simulator.newest()->frame < 5) std::this_thread::yield();
    simulator.play(false);
    simulator.finish();
    const std::uint64_t frame = simulator.newest()->frame;
    EXPECT_FALSE(simulator.newest()->playing);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(simulator.newest()->frame, frame);
}

TEST(Simulator, reports_actions_that_fail) {
    Simulator simulator(open_small(), {});
    const std::uint64_t number = simulator.post(change_of("/cloths/0/fabric/density", -1));
    simulator.finish();
    const auto failures = simulator.take_failures();
    ASSERT_THAT(failures, SizeIs(1));
    EXPECT_EQ(failures[0].number, number);
    EXPECT_THAT(failures[0].errors.front().message(), HasSubstr("must be > 0"));
    EXPECT_THAT(simulator.take_failures(), SizeIs(0));
}

// Edits arrive at any frame; the log says at which, and gives the same bits.
TEST(Simulator, writes_a_log_that_plays_to_the_same_state) {
    ScratchFolder folder;
    std::string expected;
    {
        Stage stage = open_small();
        auto log = ActionLog::create(folder / "log", {stage.document(), "cpu", 1});
        ASSERT_TRUE(log);
        Simulator simulator(std::move(stage), {}, std::move(*log));
        simulator.set_speed(0);
        simulator.play(true);
        for (int i = 0; i < 30; ++i) {
            simulator.post(change_of("/cloths/0/fabric/density", 0.1 + 0.01 * i, 5));
            simulator.post(change_of("/colliders/0/transform/position", Json{0.01 * i, 0, 0}, 6));
            if (i % 10 == 9) simulator.post(Undo{});
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        simulator.play(false);
        expected = hash_of(simulator);
    }
    const auto log = read_log(folder / "log");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_TRUE(log->complete);
    auto again = open_stage(log->head, {});
    ASSERT_TRUE(again);
    must(play(*again, log->actions, log->end));
    EXPECT_EQ(again->hash(), expected);
}

TEST(Simulator, stops_when_a_cloth_diverges) {
    Stage stage = open_small();
    Simulator simulator(std::move(stage), {});
    simulator.run([](Stage& one) {
        World& world = one.world().world();
        WorldSettings settings = world.settings();
        settings.gravity.y = std::numeric_limits<float>::quiet_NaN();  // no document can hold it
        world.configure(settings);
    });
    simulator.set_speed(0);
    simulator.play(true);
    std::vector<Failure> failures;
    for (int i = 0; i < 5000 && failures.empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        failures = simulator.take_failures();
    }
    simulator.finish();
    EXPECT_FALSE(simulator.newest()->playing);
    ASSERT_THAT(failures, SizeIs(1));
    EXPECT_THAT(failures[0].errors.front().message(), HasSubstr("has diverged (gravity is not finite)"));
}

TEST(Simulator, wakes_the_view_and_gives_it_a_copy) {
    std::atomic<int> woken{0};
    Simulator simulator(open_small(),
                        {.observe = [](Stage& stage) { return std::make_shared<std::uint64_t>(stage.frame()); },
                         .wake = [&] { ++woken; }});
    simulator.post(Advance{4});
    simulator.finish();
    EXPECT_GE(woken.load(), 2);
    EXPECT_EQ(*static_cast<const std::uint64_t*>(simulator.newest()->picture.get()), 4u);
}

}  // namespace
}  // namespace weft::editor
