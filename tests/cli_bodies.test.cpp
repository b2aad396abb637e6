// The program with rigid bodies.

#include "cli_fixture.h"

namespace {

using weft::Cli;
using weft::Json;
using weft::read_file;

// A ball of 2 kg falls for half a second from (3, 9, 0), away from the cloth.
TEST_F(Cli, stats_tell_the_momentum_and_energy_of_bodies) {
    EXPECT_TRUE(stats("--frames 1")["bodies"].is_null()) << "there are none";
    Json scene = Json::parse(read_file(folder_ / "sheet.json"), nullptr, true, true);
    scene["colliders"].push_back({{"name", "stone"},
                                  {"sphere", {{"radius", 0.1}}},
                                  {"transform", {{"position", {3, 9, 0}}}},
                                  {"motion", {{"dynamic", {{"mass", 2}}}}}});
    write("stone.json", scene.dump());
    ASSERT_EQ(weft("run stone.json --frames 30 --quiet --stats stone_stats.json").status, 0);
    const Json bodies = Json::parse(read_file(folder_ / "stone_stats.json"))["bodies"];
    const double v = -9.81 / 2;
    EXPECT_EQ(bodies["count"], 1);
    EXPECT_NEAR(bodies["momentum"][1], 2 * v, 1e-3);
    EXPECT_NEAR(bodies["angular_momentum"][2], 3 * 2 * v, 1e-2);
    EXPECT_NEAR(bodies["kinetic_energy"], v * v, 1e-2);
    EXPECT_NEAR(bodies["max_speed"], -v, 1e-3);
}

}  // namespace
