// The image distance responds to visible changes and ignores invisible ones.

#include "measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace weft {
namespace {

constexpr std::uint32_t width = 160, height = 90;

std::uint8_t encoded(float linear) {
    const float c = std::clamp(linear, 0.0f, 1.0f);
    const float s = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255 * s));
}

struct Scene {
    float brightness = 1;
    bool shadow = true;
    float tilt = 0;  // rad, of normals
    float blue = 1;
    float shift = 0;  // pixels
};

/// A synthetic image: a red ball with its shadow on gray paper.
Image8 drawn(const Scene& scene) {
    Image8 image{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const float px = (static_cast<float>(x) - 80 - scene.shift) / 24, py = (40 - static_cast<float>(y)) / 24;
            float light[3] = {0.55f, 0.54f, 0.52f};
            const float sx = (px + 1.2f) / 1.2f, sy = (py + 1.1f) / 0.35f;
            if (scene.shadow && sx * sx + sy * sy < 1)
                for (float& c : light) c *= 0.5f;
            if (px * px + py * py < 1) {
                const float pz = std::sqrt(1 - px * px - py * py);
                const float a = 0.7f + scene.tilt,
                            facing = px * std::sin(a) * 0.8f + py * 0.6f + pz * std::cos(a) * 0.8f;
                light[0] = 0.1f + 0.5f * std::max(0.0f, facing);
                light[1] = light[2] = 0.3f * light[0];
            }
            light[2] *= scene.blue;
            for (const float c : light) image.rgba.push_back(encoded(c * scene.brightness));
            image.rgba.push_back(255);
        }
    }
    return image;
}

TEST(PictureMeasure, a_picture_is_like_itself) {
    const PictureDistance same = distance_of(drawn({}), drawn({}));
    EXPECT_EQ(same.mean, 0);
    EXPECT_EQ(same.worst, 0);
}

TEST(PictureMeasure, sees_what_an_eye_sees) {
    const Image8 good = drawn({});
    const auto seen = [&](const Scene& scene) { return !alike(distance_of(good, drawn(scene))); };
    EXPECT_TRUE(seen({.brightness = 1.05f})) << "5 % brighter";
    EXPECT_TRUE(seen({.brightness = 0.95f})) << "5 % darker";
    EXPECT_TRUE(seen({.shadow = false})) << "a missing shadow";
    EXPECT_TRUE(seen({.tilt = 0.2f})) << "wrong normals";
    EXPECT_TRUE(seen({.blue = 0.9f})) << "a yellow tint";
    EXPECT_TRUE(seen({.shift = 2})) << "in another place";
}

TEST(PictureMeasure, does_not_see_noise_and_rounding) {
    const Image8 good = drawn({});
    Image8 noisy = good;
    std::mt19937 random(1);
    for (std::size_t i = 0; i < noisy.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const std::uint32_t dice = random() % 8;  // a quarter of all numbers is off by one
        const int value = noisy.rgba[i] + (dice == 0) - (dice == 1);
        noisy.rgba[i] = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
    }
    EXPECT_TRUE(alike(distance_of(good, noisy))) << distance_of(good, noisy).mean;
    for (std::uint32_t i = 0; i < 40; ++i)  // a few pixels of edges
        for (int c = 0; c < 3; ++c) noisy.at(random() % width, random() % height)[c] ^= 16;
    EXPECT_TRUE(alike(distance_of(good, noisy))) << distance_of(good, noisy).worst;
}

TEST(PictureMeasure, alpha_counts) {
    Image8 clear = drawn({}), full = clear;
    for (std::size_t i = 3; i < clear.rgba.size(); i += 4) clear.rgba[i] = 200;
    EXPECT_FALSE(alike(distance_of(clear, full)));
    for (std::size_t i = 0; i < clear.rgba.size(); ++i) {
        clear.rgba[i] = i % 4 == 3 ? 0 : clear.rgba[i];
        full.rgba[i] = 0;
    }
    EXPECT_TRUE(alike(distance_of(clear, full))) << "what is not covered has no color";
}

TEST(PictureMeasure, other_sizes_are_other_pictures) {
    EXPECT_FALSE(alike(distance_of(drawn({}), Image8{2, 2, std::vector<std::uint8_t>(16)})));
    EXPECT_FALSE(alike(distance_of({}, {})));
}

}  // namespace
}  // namespace weft
