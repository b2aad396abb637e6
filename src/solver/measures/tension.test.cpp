#include "solver/measures/tension.h"

#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace weft {
namespace {

enum class TestMesh { uniform, alternating, cross, irregular };

// A sheet of 1 m by 1 m. The irregular mesh is a grid with its vertices moved by up to a quarter of a cell, and
// diagonals by chance.
TriangleMesh tension_mesh(TestMesh kind, std::uint32_t cells = 16) {
    const std::uint32_t n = cells + 1;
    TriangleMesh mesh = make_grid({1, 1}, {n, n},
                                  kind == TestMesh::uniform ? GridDiagonal::uniform
                                  : kind == TestMesh::cross ? GridDiagonal::cross
                                                            : GridDiagonal::alternating);
    if (kind != TestMesh::irregular) return mesh;
    std::mt19937 chance(7);
    const auto offset = [&] {
        return (static_cast<float>(chance() % 2001) / 1000 - 1) * 0.25f / static_cast<float>(cells);
    };
    for (std::uint32_t iz = 1; iz + 1 < n; ++iz)
        for (std::uint32_t ix = 1; ix + 1 < n; ++ix) mesh.positions[iz * n + ix] += Vec3{offset(), 0, offset()};
    mesh.uvs.clear();  // the warp is the x axis
    mesh.triangles.clear();
    for (std::uint32_t iz = 0; iz < cells; ++iz) {
        for (std::uint32_t ix = 0; ix < cells; ++ix) {
            const std::uint32_t a = iz * n + ix, b = a + 1, c = a + n, d = c + 1;
            if (chance() % 2) {
                mesh.triangles.push_back({a, c, d}), mesh.triangles.push_back({a, d, b});
            } else {
                mesh.triangles.push_back({a, c, b}), mesh.triangles.push_back({b, c, d});
            }
        }
    }
    return mesh;
}

std::shared_ptr<const ClothModel> tension_model(TriangleMesh mesh, const Fabric& fabric) {
    auto topology = build_topology(mesh, {.reorder = false});
    EXPECT_TRUE(topology.ok());
    auto model = build_cloth_model({.name = "sheet", .mesh = std::move(mesh), .fabric = fabric}, std::move(*topology));
    EXPECT_TRUE(model.ok());
    return *model;
}

Fabric woven(float warp, float weft, float shear) {
    Fabric fabric;
    fabric.stretch = {.stretch = {warp, weft}, .compression = {warp, weft}, .shear = shear};
    return fabric;
}

// The continuum that edges of a square grid add up to: warp and weft springs k1, k2 beside diagonals of shear
// stiffness Ks. Stress (xx, yy, xy) = C · strain (xx, yy, 2 xy).
struct Continuum {
    double k1, k2, ks;

    Continuum(double warp, double weft, double shear) : k1(warp), k2(weft), ks(shear) {
        for (int i = 0; i < 200; ++i) {
            const double next = warp - ks * k2 / (k2 + ks);
            k2 = weft - ks * k1 / (k1 + ks);
            k1 = next;
        }
    }
    // Strain under the stress.
    std::array<double, 3> strain(double xx, double yy, double xy) const {
        const double a = k1 + ks, b = k2 + ks, det = a * b - ks * ks;
        return {(b * xx - ks * yy) / det, (a * yy - ks * xx) / det, xy / ks};
    }
};

// Threads along warp and weft are longer by exactly the strain, and turn toward each other by the shear angle. So the
// lengths of edges have no second-order terms, which stiff threads would make large.
std::vector<Vec4> strained(const ClothModel& model, const std::array<double, 3>& strain) {
    const double turn = 0.5 * std::asin(strain[2]), c = std::cos(turn), s = std::sin(turn);
    std::vector<Vec4> positions;
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        const double x = model.rest_position(p).x * (1 + strain[0]), z = model.rest_position(p).z * (1 + strain[1]);
        positions.push_back(
            {static_cast<float>(x * c + z * s), model.rest_position(p).y, static_cast<float>(x * s + z * c), 1});
    }
    return positions;
}

bool inside(const ClothModel& model, std::uint32_t p) {
    const Vec3 x = model.rest_position(p);
    return std::abs(x.x) < 0.49f && std::abs(x.z) < 0.49f;
}

