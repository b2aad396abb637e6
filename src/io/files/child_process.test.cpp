#include "io/files/child_process.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <span>
#include <string_view>
#include <thread>

namespace weft {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

Result<ChildProcess> shell(const std::string& script, ChildOptions options) {
    options.where = "the test";
    return ChildProcess::start({"sh", "-c", script}, options);
}

void wait_for_end(ChildProcess& child) {
    for (int i = 0; i < 2000 && child.running(); ++i) std::this_thread::sleep_for(5ms);
    EXPECT_FALSE(child.running());
}

TEST(ChildProcess, what_it_prints_can_be_read_while_it_runs) {
    auto child = shell("echo half; read line; echo whole; echo problem >&2", {.where = {}, .prints = true});
    ASSERT_TRUE(child) << child.error().message();
    for (int i = 0; i < 2000 && child->messages().empty(); ++i) {
        ASSERT_TRUE(child->running());
        std::this_thread::sleep_for(5ms);
    }
    EXPECT_EQ(child->messages(), "half\n");
    EXPECT_FALSE(child->succeeded()) << "it still runs";
    constexpr std::string_view line = "go on\n";
    ASSERT_TRUE(child->write(std::as_bytes(std::span(line))));
    wait_for_end(*child);
    EXPECT_EQ(child->messages(), "half\nwhole\nproblem\n");
    EXPECT_TRUE(child->succeeded());
}

TEST(ChildProcess, its_output_is_dropped_unless_it_is_asked_for) {
    auto child = shell("echo nothing; echo problem >&2; exit 3", {.where = {}});
    ASSERT_TRUE(child);
    wait_for_end(*child);
    EXPECT_EQ(child->messages(), "problem\n");
    EXPECT_FALSE(child->succeeded());
}

TEST(ChildProcess, variables_are_replaced_and_added_and_the_others_stay) {
    ::setenv("WEFT_TEST_OLD", "old", 1);
    ::setenv("WEFT_TEST_KEPT", "kept", 1);
    auto child = shell(
        "echo $WEFT_TEST_OLD $WEFT_TEST_NEW $WEFT_TEST_KEPT",
        {.where = {}, .environment = {{"WEFT_TEST_OLD", "replaced"}, {"WEFT_TEST_NEW", "added"}}, .prints = true});
    ASSERT_TRUE(child);
    wait_for_end(*child);
    EXPECT_EQ(child->messages(), "replaced added kept\n");
}

TEST(ChildProcess, is_asked_to_end_and_may_clean_up) {
    auto child = shell("trap 'echo cleaned; exit 0' TERM; echo ready; while :; do sleep 0.05; done",
                       {.where = {}, .prints = true});
    ASSERT_TRUE(child);
    for (int i = 0; i < 2000 && child->messages().empty() && child->running(); ++i) std::this_thread::sleep_for(5ms);
    child->end(10s);
    EXPECT_FALSE(child->running());
    EXPECT_THAT(child->messages(), HasSubstr("cleaned"));
}

TEST(ChildProcess, is_forced_to_end_if_it_does_not_listen) {
    auto child = shell("trap '' TERM; echo ready; while :; do sleep 0.05; done", {.where = {}, .prints = true});
    ASSERT_TRUE(child);
    for (int i = 0; i < 2000 && child->messages().empty() && child->running(); ++i) std::this_thread::sleep_for(5ms);
    const auto begin = std::chrono::steady_clock::now();
    child->end(200ms);
    EXPECT_FALSE(child->running());
    EXPECT_FALSE(child->succeeded());
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 8s);
}

TEST(ChildProcess, a_program_that_is_missing_is_named) {
    const auto with = ChildProcess::start({"weft-no-such-program"}, {.where = "video", .package = "nothing"});
    ASSERT_FALSE(with);
    EXPECT_THAT(with.error().message(), HasSubstr("install"));
    const auto without = ChildProcess::start({"/no/such/program"}, {.where = "export"});
    ASSERT_FALSE(without);
    EXPECT_THAT(without.error().message(),
                testing::AllOf(HasSubstr("/no/such/program"), HasSubstr("cannot be started")));
}

}  // namespace
}  // namespace weft
