// Cloth that passes through cloth at the start, or because pins pressed it through, is taken apart.

#include "falling_cloth.h"

#include <cmath>
#include <functional>

namespace weft::physical {
namespace {

World empty_world(float gravity, CpuOptions options = {}) {
    World world = make_world({.gravity = {0, gravity, 0}, .solver = {.substeps = 20}}, options);
    add_ground(world);
    return world;
}

/// The number of tangled pairs falls from each half second to the next, and is 0 within two seconds and later.
void expect_to_come_apart(World& world) {
    std::uint64_t before = crossings(world);
    EXPECT_GT(before, 10u);
    before = ~std::uint64_t{0};
    for (int half = 0; half < 6; ++half) {
        for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
        const std::uint64_t tangled = world.frame().cloth_contacts.tangled;
        EXPECT_TRUE(tangled < before || tangled == 0) << tangled << " after " << half + 1 << " half seconds";
        EXPECT_EQ(tangled > 0, world.frame().tangled_at.has_value());
        before = tangled;
        if (half >= 3) {
            EXPECT_EQ(tangled, 0u);
            EXPECT_EQ(crossings(world), 0u);
        }
    }
    EXPECT_TRUE(all_finite(world));
}

/// Of a sheet's particles near another sheet, the part that lies in front of its nearest triangle.
double part_in_front(const ClothFrame& lower, const ClothFrame& higher) {
    double near = 0, front = 0;
    for (const Vec4& x : higher.positions) {
        float nearest = 0.06f;
        bool in_front = false;
        for (const Triangle t : lower.triangles) {
            const Vec3 a = lower.positions[t[0]].xyz(), b = lower.positions[t[1]].xyz(),
                       c = lower.positions[t[2]].xyz();
            const Vec3 to = x.xyz() - (a + b + c) / 3;
            if (length(to) >= nearest) continue;
            nearest = length(to);
            in_front = dot(cross(b - a, c - a), to) > 0;
        }
        if (nearest == 0.06f) continue;
        near += 1, front += in_front;
    }
    EXPECT_GT(near, 10);
    return front / near;
}

double fastest(const World& world) {
    double result = 0;
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const Vec4& v : cloth.velocities) result = std::max(result, double{std::hypot(v.x, v.y, v.z)});
    return result;
}

// Labels: slow no-asan long
TEST(Untangle, sheets_placed_through_each_other_come_apart) {
    for (const float gravity : {0.0f, -9.81f}) {
        for (const Vec3 rotation : {Vec3{90, 0, 0}, Vec3{10, 20, 5}, Vec3{60, 30, 5}}) {
            World world = empty_world(gravity);
            add_crossed_sheets(world, 18, rotation);
            expect_to_come_apart(world);
        }
    }
}

// Labels: slow no-asan
TEST(Untangle, sheets_that_cut_each_other_from_the_rim_to_the_middle_come_apart) {
    for (const float gravity : {0.0f, -9.81f}) {
        World world = empty_world(gravity);
        add_crossed_sheets(world, 18, {90, 0, 0}, {0.5f, 0, 0});
        expect_to_come_apart(world);
    }
}

// Labels: slow no-asan
TEST(Untangle, a_sheet_placed_half_through_itself_comes_apart) {
    for (const SheetDesc& sheet : {looped(20), folded_through_itself(20)}) {
        for (const float gravity : {0.0f, -9.81f}) {
            World world = empty_world(gravity);
            world.add(make_sheet(sheet));
            expect_to_come_apart(world);
        }
    }
}

// Labels: slow no-asan
TEST(Untangle, the_higher_layer_ends_in_front_of_the_lower_one) {
    for (const std::array<std::uint32_t, 2> layers : {std::array{0u, 1u}, std::array{3u, 2u}}) {
        for (const Vec3 offset : {Vec3{}, Vec3{0.3f, 0, 0}}) {
            World world = empty_world(0);
            // In the middle neither part is smaller; with the offset, the smaller one is on the same side for both.
            add_crossed_sheets(world, 14, {70, 20, 0}, offset, layers);
            EXPECT_GT(crossings(world), 10u);
            int frames = 0;
            for (; frames < 120 && crossings(world) > 0; ++frames) world.step(1.0 / 60);
            EXPECT_LT(frames, 120);
            const auto& cloths = world.frame().cloths;
            const bool second_is_higher = layers[0] < layers[1];
            EXPECT_GT(part_in_front(cloths[second_is_higher ? 0 : 1], cloths[second_is_higher ? 1 : 0]), 0.95);
            for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
            EXPECT_EQ(crossings(world), 0u);
            EXPECT_EQ(world.frame().cloth_contacts.tangled, 0u);
        }
    }
}

// Labels: slow no-asan
TEST(Untangle, it_adds_little_speed) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 20}}, CpuOptions{});
    add_crossed_sheets(world, 24, {90, 0, 0});
    double most = 0;
    for (int i = 0; i < 20; ++i) {
        world.step(1.0 / 60);
        most = std::max(most, fastest(world));
    }
    EXPECT_LT(most, 1);
}

TEST(Untangle, what_is_not_tangled_keeps_its_promise) {
    World world = empty_world(-9.81f);
    add_crossed_sheets(world, 14, {90, 0, 0});
    SheetDesc other = falling(14);
    other.position = {3, 0.75f, 0};
    world.add(make_sheet(other));
    for (int i = 0; i < 45; ++i) {
        world.step(1.0 / 60);
        const ClothFrame& cloth = world.frame().cloths[2];
        std::vector<Vec3> positions;
        std::vector<Triangle> triangles(cloth.triangles.begin(), cloth.triangles.end());
        for (const Vec4& x : cloth.positions) positions.push_back(x.xyz());
        EXPECT_EQ(count_crossings(positions, triangles).triangles, 0u);
    }
}

// Labels: slow no-asan long
TEST(Untangle, bits_do_not_depend_on_lists_threads_and_restored_states) {
    const auto start = [](const CpuOptions& options) {
        World world = empty_world(-9.81f, options);
        add_crossed_sheets(world, 14, {10, 20, 5});
        return world;
    };
    World world = start({});
    (void)hash_after(world, 10);
    ASSERT_GT(world.frame().cloth_contacts.tangled, 0u);
    const Snapshot saved = world.save();
    const std::string expected = hash_after(world, 20);
    World always = start({.search_always = true}), threads = start({.workers = 3}), scalar = start({.isa = "scalar"});
    for (World* other : {&always, &threads, &scalar}) EXPECT_EQ(hash_after(*other, 30), expected);
    ASSERT_TRUE(world.restore(saved).ok());
    EXPECT_EQ(hash_after(world, 20), expected);
}

// Labels: slow no-asan
TEST(Untangle, what_pins_press_through_comes_apart_when_they_let_go) {
    World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
    add_pressed_sheets(world, 0.5f);
    for (int i = 0; i < 10; ++i) world.step(1.0 / 60);
    ASSERT_GT(crossings(world), 0u);
    for (const ClothFrame& cloth : world.frame().cloths) ASSERT_TRUE(world.set_pins(cloth.id, {}, {}).ok());
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    EXPECT_EQ(crossings(world), 0u);
    EXPECT_EQ(world.frame().cloth_contacts.tangled, 0u);
}

}  // namespace
}  // namespace weft::physical