struct LoadCase {
    const char* name;
    std::array<double, 3> stress;  // xx, yy, xy, N/m
};
constexpr double unit_load = 1;
constexpr LoadCase load_cases[] = {{"warp", {unit_load, 0, 0}},
                                   {"weft", {0, unit_load, 0}},
                                   {"bias", {unit_load / 2, unit_load / 2, unit_load / 2}},
                                   {"biaxial", {unit_load, unit_load, 0}},
                                   {"shear", {0, 0, unit_load}}};

// Tension over that of the continuum, minus 1: mean of the particles inside.
double tension_error(const ClothModel& model, const StressTable& table, const LoadCase& load) {
    const Continuum sheet(model.fabric.stretch.stretch[0], model.fabric.stretch.stretch[1], model.fabric.stretch.shear);
    // Small, so that diagonals are nearly linear in the strain; large, so that floats resolve it.
    std::array<double, 3> strain = sheet.strain(load.stress[0], load.stress[1], load.stress[2]);
    const double scale = 2e-3 / std::max({std::abs(strain[0]), std::abs(strain[1]), std::abs(strain[2])});
    for (double& s : strain) s *= scale;
    const ClothTension measured = measure_tension(table, strained(model, strain));
    double sum = 0, count = 0;
    for (std::uint32_t p = 0; p < model.particle_count; ++p)
        if (inside(model, p)) sum += measured.tension[p] / (scale * unit_load) - 1, ++count;
    return sum / count;
}

// The sum over edges is exact. Whether it is the fabric's stress under this strain depends on the mesh: springs along
// edges are the fabric only on square grids with alternating diagonals (stretch.md). These are the errors elsewhere.
TEST(TensionMeasure, of_a_uniform_strain_is_off_by_what_the_mesh_is_too_stiff) {
    struct Row {
        const char* name;
        Fabric fabric;
        TestMesh mesh;
        std::array<double, std::size(load_cases)> error;  // %
    };
    const Fabric cotton = woven(4000, 4000, 40), denim = woven(411, 2028, 27), rubber = woven(300, 300, 100);
    const Row rows[] = {
        {"cotton, uniform", cotton, TestMesh::uniform, {0, 0, 50.9, 2, 99.9}},
        {"cotton, alternating", cotton, TestMesh::alternating, {0, 0, 0, 0, 0}},
        {"cotton, cross", cotton, TestMesh::cross, {-48.5, -48.5, 26.4, -47, 99.9}},
        {"cotton, irregular", cotton, TestMesh::irregular, {-15.6, -17.1, 311.9, -0.2, 638.1}},
        {"denim, uniform", denim, TestMesh::uniform, {0.4, 0, 53.8, 7.7, 99.9}},
        {"denim, alternating", denim, TestMesh::alternating, {0, 0, 0, 0, 0}},
        {"denim, cross", denim, TestMesh::cross, {-40.3, -48.1, 30.8, -38.4, 99.9}},
        {"denim, irregular", denim, TestMesh::irregular, {-0.2, -19.6, 149.6, 11.2, 301.2}},
        {"rubber, uniform", rubber, TestMesh::uniform, {5.2, 5.2, 73.2, 46.5, 99.9}},
        {"rubber, alternating", rubber, TestMesh::alternating, {0, 0, 0, 0, 0}},
        {"rubber, cross", rubber, TestMesh::cross, {-15.1, -15.1, 59.9, 19.7, 99.9}},
        {"rubber, irregular", rubber, TestMesh::irregular, {1.8, 3.5, 0.6, 23.5, 1.5}},
    };
    for (const Row& row : rows) {
        const auto model = tension_model(tension_mesh(row.mesh), row.fabric);
        const StressTable table = make_stress_table(*model, model->triangles());
        std::printf("  tension  %-20s", row.name);
        for (std::size_t i = 0; i < std::size(load_cases); ++i) {
            const double error = 100 * tension_error(*model, table, load_cases[i]);
            std::printf("  %s %+.1f %%", load_cases[i].name, error);
            EXPECT_NEAR(error, row.error[i], 0.3 + 0.02 * std::abs(row.error[i]))
                << row.name << ' ' << load_cases[i].name;
        }
        std::printf("\n");
    }
}

