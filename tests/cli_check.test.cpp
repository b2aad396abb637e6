// weft check, as a user sees it: errors with their places, and warnings.

#include "cli_fixture.h"

#include <string>

namespace {

using weft::Cli;
using weft::Outcome;

TEST_F(Cli, check_reports_every_problem_with_its_place) {
    write("bad.json", R"({ "weft": 1, "gravty": [0, -1, 0],
        "cloths": [{ "mesh": { "grid": {} }, "fabric": { "density": -1 } }, { "mesh": { "file": "missing.obj" } }] })");
    const Outcome outcome = weft("check bad.json");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("weft: error: bad.json: /cloths/0/fabric/density: must be > 0 kg/m², got -1"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("did you mean \"gravity\""), std::string::npos) << outcome.err;
    EXPECT_EQ(weft("check sheet.json").status, 0);
}

TEST_F(Cli, check_tells_the_size_and_warns_of_other_units) {
    write("big.obj", "v 0 0 0\nv 90 0 0\nv 0 0 90\nf 1 3 2\n");
    write("big.json", R"({ "weft": 1, "cloths": [{ "name": "disc", "mesh": { "file": "big.obj" } }] })");
    const Outcome outcome = weft("check big.json");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("90 × 0 × 90 m, mean edge"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.err.find("cloth 'disc' is 90 m in size"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.out.ends_with("big.json: ok, 1 warning\n")) << outcome.out;
    EXPECT_TRUE(weft("check sheet.json").out.ends_with("sheet.json: ok\n"));
}

TEST_F(Cli, check_warns_of_substeps_that_are_too_long_for_bending) {
    const auto warning = [&](const std::string& resolution, const std::string& solver) {
        write("fine.json", R"({ "weft": 1, "solver": { )" + solver +
                               R"( }, "cloths": [{ "name": "patch", "mesh": { "grid": {
            "size": [0.3, 0.3], "resolution": )" +
                               resolution + R"( } }, "fabric": { "preset": "leather" } }] })");
        const Outcome outcome = weft("check fine.json");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.err;
    };
    EXPECT_EQ(warning("[20, 20]", ""), "");
    const std::string text = warning("[80, 80]", "");
    EXPECT_NE(text.find("cloth 'patch' bends with "), std::string::npos) << text;
    EXPECT_NE(text.find(" mm are short for 20 substeps; "), std::string::npos) << text;
    EXPECT_EQ(warning("[80, 80]", R"("substeps": 200)"), "");
    EXPECT_EQ(warning("[80, 80]", R"("iterations": 4)"), "") << "it was not measured there";
}

TEST_F(Cli, check_warns_of_cloth_that_crosses_at_the_start) {
    const auto check = [&](const std::string& height, const std::string& self_collision) {
        const std::string sheet =
            R"("mesh": { "grid": { "resolution": [4, 4] } }, "self_collision": )" + self_collision;
        write("crossed.json", R"({ "weft": 1, "cloths": [{ )" + sheet + R"( }, { )" + sheet +
                                  R"(, "transform": { "position": [0, )" + height +
                                  R"(, 0], "rotation": [30, 10, 0] } }] })");
        const Outcome outcome = weft("check crossed.json");
        EXPECT_EQ(outcome.status, 0);
        return outcome.err.find("crosses itself or other cloth at the start") != std::string::npos;
    };
    EXPECT_TRUE(check("0.01", "true"));
    EXPECT_FALSE(check("1", "true"));
    EXPECT_TRUE(check("0.01", R"("fast")"));
    EXPECT_FALSE(check("1", R"("fast")"));
    EXPECT_FALSE(check("0.01", "false"));
}

TEST_F(Cli, check_warns_of_pictures_that_are_not_found) {
    write("here.png", "");
    write("looks.json", R"({ "weft": 1, "light": { "environment": { "file": "hall.hdr" } },
        "cloths": [{ "material": { "color_map": "here.png", "normal_map": "gone.png" } }] })");
    const Outcome outcome = weft("check looks.json");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(
        outcome.err.find("weft: warning: looks.json: /light/environment/file: hall.hdr: not found; tried hall.hdr, "),
        std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("weft: warning: looks.json: /cloths/0/material/normal_map: gone.png: not found"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(outcome.err.find("here.png"), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.out.ends_with("looks.json: ok, 2 warnings\n")) << outcome.out;
}

}  // namespace
