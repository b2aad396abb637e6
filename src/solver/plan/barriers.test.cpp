#include "solver/plan/barriers.h"

#include "mesh/procedural.h"
#include "solver/plan/island_plan.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

// Whether there is a barrier before the last pass.
bool barrier_before_last(std::initializer_list<Pass> passes, Sharing sharing = Sharing::fixed) {
    Barriers barriers(sharing);
    bool last = false;
    for (const Pass& pass : passes) last = barriers.before(pass);
    return last;
}

Pass of(PassKind kind) {
    return {.kind = kind};
}
Pass batch(std::uint32_t number, ConstraintKind constraint = ConstraintKind::stretch) {
    return {.kind = PassKind::project, .constraint = constraint, .batch = number};
}
Pass level(PassKind kind, std::uint32_t number) {
    return {.kind = kind, .constraint = ConstraintKind::coarse_limit, .level = number, .source = RowSource::level};
}

TEST(Barriers, are_not_needed_between_passes_that_touch_their_own_particles) {
    EXPECT_FALSE(barrier_before_last({of(PassKind::predict), of(PassKind::targets)}));
    EXPECT_FALSE(barrier_before_last({of(PassKind::contact), of(PassKind::velocities)}));
    EXPECT_FALSE(barrier_before_last({of(PassKind::velocities), of(PassKind::predict)}));
    EXPECT_FALSE(barrier_before_last({of(PassKind::push), of(PassKind::predict)}));
    EXPECT_FALSE(barrier_before_last({of(PassKind::average), of(PassKind::contact)}));
    EXPECT_FALSE(barrier_before_last({of(PassKind::wind), of(PassKind::air)}));
}

TEST(Barriers, stand_where_a_pass_reads_what_others_write) {
    EXPECT_TRUE(barrier_before_last({of(PassKind::predict), batch(0)}));
    EXPECT_TRUE(barrier_before_last({batch(0), batch(1)}));
    EXPECT_TRUE(barrier_before_last({batch(0), of(PassKind::contact)}));
    EXPECT_TRUE(barrier_before_last({of(PassKind::air), of(PassKind::push)}));
    EXPECT_TRUE(barrier_before_last({of(PassKind::faces), of(PassKind::normals)}));
    EXPECT_TRUE(barrier_before_last({of(PassKind::velocities), of(PassKind::damp)}));
    EXPECT_TRUE(barrier_before_last({level(PassKind::restriction, 0), level(PassKind::restriction, 1)}));
    EXPECT_TRUE(barrier_before_last({level(PassKind::node_correction, 1), level(PassKind::interpolation, 0)}));
    EXPECT_TRUE(barrier_before_last({level(PassKind::node_correction, 0), of(PassKind::prolongation)}));
}

TEST(Barriers, look_back_to_the_last_one) {
    // Faces wait for contact, not for velocities, which do not write positions.
    EXPECT_TRUE(barrier_before_last({of(PassKind::contact), of(PassKind::velocities), of(PassKind::faces)}));
    EXPECT_FALSE(barrier_before_last({of(PassKind::velocities), of(PassKind::faces)}));
}

TEST(Barriers, of_side_by_side_constraints_are_none) {
    const auto correct = [](ConstraintKind kind) { return Pass{.kind = PassKind::correct, .constraint = kind}; };
    EXPECT_FALSE(barrier_before_last({correct(ConstraintKind::stretch), correct(ConstraintKind::bend)}));
    EXPECT_TRUE(barrier_before_last({correct(ConstraintKind::stretch), of(PassKind::average)}));
    EXPECT_TRUE(barrier_before_last({of(PassKind::average), correct(ConstraintKind::stretch)}));
}

TEST(Barriers, stand_between_the_passes_that_find_constraints) {
    const auto list = [](PassKind kind) {
        return Pass{.kind = kind, .constraint = ConstraintKind::adhesion, .source = RowSource::dynamic};
    };
    EXPECT_TRUE(barrier_before_last({list(PassKind::find), list(PassKind::place)}));
    EXPECT_TRUE(barrier_before_last({list(PassKind::place), list(PassKind::list)}));
    EXPECT_TRUE(barrier_before_last({list(PassKind::list), list(PassKind::aim)}));
    EXPECT_TRUE(barrier_before_last({list(PassKind::list), of(PassKind::predict)}, Sharing::free));
    EXPECT_FALSE(barrier_before_last({of(PassKind::predict), list(PassKind::aim)}));
    EXPECT_FALSE(barrier_before_last({list(PassKind::aim), list(PassKind::correct)})) << "each its own rows";
    EXPECT_TRUE(barrier_before_last({list(PassKind::aim), list(PassKind::correct)}, Sharing::free));
    EXPECT_TRUE(barrier_before_last({list(PassKind::correct), list(PassKind::average)}));
    EXPECT_TRUE(barrier_before_last({list(PassKind::place), list(PassKind::average)}));
}