// Threads of a membrane do not contract across a pull.
TEST(TensionMeasure, of_a_uniformly_strained_membrane_is_that_of_the_fabric_on_every_mesh) {
    for (Fabric fabric : {woven(4000, 4000, 40), woven(411, 2028, 27), woven(300, 300, 100)}) {
        fabric.stretch.model = StretchModel::membrane;
        const StretchMaterial& stretch = fabric.stretch;
        const double rounding = 1e-6 * double{std::max(stretch.stretch[0], stretch.stretch[1])};  // of positions
        for (const TestMesh mesh : {TestMesh::uniform, TestMesh::alternating, TestMesh::cross, TestMesh::irregular}) {
            const auto model = tension_model(tension_mesh(mesh), fabric);
            const StressTable table = make_stress_table(*model, model->triangles());
            for (const LoadCase& load : load_cases) {
                const double strain[3] = {load.stress[0] / double{stretch.stretch[0]},
                                          load.stress[1] / double{stretch.stretch[1]},
                                          load.stress[2] / double{stretch.shear}};
                const double scale = 2e-3 / std::max({strain[0], strain[1], strain[2]});
                const ClothTension measured =
                    measure_tension(table, strained(*model, {scale * strain[0], scale * strain[1], scale * strain[2]}));
                double sum = 0;
                for (const double tension : measured.tension) sum += tension;
                EXPECT_NEAR(sum / model->particle_count, scale * unit_load, 0.003 * scale * unit_load);
                for (std::uint32_t p = 0; p < model->particle_count; ++p)
                    EXPECT_NEAR(measured.tension[p], scale * unit_load, 0.005 * scale * unit_load + rounding)
                        << load.name << " on mesh " << static_cast<int>(mesh) << ", particle " << p;
                if (HasFailure()) return;
            }
        }
    }
}

TEST(TensionMeasure, does_not_depend_on_how_the_cloth_is_folded) {
    const auto model = tension_model(tension_mesh(TestMesh::alternating, 8), woven(2000, 1000, 50));
    const StressTable table = make_stress_table(*model, model->triangles());
    const std::vector<Vec4> flat = strained(*model, {2e-3, 0, 0});
    std::vector<Vec4> folded = flat;
    for (Vec4& p : folded)
        if (p.z > 0) p = {p.x, p.z, 0, 1};
    const ClothTension of_flat = measure_tension(table, flat), of_folded = measure_tension(table, folded);
    for (std::uint32_t p = 0; p < model->particle_count; ++p)
        EXPECT_NEAR(of_flat.tension[p], of_folded.tension[p], 1e-3) << "particle " << p;
}

TEST(TensionMeasure, does_not_depend_on_how_triangles_wind) {
    TriangleMesh mesh = tension_mesh(TestMesh::irregular, 8);
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    const auto model = tension_model(tension_mesh(TestMesh::irregular, 8), woven(2000, 1000, 50)),
               mixed = tension_model(mesh, woven(2000, 1000, 50));
    const std::vector<Vec4> positions = strained(*model, {2e-3, -1e-3, 4e-3});
    const ClothTension plain = measure_tension(make_stress_table(*model, model->triangles()), positions),
                       wound = measure_tension(make_stress_table(*mixed, mixed->triangles()), positions);
    for (std::uint32_t p = 0; p < model->particle_count; ++p)
        EXPECT_NEAR(plain.tension[p], wound.tension[p], 1e-4) << "particle " << p;
}

TEST(TensionMeasure, adds_triangles_in_common_axes) {
    // The weft is as stiff as the warp, so a turn of the threads by 90° changes no stiffness.
    const auto model = tension_model(tension_mesh(TestMesh::alternating, 8), woven(500, 500, 20));
    ClothModel seam = *model;
    std::vector<float> warp(seam.face_warp.begin(), seam.face_warp.end());
    for (std::uint32_t t = 0; t < warp.size(); ++t)
        if (model->rest_position(model->triangles()[t][0]).x > 0) warp[t] += 1.570796f;
    seam.face_warp = std::move(warp);
    const std::vector<Vec4> positions = strained(*model, {2e-3, 0, 0});
    const ClothTension plain = measure_tension(make_stress_table(*model, model->triangles()), positions),
                       turned = measure_tension(make_stress_table(seam, model->triangles()), positions);
    for (std::uint32_t p = 0; p < model->particle_count; ++p)
        EXPECT_NEAR(plain.tension[p], turned.tension[p], 1e-6) << "particle " << p;
}

