// Bodies in scene files.
#include "io/scenes/json_text.h"
#include "io/scenes/scene_file.h"
#include "io/scenes/scene_text_edit.h"
#include "io/scenes/scene_writer.h"

#include "io/scenes/read_scene.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace weft {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string with_motion(const std::string& motion, const std::string& shape = R"("sphere": {})") {
    return R"({"weft": 1, "cloths": [{}], "colliders": [{)" + shape + R"(, "motion": )" + motion + "}]}";
}

const char* const every_key = R"({"dynamic": {"mass": 2, "density": 500, "center": [0, -0.1, 0], "inertia": [1, 2, 2.5],
    "velocity": [0, 0, -60], "spin": [0, 360, 0], "damping": 0.1, "spin_damping": 0.2, "restitution": 0.5,
    "reaction": false}})";

TEST(SceneBody, reads_every_key) {
    const SceneDesc scene = read(with_motion(every_key));
    ASSERT_TRUE(scene.colliders[0].body);
    EXPECT_EQ(*scene.colliders[0].body, (BodyDesc{.mass = 2,
                                                  .density = 500,
                                                  .center = {0, -0.1f, 0},
                                                  .inertia = {1, 2, 2.5f},
                                                  .velocity = {0, 0, -60},
                                                  .spin = {0, 360, 0},
                                                  .damping = 0.1f,
                                                  .spin_damping = 0.2f,
                                                  .restitution = 0.5f,
                                                  .reaction = false}));
    EXPECT_EQ(*read(with_motion(R"({"dynamic": {}})")).colliders[0].body, BodyDesc());
    EXPECT_FALSE(read(with_motion(R"("static")")).colliders[0].body);
    EXPECT_FALSE(read(with_motion(R"({"keys": [{}]})")).colliders[0].body);
}

TEST(SceneBody, is_the_same_after_writing) {
    for (const char* const motion : {every_key, R"({"dynamic": {}})", R"({"dynamic": {"mass": 3}})"}) {
        const SceneDesc scene = read(with_motion(motion));
        const auto text = write_scene(scene);
        ASSERT_TRUE(text.ok());
        EXPECT_TRUE(read(*text) == scene) << *text;
        EXPECT_THAT(*text, HasSubstr("\"dynamic\": {"));
    }
    EXPECT_THAT(*write_scene(read(with_motion(R"("static")"))), Not(HasSubstr("motion")));
}

TEST(SceneBody, holds_pins) {
    EXPECT_THAT(errors_of(R"({"weft": 1, "cloths": [{"pins": [{"vertices": [0], "attach": "crate"}]}],
        "colliders": [{"name": "crate", "box": {}, "motion": {"dynamic": {}}}]})"),
                ElementsAre());
}

TEST(SceneBody, names_what_is_wrong) {
    const auto errors = [](const std::string& keys) {
        return errors_of(with_motion(R"({"dynamic": {)" + keys + "}}"));
    };
    EXPECT_THAT(errors(R"("mass": -1)"),
                ElementsAre("s.json: /colliders/0/motion/dynamic/mass: must be ≥ 0 kg, got -1"));
    EXPECT_THAT(errors(R"("mas": 1)"),
                ElementsAre("s.json: /colliders/0/motion/dynamic/mas: unknown key \"mas\"; did you mean \"mass\"?"));
    EXPECT_THAT(errors(R"("reaction": 1)"),
                ElementsAre("s.json: /colliders/0/motion/dynamic/reaction: must be true or false, got 1"));
    EXPECT_THAT(errors(R"("inertia": [1, 1, 3])"),
                ElementsAre("s.json: /colliders/0/motion/dynamic/inertia: must hold moments that a body can have: each "
                            "at most the sum of the other two, got [1, 1, 3]"));
    EXPECT_THAT(errors_of(with_motion(R"({"dynamic": 3})")),
                ElementsAre("s.json: /colliders/0/motion/dynamic: must be an object, got 3"));
    EXPECT_THAT(errors_of(with_motion(R"({"dynamic": {}, "keys": [{}]})")),
                ElementsAre("s.json: /colliders/0/motion: must have one of \"keys\" or \"dynamic\", got 2"));
    EXPECT_THAT(
        errors_of(with_motion(R"("dynamic")")),
        ElementsAre("s.json: /colliders/0/motion: must be \"static\" or an object with \"keys\" or \"dynamic\", "
                    "got \"dynamic\""));
    EXPECT_THAT(errors_of(with_motion(R"({"dynamic": {}})", R"("plane": {})")),
                ElementsAre("s.json: /colliders/0/motion/dynamic: must not stand beside \"plane\": a plane has no "
                            "volume, so it cannot be a body"));
    EXPECT_THAT(
        errors_of(with_motion(R"({"dynamic": {}})", R"("mesh": {"file": "a.obj", "contact": "surface"})")),
        ElementsAre("s.json: /colliders/0/mesh/contact: must not be \"surface\" with a \"dynamic\" motion: bodies are "
                    "solids"));
}

TEST(SceneBody, changes_in_the_text_of_a_scene) {
    const std::string text = R"({
    "weft": 1,
    "cloths": [ {} ],
    "colliders": [
        // falls
        { "sphere": {}, "motion": { "dynamic": { "mass": 1 } } } // a ball
    ]
}
)";
    SceneDesc scene = read(text);
    scene.colliders[0].body->mass = 2.5f;
    scene.colliders[0].body->velocity = {0, 1, 0};
    const auto edited = edit_scene_text(text, nlohmann::json::parse(*write_scene(scene)));
    ASSERT_TRUE(edited.ok()) << edited.error().message();
    EXPECT_TRUE(read(*edited) == scene);
    EXPECT_THAT(*edited, HasSubstr("// falls"));
    EXPECT_THAT(*edited, HasSubstr(R"("motion": { "dynamic": { "mass": 2.5, "velocity": [0, 1, 0] } } })"));
}

}  // namespace
}  // namespace weft
