// The kinds of constraint, and their rows as the builders make them.
#pragma once

#include "physics/constraints.data.h"
#include "physics/rest_shape.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace weft {

enum class ConstraintKind : std::uint32_t {
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) name,
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
};

#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) +1
inline constexpr std::uint32_t constraint_kind_count = 0
#include "physics/constraints.def"
    ;
#undef WEFT_CONSTRAINT

/// Which table the rows of a constraint stand in.
enum class RowSource : std::uint8_t {
    model,  ///< that of each cloth's model
    level,  ///< that of a coarse level
    links,  ///< the island's, of constraints between cloths, whose particles are numbered over the world
    /// A list that the passes find, place and list make anew while the world moves: how long it is, only the device
    /// knows. It has a capacity; a frame in which it is full is run again with a larger one (ListCounts).
    dynamic,
};

struct ConstraintInfo {
    std::string_view name;
    std::uint32_t arity;                       ///< particles per row
    std::uint32_t moved;                       ///< of them, how many, from the first, a row may move
    std::uint32_t lambdas;                     ///< Lagrange multipliers per row
    std::span<const std::string_view> fields;  ///< names of the row's numbers
    RowSource source;
    bool damped;
};

const ConstraintInfo& constraint_info(ConstraintKind kind);

/// In place of a particle: the row does not use this slot. Its numbers for the slot must be such that nothing moves.
inline constexpr std::uint32_t no_particle = ~0u;

/// Rows in the order in which they were built.
struct RowList {
    std::uint32_t arity = 0, field_count = 0;
    std::vector<std::uint32_t> particles;  ///< arity per row
    std::vector<float> fields;             ///< field_count per row
    /// Of kinds whose rows change_rows.h can give another material: what of the cloth's shape the fields follow from,
    /// and one such number for each row that the material leaves out because it has no stiffness there.
    std::uint32_t geometry_count = 0;
    std::vector<float> geometry = {};  ///< geometry_count per row
    std::vector<float> left_out = {};

    std::uint32_t size() const { return arity ? static_cast<std::uint32_t>(particles.size() / arity) : 0; }
    void add(std::initializer_list<std::uint32_t> row_particles, std::initializer_list<float> row_fields,
             std::initializer_list<float> row_geometry = {}) {
        particles.insert(particles.end(), row_particles);
        fields.insert(fields.end(), row_fields);
        geometry.insert(geometry.end(), row_geometry);
    }
};

/// An empty list for rows of that kind.
RowList make_rows(ConstraintKind kind);

// One builder per kind of a model's rows: build_stretch, build_bend, …
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping)                           \
    WEFT_IF_FABRIC_##source(RowList build_##name(const RestShape& rest, const Name##Material& material);) \
        WEFT_IF_PINS_##source(RowList build_##name(const RestShape& rest);)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

}  // namespace weft
