// What contact of fast particles (physics/contact/swept.kernel.h) relies on: a point that goes no farther than its
// distance divided by the steepness passes through no surface of the field.
#include "collide/free_way.h"

#include "base/transform.h"
#include "collide/field_reading.test.h"
#include "mesh/procedural.h"
#include "mesh/testing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

// With its tip up.
TriangleMesh cone(float radius, float height, std::uint32_t sides) {
    TriangleMesh mesh;
    mesh.positions = {{0, height, 0}, {0, 0, 0}};
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        mesh.positions.push_back(
            {radius * static_cast<float>(std::cos(angle)), 0, radius * static_cast<float>(std::sin(angle))});
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
        mesh.triangles.push_back({0, b, a});
        mesh.triangles.push_back({1, a, b});
    }
    return mesh;
}

TriangleMesh turned(TriangleMesh mesh) {
    const Mat3 turn = rotation_from_degrees({20, 35, 50});
    for (Vec3& p : mesh.positions) p = turn * p;
    return mesh;
}

// Two blocks with a slit of 1.7 cells between them, and a bar over it.
TriangleMesh blocks_with_slit(float cell) {
    TriangleMesh mesh;
    const auto add = [&](std::array<float, 3> size, Vec3 at) {
        TriangleMesh box = make_box(size, {2, 2, 2});
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3 p : box.positions) mesh.positions.push_back(p + at);
        for (const auto& [a, b, c] : box.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
    };
    const float half = 0.5f * (0.5f + 1.7f * cell);
    add({0.5f, 0.5f, 0.5f}, {half, 0, 0});
    add({0.5f, 0.5f, 0.5f}, {-half, 0, 0});
    add({1, 0.03f, 0.03f}, {0, 0.6f, 0});
    return mesh;
}

// Small balls, far apart: their distance is strongly curved where cells are large.
TriangleMesh dots(float radius) {
    TriangleMesh mesh;
    FieldRandom random(3);
    for (int i = 0; i < 40; ++i) {
        const auto at = random.vector(0.5);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const TriangleMesh ball = make_sphere(radius, 2);
        for (const Vec3 p : ball.positions) {
            mesh.positions.push_back(
                p + Vec3{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)});
        }
        for (const auto& [a, b, c] : ball.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
    }
    return mesh;
}

TriangleMesh open_shell(float height) {
    TriangleMesh mesh = make_sphere(1, 4);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.positions[t[0]].y + mesh.positions[t[1]].y + mesh.positions[t[2]].y > 3 * height;
    });
    return mesh;
}

struct FieldCase {
    const char* name;
    TriangleMesh mesh;
    DistanceField field;
};
std::vector<FieldCase> field_cases() {
    std::vector<FieldCase> cases;
    const auto add = [&](const char* name, const TriangleMesh& mesh, std::uint32_t cells) {
        cases.push_back({name, mesh, field_of(mesh, cells, 2)});
    };
    add("cube", make_box({1, 1, 1}, {3, 3, 3}), 48);
    add("turned cube", turned(make_box({1, 1, 1}, {3, 3, 3})), 48);
    add("plate", turned(make_box({1, 0.06f, 1}, {5, 2, 5})), 48);
    add("thin plate", make_box({1, 0.01f, 1}, {5, 2, 5}), 64);
    add("cone", cone(0.1f, 0.4f, 32), 64);
    add("needle", turned(cone(0.01f, 1, 8)), 100);
    add("slit", blocks_with_slit(1 / 96.0f), 96);
    add("shell with a hole", open_shell(0.6f), 64);
    add("half a shell", turned(open_shell(0)), 64);
    add("sphere", make_sphere(1, 4), 100);
    add("dots", dots(3.5f / 160), 160);
    if (std::ifstream(bunny_file)) add("bunny", read_bunny(), 96);
    return cases;
}

double read_exactly(const DistanceField& field, reference::vec3 p) {
    reference::vec3 normal;
    return reference::distance_mesh(p, {0, 0, 0, 0, field.data.blocks()}, normal);
}
reference::vec3 exactly(Vec3 p) {
    return {double{p.x}, double{p.y}, double{p.z}};
}

// In a box that has twice the size of the mesh's bounds.
reference::vec3 point_around(const DistanceField& field, FieldRandom& random) {
    const Vec3 center = (field.data.bounds.min + field.data.bounds.max) * 0.5f;
    const double longest =
        double{std::max({field.data.bounds.size().x, field.data.bounds.size().y, field.data.bounds.size().z})};
    return exactly(center) + random.vector(longest);
}

