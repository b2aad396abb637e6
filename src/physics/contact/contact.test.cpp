#include "physics/testing.h"

namespace weft {
namespace {

using namespace testing_kernels;
using reference::ContactBody;
using reference::ContactSum;
using reference::ShapeNumbers;

constexpr double depenetration = 0.001;

ContactBody body_at(vec3 now, vec3 before, double static_friction, double kinetic_friction, double half = 0) {
    const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    return {x, y, z, now, x, y, z, before, static_friction, kinetic_friction, half, depenetration};
}

ContactSum fresh() {
    return {vec3(0.0), 0};
}

// One substep's contact with the ground plane y = 0 of a particle that went from start to x.
vec3 on_ground(vec3 start, vec3 x, const ContactBody& body, double w = 1) {
    ContactSum sum = fresh();
    vec3 n;
    const ShapeNumbers ground{0, 1, 0, 0, {}};
    const vec3 local = reference::to_body(body, x);
    const double gap = reference::distance_plane(local, ground, n) - body.half_thickness;
    vec3 unused;
    const double gap_start =
        reference::distance_plane(reference::to_body_at_start(body, start), ground, unused) - body.half_thickness;
    reference::project_contact(x, start, w, sum, gap, gap_start, n, reference::carried_by(body, local), body);
    return x;
}

TEST(Contact, distances_and_normals) {
    vec3 n;
    EXPECT_NEAR(reference::distance_plane({3, 2, 1}, {0, 1, 0, 0.5, {}}, n), 1.5, 1e-15);
    EXPECT_NEAR(reference::distance_sphere({3, 4, 0}, {2, 0, 0, 0, {}}, n), 3, 1e-15);
    EXPECT_LT(norm(n - vec3(0.6, 0.8, 0)), 1e-15);
    EXPECT_NEAR(reference::distance_sphere({0, 0, 0}, {2, 0, 0, 0, {}}, n), -2, 1e-15);
    EXPECT_NEAR(norm(n), 1, 1e-15) << "even at the center there is a way out";
}

TEST(Contact, normals_are_gradients_of_the_distance) {
    Random random(6);
    for (int i = 0; i < 100; ++i) {
        vec3 p[1] = {random.vector(2)};
        vec3 n, unused;
        reference::distance_sphere(p[0], {0.7, 0, 0, 0, {}}, n);
        expect_gradient(
            p, std::span<const vec3>(&n, 1),
            [&] {
                return reference::distance_sphere(p[0], {0.7, 0, 0, 0, {}}, unused);
            },
            1e-7);
    }
}

TEST(Contact, keeps_half_a_thickness_away) {
    const vec3 x = on_ground({0, 0.1, 0}, {0, -0.05, 0}, body_at(vec3(0.0), vec3(0.0), 0, 0, 0.01));
    EXPECT_NEAR(x.y, 0.01, 1e-15);
    EXPECT_NEAR(on_ground({0, 0.1, 0}, {0, 0.02, 0}, body_at(vec3(0.0), vec3(0.0), 0, 0, 0.01)).y, 0.02, 1e-15);
}

TEST(Contact, a_pinned_particle_is_left_alone) {
    EXPECT_EQ(on_ground({0, -1, 0}, {0, -1, 0}, body_at(vec3(0.0), vec3(0.0), 1, 1), 0).y, -1);
}

TEST(Contact, old_overlap_leaves_slowly_and_never_deepens) {
    const ContactBody body = body_at(vec3(0.0), vec3(0.0), 0, 0);
    EXPECT_NEAR(on_ground({0, -0.5, 0}, {0, -0.6, 0}, body).y, -0.5 + depenetration, 1e-15);
    EXPECT_NEAR(on_ground({0, -0.5, 0}, {0, -0.2, 0}, body).y, -0.2, 1e-15) << "leaving by itself is welcome";
    EXPECT_NEAR(on_ground({0, -0.5 * depenetration, 0}, {0, -0.1, 0}, body).y, 0, 1e-15);
}

TEST(Contact, sticks_within_the_static_cone_and_slides_by_the_kinetic_one_beyond) {
    const ContactBody body = body_at(vec3(0.0), vec3(0.0), 0.5, 0.3);
    // Pushed out by 0.1: static friction holds up to 0.05 of slip.
    EXPECT_NEAR(on_ground({0, 0, 0}, {0.049, -0.1, 0}, body).x, 0, 1e-15);
    const vec3 slid = on_ground({0, 0, 0}, {0.06, -0.1, 0.08}, body);
    EXPECT_NEAR(norm(vec3(slid.x, 0, slid.z)), 0.1 - 0.3 * 0.1, 1e-15);
    EXPECT_NEAR(slid.z / slid.x, 8.0 / 6, 1e-12) << "along its own way";
    EXPECT_NEAR(on_ground({0, 0, 0}, {0.06, 0.01, 0}, body).x, 0.06, 1e-15) << "no push, no friction";
}

TEST(Contact, iterations_share_one_cone) {
    const ContactBody body = body_at(vec3(0.0), vec3(0.0), 0.3, 0.3);
    const vec3 start(0, 0, 0);
    vec3 x(1, -0.1, 0);
    ContactSum sum = fresh();
    for (int i = 0; i < 10; ++i) reference::project_contact(x, start, 1, sum, x.y, 0, {0, 1, 0}, vec3(0.0), body);
    EXPECT_NEAR(x.x, 1 - 0.3 * 0.1, 1e-12) << "not ten times the friction";
    // If a later iteration pushes the particle back, the friction that is no longer needed is removed.
    x.x -= 0.99;
    reference::project_contact(x, start, 1, sum, x.y, 0, {0, 1, 0}, vec3(0.0), body);
    EXPECT_NEAR(x.x, 0, 1e-12);
}

TEST(Contact, a_moving_body_carries_what_rests_on_it) {
    const ContactBody belt = body_at({0.02, 0, 0}, {0, 0, 0}, 0.5, 0.5);
    EXPECT_NEAR(on_ground({0, 0, 0}, {0, -0.1, 0}, belt).x, 0.02, 1e-15);
    const ContactBody lift = body_at({0, 0.03, 0}, {0, 0, 0}, 0, 0);
    EXPECT_NEAR(on_ground({0, 0, 0}, {0, 0, 0}, lift).y, 0.03, 1e-15);
}

TEST(Contact, float_survives_degenerate_input) {
    const scalar::vec3 ex(1, 0, 0), ey(0, 1, 0), ez(0, 0, 1), o(0.0f);
    const scalar::ContactBody body{ex, ey, ez, o, ex, ey, ez, o, 1e30f, 1e30f, 0, 1e-3f};
    for (const float d : {0.0f, 1e-30f, 1e10f}) {
        scalar::vec3 x(d, -d, d), n;
        scalar::ContactSum sum{scalar::vec3(0.0f), 0};
        const float gap = scalar::distance_sphere(x, {1, 0, 0, 0, {}}, n);
        scalar::project_contact(x, scalar::vec3(0.0f), 1.0f, sum, gap, -1, n, o, body);
        EXPECT_TRUE(std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z)) << d;
    }
}

}  // namespace
}  // namespace weft
