// Wind sources in scene files.
#include "io/scenes/scene_file.h"
#include "io/scenes/scene_writer.h"

#include "io/scenes/read_scene.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace weft {
namespace {

using testing::ElementsAre;

std::string with_source(const std::string& keys) {
    return R"({"weft": 1, "cloths": [{}], "air": {"wind": [{)" + keys + "}]}}";
}

TEST(SceneWind, reads_every_kind) {
    const auto read = parse_scene(R"({"weft": 1, "cloths": [{}], "air": {"wind": [
        {"velocity": [1, 2, 3]},
        {"kind": "jet", "velocity": [0, 8, 0], "diameter": 0.2, "shelter": 1.5,
         "transform": {"position": [1, 2, 3], "rotation": [0, 90, 0]},
         "motion": {"keys": [{"time": 0, "strength": 0}, {"time": 1, "position": [4, 5, 6], "rotation": [0, 0, 1]}]}},
        {"kind": "vortex", "swirl": -4, "inflow": 2, "radius": 0.6, "box": {"half_extents": [1, 2, 3], "border": 0},
         "motion": "static", "seed": 9}]}})",
                                  "s.json");
    ASSERT_TRUE(read.ok()) << read.error().message();
    const std::vector<WindDesc>& wind = read->air->wind;
    ASSERT_EQ(wind.size(), 3u);
    EXPECT_EQ(wind[0], WindDesc{.velocity = Vec3(1, 2, 3)});
    EXPECT_EQ(std::get<JetDesc>(wind[1].kind), JetDesc{0.2f});
    EXPECT_EQ(wind[1].shelter, 1.5f);
    const std::vector<WindKey> keys{{.time = 0, .position = {1, 2, 3}, .rotation_degrees = {0, 90, 0}, .strength = 0},
                                    {.time = 1, .position = {4, 5, 6}, .rotation_degrees = {0, 0, 1}, .strength = 1}};
    EXPECT_EQ(wind[1].motion, keys) << "a key has what the transform has, if it does not say otherwise";
    EXPECT_EQ(std::get<VortexDesc>(wind[2].kind), (VortexDesc{-4, 2, 0.6f}));
    EXPECT_EQ(wind[2].box, (WindBoxDesc{{1, 2, 3}, 0}));
    EXPECT_TRUE(wind[2].motion.empty());
    EXPECT_EQ(wind[2].seed, 9u);

    const auto text = write_scene(*read);
    ASSERT_TRUE(text.ok());
    const auto again = parse_scene(*text, "again");
    ASSERT_TRUE(again.ok()) << again.error().message();
    EXPECT_EQ(*again, *read);
}

TEST(SceneWind, names_what_is_wrong_and_where) {
    const auto errors = [](const std::string& keys) { return errors_of(with_source(keys)); };
    EXPECT_THAT(errors(R"("velocity": [1e6, 0, 0])"),
                ElementsAre("s.json: /air/wind/0/velocity/0: must be ≤ 10000 m/s, got 1000000"));
    EXPECT_THAT(errors(R"("kind": "jet", "diameter": 0)"),
                ElementsAre("s.json: /air/wind/0/diameter: must be ≥ 1e-6 m, got 0"));
    EXPECT_THAT(errors(R"("kind": "vortex", "radius": 0, "swirl": 1e6)"),
                ElementsAre("s.json: /air/wind/0/swirl: must be ≤ 10000 m/s, got 1000000",
                            "s.json: /air/wind/0/radius: must be ≥ 1e-6 m, got 0"));
    EXPECT_THAT(errors(R"("box": {"half_extents": [0, 1, 1], "border": -1})"),
                ElementsAre("s.json: /air/wind/0/box/half_extents/0: must be > 0 m, got 0",
                            "s.json: /air/wind/0/box/border: must be ≥ 0 m, got -1"));
    EXPECT_THAT(errors(R"("shelter": -1)"), ElementsAre("s.json: /air/wind/0/shelter: must be ≥ 0 m, got -1"));
    EXPECT_THAT(errors(R"("diameter": 1)"), ElementsAre("s.json: /air/wind/0/diameter: requires \"kind\": \"jet\""));
    EXPECT_THAT(errors(R"("kind": "jet", "swirl": 1)"),
                ElementsAre("s.json: /air/wind/0/swirl: requires \"kind\": \"vortex\""));
    EXPECT_THAT(errors(R"("kind": "storm")"),
                ElementsAre("s.json: /air/wind/0/kind: must be \"directional\", \"jet\" or \"vortex\", got \"storm\""));
    EXPECT_THAT(errors(R"("motion": {"keys": [{"time": 1, "strength": -1}, {"time": 1, "strength": 101}]})"),
                testing::UnorderedElementsAre(
                    "s.json: /air/wind/0/motion/keys/0/strength: must be ≥ 0, got -1",
                    "s.json: /air/wind/0/motion/keys/1/strength: must be ≤ 100, got 101",
                    "s.json: /air/wind/0/motion/keys/1/time: must be later than that of the key before, 1, got 1"));
    EXPECT_THAT(errors(R"("motion": {})"), ElementsAre("s.json: /air/wind/0/motion/keys: must hold at least one key"));
    EXPECT_THAT(errors(R"("motion": 3)"),
                ElementsAre("s.json: /air/wind/0/motion: must be \"static\" or an object with keys, got 3"));
}

}  // namespace
}  // namespace weft