TEST(Barriers, between_passes_of_one_thread_are_none) {
    Barriers barriers(Sharing::fixed);
    EXPECT_FALSE(barriers.before(level(PassKind::restriction, 0), true));
    EXPECT_FALSE(barriers.before(level(PassKind::restriction, 1), true));
    EXPECT_FALSE(barriers.before(level(PassKind::interpolation, 1), true));
    EXPECT_TRUE(barriers.before(level(PassKind::interpolation, 0), false)) << "others join";
}

TEST(Barriers, know_that_any_thread_may_get_any_item) {
    EXPECT_TRUE(barrier_before_last({of(PassKind::predict), of(PassKind::targets)}, Sharing::free));
    EXPECT_FALSE(barrier_before_last({of(PassKind::velocities), of(PassKind::faces)}, Sharing::free));
}

std::shared_ptr<const ClothModel> make_model(std::uint32_t side, float damping) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    ClothModelDesc desc{.name = "sheet", .mesh = std::move(mesh), .layout = {.lines = true, .hierarchy = true}};
    desc.fabric.body.damping = damping;
    return *build_cloth_model(std::move(desc), std::move(*topology));
}

TEST(WorldPlan, has_the_passes_of_the_cloth_with_most) {
    const auto small = make_model(5, 0), large = make_model(33, 0.1f);
    const PlannedCloth cloths[] = {{small.get(), false}, {large.get(), true}};
    const StepSettings settings{.solver = {.substeps = 3}};
    const WorldPlan both = plan_world(settings, cloths);
    const WorldPlan of_large = plan_world(settings, std::span(cloths).subspan(1));
    EXPECT_EQ(both.substep, of_large.substep);
    EXPECT_EQ(both.frame_end, of_large.frame_end);
    const auto count = [&](const PlannedCloth& cloth) {
        std::size_t sum = 0;
        for_each_pass(both, [&](const Pass& pass, std::uint32_t) { sum += takes_part(cloth, pass); });
        return sum;
    };
    EXPECT_LT(count(cloths[0]), count(cloths[1])) << "no levels, no damping, nothing held";
}

TEST(WorldPlan, finds_what_sticks_once_a_frame_and_projects_it_before_contact) {
    const auto model = make_model(5, 0);
    const PlannedCloth cloth{model.get(), false};
    const StepSettings settings{.solver = {.substeps = 3, .iterations = 2}, .adhesion = true};
    EXPECT_EQ(describe(plan_world(settings, {&cloth, 1})).substr(0, 17), "first:\n  find x3\n");
    const WorldPlan plan = plan_world(settings, {&cloth, 1});
    std::vector<PassKind> found;
    for (const Pass& pass : plan.substep)
        if (pass.source == RowSource::dynamic || pass.kind == PassKind::contact) found.push_back(pass.kind);
    using enum PassKind;
    EXPECT_EQ(found, (std::vector{aim, correct, average, contact, correct, average, contact}));
}

TEST(IslandPlan, has_the_passes_in_which_somebody_has_work) {
    const auto small = make_model(5, 0), large = make_model(33, 0.1f);
    const PlannedCloth cloths[] = {{small.get(), false}, {large.get(), true}};
    const WorldPlan plan = plan_world({.solver = {.substeps = 4}}, cloths);
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        std::vector<std::pair<Pass, std::uint32_t>> expected, found;
        for_each_pass(plan, [&](const Pass& pass, std::uint32_t substep) {
            if (takes_part(cloths[i], pass)) expected.push_back({pass, substep});
        });
        IslandPlan(plan, std::span(cloths).subspan(i, 1), {})
            .for_each_pass([&](const IslandPass& pass, std::uint32_t substep) {
                found.push_back({pass.pass, substep});
            });
        EXPECT_EQ(found, expected) << i;
    }
}

TEST(PlainStiffness, of_some_iterations_undoes_the_whole_part) {
    Fabric fabric;
    for (const float s : {0.0f, 0.1f, 0.5f, 0.99f, 1.0f}) {
        fabric.body.stiffness[0] = s;
        for (const std::uint32_t iterations : {1u, 2u, 7u, 100u}) {
            const double part =
                plain_stiffness(fabric, iterations)[static_cast<std::size_t>(ConstraintKind::stretch)][0];
            double left = 1;
            for (std::uint32_t i = 0; i < iterations; ++i) left *= 1 - part;
            EXPECT_NEAR(left, 1 - s, 2e-6 * iterations) << s << ' ' << iterations;
        }
    }
}

}  // namespace
}  // namespace weft
