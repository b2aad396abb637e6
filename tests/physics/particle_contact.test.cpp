// Cloth whose particles keep a distance from each other like spheres.

#include "falling_cloth.h"

#include "solver/plan/particle_contact_numbers.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace weft::physical {
namespace {

SheetDesc fast_sheet(std::uint32_t side, Vec3 rotation = {80, 20, 45}) {
    SheetDesc sheet = falling(side, rotation);
    sheet.self_collision = SelfCollision::fast;
    sheet.fabric.contact.thickness = 0.001f;
    return sheet;
}

void add_fast_stack(World& world, float speed, std::uint32_t sheets) {
    for (std::uint32_t i = 0; i < sheets; ++i) {
        SheetDesc sheet = fast_sheet(8, {0, 0, 0});
        sheet.position = {0, 0.5f + 0.25f * static_cast<float>(i), 0};
        sheet.velocity = {0, speed, 0};
        world.add(make_sheet(sheet));
    }
    add_ground(world);
}

/// Least distance between particles of two cloths.
float least_distance(const ClothFrame& one, const ClothFrame& two) {
    float least = std::numeric_limits<float>::infinity();
    for (const Vec4& x : one.positions)
        for (const Vec4& y : two.positions) least = std::min(least, length(x.xyz() - y.xyz()));
    return least;
}

/// Sum over frames.
std::uint64_t contacts_within(World& world, int frames) {
    std::uint64_t contacts = 0;
    for (int i = 0; i < frames; ++i) {
        world.step(1.0 / 60);
        contacts += world.frame().cloth_contacts.contacts;
    }
    return contacts;
}

// Labels: slow no-asan
TEST(ParticleContact, a_sheet_that_falls_by_a_corner_leaves_no_crossings_and_comes_to_rest) {
    for (const Vec3 rotation : {Vec3{80, 20, 45}, Vec3{70, 10, -45}, Vec3{-80, -20, 135}}) {
        World world = falling_world(fast_sheet(40, rotation), 10);
        EXPECT_LT(fall(world, 5).worst, 30u) << "for a moment, while it falls";
        const Outcome result = fall(world, 1);
        EXPECT_EQ(result.worst, 0u);
        EXPECT_LT(result.speed, 0.005);
        EXPECT_TRUE(all_finite(world));
    }
}

// With the first sweep alone, 107 pairs of triangles cross for a moment.
// Labels: slow no-asan
TEST(ParticleContact, a_fine_sheet_hardly_crosses_itself_while_it_falls) {
    World world = falling_world(fast_sheet(96, {-80, -20, 135}), 10);
    EXPECT_LT(fall(world, 0.75).worst, 20u);
}

// Labels: slow no-asan
TEST(ParticleContact, other_meshes_and_substeps_leave_no_crossings) {
    SheetDesc cross = fast_sheet(20), uniform = fast_sheet(28), oblong = fast_sheet(28);
    cross.diagonal = GridDiagonal::cross;
    uniform.diagonal = GridDiagonal::uniform;
    oblong.size = {1.4f, 0.5f}, oblong.resolution = {50, 18};
    for (const std::uint32_t substeps : {5u, 20u}) {
        for (const SheetDesc& sheet : {cross, uniform, oblong}) {
            World world = falling_world(sheet, substeps);
            (void)fall(world, 3);
            EXPECT_EQ(fall(world, 0.5).worst, 0u) << substeps << " substeps";
        }
    }
}

// Labels: slow no-asan
TEST(ParticleContact, a_sheet_without_contact_crosses_itself) {
    SheetDesc sheet = fast_sheet(40);
    sheet.self_collision = SelfCollision::off;
    World world = falling_world(sheet, 10);
    EXPECT_GT(fall(world, 1.5).worst, 100u) << "so the tests above can fail";
}

// Labels: slow no-asan
TEST(ParticleContact, a_sheet_thrown_down_does_not_rebound) {
    SheetDesc sheet = fast_sheet(28);
    sheet.velocity = {0, -15, 0};
    World world = falling_world(sheet, 10);
    EXPECT_LT(fall(world, 0.5).highest, 0.6) << "it was 1.5 m high";
}

TEST(ParticleContact, layers_of_two_cloths_keep_their_diameter) {
    World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
    add_fast_stack(world, 0, 2);
    run(world, 2);
    const auto& cloths = world.frame().cloths;
    const float diameter = particle_diameter(*cloths[0].model);
    EXPECT_NEAR(diameter, 1.4f * cloths[0].model->mean_edge, 1e-6f);
    EXPECT_GT(least_distance(cloths[0], cloths[1]), 0.97f * diameter);
    EXPECT_LT(mean_speed(world), 0.005);
    EXPECT_GT(world.frame().cloth_contacts.contacts, 0u);
}

TEST(ParticleContact, thickness_wins_where_it_is_larger) {
    World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
    for (int i = 0; i < 2; ++i) {
        SheetDesc sheet = fast_sheet(10, {0, 0, 0});
        sheet.fabric.contact.thickness = 0.25f;
        sheet.position = {0, 0.13f + 0.35f * static_cast<float>(i), 0};
        world.add(make_sheet(sheet));
    }
    add_ground(world);
    run(world, 2);
    const auto& cloths = world.frame().cloths;
    EXPECT_NEAR(center_of_mass(cloths[1]).y - center_of_mass(cloths[0]).y, 0.25f, 0.02f);
}

TEST(ParticleContact, a_flat_sheet_pushes_nothing) {
    SheetDesc sheet = fast_sheet(20, {0, 0, 0});
    sheet.position = {0, 0.01f, 0};
    World world = falling_world(sheet, 10);
    run(world, 1);
    EXPECT_EQ(world.frame().cloth_contacts.contacts, 0u);
}

TEST(ParticleContact, cloths_in_flight_are_not_braked) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 20}}, CpuOptions{});
    for (int i = 0; i < 4; ++i) {
        SheetDesc sheet = fast_sheet(10, {0, 0, 0});
        sheet.position = {0, 0.18f * static_cast<float>(i), 0};
        sheet.velocity = {3, 10, -2};
        world.add(make_sheet(sheet));
    }
    run(world, 0.5);
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const Vec4& v : cloth.velocities) EXPECT_NEAR(v.y, 10, 1e-3);
}

