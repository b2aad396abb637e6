#include "view/field_surfaces.h"
#include "view/nice_numbers.h"
#include "view/overlay_parts.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft::overlay {
namespace {

constexpr Vec4 beyond_color{1.0f, 0.75f, 0.1f, 1};

// Cells. Lower bound for the end of the scale: the field covers its mesh within this.
constexpr double least_scale_of_errors = 0.02;

/// What the legend says about all fields of a scene.
struct FieldSums {
    std::vector<float> sizes;  // of the errors, cells
    float least = 0, most = 0, beyond = 0;
    float smallest_cell = 0, largest_cell = 0;  // m

    void add(const FieldSurface& field) {
        for (const float error : field.errors) sizes.push_back(std::abs(error));
        least = std::min(least, field.least);
        most = std::max(most, field.most);
        beyond = std::max(beyond, field.farthest_beyond);
        smallest_cell = smallest_cell > 0 ? std::min(smallest_cell, field.cell) : field.cell;
        largest_cell = std::max(largest_cell, field.cell);
    }
};

std::string millimeters(float meters) {
    return short_number(1e3 * double{meters});
}

Legend legend_of(const FieldSums& sums, float most) {
    Legend legend{.title = "distance field beyond its mesh, cells",
                  .bar = Legend::Bar{-most, most, render::ColorScale::balance}};
    legend.entries.push_back({{},
                              "outside by up to " + short_number(double{sums.most}) + ", inside by up to " +
                                  short_number(-double{sums.least})});
    legend.entries.push_back({beyond_color, sums.beyond > FieldSurface::beyond_counts
                                                ? "mesh beyond the field: " + short_number(double{sums.beyond})
                                                : "mesh beyond the field: none"});
    std::string cells = "cell: " + millimeters(sums.smallest_cell);
    if (sums.largest_cell > sums.smallest_cell) cells += " to " + millimeters(sums.largest_cell);
    legend.entries.push_back({{}, cells + " mm"});
    return legend;
}

}  // namespace

void distance_fields(const OverlayInput& input, OverlayOutput& output) {
    const std::span<const Collider> colliders = input.world.colliders();
    input.fields.keep(colliders);
    const std::size_t first = output.colliders.size();
    FieldSums sums;
    for (std::uint32_t i = 0; i < colliders.size(); ++i) {
        const auto field = input.fields.of(colliders[i]);
        if (!field) continue;
        sums.add(*field);
        output.colliders.push_back({.collider = i, .field = field});
        const Pose& pose = colliders[i].pose;
        for (const auto& [from, to] : field->beyond)
            add_line(output.lines, to_world(pose, from), to_world(pose, to), beyond_color, pixels(input, 2));
    }
    if (output.colliders.size() == first) {
        output.legends.push_back({.title = "distance fields: none"});
        return;
    }
    const auto most = static_cast<float>(
        std::max(least_scale_of_errors, nice_above(std::max(percentile(std::move(sums.sizes), 0.98), 1e-9))));
    for (std::size_t i = first; i < output.colliders.size(); ++i)
        output.colliders[i].least = -most, output.colliders[i].most = most;
    output.legends.push_back(legend_of(sums, most));
}

}  // namespace weft::overlay
