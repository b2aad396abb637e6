#include "vulkan/patches.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace weft::vulkan {
namespace {

std::shared_ptr<const ClothModel> sheet(std::uint32_t side, std::vector<std::uint32_t> pins = {}) {
    ClothModelDesc desc;
    desc.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    desc.pins.particles = std::move(pins);
    auto topology = build_topology(desc.mesh);
    EXPECT_TRUE(topology.ok());
    auto model = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

TEST(Patches, own_every_particle_and_every_row_once) {
    const auto model = sheet(23, {0, 22, 100});
    const JacobiGather gather = build_gather(*model);
    const std::vector<Patch> patches = cut_into_patches(*model, gather, {.size = 60, .rings = 3});
    EXPECT_GT(patches.size(), 8u);
    std::vector<int> owners(model->point_count());
    std::array<std::vector<int>, constraint_kind_count> row_owners;
    for (const ConstraintTable& table : model->constraints)
        row_owners[static_cast<std::uint32_t>(table.kind)].resize(table.stride);
    for (const Patch& patch : patches) {
        EXPECT_LE(patch.within[0], 60u);
        EXPECT_EQ(patch.within.back(), patch.points.size());
        EXPECT_EQ(std::set(patch.points.begin(), patch.points.end()).size(), patch.points.size());
        for (std::uint32_t i = 0; i < patch.within[0]; ++i) ++owners[patch.points[i]];
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            const PatchRows& rows = patch.tables[kind];
            for (std::uint32_t i = 0; i < rows.owned; ++i) ++row_owners[kind][rows.rows[i]];
        }
    }
    EXPECT_EQ(std::ranges::count(owners, 1), std::ptrdiff_t{model->point_count()});
    for (const ConstraintTable& table : model->constraints) {
        for (std::uint32_t row = 0; row < table.stride; ++row)
            EXPECT_EQ(row_owners[static_cast<std::uint32_t>(table.kind)][row], table.is_real(row) ? 1 : 0);
    }
}

// What a particle will be after an iteration depends on what its rows read. So everything within a ring is known as
// long as everything within the next was: all its rows are there, in the model's order, and read no farther than that.
TEST(Patches, have_what_each_iteration_reads) {
    const auto model = sheet(17, {0, 16});
    const JacobiGather gather = build_gather(*model);
    constexpr std::uint32_t rings = 4;
    for (const Patch& patch : cut_into_patches(*model, gather, {.size = 40, .rings = rings})) {
        for (std::uint32_t ring = 0; ring < rings; ++ring) {
            for (std::uint32_t i = 0; i < patch.within[ring]; ++i) {
                const std::uint32_t p = patch.points[i];
                const std::uint32_t count = gather.offsets[p + 1] - gather.offsets[p];
                if (i >= patch.within[0] && model->start[p].w == 0) continue;
                ASSERT_EQ(patch.offsets[i + 1] - patch.offsets[i], count);
                for (std::uint32_t k = 0; k < count; ++k) {
                    std::uint32_t kind = 0, item = patch.items[patch.offsets[i] + k];
                    while (kind + 1 < constraint_kind_count && item >= patch.first[kind + 1]) ++kind;
                    const PatchRows& rows = patch.tables[kind];
                    const auto size = static_cast<std::uint32_t>(rows.rows.size());
                    ASSERT_GT(size, 0u);
                    const std::uint32_t slot = (item - patch.first[kind]) / size,
                                        row = (item - patch.first[kind]) % size;
                    ASSERT_LT(row, rows.within[ring]);
                    const ConstraintTable& table = model->constraints[kind];
                    ASSERT_EQ(gather.items[gather.offsets[p] + k],
                              gather.first[kind] + slot * table.stride + rows.rows[row]);
                    for (std::uint32_t s = 0; s < table.arity; ++s) {
                        const std::uint32_t local = rows.particles[s * size + row];
                        ASSERT_LT(local, patch.within[ring + 1]);
                        ASSERT_EQ(patch.points[local], table.particles[s * table.stride + rows.rows[row]]);
                    }
                }
            }
        }
    }
}

TEST(Patches, are_chosen_to_fit) {
    const auto model = sheet(64);
    const JacobiGather gather = build_gather(*model);
    const auto shape = choose_patch_shape(*model, gather, 42, 1024);
    ASSERT_TRUE(shape);
    EXPECT_GE(shape->rings, 2u);
    for (const Patch& patch : cut_into_patches(*model, gather, *shape)) EXPECT_LE(patch.within[shape->rings], 1024u);
    EXPECT_FALSE(choose_patch_shape(*model, gather, 3, 1024)) << "three iterations are not two dispatches of two";
    EXPECT_FALSE(choose_patch_shape(*model, gather, 42, 40)) << "no room for what lies around";
    EXPECT_FALSE(choose_patch_shape(*sheet(4), build_gather(*sheet(4)), 42, 1024)) << "one patch is the whole cloth";
}

}  // namespace
}  // namespace weft::vulkan
