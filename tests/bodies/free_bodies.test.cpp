// Bodies without cloth.
#include "body_worlds.h"

namespace weft::physical {
namespace {

TEST(FreeBody, falls_like_a_stone) {
    World world = make_world(WorldSettings{});
    const ColliderId ball = world.add(make_ball(0.1f, 2, {0, 10, 0}, {.velocity = {3, 0, 0}}));
    run(world, 1);
    const BodyState& state = world.body(ball).state;
    EXPECT_NEAR(state.velocity.y, -9.81, 1e-4);
    EXPECT_NEAR(state.place.x, 3, 1e-4);
    // Symplectic Euler falls half a substep farther.
    EXPECT_NEAR(state.place.y, 10 - 0.5 * 9.81 * (1 + 1.0 / 1200), 2e-2);
    EXPECT_EQ(world.collider(ball).pose.position.y, state.place.y);
}

TEST(FreeBody, keeps_its_angular_momentum_and_its_energy) {
    World world = make_world({.gravity = {}});
    // About the axis of the middle moment, where rotation is unstable.
    const ColliderId box = world.add(make_box({0.1f, 0.2f, 0.3f}, 3, {}, {.velocity = {1, 2, 3}, .spin = {2, 500, 1}}));
    world.frame();
    const Momentum start = momentum_of(world);
    double turned_over = 1;
    for (int frame = 0; frame < 600; ++frame) {
        world.step(1.0 / 60);
        const Momentum now = momentum_of(world);
        EXPECT_LT(distance_between(now.linear, start.linear), 1e-5 * size_of(start.linear));
        EXPECT_NEAR(now.energy, start.energy, 1e-3 * start.energy);
        turned_over = std::min(turned_over, double{world.collider(box).pose.rotation.y.y});
        const Vec4 spin = world.body(box).state.spin;
        EXPECT_EQ(spin.x, world.body(box).state.spin.x);
    }
    EXPECT_LT(turned_over, -0.9) << "a body that turns about its middle axis turns over";
}

TEST(FreeBody, survives_any_spin) {
    World world = make_world({.gravity = {}});
    const ColliderId box = world.add(make_box({0.1f, 0.2f, 0.3f}, 3, {}, {.spin = {360000, 1e5f, 0}}));
    world.frame();
    const Momentum start = momentum_of(world);
    run(world, 5);
    const Momentum now = momentum_of(world);
    EXPECT_LT(distance_between(now.angular, start.angular), 1e-5 * size_of(start.angular));
    EXPECT_TRUE(is_finite(world.body(box).state));
}

TEST(FreeBody, slows_down_by_its_damping) {
    World world = make_world({.gravity = {}});
    const ColliderId ball =
        world.add(make_ball(0.1f, 2, {}, {.velocity = {4, 0, 0}, .spin = {0, 90, 0}, .damping = 1, .spin_damping = 2}));
    run(world, 1);
    EXPECT_NEAR(world.body(ball).state.velocity.x, 4 * std::exp(-1), 2e-3);
    const Body& body = world.body(ball);
    EXPECT_NEAR(rate_of(body.state, body.mass).y, std::numbers::pi / 2 * std::exp(-2), 1e-3);
}

TEST(FreeBody, is_pushed_by_an_impulse_at_a_point) {
    World world = make_world({.gravity = {}});
    const ColliderId ball = world.add(make_ball(0.1f, 2, {1, 0, 0}));
    world.push_body(ball, {0, 4, 0}, {1.1f, 0, 0});
    const Body& body = world.body(ball);
    EXPECT_NEAR(body.state.velocity.y, 2, 1e-6);
    EXPECT_NEAR(body.state.spin.z, 0.4, 1e-6);
}

TEST(BodyContact, a_ball_comes_to_rest_on_the_floor) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    const ColliderId ball = world.add(make_ball(0.1f, 2, {0, 0.5f, 0}));
    run(world, 2);
    EXPECT_NEAR(world.body(ball).state.place.y, 0.1, 1e-4);
    EXPECT_LT(speed_of(world.body(ball)), 1e-3);
}

TEST(BodyContact, a_ball_bounces_to_the_square_of_its_restitution) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    const ColliderId ball = world.add(make_ball(0.1f, 2, {0, 1.1f, 0}, {.restitution = 0.8f}));
    float highest = 0;
    for (int frame = 0; frame < 70; ++frame) {
        world.step(1.0 / 60);
        if (world.body(ball).state.velocity.y > 0) highest = std::max(highest, world.body(ball).state.place.y);
    }
    EXPECT_NEAR(highest, 0.1 + 0.64, 0.02);
}

TEST(BodyContact, a_ball_that_slides_begins_to_roll) {
    World world = make_world(WorldSettings{});
    world.add(make_floor(0.3f));
    const ColliderId ball = world.add(make_ball(0.1f, 2, {0, 0.1f, 0}, {.velocity = {1, 0, 0}}));
    run(world, 2);
    const Body& body = world.body(ball);
    // 5/7 of the speed: what sliding friction does not change is the angular momentum about the floor.
    EXPECT_NEAR(body.state.velocity.x, 5.0 / 7, 0.01);
    EXPECT_NEAR(rate_of(body.state, body.mass).z, -5.0 / 7 / 0.1, 0.1);
}

