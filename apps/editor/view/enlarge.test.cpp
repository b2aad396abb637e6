#include "editor/view/enlarge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace weft::editor {
namespace {

Image8 drawn(std::uint32_t width, std::uint32_t height, const std::function<bool(double, double)>& inside) {
    Image8 image{width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4, 255)};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            for (std::size_t k = 0; k < 3; ++k) image.at(x, y)[k] = inside(x + 0.5, y + 0.5) ? 200 : 40;
    return image;
}

/// The part of each pixel that is inside, from 8 × 8 samples.
double difference_from_truth(const Image8& image, const std::function<bool(double, double)>& inside) {
    double sum = 0;
    for (std::uint32_t y = 2; y + 2 < image.height; ++y) {
        for (std::uint32_t x = 2; x + 2 < image.width; ++x) {
            int covered = 0;
            for (int i = 0; i < 64; ++i) covered += inside(x + (i % 8 + 0.5) / 8, y + (i / 8 + 0.5) / 8);
            sum += std::abs(image.at(x, y)[1] - (40 + 160 * covered / 64.0));
        }
    }
    return sum;
}

TEST(WithoutSteps, brings_slanted_edges_nearer_to_the_truth) {
    for (const double slope : {0.1, 0.23, 0.4, -0.15, 3.0, 7.0}) {
        const auto inside = [&](double x, double y) { return y - 32 > slope * (x - 32); };
        const Image8 image = drawn(64, 64, inside);
        EXPECT_LT(difference_from_truth(without_steps(image), inside), 0.6 * difference_from_truth(image, inside))
            << slope;
    }
}

TEST(WithoutSteps, leaves_straight_edges_and_smooth_images) {
    const Image8 edge = drawn(32, 32, [](double x, double) { return x > 16; });
    EXPECT_EQ(without_steps(edge).rgba, edge.rgba);
    Image8 ramp = edge;
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x)
            for (std::size_t k = 0; k < 3; ++k) ramp.at(x, y)[k] = static_cast<std::uint8_t>(4 * x + 2 * y);
    EXPECT_EQ(without_steps(ramp).rgba, ramp.rgba);
    const Image8 tiny = drawn(2, 1, [](double x, double) { return x > 1; });
    EXPECT_EQ(without_steps(tiny).rgba, tiny.rgba);
    EXPECT_TRUE(without_steps({}).rgba.empty());
}

TEST(Enlarged, interpolates_between_pixels) {
    Image8 image{2, 1, {0, 0, 0, 255, 100, 200, 40, 255}};
    const Image8 wide = enlarged(image, 8, 3);
    ASSERT_EQ(wide.width, 8u);
    ASSERT_EQ(wide.height, 3u);
    EXPECT_EQ(wide.at(0, 2)[0], 0);
    EXPECT_EQ(wide.at(7, 0)[1], 200);
    for (std::uint32_t x = 1; x < 8; ++x) {
        EXPECT_GE(wide.at(x, 1)[1], wide.at(x - 1, 1)[1]);
        EXPECT_EQ(wide.at(x, 1)[3], 255);
    }
    EXPECT_NEAR(wide.at(3, 1)[0], 37, 2);
    EXPECT_EQ(enlarged(image, 2, 1).rgba, image.rgba);
}

}  // namespace
}  // namespace weft::editor
