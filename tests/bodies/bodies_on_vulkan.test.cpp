// Rigid bodies on Vulkan: the same bits as on the CPU.

#ifdef WEFT_VULKAN

#include "../physics/backend_runs.h"
#include "attached_worlds.h"
#include "stacks.h"

namespace weft::physical {
namespace {

SheetDesc pinned_rim(std::uint32_t side) {
    return {.resolution = {side, side}, .layout = {.lines = true, .hierarchy = true}, .pinned = [](Vec3 p) {
                return std::max(std::abs(p.x), std::abs(p.z)) > 0.49f;
            }};
}

// Balls and boxes of 50 g to 2 kg, one above another.
void add_heap(World& world, int count, float side = 0.06f) {
    for (int i = 0; i < count; ++i) {
        const Vec3 at{0.14f * static_cast<float>(i % 3) - 0.13f, 0.1f + 0.05f * static_cast<float>(i),
                      0.15f * static_cast<float>(i / 3 % 3) - 0.16f};
        const float mass = 0.05f * static_cast<float>(1 + i * i % 40);
        const BodyDesc desc{.velocity = {0.1f, -2, 0}, .spin = {0, 90, 40}, .restitution = i % 2 ? 0.3f : 0.0f};
        world.add(i % 2 ? make_box({side, 0.7f * side, 0.9f * side}, mass, at, desc) : make_ball(side, mass, at, desc));
    }
}

void expect_same_forces(World& vulkan, World& cpu) {
    vulkan.summary(), cpu.summary();
    const auto &one = vulkan.contact_forces(), &other = cpu.contact_forces();
    ASSERT_EQ(one.colliders.size(), other.colliders.size());
    for (std::size_t i = 0; i < one.colliders.size(); ++i) {
        EXPECT_EQ(one.colliders[i].force, other.colliders[i].force) << i;
        EXPECT_EQ(one.colliders[i].torque, other.colliders[i].torque) << i;
    }
}

template <class Add>
void expect_same(const WorldSettings& settings, Add&& add, int frames) {
    World cpu = on_cpu(settings), vulkan = on_vulkan(settings);
    add(cpu), add(vulkan);
    for (int frame = 0; frame < frames; ++frame) cpu.step(1.0 / 60), vulkan.step(1.0 / 60);
    EXPECT_EQ(vulkan.frame().reports, report_none);
    if (!rounds_like_the_cpu(vulkan)) return;
    EXPECT_EQ(vulkan.state_hash(), cpu.state_hash());
    if (settings.contact_forces) expect_same_forces(vulkan, cpu);
}

// Labels: slow no-asan long
TEST(BodiesOnVulkan, a_heap_in_a_sheet_is_the_same_as_on_the_cpu) {
    WorldSettings settings = with_substeps(5);
    settings.contact_forces = true;
    expect_same(
        settings,
        [](World& world) {
            world.add(make_sheet(pinned_rim(11)));
            world.add(make_floor());
            add_heap(world, 7);
            world.add(make_ball(0.08f, 0.1f, {0.2f, 0.3f, 0.2f}, {.reaction = false}));
        },
        24);
}

// Labels: slow no-asan
TEST(BodiesOnVulkan, bodies_without_cloth_are_the_same_as_on_the_cpu) {
    expect_same(
        with_substeps(10),
        [](World& world) {
            world.add(make_floor());
            add_heap(world, 12);
        },
        40);
}

// Labels: slow no-asan
TEST(BodiesOnVulkan, stacks_are_the_same_as_on_the_cpu) {
    for (const int degrees : {0, 37}) {
        expect_same(
            with_substeps(10),
            [degrees](World& world) {
                add_tower(world, 4, degrees > 0 ? 0.004f : 0.0f, degrees);
                world.add(make_rod({0.01f, 0.42f, 0}));
                // Within another box at the start.
                world.add(make_box({0.05f, 0.03f, 0.05f}, 0.2f, {0.08f, 0.06f, 0.01f}));
            },
            20);
    }
}

// More pairs and contacts than lists have room for at first.
// Labels: slow no-asan long
TEST(BodiesOnVulkan, a_frame_runs_again_with_longer_lists) {
    expect_same(
        with_substeps(2),
        [](World& world) {
            world.add(make_sheet(pinned_rim(5)));
            world.add(make_floor());
            add_heap(world, 60, 0.1f);
        },
        6);
}

// A frame that runs again weighs taut edges by lambda of the frame before, like one that runs once.
// Labels: slow no-asan long
TEST(BodiesOnVulkan, frames_that_run_again_give_the_same_bits) {
    std::uint64_t repeats = 0;
    const auto hash = [&](World world) {
        world.add(make_sheet(pinned_rim(25)));
        world.add(make_ball(0.12f, 2, {0.05f, 0.13f, 0}));
        Collider sticky = make_collider({.name = "post", .shape = SphereDesc{.radius = 0.15f}});
        sticky.adhesion = Adhesion{.distance = 0.05f, .compliance = 1e-3f};
        sticky.pose.position = {-0.15f, -0.215f, 0};  // reached by the sheet once it sags
        world.add(std::move(sticky));
        std::string end;
        for (int frame = 0; frame < 20; ++frame) {
            end = hash_after(world, 1);
            if (frame > 5) repeats += world.frame().lists.repeats;
        }
        return end;
    };
    WorldSettings settings = with_substeps(4);
    const std::string expected = hash(on_cpu(settings));
    settings.list_capacity = 1;
    EXPECT_EQ(hash(on_cpu(settings)), expected);
    EXPECT_GT(repeats, 0u);
    World vulkan = on_vulkan(settings);
    if (!rounds_like_the_cpu(vulkan)) return;
    EXPECT_EQ(hash(std::move(vulkan)), expected);
}

// Labels: slow no-asan long
TEST(BodiesOnVulkan, every_method_is_the_same_as_on_the_cpu) {
    const auto add = [](World& world) {
        world.add(make_sheet(pinned_rim(7)));
        world.add(make_ball(0.15f, 1, {0, 0.2f, 0}, {.velocity = {0, -3, 0}}));
    };
    WorldSettings settings = with_substeps(3);
    settings.solver.iterations = 2;
    expect_same(settings, add, 4);
    settings.solver.projection = Projection::jacobi;
    expect_same(settings, add, 4);
    settings.solver.projection = Projection::gauss_seidel;
    expect_same(settings, add, 4);
    settings.solver.method = Method::pbd;
    expect_same(settings, add, 4);
}

// Labels: slow no-asan long
TEST(BodiesOnVulkan, cloth_between_bodies_and_colliders_is_the_same_as_on_the_cpu) {
    const auto add = [](World& world) {
        world.add(make_sheet({.resolution = {9, 9}, .position = {0, 0.0005f, 0}, .pinned = [](Vec3 p) {
                                  return p.x > 0.49f && p.z > 0.49f;
                              }}));
        world.add(make_floor());
        Collider wedge = make_collider({.name = "wedge", .shape = BoxDesc{.half_extents = {0.2f, 0.1f, 0.2f}}});
        wedge.pose = {rotation_from_degrees({10, 20, 30}), {-0.3f, -0.05f, 0.2f}};
        world.add(std::move(wedge));
        world.add(make_box({0.1f, 0.05f, 0.1f}, 0.3f, {0.2f, 0.052f, -0.1f}, {.velocity = {1, 0, 0.3f}}));
        world.add(make_box({0.1f, 0.05f, 0.1f}, 2, {-0.25f, 0.25f, 0.2f}));
        world.add(make_ball(0.1f, 0.5f, {-0.1f, 0.2f, -0.3f}, {.spin = {0, 0, 400}}));
    };
    WorldSettings settings = with_substeps(4);
    settings.contact_forces = true;
    expect_same(settings, add, 30);
    settings.solver.iterations = 2;
    expect_same(settings, add, 10);
}

// Labels: slow no-asan long
TEST(BodiesOnVulkan, cloth_that_meets_cloth_is_the_same_as_on_the_cpu) {
    const auto add = [](SelfCollision with) {
        return [with](World& world) {
            SheetDesc sheet = pinned_rim(9);
            sheet.self_collision = with;
            world.add(make_sheet(sheet));
            SheetDesc other{
                .size = {0.4f, 0.4f}, .resolution = {7, 7}, .position = {0, 0.3f, 0}, .self_collision = with};
            world.add(make_sheet(other));
            world.add(make_ball(0.1f, 0.5f, {0, 0.12f, 0}));
            world.add(make_box({0.08f, 0.05f, 0.08f}, 0.5f, {0.02f, 0.5f, 0}, {.velocity = {0, -2, 0}}));
        };
    };
    expect_same(with_substeps(4), add(SelfCollision::exact), 12);
    expect_same(with_substeps(4), add(SelfCollision::fast), 12);
}

// Labels: slow no-asan long
TEST(BodiesOnVulkan, what_is_attached_is_the_same_as_on_the_cpu) {
    const auto add = [](World& world) { add_bodies_in_nets(world, SelfCollision::off, 7); };
    WorldSettings settings = with_substeps(4);
    settings.air = AirDesc{};
    settings.air->wind.push_back({.velocity = {3, 1, 2}});
    expect_same(settings, add, 12);
    settings.solver.iterations = 2;
    expect_same(settings, add, 3);
    settings.solver.projection = Projection::jacobi;
    expect_same(settings, add, 3);
    settings.solver.method = Method::pbd;
    settings.solver.projection = Projection::gauss_seidel;
    expect_same(settings, add, 3);
}

// Labels: slow no-asan
TEST(BodiesOnVulkan, coarse_levels_pull_at_bodies_as_on_the_cpu) {
    const auto add = [](World& world) {
        const ColliderId left =
            world.add(make_box({0.05f, 0.04f, 0.3f}, 1, {-0.55f, 0, 0}, {.velocity = {-2, 0.4f, 0}}));
        const ColliderId right =
            world.add(make_box({0.05f, 0.04f, 0.3f}, 0.2f, {0.55f, 0, 0}, {.velocity = {2, 0, 0}}));
        const ClothId cloth =
            add_attached(world,
                         {.resolution = {49, 33},
                          .fabric = find_fabric("cotton")->fabric,
                          .layout = {.lines = true, .hierarchy = true}},
                         {{left, [](Vec3 p) { return p.x < -0.49f; }}, {right, [](Vec3 p) { return p.x > 0.49f; }}});
        const auto& levels = world.model(cloth)->hierarchy;
        ASSERT_GE(levels.size(), 2u);
        for (const CoarseLevel& level : levels) ASSERT_FALSE(level.pinned.empty());
    };
    WorldSettings settings = with_substeps(4);
    expect_same(settings, add, 4);
    settings.solver.iterations = 2;
    expect_same(settings, add, 2);
    settings.solver.compensation = Compensation::on;
    expect_same(settings, add, 2);
    settings.solver.compensation = Compensation::off;
    settings.solver.method = Method::pbd;
    expect_same(settings, add, 2);
}

// Labels: slow no-asan long
TEST(BodiesOnVulkan, what_is_attached_meets_cloth_as_on_the_cpu) {
    for (int frames : {8, 12}) {
        for (const SelfCollision contact : {SelfCollision::fast, SelfCollision::exact}) {
            SCOPED_TRACE(std::to_string(frames) + (contact == SelfCollision::exact ? "exact" : "fast"));
            expect_same(
                with_substeps(4), [&](World& world) { add_bodies_in_nets(world, contact, 7); }, frames);
        }
    }
}

// Labels: slow no-asan long
TEST(BodiesOnVulkan, a_restored_and_changed_world_goes_on_as_on_the_cpu) {
    World cpu = on_cpu(with_substeps(4)), vulkan = on_vulkan(with_substeps(4));
    std::string hashes[2];
    for (int i = 0; i < 2; ++i) {
        World& world = i == 0 ? cpu : vulkan;
        world.add(make_sheet(pinned_rim(7)));
        const ColliderId ball = world.add(make_ball(0.12f, 1, {0, 0.15f, 0}));
        const ColliderId box = world.add(make_box({0.1f, 0.05f, 0.1f}, 0.5f, {0.05f, 0.4f, 0}));
        (void)hash_after(world, 10);
        const Snapshot saved = world.save();
        const std::string expected = hash_after(world, 6);
        ASSERT_TRUE(world.restore(saved).ok());
        EXPECT_EQ(hash_after(world, 6), expected);
        world.push_body(ball, {0.3f, 1, 0}, {0, 0.2f, 0.05f});
        world.place_body(box, {.rotation = {}, .position = {-0.1f, 0.5f, 0.1f}}, {0, -1, 0}, {1, 0, 2});
        (void)hash_after(world, 6);
        ASSERT_TRUE(world.set_body(ball, std::nullopt, {}).ok());
        (void)hash_after(world, 4);
        world.remove(box);
        hashes[i] = hash_after(world, 4);
    }
    if (!rounds_like_the_cpu(vulkan)) return;
    EXPECT_EQ(hashes[1], hashes[0]);
}

// Labels: slow no-asan
TEST(BodiesOnVulkan, a_frame_with_a_body_that_is_not_finite_is_rolled_back) {
    World world = on_vulkan(with_substeps(4));
    world.add(make_sheet(pinned_rim(5)));
    const ColliderId ball = world.add(make_ball(0.1f, 1, {0, 2, 0}));
    world.step(1.0 / 60);
    world.push_body(ball, {0, 1e38f, 0}, {0.05f, 2, 0});
    const std::string before = world.state_hash();
    world.step(1.0 / 60);
    EXPECT_TRUE(world.frame().reports & report_non_finite);
    EXPECT_EQ(world.state_hash(), before);
}

// Labels: slow
TEST(BodiesOnVulkan, refuses_more_bodies_than_it_moves) {
    World world = on_vulkan(with_substeps(4));
    for (int i = 0; i < 256; ++i) world.add(make_ball(0.1f, 1, {static_cast<float>(i), 0, 0}));
    const auto added = world.try_add(make_ball(0.1f, 1, {}));
    ASSERT_FALSE(added.ok());
    EXPECT_EQ(added.error().message(),
              "motion/dynamic: would be body number 257, but the vulkan backend moves at most 256 "
              "(--backend cpu moves any number)");
}

}  // namespace
}  // namespace weft::physical

#endif
