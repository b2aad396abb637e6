#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::TangentFrame;

TEST(Tangents, of_a_face_solve_its_uv_system) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const vec3 a = random.vector(2), b = random.vector(2), c = random.vector(2);
        const double du1 = random.number(-1, 1), dv1 = random.number(-1, 1);
        const double du2 = random.number(-1, 1), dv2 = random.number(-1, 1);
        if (std::abs(du1 * dv2 - du2 * dv1) < 0.01) continue;
        const TangentFrame f = reference::face_tangents(a, b, c, du1, dv1, du2, dv2);
        EXPECT_LT(norm(f.tangent * du1 + f.bitangent * dv1 - (b - a)), 1e-10);
        EXPECT_LT(norm(f.tangent * du2 + f.bitangent * dv2 - (c - a)), 1e-10);
    }
}

TEST(Tangents, of_uvs_without_an_area_are_nothing) {
    const vec3 a(0, 0, 0), b(1, 0, 0), c(0, 0, 1);
    for (const double scale : {0.0, 1.0, 1e-20}) {
        const TangentFrame f = reference::face_tangents(a, b, c, 1 * scale, 2 * scale, 2 * scale, 4 * scale);
        EXPECT_EQ(norm(f.tangent) + norm(f.bitangent), 0);
    }
}

TEST(Tangents, are_unit_and_across_the_normal_whatever_the_sum) {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        vec3 n = random.vector(1);
        n = n * (1 / norm(n));
        const double size = std::pow(10.0, random.number(-9, 9));
        // Now and then nothing, and now and then along the normal.
        const vec3 sum = i % 3 == 0 ? vec3(0.0) : i % 3 == 1 ? n * size : random.vector(size);
        double handedness = 0;
        const vec3 t = reference::unit_tangent({sum, random.vector(size)}, n, handedness);
        EXPECT_NEAR(norm(t), 1, 1e-12);
        EXPECT_NEAR(reference::dot(t, n), 0, 1e-5);
        EXPECT_EQ(std::abs(handedness), 1);
    }
}

TEST(Tangents, of_mirrored_uvs_have_the_other_hand) {
    const vec3 a(0, 0, 0), b(0, 0, 1), c(1, 0, 0), n(0, 1, 0);  // counter-clockwise from above
    double hand = 0;
    reference::unit_tangent(reference::face_tangents(a, b, c, 0, 1, 1, 0), n, hand);  // u along x, v along z
    const double first = hand;
    reference::unit_tangent(reference::face_tangents(a, b, c, 0, 1, -1, 0), n, hand);
    EXPECT_EQ(first, -hand);
    EXPECT_EQ(first, -1) << "y × x = -z, and v grows along z";
}

// A wave y = a sin(kx) whose u is x and v is -z: the tangent is the slope of the wave.
TEST(Tangents, of_a_wave_converge_to_the_surface_s) {
    const double amplitude = 0.1, k = 3, cell = 0.01;
    const auto at = [&](double x, double z) { return vec3(x, amplitude * std::sin(k * x), z); };
    for (double x = -1; x < 1; x += 0.1) {
        TangentFrame sum{vec3(0.0), vec3(0.0)};
        for (int quadrant = 0; quadrant < 4; ++quadrant) {
            const double sx = quadrant & 1 ? cell : -cell, sz = quadrant & 2 ? cell : -cell;
            const TangentFrame f = reference::face_tangents(at(x, 0), at(x + sx, 0), at(x, sz), sx, 0, 0, -sz);
            sum.tangent = sum.tangent + f.tangent, sum.bitangent = sum.bitangent + f.bitangent;
        }
        vec3 slope(1, amplitude * k * std::cos(k * x), 0), n(-slope.y, 1, 0);
        n = n * (1 / norm(n));
        double hand = 0;
        const vec3 t = reference::unit_tangent(sum, n, hand);
        EXPECT_LT(norm(t - slope * (1 / norm(slope))), 1e-3) << x;
        EXPECT_EQ(hand, 1);
    }
}

TEST(Tangents, of_garbage_are_finite) {
    for (const float size : {0.0f, 1e-30f, 1e-12f, 1e12f, 1e18f}) {
        const scalar::vec3 p(size, -size, size), q(-size, size, 0.0f), r(0.0f, 0.0f, size);
        const scalar::TangentFrame f = scalar::face_tangents(p, q, r, size, 0, 0, size);
        float hand = 0;
        const scalar::vec3 t = scalar::unit_tangent(f, {0, 1, 0}, hand);
        EXPECT_TRUE(std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.z)) << size;
    }
}

}  // namespace
}  // namespace weft