TEST(ParticleContact, a_collision_in_free_space_keeps_momentum) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 20}}, CpuOptions{});
    SheetDesc one = fast_sheet(14, {0, 0, 0}), two = fast_sheet(17, {7, 30, 4});
    one.position = {}, one.velocity = {0, 2, 0};
    two.position = {0.1f, 0.2f, 0.05f}, two.velocity = {0.5f, -1, 0};
    two.fabric.body.density = 0.2f;
    world.add(make_sheet(one));
    world.add(make_sheet(two));
    const auto before = momentum(world);
    (void)fall(world, 0.15);
    const auto after = momentum(world);
    EXPECT_LT(after[3], 0.9 * before[3]) << "they met";
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], 1e-4 * before[3]);
}

TEST(ParticleContact, cloth_slides_on_tilted_cloth_if_the_slope_exceeds_the_friction) {
    const auto slides = [](float degrees, float friction) {
        World world = make_world({.solver = {.substeps = 20}}, CpuOptions{});
        SheetDesc under = fast_sheet(22, {0, 0, degrees}), over = fast_sheet(7, {0, 0, degrees});
        const float angle = degrees * std::numbers::pi_v<float> / 180;
        under.pinned = [](Vec3) { return true; };
        over.size = {0.3f, 0.3f};
        for (SheetDesc* sheet : {&under, &over})
            sheet->fabric.contact.friction[0] = sheet->fabric.contact.friction[1] = friction;
        over.position = {-0.06f * std::sin(angle), 0.06f * std::cos(angle), 0.01f};
        under.position = {};
        world.add(make_sheet(under));
        world.add(make_sheet(over));
        run(world, 0.4);
        const Vec3 start = center_of_mass(world.frame().cloths[1]);
        run(world, 0.5);
        return length(center_of_mass(world.frame().cloths[1]) - start) > 0.02f;
    };
    EXPECT_FALSE(slides(15, 0.6f));
    EXPECT_TRUE(slides(40, 0.1f)) << "rougher than its friction, because particles lie in hollows";
}

// Labels: slow no-asan
TEST(ParticleContact, bits_do_not_depend_on_when_lists_are_made) {
    const auto drop = [](bool always) {
        World world = falling_world(fast_sheet(24), 10, {.search_always = always});
        EXPECT_GT(contacts_within(world, 35), 0u);
        return hash_after(world, 40);
    };
    EXPECT_EQ(drop(false), drop(true));
    std::uint64_t searches[2] = {};
    const auto flat = [&](bool always) {
        World world = make_world({.solver = {.substeps = 10}}, CpuOptions{.search_always = always});
        add_fast_stack(world, -3, 3);
        for (int i = 0; i < 60; ++i) {
            world.step(1.0 / 60);
            searches[always] += world.frame().cloth_contacts.searches;
        }
        return world.state_hash();
    };
    EXPECT_EQ(flat(false), flat(true));
    EXPECT_EQ(searches[1], 600u);
    EXPECT_LT(searches[0], 500u);
}

// Labels: slow no-asan
TEST(ParticleContact, bits_do_not_depend_on_instruction_sets_and_threads) {
    const auto drop = [](std::string_view isa, unsigned workers) {
        World world =
            falling_world(fast_sheet(20), 10, {.workers = workers, .isa = std::string(isa), .smallest_shared = 0});
        return hash_after(world, 60);
    };
    const std::string expected = drop("scalar", 0);
    for (const std::string_view isa : cpu_instruction_sets())
        for (const unsigned workers : {0u, 3u}) EXPECT_EQ(drop(isa, workers), expected) << isa << ", " << workers;
}

