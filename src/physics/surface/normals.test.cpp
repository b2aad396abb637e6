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

}  // namespace
}  // namespace weft
