// Marks of what contact between cloths does to each particle.

#ifdef WEFT_VULKAN
#include "backend_runs.h"
#endif
#include "falling_cloth.h"

namespace weft::physical {
namespace {

constexpr std::uint32_t all_marks = mark_touches | mark_limited | mark_tangled;

std::uint64_t marked(const World& world, std::uint32_t mark) {
    std::uint64_t count = 0;
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const std::uint32_t marks : cloth.contact_marks) count += (marks & mark) != 0;
    return count;
}

std::vector<std::vector<std::uint32_t>> marks_of(const World& world) {
    std::vector<std::vector<std::uint32_t>> marks;
    for (const ClothFrame& cloth : world.frame().cloths) marks.push_back(cloth.contact_marks);
    return marks;
}

WorldSettings recording(std::uint32_t substeps) {
    return {.solver = {.substeps = substeps}, .contact_marks = true};
}

void add_thrown(World& world, SelfCollision self_collision) {
    SheetDesc sheet = falling(12);
    sheet.position = {0, 0.8f, 0};
    sheet.velocity = {0, -15, 0};
    sheet.self_collision = self_collision;
    world.add(make_sheet(sheet));
    add_ground(world);
}

TEST(ContactMarks, are_recorded_on_request_only_and_change_no_bit) {
    World with = make_world(recording(4), CpuOptions{}),
          without = make_world({.solver = {.substeps = 4}}, CpuOptions{});
    for (World* world : {&with, &without}) add_thrown(*world, SelfCollision::exact);
    EXPECT_TRUE(with.frame().cloths[0].contact_marks.empty()) << "no frame yet";
    EXPECT_EQ(hash_after(with, 8), hash_after(without, 8));
    EXPECT_EQ(with.frame().cloths[0].contact_marks.size(), 144u);
    EXPECT_TRUE(without.frame().cloths[0].contact_marks.empty());
    with.configure({.solver = {.substeps = 4}});
    EXPECT_TRUE(with.frame().cloths[0].contact_marks.empty()) << "no longer wanted";
    with.step(1.0 / 60);
    EXPECT_TRUE(with.frame().cloths[0].contact_marks.empty());
}

TEST(ContactMarks, agree_with_the_counts_of_the_frame) {
    World world = make_world(recording(1), CpuOptions{});
    add_thrown(world, SelfCollision::exact);
    std::uint64_t limited = 0, touching = 0;
    for (int frame = 0; frame < 20; ++frame) {
        const ClothContactCounts& counts = world.step(1.0 / 60).cloth_contacts;
        EXPECT_EQ(marked(world, mark_limited), counts.limited) << "of the only substep";
        EXPECT_EQ(marked(world, mark_tangled), 0u);
        if (counts.contacts > 0) {
            EXPECT_GE(marked(world, mark_touches), 4u);
        }
        limited += counts.limited, touching += marked(world, mark_touches);
    }
    EXPECT_GT(limited, 0u);
    EXPECT_GT(touching, 0u);
}

TEST(ContactMarks, of_a_stack_are_on_both_sides_of_each_gap) {
    World world = make_world(recording(10), CpuOptions{});
    add_stack(world, 0, 3);
    SheetDesc far = falling(8, {0, 0, 0});
    far.position = {3, 1, 0};
    world.add(make_sheet(far));
    (void)hash_after(world, 60);
    for (const int sheet : {0, 1, 2}) {
        const auto& marks = world.frame().cloths[sheet].contact_marks;
        EXPECT_GT(std::ranges::count(marks, std::uint32_t{mark_touches}), 32) << sheet;
    }
    EXPECT_EQ(std::ranges::count(world.frame().cloths[3].contact_marks, 0u), 64) << "it touches no cloth";
    world.remove(world.frame().cloths[0].id);
    EXPECT_EQ(marked(world, all_marks), 0u) << "of another state";
}

TEST(ContactMarks, tangled_particles_are_those_that_pass_through_cloth) {
    World world = make_world(recording(3), CpuOptions{});
    add_pressed_sheets(world, 0.1f);
    std::uint64_t tangled = 0;
    for (int frame = 0; frame < 20; ++frame) {
        const Frame& now = world.step(1.0 / 60);
        EXPECT_EQ(marked(world, mark_tangled) > 0, now.cloth_contacts.tangled > 0);
        tangled += now.cloth_contacts.tangled;
        if (now.tangled_at) {
            EXPECT_TRUE(now.cloths[now.tangled_at->cloth].contact_marks[now.tangled_at->particle] & mark_tangled);
        }
    }
    EXPECT_GT(tangled, 0u);
}

TEST(ContactMarks, of_fast_contact_are_the_particles_of_its_pairs) {
    World world = make_world(recording(4), CpuOptions{.workers = 3});
    add_thrown(world, SelfCollision::fast);
    std::uint64_t touching = 0;
    for (int frame = 0; frame < 20; ++frame) {
        const ClothContactCounts& counts = world.step(1.0 / 60).cloth_contacts;
        EXPECT_EQ(marked(world, mark_touches) > 0, counts.contacts > 0);
        EXPECT_LE(marked(world, mark_touches), 2 * counts.contacts);
        EXPECT_EQ(marked(world, mark_limited | mark_tangled), 0u);
        touching += marked(world, mark_touches);
    }
    EXPECT_GT(touching, 0u);
}

#ifdef WEFT_VULKAN

/// Returns all marks of any frame.
std::uint32_t expect_equal_marks(std::uint32_t substeps, int frames, void (*add)(World&)) {
    World cpu = on_cpu(recording(substeps)), vulkan = on_vulkan(recording(substeps));
    add(cpu), add(vulkan);
    std::uint32_t seen = 0;
    for (int frame = 0; frame < frames; ++frame) {
        cpu.step(1.0 / 60), vulkan.step(1.0 / 60);
        if (rounds_like_the_cpu(vulkan)) {
            EXPECT_EQ(marks_of(vulkan), marks_of(cpu)) << frame;
        }
        for (const ClothFrame& cloth : vulkan.frame().cloths)
            for (const std::uint32_t marks : cloth.contact_marks) seen |= marks;
    }
    return seen;
}

// Labels: slow no-asan
TEST(ContactMarksOnVulkan, are_those_of_the_cpu) {
    EXPECT_EQ(expect_equal_marks(4, 8, [](World& world) { add_thrown(world, SelfCollision::exact); }),
              mark_touches | mark_limited);
    EXPECT_EQ(expect_equal_marks(3, 8, [](World& world) { add_pressed_sheets(world, 0.1f); }),
              mark_touches | mark_tangled);
}

// Labels: slow
TEST(ContactMarksOnVulkan, of_fast_contact_are_those_of_the_cpu) {
    EXPECT_EQ(expect_equal_marks(4, 12,
                                 [](World& world) {
                                     add_thrown(world, SelfCollision::fast);
                                     SheetDesc exact = falling(6, {0, 0, 0});  // it touches the fast one
                                     exact.position = {0, 0.02f, 0};
                                     world.add(make_sheet(exact));
                                 }) &
                  mark_touches,
              mark_touches);
}

TEST(ContactMarksOnVulkan, are_recorded_on_request_only) {
    World world = on_vulkan({.solver = {.substeps = 2}});
    add_thrown(world, SelfCollision::fast);
    world.step(1.0 / 60);
    EXPECT_TRUE(world.frame().cloths[0].contact_marks.empty());
    world.configure(recording(2));
    world.step(1.0 / 60);
    EXPECT_EQ(world.frame().cloths[0].contact_marks.size(), 144u);
}

#endif

}  // namespace
}  // namespace weft::physical
