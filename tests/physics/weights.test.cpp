// Factors on the density and the stiffness of a fabric, at places of the cloth.

#ifdef WEFT_VULKAN
#include "backend_runs.h"
#endif
#include "sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace weft::physical {
namespace {

// A power of four, so that multiplying with it, also under a root, rounds nothing.
constexpr float factor = 4;

float everywhere(Vec3) {
    return factor;
}

/// Scales what the weights of make_sheet() scale.
void scale(Fabric& fabric, bool density, bool stretch, bool bend) {
    if (density) fabric.body.density *= factor;
    for (float* one : {&fabric.stretch.stretch[0], &fabric.stretch.stretch[1], &fabric.stretch.compression[0],
                       &fabric.stretch.compression[1], &fabric.stretch.shear})
        if (stretch) *one *= factor;
    for (float& one : fabric.bend.bend)
        if (bend) one *= factor;
}

SheetDesc waving_sheet(StretchModel stretch, BendModel bend) {
    SheetDesc sheet = hung_by_corners(13, {.lines = true, .hierarchy = true});
    sheet.fabric.stretch = {.stretch = {800, 500}, .compression = {400, 250}, .shear = 20, .model = stretch};
    sheet.fabric.bend = {.bend = {2e-4f, 1e-4f, 8e-5f}, .model = bend};
    return sheet;
}

WorldSettings windy() {
    WindDesc wind;
    wind.velocity = {1, 0, 3};
    return {.air = AirDesc{.wind = {wind}}};
}

std::string hash_of(const SheetDesc& sheet, bool vulkan = false) {
#ifdef WEFT_VULKAN
    World world = vulkan ? on_vulkan(windy()) : on_cpu(windy());
#else
    (void)vulkan;
    World world = make_world(windy());
#endif
    world.add(make_sheet(sheet));
    run(world, 0.3);
    return world.state_hash();
}

TEST(Weights, of_everything_are_another_fabric) {
    for (const StretchModel stretch : {StretchModel::edges, StretchModel::membrane}) {
        for (const BendModel bend : {BendModel::dihedral, BendModel::distance, BendModel::moment, BendModel::plate}) {
            for (int which = 0; which < 3; ++which) {
                SheetDesc weighted = waving_sheet(stretch, bend), other = weighted;
                std::function<float(Vec3)>* const weights[] = {&weighted.density, &weighted.stretch, &weighted.bend};
                *weights[which] = everywhere;
                scale(other.fabric, which == 0, which == 1, which == 2);
                EXPECT_EQ(hash_of(weighted), hash_of(other))
                    << "stretch model " << static_cast<int>(stretch) << ", bend model " << static_cast<int>(bend)
                    << ", weight " << which;
            }
        }
    }
}

float one_side(Vec3 p) {
    return p.x < 0 ? 0.2f : 3;
}

SheetDesc uneven_sheet(BendModel bend) {
    SheetDesc sheet = waving_sheet(StretchModel::edges, bend);
    sheet.density = sheet.stretch = sheet.bend = one_side;
    return sheet;
}

#ifdef WEFT_VULKAN
// Labels: slow no-asan
TEST(Weights, are_the_same_on_both_backends) {
    for (const BendModel bend : {BendModel::dihedral, BendModel::moment})
        EXPECT_EQ(hash_of(uneven_sheet(bend), true), hash_of(uneven_sheet(bend), false));
}
#endif

// The fabric changes while the cloth moves, and the weights stay.
TEST(Weights, stay_when_the_fabric_changes) {
    for (const BendModel bend : {BendModel::dihedral, BendModel::distance}) {
        SheetDesc sheet = uneven_sheet(bend);
        const auto before = make_sheet(sheet);
        Fabric fabric = sheet.fabric;
        scale(fabric, true, true, true);
        sheet.fabric = fabric;
        const auto expected = make_sheet(sheet);
        const auto changed = with_fabric(*before, fabric);
        ASSERT_TRUE(changed.ok() && *changed);
        EXPECT_TRUE(std::ranges::equal((*changed)->mass, expected->mass));
        EXPECT_EQ((*changed)->elasticity.tension, expected->elasticity.tension);
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            if (static_cast<ConstraintKind>(kind) == ConstraintKind::tether) continue;
            EXPECT_TRUE(std::ranges::equal((*changed)->constraints[kind].fields, expected->constraints[kind].fields))
                << kind;
        }
    }
    // Moments are built again.
    const auto moments = make_sheet(uneven_sheet(BendModel::moment));
    Fabric fabric = moments->fabric;
    for (float& one : fabric.bend.bend) one *= 2;
    const auto changed = with_fabric(*moments, fabric);
    ASSERT_TRUE(changed.ok());
    EXPECT_FALSE(*changed);
}

