#include "mesh/sound_triangles.h"

#include "mesh/grouping.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <utility>

namespace weft {
namespace {

// In double, which can hold the fourth power of any float.
struct Difference {
    double x, y, z;
    Difference(Vec3 a, Vec3 b) : x(double{a.x} - b.x), y(double{a.y} - b.y), z(double{a.z} - b.z) {}
    double squared() const { return x * x + y * y + z * z; }
};

double squared_cross(const Difference& a, const Difference& b) {
    const double x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
    return x * x + y * y + z * z;
}

struct UpperCorners {
    std::uint32_t middle = 0, high = 0, triangle = 0;
    friend auto operator<=>(const UpperCorners&, const UpperCorners&) = default;
};

/// 1 for each triangle with the same corners as an earlier one.
std::vector<std::uint8_t> find_duplicates(std::span<const Triangle> triangles, std::uint32_t corner_count) {
    auto by_lowest = group_items<UpperCorners>(corner_count, [&](auto put) {
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            auto [low, middle, high] = triangles[i];
            if (low > middle) std::swap(low, middle);
            if (middle > high) std::swap(middle, high);
            if (low > middle) std::swap(low, middle);
            put(low, UpperCorners{middle, high, i});
        }
    });
    std::vector<std::uint8_t> duplicate(triangles.size(), 0);
    for (std::uint32_t low = 0; low < corner_count; ++low) {
        const auto begin = by_lowest.items.begin() + by_lowest.offsets[low];
        const auto end = by_lowest.items.begin() + by_lowest.offsets[low + 1];
        std::sort(begin, end);
        for (auto i = begin; i != end; ++i)
            if (i != begin && i[-1].middle == i->middle && i[-1].high == i->high) duplicate[i->triangle] = 1;
    }
    return duplicate;
}

}  // namespace

bool has_zero_area(Vec3 a, Vec3 b, Vec3 c) {
    const Difference ab(b, a), ac(c, a), bc(c, b);
    const double longest = std::max({ab.squared(), ac.squared(), bc.squared()});
    // |ab x ac| is the height times the longest side.
    return squared_cross(ab, ac) <= zero_area_ratio * zero_area_ratio * longest * longest;
}

SoundTriangles sound_triangles(std::span<const Triangle> triangles, std::span<const Vec3> positions) {
    SoundTriangles sound;
    sound.triangles.reserve(triangles.size());
    sound.source_triangle.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles[i];
        if (has_zero_area(positions[a], positions[b], positions[c])) {
            ++sound.degenerate;
            continue;
        }
        sound.triangles.push_back(triangles[i]);
        sound.source_triangle.push_back(i);
    }

    const auto duplicate = find_duplicates(sound.triangles, static_cast<std::uint32_t>(positions.size()));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sound.triangles.size(); ++i) {
        if (duplicate[i]) {
            ++sound.duplicate;
            continue;
        }
        sound.triangles[kept] = sound.triangles[i];
        sound.source_triangle[kept] = sound.source_triangle[i];
        ++kept;
    }
    sound.triangles.resize(kept);
    sound.source_triangle.resize(kept);
    return sound;
}

}  // namespace weft
