#include "view/legend.h"

#include "render/shading/color_scale.h"
#include "view/flat_text.h"
#include "view/nice_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft {
namespace {

using render::ColorScale;
using render::FlatVertex;

TEST(NiceNumbers, are_one_two_or_five_in_every_decade) {
    EXPECT_EQ(nice_above(0.9), 1);
    EXPECT_EQ(nice_above(1), 1);
    EXPECT_EQ(nice_above(1.01), 2);
    EXPECT_EQ(nice_above(2.5), 5);
    EXPECT_EQ(nice_above(5.1), 10);
    EXPECT_EQ(nice_above(730), 1000);
    EXPECT_EQ(nice_above(0.3), 0.5);
    EXPECT_EQ(nice_above(0.0012), 0.002);
    for (const double none : {0.0, -3.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_EQ(nice_above(none), 1);
    for (double x = 1e-9; x < 1e9; x *= 1.37) {
        EXPECT_GE(nice_above(x), x * (1 - 1e-6));
        EXPECT_LE(nice_above(x), x * 2.5);
    }
}

TEST(NiceNumbers, a_percentile_leaves_out_the_wildest) {
    std::vector<float> values;
    for (int i = 0; i <= 100; ++i) values.push_back(static_cast<float>(100 - i));
    values.push_back(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(percentile(values, 0.98), 98);
    EXPECT_EQ(percentile(values, 1), 100);
    EXPECT_EQ(percentile({}, 0.98), 0);
}

TEST(NiceNumbers, are_written_short) {
    EXPECT_EQ(short_number(0.25), "0.25");
    EXPECT_EQ(short_number(-0.0), "0");
    EXPECT_EQ(short_number(12345), "12345");
    EXPECT_EQ(short_number(3.0000001), "3");
}

TEST(Legend, has_the_numbers_of_its_ends_and_what_lies_between) {
    EXPECT_EQ(tick_texts({.least = -2, .most = 2}), (std::vector<std::string>{"-2", "-1", "0", "+1", "+2"}));
    EXPECT_EQ(tick_texts({.least = 0, .most = 50}, 3), (std::vector<std::string>{"0", "25", "50"}));
    EXPECT_EQ(tick_texts({.least = -0.5f, .most = 0.5f}),
              (std::vector<std::string>{"-0.5", "-0.25", "0", "+0.25", "+0.5"}));
}

std::vector<Legend> several(std::size_t count) {
    const Legend one{.title = "strain, %",
                     .bar = Legend::Bar{-0.5f, 0.5f, ColorScale::balance},
                     .entries = {{Vec4{1, 0, 0, 1}, "a color"}, {{}, "some text"}}};
    return std::vector<Legend>(count, one);
}

TEST(Legend, stands_in_the_lower_left_corner_of_every_picture) {
    for (const auto& [width, height] : {std::pair{1280u, 720u}, {320u, 180u}, {3840u, 2160u}, {200u, 1000u}}) {
        for (const std::size_t count : {1u, 2u, 9u}) {
            std::vector<FlatVertex> flat;
            draw_legends(several(count), width, height, flat);
            ASSERT_GT(flat.size(), 100u);
            EXPECT_EQ(flat.size() % 3, 0u);
            float right = 0, top = 1e9f, bottom = 0;
            for (const FlatVertex& corner : flat) {
                ASSERT_GE(corner.x, 0);
                ASSERT_LE(corner.x, static_cast<float>(width));
                ASSERT_GE(corner.y, 0);
                ASSERT_LE(corner.y, static_cast<float>(height));
                right = std::max(right, corner.x), top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);
            }
            EXPECT_GT(bottom, 0.9f * static_cast<float>(height));
            EXPECT_TRUE(width < height || right < 0.6f * static_cast<float>(width));
            EXPECT_TRUE(count > 1 || top > 0.5f * static_cast<float>(height));
        }
    }
}

TEST(Legend, stacks_and_leaves_out_what_has_no_room) {
    const auto drawn = [](std::size_t count, std::uint32_t height) {
        std::vector<FlatVertex> flat;
        draw_legends(several(count), 1280, height, flat);
        return flat.size();
    };
    constexpr std::size_t backdrop = 9 * 6;
    const std::size_t one = drawn(1, 720) - backdrop;
    EXPECT_EQ(drawn(2, 720) - backdrop, 2 * one);
    EXPECT_EQ(drawn(3, 720) - backdrop, 3 * one);
    EXPECT_LT(drawn(30, 720) - backdrop, 10 * one);
    EXPECT_EQ(drawn(0, 720), 0u);
    EXPECT_EQ(drawn(1, 20), 0u) << "no room at all";
}

TEST(Legend, has_the_colors_of_the_scale) {
    std::vector<FlatVertex> flat;
    draw_legends(std::vector<Legend>{{.title = "", .bar = Legend::Bar{0, 1, ColorScale::amount}}}, 1280, 720, flat);
    for (const float t : {0.0f, 0.5f, 1.0f}) {
        const auto color = shading::color_scale(t, WEFT_SCALE_AMOUNT);
        std::size_t found = 0;
        for (const FlatVertex& corner : flat) found += corner.color == Vec4{color.x, color.y, color.z, 1};
        EXPECT_GE(found, 3u) << t;
    }
}

TEST(Text, is_as_wide_as_it_is_drawn_and_takes_any_character) {
    std::vector<FlatVertex> flat;
    draw_text("strain \xc3\xa4\n%", 10, 20, 2, {1, 1, 1, 1}, flat);
    float right = 0;
    for (const FlatVertex& corner : flat) right = std::max(right, corner.x);
    EXPECT_GT(right, 10 + text_width("strain"));
    EXPECT_LE(right, 10 + 2 * text_width("strain \xc3\xa4\n%"));
    std::string all;
    for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
    draw_text(all, 0, 0, 1, {}, flat);
    EXPECT_EQ(text_width(""), 0);
}

// Relative luminance of an sRGB color.
float luminance(glm::vec3 c) {
    const auto linear = [](float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); };
    return 0.2126f * linear(c.x) + 0.7152f * linear(c.y) + 0.0722f * linear(c.z);
}

TEST(ColorScale, of_amounts_grows_lighter_all_the_way) {
    float before = -1;
    for (int i = 0; i <= 100; ++i) {
        const float now = luminance(shading::color_scale(static_cast<float>(i) / 100, WEFT_SCALE_AMOUNT));
        EXPECT_GT(now, before) << i;
        before = now;
    }
}

TEST(ColorScale, of_balance_is_lightest_in_the_middle_blue_below_and_red_above) {
    const auto at = [](float t) { return shading::color_scale(t, WEFT_SCALE_BALANCE); };
    for (int i = 0; i < 50; ++i) {
        const float t = static_cast<float>(i) / 100, next = t + 0.01f;
        EXPECT_LT(luminance(at(t)), luminance(at(next))) << t;
        EXPECT_LT(luminance(at(1 - t)), luminance(at(1 - next))) << t;
        EXPECT_GT(at(t).z, at(t).x) << "blue";
        EXPECT_GT(at(1 - t).x, at(1 - t).z) << "red";
    }
    EXPECT_EQ(at(0.5f).x, at(0.5f).y);
}

TEST(ColorScale, stays_within_its_ends) {
    for (const int kind : {WEFT_SCALE_BALANCE, WEFT_SCALE_AMOUNT}) {
        const auto at = [&](float t) { return shading::color_scale(t, kind); };
        EXPECT_EQ(at(-5), at(0));
        EXPECT_EQ(at(7), at(1));
        EXPECT_EQ(at(std::nanf("")), at(1));
        for (float t = 0; t <= 1; t += 0.01f)
            for (int channel = 0; channel < 3; ++channel) EXPECT_TRUE(at(t)[channel] >= 0 && at(t)[channel] <= 1);
    }
}

Image8 gray(std::uint32_t width, std::uint32_t height) {
    Image8 image{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 128)};
    return image;
}

// Each pixel once, also on the diagonal between both triangles of a rectangle, and none outside.
TEST(FlatTriangles, are_drawn_onto_images) {
    Image8 image = gray(20, 12);
    std::vector<FlatVertex> flat;
    draw_rectangle(3, 2, 15, 9, {1, 0, 0, 0.5f}, flat);
    draw_onto(image, flat);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const bool inside = x >= 3 && x < 15 && y >= 2 && y < 9;
            EXPECT_EQ(image.at(x, y)[0], inside ? 192 : 128) << x << ' ' << y;
            EXPECT_EQ(image.at(x, y)[1], inside ? 64 : 128) << x << ' ' << y;
        }
    }
    // A gradient from side to side, and what lies partly outside.
    flat.clear();
    draw_gradient(-10, -5, 30, 40, {0, 0, 0, 1}, {1, 1, 1, 1}, flat);
    draw_onto(image, flat);
    EXPECT_NEAR(image.at(0, 0)[0], 255 * 10.5 / 40, 1);
    EXPECT_NEAR(image.at(19, 11)[2], 255 * 29.5 / 40, 1);
    Image8 empty;
    draw_onto(empty, flat);
    flat.pop_back();
    draw_onto(image, flat);  // two corners are no triangle
}

TEST(Legends, are_drawn_onto_images) {
    Image8 image = gray(640, 360);
    std::vector<FlatVertex> flat;
    const Legend legend{.title = "strain, %", .bar = Legend::Bar{-1, 1, ColorScale::balance}};
    draw_legends(std::span(&legend, 1), image.width, image.height, flat);
    draw_onto(image, flat);
    EXPECT_LT(image.at(20, 350)[0], 100) << "backdrop";
    EXPECT_EQ(image.at(500, 100)[0], 128);
    bool blue = false, red = false;
    for (std::uint32_t x = 0; x < 200; ++x) {
        for (std::uint32_t y = 300; y < 360; ++y) {
            const std::uint8_t* c = image.at(x, y);
            blue = blue || c[2] > c[0] + 100;
            red = red || c[0] > c[2] + 100;
        }
    }
    EXPECT_TRUE(blue && red);
}

}  // namespace
}  // namespace weft
