// The kinds of constraint, and the lists of constraints that the builders return.
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

/// Which table holds the constraints of a kind.
enum class RowSource : std::uint8_t {
    model,  ///< the table of each cloth's model
    level,  ///< the table of a coarse level
    links,  ///< the island's table of constraints between cloths; particles are numbered over the world
    /// A list that the passes `find`, `place` and `list` rebuild while the world moves. Only the backend knows its
    /// length. If a frame exceeds its capacity, the frame is repeated with a larger one (ListCounts).
    dynamic,
};

struct ConstraintInfo {
    std::string_view name;
    std::uint32_t arity;                       ///< particles per constraint
    std::uint32_t moved;                       ///< a constraint may move the first `moved` of them
    std::uint32_t lambdas;                     ///< Lagrange multipliers per constraint
    std::span<const std::string_view> fields;  ///< names of the constraint's numbers
    RowSource source;
    bool damped;
};

const ConstraintInfo& constraint_info(ConstraintKind kind);

/// Marks a slot that the constraint does not use. Its numbers for the slot must cause no motion.
inline constexpr std::uint32_t no_particle = ~0u;

/// Numbers per constraint of the coupling with others of its kind.
inline constexpr std::uint32_t coupled_rows = 4, coupled_numbers = 7;

/// Constraints in the order in which they were built.
struct RowList {
    std::uint32_t arity = 0, field_count = 0;
    std::vector<std::uint32_t> particles;  ///< arity per constraint
    std::vector<float> fields;             ///< field_count per constraint
    /// Only for kinds that change_rows.h supports: the geometry from which the fields are computed, and in `left_out`
    /// one geometry number for each constraint that was omitted because the material gives it no stiffness.
    std::uint32_t geometry_count = 0;
    std::vector<float> geometry = {};  ///< geometry_count per constraint
    std::vector<float> left_out = {};
    /// Only for kinds with coupled compliance (moment.kernel.h): per constraint coupled_rows indices of others, or
    /// `none`, and coupled_numbers numbers. Empty if the constraints are not coupled.
    std::vector<std::uint32_t> coupled = {};
    std::vector<float> coupling = {};

    std::uint32_t size() const { return arity ? static_cast<std::uint32_t>(particles.size() / arity) : 0; }
    void add(std::initializer_list<std::uint32_t> row_particles, std::initializer_list<float> row_fields,
             std::initializer_list<float> row_geometry = {}) {
        particles.insert(particles.end(), row_particles);
        fields.insert(fields.end(), row_fields);
        geometry.insert(geometry.end(), row_geometry);
    }
};

/// An empty list for constraints of this kind.
RowList make_rows(ConstraintKind kind);

// One builder per kind of constraint in a model: build_stretch, build_bend, …
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping)                           \
    WEFT_IF_FABRIC_##source(RowList build_##name(const RestShape& rest, const Name##Material& material);) \
        WEFT_IF_PINS_##source(RowList build_##name(const RestShape& rest);)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

}  // namespace weft
