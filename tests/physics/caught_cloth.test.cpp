// Cloth that cannot get out of the way: between two colliders, and between a collider and a pin.

#include "falling_cloth.h"

#include "solver/measures/penetration.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::physical {
namespace {

// Closed from 0.25 s to 0.75 s, open from 1 s on.
std::vector<PoseKey> closing(Vec3 open, Vec3 closed) {
    return {{0, open, {}}, {0.25f, closed, {}}, {0.75f, closed, {}}, {1, open, {}}};
}

struct Caught {
    double deepest = 0;  ///< m, while it is caught
    double left = 0;     ///< m, deepest of the last half second
    double fastest = 0;  ///< m/s, of any particle after it came free
    double end = 0;      ///< m/s, mean at the end
};

Caught run_caught(World& world) {
    Caught result;
    PenetrationSearch search;
    for (int i = 0; i < 150; ++i) {
        world.step(1.0 / 60);
        EXPECT_EQ(world.frame().reports & report_non_finite, 0u) << "frame " << i;
        const Penetration found = search.measure(world.frame(), world.colliders());
        if (i < 50) result.deepest = std::max(result.deepest, found.max);
        if (i >= 120) result.left = std::max(result.left, found.max);
        if (i >= 66) result.fastest = std::max(result.fastest, max_speed(world.frame()));
    }
    EXPECT_TRUE(all_finite(world));
    result.end = mean_speed(world);
    return result;
}

// It is reported as penetration while it is caught, and free and slow afterwards.
void expect_caught_and_freed(World& world, double overlap) {
    const Caught found = run_caught(world);
    EXPECT_GT(found.deepest, 0.5 * overlap);
    EXPECT_LT(found.deepest, overlap + 0.02);
    EXPECT_EQ(found.left, 0);
    EXPECT_LT(found.fastest, 6);
    EXPECT_LT(found.end, 0.5);
}

SheetDesc small_sheet() {
    return {.size = {0.5f, 0.5f},
            .resolution = {21, 21},
            .position = {0, 0.002f, 0},
            .fabric = find_fabric("cotton")->fabric,
            .layout = {.lines = true, .hierarchy = true}};
}

void press_by_ball_on_plane(float overlap) {
    World world = make_world({.solver = {.substeps = 20}}, small_sheet());
    world.add(make_collider({.shape = PlaneDesc{}}));
    world.add(make_collider({.shape = SphereDesc{0.1f}, .motion = closing({0, 0.25f, 0}, {0, 0.1f - overlap, 0})}));
    expect_caught_and_freed(world, double{overlap});
}

TEST(CaughtCloth, between_a_ball_and_a_plane_comes_free) {
    press_by_ball_on_plane(0.005f);
}

TEST(CaughtCloth, deep_between_a_ball_and_a_plane_comes_free) {
    press_by_ball_on_plane(0.05f);
}

TEST(CaughtCloth, between_two_boxes_comes_free) {
    for (const auto& [overlap, kind] : {std::pair(0.005f, SelfCollision::off), {0.05f, SelfCollision::exact}}) {
        SheetDesc sheet = small_sheet();
        sheet.self_collision = kind;
        World world = make_world({.solver = {.substeps = 20}}, sheet);
        world.add(make_collider({.shape = BoxDesc{{0.2f, 0.1f, 0.2f}}, .transform = {.position = {0, -0.1f, 0}}}));
        world.add(make_collider(
            {.shape = BoxDesc{{0.1f, 0.1f, 0.1f}}, .motion = closing({0, 0.25f, 0}, {0, 0.1f - overlap, 0})}));
        expect_caught_and_freed(world, double{overlap});
    }
}

TEST(CaughtCloth, between_two_balls_comes_free) {
    for (const float overlap : {0.005f, 0.05f}) {
        SheetDesc sheet = small_sheet();
        sheet.rotation_degrees = {90, 0, 0};
        sheet.pinned = [](Vec3 p) { return p.z < -0.249f; };
        World world = make_world({.solver = {.substeps = 20}}, sheet);
        for (const float side : {-1.0f, 1.0f})
            world.add(make_collider({.shape = SphereDesc{0.1f},
                                     .motion = closing({0, 0, 0.25f * side}, {0, 0, (0.1f - 0.5f * overlap) * side})}));
        expect_caught_and_freed(world, double{overlap});
    }
}

// A pin takes the middle of a sheet into a ball, and out again.
TEST(CaughtCloth, between_a_pin_and_a_ball_comes_free) {
    for (const float overlap : {0.005f, 0.05f}) {
        SheetDesc sheet = small_sheet();
        sheet.pinned = [](Vec3 p) { return length(p) < 1e-3f; };
        const auto model = make_sheet(sheet);
        World world = make_world({.solver = {.substeps = 20}});
        world.add(make_collider({.shape = SphereDesc{0.1f}, .transform = {.position = {0, -0.1f, 0}}}));
        const Vec3 in{0, -overlap - 0.002f, 0};
        KinematicTargets targets{.motions = {{.offsets = {{0, {}}, {0.25f, in}, {0.75f, in}, {1, {0, 0.1f, 0}}}}},
                                 .particles = {}};
        for (const std::uint32_t p : pinned_particles(*model))
            targets.particles.push_back({p, 0, model->rest_position(p)});
        world.add(model, targets);
        expect_caught_and_freed(world, double{overlap});
    }
}

// A box comes down on a pinned particle, and goes away.
TEST(CaughtCloth, between_a_box_and_a_pin_comes_free) {
    for (const float overlap : {0.005f, 0.05f}) {
        SheetDesc sheet = small_sheet();
        sheet.position = {};
        sheet.pinned = [](Vec3 p) { return length(p) < 1e-3f || std::max(std::abs(p.x), std::abs(p.z)) > 0.249f; };
        World world = make_world({.solver = {.substeps = 20}}, sheet);
        world.add(make_collider(
            {.shape = BoxDesc{{0.1f, 0.1f, 0.1f}}, .motion = closing({0, 0.25f, 0}, {0, 0.1f - overlap, 0})}));
        expect_caught_and_freed(world, double{overlap});
    }
}

}  // namespace
}  // namespace weft::physical