TEST(BodyContact, a_box_stays_on_a_slope_if_friction_holds_it) {
    for (const float degrees : {19.0f, 24.0f}) {
        World world = make_world(WorldSettings{});
        Collider slope = make_floor(0.4f);  // the angle of friction is 21.8°
        slope.pose.rotation = rotation_from_degrees({0, 0, -degrees});
        world.add(slope);
        Collider box = make_box({0.1f, 0.05f, 0.1f}, 1, slope.pose.rotation * Vec3{0, 0.05f, 0});
        box.pose.rotation = slope.pose.rotation;
        const ColliderId id = world.add(box);
        run(world, 0.5);
        const Vec3 start = world.body(id).state.place.xyz();
        run(world, 1);
        const float way = length(world.body(id).state.place.xyz() - start);
        if (degrees < 21)
            EXPECT_LT(way, 1e-3) << degrees;
        else
            EXPECT_GT(way, 0.1) << degrees;
    }
}

TEST(BodyContact, boxes_stand_on_one_another) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    std::vector<ColliderId> boxes;
    for (int i = 0; i < 4; ++i)
        boxes.push_back(world.add(
            make_box({0.1f, 0.1f, 0.1f}, 1, {0.01f * static_cast<float>(i), 0.1f + 0.2f * static_cast<float>(i), 0})));
    run(world, 5);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_NEAR(world.body(boxes[i]).state.place.y, 0.1 + 0.2 * static_cast<double>(i), 2e-3);
        EXPECT_LT(speed_of(world.body(boxes[i])), 3e-2);
    }
}

TEST(BodyContact, crossed_rods_do_not_pass) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    const ColliderId low = world.add(make_box({0.3f, 0.05f, 0.05f}, 1, {0, 0.05f, 0}));
    Collider upper = make_box({0.3f, 0.02f, 0.02f}, 1, {0.03f, 0.3f, 0.01f});
    upper.pose.rotation = rotation_from_degrees({45, 80, 0});  // on its edge
    const ColliderId high = world.add(upper);
    run(world, 0.25);
    EXPECT_GT(world.body(high).state.place.y, 0.1);
    run(world, 3);
    EXPECT_GT(world.body(high).state.place.y, 0.1);
    EXPECT_NEAR(world.body(low).state.place.y, 0.05, 2e-3);
}

TEST(BodyContact, a_fast_ball_does_not_pass_a_thin_wall) {
    World world = make_world(WorldSettings{});
    world.add(make_collider({.name = "wall", .shape = BoxDesc{.half_extents = {0.001f, 1, 1}}}));
    const ColliderId ball = world.add(make_ball(0.02f, 1, {-1, 0.5f, 0}, {.velocity = {100, 0, 0}}));
    run(world, 0.2);
    EXPECT_LT(world.body(ball).state.place.x, 0);
}

// What flies hits a ball at rest: the ball gets what the other loses, whichever comes first.
TEST(BodyContact, a_ball_meets_each_shape_in_either_order) {
    const auto capsule = [](const BodyDesc& desc) {
        Collider made = make_ball(0.1f, 1, {-0.5f, 0.02f, 0}, desc);
        const Collider shape = make_collider({.name = "capsule", .shape = CapsuleDesc{0.1f, 0.1f}});
        made.shape = shape.shape, made.numbers = shape.numbers;
        made.bounds = shape.bounds, made.roundness = shape.roundness;
        made.features = features_of(CapsuleDesc{0.1f, 0.1f}, nullptr);
        return made;
    };
    const BodyDesc flies{.velocity = {1, 0, 0}, .spin = {0, 0, 90}, .restitution = 1};
    const Collider others[] = {make_ball(0.1f, 1, {-0.5f, 0, 0}, flies),
                               make_box({0.1f, 0.1f, 0.1f}, 1, {-0.5f, 0.02f, 0}, flies), capsule(flies)};
    for (const Collider& other : others) {
        for (const bool ball_first : {false, true}) {
            World world = make_world({.gravity = {}});
            const Collider ball = make_ball(0.1f, 1, {});
            const ColliderId first = world.add(ball_first ? ball : other),
                             second = world.add(ball_first ? other : ball);
            world.frame();
            const Momentum start = momentum_of(world);
            run(world, 1);
            const Momentum now = momentum_of(world);
            EXPECT_GT(world.body(ball_first ? first : second).state.velocity.x, 0.5) << other.name << ball_first;
            EXPECT_LT(world.body(ball_first ? second : first).state.velocity.x, 0.5) << other.name << ball_first;
            EXPECT_LT(distance_between(now.linear, start.linear), 1e-4) << other.name << ball_first;
            EXPECT_LE(now.energy, start.energy * 1.0001) << other.name << ball_first;
        }
    }
}

TEST(BodyContact, keeps_momentum) {
    World world = make_world({.gravity = {}});
    const ColliderId a = world.add(make_ball(0.1f, 2, {0, 0, 0}, {.velocity = {1, 0, 0}, .spin = {0, 0, 300}}));
    world.add(make_ball(0.15f, 0.5f, {0.5f, 0.1f, 0.05f}, {.restitution = 1}));
    world.frame();
    const Momentum start = momentum_of(world);
    run(world, 2);
    const Momentum now = momentum_of(world);
    EXPECT_LT(world.body(a).state.velocity.x, 0.9);
    EXPECT_LT(distance_between(now.linear, start.linear), 1e-4 * size_of(start.linear));
    EXPECT_LT(distance_between(now.angular, start.angular), 1e-4 * size_of(start.linear));
    EXPECT_LE(now.energy, start.energy * 1.0001);
}

}  // namespace
}  // namespace weft::physical