TEST(TensionMeasure, of_a_shape_that_is_not_flat_at_rest) {
    TriangleMesh mesh = tension_mesh(TestMesh::alternating, 16);
    for (Vec3& x : mesh.positions) x = {0.4f * std::sin(x.x / 0.4f), 0.4f * std::cos(x.x / 0.4f), x.z};
    const auto model = tension_model(mesh, woven(500, 500, 20));
    const StressTable table = make_stress_table(*model, model->triangles());
    std::vector<Vec4> positions;
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const Vec3 x = model->rest_position(p) * 1.01f;
        positions.push_back({x.x, x.y, x.z, 1});
    }
    const Continuum sheet(500, 500, 20);
    const ClothTension tension = measure_tension(table, positions);
    for (std::uint32_t p = 0; p < model->particle_count; ++p) {
        const bool rim = std::abs(model->start[p].z) > 0.49f || std::abs(mesh.uvs[p].x - 0.5f) > 0.49f;
        if (rim) continue;
        EXPECT_NEAR(tension.tension[p], 0.01 * (sheet.k1 + 2 * sheet.ks), 0.03) << "particle " << p;
    }
}

// Bent by 90° at rest along a row of particles, across the warp.
TEST(TensionMeasure, follows_the_threads_around_a_crease) {
    const TriangleMesh flat_mesh = tension_mesh(TestMesh::alternating, 8);
    const auto bent = [](Vec3 x) { return x.x > 0 ? Vec3{0, x.x, x.z} : x; };
    TriangleMesh mesh = flat_mesh;
    for (Vec3& x : mesh.positions) x = bent(x);
    const auto flat = tension_model(flat_mesh, woven(2000, 500, 50)), creased = tension_model(mesh, flat->fabric);
    const std::vector<Vec4> pulled = strained(*flat, {2e-3, 0, 0});
    std::vector<Vec4> positions;
    for (const Vec4& p : pulled) {
        const Vec3 x = bent(p.xyz());
        positions.push_back({x.x, x.y, x.z, 1});
    }
    const ClothTension expected = measure_tension(make_stress_table(*flat, flat->triangles()), pulled),
                       measured = measure_tension(make_stress_table(*creased, creased->triangles()), positions);
    for (std::uint32_t p = 0; p < flat->particle_count; ++p)
        EXPECT_NEAR(measured.tension[p], expected.tension[p], 1e-3) << "particle " << p;
}

// With these stiffnesses k(φ) is 400 N/m in every direction, so threads matter for the strength alone.
TEST(TensionMeasure, takes_the_mean_of_the_threads_at_a_seam) {
    Fabric fabric = woven(480, 480, 100);
    fabric.tear = {.strength = {50, 500}, .tear_energy = 0, .tear_ratio = 0};
    const auto model = tension_model(tension_mesh(TestMesh::alternating, 8), fabric);
    ClothModel seam = *model;
    std::vector<float> warp(seam.face_warp.begin(), seam.face_warp.end());
    for (std::uint32_t t = 0; t < warp.size(); ++t) {
        const auto [a, b, c] = model->triangles()[t];
        const float middle = model->rest_position(a).x + model->rest_position(b).x + model->rest_position(c).x;
        warp[t] += middle > 0 ? 0.35f : -0.35f;
    }
    seam.face_warp = std::move(warp);
    const ClothTension measured = measure_tension(make_stress_table(seam, seam.triangles()),
                                                  strained(*model, Continuum(480, 480, 100).strain(1, 0, 0)));
    for (std::uint32_t iz = 1; iz < 8; ++iz) {
        EXPECT_NEAR(measured.tension[iz * 9 + 4], 1, 5e-3) << iz;
        EXPECT_NEAR(measured.load[iz * 9 + 4], 1.0 / 50, 1e-3) << "at the seam, along the mean warp: " << iz;
        EXPECT_LT(measured.load[iz * 9 + 1], 0.95 / 50) << "beside it: " << iz;
    }
}

