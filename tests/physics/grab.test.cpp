// Grabs pull cloth with a limited force, follow their triangle, and belong to the saved state.

#include "sheet.h"

#include "solver/state/snapshot.h"

#include <array>
#include <cmath>
#include <random>

namespace weft::physical {
namespace {

constexpr Vec3 middle{1.0f / 3, 1.0f / 3, 1.0f / 3};

Vec3 rest_of(const ClothModel& model, std::uint32_t triangle, Vec3 weights = middle) {
    const Triangle t = model.triangles()[triangle];
    return model.rest_position(t[0]) * weights.x + model.rest_position(t[1]) * weights.y +
           model.rest_position(t[2]) * weights.z;
}

struct Grabbed {
    World world;
    ClothId cloth;
    std::uint32_t triangle = 0;
    Vec3 start;  ///< of the point in the middle of the triangle
    GrabId id;
};

SheetDesc flat(std::uint32_t side = 17) {
    return {.resolution = {side, side}, .layout = {.lines = true, .hierarchy = true}};
}

// A sheet that is grabbed in its middle.
Grabbed grab_sheet(World world, const SheetDesc& sheet, const GrabDesc& spring = {}) {
    Grabbed made{std::move(world), {}, 0, {}, {}};
    made.cloth = made.world.add(make_sheet(sheet));
    const ClothModel& model = *made.world.model(made.cloth);
    made.triangle = model.triangle_count / 2 + sheet.resolution[0] - 1;
    made.start = rest_of(model, made.triangle);
    made.id = made.world.grab(made.cloth, made.triangle, middle, made.start, spring);
    return made;
}

Grabbed grab_sheet(const SheetDesc& sheet, const GrabDesc& spring = {}, SolverDesc solver = {.substeps = 20}) {
    return grab_sheet(make_world({.solver = solver}), sheet, spring);
}

double weight_of(const ClothModel& model) {
    double mass = 0;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) mass += model.mass[p];
    return 9.81 * mass;
}

TEST(Grab, carries_a_sheet_and_pulls_with_its_weight) {
    Grabbed sheet = grab_sheet(flat());
    sheet.world.move_grab(sheet.id, sheet.start + Vec3{0.3f, 0.5f, 0});
    double pull = 0;
    run(sheet.world, 4);
    for (int i = 0; i < 60; ++i) {
        sheet.world.step(1.0 / 60);
        pull += sheet.world.grab_force(sheet.id).y / 60;
        EXPECT_LT(length(sheet.world.grab_position(sheet.id) - sheet.start - Vec3{0.3f, 0.5f, 0}), 1e-3f);
    }
    const double weight = weight_of(*sheet.world.model(sheet.cloth));
    EXPECT_NEAR(pull, weight, 0.1 * weight);
    EXPECT_EQ(sheet.world.frame().reports, 0u);
}

TEST(Grab, on_a_spring_gives_way_by_its_compliance) {
    Grabbed sheet = grab_sheet(flat(), {.compliance = 0.02f, .damping = 0.1f});
    run(sheet.world, 6);
    const double weight = weight_of(*sheet.world.model(sheet.cloth));
    double sag = 0;
    for (int i = 0; i < 60; ++i) {
        sheet.world.step(1.0 / 60);
        sag += (sheet.start - sheet.world.grab_position(sheet.id)).y / 60;
    }
    EXPECT_NEAR(sag, 0.02 * weight, 0.05 * 0.02 * weight);
}

// Labels on Vulkan: no-asan long
TEST(Grab, never_pulls_more_than_its_limit) {
    for (const float limit : {0.5f, 20.0f}) {
        SheetDesc hung = hung_upright({.lines = true, .hierarchy = true});
        Grabbed sheet = grab_sheet(hung, {.max_force = limit});
        run(sheet.world, 0.5);
        sheet.world.move_grab(sheet.id, sheet.start + Vec3{0, -2, 10});
        for (int i = 0; i < 60; ++i) {
            sheet.world.step(1.0 / 60);
            EXPECT_LT(length(sheet.world.grab_force(sheet.id)), limit * 1.000001f);
        }
        EXPECT_GT(length(sheet.world.grab_force(sheet.id)), 0.99f * limit);
        EXPECT_GT(length(sheet.world.grab_position(sheet.id) - sheet.start - Vec3{0, -2, 10}), 5.0f);
    }
}

TEST(Grab, arrives_without_swinging_when_its_target_jumps) {
    for (const float compliance : {0.0f, 1e-3f}) {
        World world = make_world({.gravity = {}, .solver = {.substeps = 20}});
        Grabbed sheet = grab_sheet(std::move(world), flat(33), {.max_force = 50, .compliance = compliance});
        sheet.world.move_grab(sheet.id, sheet.start + Vec3{0.1f, 0, 0});
        for (int i = 0; i < 60; ++i) {
            sheet.world.step(1.0 / 60);
            const float way = sheet.world.grab_position(sheet.id).x - sheet.start.x;
            EXPECT_LT(way, compliance > 0 ? 0.115f : 0.102f) << i;
            if (i > 15) {
                EXPECT_NEAR(way, 0.1f, compliance > 0 ? 0.01f : 1e-3f) << i;
            }
        }
    }
}

TEST(Grab, survives_wild_targets_and_leaves_a_calm_cloth) {
    for (const float limit : {1.0f, 20.0f, 1e6f}) {
        World air = make_world({.solver = {.substeps = 20}, .air = AirDesc{}});
        Grabbed sheet =
            grab_sheet(std::move(air), hung_upright({.lines = true, .hierarchy = true}), {.max_force = limit});
        std::mt19937 random(1);
        const auto number = [&] { return (static_cast<float>(random()) / 4294967296.0f - 0.5f) * 2e6f; };
        for (int i = 0; i < 300; ++i) {
            const float x = number(), y = number(), z = number();
            sheet.world.move_grab(sheet.id, {x, y, z});
            sheet.world.step(1.0 / 60);
            ASSERT_FALSE(sheet.world.frame().reports & report_non_finite) << limit << ", frame " << i;
            EXPECT_LE(length(sheet.world.grab_force(sheet.id)), limit * 1.000001f);
        }
        sheet.world.release(sheet.id);
        run(sheet.world, 10);
        EXPECT_LT(max_speed(sheet.world.frame()), 0.5);
        EXPECT_LT(sheet.world.measure().strain.stretch.max, 0.2);
    }
}

TEST(Grab, does_nothing_at_a_pinned_triangle) {
    SheetDesc pinned = flat();
    pinned.pinned = [](Vec3) { return true; };
    Grabbed sheet = grab_sheet(pinned);
    sheet.world.move_grab(sheet.id, {0, 5, 0});
    run(sheet.world, 0.2);
    EXPECT_EQ(length(sheet.world.grab_position(sheet.id) - sheet.start), 0);
    EXPECT_EQ(length(sheet.world.grab_force(sheet.id)), 0);
}

TEST(Grab, moves_only_the_free_corners_of_a_half_pinned_triangle) {
    SheetDesc hung = hung_upright();
    Grabbed sheet{make_world({.solver = {.substeps = 20}}), {}, 0, {}, {}};
    sheet.cloth = sheet.world.add(make_sheet(hung));
    const ClothModel& model = *sheet.world.model(sheet.cloth);
    for (; model.triangles()[sheet.triangle][0] != 0 && model.triangles()[sheet.triangle][1] != 0 &&
           model.triangles()[sheet.triangle][2] != 0;)
        ++sheet.triangle;
    sheet.id = sheet.world.grab(sheet.cloth, sheet.triangle, middle, rest_of(model, sheet.triangle) + Vec3{0, 0, 1},
                                {.max_force = 5});
    run(sheet.world, 0.3);
    EXPECT_EQ(sheet.world.frame().cloths[0].positions[0].xyz(), model.rest_position(0));
    EXPECT_NEAR(length(sheet.world.grab_force(sheet.id)), 5, 0.05);
}

TEST(Grab, several_hold_one_cloth_and_one_triangle) {
    Grabbed sheet = grab_sheet(flat());
    const GrabId same = sheet.world.grab(sheet.cloth, sheet.triangle, middle, sheet.start);
    const Vec3 corner = rest_of(*sheet.world.model(sheet.cloth), 0, {1, 0, 0});
    const GrabId other = sheet.world.grab(sheet.cloth, 0, {1, 0, 0}, corner);
    run(sheet.world, 3);
    EXPECT_LT(length(sheet.world.grab_position(sheet.id) - sheet.start), 1e-3f);
    EXPECT_LT(length(sheet.world.grab_position(other) - corner), 1e-3f);
    sheet.world.release(same);
    EXPECT_FALSE(sheet.world.contains(same));
    sheet.world.release(sheet.id);
    run(sheet.world, 1);
    EXPECT_LT(length(sheet.world.grab_position(other) - corner), 1e-3f);
    sheet.world.remove(sheet.cloth);
    EXPECT_FALSE(sheet.world.contains(other));
    sheet.world.step(1.0 / 60);
}

TEST(Grab, that_is_released_leaves_no_trace) {
    Grabbed sheet = grab_sheet(flat());
    sheet.world.release(sheet.id);
    World other = make_world({.solver = {.substeps = 20}}, flat());
    run(sheet.world, 0.2);
    run(other, 0.2);
    EXPECT_EQ(sheet.world.state_hash(), other.state_hash());
}

// The passes of one cloth's grab do not change another cloth.
TEST(Grab, leaves_other_cloths_alone) {
    SheetDesc apart = flat();
    apart.position = {3, 0, 0};
    Grabbed sheet = grab_sheet(flat());
    sheet.world.add(make_sheet(apart));
    World other = make_world({.solver = {.substeps = 20}}, apart);
    run(sheet.world, 0.3);
    run(other, 0.3);
    const auto one = sheet.world.frame().cloths[1].positions, two = other.frame().cloths[0].positions;
    EXPECT_TRUE(std::ranges::equal(one, two));
}

TEST(Grab, goes_on_with_the_same_bits_in_a_restored_world) {
    Grabbed sheet = grab_sheet(flat(), {.compliance = 1e-3f});
    sheet.world.move_grab(sheet.id, sheet.start + Vec3{0.2f, 0.3f, 0});
    run(sheet.world, 0.1);
    sheet.world.move_grab(sheet.id, sheet.start + Vec3{0.4f, 0.3f, 0});  // on its way
    const Snapshot saved = sheet.world.save();
    const std::string hash_then = sheet.world.state_hash();
    run(sheet.world, 0.3);
    const std::string hash = sheet.world.state_hash();
    sheet.world.release(sheet.id);
    run(sheet.world, 0.1);
    const auto bytes = snapshot_from_bytes(to_bytes(saved));
    ASSERT_TRUE(bytes.ok());
    ASSERT_TRUE(sheet.world.restore(*bytes).ok());
    EXPECT_TRUE(sheet.world.contains(sheet.id));
    EXPECT_EQ(sheet.world.state_hash(), hash_then);
    run(sheet.world, 0.3);
    EXPECT_EQ(sheet.world.state_hash(), hash);

    World other = make_world({.solver = {.substeps = 20}}, flat());
    ASSERT_TRUE(other.restore(*bytes).ok());
    run(other, 0.3);
    EXPECT_EQ(other.state_hash(), hash);
    const GrabId next = other.grab(other.cloth_id(0), 0, middle, {});
    EXPECT_NE(next, sheet.id);
}

TEST(Grab, in_a_saved_state_is_checked) {
    Grabbed sheet = grab_sheet(flat());
    const Snapshot good = sheet.world.save();
    const auto refused = [&](auto&& change) {
        Snapshot bad = good;
        change(bad);
        return !sheet.world.restore(bad).ok();
    };
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs[0].cloth = 1; }));
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs[0].step.triangle = 1u << 20; }));
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs[0].step.to.x = std::nanf(""); }));
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs[0].step.weights.x = 0.5f; }));
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs[0].step.spring.max_force = 0; }));
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs[0].step.spring.max_force = 1e7f; }));
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs[0].step.spring.damping = -1; }));
    EXPECT_TRUE(refused([](Snapshot& s) { s.grabs.push_back(s.grabs[0]); }));
    EXPECT_TRUE(sheet.world.restore(good).ok());
}

