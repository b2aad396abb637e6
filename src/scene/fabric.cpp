#include "scene/fabric.h"

#include "scene/values.h"

#include <algorithm>
#include <cstddef>

namespace weft {
namespace {

constexpr bool textile = true;  // woven or knitted
constexpr bool sheet = false;

// One line of fabrics.def, with its arguments. Bending is in µN·m in the file and in N·m in a Fabric.
struct Row {
    double density, stretch_warp, stretch_weft, shear, bend_warp, bend_bias, bend_weft;
};

// To three digits: more would not be known.
constexpr double rounded(double value) {
    double unit = 1;
    while (value >= 1000 * unit) unit *= 10;
    while (value > 0 && value < 100 * unit) unit /= 10;
    return static_cast<double>(static_cast<long>(value / unit + 0.5)) * unit;
}

// Sets the elongation at break, and scales the energy of tearing like the tension at break.
constexpr TearMaterial tear_from(const TearingFigures& figures, const float (&stretch)[2]) {
    TearMaterial tear;
    for (int i = 0; i < 2; ++i) tear.strength[i] = static_cast<float>(stretch[i] * figures.elongation);
    const double mean = (stretch[0] + stretch[1]) * figures.elongation / 2;
    tear.tear_energy = static_cast<float>(rounded(2 * figures.tear_force * mean / figures.breaking_force));
    return tear;
}

constexpr Fabric fabric_from(const Row& row, const TearingFigures& tearing) {
    Fabric f;
    f.body.density = static_cast<float>(row.density);
    const float stretch[2] = {static_cast<float>(row.stretch_warp), static_cast<float>(row.stretch_weft)};
    std::copy_n(stretch, 2, f.stretch.stretch);
    std::copy_n(stretch, 2, f.stretch.compression);
    f.stretch.shear = static_cast<float>(row.shear);
    f.tear = tear_from(tearing, stretch);
    const double bend[3] = {row.bend_warp, row.bend_bias, row.bend_weft};
    for (int i = 0; i < 3; ++i) f.bend.bend[i] = static_cast<float>(bend[i] * 1e-6);
    return f;
}

#define WEFT_MEASURED                                                                                                  \
    "measured by Wang, O'Brien, Ramamoorthi 2011, \"Data-Driven Elastic Models for Cloth: Modeling and Measurement\" " \
    "(bend converted to SI): "
#define WEFT_MEDIANS "medians by areal density over 618 measured fabrics (DrapeTester), "
#define WEFT_MEDIAN "bend from the " WEFT_MEDIANS
#define WEFT_TENSILE_CHOSEN "stretch and shear are chosen, not measured"

#define WEFT_BREAKS "breaking force: "
#define WEFT_ALL_CHOSEN "every value is chosen, none measured"

struct NamedFigures {
    std::string_view name;
    TearingFigures figures;
};

constexpr NamedFigures tearing_figures[] = {
#define WEFT_TEARING(name, elongation, breaking_force, tear_force, source) \
    {#name, {elongation, breaking_force, tear_force, source}},
#include "scene/tearing.def"
#undef WEFT_TEARING
};

// A preset without a line in tearing.def is an error of compilation.
consteval TearingFigures tearing_of(std::string_view name) {
    for (const NamedFigures& named : tearing_figures)
        if (named.name == name) return named.figures;
    throw "a preset has no line in tearing.def";
}

constexpr FabricPreset presets[] = {
#define WEFT_FABRIC(name, density, stretch_warp, stretch_weft, shear, bend_warp, bend_bias, bend_weft, material, kind, \
                    source)                                                                                            \
    {#name,                                                                                                            \
     source,                                                                                                           \
     fabric_from({density, stretch_warp, stretch_weft, shear, bend_warp, bend_bias, bend_weft}, tearing_of(#name)),    \
     kind,                                                                                                             \
     #material,                                                                                                        \
     tearing_of(#name)},
#include "scene/fabrics.def"
#undef WEFT_FABRIC
};

constexpr FabricTable fabric_table_list[] = {
    {body_parameters, offsetof(Fabric, body)},
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) \
    WEFT_IF_FABRIC_##source({name##_parameters, offsetof(Fabric, name)}, )
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
    {tear_parameters, offsetof(Fabric, tear)},
    {contact_parameters, offsetof(Fabric, contact)},
    {air_parameters, offsetof(Fabric, air)},
};

}  // namespace

std::span<const FabricTable> fabric_tables() {
    return fabric_table_list;
}

bool operator==(const Fabric& a, const Fabric& b) {
    return std::ranges::all_of(fabric_table_list, [&](const FabricTable& table) {
        const auto in = [&](const Fabric& fabric) {
            return reinterpret_cast<const std::byte*>(&fabric) + table.offset;
        };
        return std::ranges::all_of(table.parameters, [&](const Parameter& p) { return same_value(p, in(a), in(b)); });
    });
}

std::span<const FabricPreset> fabric_presets() {
    return presets;
}

const FabricPreset* find_fabric(std::string_view name) {
    const auto it = std::ranges::find(presets, name, &FabricPreset::name);
    return it != std::end(presets) ? &*it : nullptr;
}

}  // namespace weft
