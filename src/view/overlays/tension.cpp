#include "solver/measures/tension.h"

#include "view/nice_numbers.h"
#include "view/overlay_parts.h"

#include <cmath>

namespace weft::overlay {
namespace {

// Lower bounds for the end of a scale: smaller scales would show rounding errors.
constexpr double least_scale_of_load = 0.01, least_scale_of_tension = 1;  // -, N/m

// The scale of the cloths that are colored by the same quantity.
struct Quantity {
    const char* title;
    double least_scale;
    std::vector<float> all = {};
    std::vector<std::size_t> cloths = {};
};

void add_values(Quantity& quantity, std::size_t cloth, const std::vector<double>& values, const ClothModel& model,
                OverlayOutput& output) {
    std::vector<float> finite;
    for (const double value : values) finite.push_back(std::isfinite(value) ? static_cast<float>(value) : 0);
    quantity.all.insert(quantity.all.end(), finite.begin(), finite.end());
    quantity.cloths.push_back(cloth);
    output.scalars.push_back({.values = at_vertices(model, finite)});
}

}  // namespace

void tension(const OverlayInput& input, OverlayOutput& output) {
    Quantity load{"tension / strength", least_scale_of_load}, plain{"tension, N/m", least_scale_of_tension};
    for (std::size_t i = 0; i < input.frame.cloths.size(); ++i) {
        const ClothFrame& cloth = input.frame.cloths[i];
        const StressTable table = make_stress_table(*cloth.model, cloth.triangles);
        const ClothTension measured = measure_tension(table, cloth.positions);
        const bool limited = has_limit(table);
        add_values(limited ? load : plain, i, limited ? measured.load : measured.tension, *cloth.model, output);
    }
    for (const Quantity* quantity : {&load, &plain}) {
        if (quantity->cloths.empty()) continue;
        const auto most = static_cast<float>(
            std::max(quantity->least_scale, nice_above(std::max(percentile(quantity->all, 0.98), 1e-9))));
        for (const std::size_t cloth : quantity->cloths) {
            output.scalars[cloth].most = most;
            output.scalars[cloth].scale = render::ColorScale::amount;
        }
        output.legends.push_back(
            {.title = quantity->title, .bar = Legend::Bar{0, most, render::ColorScale::amount}, .of_scalars = true});
    }
}

}  // namespace weft::overlay
