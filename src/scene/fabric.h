// A fabric: every material value of a cloth, and the fabrics known by name.
#pragma once

#include "base/parameter.h"
#include "physics/air/air.data.h"
#include "physics/constraints.data.h"
#include "physics/contact/contact.data.h"

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
    /// Of stretch, compression and bend, 0…1, for plain position-based dynamics, which knows no N/m.
    float stiffness[3] = {1, 1, 1};
};

// One entry is one key.
// clang-format off
inline constexpr Parameter body_parameters[] = {
    {.key = "density", .count = 1, .offset = offsetof(BodyMaterial, density), .min = 0, .max = 1e4,
     .min_excluded = true, .unit = "kg/m²", .what = "mass per area"},
    {.key = "damping", .count = 1, .offset = offsetof(BodyMaterial, damping), .min = 0, .max = 1e4, .unit = "s",
     .what = "retardation time of a Kelvin-Voigt solid: stress = stiffness · (strain + time · strain rate)"},
    {.key = "stiffness", .count = 3, .offset = offsetof(BodyMaterial, stiffness), .min = 0, .max = 1,
     .what = "part of a stretch, compression and bend that an iteration undoes, in place of N/m; `method` `pbd` only"},
};
// clang-format on

/// Defaults are the preset `cotton`.
struct Fabric {
    BodyMaterial body;
    ContactMaterial contact;
    AirMaterial air;
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) \
    WEFT_IF_FABRIC_##source(Name##Material name;)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

    /// Of the values that have a key, bit by bit: an angle that the mesh has is a NaN.
    friend bool operator==(const Fabric& a, const Fabric& b);
};

/// One table of parameters and where its struct stands in a Fabric.
struct FabricTable {
    std::span<const Parameter> parameters;
    std::size_t offset;
};

/// Every table, in the order in which documentation lists them. Address of a value: fabric + table.offset + p.offset.
std::span<const FabricTable> fabric_tables();

struct FabricPreset {
    std::string_view name;
    std::string_view source;  ///< where the values come from, and which of them are chosen rather than measured
    Fabric fabric;
    bool woven_or_knitted = true;
    std::string_view material = "cotton";  ///< what it looks like where a scene does not say
};

/// The fabric that a program describes. Every problem with it has its place below `pointer`.
Result<Fabric> make_fabric(const FabricDesc& desc, const std::string& pointer = "/fabric");

/// Where a description says how stiff a stretch is and not a compression, both are the same.
void follow_stretch(Fabric& fabric, bool stretch_given, bool compression_given);

/// Every fabric known by name.
std::span<const FabricPreset> fabric_presets();
/// nullptr if no preset has that name.
const FabricPreset* find_fabric(std::string_view name);

}  // namespace weft
