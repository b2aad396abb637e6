#include "solver/world/air.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

Vec3 velocity(const WindDesc& wind, Vec3 p, double time = 0) {
    return wind_velocity({wind_at(wind, time)}, p, 0);
}

WindDesc jet_from(Vec3 position, Vec3 rotation = {}) {
    return {.kind = JetDesc{0.2f},
            .velocity = {10, 0, 0},
            .transform = {.position = position, .rotation_degrees = rotation}};
}

TEST(WindSource, stands_and_points_as_its_transform_says) {
    EXPECT_NEAR(velocity(jet_from({1, 2, 3}), {1.5f, 2, 3}).x, 10, 1e-5f);
    EXPECT_EQ(length(velocity(jet_from({1, 2, 3}), {0.9f, 2, 3})), 0) << "behind the nozzle";
    const Vec3 up = velocity(jet_from({1, 2, 3}, {0, 0, 90}), {1, 2.5f, 3});
    EXPECT_NEAR(up.y, 10, 1e-5f);
    EXPECT_NEAR(up.x, 0, 1e-5f);
    // The axis of a vortex is its y axis.
    const WindDesc vortex{.kind = VortexDesc{.swirl = 4, .radius = 0.3f},
                          .transform = {.rotation_degrees = {90, 0, 0}}};
    const Vec3 around = velocity(vortex, {0.3f, 0, 7});
    EXPECT_NEAR(around.y, 4, 1e-4f) << "right-handed around z";
    EXPECT_NEAR(around.x, 0, 1e-5f);
}

TEST(WindSource, follows_its_keys_in_place_direction_and_strength) {
    WindDesc wind = jet_from({});
    wind.motion = {{.time = 1, .strength = 0},
                   {.time = 3, .position = {2, 0, 0}, .rotation_degrees = {0, 0, 90}, .strength = 2}};
    EXPECT_EQ(length(velocity(wind, {0.5f, 0, 0}, 0)), 0) << "before the first key";
    const WindNow half = wind_at(wind, 2);
    EXPECT_NEAR(half.position.x, 1, 1e-6f);
    EXPECT_NEAR(half.vectors[0].x, 10 * std::sqrt(0.5f), 1e-5f);
    EXPECT_NEAR(half.vectors[0].y, 10 * std::sqrt(0.5f), 1e-5f);
    EXPECT_EQ(half.strength, 1);
    EXPECT_NEAR(length(velocity(wind, {1.2f, 0.2f, 0}, 2)), 10, 1e-4f);
    EXPECT_NEAR(velocity(wind, {2, 0.5f, 0}, 3).y, 20, 1e-4f);
    EXPECT_NEAR(velocity(wind, {2, 0.5f, 0}, 9).y, 20, 1e-4f) << "after the last key";
}

TEST(WindSource, without_a_transform_has_the_bits_that_it_had) {
    const WindDesc plain{.velocity = {7, -1, 1.5f}};
    WindDesc moved = plain;
    moved.motion = {{.time = 0}, {.time = 1}};
    const WindNow a = wind_at(plain, 0.4), b = wind_at(moved, 0.4);
    EXPECT_EQ(a.vectors, b.vectors);
    EXPECT_EQ(a.vectors[0], plain.velocity);
    EXPECT_EQ(velocity(plain, {0.1f, 0.2f, 0.3f}), plain.velocity);
}