// A stiff part leaves the springs of the rest, however stiff it is.
TEST(Weights, of_a_part_leave_the_constraints_of_the_rest) {
    for (const StretchModel model : {StretchModel::edges, StretchModel::membrane}) {
        SheetDesc sheet = waving_sheet(model, BendModel::moment);
        const std::uint32_t rows = make_sheet(sheet)->table(ConstraintKind::stretch).rows;
        sheet.stretch = [](Vec3 p) { return p.x < 0 ? 1e6f : 1.0f; };
        EXPECT_EQ(make_sheet(sheet)->table(ConstraintKind::stretch).rows, rows);
    }
}

// A strip that hangs by its upper edge, whose lower half has other weights.
SheetDesc two_halves(StretchModel model) {
    SheetDesc sheet = hanging_strip({9, 33}, 400, 20);
    sheet.fabric.stretch.model = model;
    sheet.layout = {.lines = true, .hierarchy = true};
    return sheet;
}

/// Height of the middle and of the lower end of the strip, m, at rest. Columns at its sides are left out.
std::array<double, 2> heights(const SheetDesc& sheet) {
    World world = make_world({.solver = {.substeps = 20}});
    world.add(make_sheet(sheet));
    run(world, 10);
    const auto positions = world.frame().cloths[0].positions;
    return {double{positions[16 * 9 + 4].y}, double{positions[32 * 9 + 4].y}};
}

// Each part stretches by the load that it bears over its own stiffness. The triangles of one row have weights in
// between.
// Labels: slow no-asan
TEST(Weights, make_a_part_softer_and_another_one_heavier) {
    constexpr double density = 0.2, gravity = 9.81, stiffness = 400, soft = 0.25, heavy = 4, row = 1.0 / 32;
    for (const StretchModel model : {StretchModel::edges, StretchModel::membrane}) {
        SheetDesc sheet = two_halves(model);
        sheet.stretch = [](Vec3 p) { return p.z > 0 ? float(soft) : 1.0f; };
        sheet.density = [](Vec3 p) { return p.z > 0 ? float(heavy) : 1.0f; };
        const auto [middle, low] = heights(sheet);
        double load = 0, upper = 0, lower = 0;  // N/m, m, m; from the lower end up
        for (int r = 31; r >= 0; --r) {
            const double part = r > 16 ? 1 : r == 16 ? 0.5 : 0;  // of the other weight
            const double weight = (1 + (heavy - 1) * part) * density * gravity * row;
            (r < 16 ? upper : lower) += (load + 0.5 * weight) * row / (stiffness * (1 + (soft - 1) * part));
            load += weight;
        }
        std::printf("  upper half longer by %.4f m, expected %.4f; lower half %.4f, expected %.4f\n", -0.5 - middle,
                    upper, middle - low - 0.5, lower);
        EXPECT_NEAR(-0.5 - middle, upper, 0.05 * upper);
        EXPECT_NEAR(middle - low - 0.5, lower, 0.05 * lower);
    }
}