// A sheet with a slit from the side x = -0.5 m to its middle, 1 mm wide. `tip`: the particle at the end.
struct SlitSheet {
    std::shared_ptr<const ClothModel> model;
    std::uint32_t tip = 0;
};

SlitSheet slit_sheet(const Fabric& fabric, std::uint32_t cells = 8) {
    TriangleMesh mesh = make_grid({1, 1}, {cells + 1, cells + 1}, GridDiagonal::alternating);
    const std::uint32_t row = (cells / 2) * (cells + 1);
    for (std::uint32_t ix = 0; ix < cells / 2; ++ix) {
        const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(mesh.positions[row + ix] + Vec3{0, 0, 1e-3f});
        mesh.uvs.push_back(mesh.uvs[row + ix]);
        for (Triangle& t : mesh.triangles) {
            const float middle = mesh.positions[t[0]].z + mesh.positions[t[1]].z + mesh.positions[t[2]].z;
            if (middle > 0.01f)
                for (std::uint32_t& corner : t) corner = corner == row + ix ? copy : corner;
        }
    }
    return {tension_model(mesh, fabric), row + cells / 2};
}

TEST(TensionMeasure, has_another_limit_at_the_end_of_a_cut) {
    Fabric fabric = woven(300, 300, 100);
    fabric.tear = {.strength = {50, 50}, .tear_energy = 2, .tear_ratio = 0};
    const SlitSheet slit = slit_sheet(fabric);
    const StressTable table = make_stress_table(*slit.model, slit.model->triangles());
    const double edges = (4 * 0.125 + 4 * 0.125 * std::numbers::sqrt2) / 8;
    for (std::uint32_t p = 0; p < slit.model->particle_count; ++p)
        EXPECT_NEAR(table.cut_end[p], p == slit.tip ? edges : 0, 0.03) << "particle " << p;
    const ClothTension pulled = measure_tension(table, strained(*slit.model, {0, 0.02, 0}));
    const Continuum sheet(300, 300, 100);
    const double stiffness = sheet.k2 + sheet.ks, tension = 0.02 * stiffness;
    EXPECT_NEAR(pulled.load[slit.tip],
                tension / std::sqrt(WEFT_CUT_END_FACTOR_SQUARED * 2 * stiffness / table.cut_end[slit.tip]),
                0.02 * pulled.load[slit.tip]);
    EXPECT_NEAR(pulled.load[slit.tip + 1], tension / 50, 1e-3);

    fabric.tear.tear_energy = 0;
    const SlitSheet strong = slit_sheet(fabric);
    const ClothTension without = measure_tension(make_stress_table(*strong.model, strong.model->triangles()),
                                                 strained(*strong.model, {0, 0.02, 0}));
    EXPECT_NEAR(without.load[slit.tip], without.load[slit.tip + 1], 0.02);
}

TEST(TensionMeasure, compares_each_direction_with_its_strength) {
    Fabric fabric = woven(400, 2000, 20);
    fabric.tear = {.strength = {100, 300}, .tear_energy = 0, .tear_ratio = 0};
    const auto model = tension_model(tension_mesh(TestMesh::alternating, 8), fabric);
    const StressTable table = make_stress_table(*model, model->triangles());
    const Continuum sheet(400, 2000, 20);
    const auto load_at = [&](double xx, double yy) {
        return measure_tension(table, strained(*model, sheet.strain(xx, yy, 0))).load[4 * 9 + 4];
    };
    EXPECT_NEAR(load_at(10, 0), 0.1, 1e-3);
    EXPECT_NEAR(load_at(0, 30), 0.1, 1e-3);
    EXPECT_EQ(load_at(-10, -10), 0) << "compressed";
}

TEST(TensionMeasure, of_inextensible_cloth_is_its_length_alone) {
    Fabric fabric;
    fabric.stretch.inextensible = true;
    fabric.tear = {.strength = {1, 1}, .tear_energy = 1, .tear_ratio = 1.1f};
    const auto model = tension_model(tension_mesh(TestMesh::alternating, 8), fabric);
    const auto load_of = [&](const std::array<double, 3>& strain) {
        const ClothTension measured =
            measure_tension(make_stress_table(*model, model->triangles()), strained(*model, strain));
        EXPECT_EQ(measured.tension, std::vector<double>(model->particle_count, 0));
        return measured.load[4 * 9 + 4];
    };
    EXPECT_NEAR(load_of({0.05, 0, 0}), 0.5, 1e-3);
    EXPECT_NEAR(load_of({0, 0.2, 0}), 2, 1e-3);
    EXPECT_EQ(load_of({-0.1, -0.1, 0}), 0);
}

