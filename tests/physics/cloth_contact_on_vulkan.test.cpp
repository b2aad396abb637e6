// Contact between cloths on Vulkan: the same bits as on the CPU.

#ifdef WEFT_VULKAN

#include "backend_runs.h"

namespace weft::physical {
namespace {

// Labels: slow no-asan
TEST(ClothContactOnVulkan, a_fallen_sheet_is_the_same_as_on_the_cpu) {
    SheetDesc sheet = falling(14);
    sheet.position = {0, 0.62f, 0};
    sheet.velocity = {0, -2, 0};
    const RunOfFrames result = expect_equal(
        with_substeps(5), [&](World& world) { add_dropped(world, sheet); }, 25);
    EXPECT_GT(result.counts.contacts, 0u);
}

// Labels: long no-asan
TEST(ClothContactOnVulkan, a_fallen_stack_is_the_same_as_on_the_cpu) {
    const RunOfFrames result = expect_equal(
        with_substeps(4), [](World& world) { add_stack(world, -5, 4); }, 12);
    EXPECT_GT(result.counts.contacts, 0u);
}

// The limit sends back particles that move by more than lists allow for, so it searches a second time.
// Labels: slow no-asan long
TEST(ClothContactOnVulkan, a_sheet_thrown_down_is_the_same_as_on_the_cpu) {
    SheetDesc sheet = falling(14);
    sheet.position = {0, 0.8f, 0};
    sheet.velocity = {0, -15, 0};
    const RunOfFrames result = expect_equal(
        with_substeps(4), [&](World& world) { add_dropped(world, sheet); }, 8);
    EXPECT_GT(result.counts.limited, 0u);
    EXPECT_GT(result.counts.searches, 4 * 8u) << "more than one search in some substep";
}

// Labels: slow
TEST(ClothContactOnVulkan, pins_that_press_cloth_together_are_counted_as_on_the_cpu) {
    const auto add = [](World& world) { add_pressed_sheets(world, 0.1f); };
    const RunOfFrames result = expect_equal(with_substeps(3), add, 10);
    EXPECT_GT(result.counts.tangled, 0u);
    EXPECT_NE(result.counts.tangled_particle, no_particle);
}

// By more than contact can take back, so the brake acts.
// Labels: slow no-asan long
TEST(ClothContactOnVulkan, cloth_driven_into_cloth_is_the_same_as_on_the_cpu) {
    const RunOfFrames result = expect_equal(with_substeps(5), add_driven_sheets, 3);
    EXPECT_GT(result.counts.contacts, 0u);
}

// Labels: slow no-asan long
TEST(ClothContactOnVulkan, bits_depend_neither_on_when_lists_are_made_nor_on_their_room) {
    const auto drop = [](const WorldSettings& settings, const VulkanOptions& options) {
        World world = on_vulkan(settings, options);
        add_stack(world, -5, 3);
        return run_frames(world, 12);
    };
    const RunOfFrames expected = drop(with_substeps(4), {});
    EXPECT_GT(expected.counts.contacts, 0u);
    const RunOfFrames always = drop(with_substeps(4), {.search_always = true});
    EXPECT_EQ(always.hash, expected.hash);
    EXPECT_EQ(always.counts.searches, 4 * 12u);
    EXPECT_LT(expected.counts.searches, always.counts.searches);
    WorldSettings short_lists = with_substeps(4);
    short_lists.list_capacity = 1;
    const RunOfFrames again = drop(short_lists, {});
    EXPECT_GT(again.repeats, 0u);
    EXPECT_EQ(again.hash, expected.hash);
    EXPECT_EQ(again.counts, expected.counts);
    for (const char* execution : {"streamed", "grouped", "fused"})
        EXPECT_EQ(drop(with_substeps(4), {.execution = execution}).hash, expected.hash) << execution;
}

// Labels: slow no-asan long
TEST(ClothContactOnVulkan, a_restored_world_goes_on_with_the_same_bits) {
    const auto make = [] {
        World world = on_vulkan(with_substeps(4));
        add_stack(world, -5, 3);
        return world;
    };
    World world = make();
    (void)hash_after(world, 8);
    const Snapshot saved = world.save();
    const std::string expected = hash_after(world, 4);
    ASSERT_TRUE(world.restore(saved).ok());
    EXPECT_EQ(hash_after(world, 4), expected);
    World other = make();
    ASSERT_TRUE(other.restore(saved).ok());
    EXPECT_EQ(hash_after(other, 4), expected);
}

// Labels: slow no-asan
TEST(ClothContactOnVulkan, tangled_cloth_comes_apart_as_on_the_cpu) {
    for (const std::array<std::uint32_t, 2> layers : {std::array{0u, 0u}, std::array{0u, 1u}}) {
        const auto add = [&](World& world) { add_crossed_sheets(world, 6, {70, 30, 0}, {0.4f, 0.3f, 0}, layers); };
        const RunOfFrames result = expect_equal(with_substeps(4), add, 16);
        EXPECT_GT(result.counts.tangled, 4u);
    }
}

// More pairs than a workgroup has invocations.
// Labels: long no-asan
TEST(ClothContactOnVulkan, many_tangled_pairs_come_apart_as_on_the_cpu) {
    const auto add = [](World& world) {
        for (int i = 0; i < 3; ++i) add_crossed_sheets(world, 20, {70, 30, 0}, {0.1f, 0, 0}, {0, 1});
    };
    World cpu = on_cpu(with_substeps(2)), vulkan = on_vulkan(with_substeps(2));
    add(cpu), add(vulkan);
    const RunOfFrames expected = run_frames(cpu, 1), result = run_frames(vulkan, 1);
    EXPECT_GT(expected.counts.tangled, 300u);
    EXPECT_GT(result.counts.tangled, 300u);
    if (!rounds_like_the_cpu(vulkan)) return;
    EXPECT_EQ(result.counts.tangled, expected.counts.tangled);
    EXPECT_EQ(result.hash, expected.hash);
}

// Labels: slow no-asan
TEST(ClothContactOnVulkan, cloths_without_contact_do_not_take_part) {
    const auto add = [](World& world) {
        SheetDesc plain = falling(8, {0, 0, 0});
        plain.self_collision = SelfCollision::off;
        plain.position = {0, 0.503f, 0};
        world.add(make_sheet(plain));
        add_stack(world, -5, 2);
        plain.position = {3, 0.5f, 0};
        world.add(make_sheet(plain));
    };
    (void)expect_equal(with_substeps(3), add, 8);
}

}  // namespace
}  // namespace weft::physical

#endif
