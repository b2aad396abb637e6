// Contact between particles on Vulkan: the same bits as on the CPU.

#ifdef WEFT_VULKAN

#include "backend_runs.h"

namespace weft::physical {
namespace {

SheetDesc by_particles(SheetDesc sheet) {
    sheet.self_collision = SelfCollision::fast;
    sheet.fabric.contact.thickness = 0.001f;
    return sheet;
}

void add_particle_stack(World& world) {
    for (std::uint32_t i = 0; i < 3; ++i) {
        SheetDesc sheet = by_particles(falling(7, {0, 0, 0}));
        sheet.position = {0, 0.2f + 0.25f * static_cast<float>(i), 0.01f * static_cast<float>(i)};
        sheet.velocity = {0, -4, 0};
        world.add(make_sheet(sheet));
    }
    add_ground(world);
}

// Labels: slow no-asan
TEST(ParticleContactOnVulkan, a_fallen_sheet_is_the_same_as_on_the_cpu) {
    SheetDesc sheet = by_particles(falling(18));
    sheet.position = {0, 0.62f, 0};
    sheet.velocity = {0, -2, 0};
    const RunOfFrames result = expect_equal(
        with_substeps(5), [&](World& world) { add_dropped(world, sheet); }, 30);
    EXPECT_GT(result.contacts, 0u);
}

// Labels: slow no-asan
TEST(ParticleContactOnVulkan, a_fallen_stack_is_the_same_as_on_the_cpu) {
    const RunOfFrames result = expect_equal(with_substeps(5), add_particle_stack, 20);
    EXPECT_GT(result.contacts, 0u);
}

// Labels: slow no-asan
TEST(ParticleContactOnVulkan, fast_exact_and_plain_cloths_are_the_same_as_on_the_cpu) {
    const auto add = [](World& world) {
        SheetDesc exact = falling(8, {0, 0, 0}), fast = by_particles(falling(7, {0, 10, 0})), plain = exact;
        exact.position = {0, 0.3f, 0}, fast.position = {0, 0.5f, 0}, plain.position = {0, 0.4f, 0};
        fast.velocity = {0, -4, 0};
        plain.self_collision = SelfCollision::off;
        for (const SheetDesc& sheet : {plain, exact, fast}) world.add(make_sheet(sheet));
        add_ground(world);
    };
    const RunOfFrames result = expect_equal(with_substeps(4), add, 12);
    EXPECT_GT(result.contacts, 0u);
}

// Labels: slow no-asan
TEST(ParticleContactOnVulkan, cloths_at_one_place_are_the_same_as_on_the_cpu) {
    const auto add = [](World& world) {
        SheetDesc sheet = by_particles(falling(6, {0, 0, 0}));
        sheet.position = {0, 0.05f, 0};
        world.add(make_sheet(sheet));
        world.add(make_sheet(sheet));
        add_ground(world);
    };
    const RunOfFrames result = expect_equal(with_substeps(4), add, 10);
    EXPECT_GT(result.contacts, 0u);
}

// Labels: slow no-asan long
TEST(ParticleContactOnVulkan, bits_depend_neither_on_when_lists_are_made_nor_on_their_room) {
    const auto drop = [](const WorldSettings& settings, const VulkanOptions& options) {
        World world = on_vulkan(settings, options);
        add_particle_stack(world);
        return run_frames(world, 16);
    };
    const RunOfFrames expected = drop(with_substeps(4), {});
    EXPECT_GT(expected.contacts, 0u);
    const RunOfFrames always = drop(with_substeps(4), {.search_always = true});
    EXPECT_EQ(always.hash, expected.hash);
    EXPECT_EQ(always.counts.searches, 4 * 16u);
    EXPECT_LT(expected.counts.searches, always.counts.searches);
    WorldSettings short_lists = with_substeps(4);
    short_lists.list_capacity = 1;
    const RunOfFrames again = drop(short_lists, {});
    EXPECT_GT(again.repeats, 0u);
    EXPECT_EQ(again.hash, expected.hash);
    EXPECT_EQ(again.contacts, expected.contacts);
    for (const char* execution : {"streamed", "grouped", "fused"})
        EXPECT_EQ(drop(with_substeps(4), {.execution = execution}).hash, expected.hash) << execution;
}

// Labels: slow no-asan
TEST(ParticleContactOnVulkan, a_restored_world_goes_on_with_the_same_bits) {
    const auto make = [] {
        World world = on_vulkan(with_substeps(4));
        add_particle_stack(world);
        return world;
    };
    World world = make();
    (void)hash_after(world, 10);
    const Snapshot saved = world.save();
    const std::string expected = hash_after(world, 4);
    ASSERT_TRUE(world.restore(saved).ok());
    EXPECT_EQ(hash_after(world, 4), expected);
    World other = make();
    ASSERT_TRUE(other.restore(saved).ok());
    EXPECT_EQ(hash_after(other, 4), expected);
}

}  // namespace
}  // namespace weft::physical

#endif
