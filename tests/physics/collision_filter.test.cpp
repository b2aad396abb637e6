// Groups and masks say which cloths collide with each other, in exact and in fast contact.
#include "backend_runs.h"

namespace weft::physical {
namespace {

constexpr CollisionFilter everything{}, nothing{.mask = 0};
constexpr CollisionFilter in_second{.groups = 2}, without_second{.mask = ~2u};

SheetDesc held(SelfCollision kind, CollisionFilter filter) {
    SheetDesc sheet = falling(10, {0, 0, 0});
    sheet.pinned = [](Vec3) { return true; };
    sheet.position = {0, 1, 0};
    sheet.self_collision = kind;
    sheet.filter = filter;
    return sheet;
}
SheetDesc dropped(SelfCollision kind, CollisionFilter filter) {
    SheetDesc sheet = held(kind, filter);
    sheet.pinned = {};
    sheet.position = {0.02f, 1.3f, 0.03f};
    return sheet;
}

bool falls_through(SelfCollision of_lower, CollisionFilter lower, SelfCollision of_upper, CollisionFilter upper) {
    World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
    world.add(make_sheet(held(of_lower, lower)));
    world.add(make_sheet(dropped(of_upper, upper)));
    for (int i = 0; i < 50; ++i) world.step(1.0 / 60);
    EXPECT_EQ(world.frame().cloth_contacts.tangled, 0u) << "crossings of cloths that do not collide are not tangled";
    const auto& sheet = world.frame().cloths[1].positions;
    return std::ranges::all_of(sheet, [](const Vec4& x) { return x.y < 0.9f; });
}

TEST(CollisionFilter, each_mask_has_to_contain_a_group_of_the_other_one) {
    EXPECT_TRUE(collide(everything, everything));
    EXPECT_TRUE(collide(everything, in_second));
    EXPECT_FALSE(collide(without_second, in_second));
    EXPECT_FALSE(collide(in_second, without_second));
    EXPECT_FALSE(collide(everything, nothing));
    EXPECT_FALSE(collide(nothing, nothing));
}

// Labels: slow no-asan
TEST(CollisionFilter, cloths_that_do_not_collide_fall_through_each_other) {
    for (const SelfCollision a : {SelfCollision::exact, SelfCollision::fast}) {
        for (const SelfCollision b : {SelfCollision::exact, SelfCollision::fast}) {
            EXPECT_FALSE(falls_through(a, everything, b, in_second));
            EXPECT_TRUE(falls_through(a, without_second, b, in_second));
            EXPECT_TRUE(falls_through(a, in_second, b, without_second));
            EXPECT_TRUE(falls_through(a, everything, b, nothing));
        }
    }
}

// Labels: slow no-asan
TEST(CollisionFilter, a_cloth_collides_with_itself_whatever_its_mask) {
    for (const SelfCollision kind : {SelfCollision::exact, SelfCollision::fast}) {
        const auto drop = [&](CollisionFilter filter) {
            SheetDesc sheet = falling(14);
            sheet.self_collision = kind;
            sheet.filter = filter;
            World world = falling_world(sheet, 10);
            std::uint64_t contacts = 0;
            for (int i = 0; i < 60; ++i) {
                world.step(1.0 / 60);
                contacts += world.frame().cloth_contacts.contacts;
            }
            EXPECT_GT(contacts, 0u);
            return world.state_hash();
        };
        EXPECT_EQ(drop(nothing), drop(everything));
    }
}

TEST(CollisionFilter, a_change_acts_from_the_next_frame_on) {
    World world = make_world({.solver = {.substeps = 10}}, CpuOptions{});
    world.add(make_sheet(held(SelfCollision::exact, everything)));
    const ClothId upper = world.add(make_sheet(dropped(SelfCollision::exact, everything)));
    for (int i = 0; i < 40; ++i) world.step(1.0 / 60);
    EXPECT_GT(world.frame().cloth_contacts.contacts, 0u);
    ASSERT_TRUE(world.set_model(upper, make_sheet(dropped(SelfCollision::exact, nothing)), {}).ok());
    world.step(1.0 / 60);
    EXPECT_EQ(world.frame().cloth_contacts.contacts, 0u);
}

#ifdef WEFT_VULKAN

// Three sheets that cross each other while they fall; only the first and the last one collide.
void add_filtered(World& world, SelfCollision first, SelfCollision others) {
    SheetDesc sheet = falling(6, {0, 0, 0});
    sheet.position = {0, 0.05f, 0};
    sheet.self_collision = first;
    sheet.filter = without_second;
    world.add(make_sheet(sheet));
    sheet.position = {0, 0.08f, 0}, sheet.rotation_degrees = {0, 10, 20};
    sheet.self_collision = others;
    sheet.filter = {.groups = 2, .mask = 2};
    world.add(make_sheet(sheet));
    sheet.position = {0, 0.3f, 0}, sheet.rotation_degrees = {0, 30, 0};
    sheet.velocity = {0, -4, 0};
    sheet.filter = everything;
    world.add(make_sheet(sheet));
    add_ground(world);
}

// Labels: slow no-asan long
TEST(CollisionFilter, is_the_same_on_vulkan_as_on_the_cpu) {
    for (const SelfCollision others : {SelfCollision::exact, SelfCollision::fast}) {
        const auto add = [&](World& world) { add_filtered(world, SelfCollision::exact, others); };
        World cpu = on_cpu(with_substeps(4));
        add(cpu);
        (void)run_frames(cpu, 10);
        EXPECT_GT(crossings(cpu), 0u) << "of the sheets that do not collide";
        const RunOfFrames result = expect_equal(with_substeps(4), add, 10, crossings(cpu));
        EXPECT_GT(result.counts.contacts, 0u);
        EXPECT_EQ(result.counts.tangled, 0u);
    }
}

#endif

}  // namespace
}  // namespace weft::physical