TEST(TensionMeter, sums_up_all_cloths) {
    Fabric plain = woven(300, 300, 0), rigid;
    plain.tear = {.strength = {0, 0}, .tear_energy = 0, .tear_ratio = 0};
    rigid.stretch.inextensible = true;
    rigid.tear = {.strength = {1, 1}, .tear_energy = 1, .tear_ratio = 0};
    const auto soft = tension_model(tension_mesh(TestMesh::uniform, 4), plain),
               hard = tension_model(tension_mesh(TestMesh::uniform, 4), rigid);
    const std::vector<Vec4> pulled = strained(*soft, {0.01, 0, 0});
    const auto frame_of = [&](std::initializer_list<const ClothModel*> models) {
        Frame frame;
        for (const ClothModel* model : models) {
            ClothFrame& cloth = frame.cloths.emplace_back();
            cloth.model = model, cloth.positions = pulled, cloth.triangles = model->triangles();
        }
        return frame;
    };
    TensionMeter meter;
    const TensionSummary of_hard = meter.measure(frame_of({hard.get()}));
    EXPECT_FALSE(of_hard.mean || of_hard.most || of_hard.load);
    const TensionSummary both = TensionMeter().measure(frame_of({hard.get(), soft.get()}));
    EXPECT_NEAR(both.mean.value(), 3, 1e-3);
    EXPECT_NEAR(both.most.value().value, 3, 1e-3);
    EXPECT_EQ(both.most->at.cloth, 1u);
    EXPECT_FALSE(both.load) << "no limit";

    // Another fabric of the same cloth.
    TensionMeter kept;
    kept.measure(frame_of({soft.get()}));
    Fabric limited = woven(600, 600, 0);
    limited.tear = {.strength = {60, 60}, .tear_energy = 0, .tear_ratio = 0};
    const auto changed = with_fabric(*soft, limited);
    ASSERT_TRUE(changed.ok() && *changed);
    const TensionSummary after = kept.measure(frame_of({changed->get()}));
    EXPECT_NEAR(after.most.value().value, 6, 1e-3);
    EXPECT_NEAR(after.load.value().value, 0.1, 1e-4);
}

TEST(TensionMeasure, keeps_what_is_no_number_and_leaves_degenerate_triangles_out) {
    TriangleMesh mesh = tension_mesh(TestMesh::uniform, 4);
    const auto spare = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({2, 0, 0});
    mesh.positions.push_back({3, 0, 0});
    mesh.positions.push_back({4, 0, 1e-25f});
    for (int i = 0; i < 3; ++i) mesh.uvs.push_back({0, 0});
    mesh.triangles.push_back({spare, spare + 1, spare + 2});
    const auto model = tension_model(mesh, woven(300, 300, 20));
    const StressTable table = make_stress_table(*model, model->triangles());
    std::vector<Vec4> positions = strained(*model, {0.01, 0, 0});
    const ClothTension sound = measure_tension(table, positions);
    for (std::uint32_t p = 0; p < model->particle_count; ++p) EXPECT_TRUE(std::isfinite(sound.tension[p])) << p;
    positions[0].x = std::numeric_limits<float>::quiet_NaN();
    const ClothTension broken = measure_tension(table, positions);
    EXPECT_TRUE(std::isnan(broken.tension[0]));
    EXPECT_TRUE(std::isnan(broken.load[0]));
    EXPECT_TRUE(std::isfinite(broken.tension[24]));
    Frame frame;
    ClothFrame& cloth = frame.cloths.emplace_back();
    cloth.model = model.get(), cloth.positions = positions, cloth.triangles = model->triangles();
    const TensionSummary summary = TensionMeter().measure(frame);
    EXPECT_TRUE(std::isnan(summary.most.value().value));
    EXPECT_TRUE(std::isnan(summary.mean.value()));
}

}  // namespace
}  // namespace weft
