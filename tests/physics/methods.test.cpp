// The other ways to project: plain position-based dynamics, and averaged Jacobi.

#include "sheet.h"
#include "specimen.h"

#include <cstdio>

namespace weft::physical {
namespace {

SheetDesc hanging(float stiffness) {
    SheetDesc sheet = hanging_strip({3, 9}, stiffness, 0);
    sheet.fabric.bend.bend[0] = sheet.fabric.bend.bend[1] = sheet.fabric.bend.bend[2] = 0;
    return sheet;
}

double sag_after(const WorldSettings& settings, const SheetDesc& sheet, double rate, double seconds) {
    World world = make_world(settings, sheet);
    run(world, seconds, rate);
    return sag(world);
}

// Negative control of TimeStep: with position-based dynamics the stiffness depends on the number of projections, and so
// on the time step.
TEST(PlainDynamics, stretches_by_the_time_step) {
    SheetDesc sheet = hanging(60);
    sheet.fabric.body.stiffness[0] = sheet.fabric.body.stiffness[1] = 0.02f;
    double coarse = 0, fine = 0;
    for (const double rate : {60.0, 240.0, 960.0}) {
        const double at =
            sag_after({.solver = {.substeps = 2, .iterations = 5, .method = Method::pbd}}, sheet, rate, 8);
        std::printf("  plain  1/%3.0f s  sag %.4f m\n", rate, at);
        if (rate == 60) coarse = at;
        if (rate == 960) fine = at;
    }
    EXPECT_GT(coarse, 10 * fine);
}

TEST(PlainDynamics, undoes_the_part_that_its_stiffness_says) {
    // Without gravity and inertia one free row of two particles: after a substep of k iterations 1 - s is left.
    for (const std::uint32_t iterations : {1u, 7u}) {
        for (const float s : {0.0f, 0.3f, 1.0f}) {
            SheetDesc sheet;
            sheet.resolution = {2, 2};
            sheet.fabric.body.stiffness[0] = s;
            const auto model = make_sheet(sheet);
            const PlainStiffness stiffness = plain_stiffness(model->fabric, iterations);
            const double part = stiffness[static_cast<std::uint32_t>(ConstraintKind::stretch)][0];
            EXPECT_NEAR(std::pow(1 - part, iterations), 1 - s, 1e-6);
            EXPECT_EQ(stiffness[static_cast<std::uint32_t>(ConstraintKind::stretch)][1], 1);
            EXPECT_EQ(stiffness[static_cast<std::uint32_t>(ConstraintKind::tether)][0], 1);
        }
    }
}

TEST(PlainDynamics, with_full_stiffness_is_the_inextensible_cloth) {
    // Compliance 0 and a full part are the same projection.
    SheetDesc sheet = hanging(60);
    sheet.fabric.body.damping = 0;
    World plain = make_world({.solver = {.method = Method::pbd}}, sheet);
    sheet.fabric.stretch.inextensible = true;
    World hard = make_world({}, sheet);
    // Without shear and bend the constraints differ: the plain cloth has no diagonals.
    EXPECT_GT(hard.frame().cloths[0].model->table(ConstraintKind::stretch).rows,
              plain.frame().cloths[0].model->table(ConstraintKind::stretch).rows);
    run(plain, 2);
    EXPECT_LT(sag(plain), 0.02);
    EXPECT_NEAR(plain.stretch_residual().mean, measure_strain(plain.frame()).stretch.mean, 1e-4)
        << "what is left is the stretch itself";
}

TEST(PlainDynamics, has_a_stiffness_for_compression) {
    // A strip stands on its lower edge and sinks under its weight, as far as compression gives way.
    SheetDesc sheet = hanging(60);
    sheet.pinned = [](Vec3 p) { return p.z > 0.49f; };
    sheet.resolution = {2, 3};
    sheet.fabric.body.stiffness[1] = 0.01f;
    World soft = make_world({.solver = {.substeps = 10, .method = Method::pbd}}, sheet);
    sheet.fabric.body.stiffness[1] = 1;
    World hard = make_world({.solver = {.substeps = 10, .method = Method::pbd}}, sheet);
    run(soft, 0.3), run(hard, 0.3);
    EXPECT_LT(soft.frame().cloths[0].positions[0].y, hard.frame().cloths[0].positions[0].y - 0.01f);
}

TEST(Jacobi, comes_to_the_equilibrium_of_gauss_seidel) {
    const SheetDesc sheet = hanging(200);
    WorldSettings settings{.solver = {.substeps = 10, .iterations = 20}};
    const double one_by_one = sag_after(settings, sheet, 120, 4);
    settings.solver.projection = Projection::jacobi;
    const double together = sag_after(settings, sheet, 120, 4);
    const double law = 0.2 * 9.81 / (2 * 200);
    std::printf("  sag  Gauss-Seidel %.5f m, Jacobi %.5f m, law %.5f m\n", one_by_one, together, law);
    EXPECT_NEAR(one_by_one / law, 1, 0.03);
    EXPECT_NEAR(together / law, 1, 0.03);
}

TEST(Jacobi, is_further_from_the_goal_than_gauss_seidel_after_as_many_iterations) {
    const SheetDesc sheet = hanging(4000);
    WorldSettings settings{.solver = {.substeps = 5, .iterations = 2}};
    const double one_by_one = sag_after(settings, sheet, 60, 3);
    settings.solver.projection = Projection::jacobi;
    EXPECT_GT(sag_after(settings, sheet, 60, 3), 1.2 * one_by_one);
}

// A correction that has the same weight at all particles of a constraint conserves momentum. Averaging by the count of
// each particle does not conserve it at the borders, where the counts differ.
TEST(Jacobi, keeps_momentum_where_stiffness_is_in_newtons_per_meter) {
    const auto drift = [](Method method) {
        SheetDesc sheet;
        sheet.rotation_degrees = {20, 30, 0};
        sheet.fabric.body.damping = 0;
        const auto model = make_sheet(sheet);
        LoneCloth cloth(
            model, {.solver = {.substeps = 20, .method = method, .projection = Projection::jacobi}, .contacts = false});
        // Pulled out of shape, unevenly.
        for (std::uint32_t p = 0; p < model->particle_count; ++p) {
            Vec4& x = cloth.now().position[p];
            const float s = x.x + 0.5f;
            x.x += 0.1f * s * s, x.z += 0.05f * s * s * s;
        }
        double p[3] = {}, fast = 0;
        for (int i = 0; i < 5; ++i) cloth.step(1.0 / 60, {});
        for (std::uint32_t i = 0; i < model->particle_count; ++i) {
            const Vec4& v = cloth.now().velocity[i];
            p[0] += model->mass[i] * v.x, p[1] += model->mass[i] * v.y, p[2] += model->mass[i] * v.z;
            fast += model->mass[i] * length(v.xyz());
        }
        return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / fast;
    };
    EXPECT_LT(drift(Method::xpbd), 2e-3);
    EXPECT_GT(drift(Method::pbd), 5e-3);
}

// A particle that hangs by its attachments sinks by its weight times their compliance.
TEST(Attachment, gives_way_by_its_compliance) {
    for (const std::uint32_t iterations : {1u, 6u}) {
        const float compliance = 0.05f;
        SheetDesc sheet{.size = {0.5f, 0.5f}, .resolution = {3, 3}, .spring = [=](Vec3) { return compliance; }};
        sheet.fabric.stretch.inextensible = true;
        World world = make_world({.solver = {.substeps = 10, .iterations = iterations}}, sheet);
        run(world, 6);
        // The nine forces add up to the weight of the sheet.
        const double weight = 0.25 * 0.14 * 9.81;
        double carried = 0;
        for (const Vec4& p : world.frame().cloths[0].positions) carried -= p.y / compliance;
        EXPECT_NEAR(carried / weight, 1, 0.02) << iterations;
        EXPECT_EQ(world.frame().cloths[0].positions.size(), 9u) << "anchors are not the cloth's";
    }
}

TEST(Attachment, follows_what_carries_its_anchor) {
    const auto model = make_sheet(
        {.size = {0.2f, 0.2f}, .resolution = {3, 3}, .spring = [](Vec3 p) { return p == Vec3{} ? 1e-4f : 0; }});
    ASSERT_EQ(model->anchor_count, 1u);
    World world = make_world({.gravity = {}});
    world.add(model, {.motions = {{.offsets = {{0, {}}, {1, {0, 0.4f, 0}}}}}, .particles = {{9, 0, {0, 0, 0}}}});
    run(world, 3);
    EXPECT_NEAR(world.frame().cloths[0].positions[4].y, 0.4f, 0.02f);
}

TEST(Attachment, of_nonsense_is_refused) {
    for (const Attachment bad : {Attachment{9, 1e-3f}, {0, 0}, {0, -1}, {0, NAN}, {0, INFINITY}}) {
        TriangleMesh mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::alternating);
        auto topology = build_topology(mesh);
        ClothModelDesc desc{.mesh = std::move(mesh), .pins = {.attachments = {bad}}};
        const auto model = build_cloth_model(std::move(desc), std::move(*topology));
        ASSERT_FALSE(model.ok());
        EXPECT_EQ(model.error().where, "attachment 0");
    }
}

}  // namespace
}  // namespace weft::physical
