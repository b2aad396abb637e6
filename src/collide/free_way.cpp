#include "collide/free_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr double root3 = 1.7320509;

// Points of the cube on a grid of this spacing are examined. Between them, the interpolation of a distance is larger
// than the distance by at most excess().
std::uint32_t spacing_for(double least_distance, std::uint32_t side) {
    return least_distance >= 2 * side ? side : least_distance >= side ? side / 2 : 2;
}

// A distance to a set curves upward at most as that to its nearest point does: in two directions, by 1 / distance. So a
// trilinear interpolation over a cube of side s exceeds it by at most 2 s² / 8 / distance. Closer to unit cubes than
// two sides the largest excess is less; for s = 2, an enumeration of all cubes at a distance of 1 or more gives 0.427.
double excess(std::uint32_t spacing, double least_distance) {
    const double bound = 0.25 * spacing * spacing / least_distance;
    return spacing == 2 ? std::min(bound, 0.43) : bound;
}

double interpolate(const std::array<float, 8>& values, double x, double y, double z) {
    double sum = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        sum += (k & 1 ? x : 1 - x) * (k & 2 ? y : 1 - y) * (k & 4 ? z : 1 - z) * double{values[k]};
    }
    return sum;
}

}  // namespace

double CellDistance::at(Vec3 point) const {
    double squared = std::numeric_limits<double>::infinity();
    tree_.for_each_nearest(point, squared, [&](std::uint32_t box) {
        return squared = std::min(squared, Bvh::squared_distance(boxes_[box], point));
    });
    return std::sqrt(squared);
}

std::array<float, 8> lower_to_free_way(const CellDistance& cells, Vec3 low, std::uint32_t side,
                                       std::array<float, 8> values, double slack) {
    if (cells.empty()) return values;
    const auto point = [&](double x, double y, double z) {
        const auto s = static_cast<double>(side);
        return low + Vec3{static_cast<float>(x * s), static_cast<float>(y * s), static_cast<float>(z * s)};
    };
    for (std::uint32_t k = 0; k < 8; ++k) {
        const double free = cells.at(point(k & 1 ? 1 : 0, k & 2 ? 1 : 0, k & 4 ? 1 : 0));
        values[k] = std::min(values[k], static_cast<float>(free));
    }
    const double nearest = std::max(1.0, cells.at(point(0.5, 0.5, 0.5)) - 0.5 * root3 * side);
    const std::uint32_t spacing = spacing_for(nearest, side), steps = side / spacing;

    struct Examined {
        double value, free;
    };
    std::vector<Examined> examined;
    double least_free = std::numeric_limits<double>::infinity();
    for (std::uint32_t z = 0; z <= steps; ++z) {
        for (std::uint32_t y = 0; y <= steps; ++y) {
            for (std::uint32_t x = 0; x <= steps; ++x) {
                const double n = steps;
                const Examined e{interpolate(values, x / n, y / n, z / n), cells.at(point(x / n, y / n, z / n))};
                least_free = std::min(least_free, e.free);
                examined.push_back(e);
            }
        }
    }
    const double spare = excess(spacing, std::max(nearest, least_free - 0.5 * root3 * spacing)) + slack;
    const double low_value = double{*std::min_element(values.begin(), values.end())};
    double too_large = 0;
    for (const auto& [value, free] : examined) too_large = std::max(too_large, value + spare - free);

    // Where subtracting that would leave too little, reduce the slope instead.
    const double floor = std::min(0.8 * (least_free - spare), low_value);
    double slope = 1, least = low_value - too_large;
    if (least < floor) {
        least = floor;
        for (const auto& [value, free] : examined) {
            if (value > low_value) slope = std::min(slope, (free - spare - floor) / (value - low_value));
        }
    }
    for (float& value : values) value = static_cast<float>(least + slope * (double{value} - low_value));
    return values;
}

}  // namespace weft