// Labels: slow no-asan
TEST(ParticleContact, a_restored_world_goes_on_with_the_same_bits) {
    World world = falling_world(fast_sheet(20), 10);
    (void)hash_after(world, 45);
    const Snapshot saved = world.save();
    const std::string expected = hash_after(world, 15);
    ASSERT_TRUE(world.restore(saved).ok());
    EXPECT_EQ(hash_after(world, 15), expected);
    World other = falling_world(fast_sheet(20), 10);
    ASSERT_TRUE(other.restore(saved).ok());
    EXPECT_EQ(hash_after(other, 15), expected);
}

TEST(ParticleContact, a_fast_and_an_exact_cloth_meet_and_both_move) {
    World world = make_world({.gravity = {}, .solver = {.substeps = 10}}, CpuOptions{});
    SheetDesc exact = falling(10, {0, 0, 0}), fast = fast_sheet(12, {0, 10, 0});
    exact.position = {}, fast.position = {0, 0.3f, 0};
    fast.velocity = {0, -2, 0};
    world.add(make_sheet(exact));
    world.add(make_sheet(fast));
    const auto before = momentum(world);
    EXPECT_EQ(fall(world, 0.4).worst, 0u);
    const auto after = momentum(world);
    const auto& cloths = world.frame().cloths;
    const float apart = 0.5f * (particle_diameter(*cloths[0].model) + particle_diameter(*cloths[1].model));
    EXPECT_GT(least_distance(cloths[0], cloths[1]), 0.9f * apart);
    EXPECT_LT(center_of_mass(cloths[0]).y, -0.05f) << "pushed ahead";
    EXPECT_NEAR(after[1], before[1], 1e-3 * before[3]);
}

// Labels: slow no-asan
TEST(ParticleContact, exact_cloths_do_not_meet_by_particles) {
    const auto stacked = [](bool with_fast) {
        World world = stack(-5, 3);
        if (with_fast) {
            SheetDesc away = fast_sheet(6, {0, 0, 0});
            away.position = {10, 1, 0};
            world.add(make_sheet(away));
        }
        run(world, 0.3);
        return center_of_mass(world.frame().cloths[2]).y;
    };
    EXPECT_LT(stacked(false), 0.02f);
    EXPECT_NEAR(stacked(true), stacked(false), 1e-3f) << "spheres would keep them 0.2 m apart";
}

TEST(ParticleContact, cloths_without_contact_do_not_take_part) {
    const auto falls_through = [](SelfCollision of_upper) {
        World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
        SheetDesc lower = fast_sheet(10, {0, 0, 0}), upper = lower;
        lower.pinned = [](Vec3) { return true; };
        lower.position = {0, 1, 0}, upper.position = {0.02f, 1.3f, 0.03f};
        upper.self_collision = of_upper;
        world.add(make_sheet(lower));
        world.add(make_sheet(upper));
        run(world, 1);
        return center_of_mass(world.frame().cloths[1]).y < 0.5f;
    };
    EXPECT_TRUE(falls_through(SelfCollision::off));
    EXPECT_FALSE(falls_through(SelfCollision::fast));
    EXPECT_FALSE(falls_through(SelfCollision::exact));
}

TEST(ParticleContact, bits_do_not_change_far_from_the_origin_with_the_age_of_lists) {
    const auto drop = [](bool always) {
        SheetDesc sheet = fast_sheet(14);
        sheet.position = {60, 0.75f, -40};
        World world = falling_world(sheet, 10, {.search_always = always});
        return hash_after(world, 40);
    };
    EXPECT_EQ(drop(false), drop(true));
}

// Labels: slow no-asan
TEST(ParticleContact, any_thickness_is_survived) {
    for (const float thickness : {0.0f, 0.1f, 1.0f}) {  // edges are 77 mm long
        SheetDesc sheet = fast_sheet(14);
        sheet.fabric.contact.thickness = thickness;
        World world = falling_world(sheet, 10);
        (void)fall(world, 1.5);
        EXPECT_TRUE(all_finite(world)) << thickness;
        EXPECT_EQ(world.frame().reports & report_non_finite, report_none) << thickness;
    }
}

TEST(ParticleContact, cloths_at_one_place_stay_finite) {
    for (const float apart : {0.0f, 1e-7f}) {
        World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
        for (int i = 0; i < 2; ++i) {
            SheetDesc sheet = fast_sheet(10, {0, 0, 0});
            sheet.position.y = 0.1f + apart * static_cast<float>(i);
            world.add(make_sheet(sheet));
        }
        add_ground(world);
        run(world, 1);
        EXPECT_TRUE(all_finite(world));
        EXPECT_EQ(world.frame().reports & report_non_finite, report_none);
        EXPECT_GT(least_distance(world.frame().cloths[0], world.frame().cloths[1]), 0.01f);
    }
}

TEST(ParticleContact, pinned_cloth_does_not_move) {
    SheetDesc sheet = fast_sheet(8, {0, 0, 0});
    sheet.pinned = [](Vec3) { return true; };
    World world = make_world({.solver = {.substeps = 5}}, sheet, {});
    world.add(make_sheet(sheet));
    run(world, 0.2);
    EXPECT_EQ(mean_speed(world), 0);
    EXPECT_EQ(world.frame().cloth_contacts.contacts, 0u) << "nothing can move these pairs";
}

}  // namespace
}  // namespace weft::physical