TEST(WindSource, of_any_kind_ends_at_its_box) {
    for (WindDesc wind : {WindDesc{.velocity = {3, 0, 0}}, jet_from({0, 0, 0}),
                          WindDesc{.kind = VortexDesc{.radius = 0.3f}, .velocity = {0, 1, 0}}}) {
        const Vec3 p{0.4f, 0.01f, 0.02f};
        const Vec3 open = velocity(wind, p);
        ASSERT_GT(length(open), 0);
        wind.box = WindBoxDesc{.half_extents = {0.5f, 0.5f, 0.5f}, .border = 0.2f};
        EXPECT_EQ(velocity(wind, p), open) << "inside it is as without";
        wind.box->half_extents.x = 0.3f;
        EXPECT_NEAR(length(velocity(wind, p) - open * 0.5f), 0, 1e-5f) << "in the middle of the border";
        wind.box->half_extents.x = 0.19f;
        EXPECT_EQ(length(velocity(wind, p)), 0);
        wind.box->border = 0;
        wind.box->half_extents.x = 0.41f;
        EXPECT_EQ(velocity(wind, p), open) << "without a border";
        wind.box->half_extents.x = 0.39f;
        EXPECT_EQ(length(velocity(wind, p)), 0);
    }
    // The box turns and moves with the source.
    WindDesc wind{.velocity = {3, 0, 0}, .transform = {.position = {5, 0, 0}, .rotation_degrees = {0, 0, 90}}};
    wind.box = WindBoxDesc{.half_extents = {2, 0.1f, 0.1f}, .border = 0};
    EXPECT_NEAR(velocity(wind, {5, 1.9f, 0}).y, 3, 1e-5f);
    EXPECT_EQ(length(velocity(wind, {6, 0, 0})), 0);
}

TEST(WindSources, add_up) {
    const WindDesc breeze{.velocity = {1, 2, 3}, .gust = {.amplitude = 0.5f}, .turbulence = {.strength = 0.5f}};
    const WindDesc fan = jet_from({0, 0.1f, 0}), vortex{.kind = VortexDesc{}, .seed = 4};
    const Vec3 p{0.3f, 0.1f, 0.05f};
    const Vec3 sum = wind_velocity({wind_at(breeze, 1), wind_at(fan, 1), wind_at(vortex, 1)}, p, 7);
    const Vec3 apart = velocity(breeze, p, 1) + velocity(fan, p, 1) + velocity(vortex, p, 1);
    EXPECT_NEAR(length(sum - apart), 0, 1e-5f);
}

TEST(WindSource, of_any_kind_has_gusts_and_moving_noise_of_its_own_seed) {
    for (WindDesc wind :
         {WindDesc{.velocity = {3, 0, 0}}, jet_from({0, 0, 0}), WindDesc{.kind = VortexDesc{.radius = 0.3f}}}) {
        const Vec3 p{0.4f, 0.01f, 0.02f};
        const float still = length(velocity(wind, p, 0));
        EXPECT_EQ(length(velocity(wind, p, 3)), still);
        wind.turbulence = {.strength = 0.8f, .scale = 0.3f, .period = 0.5f};
        EXPECT_NE(length(velocity(wind, p, 0.3)), length(velocity(wind, p, 0.4)));
        WindDesc other = wind;
        other.seed = 77;
        EXPECT_NE(length(velocity(wind, p, 0.3)), length(velocity(other, p, 0.3)));
        wind.turbulence = {};
        wind.gust = {.amplitude = 0.5f, .frequency = 1};
        EXPECT_NE(length(velocity(wind, p, 0)), length(velocity(wind, p, 0.3)));
    }
}

TEST(WindSource, is_never_faster_than_its_top_speed) {
    WindDesc vortex{.kind = VortexDesc{.swirl = 4, .inflow = -3, .radius = 0.3f}, .velocity = {0, 2, 0}};
    vortex.gust = {.amplitude = 0.5f}, vortex.turbulence = {.strength = 0.5f, .scale = 0.1f};
    vortex.motion = {{.time = 0, .strength = 0.5f}, {.time = 5, .strength = 3}};
    WindDesc jet = jet_from({});
    jet.gust = {.amplitude = 0.5f};
    double most = 0;
    for (int i = 0; i < 3000; ++i) {
        const float x = static_cast<float>(i) * 3e-4f;
        const Vec3 p{x, 0.3f * x, 0.1f};
        for (const WindDesc& wind : {vortex, jet}) {
            const double speed = length(velocity(wind, p, 0.01 * i)), top = top_speed(wind);
            EXPECT_LE(speed, top * 1.00001);
            most = std::max(most, speed / top);
        }
    }
    EXPECT_GT(most, 0.5);
}

}  // namespace
}  // namespace weft
