#include "editor/view/outline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft::editor {
namespace {

constexpr Camera camera{.position = {0, 0, 2}, .target = {0, 0, 0}, .fov = 90};

Image8 gray(std::uint32_t width, std::uint32_t height) {
    return {width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4, 128)};
}

TEST(Outline, covers_the_pixels_of_a_square) {
    // At a distance of 2 m, 100 pixels show 4 m.
    Coverage coverage(camera, 100, 100);
    const Vec3 corners[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const Triangle triangles[] = {{0, 1, 2}, {0, 2, 3}};
    coverage.add(corners, triangles);
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < 100; ++y)
        for (std::uint32_t x = 0; x < 100; ++x) count += coverage.at(x, y);
    EXPECT_NEAR(static_cast<double>(count), 2500, 101);
    EXPECT_TRUE(coverage.at(27, 27) && coverage.at(72, 72) && coverage.at(50, 50));
    EXPECT_FALSE(coverage.at(20, 50) || coverage.at(50, 80));

    Image8 image = gray(100, 100);
    coverage.outline(image);
    EXPECT_EQ(image.at(50, 50)[0], 128) << "the object itself stays as it is";
    EXPECT_EQ(image.at(5, 50)[0], 128) << "far from it";
    bool is_bright = false, is_dark = false;
    for (std::uint32_t x = 15; x < 25; ++x) {
        is_bright |= image.at(x, 50)[0] > 200;
        is_dark |= image.at(x, 50)[0] < 100;
    }
    EXPECT_TRUE(is_bright);
    EXPECT_TRUE(is_dark);
}

TEST(Outline, leaves_out_what_is_behind_the_eye) {
    Coverage coverage(camera, 100, 100);
    const Vec3 behind[] = {{-1, -1, 5}, {1, -1, 5}, {0, 1, 5}};
    const Triangle triangles[] = {{0, 1, 2}};
    coverage.add(behind, triangles);
    Image8 image = gray(100, 100);
    coverage.outline(image);
    EXPECT_EQ(image.rgba, gray(100, 100).rgba);
    // A strip from below the eye to far away fills the lower half of the image.
    const Vec3 strip[] = {{-100, -1, 10}, {100, -1, 10}, {0, -1, -1e5f}};
    coverage.add(strip, triangles);
    EXPECT_TRUE(coverage.at(50, 99));
    EXPECT_TRUE(coverage.at(50, 55));
    EXPECT_FALSE(coverage.at(50, 45));
}

TEST(Outline, finds_what_is_smaller_than_a_pixel_and_ignores_what_is_not_finite) {
    Coverage coverage(camera, 100, 100);
    const Vec3 tiny[] = {{0, 0, 0}, {1e-4f, 0, 0}, {0, 1e-4f, 0}};
    const Triangle triangles[] = {{0, 1, 2}};
    coverage.add(tiny, triangles);
    EXPECT_TRUE(coverage.at(50, 50) || coverage.at(50, 49));
    const Vec3 wrong[] = {{NAN, 0, 0}, {INFINITY, 0, 0}, {1e38f, 1e38f, -1e38f}};
    coverage.add(wrong, triangles);
    Image8 image = gray(100, 100);
    coverage.outline(image);
}

TEST(Outline, fits_images_of_any_size) {
    for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 1u}, {1u, 5u}, {320u, 200u}, {1000u, 4u}}) {
        Coverage coverage(camera, width, height);
        const Vec3 corners[] = {{-1e5f, -1e5f, 0}, {1e5f, -1e5f, 0}, {0, 1e5f, 0}};
        const Triangle triangles[] = {{0, 1, 2}};
        coverage.add(corners, triangles);
        Image8 image = gray(width, height);
        coverage.outline(image);
        EXPECT_EQ(image.rgba, gray(width, height).rgba) << "all of it is covered";
    }
}

}  // namespace
}  // namespace weft::editor
