// weft validate.

#include "cli_fixture.h"

#include <gmock/gmock.h>

namespace {

using testing::HasSubstr;
using weft::Cli;
using weft::Json;
using weft::read_file;

TEST_F(Cli, validate_passes_a_case_and_writes_what_it_measured) {
    const auto outcome = weft("validate --quick --backend cpu --case free_fall --case incline --json results.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("11 of 11 checks pass, in 2 of 2 cases"));
    const Json results = Json::parse(read_file(folder_ / "results.json"));
    EXPECT_EQ(results["complete"], true);
    EXPECT_EQ(results["pass"], true);
    ASSERT_EQ(results["cases"].size(), 2u);
    const Json& check = results["cases"][0]["checks"][0];
    EXPECT_NEAR(check["measured"], 0.5 * 9.81 * (1 + 1.0 / 60), 1e-4);
    EXPECT_EQ(check["pass"], true);
}

TEST_F(Cli, validate_fails_where_weft_misses_a_reference) {
    const auto outcome = weft("validate --quick --backend cpu --case cantilever");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out, HasSubstr("FAIL  drop over reach, dihedral"));
    EXPECT_THAT(outcome.out, HasSubstr("  why: "));
}

// The whole case takes half a minute or more. `timeout` sends a signal twice, so each is sent twice.
TEST_F(Cli, validate_ended_early_keeps_what_it_has_measured) {
    write("when_measured",
          "\"$@\" & program=$!\n"
          "until grep -q expected stdout.txt || ! kill -0 $program; do sleep 0.05; done\n"
          "kill -s TERM $program; sleep 0.02; kill -s TERM $program; wait $program\n");
    const auto outcome =
        weft("validate --backend cpu --case cantilever --json results.json", "timeout -k 9 120 sh ./when_measured");
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("cantilever: interrupted"));
    const Json results = Json::parse(read_file(folder_ / "results.json"));
    EXPECT_EQ(results["complete"], false);
    EXPECT_EQ(results["pass"], false);
    ASSERT_EQ(results["cases"].size(), 1u);
    EXPECT_EQ(results["cases"][0]["problem"], "interrupted");
    EXPECT_GE(results["cases"][0]["checks"].size(), 1u);
    EXPECT_LT(results["cases"][0]["checks"].size(), 176u);
}

TEST_F(Cli, validate_refuses_what_there_is_not) {
    auto outcome = weft("validate --case cantelever");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("unknown case 'cantelever'; did you mean \"cantilever\"?"));
    EXPECT_EQ(weft("validate --quick --case free_fall --json no/such/folder.json").status, 2);
    outcome = weft("validate --quick --backend vulkan --device nowhere --case free_fall");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("nowhere"));
    EXPECT_THAT(weft("validate --list").out, HasSubstr("catenary"));
}

}  // namespace
