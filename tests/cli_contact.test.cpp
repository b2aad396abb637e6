// Contact between cloths, as a user sees it: crossings, counts and messages of weft run.

#include "cli_fixture.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;
using weft::Cli;
using weft::Json;
using weft::Outcome;
using weft::read_file;

// The statistics must show it.
TEST_F(Cli, cloth_falls_on_cloth_without_crossings) {
    for (const std::string self_collision : {"exact", "fast"}) {
        const std::string sheet =
            R"("mesh": { "grid": { "resolution": [8, 8] } }, "self_collision": ")" + self_collision + '"';
        write("fall.json",
              R"({ "weft": 1, "cloths": [{ )" + sheet + R"( }, { )" + sheet +
                  R"(, "transform": { "position": [0, 0.25, 0], "rotation": [4, 10, 0] }, "velocity": [0, -3, 0] }],
                               "colliders": [{ "plane": { "offset": -0.1 } }] })");
        const Outcome outcome = weft("run fall.json --frames 30 --crossings every --stats fall_stats.json --quiet");
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const nlohmann::json stats = nlohmann::json::parse(read_file(folder_ / "fall_stats.json"));
        EXPECT_EQ(stats["intersections"]["worst"], 0);
        EXPECT_EQ(stats["intersections"]["order_lost"], 0);
        EXPECT_GT(stats["searches"], 0);
        EXPECT_GT(stats["self_contacts"], 0);
        EXPECT_GT(stats["stage_ms"]["cloth contact"], 0);
    }
}

// Cloth drawn through a hoop of cloth, an overhand knot, a towel that is twisted, a tube that crumples. All of them
// touch cloth within half a second. `scripts/test --long` runs a second of each.
// Labels: slow no-asan long
TEST_F(Cli, cloth_of_the_contact_scenes_never_crosses) {
    for (const auto& entry : fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "scenes" / "contact")) {
        if (entry.path().extension() != ".json") continue;
        SCOPED_TRACE(entry.path());
        // One of them starts with crossings, which are gone within a second.
        const bool starts_crossed = entry.path().stem() == "crossed";
        const std::string seconds = starts_crossed || std::getenv("WEFT_LONG_TESTS") ? "1" : "0.5";
        const Outcome outcome = weft("run " + entry.path().string() + " --seconds " + seconds +
                                     " --crossings every --stats scene_stats.json --quiet");
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const Json stats = Json::parse(read_file(folder_ / "scene_stats.json"));
        EXPECT_EQ(stats["intersections"][starts_crossed ? "triangles" : "worst"], 0);
        EXPECT_EQ(stats["tangled"] > 0, starts_crossed);
        EXPECT_EQ(stats["intersections"]["order_lost"], 0);
        EXPECT_EQ(stats["finite"], true);
        EXPECT_GT(stats["searches"], 0);
        if (seconds == "0.5") {
            EXPECT_GT(stats["self_contacts"], 0);
        }
        EXPECT_LT(stats["stretch"]["mean"], 0.02);
    }
}

// What the constraints ask for in a substep is then more than contact can take back. Cloth must slide all the same.
// Labels: slow no-asan
TEST_F(Cli, cloth_pulled_over_cloth_does_not_jam_with_few_substeps) {
    const std::string scene = std::string(WEFT_SOURCE_DIR) + "/scenes/contact/ring.json";
    const Outcome outcome =
        weft("run " + scene + " --substeps 20 --seconds 1 --crossings every --stats ring.json --quiet");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json stats = Json::parse(read_file(folder_ / "ring.json"));
    EXPECT_EQ(stats["intersections"]["worst"], 0);
    EXPECT_LT(stats["stretch"]["mean"], 0.01);
    EXPECT_LT(stats["limited"], 2000);
}

TEST_F(Cli, counts_contacts_of_cloth_with_cloth_on_vulkan) {
    write("sheet.json", R"({ "weft": 1, "solver": { "substeps": 2 }, "cloths": [
        { "mesh": { "grid": { "size": [0.2, 0.2], "resolution": [6, 6] } }, "self_collision": true,
          "pins": [{ "box": { "min": [-1, -1, -1], "max": [1, 1, 1] } }] },
        { "mesh": { "grid": { "size": [0.2, 0.2], "resolution": [6, 6] } }, "self_collision": true,
          "transform": { "position": [0.01, 0.01, 0.02] } }] })");
    const Json on_cpu = stats("--frames 6 --backend cpu"), on_vulkan = stats("--frames 6 --backend vulkan");
    EXPECT_GT(on_cpu["self_contacts"], 0);
    for (const char* key : {"self_contacts", "limited", "tangled", "intersections"})
        EXPECT_EQ(on_vulkan[key], on_cpu[key]) << key;
}

TEST_F(Cli, tells_where_pins_press_cloth_through_cloth) {
    const auto sheet = [](const std::string& rest) {
        return R"({ "mesh": { "grid": { "size": [0.2, 0.2], "resolution": [6, 6] } }, "self_collision": true, )" +
               rest + " }";
    };
    const std::string all = R"("pins": [{ "box": { "min": [-1, -1, -1], "max": [1, 1, 1] })";
    write("press.json", R"({ "weft": 1, "solver": { "substeps": 2 }, "cloths": [)" +
                            sheet(R"("name": "below", )" + all + "}]") + "," +
                            sheet(R"("name": "above", "transform": { "position": [0.01, 0.05, 0.02] }, )" + all +
                                  R"(, "motion": [{ "time": 0 }, { "time": 0.1, "offset": [0, -0.1, 0] }] }])") +
                            "] }");
    const Outcome outcome = weft("run press.json --frames 9 --stats press-stats.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("  tangled       first in frame "), std::string::npos) << outcome.out;
    const Json first = Json::parse(std::ifstream(folder_ / "press-stats.json"))["tangled_first"];
    EXPECT_GT(first["frame"], 0);
    EXPECT_EQ(first["cloth"], "below") << "its particles come first";
    EXPECT_EQ(stats("--frames 1")["tangled_first"], nullptr);
}

}  // namespace
