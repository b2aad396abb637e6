// Cloth whose edges are opened while it moves.

#include "solver/model/cuts.h"
#include "sheet.h"
#include "solver/measures/pieces.h"

#include <cmath>

namespace weft::physical {
namespace {

// A square meter that hangs upright by its upper row. Even columns, so that the plane x = 0 runs along one.
std::shared_ptr<const ClothModel> make_curtain(std::uint32_t side, const ClothLayout& layout,
                                               const Fabric& fabric = {}) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    ClothModelDesc desc{
        .name = "curtain", .fabric = fabric, .layout = layout, .reserve = {.particles = 4 * side, .openings = true}};
    return make_upright(std::move(desc), std::move(mesh), [](Vec3 x) { return x.z < -0.499f; });
}

// Half of it, as a cloth of its own: `side` × (side + 1) / 2 particles.
std::shared_ptr<const ClothModel> make_half(std::uint32_t side, float center, const ClothLayout& layout,
                                            const Fabric& fabric = {}) {
    // The diagonals of the right half continue those of the left one.
    TriangleMesh mesh = make_grid({0.5f, 1}, {(side + 1) / 2, side}, GridDiagonal::alternating);
    ClothModelDesc desc{.name = "half", .fabric = fabric, .layout = layout};
    return make_upright(
        std::move(desc), std::move(mesh), [](Vec3 x) { return x.z < -0.499f; }, center);
}

SolverDesc solver_with(bool lines) {
    return {.substeps = 20, .projection = lines ? Projection::lines : Projection::gauss_seidel, .hierarchy = lines};
}

// A soft pull to the side makes both halves swing.
WorldSettings pulled(bool lines) {
    return {.gravity = {0.3f, -9.81f, 1}, .solver = solver_with(lines)};
}

std::vector<Opening> down_the_middle(const World& world, ClothId id) {
    return openings_along_plane(*world.model(id), world.frame().cloths[0].positions, {}, {1, 0, 0});
}

TEST(Cuts, part_a_sheet_into_what_two_sheets_of_half_the_width_are) {
    constexpr std::uint32_t side = 33;
    for (const bool lines : {true, false}) {
        const ClothLayout layout{.lines = lines, .hierarchy = lines};
        Fabric fabric;
        fabric.body.damping = 0.01f;
        World cut = make_world(pulled(lines)), twins = make_world(pulled(lines));
        const ClothId id = cut.add(make_curtain(side, layout, fabric));
        ASSERT_TRUE(cut.edit(id, {.openings = down_the_middle(cut, id)}).ok());
        EXPECT_EQ(cut.model(id)->copied_from.size(), side);
        twins.add(make_half(side, -0.25f, layout, fabric));
        twins.add(make_half(side, 0.25f, layout, fabric));
        run(cut, 4), run(twins, 4);
        const auto& whole = cut.frame().cloths[0];
        double squared = 0, farthest = 0;
        std::size_t count = 0;
        for (std::size_t half = 0; half < 2; ++half) {
            const ClothFrame& twin = twins.frame().cloths[half];
            for (std::uint32_t p = 0; p < twin.positions.size(); ++p) {
                const std::uint32_t row = p / ((side + 1) / 2), column = p % ((side + 1) / 2);
                std::uint32_t q = row * side + column + (half == 1 ? side / 2 : 0);
                const bool on_cut = column == (half == 0 ? side / 2 : 0);
                // One of the two particles on the cut is the original, the other a copy: the nearer one is meant.
                const auto distance = [&](std::uint32_t other) {
                    return static_cast<double>(length(whole.positions[other].xyz() - twin.positions[p].xyz()));
                };
                double d = distance(q);
                for (std::uint32_t copy = side * side; on_cut && copy < whole.positions.size(); ++copy)
                    if (cut.model(id)->copied_from[copy - side * side] == q) d = std::min(d, distance(copy));
                squared += d * d, farthest = std::max(farthest, d), ++count;
            }
        }
        const double rms = std::sqrt(squared / static_cast<double>(count));
        RecordProperty(lines ? "rms_lines_mm" : "rms_mm", std::to_string(1000 * rms));
        EXPECT_LT(rms, 0.002) << "farthest " << farthest;
        EXPECT_EQ(cut.frame().reports, report_none);
    }
}

TEST(Cuts, leave_no_pull_between_the_pieces) {
    const ClothLayout layout{.lines = true, .hierarchy = true};
    const auto run_with = [&](bool dragged) {
        World world = make_world({.solver = solver_with(true)});
        const ClothId id = world.add(make_curtain(17, layout));
        EXPECT_TRUE(world.edit(id, {.openings = down_the_middle(world, id)}).ok());
        run(world, 0.5);
        if (dragged) {
            KinematicTargets targets;
            targets.motions.push_back({.offsets = {{0, {}}, {0.5f, {}}, {1, {1, 0.2f, 0}}}});
            std::vector<std::uint32_t> pinned;
            const auto& model = *world.model(id);
            for (std::uint32_t p = 0; p < model.particle_count; ++p) {
                if (model.start[p].w > 0) continue;
                pinned.push_back(p);
                const bool right = model.rest_position(p).x > 0.01f;
                if (right) targets.particles.push_back({p, 0, model.rest_position(p)});
            }
            EXPECT_TRUE(world.set_pins(id, pinned, targets).ok());
        }
        run(world, 1);
        return std::vector<Vec4>(world.frame().cloths[0].positions.begin(), world.frame().cloths[0].positions.end());
    };
    const auto still = run_with(false), dragged = run_with(true);
    double left = 0, right = 0;
    for (std::uint32_t p = 0; p < 17 * 17; ++p) {
        const double moved = static_cast<double>(length(still[p].xyz() - dragged[p].xyz()));
        if (p % 17 < 8) left = std::max(left, moved);
        if (p % 17 > 8) right = std::max(right, moved);
    }
    EXPECT_GT(right, 0.9);
    EXPECT_LT(left, 1e-4);
}

// Labels: no-asan
TEST(Cuts, go_on_with_the_same_bits_after_a_restore_and_in_every_number_of_threads) {
    const auto model = make_curtain(33, {.lines = true, .hierarchy = true});
    std::string hash;
    for (const unsigned workers : {0u, 1u, 3u}) {
        World world = make_world({.solver = solver_with(true)}, CpuOptions{.workers = workers});
        const ClothId id = world.add(model);
        run(world, 0.1);
        ASSERT_TRUE(world.edit(id, {.openings = down_the_middle(world, id)}).ok());
        run(world, 0.1);
        const Snapshot middle = world.save();
        run(world, 0.1);
        if (hash.empty()) hash = world.state_hash();
        EXPECT_EQ(world.state_hash(), hash) << workers << " workers";
        World other = make_world({.solver = solver_with(true)}, CpuOptions{.workers = workers});
        other.add(model);
        ASSERT_TRUE(other.restore(*snapshot_from_bytes(to_bytes(middle))).ok());
        run(other, 0.1);
        EXPECT_EQ(other.state_hash(), hash);
    }
}

// The largest strain of edges at the cut, along it. Without lines of their own, the second halves would stretch.
TEST(Cuts, keep_both_sides_of_the_cut_short) {
    World world = make_world({.solver = solver_with(true)});
    const ClothId id = world.add(make_curtain(33, {.lines = true, .hierarchy = true}));
    ASSERT_TRUE(world.edit(id, {.openings = down_the_middle(world, id)}).ok());
    run(world, 2);
    const ClothMeasures measures = world.measure();
    EXPECT_LT(measures.strain.stretch.mean, 0.002);
    EXPECT_LT(measures.strain.stretch.max, 0.02);
}

TEST(Cuts, are_counted_by_edges_and_pieces) {
    World world = make_world({.solver = solver_with(true)});
    const ClothId id = world.add(make_curtain(17, {}));
    const auto pieces = [&] { return find_pieces(world.frame()); };
    EXPECT_EQ(pieces().torn_edges, 0u);
    EXPECT_EQ(pieces().count, 1u);
    EXPECT_EQ(pieces().smallest.part, 1);
    // A slit parts nothing.
    const std::vector<Vec3> slit{{-0.25f, 0.25f, 0}, {-0.25f, -0.25f, 0}};
    const auto& positions = world.frame().cloths[0].positions;
    ASSERT_TRUE(world.edit(id, {.openings = openings_along_stroke(*world.model(id), positions, slit)}).ok());
    EXPECT_EQ(pieces().torn_edges, 8u);
    EXPECT_EQ(pieces().count, 1u);
    ASSERT_TRUE(world
                    .edit(id, {.openings = openings_along_plane(*world.model(id), world.frame().cloths[0].positions,
                                                                {0.25f, 0, 0}, {1, 0, 0})})
                    .ok());
    EXPECT_EQ(pieces().torn_edges, 8u + 16u);
    EXPECT_EQ(pieces().count, 2u);
    EXPECT_EQ(pieces().smallest.triangles, 4u * 16 * 2);
    EXPECT_NEAR(pieces().smallest.part, 0.25, 1e-6);
    EXPECT_EQ(pieces().smallest.cloth, 0u);
    // Another cloth without a tear table, smaller but whole.
    world.add(make_half(17, 3, {}));
    EXPECT_EQ(pieces().count, 3u);
    EXPECT_NEAR(pieces().smallest.part, 0.25, 1e-6);
}

// One half is moved through the plane of the other one, where the rims meet. They coincide at rest.
TEST(Cuts, leave_rims_that_do_not_pass_through_each_other) {
    constexpr std::uint32_t side = 17;
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    ClothModelDesc desc{.name = "curtain",
                        .collision = {SelfCollision::exact},
                        .layout = {.lines = true, .hierarchy = true},
                        .reserve = {.particles = 100, .openings = true}};
    const auto model =
        make_upright(std::move(desc), std::move(mesh), [](Vec3 x) { return x.z < -0.499f && std::abs(x.x) > 0.1f; });
    // To and fro through the other half's plane, rim against rim.
    std::vector<OffsetKey> keys{{0, {}}, {0.2f, {-0.02f, 0, 0.01f}}};
    for (int i = 0; i < 6; ++i)
        keys.push_back({0.4f + 0.3f * static_cast<float>(i), {0.01f, 0, i % 2 == 0 ? -0.04f : 0.04f}});
    KinematicTargets targets{.motions = {{.offsets = keys}}, .particles = {}};
    for (std::uint32_t p = 0; p < model->particle_count; ++p)
        if (const Vec3 x = model->rest_position(p); x.x < -0.1f && !(model->start[p].w > 0))
            targets.particles.push_back({p, 0, x});
    World world = make_world({.solver = solver_with(true)});
    const ClothId id = world.add(model, targets);
    ASSERT_TRUE(world.edit(id, {.openings = down_the_middle(world, id)}).ok());
    std::uint64_t tangled = 0;
    for (int i = 0; i < 120; ++i) tangled += world.step(1.0 / 60).cloth_contacts.tangled;
    EXPECT_EQ(tangled, 0u);
}

/// State hash of a curtain that gets room for cuts while it hangs, and is cut.
std::string cut_after_room(World world) {
    const ClothLayout layout{.lines = true, .hierarchy = true};
    TriangleMesh mesh = make_grid({1, 1}, {17, 17}, GridDiagonal::alternating);
    const auto model = make_upright({.name = "curtain", .layout = layout}, mesh, [](Vec3 x) { return x.z < -0.499f; });
    const ClothId id = world.add(model);
    run(world, 0.1);
    const std::string before = world.state_hash();
    const TriangleMesh& upright = model->mesh();
    const auto roomy = change_cloth_model(*model, upright, *build_topology(upright, {.reorder = false}),
                                          {.fabric = model->fabric,
                                           .pins = {.particles = pinned_particles(*model)},
                                           .layout = layout,
                                           .reserve = ClothReserve{.particles = 100, .openings = true}});
    EXPECT_TRUE(roomy.ok() && world.set_model_with_room(id, *roomy, {}));
    EXPECT_EQ(world.state_hash(), before);
    run(world, 0.1);
    EXPECT_TRUE(world.edit(id, {.openings = down_the_middle(world, id)}).ok());
    run(world, 0.1);
    EXPECT_EQ(world.model(id)->copied_from.size(), 17u);
    return world.state_hash();
}

TEST(Cuts, open_a_cloth_that_got_room_while_it_moved) {
    EXPECT_EQ(cut_after_room(make_world(pulled(true))), cut_after_room(make_world(pulled(true))));
}

#ifdef WEFT_VULKAN
// Labels: no-asan
TEST(Cuts, of_a_cloth_that_got_room_are_the_same_on_both_backends) {
    World device(checked_vulkan_backend({}), pulled(true));
    const bool exact = rounds_like_the_cpu(device);
    const std::string on_device = cut_after_room(std::move(device)),
                      on_cpu = cut_after_room(make_world(pulled(true), CpuOptions{}));
    if (exact) {
        EXPECT_EQ(on_device, on_cpu);
    }
}

// Labels: no-asan
TEST(Cuts, are_the_same_on_both_backends) {
    for (const bool lines : {true, false}) {
        const auto model = make_curtain(33, {.lines = lines, .hierarchy = lines});
        const auto hash_of = [&](World world) {
            const ClothId id = world.add(model);
            run(world, 0.1);
            // A slit across the cut, so that lines of all directions end and go on.
            const std::vector<Vec3> stroke{{-0.3f, -0.1f, 0}, {0.25f, 0.1f, 0}};
            for (int i = 0; i < 2; ++i) {
                const auto openings =
                    i == 0 ? openings_along_stroke(*world.model(id), world.frame().cloths[0].positions, stroke)
                           : down_the_middle(world, id);
                EXPECT_TRUE(world.edit(id, {.openings = openings}).ok());
                run(world, 0.1);
            }
            return world.state_hash();
        };
        World device(checked_vulkan_backend({}), pulled(lines));
        const bool exact = rounds_like_the_cpu(device);
        const std::string on_device = hash_of(std::move(device)),
                          on_cpu = hash_of(make_world(pulled(lines), CpuOptions{}));
        if (exact) {
            EXPECT_EQ(on_device, on_cpu);
        }
    }
}
#endif

}  // namespace
}  // namespace weft::physical
