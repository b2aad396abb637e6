// Boxes and other bodies that lie on one another.
#include "stacks.h"
#include "collide/convex_hull.h"

namespace weft::physical {
namespace {

// How far the bodies have gone aside and up or down.
struct Ways {
    float aside = 0, up = 0, speed = 0;  // m, m, m/s
};

Ways ways_after(World& world, const std::vector<ColliderId>& bodies, double seconds) {
    std::vector<Vec3> start;
    world.frame();
    for (const ColliderId body : bodies) start.push_back(world.body(body).state.place.xyz());
    run(world, seconds);
    Ways most;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3 way = world.body(bodies[i]).state.place.xyz() - start[i];
        most.aside = std::max(most.aside, std::hypot(way.x, way.z));
        most.up = std::max(most.up, std::abs(way.y));
        most.speed = std::max(most.speed, speed_of(world.body(bodies[i])));
    }
    return most;
}

// Corners lie on corners and edges on edges, where a distance has no normal.
TEST(Stacks, of_boxes_of_one_size_stand) {
    World world = make_world(WorldSettings{});
    const Ways ways = ways_after(world, add_tower(world, 5), 5);
    EXPECT_LT(ways.up, 2e-4);
    EXPECT_LT(ways.aside, 5e-3);
    EXPECT_LT(ways.speed, 1e-2);
}

// Labels: slow
TEST(Stacks, of_ten_boxes_stand) {
    World world = make_world(WorldSettings{});
    const Ways ways = ways_after(world, add_tower(world, 10, 0.004f, 37), 10);
    EXPECT_LT(ways.up, 2e-3);
    EXPECT_LT(ways.aside, 0.1);
}

TEST(Stacks, of_turned_boxes_stand) {
    World world = make_world(WorldSettings{});
    const Ways ways = ways_after(world, add_tower(world, 5, 0.004f, 37), 5);
    EXPECT_LT(ways.up, 2e-4);
    EXPECT_LT(ways.aside, 1e-2);
    EXPECT_LT(ways.speed, 1e-2);
}

TEST(Stacks, of_polyhedra_stand) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back({i & 1 ? 0.04f : -0.04f, i & 2 ? 0.04f : -0.04f, i & 4 ? 0.04f : -0.04f});
    const auto hull = convex_hull(corners);
    ASSERT_TRUE(hull.ok());
    const auto data = std::make_shared<ShapeData>(make_convex_data(*hull));
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    std::vector<ColliderId> bodies;
    for (int i = 0; i < 4; ++i) {
        // Rounded by 1 cm, so that they are as large as the boxes.
        Collider one = make_collider({.name = "stone", .shape = ConvexDesc{.radius = 0.01f}}, data);
        one.pose.position = {0, 0.05f + 0.1f * static_cast<float>(i), 0};
        one.body = make_box({0.05f, 0.05f, 0.05f}, 0.5f, {}).body;
        bodies.push_back(world.add(one));
    }
    const Ways ways = ways_after(world, bodies, 5);
    EXPECT_LT(ways.up, 2e-4);
    EXPECT_LT(ways.aside, 5e-3);
    EXPECT_LT(ways.speed, 1e-2);
}

TEST(Stacks, a_pyramid_stays_where_it_is) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    std::vector<ColliderId> bodies;
    for (int row = 0; row < 6; ++row)
        for (int i = 0; i < 6 - row; ++i)
            bodies.push_back(world.add(make_box({0.05f, 0.05f, 0.05f}, 0.5f,
                                                {0.105f * (static_cast<float>(i) + 0.5f * static_cast<float>(row)),
                                                 0.05f + 0.1f * static_cast<float>(row), 0})));
    const Ways ways = ways_after(world, bodies, 4);
    EXPECT_LT(ways.up, 2e-4);
    EXPECT_LT(ways.aside, 2e-3);
    EXPECT_LT(ways.speed, 5e-3);
}

// It touches the rim of the box in two places of its side, and ends of it are in the air.
TEST(Stacks, a_rod_lies_on_a_box) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    world.add(make_box({0.05f, 0.05f, 0.05f}, 0.5f, {0, 0.05f, 0}));
    const ColliderId id = world.add(make_rod({0.01f, 0.12f, 0}));
    const Ways ways = ways_after(world, {id}, 3);
    EXPECT_LT(ways.up, 1e-3);
    EXPECT_LT(std::abs(world.collider(id).pose.rotation.y.y), 0.01) << "it tips over";
    EXPECT_LT(ways.speed, 1e-2);
}

// The corner that comes over the joint is behind the side of the next tile by as much as it has moved.
TEST(Stacks, a_box_slides_over_a_joint_of_two_boxes) {
    World world = make_world(WorldSettings{});
    for (const float x : {-0.5f, 0.5f}) {
        Collider tile =
            make_collider({.name = "tile", .shape = BoxDesc{.half_extents = {0.5f, 0.1f, 0.5f}}, .friction = {0, 0}});
        tile.pose.position = {x, -0.1f, 0};
        world.add(tile);
    }
    const ColliderId box = world.add(make_box({0.05f, 0.05f, 0.05f}, 1, {-0.3f, 0.05f, 0}, {.velocity = {1, 0, 0}}));
    for (int frame = 0; frame < 36; ++frame) {
        world.step(1.0 / 60);
        EXPECT_LT(world.body(box).state.place.y, 0.0502);
        ASSERT_NEAR(world.body(box).state.velocity.x, 1, 1e-2) << frame;
    }
    EXPECT_NEAR(world.body(box).state.place.x, 0.3, 1e-2);
}

TEST(Overlaps, of_balls_go_and_leave_no_speed) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    std::vector<ColliderId> balls;
    for (int i = 0; i < 3; ++i)
        balls.push_back(world.add(make_ball(0.05f, 0.3f, {0.03f * static_cast<float>(i), 0.06f, 0})));
    run(world, 1);
    for (const ColliderId ball : balls) EXPECT_LT(speed_of(world.body(ball)), 2e-3);
    for (std::size_t i = 1; i < balls.size(); ++i) {
        const float apart = world.body(balls[i]).state.place.x - world.body(balls[i - 1]).state.place.x;
        EXPECT_NEAR(apart, 0.1, 1e-4);
    }
}

TEST(Overlaps, of_boxes_go_along_the_shortest_way) {
    World world = make_world(WorldSettings{});
    world.add(make_floor());
    const ColliderId low = world.add(make_box({0.05f, 0.05f, 0.05f}, 0.5f, {0, 0.05f, 0}));
    const ColliderId high = world.add(make_box({0.05f, 0.05f, 0.05f}, 0.5f, {0.03f, 0.09f, 0}));
    float fastest = 0;
    for (int frame = 0; frame < 120; ++frame) {
        world.step(1.0 / 60);
        for (const ColliderId box : {low, high}) fastest = std::max(fastest, speed_of(world.body(box)));
    }
    EXPECT_NEAR(world.body(low).state.place.y, 0.05, 2e-4);
    EXPECT_NEAR(world.body(high).state.place.y, 0.15, 2e-4);
    EXPECT_LT(fastest, 0.3);
    EXPECT_LT(speed_of(world.body(high)), 5e-3);
}

}  // namespace
}  // namespace weft::physical
