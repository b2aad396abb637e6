#include "render/shading/color_scale.h"
#include "solver/world/air.h"
#include "view/nice_numbers.h"
#include "view/overlay_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft::overlay {
namespace {

// Arrows per radius of the scene; arrows to either side of the middle; and length of the longest arrow relative to the
// spacing. It may exceed 1 because such gusts are rare.
constexpr float per_radius = 4;
constexpr float to_either_side = 4;
constexpr float longest = 1.5f;

// m/s: upper bound for gusts.
double fastest_of(const std::vector<WindDesc>& winds) {
    double sum = 0;
    for (const WindDesc& wind : winds) sum += top_speed(wind);
    return sum;
}

// Points at integer multiples of the spacing, so that they stay in place while the cloth moves.
struct Grid {
    float spacing = 1;  ///< m
    std::array<float, 3> first{};
    std::array<int, 3> count{};

    Vec3 at(int x, int y, int z) const {
        return Vec3{first[0] + static_cast<float>(x), first[1] + static_cast<float>(y),
                    first[2] + static_cast<float>(z)} *
               spacing;
    }
};

Grid grid_around(const Bounds& bounds, float radius) {
    Grid grid{.spacing = std::max(radius, 1e-3f) / per_radius};
    const Vec3 size = bounds.size() * 0.65f, center = bounds.center();
    const float middles[] = {center.x, center.y, center.z}, sizes[] = {size.x, size.y, size.z};
    for (int axis = 0; axis < 3; ++axis) {
        // A flat cloth has one layer above and one below it.
        const float reach = std::clamp(sizes[axis] / grid.spacing, 1.0f, to_either_side);
        const float middle = middles[axis] / grid.spacing;
        grid.first[axis] = std::ceil(middle - reach);
        const float last = std::floor(middle + reach);
        grid.count[axis] = static_cast<int>(std::clamp(last - grid.first[axis] + 1, 1.0f, 2 * to_either_side + 1));
    }
    return grid;
}

void add_arrow(std::vector<render::Line>& lines, Vec3 from, Vec3 along, Vec4 color, float width) {
    const float reach = length(along);
    if (!(reach > 0)) return;
    const Vec3 to = from + along, unit = along / reach;
    add_line(lines, from, to, color, width);
    // Four barbs, so that at least two are visible from any direction.
    const Vec3 across = normalized(cross(unit, std::abs(unit.y) < 0.7f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
    const Vec3 other = cross(unit, across);
    for (const Vec3 side : {across, -across, other, -other})
        add_line(lines, to, to - along * 0.25f + side * (0.12f * reach), color, width);
}

}  // namespace

void wind(const OverlayInput& input, OverlayOutput& output) {
    const auto& air = input.world.air();
    const Bounds bounds = bounds_of_cloths(input);
    const double most = air ? nice_above(fastest_of(air->wind)) : 0;  // m/s
    if (!air || air->wind.empty() || bounds.empty() || !(fastest_of(air->wind) > 0)) {
        output.legends.push_back({.title = "wind: none"});
        return;
    }
    std::vector<WindNow> winds;
    for (const WindDesc& desc : air->wind) winds.push_back(wind_at(desc, input.frame.time));
    const Grid grid = grid_around(bounds, input.size);
    const float scale = longest * grid.spacing / static_cast<float>(most);  // s
    std::uint32_t number = 0;  // scattered gusts differ by this number, as they do by triangle
    for (int x = 0; x < grid.count[0]; ++x) {
        for (int y = 0; y < grid.count[1]; ++y) {
            for (int z = 0; z < grid.count[2]; ++z) {
                const Vec3 at = grid.at(x, y, z);
                const Vec3 velocity = wind_velocity(winds, at, number++);
                const auto color = shading::color_scale(length(velocity) / static_cast<float>(most), WEFT_SCALE_AMOUNT);
                add_arrow(output.lines, at, velocity * scale, {color.x, color.y, color.z, 1}, pixels(input, 1.6f));
            }
        }
    }
    output.legends.push_back({.title = "wind, m/s",
                              .bar = Legend::Bar{0, static_cast<float>(most), render::ColorScale::amount},
                              .entries = {{{},
                                           "an arrow of " + short_number(100 * longest * grid.spacing) +
                                               " cm: " + short_number(most) + " m/s"}}});
}

}  // namespace weft::overlay
