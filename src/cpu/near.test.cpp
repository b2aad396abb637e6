// What the cheap tests leave out of contact, contact would leave as it is.
#include "collide/convex_hull.h"
#include "cpu/instruction_sets.test.h"
#include "cpu/moving_ball.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <random>

namespace weft::cpu {
namespace {

using namespace instruction_sets;

constexpr std::uint32_t point_count = 2 * lane_padding, corners_stride = 3 * lane_padding;
constexpr float half_thickness = 0.001f, deep = 0.1f;

/// Shapes within about half a meter of their origin.
std::vector<Collider> colliders_of_all_shapes() {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 0.5f : -0.4f, i & 2 ? 0.4f : -0.5f, i & 4 ? 0.6f : -0.3f});
    const auto hull = std::make_shared<const ShapeData>(make_convex_data(*convex_hull(corners)));
    return {make_collider({.shape = SphereDesc{0.5f}}), make_collider({.shape = BoxDesc{{0.3f, 0.2f, 0.5f}}}),
            make_collider({.shape = CapsuleDesc{0.1f, 0.4f}}),
            make_collider({.shape = TaperedCapsuleDesc{{0.2f, 0.1f}, 0.4f}}),
            make_collider({.shape = ConvexDesc{.radius = 0.05f}}, hull)};
}

/// Particles around a collider at the origin, near one another and far apart, that are slow or fast.
class Near : public InstructionSet {
  protected:
    struct Case {
        AlignedVector<Vec4> position = AlignedVector<Vec4>(point_count), start = position;
        AlignedVector<float> factors;  // on the thickness; empty: 1 everywhere
        Pose before, now;
    };

