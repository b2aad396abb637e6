#include "collide/winding_number.h"

#include "mesh/procedural.h"
#include "mesh/testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace weft {
namespace {

void add_mesh(TriangleMesh& to, const TriangleMesh& from, Vec3 offset) {
    const auto first = static_cast<std::uint32_t>(to.positions.size());
    for (const Vec3 p : from.positions) to.positions.push_back(p + offset);
    for (const auto& [a, b, c] : from.triangles) to.triangles.push_back({a + first, b + first, c + first});
}

TriangleMesh half_shell() {
    TriangleMesh mesh = make_sphere(1, 4);
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.positions[t[0]].y + mesh.positions[t[1]].y + mesh.positions[t[2]].y > 0;
    });
    return mesh;
}

// Largest difference between the tree and the sum of all triangles, at points in and around the mesh and at points
// close to its surface.
double largest_error(const TriangleMesh& mesh) {
    const WindingNumber winding(mesh.positions, mesh.triangles);
    std::mt19937 engine(7);
    const auto number = [&] { return static_cast<float>(engine() % 2000001) / 1000000.0f - 1; };
    const auto error_at = [&](Vec3 p) {
        return std::abs(winding.at(p) - exact_winding_number(p, mesh.positions, mesh.triangles));
    };
    double largest = 0;
    for (int i = 0; i < 400; ++i) {
        largest = std::max(largest, error_at(Vec3{number(), number(), number()} * 2.5f));
        const Triangle& t = mesh.triangles[engine() % mesh.triangles.size()];
        const Vec3 on = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) * (1.0f / 3.0f);
        largest = std::max(largest, error_at(on + Vec3{number(), number(), number()} * 0.05f));
    }
    return largest;
}

TEST(WindingNumber, is_one_inside_a_closed_surface_and_zero_outside) {
    const TriangleMesh mesh = make_sphere(1, 4);
    const WindingNumber winding(mesh.positions, mesh.triangles);
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{0.9f, 0, 0}, Vec3{0.5f, -0.5f, 0.5f}}) {
        EXPECT_NEAR(exact_winding_number(p, mesh.positions, mesh.triangles), 1, 1e-10);
        EXPECT_NEAR(winding.at(p), 1, 0.01);
    }
    for (const Vec3 p : {Vec3{0, 1.1f, 0}, Vec3{5, 0, 0}, Vec3{-2, 3, 1}}) {
        EXPECT_NEAR(exact_winding_number(p, mesh.positions, mesh.triangles), 0, 1e-10);
        EXPECT_NEAR(winding.at(p), 0, 0.01);
    }
}

TEST(WindingNumber, equals_the_sum_of_all_triangles) {
    TriangleMesh two;
    add_mesh(two, make_sphere(1, 4), {-0.4f, 0, 0});
    add_mesh(two, make_sphere(1, 4), {0.4f, 0.1f, 0});
    TriangleMesh flipped = make_sphere(1, 4);
    for (std::size_t t = 0; t < flipped.triangles.size(); t += 3) {
        std::swap(flipped.triangles[t][1], flipped.triangles[t][2]);
    }
    const struct {
        const char* name;
        TriangleMesh mesh;
    } cases[] = {
        {"sphere", make_sphere(1, 4)},  {"box", make_box({2, 1, 1.5f}, {12, 7, 9})},
        {"half shell", half_shell()},   {"overlapping spheres", two},
        {"flipped triangles", flipped},
    };
    for (const auto& [name, mesh] : cases) {
        const double error = largest_error(mesh);
        EXPECT_LT(error, 0.01) << name;
        RecordProperty(std::string("error of ") + name, std::to_string(error));
    }
}

TEST(WindingNumber, adds_up_where_surfaces_overlap) {
    TriangleMesh mesh;
    add_mesh(mesh, make_sphere(1, 3), {-0.5f, 0, 0});
    add_mesh(mesh, make_sphere(1, 3), {0.5f, 0, 0});
    const WindingNumber winding(mesh.positions, mesh.triangles);
    EXPECT_NEAR(winding.at({0, 0, 0}), 2, 0.01);
    EXPECT_NEAR(winding.at({1.2f, 0, 0}), 1, 0.01);
}

TEST(WindingNumber, of_half_a_sphere_is_one_half_in_the_middle_of_the_opening) {
    const TriangleMesh mesh = half_shell();
    const WindingNumber winding(mesh.positions, mesh.triangles);
    EXPECT_NEAR(winding.at({0, 0, 0}), 0.5, 0.02);
    EXPECT_GT(winding.at({0, -0.8f, 0}), 0.7);
    EXPECT_LT(winding.at({0, 0.5f, 0}), 0.35);
}

TEST(WindingNumber, has_a_gradient_near_holes) {
    const TriangleMesh mesh = half_shell();
    const WindingNumber winding(mesh.positions, mesh.triangles);
    for (const Vec3 p :
         {Vec3{0, 0, 0}, Vec3{0.3f, 0.1f, -0.2f}, Vec3{0.1f, -0.5f, 0}, Vec3{0, 0.8f, 0.5f}, Vec3{0.7f, 0.05f, 0.1f}}) {
        const auto slope = [&](Vec3 d) {
            return (exact_winding_number(p + d * 0.01f, mesh.positions, mesh.triangles) -
                    exact_winding_number(p - d * 0.01f, mesh.positions, mesh.triangles)) /
                   0.02;
        };
        const auto gradient = winding.gradient_at(p), exact = winding.gradient_at(p, 1e6);
        const double expected[] = {slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})};
        const double size = std::hypot(expected[0], expected[1], expected[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(exact[k], expected[k], 1e-3 * size);
            EXPECT_NEAR(gradient[k], expected[k], 0.1 * size);
        }
    }
}

TEST(WindingNumber, of_degenerate_meshes_is_finite) {
    EXPECT_EQ(WindingNumber().at({1, 2, 3}), 0);
    EXPECT_EQ(WindingNumber({}, {}).at({1, 2, 3}), 0);
    TriangleMesh mesh;
    testing_meshes::add_triangle(mesh, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    testing_meshes::add_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
    const WindingNumber winding(mesh.positions, mesh.triangles);
    for (const Vec3 p : {Vec3{1, 1, 1}, Vec3{1, 0, 0}, Vec3{0.5f, 0, 0}, Vec3{3, 1, 0}}) {
        EXPECT_TRUE(std::isfinite(winding.at(p)));
        EXPECT_TRUE(std::isfinite(winding.gradient_at(p)[0]));
    }
    const TriangleMesh fan = testing_meshes::fan(1000);
    EXPECT_TRUE(std::isfinite(WindingNumber(fan.positions, fan.triangles).at(fan.positions[0])));
}

}  // namespace
}  // namespace weft
