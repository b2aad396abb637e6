// The Vulkan backend against the CPU's, constraint by constraint, on random and degenerate input.
//
// Both backends compile the same source in the same order of operations. Only division and square root may differ:
// Vulkan allows errors of 2.5 and 3 units in the last place. A device that rounds them as IEEE 754 says (software
// devices do) must give the same bits. On other devices ordinary input must agree within the tolerances below.

#include "vulkan_fixture.h"

#include "cpu/cpu_backend.h"
#include "solver/model/random_rows.test.h"
#include "solver/plan/island_plan.h"
#include "solver/state/address_space.h"

#include <bit>
#include <cmath>
#include <string_view>

namespace weft {
namespace {

using namespace random_rows;

// Relative to the movement by a constraint in these tests, some tenths of a meter.
double tolerance(ConstraintKind kind) {
    switch (kind) {
        case ConstraintKind::bend:
        case ConstraintKind::moment:
            return 1e-4;  // an angle of vectors that nearly cancel
        case ConstraintKind::plate:
            return 1e-3;  // three of them, coupled
        default:
            return 1e-5;
    }
}

std::shared_ptr<const ClothModel> model_of(const RandomState& state) {
    auto model = std::make_shared<ClothModel>();
    model->name = "random";
    model->particle_count = particle_count;
    model->start = AlignedVector<Vec4>(state.position);
    model->mass = std::vector<float>(particle_count, 1);
    model->mean_edge = 1;
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        const auto as_kind = static_cast<ConstraintKind>(kind);
        model->constraints[kind] = as_kind == state.table.kind && state.table.rows > 0
                                       ? state.table
                                       : pack_rows(as_kind, make_rows(as_kind), particle_count);
    }
    model->around = std::make_shared<FacesAround>(
        lay_out_around({.offsets = std::vector<std::uint32_t>(particle_count + 1), .items = {}}, 0));
    return model;
}

enum class Way { project, plain, side_by_side, fixed_point, damp, project_exactly, side_by_side_exactly };

bool keeps_remainders(Way way) {
    return way == Way::project_exactly || way == Way::side_by_side_exactly;
}

// Whether constraints.def lists a loop for it.
bool exists(const ConstraintInfo& info, Way way) {
    switch (way) {
        case Way::project:
            return true;
        case Way::project_exactly:  // one particle alone is not relative to another
            return info.source == RowSource::model || info.source == RowSource::level;
        case Way::side_by_side_exactly:
            return info.source == RowSource::model;
        case Way::plain:
            return info.source == RowSource::model || info.source == RowSource::links;
        case Way::side_by_side:
        case Way::fixed_point:
            return info.source == RowSource::model || info.source == RowSource::dynamic;
        case Way::damp:
            return info.damped;
    }
    return false;
}

// Two iterations of one constraint and nothing else.
WorldPlan plan_of(const ConstraintTable& table, Way way) {
    constexpr std::uint32_t iterations = 2;
    WorldPlan plan;
    plan.substeps = 1;
    plan.iterations = iterations;
    plan.method = way == Way::plain ? Method::pbd : Method::xpbd;
    if (way == Way::fixed_point) plan.accumulate = Accumulate::fixed_point;
    plan.compensated = keeps_remainders(way);
    const bool jacobi = way == Way::side_by_side || way == Way::fixed_point || way == Way::side_by_side_exactly;
    plan.projection = jacobi ? Projection::jacobi : table.blocks.empty() ? Projection::gauss_seidel : Projection::lines;
    for (std::uint32_t i = 0; i < iterations; ++i) {
        const bool first = i == 0;
        if (jacobi) {
            plan.substep.push_back({.kind = PassKind::correct, .constraint = table.kind, .first_iteration = first});
            plan.substep.push_back({.kind = PassKind::average});
        }
        for (std::uint32_t batch = 0; batch < table.batches.size(); ++batch) {
            const Pass pass{PassKind::project, table.kind, batch, first};
            if (way == Way::project || way == Way::plain || way == Way::project_exactly) plan.substep.push_back(pass);
            if (way == Way::damp && first && constraint_info(table.kind).moved == constraint_info(table.kind).arity)
                plan.frame_end.push_back({.kind = PassKind::damp, .constraint = table.kind, .batch = batch});
        }
    }
    // The remainders come to light in what the end of a substep makes of them.
    if (plan.compensated) plan.substep.push_back({.kind = PassKind::velocities});
    if (table.is_coupled() && plan.method == Method::xpbd && way != Way::damp) {
        plan.substep.push_back({.kind = PassKind::couple, .constraint = table.kind});
        plan.reads_kept = true;
    }
    return plan;
}

class Parity : public testing::TestWithParam<const char*> {
  protected:
    Parity() : cpu_(std::move(*make_cpu_backend())), vulkan_(checked_vulkan_backend({.execution = GetParam()})) {
        exact_ = vulkan_ && vulkan_->device().find("llvmpipe") != std::string::npos;
    }

