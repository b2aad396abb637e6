#include "mesh/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace weft {
namespace {

using Corners = std::vector<std::array<double, 2>>;

double area_of_flat(const Corners& corners, const Triangle& t) {
    const auto& [a, b, c] = t;
    return 0.5 * ((corners[b][0] - corners[a][0]) * (corners[c][1] - corners[a][1]) -
                  (corners[b][1] - corners[a][1]) * (corners[c][0] - corners[a][0]));
}

TEST(Polygon, is_divided_into_triangles_with_an_area) {
    const Corners square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    Corners triangle;  // with nine corners on each side
    for (int i = 0; i < 9; ++i) triangle.push_back({i / 9.0, 0});
    for (int i = 0; i < 9; ++i) triangle.push_back({1 - i / 9.0, i / 9.0});
    for (int i = 0; i < 9; ++i) triangle.push_back({0, 1 - i / 9.0});
    const Corners one_side{{0, 0}, {0.2, 0}, {0.5, 0}, {0.9, 0}, {1, 0}, {0.3, 0.7}};
    for (const Corners& corners : {square, triangle, one_side}) {
        double sum = 0;
        const std::vector<Triangle> triangles = triangulate_polygon(corners);
        ASSERT_EQ(triangles.size(), corners.size() - 2);
        for (const Triangle& t : triangles) {
            EXPECT_GT(area_of_flat(corners, t), 1e-4);
            sum += area_of_flat(corners, t);
        }
        double whole = 0;
        for (std::uint32_t i = 2; i < corners.size(); ++i) whole += area_of_flat(corners, {0, i - 1, i});
        EXPECT_NEAR(sum, whole, 1e-12);
    }
}

TEST(Polygon, with_many_or_few_corners_is_divided_too) {
    EXPECT_TRUE(triangulate_polygon(Corners{}).empty());
    EXPECT_TRUE(triangulate_polygon(Corners{{0, 0}, {1, 0}}).empty());
    EXPECT_EQ(triangulate_polygon(Corners{{0, 0}, {1, 0}, {0, 1}}), (std::vector<Triangle>{{0, 1, 2}}));
    Corners circle;
    for (int i = 0; i < 200; ++i) {
        const double angle = 2 * std::numbers::pi * i / 200;
        circle.push_back({std::cos(angle), std::sin(angle)});
    }
    EXPECT_EQ(triangulate_polygon(circle).size(), 198u);
}

}  // namespace
}  // namespace weft