reference::vec3 point_on(const TriangleMesh& mesh, FieldRandom& random) {
    const Triangle& t = mesh.triangles[random.index(static_cast<std::uint32_t>(mesh.triangles.size()))];
    double u = random.number(0, 1), v = random.number(0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const reference::vec3 a = exactly(mesh.positions[t[0]]);
    return a + (exactly(mesh.positions[t[1]]) - a) * u + (exactly(mesh.positions[t[2]]) - a) * v;
}

// Points at which lines enter the solid of the field. Half of them aim at the mesh.
std::vector<reference::vec3> points_of_zero(const FieldCase& of, FieldRandom& random) {
    std::vector<reference::vec3> points;
    const double step = 0.5 * double{of.field.cell};
    for (int i = 0; i < 2000; ++i) {
        const reference::vec3 from = point_around(of.field, random),
                              aim = i % 2 ? point_on(of.mesh, random) : point_around(of.field, random);
        const reference::vec3 way = (aim - from) * 1.2;
        const double size = testing_kernels::norm(way);
        for (double at = 0; at < size; at += step) {
            const auto point = [&](double t) { return from + way * (t / size); };
            if (!(read_exactly(of.field, point(at)) > 0 && read_exactly(of.field, point(at + step)) <= 0)) continue;
            double out = at, in = at + step;
            for (int k = 0; k < 30; ++k) {
                const double middle = 0.5 * (in + out);
                (read_exactly(of.field, point(middle)) > 0 ? out : in) = middle;
            }
            points.push_back(point(in));
        }
    }
    return points;
}

double interpolated(const std::array<float, 8>& values, double x, double y, double z) {
    double sum = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        sum += (k & 1 ? x : 1 - x) * (k & 2 ? y : 1 - y) * (k & 4 ? z : 1 - z) * double{values[k]};
    }
    return sum;
}

TEST(FreeWay, lowered_values_are_below_the_distance_to_the_cells_and_positive) {
    FieldRandom random(7);
    double share = 0;
    constexpr int cubes = 400;
    for (int i = 0; i < cubes; ++i) {
        // A few cells around the cube from 16 to 24, up to 3, 12 or 30 away.
        std::vector<Bounds> boxes;
        const std::uint32_t reach = i % 3 == 0 ? 3 : i % 3 == 1 ? 12 : 30, count = 1 + random.index(3);
        while (boxes.size() < count) {
            const auto along = [&] {
                return static_cast<float>(random.index(2 * reach + 9)) + 15 - static_cast<float>(reach);
            };
            const Vec3 low{along(), along(), along()};
            const auto apart = [](float x) { return std::max({0.0f, 16 - (x + 1), x - 24}); };
            if (std::max({apart(low.x), apart(low.y), apart(low.z)}) < 1) continue;
            boxes.push_back({low, low + Vec3{1, 1, 1}});
        }
        const CellDistance cells(boxes);
        std::array<float, 8> values;
        for (std::uint32_t k = 0; k < 8; ++k) {
            const Vec3 p{k & 1 ? 24.0f : 16.0f, k & 2 ? 24.0f : 16.0f, k & 4 ? 24.0f : 16.0f};
            values[k] = static_cast<float>(cells.at(p) + random.number(-0.5, 0.5));
        }
        const auto lowered = lower_to_free_way(cells, {16, 16, 16}, 8, values, 0);
        for (int n = 0; n < 500; ++n) {
            // Half of the points on the cube's surface, near the cells.
            double at[3] = {random.number(0, 1), random.number(0, 1), random.number(0, 1)};
            if (n % 2) at[random.index(3)] = n % 4 < 2 ? 0 : 1;
            const double value = interpolated(lowered, at[0], at[1], at[2]);
            const double free =
                cells.at(Vec3{16, 16, 16} + Vec3{static_cast<float>(8 * at[0]), static_cast<float>(8 * at[1]),
                                                 static_cast<float>(8 * at[2])});
            ASSERT_LE(value, free + 1e-5) << i;
            ASSERT_GT(value, 0.3) << i;
            share += value / free / (500.0 * cubes);
        }
    }
    EXPECT_GT(share, 0.7);

    // Along a flat layer the interpolation of the distance is exact, so little is taken away.
    const CellDistance layer(std::vector<Bounds>{{{-100, 10, -100}, {100, 13, 100}}});
    const auto above = lower_to_free_way(layer, {16, 16, 16}, 8, {3, 3, 11, 11, 3, 3, 11, 11}, 0);
    for (std::uint32_t k = 0; k < 8; ++k) EXPECT_NEAR(above[k], (k & 2 ? 11 : 3) - 0.4, 0.1);
    const CellDistance nothing(std::vector<Bounds>{});
    EXPECT_EQ(lower_to_free_way(nothing, {16, 16, 16}, 8, {1, 2, 3, 4, 5, 6, 7, 8}, 0)[7], 8);
}

