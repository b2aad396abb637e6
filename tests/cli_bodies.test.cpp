// The program with rigid bodies.

#include "cli_fixture.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

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

/// The names of the nodes in a .glb, in their order.
std::vector<std::string> nodes_of(const std::filesystem::path& path) {
    const std::string file = read_file(path);
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, &file.at(12), sizeof bytes);  // length of the JSON chunk, which follows the header
    std::vector<std::string> names;
    const Json content = Json::parse(file.substr(20, bytes));
    for (const Json& node : content["nodes"]) names.push_back(node["name"]);
    return names;
}

TEST_F(Cli, a_glb_has_the_bodies_and_on_demand_the_other_colliders) {
    using Names = std::vector<std::string>;
    const std::string without = "run sheet.json --frames 3 --quiet --out plain.glb";
    ASSERT_EQ(weft(without).status, 0);
    EXPECT_EQ(nodes_of(folder_ / "plain.glb"), Names{"sheet"}) << "the ball is no body";
    ASSERT_EQ(weft(without + " --colliders").status, 0);
    EXPECT_EQ(nodes_of(folder_ / "plain.glb"), (Names{"sheet", "ball"}));

    Json scene = Json::parse(read_file(folder_ / "sheet.json"), nullptr, true, true);
    scene["colliders"].push_back({{"name", "stone"},
                                  {"box", {{"half_extents", {0.1, 0.1, 0.1}}}},
                                  {"transform", {{"position", {0, 1, 0}}}},
                                  {"motion", {{"dynamic", {{"mass", 0.2}}}}}});
    scene["colliders"].push_back({{"name", "ground"}, {"plane", Json::object()}});
    write("stone.json", scene.dump());
    ASSERT_EQ(weft("run stone.json --frames 3 --quiet --out stone.glb --out stone.obj").status, 0);
    EXPECT_EQ(nodes_of(folder_ / "stone.glb"), (Names{"sheet", "stone"}));
    EXPECT_EQ(read_file(folder_ / "stone.obj").find("stone\n"), std::string::npos);
    ASSERT_EQ(weft("run stone.json --frames 0 --quiet --colliders --out still.GLB --out still.ply").status, 0);
    EXPECT_EQ(nodes_of(folder_ / "still.GLB"), (Names{"sheet", "ball", "stone"}));

    expect_usage_error("run stone.json --colliders --out a.obj", "--colliders: needs an --out FILE.glb");
    expect_usage_error("run stone.json --colliders", "--colliders: needs an --out FILE.glb");
}

}  // namespace