// Labels on Vulkan: no-asan long
TEST(Grab, stays_when_pins_model_and_solver_change) {
    Grabbed sheet = grab_sheet(flat());
    run(sheet.world, 0.2);
    ASSERT_TRUE(sheet.world.set_pins(sheet.cloth, {0}, {}).ok());
    run(sheet.world, 0.2);
    WorldSettings settings = sheet.world.settings();
    settings.solver.substeps = 8;
    settings.solver.iterations = 2;
    sheet.world.configure(settings);
    run(sheet.world, 0.2);
    SheetDesc heavy = flat();
    heavy.fabric.body.density = 0.4f;
    ASSERT_TRUE(sheet.world.set_model(sheet.cloth, make_sheet(heavy), {}, std::vector<std::uint32_t>{}).ok());
    run(sheet.world, 2);
    EXPECT_LT(length(sheet.world.grab_position(sheet.id) - sheet.start), 1e-3f);
    EXPECT_EQ(sheet.world.frame().reports, 0u);
}

TEST(Grab, of_a_removed_triangle_is_released) {
    TriangleMesh mesh = make_grid({1, 1}, {9, 9}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    auto model = build_cloth_model({.name = "sheet", .mesh = std::move(mesh), .reserve = {.particles = 16}},
                                   std::move(*topology));
    ASSERT_TRUE(model.ok());
    World world = make_world({.solver = {.substeps = 10}});
    const ClothId cloth = world.add(*model);
    const GrabId gone = world.grab(cloth, 40, middle, rest_of(**model, 40)),
                 other = world.grab(cloth, 41, middle, rest_of(**model, 41));
    run(world, 0.1);
    ASSERT_TRUE(
        world.edit(cloth, {.triangles = {{.triangle = 40, .corners = (*model)->triangles()[40], .alive = 0}}}).ok());
    EXPECT_FALSE(world.contains(gone));
    EXPECT_TRUE(world.contains(other));
    run(world, 0.5);
    EXPECT_EQ(world.frame().reports, 0u);
}

TEST(Grab, survives_iterations_methods_and_projections) {
    for (const Method method : {Method::xpbd, Method::pbd}) {
        for (const Projection projection : {Projection::lines, Projection::gauss_seidel, Projection::jacobi}) {
            if (method == Method::pbd && projection == Projection::lines) continue;
            for (const SelfCollision contact : {SelfCollision::off, SelfCollision::fast, SelfCollision::exact}) {
                SheetDesc desc = flat(11);
                desc.layout.lines = projection == Projection::lines;
                desc.self_collision = contact;
                Grabbed sheet =
                    grab_sheet(desc, {.max_force = 5},
                               {.substeps = 10, .iterations = 2, .method = method, .projection = projection});
                for (int i = 0; i < 40; ++i) {
                    sheet.world.step(1.0 / 60);
                    EXPECT_LT(length(sheet.world.grab_force(sheet.id)), 5.00001f);
                    if (i == 20) sheet.world.move_grab(sheet.id, sheet.start + Vec3{0, 0.1f, 0});
                }
                EXPECT_LT(length(sheet.world.grab_position(sheet.id) - sheet.start - Vec3{0, 0.1f, 0}), 2e-3f);
                EXPECT_EQ(sheet.world.frame().reports, 0u);
            }
        }
    }
}

TEST(Grab, has_the_same_bits_on_every_thread_count) {
    for (const SelfCollision contact : {SelfCollision::off, SelfCollision::exact}) {
        const auto hash = [&](unsigned workers, std::string_view isa) {
            SheetDesc desc = flat(12);
            desc.self_collision = contact;
            Grabbed sheet = grab_sheet(
                make_world({.solver = {.substeps = 4}}, CpuOptions{.workers = workers, .isa = std::string(isa)}), desc,
                {.compliance = 1e-4f});
            for (int i = 0; i < 8; ++i) {
                sheet.world.move_grab(sheet.id, sheet.start + Vec3{0.02f * static_cast<float>(i), 0, 0});
                sheet.world.step(1.0 / 60);
            }
            return sheet.world.state_hash();
        };
        const std::string one = hash(0, "scalar");
        for (const unsigned workers : {0u, 1u, 2u}) EXPECT_EQ(hash(workers, ""), one) << workers;
    }
}

}  // namespace
}  // namespace weft::physical
