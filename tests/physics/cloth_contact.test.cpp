// Cloth that meets itself and other cloth: nothing passes through, and piles come to rest.

#include "falling_cloth.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace weft::physical {
namespace {

// Labels: slow no-asan
TEST(ClothContact, a_sheet_that_falls_by_a_corner_never_crosses_itself_and_comes_to_rest) {
    for (const Vec3 rotation : {Vec3{80, 20, 45}, Vec3{70, 10, -45}, Vec3{-80, -20, 135}}) {
        World world = falling_world(falling(28, rotation));
        const Outcome result = fall(world, 5);
        EXPECT_EQ(result.worst, 0u);
        EXPECT_LT(result.speed, 0.005);
        EXPECT_EQ(result.limited, 0u);
    }
}

// Labels: slow no-asan
TEST(ClothContact, a_sheet_never_crosses_itself_with_few_substeps) {
    for (const std::uint32_t substeps : {1u, 2u, 5u, 10u}) {
        World world = falling_world(falling(24), substeps);
        const Outcome result = fall(world, 3);
        EXPECT_EQ(result.worst, 0u) << substeps << " substeps";
        EXPECT_TRUE(all_finite(world));
    }
}

// Labels: slow no-asan
TEST(ClothContact, other_meshes_never_cross_themselves) {
    SheetDesc cross = falling(16);
    cross.diagonal = GridDiagonal::cross;
    SheetDesc uniform = falling(24);
    uniform.diagonal = GridDiagonal::uniform;
    SheetDesc oblong = falling(24);
    oblong.size = {1.4f, 0.5f}, oblong.resolution = {50, 12};
    for (const SheetDesc& sheet : {cross, uniform, oblong}) {
        World world = falling_world(sheet);
        EXPECT_EQ(fall(world, 3).worst, 0u);
    }
}

// Labels: slow no-asan
TEST(ClothContact, a_sheet_thrown_down_never_crosses_itself_and_does_not_rebound) {
    for (const std::uint32_t substeps : {10u, 20u}) {
        SheetDesc sheet = falling(28);
        sheet.velocity = {0, -15, 0};
        World world = falling_world(sheet, substeps);
        const Outcome impact = fall(world, 0.5);
        EXPECT_EQ(impact.worst, 0u);
        EXPECT_LT(impact.highest, 0.6) << "it was 1.5 m high";
        EXPECT_EQ(fall(world, 2).worst, 0u);
    }
}

// Kinetic and potential energy, of the particles that can move.
double energy_of(World& world) {
    double energy = 0;
    const Snapshot state = world.save();
    for (const ClothSnapshot& cloth : state.cloths) {
        for (std::size_t p = 0; p < cloth.position.size(); ++p) {
            const Vec4 x = cloth.position[p];
            const Vec3 v = cloth.velocity[p].xyz();
            if (x.w > 0) energy += (0.5 * dot(v, v) + 9.81 * x.y) / x.w;
        }
    }
    return energy;
}

// Labels: slow no-asan
TEST(ClothContact, a_sheet_thrown_down_gains_no_energy) {
    for (const std::uint32_t substeps : {10u, 20u}) {
        SheetDesc sheet = falling(32);
        sheet.velocity = {0, -15, 0};
        World world = falling_world(sheet, substeps);
        const double first = energy_of(world);
        double before = first;
        for (int frame = 0; frame < 90; ++frame) {
            world.step(1.0 / 60);
            const double now = energy_of(world);
            EXPECT_LT(now - before, 1e-4 * first) << "frame " << frame;
            before = now;
        }
        EXPECT_LT(before, 0.1 * first);
    }
}

// Labels: slow no-asan long
TEST(ClothContact, a_stack_keeps_its_order) {
    for (const float speed : {0.0f, -10.0f}) {
        World world = stack(speed, 10);
        EXPECT_EQ(fall(world, 2).worst, 0u);
        EXPECT_LT(mean_speed(world), 0.005);
        const auto& cloths = world.frame().cloths;
        for (std::size_t i = 1; i < cloths.size(); ++i) {
            for (std::size_t p = 0; p < cloths[i].positions.size(); ++p)
                EXPECT_GT(cloths[i].positions[p].y, cloths[i - 1].positions[p].y)
                    << "sheet " << i << ", particle " << p;
        }
    }
}

TEST(ClothContact, a_stack_in_flight_is_not_braked) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 20}}, CpuOptions{});
    for (int i = 0; i < 5; ++i) {
        SheetDesc sheet = falling(10, {0, 0, 0});
        sheet.position = {0, 0.0105f * static_cast<float>(i), 0};
        sheet.fabric.contact.thickness = 0.01f;
        sheet.velocity = {3, 10, -2};
        world.add(make_sheet(sheet));
    }
    run(world, 0.5);
    EXPECT_EQ(world.frame().cloth_contacts.limited, 0u);
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const Vec4& v : cloth.velocities) EXPECT_NEAR(v.y, 10, 1e-3);
}