    struct Outcome {
        ClothSnapshot state;
        std::uint32_t reports = 0;
        std::string detail;
    };

    static Outcome run(Backend& backend, const RandomState& from, const WorldPlan& plan) {
        const auto model = model_of(from);
        auto cloth = backend.add_cloth(model, AddressSpace::reserved);
        EXPECT_TRUE(cloth.ok());
        const auto points = [&](const AlignedVector<Vec4>& array) {
            return std::vector<Vec4>(array.begin(), array.begin() + particle_count);
        };
        EXPECT_TRUE(backend
                        .restore(*cloth, {.position = points(from.position),
                                          .start = points(from.start),
                                          .velocity = points(from.velocity),
                                          .compensation = points(from.compensation),
                                          .kept = std::vector<float>(model->kept_floats(), 0.25f)})
                        .ok());
        ClothFrame frame;
        std::array<double, stage_count> stages{};
        PlainStiffness stiffness;
        stiffness.fill({0.3f, 0.8f});
        const PlannedCloth planned{model.get(), false};
        const IslandPlan passes(plan, {&planned, 1}, {});
        const ClothStep step{.cloth = *cloth, .stiffness = &stiffness, .frame = &frame};
        const StitchedPart part{0, 1};
        const IslandStep island{.plan = &passes, .cloths = {&step, 1}, .parts = {&part, 1}};
        const WorldStep world{.plan = &plan, .input = {.dt = 1e-3, .gravity = {}}, .islands = {&island, 1}};
        backend.step(world);
        backend.finish(stages);
        Outcome outcome{backend.save(*cloth), frame.reports, frame.detail};
        backend.remove_cloth(*cloth);
        return outcome;
    }

    void expect_same(const std::vector<Vec4>& cpu, const std::vector<Vec4>& vulkan, const std::vector<Vec4>& before,
                     double relative, const std::string& what) {
        ASSERT_EQ(cpu.size(), vulkan.size()) << what;
        double moved = 0;
        for (std::size_t p = 0; p < cpu.size(); ++p)
            moved = std::max(moved, double{length(cpu[p].xyz() - before[p].xyz())});
        for (std::size_t p = 0; p < cpu.size(); ++p) {
            const auto bits = [](const Vec4& v) { return std::bit_cast<std::array<std::uint32_t, 4>>(v); };
            if (exact_) {
                ASSERT_EQ(bits(cpu[p]), bits(vulkan[p]))
                    << what << ", particle " << p << ": " << cpu[p].x << " and " << vulkan[p].x;
            } else {
                ASSERT_LT(double{length(cpu[p].xyz() - vulkan[p].xyz())}, relative * moved + 1e-6)
                    << what << ", particle " << p;
            }
        }
    }

