// What weft run tells about colliders inside cloth, and about those that passed it.

#include "cli_fixture.h"

namespace {

using weft::Cli;
using weft::Json;
using weft::Outcome;
using weft::read_file;

class CliPenetration : public Cli {
  protected:
    /// A pinned sheet at y = 0, and balls with these keys.
    void write_balls(const std::string& balls) {
        write("sheet.json", R"({ "weft": 1, "solver": { "substeps": 2 },
            "cloths": [{ "name": "sheet", "mesh": { "grid": { "size": [1, 1], "resolution": [11, 11] } },
                         "pins": [{ "box": { "min": [-1, -1, -1], "max": [1, 1, 1] } }] }],
            "colliders": [)" + balls +
                                "] }");
    }
    static constexpr const char* rising = R"({ "name": "rising", "sphere": { "radius": 0.1 },
        "motion": { "keys": [{ "time": 0, "position": [0.2, -0.2, 0] }, { "time": 0.1, "position": [0.2, -0.05, 0] },
                   { "time": 0.2, "position": [0.2, -0.2, 0] }] } })";
    static constexpr const char* shot = R"({ "name": "shot", "sphere": { "radius": 0.05 },
        "motion": { "keys": [{ "time": 0.05, "position": [-0.21, -0.5, 0.13] },
                   { "time": 0.0667, "position": [-0.21, 0.5, 0.13] }] } })";
};

TEST_F(CliPenetration, is_that_of_the_last_frame_and_of_the_worst_one) {
    write_balls(rising);
    const Json middle = stats("--frames 6")["penetration"], end = stats("--frames 12")["penetration"];
    // The center of the ball is 5 cm below the sheet then.
    EXPECT_NEAR(middle["max"].get<double>(), 0.05, 1e-4);
    EXPECT_GE(middle["at_most"], middle["max"]);
    EXPECT_LT(middle["at_most"].get<double>(), 0.0502);
    EXPECT_GT(middle["count"], 0);
    EXPECT_GT(middle["samples"], middle["count"]);
    EXPECT_EQ(middle["worst"]["max"], middle["max"]);
    EXPECT_EQ(middle["worst"]["frame"], 6);

    EXPECT_EQ(end["max"], 0);
    EXPECT_EQ(end["count"], 0);
    const Json worst = end["worst"];
    EXPECT_EQ(worst["frame"], 6);
    EXPECT_EQ(worst["max"], middle["max"]);
    EXPECT_EQ(worst["count"], middle["count"]);
    EXPECT_EQ(worst["collider"], "rising");
    EXPECT_EQ(worst["cloth"], "sheet");
    ASSERT_EQ(worst["position"].size(), 3u);
    EXPECT_NEAR(worst["position"][0].get<double>(), 0.2, 0.02);
    EXPECT_NEAR(worst["position"][1].get<double>(), 0, 1e-6);
    EXPECT_NEAR(worst["position"][2].get<double>(), 0, 0.02);
}

TEST_F(CliPenetration, is_none_where_nothing_is_inside) {
    write_balls(R"({ "name": "far", "sphere": { "radius": 0.1 }, "transform": { "position": [0, -0.2, 0] } })");
    const Json all = stats("--frames 3");
    EXPECT_EQ(all["penetration"]["max"], 0);
    EXPECT_EQ(all["penetration"]["worst"]["max"], 0);
    for (const char* key : {"collider", "cloth", "position"}) EXPECT_EQ(all["penetration"]["worst"][key], nullptr);
    EXPECT_EQ(all["passed"], Json::parse(R"({ "count": 0, "points": 0, "first": null })"));
}

// It is outside before and after.
TEST_F(CliPenetration, tells_what_passed_between_two_frames) {
    write_balls(std::string(rising) + "," + shot);
    const Json all = stats("--frames 6"), passed = all["passed"];
    EXPECT_EQ(passed["count"], 1);
    EXPECT_EQ(passed["points"], 1) << "the center of the ball";
    EXPECT_EQ(passed["first"]["frame"], 4);
    EXPECT_EQ(passed["first"]["collider"], "shot");
    EXPECT_EQ(passed["first"]["cloth"], "sheet");
    EXPECT_NEAR(passed["first"]["position"][0].get<double>(), -0.21, 1e-6);
    EXPECT_NEAR(passed["first"]["position"][1].get<double>(), 0.5, 0.01) << "at the end of the frame";
    EXPECT_EQ(all["penetration"]["worst"]["collider"], "rising");
    EXPECT_EQ(stats("--frames 3")["passed"]["count"], 0);
}

TEST_F(CliPenetration, is_in_the_help_and_in_the_docs) {
    const Outcome help = weft("run --help");
    EXPECT_EQ(help.status, 0);
    for (const char* word : {"penetration", "passages"}) EXPECT_NE(help.out.find(word), std::string::npos) << word;
    const std::string docs = read_file(std::filesystem::path(WEFT_SOURCE_DIR) / "docs" / "exports.md");
    write_balls(rising);
    const Json all = stats("--frames 1");
    for (const char* group : {"penetration", "passed"}) {
        EXPECT_NE(docs.find("| `" + std::string(group) + "`"), std::string::npos) << group;
        for (const auto& [key, value] : all[group].items())
            EXPECT_NE(docs.find("`" + key + "`"), std::string::npos) << group << ' ' << key;
    }
}

}  // namespace
