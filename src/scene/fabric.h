// Fabrics: all material values of a cloth, and the presets.
#pragma once

#include "base/parameter.h"
#include "physics/air/air.data.h"
#include "physics/constraints.data.h"
#include "physics/contact/contact.data.h"
#include "physics/tear/tear.data.h"

#include <weft/result.h>
#include <weft/scene.h>

#include <span>
#include <string>
#include <string_view>

namespace weft {

/// The values that belong to no single constraint.
struct BodyMaterial {
    float density = 0.14f;  ///< kg/m²
    float damping = 0.1f;   ///< s
    /// Of stretch, compression and bend, 0…1, for plain position-based dynamics, which has no stiffness in N/m.
    float stiffness[3] = {1, 1, 1};
};

// One entry per scene key.
// clang-format off
inline constexpr Parameter body_parameters[] = {
    {.key = "density", .count = 1, .offset = offsetof(BodyMaterial, density), .min = 0, .max = 1e4,
     .min_excluded = true, .unit = "kg/m²", .what = "mass per area"},
    {.key = "damping", .count = 1, .offset = offsetof(BodyMaterial, damping), .min = 0, .max = 1e4, .unit = "s",
     .what = "damping time (Kelvin-Voigt): stress = stiffness · (strain + time · strain rate)"},
    {.key = "stiffness", .count = 3, .offset = offsetof(BodyMaterial, stiffness), .min = 0, .max = 1,
     .what = "fraction of the stretch, compression and bend that an iteration removes; only for `method` `pbd`"},
};
// clang-format on

/// The default is the preset `cotton`.
struct Fabric {
    BodyMaterial body;
    ContactMaterial contact;
    AirMaterial air;
    TearMaterial tear;
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) \
    WEFT_IF_FABRIC_##source(Name##Material name;)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

    /// Compares the values that have a key, bit by bit, because the angle `mesh` is stored as a NaN.
    friend bool operator==(const Fabric& a, const Fabric& b);
};

/// One table of parameters and the offset of its struct in a Fabric.
struct FabricTable {
    std::span<const Parameter> parameters;
    std::size_t offset;
};

/// All tables, in the order of the documentation. Address of a value: fabric + table.offset + p.offset.
std::span<const FabricTable> fabric_tables();

/// Figures of tearing tests, from which the strength and the tear energy of a preset are computed (tearing.def).
struct TearingFigures {
    double elongation = 0;         ///< at break, 0.1 for 10 %
    double breaking_force = 0;     ///< N/m, per width
    double tear_force = 0;         ///< N, of a tongue tear
    std::string_view source = {};  ///< where each figure comes from, and which of them are chosen
};

struct FabricPreset {
    std::string_view name;
    std::string_view source;  ///< where the values come from, and which of them are chosen, not measured
    Fabric fabric;
    bool woven_or_knitted = true;
    std::string_view material = "cotton";  ///< used where a scene gives none
    TearingFigures tearing = {};
};

/// The fabric that a program describes. The places of its problems are below `pointer`.
Result<Fabric> make_fabric(const FabricDesc& desc, const std::string& pointer = "/fabric");

/// Where only the stretch stiffness is given, sets the compression stiffness to the same values.
void follow_stretch(Fabric& fabric, bool stretch_given, bool compression_given);

/// All presets.
std::span<const FabricPreset> fabric_presets();
/// nullptr if no preset has that name.
const FabricPreset* find_fabric(std::string_view name);

}  // namespace weft