TEST(ClothContact, a_collision_in_free_space_keeps_momentum) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 20}}, CpuOptions{});
    SheetDesc one = falling(14, {0, 0, 0}), two = falling(17, {7, 30, 4});
    one.position = {0, 0, 0}, one.velocity = {0, 2, 0};
    two.position = {0.1f, 0.12f, 0.05f}, two.velocity = {0.5f, -1, 0};
    two.fabric.body.density = 0.2f;
    world.add(make_sheet(one));
    world.add(make_sheet(two));
    const auto before = momentum(world);
    // Later, rounding of the positions of cloth that vibrates adds about 1e-3 of it per second.
    const Outcome result = fall(world, 0.15);
    const auto after = momentum(world);
    EXPECT_EQ(result.worst, 0u);
    EXPECT_LT(after[3], 0.9 * before[3]) << "they met";
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], 1e-4 * before[3]);
}

// Labels: slow no-asan
TEST(ClothContact, bits_do_not_depend_on_when_lists_are_made) {
    const auto drop = [](bool always) {
        World world = falling_world(falling(24), 10, {.search_always = always});
        const std::string hash = hash_after(world, 75);
        EXPECT_GT(world.frame().cloth_contacts.contacts, 0u);
        return hash;
    };
    EXPECT_EQ(drop(false), drop(true));
    const auto flat = [](bool always) {
        World world = stack(-3, 4, {.search_always = always});
        return hash_after(world, 40);
    };
    EXPECT_EQ(flat(false), flat(true));
}

// Labels: slow no-asan long
TEST(ClothContact, bits_do_not_depend_on_instruction_sets_and_threads) {
    const auto drop = [](std::string_view isa, unsigned workers) {
        World world = falling_world(falling(20), 10, {.workers = workers, .isa = std::string(isa)});
        return hash_after(world, 60);
    };
    const std::string expected = drop("scalar", 0);
    for (const std::string_view isa : cpu_instruction_sets())
        for (const unsigned workers : {0u, 3u}) EXPECT_EQ(drop(isa, workers), expected) << isa << ", " << workers;
}

TEST(ClothContact, a_restored_world_goes_on_with_the_same_bits) {
    World world = falling_world(falling(20), 10);
    (void)hash_after(world, 45);
    const Snapshot saved = world.save();
    const std::string expected = hash_after(world, 15);
    ASSERT_TRUE(world.restore(saved).ok());
    EXPECT_EQ(hash_after(world, 15), expected);
    World other = falling_world(falling(20), 10);
    ASSERT_TRUE(other.restore(saved).ok());
    EXPECT_EQ(hash_after(other, 15), expected);
}

TEST(ClothContact, cloths_without_contact_keep_their_bits) {
    const auto hang = [](SelfCollision self_collision) {
        SheetDesc sheet = hung_by_corners(12, {});
        sheet.self_collision = self_collision;
        World world = make_world({.solver = {.substeps = 10}}, sheet, {});
        return hash_after(world, 5);
    };
    (void)hang(SelfCollision::exact);  // runs, with more rounds, so its bits differ
    EXPECT_EQ(hang(SelfCollision::off), hang(SelfCollision::off));
}