// Each constraint has the compliance of its own place.
TEST(Weights, of_bending_count_where_they_are) {
    const std::pair<BendModel, ConstraintKind> models[] = {{BendModel::dihedral, ConstraintKind::bend},
                                                           {BendModel::moment, ConstraintKind::moment}};
    for (const auto& [bend, kind] : models) {
        SheetDesc sheet = waving_sheet(StretchModel::edges, bend);
        const auto plain = make_sheet(sheet);
        sheet.bend = [](Vec3 p) { return p.x < 0 ? 0.25f : 4.0f; };
        const auto weighted = make_sheet(sheet);
        const ConstraintTable &before = plain->table(kind), &after = weighted->table(kind);
        ASSERT_EQ(before.rows, after.rows);
        // The compliances of a moment are those of both triangles, and their sum.
        const std::uint32_t fields = kind == ConstraintKind::moment ? 3 : 1;
        std::array<int, 3> seen{};
        for (std::uint32_t row = 0; row < after.stride; ++row) {
            if (after.is_dummy(after.particles[row])) continue;
            int left = 0, right = 0;
            for (std::uint32_t slot = 0; slot < after.arity; ++slot) {
                const float x = plain->rest_position(after.particles[slot * after.stride + row]).x;
                (x < -1e-6f ? left : right) += 1;
            }
            const int place = right == 0 ? 0 : left == 0 ? 1 : 2;
            ++seen[static_cast<std::size_t>(place)];
            for (std::uint32_t field = 1; field <= fields && place < 2; ++field) {
                const std::size_t at = std::size_t{field} * after.stride + row;
                EXPECT_FLOAT_EQ(after.fields[at], before.fields[at] * (place == 0 ? 4.0f : 0.25f))
                    << "bend model " << static_cast<int>(bend) << ", field " << field;
            }
        }
        EXPECT_GT(std::ranges::min(seen), 0);
    }
}

SheetDesc overloaded_strip(StretchModel model, bool erodes) {
    SheetDesc sheet = hanging_strip({9, 25}, 100, 10);
    sheet.fabric.stretch.model = model;
    sheet.fabric.body.density = 1;
    sheet.fabric.tear.strength[0] = sheet.fabric.tear.strength[1] = erodes ? 0.0f : 40.0f;
    if (erodes) sheet.fabric.tear.tear_ratio = 1.1f;
    sheet.layout = {.lines = true, .hierarchy = true};
    sheet.reserve = {.particles = 512, .openings = true, .tears = true, .erodes = erodes};
    return sheet;
}

std::size_t particles_after(const SheetDesc& sheet, bool vulkan, std::string& hash) {
#ifdef WEFT_VULKAN
    World world = vulkan ? on_vulkan({}) : on_cpu({});
#else
    (void)vulkan;
    World world = make_world({});
#endif
    world.add(make_sheet(sheet));
    run(world, 0.6);
    hash = world.state_hash();
    return world.frame().cloths[0].positions.size();
}

// Halves of opened edges have the stiffness of their own triangle, and copies the mass of theirs.
TEST(Weights, of_a_torn_cloth_are_another_fabric) {
    for (const StretchModel model : {StretchModel::edges, StretchModel::membrane}) {
        SheetDesc weighted = overloaded_strip(model, false), other = weighted;
        weighted.density = weighted.stretch = everywhere;
        scale(other.fabric, true, true, false);
        std::string hash, expected;
        EXPECT_GT(particles_after(weighted, false, hash), 9 * 25);
        particles_after(other, false, expected);
        EXPECT_EQ(hash, expected) << static_cast<int>(model);
    }
}

#ifdef WEFT_VULKAN
// Labels: slow no-asan
TEST(Weights, of_a_torn_cloth_are_the_same_on_both_backends) {
    for (const StretchModel model : {StretchModel::edges, StretchModel::membrane}) {
        for (const bool erodes : {false, true}) {
            SheetDesc sheet = overloaded_strip(model, erodes);
            sheet.density = sheet.stretch = one_side;
            std::string hash, expected;
            particles_after(sheet, true, hash);
            particles_after(sheet, false, expected);
            EXPECT_EQ(hash, expected) << static_cast<int>(model) << ' ' << erodes;
        }
    }
}
#endif

TEST(Weights, must_be_above_0) {
    TriangleMesh mesh = make_grid({1, 1}, {3, 3}, GridDiagonal::uniform);
    for (const float bad : {0.0f, -1.0f, std::numeric_limits<float>::infinity(), std::nanf("")}) {
        auto topology = build_topology(mesh, {});
        ClothModelDesc desc{.mesh = mesh, .weights = {.stretch = {.of_triangles = std::vector<float>(8, bad)}}};
        const auto built = build_cloth_model(std::move(desc), std::move(*topology));
        ASSERT_FALSE(built.ok());
        EXPECT_EQ(built.errors()[0].where, "weights of stretch");
    }
    auto topology = build_topology(mesh, {});
    ClothModelDesc desc{.mesh = mesh, .weights = {.bend = {.of_triangles = {1, 2}}}};
    EXPECT_FALSE(build_cloth_model(std::move(desc), std::move(*topology)).ok());
}

}  // namespace
}  // namespace weft::physical