    float in(float low, float high) { return std::uniform_real_distribution(low, high)(random_); }
    Vec3 vector(float size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
    Pose moved_from(const Pose& pose, float way, float degrees) {
        const Mat3 turn = rotation_from_degrees(vector(degrees));
        return {turn * pose.rotation, pose.position + vector(way)};
    }
    Case random_case() {
        Case made;
        made.now = {rotation_from_degrees(vector(180)), vector(0.1f)};
        const float way = std::pow(10.0f, in(-5, 0));
        made.before = moved_from(made.now, way, in(0, 1) < 0.2f ? 90 : 100 * way);
        const Vec3 middle = vector(1.2f);
        const float size = std::pow(10.0f, in(-2.5f, 0)), own_way = std::pow(10.0f, in(-5, 0));
        const bool follows = in(0, 1) < 0.5f;
        if (in(0, 1) < 0.5f)
            for (std::uint32_t p = 0; p < point_count; ++p) made.factors.push_back(in(0.1f, 1));
        const Vec3 common = follows ? made.now.position - made.before.position : Vec3{};
        for (std::uint32_t p = 0; p < point_count; ++p) {
            const Vec3 x = middle + vector(size), from = x + vector(own_way) - common;
            made.position[p] = {x.x, x.y, x.z, p % 7 ? 20.0f : 0.0f};
            made.start[p] = {from.x, from.y, from.z, 0};
        }
        return made;
    }
    static ParticleView view_of(Case& of) { return {&of.position[0].x, &of.start[0].x, nullptr, nullptr}; }
    static ContactView contact_view(const Collider& collider, const Case& in) {
        return {.kind = static_cast<int>(collider.shape),
                .numbers = collider.numbers,
                .data = blocks_of(collider),
                .steepness = steepness_of(collider),
                .roundness = roundness_of(collider),
                .width = width_of(collider),
                .now = in.now,
                .before = in.before,
                .static_friction = 0.4f,
                .kinetic_friction = 0.3f,
                .thickness = {half_thickness, in.factors.empty() ? nullptr : in.factors.data()},
                .depenetration = deep};
    }

    std::mt19937 random_{7};
};

TEST_P(Near, particles_that_are_left_out_would_not_be_touched) {
    std::array<std::uint32_t, 2> tested{};  // near; left out
    for (const Collider& collider : colliders_of_all_shapes()) {
        for (int trial = 0; trial < 2000; ++trial) {
            Case one = random_case();
            const bool pressed = trial % 3 == 0;
            const float widest = trial % 2 ? in(0.001f, 0.1f) : -static_cast<float>(far_away);
            AlignedVector<Vec4> sums(point_count), plane(point_count), taken(point_count), carried(point_count),
                friction(point_count), seen(point_count);
            std::vector<std::uint8_t> marks(point_count, 0);
            for (Vec4& support : plane) {
                const Vec3 normal = normalized(vector(1));
                support = {normal.x, normal.y, normal.z, in(-1, 1)};
            }
            ContactView contact = contact_view(collider, one);
            contact.sums = &sums[0].x, contact.near_faces = marks.data();
            contact.nearest = 0.5f * half_thickness, contact.widest = widest;
            if (pressed) contact.support = {&plane[0].x, &taken[0].x, &carried[0].x, &friction[0].x, &seen[0].x};

            const MovingBall ball = moving_ball(collider, ball_radius(collider), one.before, one.now, widest);
            const std::uint32_t number = 0;
            NearBalls near{.balls = &ball,
                           .half_thickness = half_thickness,
                           .nearest = contact.nearest,
                           .numbers = &number,
                           .count = 1,
                           .inside = pressed ? deep : 0};
            BodySums pushed;
            const BodyView body{2, 1, one.now.position, {}, 1200, &pushed, true};
            const auto shape = static_cast<std::uint32_t>(collider.shape);
            const Range all{0, point_count};
            const bool may_count = GetParam()->first_near(view_of(one), near, all, 0) == 0;
            GetParam()->count_touches[shape](view_of(one), contact, body, all);
            if (!may_count) {
                ASSERT_EQ(pushed.touches, 0u) << "shape " << shape << ", trial " << trial;
            }
            pushed = {};
            near.faces = true;
            const bool may_touch = GetParam()->first_near(view_of(one), near, all, 0) == 0;
            ++tested[may_touch ? 0 : 1];
            const Case before = one;
            GetParam()->touch_body[shape](view_of(one), contact, body, all);
            if (may_touch) continue;
            ASSERT_EQ(pushed.touches, 0u) << "shape " << shape << ", trial " << trial;
            for (std::uint32_t p = 0; p < point_count; ++p) {
                const Vec4 &x = one.position[p], &y = before.position[p];
                ASSERT_TRUE(x.x == y.x && x.y == y.y && x.z == y.z) << "shape " << shape << ", trial " << trial;
                ASSERT_EQ(sums[p].w, 0) << "shape " << shape << ", trial " << trial;
                ASSERT_EQ(marks[p], 0) << "shape " << shape << ", trial " << trial;
            }
        }
    }
    EXPECT_GT(tested[0], 1000u);
    EXPECT_GT(tested[1], 1000u);
}

TEST_P(Near, faces_that_are_left_out_would_have_no_contact) {
    std::array<std::uint32_t, 2> tested{};  // near; left out
    for (const Collider& collider : colliders_of_all_shapes()) {
        for (int trial = 0; trial < 1000; ++trial) {
            Case one = random_case();
            std::vector<std::uint32_t> corners(3 * corners_stride), items, rest;
            constexpr std::uint32_t faces = point_count - 2;
            for (std::uint32_t f = 0; f < faces; ++f) {
                for (std::uint32_t k = 0; k < 3; ++k) corners[k * corners_stride + f] = f + k;
                items.push_back(f);
            }
            items.resize(faces + lane_padding, 0u);
            FaceView view{.corners = corners.data(), .stride = corners_stride, .items = items.data(), .count = faces};
            AlignedVector<float> numbers(numbers_per_face * corners_stride);
            ContactView contact = contact_view(collider, one);
            contact.thickness.half = trial % 4 ? half_thickness : 0;
            const FaceMeasures measures{numbers.data(), corners_stride};
            GetParam()->measure_faces(view_of(one), view, measures);
            std::vector<std::uint32_t> near(faces + lane_padding);
            const MovingBall ball = moving_ball(collider, ball_radius(collider), one.before, one.now, 0);
            near.resize(GetParam()->near_faces(view, measures, ball, 0.5f * contact.thickness.half, near.data()));
            ASSERT_TRUE(std::ranges::is_sorted(near));
            std::ranges::set_difference(std::span(items).first(faces), near, std::back_inserter(rest));
            tested[0] += static_cast<std::uint32_t>(near.size()), tested[1] += static_cast<std::uint32_t>(rest.size());

            view.count = static_cast<std::uint32_t>(rest.size());
            rest.resize(rest.size() + lane_padding, 0u);
            view.items = rest.data();
            AlignedVector<Vec4> blocks(std::size_t{6} * corners_stride);
            AlignedVector<std::uint32_t> row_corners(std::size_t{3} * corners_stride);
            FaceRows rows;
            float** const arrays[] = {&rows.weights, &rows.plane, &rows.start, &rows.gaps, &rows.sum, &rows.lever};
            AlignedVector<Vec4> displacement(corners_stride);
            rows.displacement = &displacement[0].x;
            for (std::size_t k = 0; k < 6; ++k) *arrays[k] = &blocks[k * corners_stride].x;
            for (std::size_t k = 0; k < 3; ++k) rows.corners[k] = &row_corners[k * corners_stride];
            const auto shape = static_cast<std::uint32_t>(collider.shape);
            GetParam()->find_faces[shape](view_of(one), contact, view, rows);
            ASSERT_EQ(rows.count, 0u) << "shape " << shape << ", trial " << trial;
        }
    }
    EXPECT_GT(tested[0], 10000u);
    EXPECT_GT(tested[1], 10000u);
}

TEST_P(Near, finds_each_body_and_those_that_always_count) {
    Case one = random_case();
    for (std::uint32_t p = 0; p < point_count; ++p) one.position[p] = one.start[p] = {0, 0, 0, 1};
    const auto ball = [](float x) { return MovingBall{{x, 0, 0}, 0.5f, {}, 0, 1, 0}; };
    const std::array balls{ball(0.2f), ball(3), ball(0.4f), ball(5)};
    const std::array<std::uint32_t, 6> numbers{1, 0, none, 3, 2, 1};
    std::array<std::uint8_t, 6> always{};
    NearBalls near{.balls = balls.data(),
                   .half_thickness = half_thickness,
                   .nearest = 0,
                   .numbers = numbers.data(),
                   .always = always.data(),
                   .count = 6};
    const auto first = [&](std::uint32_t from) {
        return GetParam()->first_near(view_of(one), near, {0, point_count}, from);
    };
    EXPECT_EQ(first(0), 1u);
    EXPECT_EQ(first(2), 4u);
    EXPECT_EQ(first(5), 6u);
    always[3] = 1, always[2] = 1;
    EXPECT_EQ(first(2), 3u);
}

INSTANTIATE_TEST_SUITE_P(all, Near, testing::ValuesIn(available_passes().begin(), available_passes().end()), name_of);

}  // namespace
}  // namespace weft::cpu
