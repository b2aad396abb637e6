// Constraints, triangles and particles that change while a cloth moves.

#include "sheet.h"
#include "solver/model/cut.test.h"
#include "solver/world/backend_without_room.test.h"

#include <cmath>
#include <limits>

namespace weft::physical {
namespace {

using test::cut;

constexpr std::uint32_t side = 17;

// A sheet that hangs upright by its two upper corners, with room for a cut down its middle.
std::shared_ptr<const ClothModel> make_cuttable(const ClothLayout& layout, ClothReserve reserve = {32, 128}) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::alternating);
    ClothModelDesc desc{.name = "sheet", .layout = layout, .reserve = reserve};
    return make_upright(std::move(desc), std::move(mesh), [](Vec3 x) { return x.z < -0.49f && std::abs(x.x) > 0.49f; });
}

ClothEdit cut_in_two(const ClothModel& model) {
    const auto column = [&](std::uint32_t p) { return std::lround(model.rest_position(p).x * (side - 1)); };
    return cut(
        model, [&](std::uint32_t p) { return column(p) == 0; }, [&](std::uint32_t p) { return column(p) > 0; });
}

const ClothFrame& cloth_of(const World& world) {
    return world.frame().cloths[0];
}

struct Halves {
    Vec3 left, right;
    double mass = 0;
};
Halves halves(const World& world) {
    const ClothFrame& cloth = cloth_of(world);
    const ClothModel& model = *cloth.model;
    Halves sum;
    double left = 0, right = 0;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const bool on_right = model.rest_position(p).x > 0.01f || p >= side * side;
        (on_right ? sum.right : sum.left) += cloth.positions[p].xyz() * model.mass[p];
        (on_right ? right : left) += model.mass[p];
    }
    sum.left = sum.left * static_cast<float>(1 / left), sum.right = sum.right * static_cast<float>(1 / right);
    sum.mass = left + right;
    return sum;
}

// After the cut no constraint and no triangle joins particles of both halves.
void expect_two_pieces(const ClothModel& model) {
    const auto half_of = [&](std::uint32_t p) { return p >= side * side || model.rest_position(p).x > 0.01f; };
    for (std::uint32_t t = 0; t < model.triangle_count; ++t) {
        const auto [a, b, c] = model.triangles()[t];
        EXPECT_TRUE(half_of(a) == half_of(b) && half_of(b) == half_of(c)) << "triangle " << t;
    }
    for (const ConstraintTable& table : model.constraints) {
        for (std::uint32_t row = 0; row < table.stride; ++row) {
            if (!table.is_real(row)) continue;
            for (std::uint32_t slot = 1; slot < table.arity; ++slot) {
                const std::uint32_t p = table.particles[std::size_t{slot} * table.stride + row];
                if (table.is_dummy(p)) continue;
                EXPECT_EQ(half_of(p), half_of(table.particles[row])) << constraint_info(table.kind).name << ' ' << row;
            }
        }
    }
}

// Labels on Vulkan: long
TEST(Edits, cut_a_sheet_in_two) {
    for (const ClothLayout layout : {ClothLayout{}, ClothLayout{.lines = true, .hierarchy = true}}) {
        const auto model = make_cuttable(layout);
        World world = make_world({.solver = {.substeps = 20,
                                             .projection = layout.lines ? Projection::lines : Projection::gauss_seidel,
                                             .hierarchy = layout.hierarchy}});
        const ClothId id = world.add(model);
        run(world, 0.2);
        const double mass = halves(world).mass;
        ASSERT_TRUE(world.edit(id, cut_in_two(*model)).ok());
        expect_two_pieces(*world.model(id));
        EXPECT_NEAR(halves(world).mass, mass, 1e-6 * mass);
        EXPECT_GT(cloth_of(world).topology_version, first_topology_version);
        EXPECT_EQ(cloth_of(world).positions.size(), side * side + side);
        EXPECT_TRUE(std::ranges::equal(world.model(id)->copied_from, cut_in_two(*model).appended));
        EXPECT_EQ(cloth_of(world).render_mesh().positions.size(), side * side + side);
        EXPECT_EQ(cloth_of(world).render_mesh().triangles.size(), model->triangle_count);
        run(world, 1.5);
        EXPECT_EQ(world.frame().reports, report_none);
        // Each half hangs by its own corner now, and swings outward below it.
        EXPECT_LT(halves(world).left.x, -0.3f);
        EXPECT_GT(halves(world).right.x, 0.3f);
        EXPECT_LT(world.measure().strain.stretch.mean, 0.02);
    }
}

TEST(Edits, of_nothing_change_no_bit) {
    std::string hash[2];
    for (const bool edited : {false, true}) {
        World world = make_world({.solver = {.substeps = 10}});
        const auto model = make_cuttable({.lines = true}, edited ? ClothReserve{32, 128} : ClothReserve{});
        world.add(model);
        run(world, 0.3);
        hash[edited] = world.state_hash();
    }
    EXPECT_EQ(hash[0], hash[1]) << "what is in reserve does nothing";
}

