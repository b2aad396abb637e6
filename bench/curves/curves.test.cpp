// Tests of weft_bench_curves: its output, the points that it skips, the arguments that it rejects.

#include "../../tests/cli_fixture.h"

namespace {

using weft::Json;
using weft::Outcome;
using weft::read_file;

class BenchCurves : public weft::Cli {};

TEST_F(BenchCurves, draws_curves_of_error_against_time) {
    const Outcome outcome = weft("8 --frames 2 --warmup 0 --repeat 1 --json c.json --plot c.svg");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json report = Json::parse(read_file(folder_ / "c.json"));
    EXPECT_GE(report["scenes"].size(), 14u) << "seven methods, a grid and its irregular twin, once at least";
    EXPECT_LE(report["scenes"].size(), 70u) << "and five numbers of substeps";
    for (const Json& s : report["scenes"]) {
        EXPECT_EQ(s["frames"], 2);
        EXPECT_EQ(s["timed_frames"], 10);
        EXPECT_GT(s["ms_per_frame"]["median"], 0);
        EXPECT_GT(s["ratio"], 0);
        EXPECT_EQ(s["run_medians_ms"].size(), 1u);
    }
    EXPECT_NE(outcome.out.find("error over the last 0.03 s"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("irregular 8², lines, hierarchy, tethers"), std::string::npos);
    EXPECT_NE(outcome.out.find('*'), std::string::npos) << "something is always best";
    const std::string svg = read_file(folder_ / "c.svg");
    EXPECT_EQ(std::count(svg.begin(), svg.end(), '\n') > 100, true);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    for (const char* text : {"nan", "inf"}) EXPECT_EQ(svg.find(text), std::string::npos);
    for (const char* text : {">8²<", ">irregular 8²<", ">jacobi<", "ms a frame", "mean stretch, %"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    expect_usage_error("4", "side: must be from 8 to 1024, got 4");
    expect_usage_error("sheet.json", "side");
    expect_usage_error("--plot c.svg", "side is required");
    expect_usage_error("8 --substeps 3", "--substeps: is what the curves go through");
    expect_usage_error("8 --frames 0", "--frames: must give 1 to 1000000 frames, got 0");
    expect_usage_error("8 --plot nowhere/c.svg", "nowhere/c.svg");
}

TEST_F(BenchCurves, leaves_out_points_that_would_take_too_long) {
    const Outcome outcome = weft("8 --frames 2 --warmup 0 --repeat 1 --point-seconds 0 --json c.json --plot c.svg");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(Json::parse(read_file(folder_ / "c.json"))["scenes"].size(), 14u) << "the first of each method";
    EXPECT_NE(outcome.out.find("8² jacobi 5 and more: would take some 0 s, more than --point-seconds"),
              std::string::npos)
        << outcome.out;
    EXPECT_NE(read_file(folder_ / "c.svg").find("</svg>"), std::string::npos);
}

TEST_F(BenchCurves, gives_the_curves_that_it_has_when_interrupted) {
    const Outcome outcome = weft("24 --seconds 120 --quiet --json c.json", "timeout --foreground --preserve-status 2");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    if (outcome.err.find("before anything") == std::string::npos) {
        EXPECT_GE(Json::parse(read_file(folder_ / "c.json"))["scenes"].size(), 1u);
    }
}

}  // namespace