    void compare(const RandomState& state, Way way, bool degenerate, const std::string& what) {
        const WorldPlan plan = plan_of(state.table, way);
        const Outcome cpu = run(*cpu_, state, plan), vulkan = run(*vulkan_, state, plan);
        for (const Vec4& p : vulkan.state.position) ASSERT_TRUE(finite(p.xyz())) << what;
        if (degenerate && !exact_) return;
        ASSERT_EQ(cpu.reports, vulkan.reports) << what;
        ASSERT_EQ(cpu.detail, vulkan.detail) << what;
        const std::vector<Vec4> positions(state.position.begin(), state.position.begin() + particle_count);
        const std::vector<Vec4> velocities(state.velocity.begin(), state.velocity.begin() + particle_count);
        const double relative = tolerance(state.table.kind);
        expect_same(cpu.state.position, vulkan.state.position, positions, relative, what + ", position");
        expect_same(cpu.state.velocity, vulkan.state.velocity, velocities, relative, what + ", velocity");
        if (exact_) {
            expect_same(cpu.state.compensation, vulkan.state.compensation, velocities, relative,
                        what + ", compensation");
            expect_same(cpu.state.start, vulkan.state.start, velocities, relative, what + ", start");
            ASSERT_EQ(cpu.state.kept.size(), vulkan.state.kept.size());
            for (std::size_t i = 0; i < cpu.state.kept.size(); ++i) {
                if (!state.is_row(i)) continue;
                const float ours = cpu.state.kept[i], theirs = vulkan.state.kept[i];
                // The distance is subnormal.
                ASSERT_TRUE(std::bit_cast<std::uint32_t>(ours) == std::bit_cast<std::uint32_t>(theirs) ||
                            std::abs(ours - theirs) < 1e-30f)
                    << what << ", kept " << i << ": " << ours << " and " << theirs;
            }
        }
        // Stiff constraints: the movement by a soft plate within a millisecond is less than a rounding error.
        if (way == Way::plain && !degenerate) {
            EXPECT_NE(cpu.state.position, positions) << what << " moves something";
        }
    }

    std::unique_ptr<Backend> cpu_, vulkan_;
    bool exact_ = false;
};

// Labels: no-asan
// Labels with "fused": long
TEST_P(Parity, of_every_constraint_in_every_way) {
    ASSERT_TRUE(vulkan_);
    constexpr std::pair<Way, const char*> ways[] = {{Way::project, "project"},
                                                    {Way::plain, "plain"},
                                                    {Way::side_by_side, "side by side"},
                                                    {Way::fixed_point, "fixed point"},
                                                    {Way::damp, "damp"},
                                                    {Way::project_exactly, "project exactly"},
                                                    {Way::side_by_side_exactly, "side by side, exactly"}};
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    constexpr unsigned seeds = 2;  // a degenerate and an ordinary one; more would take minutes
    // Each way of each kind is a fused program of its own, and software drivers take long to compile one.
    const std::uint32_t stride = GetParam() == std::string_view("fused") ? 4 : 1;
#else
    constexpr unsigned seeds = 4;
    constexpr std::uint32_t stride = 1;
#endif
    for (std::uint32_t kind = 0; kind < constraint_kind_count; kind += stride) {
        for (unsigned seed = 0; seed < seeds; ++seed) {
            const bool degenerate = seed % 2;
            RandomState state = random_points(seed, degenerate);
            add_rows(state, static_cast<ConstraintKind>(kind), seed + 100, degenerate);
            const ConstraintInfo& info = constraint_info(static_cast<ConstraintKind>(kind));
            for (const auto& [way, name] : ways) {
                if (exists(info, way))
                    compare(state, way, degenerate,
                            std::string(info.name) + ", " + name + ", seed " + std::to_string(seed));
            }
        }
    }
}

// Labels: no-asan
// Labels with "fused": long
TEST_P(Parity, of_rows_that_run_one_after_another) {
    ASSERT_TRUE(vulkan_);
    // All constraints share one particle, so each has its own color.
    RandomState state = random_points(7, false);
    RowList rows = make_rows(ConstraintKind::stretch);
    for (std::uint32_t r = 1; r < 200; ++r) rows.add({0, r}, {0.5f, 1e-6f, 1e-6f, 0.1f});
    state.table = pack_rows(ConstraintKind::stretch, rows, particle_count);
    ASSERT_GT(state.table.overflow(), 0u);
    for (const Way way : {Way::project, Way::plain, Way::side_by_side, Way::fixed_point, Way::damp})
        compare(state, way, false, "star");
}

// Labels: no-asan
TEST_P(Parity, of_lines) {
    ASSERT_TRUE(vulkan_);
    for (unsigned seed = 0; seed < 6; ++seed) {
        const bool degenerate = seed % 2;
        RandomState state = random_points(seed, degenerate);
        add_lines(state, seed + 100, degenerate);
        for (const Way way : {Way::project, Way::plain, Way::damp, Way::project_exactly})
            compare(state, way, degenerate, "lines, seed " + std::to_string(seed));
    }
}

INSTANTIATE_TEST_SUITE_P(, Parity, testing::Values("streamed", "fused"));

}  // namespace
}  // namespace weft