TEST(Edits, go_on_with_the_same_bits_after_a_restore) {
    const auto model = make_cuttable({.lines = true});
    const ClothEdit edit = cut_in_two(*model);
    const auto begin = [&] {
        World world = make_world({.solver = {.substeps = 10}});
        world.add(model);
        return world;
    };
    World world = begin();
    const ClothId id = world.cloth_id(0);
    run(world, 0.2);
    const Snapshot whole = world.save();
    const std::string hash_of_whole = world.state_hash();
    ASSERT_TRUE(world.edit(id, edit).ok());
    EXPECT_NE(world.state_hash(), hash_of_whole);
    run(world, 0.2);
    const auto bytes = to_bytes(world.save());
    run(world, 0.3);

    World other = begin();
    const auto torn = snapshot_from_bytes(bytes);
    ASSERT_TRUE(torn.ok());
    ASSERT_TRUE(other.restore(*torn).ok());
    EXPECT_GT(cloth_of(other).topology_version, first_topology_version);
    run(other, 0.3);
    EXPECT_EQ(other.state_hash(), world.state_hash());

    ASSERT_TRUE(other.restore(whole).ok());
    EXPECT_EQ(other.state_hash(), hash_of_whole) << "whole again";
    EXPECT_EQ(cloth_of(other).positions.size(), side * side);
    ASSERT_TRUE(other.edit(other.cloth_id(0), edit).ok());
    run(other, 0.5);
    EXPECT_EQ(other.state_hash(), world.state_hash());
}

TEST(Edits, of_all_cloths_are_restored_or_of_none) {
    int failing = -1;
    auto cpu = make_cpu_backend(CpuOptions{});
    ASSERT_TRUE(cpu.ok());
    World world(std::make_unique<BackendWithoutRoom>(std::move(*cpu), failing), {.solver = {.substeps = 5}});
    const auto model = make_cuttable({.lines = true});
    world.add(model), world.add(model);
    run(world, 0.1);
    const Snapshot whole = world.save();
    for (const std::size_t i : {0u, 1u}) ASSERT_TRUE(world.edit(world.cloth_id(i), cut_in_two(*model)).ok());
    run(world, 0.1);
    const std::string hash = world.state_hash();
    failing = 3;  // two edits, the first of the restored cloths, the second
    const auto refused = world.restore(whole);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().message(), "device: has no room");
    EXPECT_EQ(world.state_hash(), hash);
    EXPECT_EQ(world.frame().cloths[0].positions.size(), world.frame().cloths[1].positions.size());
    failing = -1;
    ASSERT_TRUE(world.restore(whole).ok());
    EXPECT_NE(world.state_hash(), hash);
}

TEST(Edits, stay_when_a_frame_is_not_finite) {
    const auto model = make_cuttable({.lines = true});
    World world = make_world({.solver = {.substeps = 10}});
    const ClothId id = world.add(model);
    ASSERT_TRUE(world.edit(id, cut_in_two(*model)).ok());
    run(world, 0.2);
    const std::string before = world.state_hash();
    WorldSettings settings = world.settings();
    settings.gravity.y = std::nanf("");
    world.configure(settings);
    world.step(1.0 / 60);
    EXPECT_TRUE(world.frame().reports & report_non_finite);
    EXPECT_EQ(world.state_hash(), before);
}

TEST(Edits, keep_fabrics_and_pins_changeable) {
    const auto model = make_cuttable({.lines = true});
    const ClothEdit edit = cut_in_two(*model);
    Fabric stiff = model->fabric;
    stiff.stretch.stretch[0] *= 3;
    stiff.body.density *= 2;
    std::string hash[2];
    for (const bool fabric_first : {false, true}) {
        World world = make_world({.solver = {.substeps = 10}});
        const ClothId id = world.add(model);
        const auto change_fabric = [&] {
            auto changed = with_fabric(*world.model(id), stiff);
            ASSERT_TRUE(changed.ok() && *changed);
            ASSERT_TRUE(world.set_material(id, *changed).ok());
        };
        if (fabric_first) change_fabric();
        ASSERT_TRUE(world.edit(id, edit).ok());
        if (!fabric_first) change_fabric();
        ASSERT_TRUE(world.set_pins(id, {0, side * side}, {}).ok()) << "a copy can be pinned";
        run(world, 0.5);
        hash[fabric_first] = world.state_hash();
        EXPECT_EQ(cloth_of(world).positions[side * side].w, 0);
    }
    EXPECT_EQ(hash[0], hash[1]);
}

