// How a distance field is divided: places, bricks, cells and the nodes at their corners.
#pragma once

#include "collide/distance_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace weft::field {

inline constexpr std::uint32_t side = 8;  // of a place, in cells; the kernel has the same
inline constexpr std::uint32_t nodes_side = side + 1;
inline constexpr std::uint32_t blocks_per_brick = side * side * side;

// No fine value is farther from the surface: a place has a brick if its cube, enlarged by the band, meets a triangle.
// The farthest corner of the place is a diagonal of both away.
inline constexpr double fine_range = 1.7321 * (side + fine_band);
inline constexpr double largest_short = 32767;
inline constexpr double fine_unit = fine_range / largest_short;  // cells

using Counts = std::array<std::uint32_t, 3>;

struct FieldGrid {
    Vec3 origin;  // m
    float cell = 0;
    Counts places{};

    std::uint32_t count() const { return places[0] * places[1] * places[2]; }
    std::uint32_t number(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return x + places[0] * (y + places[1] * z);
    }
    Counts at(std::uint32_t number) const {
        return {number % places[0], number / places[0] % places[1], number / places[0] / places[1]};
    }
    std::uint32_t corner(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return x + (places[0] + 1) * (y + (places[1] + 1) * z);
    }
    Vec3 to_cells(Vec3 p) const {
        const auto along = [&](float x, float from) {
            return static_cast<float>((double{x} - double{from}) / double{cell});
        };
        return {along(p.x, origin.x), along(p.y, origin.y), along(p.z, origin.z)};
    }
    Vec3 to_meters(Vec3 p) const { return origin + p * cell; }
};

/// Distances at the corners of a brick's cells. Neighbors share those on the side between them, which belong to the
/// brick where they are first.
using BrickNodes = std::array<std::int16_t, nodes_side * nodes_side * nodes_side>;
inline std::uint32_t node(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return x + nodes_side * (y + nodes_side * z);
}

inline std::int16_t to_short(double cells, double unit) {
    return static_cast<std::int16_t>(std::lround(std::clamp(cells / unit, -largest_short, largest_short)));
}

}  // namespace weft::field