// A limit, not a goal: the field ends where the cone is about 1.4 cells thick.
TEST(FreeWay, ends_below_sharp_tips) {
    for (const float radius : {0.2f, 0.1f, 0.05f, 0.025f}) {
        for (int shift = 0; shift < 4; ++shift) {
            // Other parts move the tip within its cell.
            TriangleMesh mesh = cone(radius, 0.4f, 32);
            const float out = 0.45f + 0.003f * static_cast<float>(shift);
            testing_meshes::add_triangle(mesh, {out, 0, 0}, {out + 0.001f, 0, 0}, {out, 0, 0.001f});
            testing_meshes::add_triangle(mesh, {0, 0, out}, {0.001f, 0, out}, {0, 0, out + 0.001f});
            const DistanceField field = field_of(mesh, 64);
            float missing = 0;
            while (missing < 0.4f && read(field, {0, 0.4f - missing, 0}).distance > 0) missing += 0.0002f;
            const float thickness = 2 * radius / 0.4f * missing / field.cell;
            EXPECT_LT(thickness, 1.5f) << radius;
        }
    }
}

// Labels: slow no-asan long
TEST(FreeWay, leads_through_no_surface_of_the_field) {
    for (const FieldCase& of : field_cases()) {
        const auto& [name, mesh, field] = of;
        FieldRandom random(17);
        const std::vector<reference::vec3> surface = points_of_zero(of, random);
        ASSERT_GT(surface.size(), 500u) << name;
        const double cell = double{field.cell};
        int wrong = 0, tested = 0;
        double share = 0;
        for (int i = 0; i < 1500; ++i) {
            // Anywhere, and within twenty cells from the surface.
            reference::vec3 p = point_around(field, random);
            if (i % 2) {
                p = surface[random.index(static_cast<std::uint32_t>(surface.size()))] + random.vector(20 * cell);
            }
            const double distance = read_exactly(field, p), way = distance / double{field.data.steepness};
            if (!(distance > 0)) continue;
            reference::vec3 nearest = surface[0];
            for (const reference::vec3& z : surface) {
                if (testing_kernels::norm(z - p) < testing_kernels::norm(nearest - p)) nearest = z;
            }
            const double size = testing_kernels::norm(nearest - p);
            share += distance / std::max(size, 1e-9), ++tested;
            bool passes = false;
            for (int k = 0; k < 100 && !passes; ++k) {
                reference::vec3 aim =
                    k == 0 ? nearest : nearest + random.vector((0.2 + 0.02 * k) * std::min(size, 4 * cell));
                if (k > 80) aim = p + random.vector(1);
                const reference::vec3 direction = (aim - p) * (1 / std::max(testing_kernels::norm(aim - p), 1e-9));
                for (double t = 1; t > 0.6; t -= 0.05) {
                    passes = passes || read_exactly(field, p + direction * (0.9999 * t * way)) <= 0;
                }
            }
            wrong += passes;
        }
        EXPECT_EQ(wrong, 0) << name;
        EXPECT_GT(share / tested, 0.6) << name << ": steps are short";
        std::printf("%s: steepness %.3f, on average %.2f of the way to the surface\n", name,
                    double{field.data.steepness}, share / tested);
    }
}

// Labels: slow no-asan
// In fine cells outside. Elsewhere the values jump.
// Labels: slow no-asan long
TEST(FreeWay, steepness_bounds_the_slope) {
    for (const FieldCase& of : field_cases()) {
        const auto& [name, mesh, field] = of;
        const double cell = double{field.cell}, step = 1e-5 * cell;
        FieldRandom random(5);
        double most = 0;
        for (int i = 0; i < 8000; ++i) {
            const reference::vec3 p = point_on(mesh, random) + random.vector(1.9 * cell);
            const auto slope = [&](reference::vec3 d) {
                return (read_exactly(field, p + d * step) - read_exactly(field, p - d * step)) / (2 * step);
            };
            if (read_exactly(field, p) <= 0) continue;
            most = std::max(
                most, testing_kernels::norm(reference::vec3(slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1}))));
        }
        EXPECT_LE(most, double{field.data.steepness} + 1e-5) << name;
        EXPECT_GT(most, 1 + 0.2 * (double{field.data.steepness} - 1)) << name;
        EXPECT_GE(field.data.steepness, 1) << name;
        if (!field.closed) continue;  // distances in holes are estimates
        EXPECT_LT(field.data.steepness, 1.7326f) << name << ": more than along three axes at once";
    }
}

}  // namespace
}  // namespace weft