TEST(Edits, end_and_weaken_single_constraints_and_triangles) {
    const auto model = make_cuttable({});
    const ConstraintTable& rows = model->table(ConstraintKind::stretch);
    const auto as_it_is = [&](std::uint32_t row, float stiffness) {
        return RowEdit{
            ConstraintKind::stretch, row, {rows.particles[row], rows.particles[rows.stride + row]}, stiffness};
    };
    const auto edited = with_edit(*model, {.rows = {as_it_is(0, 0.25f), as_it_is(1, 0)}});
    ASSERT_TRUE(edited.ok());
    const ConstraintTable& now = (*edited)->table(ConstraintKind::stretch);
    EXPECT_FLOAT_EQ(now.fields[now.stride], 4 * rows.fields[rows.stride]);
    EXPECT_FALSE(now.is_real(1));
    EXPECT_EQ(now.rows, rows.rows - 1);
    EXPECT_EQ((*edited)->topology_version, model->topology_version);
    EXPECT_FALSE(with_edit(**edited, {.rows = {as_it_is(1, 0)}}).ok()) << "it has been removed already";

    const auto holed = with_edit(*model, {.triangles = {{.triangle = 5, .corners = {0, 1, 2}, .alive = 0}}});
    ASSERT_TRUE(holed.ok());
    EXPECT_FALSE(with_edit(**holed, {.triangles = {{.triangle = 5, .corners = {0, 1, 2}}}}).ok()) << "gone for good";
    double before = 0, after = 0;
    for (std::uint32_t p = 0; p < model->particle_count; ++p) before += model->mass[p], after += (*holed)->mass[p];
    EXPECT_NEAR(before - after, model->fabric.body.density * model->face_area[5], 1e-6);
}

TEST(Edits, that_cannot_be_are_refused_and_change_nothing) {
    const auto model = make_cuttable({.lines = true}, {2, 1});
    World world = make_world({.solver = {.substeps = 5}});
    const ClothId id = world.add(model);
    run(world, 0.1);
    const std::string before = world.state_hash();
    const ConstraintTable& rows = model->table(ConstraintKind::stretch);
    const std::array ends = {rows.particles[0], rows.particles[rows.stride]};
    const auto stretch = [&](std::uint32_t row, std::uint32_t a, std::uint32_t b, float stiffness = 1) {
        return RowEdit{ConstraintKind::stretch, row, {a, b}, stiffness};
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ClothEdit wrong[] = {
        {.appended = {0, 1, 2}},
        {.appended = {model->particle_count}},
        {.triangles = {{.triangle = model->triangle_count, .corners = {0, 1, 2}}}},
        {.triangles = {{.triangle = 0, .corners = {0, 0, 2}}}},
        {.triangles = {{.triangle = 0, .corners = {0, 1, model->particle_count}}}},
        {.rows = {stretch(rows.stride, 0, 1)}},
        {.rows = {stretch(0, ends[0], ends[1], nan)}},
        {.rows = {stretch(0, ends[0], ends[1], -1)}},
        {.rows = {stretch(0, ends[1], ends[0])}},
        {.rows = {stretch(0, ends[0], ends[1], 1e-30f)}},
        {.added = {stretch(0, 5, 5)}},
        {.added = {stretch(0, 0, 5), stretch(0, 0, 6)}},
        {.added = {stretch(0, 0, 5, 0)}},
        {.added = {stretch(0, 0, 100'000)}},
        {.rows = {RowEdit{ConstraintKind::plate, 0, {}, 1}}},
        {.rows = {RowEdit{ConstraintKind::adhesion, 0, {}, 0}}},
    };
    for (const ClothEdit& edit : wrong) {
        const auto done = world.edit(id, edit);
        EXPECT_FALSE(done.ok()) << &edit - wrong;
        EXPECT_TRUE(done.ok() || !done.error().message().empty());
    }
    EXPECT_EQ(world.state_hash(), before);
    Snapshot snapshot = world.save();
    snapshot.cloths[0].edits.push_back(wrong[0]);
    EXPECT_FALSE(world.restore(snapshot).ok());
    EXPECT_EQ(world.state_hash(), before);

    // Constraints of one batch are projected in parallel, so no two may share a particle.
    const auto plain = make_cuttable({});
    const ConstraintTable& batch = plain->table(ConstraintKind::stretch);
    const std::uint32_t second = batch.particles[1];
    EXPECT_FALSE(with_edit(*plain, {.rows = {stretch(0, second, batch.particles[batch.stride])}}).ok());
}

#ifdef WEFT_VULKAN
TEST(Edits, are_the_same_on_both_backends) {
    const auto model = make_cuttable({.lines = true, .hierarchy = true});
    const auto hash_of = [&](World world) {
        const ClothId id = world.add(model);
        run(world, 0.1);
        EXPECT_TRUE(world.edit(id, cut_in_two(*model)).ok());
        run(world, 0.2);
        return world.state_hash();
    };
    const WorldSettings settings{.solver = {.substeps = 5, .hierarchy = true}};
    World device(checked_vulkan_backend({}), settings);
    if (device.backend().device().find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "equal bits are promised where a device rounds divisions and roots as IEEE 754 says";
    EXPECT_EQ(hash_of(std::move(device)), hash_of(make_world(settings, CpuOptions{})));
}
#endif

}  // namespace
}  // namespace weft::physical
