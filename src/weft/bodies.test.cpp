// Rigid bodies through the public interface.
#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft {
namespace {

using testing::HasSubstr;

Simulation make_weightless() {
    auto simulation = Simulation::create({.gravity = {}}, {.backend = "cpu"});
    EXPECT_TRUE(simulation.ok());
    return std::move(*simulation);
}

ColliderDesc ball_of(float mass, Vec3 position = {}) {
    return {
        .name = "ball", .shape = SphereDesc{0.1f}, .transform = {.position = position}, .body = BodyDesc{.mass = mass}};
}

template <class T>
std::string message(const Result<T>& result) {
    std::string all;
    if (!result)
        for (const Error& error : result.errors()) all += error.message() + '\n';
    return all;
}

TEST(SimulationBodies, are_pushed_by_impulses) {
    Simulation simulation = make_weightless();
    const ColliderId ball = *simulation.add(ball_of(2, {1, 0, 0}));
    ASSERT_TRUE(simulation.push(ball, {0, 4, 0}, {1.1f, 0, 0}).ok());
    for (int i = 0; i < 30; ++i) simulation.step();
    const BodyMotion motion = *simulation.body(ball);
    EXPECT_NEAR(motion.velocity.y, 2, 1e-6);
    EXPECT_NEAR(motion.position.y, 1, 1e-4);
    // 0.1 m · 4 N·s over 2/5 m r², in degrees.
    EXPECT_NEAR(motion.spin.z, 0.4 / (0.4 * 2 * 0.01) * 57.29578, 0.01);
    EXPECT_NEAR(motion.energy, 0.5 * 2 * 4 + 0.5 * 0.4 * 0.4 / (0.4 * 2 * 0.01), 1e-4);
    EXPECT_NEAR(motion.mass, 2, 1e-6);
}

TEST(SimulationBodies, are_placed_at_once) {
    Simulation simulation = make_weightless();
    const ColliderId ball = *simulation.add(ball_of(1));
    ASSERT_TRUE(simulation.place_body(ball, {5, 6, 7}, {0, 90, 0}, {0, 0, 3}, {0, 180, 0}).ok());
    EXPECT_EQ(simulation.body(ball)->position, (Vec3{5, 6, 7}));
    EXPECT_NEAR(std::abs(simulation.body(ball)->rotation.y), std::sqrt(0.5), 1e-6);
    simulation.step();
    EXPECT_NEAR(simulation.body(ball)->position.z, 7 + 3 / 60.0, 1e-5);
    EXPECT_NEAR(simulation.body(ball)->spin.y, 180, 1e-3);
    ASSERT_TRUE(simulation.move(ball, {1, 1, 1}).ok());
    simulation.step();
    EXPECT_EQ(simulation.body(ball)->position, (Vec3{1, 1, 1}));
    EXPECT_EQ(simulation.body(ball)->velocity, Vec3{});
}

TEST(SimulationBodies, come_and_go_while_the_world_moves) {
    auto made = Simulation::create({}, {.backend = "cpu"});
    ASSERT_TRUE(made.ok());
    Simulation& simulation = *made;
    ColliderDesc desc = ball_of(1, {0, 2, 0});
    desc.body.reset();
    const ColliderId ball = *simulation.add(desc);
    simulation.step();
    EXPECT_FALSE(simulation.body(ball));
    ASSERT_TRUE(simulation.set_body(ball, BodyDesc{.mass = 1, .velocity = {1, 0, 0}}).ok());
    for (int i = 0; i < 30; ++i) simulation.step();
    const BodyMotion falling = *simulation.body(ball);
    EXPECT_NEAR(falling.position.x, 0.5, 1e-3);
    EXPECT_NEAR(falling.position.y, 2 - 0.5 * 9.81 * 0.25, 0.02);
    ASSERT_TRUE(simulation.set_body(ball, std::nullopt).ok());
    EXPECT_FALSE(simulation.body(ball));
    for (int i = 0; i < 30; ++i) simulation.step();
    ASSERT_TRUE(simulation.set_body(ball, BodyDesc{.mass = 1}).ok());
    EXPECT_EQ(simulation.body(ball)->position, falling.position);
}

TEST(SimulationBodies, need_sound_values_and_change_nothing_without) {
    Simulation simulation = make_weightless();
    const ColliderId ball = *simulation.add(ball_of(1));
    ColliderDesc still = ball_of(1, {3, 3, 3});
    still.name = "still", still.body.reset();
    const ColliderId no_body = *simulation.add(still);
    const ColliderId plane =
        *simulation.add(ColliderDesc{.name = "ground", .shape = PlaneDesc{}, .transform = {.position = {0, -5, 0}}});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(message(simulation.push(ball, {nan, 0, 0}, {})), HasSubstr("impulse"));
    EXPECT_THAT(message(simulation.push(ball, {1, 0, 0}, {nan, 0, 0})), HasSubstr("point"));
    EXPECT_THAT(message(simulation.push(no_body, {1, 0, 0}, {})), HasSubstr("is no body"));
    EXPECT_THAT(message(simulation.push({}, {1, 0, 0}, {})), HasSubstr("not in this simulation"));
    EXPECT_THAT(message(simulation.place_body(ball, {}, {}, {1e9f, 0, 0})), HasSubstr("velocity"));
    EXPECT_THAT(message(simulation.place_body(no_body, {})), HasSubstr("is no body"));
    EXPECT_THAT(message(simulation.set_body(ball, BodyDesc{.mass = -1})), HasSubstr("mass"));
    EXPECT_THAT(message(simulation.set_body(plane, BodyDesc{.mass = 1})), HasSubstr("plane"));
    EXPECT_THAT(message(simulation.set_body({}, BodyDesc{.mass = 1})), HasSubstr("not in this simulation"));
    EXPECT_FALSE(simulation.body(plane) || simulation.body(no_body) || simulation.body({}));
    simulation.step();
    EXPECT_EQ(simulation.body(ball)->position, Vec3{});
}

TEST(SimulationBodies, take_the_pins_of_their_colliders_along) {
    Simulation simulation = make_weightless();
    ColliderDesc desc = ball_of(1);
    desc.body.reset();
    const ColliderId ball = *simulation.add(desc);
    ClothDesc sheet{.name = "sheet", .mesh = GridDesc{.size = {0.5f, 0.5f}, .resolution = {9, 9}}};
    sheet.transform.position = {0.5f, 0, 0};
    sheet.pins = {{.select = VertexPins{.vertices = {0}}, .attach = "ball"}};
    const auto cloth = simulation.add(sheet);
    ASSERT_TRUE(cloth.ok());
    ASSERT_TRUE(simulation.set_body(ball, BodyDesc{.mass = 1, .velocity = {0, 1, 0}}).ok());
    const Vec3 before = simulation.surface(*cloth).positions[0];
    for (int i = 0; i < 30; ++i) simulation.step();
    const auto motion = simulation.body(ball);
    ASSERT_TRUE(motion);
    EXPECT_GT(motion->mass, 1) << "with the pinned particle";
    EXPECT_GT(motion->position.y, 0.2f);
    EXPECT_LT(motion->velocity.y, 1) << "the sheet is dragged along";
    EXPECT_GT(simulation.surface(*cloth).positions[0].y, before.y + 0.2f);
    ASSERT_TRUE(simulation.set_body(ball, std::nullopt).ok());
    const Vec3 held = simulation.surface(*cloth).positions[0];
    simulation.step();
    EXPECT_LT(length(simulation.surface(*cloth).positions[0] - held), 1e-5f);
}

}  // namespace
}  // namespace weft