TEST(ClothContact, cloth_slides_on_tilted_cloth_if_the_slope_exceeds_the_friction) {
    const auto slides = [](float degrees) {
        World world = make_world({.solver = {.substeps = 20}}, CpuOptions{});
        SheetDesc under = falling(10, {0, 0, degrees}), over = falling(6, {0, 0, degrees});
        const float angle = degrees * std::numbers::pi_v<float> / 180;
        under.pinned = [](Vec3) { return true; };
        under.position = {};
        over.size = {0.3f, 0.3f};
        for (SheetDesc* sheet : {&under, &over}) {
            sheet->fabric.contact.thickness = 0.01f;
            sheet->fabric.contact.friction[0] = sheet->fabric.contact.friction[1] = 0.4f;
        }
        over.position = {-0.0101f * std::sin(angle), 0.0101f * std::cos(angle), 0.01f};
        world.add(make_sheet(under));
        world.add(make_sheet(over));
        run(world, 0.3);
        const Vec3 before = center_of_mass(world.frame().cloths[1]);
        run(world, 1);
        const Vec3 moved = center_of_mass(world.frame().cloths[1]) - before;
        return std::hypot(moved.x, moved.y, moved.z) > 0.01f;
    };
    const float limit = std::atan(0.4f) * 180 / std::numbers::pi_v<float>;
    EXPECT_FALSE(slides(limit - 1));
    EXPECT_TRUE(slides(limit + 1));
}

TEST(ClothContact, crossings_do_not_appear_far_from_the_origin) {
    SheetDesc sheet = falling(16);
    sheet.position = {60, 0.75f, -40};
    World world = falling_world(sheet, 10);
    EXPECT_EQ(fall(world, 2).worst, 0u);
}

// Labels: slow no-asan
TEST(ClothContact, any_thickness_is_survived) {
    for (const float thickness : {0.0f, 1e-5f, 3e-4f, 0.1f, 1.0f}) {  // edges are 59 mm long
        SheetDesc sheet = falling(18);
        sheet.fabric.contact.thickness = thickness;
        World world = falling_world(sheet, 10);
        const Outcome result = fall(world, 2);
        EXPECT_TRUE(all_finite(world)) << thickness;
        EXPECT_EQ(result.worst, 0u) << thickness;
    }
}

// Before normals of thin cloth were made perpendicular to their edges, two of these falls crossed.
TEST(ClothContact, thin_cloth_of_long_edges_does_not_cross) {
    for (const int start : {0, 3, 4, 10, 11, 13}) {
        SheetDesc sheet = falling(18);
        sheet.fabric.contact.thickness = 1e-4f;
        sheet.position = sheet.position + Vec3{0.001f, 0.003f, 0} * static_cast<float>(start);
        World world = falling_world(sheet, 10);
        EXPECT_EQ(fall(world, 2).worst, 0u) << start;
    }
}

TEST(ClothContact, cloths_at_one_place_stay_finite) {
    for (const float apart : {0.0f, 1e-7f}) {
        World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
        for (int i = 0; i < 2; ++i) {
            SheetDesc sheet = falling(10, {0, 0, 0});
            sheet.position.y = 0.1f + apart * static_cast<float>(i);
            world.add(make_sheet(sheet));
        }
        add_ground(world);
        run(world, 1);
        EXPECT_TRUE(all_finite(world));
        EXPECT_EQ(world.frame().reports, report_none);
    }
}

TEST(ClothContact, pinned_cloth_and_cloth_without_gravity_do_not_move) {
    SheetDesc sheet = falling(8, {0, 0, 0});
    sheet.pinned = [](Vec3) { return true; };
    World world = make_world({.solver = {.substeps = 5}}, sheet, {});
    run(world, 0.2);
    EXPECT_EQ(mean_speed(world), 0);
    EXPECT_EQ(world.frame().cloth_contacts.limited, 0u);
}

TEST(ClothContact, pins_that_press_cloth_together_are_counted) {
    World world = make_world({.solver = {.substeps = 5}}, CpuOptions{});
    const auto model = add_pressed_sheets(world, 0.5f);
    std::uint64_t tangled = 0;
    for (int i = 0; i < 60; ++i) {
        world.step(1.0 / 60);
        tangled = std::max(tangled, world.frame().cloth_contacts.tangled);
        EXPECT_EQ(world.frame().tangled_at.has_value(), world.frame().cloth_contacts.tangled > 0);
        if (!world.frame().tangled_at) continue;
        EXPECT_LT(world.frame().tangled_at->cloth, 2u);
        EXPECT_LT(world.frame().tangled_at->particle, model->particle_count);
    }
    EXPECT_GT(tangled, 0u);
    EXPECT_TRUE(all_finite(world));
    EXPECT_NEAR(world.frame().cloths[1].positions[0].y, model->start[0].y - 0.3f, 1e-5) << "pins win";
}

}  // namespace
}  // namespace weft::physical
