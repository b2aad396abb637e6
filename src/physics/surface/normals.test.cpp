#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;

TEST(Normals, of_a_face_is_twice_its_area_long_and_faces_the_counter_clockwise_side) {
    const vec3 n = reference::face_normal({0, 0, 0}, {0, 0, 2}, {3, 0, 0});
    EXPECT_LT(norm(n - vec3(0, 6, 0)), 1e-15);
}

TEST(Normals, are_unit_vectors_whatever_the_faces) {
    Random random(8);
    for (int i = 0; i < 100; ++i) {
        const double size = std::pow(10.0, random.number(-6, 6));
        const vec3 a = random.vector(size), b = random.vector(size), c = random.vector(size);
        const vec3 n = reference::unit_normal(reference::face_normal(a, b, c));
        EXPECT_NEAR(norm(n), 1, 1e-12);
        EXPECT_NEAR(reference::dot(n, b - a), 0, 1e-9 * size);
    }
}

TEST(Normals, of_nothing_point_up) {
    const scalar::vec3 p(1, 2, 3);
    const scalar::vec3 n = scalar::unit_normal(scalar::face_normal(p, p, p));
    EXPECT_EQ(n.y, 1);
}

TEST(Normals, of_faces_beyond_floats_point_up) {
    for (const float size : {1e10f, 1e15f, 1e30f}) {
        const scalar::vec3 a(size, 0.0f, 0.0f), b(0.0f, size, 0.0f), c(0.0f, 0.0f, size);
        const scalar::vec3 n = scalar::unit_normal(scalar::face_normal(a, b, c));
        EXPECT_EQ(n.x, 0);
        EXPECT_EQ(n.y, 1);
        EXPECT_EQ(n.z, 0);
    }
}

// A height field y = a sin(kx): the normal at a vertex of a fine grid is that of the surface.
TEST(Normals, of_a_wave_converge_to_the_surface_s) {
    const double amplitude = 0.1, k = 3, cell = 0.01;
    const auto at = [&](double x, double z) { return vec3(x, amplitude * std::sin(k * x), z); };
    for (double x = -1; x < 1; x += 0.1) {
        vec3 sum(0.0);
        for (int quadrant = 0; quadrant < 4; ++quadrant) {  // the four cells around, cut both ways
            const double sx = quadrant & 1 ? cell : -cell, sz = quadrant & 2 ? cell : -cell;
            const vec3 o = at(x, 0), px = at(x + sx, 0), pz = at(x, sz);
            sum = sum + (sx * sz > 0 ? reference::face_normal(o, pz, px) : reference::face_normal(o, px, pz));
        }
        const vec3 slope(-amplitude * k * std::cos(k * x), 1, 0);
        EXPECT_LT(norm(reference::unit_normal(sum) - slope * (1 / norm(slope))), 1e-3) << x;
    }
}

// Normals (t, 1, 0), normalized, with t = tilt(column), on a grid of cells with alternating diagonals: the smoothed
// slope t of the normal at a particle of column 0 with eight triangles, or with four.
double smoothed_slope(bool eight, double (*tilt)(int column)) {
    const auto normal = [&](int column) {
        const vec3 n(tilt(column), 1, 0);
        return n * (1 / norm(n));
    };
    vec3 sum(0.0);
    for (const int x : {-1, 1}) {
        for (int row = 0; row < 2; ++row) {  // the cells on both sides of the row
            const vec3 face(0, 1, 0);
            if (eight) {  // the diagonal of the cell begins here
                sum = sum + reference::smooth_face(face, normal(0), normal(x), normal(x));
                sum = sum + reference::smooth_face(face, normal(0), normal(x), normal(0));
            } else {
                sum = sum + reference::smooth_face(face, normal(0), normal(x), normal(0));
            }
        }
    }
    const vec3 n = reference::unit_normal(sum);
    return n.x / n.y;
}

TEST(SmoothNormals, keep_long_waves_and_lose_the_zigzag_of_single_cells) {
    constexpr double slope = 1e-3;
    const auto constant = [](int) { return slope; };
    const auto zigzag = [](int column) { return column % 2 == 0 ? slope : -slope; };
    const auto four_cells = [](int column) { return column % 2 == 0 ? slope : 0.0; };
    for (const bool eight : {false, true}) EXPECT_NEAR(smoothed_slope(eight, constant), slope, 1e-9);
    EXPECT_NEAR(smoothed_slope(true, zigzag), 0, 1e-9);
    EXPECT_NEAR(smoothed_slope(false, zigzag), slope / 3, 1e-9);
    EXPECT_NEAR(smoothed_slope(true, four_cells), slope / 2, 1e-9);
    EXPECT_NEAR(smoothed_slope(false, four_cells), slope * 2 / 3, 1e-9);
}

TEST(SmoothNormals, weigh_triangles_by_their_area_and_ignore_those_without) {
    const vec3 up(0, 1, 0), side(1, 0, 0);
    const vec3 sum =
        reference::smooth_face(vec3(0, 0, 3), up, up, up) + reference::smooth_face(vec3(0, 0, 0), side, side, side);
    EXPECT_LT(norm(sum - vec3(0, 9, 0)), 1e-12);
}

}  // namespace
}  // namespace weft
