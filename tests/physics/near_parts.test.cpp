// Cloths that can collide but are far apart step independently of each other.

#include "falling_cloth.h"

#include <bit>
#include <numeric>

namespace weft::physical {
namespace {

using Bits = std::vector<std::array<std::uint32_t, 4>>;

Bits bits_of(const ClothFrame& cloth) {
    Bits bits;
    for (const auto& array : {cloth.positions, cloth.velocities})
        for (const Vec4& v : array) bits.push_back(std::bit_cast<std::array<std::uint32_t, 4>>(v));
    return bits;
}

World world_of(std::span<const SheetDesc> sheets, CpuOptions options = {}) {
    World world = make_world({.solver = {.substeps = 10}}, options);
    for (const SheetDesc& sheet : sheets) world.add(make_sheet(sheet));
    add_ground(world);
    return world;
}

// With other meshes and thicknesses, since nothing of a cloth may depend on another one far away.
std::vector<SheetDesc> sheets_far_apart(SelfCollision contact) {
    std::vector<SheetDesc> sheets;
    for (std::uint32_t i = 0; i < 3; ++i) {
        SheetDesc sheet = falling(12 + 5 * i, {80, 20 + 10 * static_cast<float>(i), 45});
        sheet.size = {0.5f, 0.5f};
        sheet.position = {3 * static_cast<float>(i), 0.4f, 0};
        sheet.self_collision = contact;
        sheets.push_back(sheet);
    }
    return sheets;
}

TEST(NearParts, cloths_far_apart_have_the_bits_of_each_alone) {
    for (const SelfCollision contact : {SelfCollision::exact, SelfCollision::fast}) {
        const std::vector<SheetDesc> sheets = sheets_far_apart(contact);
        World together = world_of(sheets, CpuOptions{1});
        ASSERT_EQ(together.island_count(), 1u) << "they can collide";
        std::uint64_t contacts = 0;
        for (int frame = 0; frame < 30; ++frame) {
            run(together, 1.0 / 60);
            contacts += together.frame().cloth_contacts.contacts;
        }
        EXPECT_GT(contacts, 0u);
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            World alone = world_of({&sheets[i], 1});
            run(alone, 0.5);
            EXPECT_EQ(bits_of(together.frame().cloths[i]), bits_of(alone.frame().cloths[0])) << i;
        }
    }
}

// Some cloths have no part in some of the passes.
TEST(NearParts, cloths_far_apart_may_collide_in_other_ways) {
    std::vector<SheetDesc> sheets = sheets_far_apart(SelfCollision::exact);
    sheets[0].self_collision = SelfCollision::off, sheets[1].self_collision = SelfCollision::fast;
    World together = world_of(sheets, CpuOptions{1});
    run(together, 0.5);
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        World alone = world_of({&sheets[i], 1});
        run(alone, 0.5);
        EXPECT_EQ(bits_of(together.frame().cloths[i]), bits_of(alone.frame().cloths[0])) << i;
    }
}

// The edge of a sheet, at rest until then, is driven into another one.
World driven_world(SelfCollision contact, unsigned workers) {
    SheetDesc driven = falling(24, {0, 0, 0}), hit = falling(25, {0, 0, 90});
    driven.position = {0, 1, 0};
    driven.pinned = [](Vec3 x) { return x.x > 0.499f; };
    hit.position = {0.9f, 1, 0};
    World world = make_world({.solver = {.substeps = 20}}, CpuOptions{workers});
    for (SheetDesc* sheet : {&driven, &hit}) sheet->self_collision = contact;
    world.add(make_sheet(hit));
    auto model = make_sheet(driven);
    KinematicTargets targets;
    // It is fast before it meets the other sheet, and slow then.
    targets.motions.push_back({.collider = {}, .offsets = {{0, {}}, {0.013f, {0.38f, 0, 0}}, {0.3f, {0.6f, 0, 0}}}});
    for (std::uint32_t p = 0; p < model->particle_count; ++p)
        if (!(model->start[p].w > 0))
            targets.particles.push_back({.particle = p, .motion = 0, .local = model->start[p].xyz()});
    world.add(model, targets);
    return world;
}

// Labels: slow no-asan long
TEST(NearParts, a_frame_runs_again_if_cloths_come_near_unexpectedly) {
    for (const SelfCollision contact : {SelfCollision::exact, SelfCollision::fast}) {
        std::string expected;
        for (const unsigned workers : {0u, 1u, 3u}) {
            World world = driven_world(contact, workers);
            std::uint64_t repeats = 0, contacts = 0, worst = 0;
            for (int frame = 0; frame < 20; ++frame) {
                world.step(1.0 / 60);
                repeats += world.frame().lists.repeats;
                contacts += world.frame().cloth_contacts.contacts;
                worst = std::max(worst, crossings(world));
            }
            EXPECT_GT(repeats, 0u);
            EXPECT_GT(contacts, 0u);
            EXPECT_TRUE(worst == 0 || contact == SelfCollision::fast) << worst;
            if (expected.empty()) expected = world.state_hash();
            EXPECT_EQ(world.state_hash(), expected) << workers << " workers";
        }
    }
}

// A world that was saved while cloths were apart goes on with the same groups.
// Labels: no-asan
TEST(NearParts, a_restored_world_continues_with_the_same_bits) {
    World world = driven_world(SelfCollision::exact, 0);
    world.step(1.0 / 60);
    const Snapshot saved = world.save();
    const std::string expected = hash_after(world, 4);
    World other = driven_world(SelfCollision::exact, 1);
    ASSERT_TRUE(other.restore(saved).ok());
    EXPECT_EQ(hash_after(other, 4), expected);
}

}  // namespace
}  // namespace weft::physical
