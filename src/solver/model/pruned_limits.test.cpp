#include "solver/model/pruned_limits.h"

#include "mesh/procedural.h"
#include "solver/model/cuts.h"
#include "solver/model/rebuilt_limits.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

std::shared_ptr<const ClothModel> make_sheet_to_prune() {
    TriangleMesh mesh = make_grid({1, 1}, {33, 33}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    ClothModelDesc desc{.name = "sheet",
                        .pins = {.particles = {0, 32}},
                        .layout = {.lines = true, .hierarchy = true},
                        .reserve = {.particles = 200, .openings = true}};
    desc.mesh = std::move(mesh);
    auto built = build_cloth_model(std::move(desc), std::move(*topology));
    EXPECT_TRUE(built.ok());
    EXPECT_GE((*built)->hierarchy.size(), 2u);
    return *built;
}

std::shared_ptr<const ClothModel> opened(const ClothModel& model, std::vector<Opening> openings, std::uint32_t pruned) {
    auto edited = with_edit(model, {.openings = std::move(openings), .pruned_frames = pruned});
    EXPECT_TRUE(edited.ok());
    return *edited;
}

std::vector<Opening> openings_across(const ClothModel& model) {
    return openings_along_plane(model, model.start, {}, {1, 0, 0});
}

bool is_limit(const ConstraintTable& limits, std::uint32_t row) {
    return !limits.is_dummy(limits.particles[row]) && limits.fields[row] < 1000;
}

void expect_the_same_levels(const ClothModel& a, const ClothModel& b) {
    ASSERT_EQ(a.hierarchy.size(), b.hierarchy.size());
    for (std::size_t i = 0; i < a.hierarchy.size(); ++i) {
        const CoarseLevel &one = a.hierarchy[i], &other = b.hierarchy[i];
        EXPECT_EQ(one.limits.particles, other.limits.particles);
        EXPECT_EQ(one.limits.fields, other.limits.fields);
        EXPECT_EQ(one.limits.rows, other.limits.rows);
        EXPECT_EQ(one.prolongation.stride, other.prolongation.stride);
        EXPECT_EQ(one.prolongation.narrow, other.prolongation.narrow);
        EXPECT_EQ(one.prolongation.weight, other.prolongation.weight);
        EXPECT_EQ(one.restriction.weight, other.restriction.weight);
    }
}

TEST(PrunedLimits, lead_over_no_cut_and_stay_elsewhere) {
    const auto whole = make_sheet_to_prune();
    const auto cut = opened(*whole, openings_across(*whole), 1);
    ASSERT_EQ(cut->hierarchy.size(), whole->hierarchy.size());
    for (std::size_t i = 0; i < cut->hierarchy.size(); ++i) {
        const CoarseLevel& level = cut->hierarchy[i];
        std::uint32_t left = 0, before = 0;
        for (std::uint32_t row = 0; row < level.limits.stride; ++row) {
            before += is_limit(whole->hierarchy[i].limits, row);
            if (!is_limit(level.limits, row)) continue;
            ++left;
            const std::uint32_t a = level.limits.particles[row], b = level.limits.particles[level.limits.stride + row];
            const float x = cut->rest_position(level.particle[a]).x, y = cut->rest_position(level.particle[b]).x;
            EXPECT_GT(x * y, 0) << "level " << i << ", limit " << row << " from " << x << " to " << y;
        }
        EXPECT_EQ(left, level.limits.rows);
        EXPECT_LT(left, before);
        EXPECT_GT(4 * left, i == 0 ? 2 * before : before / 4) << "level " << i;
    }
}

TEST(PrunedLimits, move_copies_with_their_originals) {
    const auto whole = make_sheet_to_prune();
    const auto cut = opened(*whole, openings_across(*whole), 1);
    const Prolongation &before = whole->hierarchy[0].prolongation, &after = cut->hierarchy[0].prolongation;
    ASSERT_GE(after.stride, cut->particle_count);
    for (std::uint32_t p = 0; p < cut->particle_count; ++p) {
        const std::uint32_t from = p < whole->particle_count ? p : cut->copied_from[p - whole->particle_count];
        for (std::uint32_t k = 0; k < Prolongation::parents; ++k) {
            const std::size_t there = std::size_t{k} * before.stride + from, here = std::size_t{k} * after.stride + p;
            EXPECT_EQ(after.weight[here], before.weight[there]);
            EXPECT_EQ(after.node(here), before.node(there));
        }
    }
}

TEST(PrunedLimits, do_not_depend_on_the_number_of_frames) {
    const auto whole = make_sheet_to_prune();
    const std::vector<Opening> all = openings_across(*whole);
    const auto at_once = opened(*whole, all, 1);
    auto one_by_one = whole;
    for (std::uint32_t i = 0; i < all.size(); ++i) one_by_one = opened(*one_by_one, {all[i]}, i + 1);
    expect_the_same_levels(*one_by_one, *at_once);
    EXPECT_EQ(one_by_one->pruned->vertices, at_once->pruned->vertices);
}

TEST(PrunedLimits, are_those_of_the_pieces_after_they_were_built_again) {
    const auto whole = make_sheet_to_prune();
    const auto rebuilt = with_rebuilt_limits(*opened(*whole, openings_across(*whole), 1));
    EXPECT_EQ(rebuilt->pruned, nullptr);
    expect_the_same_levels(*rebuilt, *opened(*whole, openings_across(*whole), 0));
}

}  // namespace
}  // namespace weft
