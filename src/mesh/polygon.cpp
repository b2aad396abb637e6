#include "mesh/polygon.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace weft {
namespace {

using FlatPoint = std::array<double, 2>;

double quality(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
    const auto squared = [](const FlatPoint& p, const FlatPoint& q) {
        const double x = q[0] - p[0], y = q[1] - p[1];
        return x * x + y * y;
    };
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double sides = squared(a, b) + squared(b, c) + squared(c, a);
    return sides > 0 ? area / sides : 0;
}

}  // namespace

// The best division of the corners first … last follows from those of shorter runs of corners.
std::vector<Triangle> triangulate_polygon(std::span<const FlatPoint> corners) {
    constexpr std::size_t many = 64;
    const std::size_t count = corners.size();
    std::vector<Triangle> triangles;
    if (count < 3) return triangles;
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        triangles.push_back(
            {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    };
    if (count == 3 || count > many) {
        for (std::size_t i = 2; i < count; ++i) add(0, i - 1, i);
        return triangles;
    }
    struct Best {
        double worst = std::numeric_limits<double>::infinity();
        std::size_t apex = 0;
    };
    std::vector<Best> best(count * count);
    for (std::size_t size = 2; size < count; ++size) {
        for (std::size_t first = 0; first + size < count; ++first) {
            const std::size_t last = first + size;
            Best& here = best[first * count + last];
            here = {-std::numeric_limits<double>::infinity(), first + 1};
            for (std::size_t apex = first + 1; apex < last; ++apex) {
                const double worst = std::min({quality(corners[first], corners[apex], corners[last]),
                                               best[first * count + apex].worst, best[apex * count + last].worst});
                if (worst > here.worst) here = {worst, apex};
            }
        }
    }
    std::vector<std::array<std::size_t, 2>> runs{{0, count - 1}};
    while (!runs.empty()) {
        const auto [first, last] = runs.back();
        runs.pop_back();
        if (last - first < 2) continue;
        const std::size_t apex = best[first * count + last].apex;
        add(first, apex, last);
        runs.push_back({first, apex});
        runs.push_back({apex, last});
    }
    return triangles;
}

}  // namespace weft
