// A pass: one kind of work on one kind of item, with the data that it reads and writes.
#pragma once

#include "physics/constraint.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace weft {

enum class PassKind : std::uint8_t {
#define WEFT_PASS(name, stage, over, accesses) name,
#include "solver/plan/passes.def"
#undef WEFT_PASS
};

#define WEFT_PASS(name, stage, over, accesses) +1
inline constexpr std::uint32_t pass_kind_count = 0
#include "solver/plan/passes.def"
    ;
#undef WEFT_PASS

/// The cloths that a pass is for.
enum class PassFor : std::uint8_t { all_cloths, exact_cloths, fast_cloths };

struct Pass {
    PassKind kind;
    ConstraintKind constraint{};  ///< of project, correct, damp and the taut ones, and of all passes of a dynamic list
    std::uint32_t batch =
        0;  ///< of project, coarse_limit, damp, weigh_taut; round of cloth_contact; sweep of push_faces
    bool first_iteration = true;  ///< of project, coarse_limit, correct, contact: lambda and friction start at 0;
                                  ///< of pull_bodies: the impulse of the air is added
    std::uint32_t level = 0;      ///< of restriction, interpolation, coarse_limit, node_correction
    RowSource source = RowSource::model;
    PassFor cloths = PassFor::all_cloths;
    friend bool operator==(const Pass&, const Pass&) = default;
};

/// The items of a pass.
enum class Over : std::uint8_t { particles, faces, nodes, rows };

/// Arrays that passes read and write. Coarse levels have arrays per level, corrections per kind of constraint.
enum class Data : std::uint8_t {
    position,
    start,
    velocity,
    compensation,
    normals,
    by_face,
    wind,
    node_position,
    node_origin,
    node_displacement,
    finer_place,           ///< node_origin of the next finer level; position on the finest level
    coarser_displacement,  ///< node_displacement of the next coarser level
    finest_displacement,   ///< node_displacement of the finest level
    correction,
    all_corrections,
    found,          ///< of a dynamic list: number of constraints per particle
    places,         ///< of a dynamic list: index of each particle's first constraint
    list_rows,      ///< of a dynamic list: the constraints
    face_contacts,  ///< of faces with colliders
    face_sums,      ///< of their pushes, per particle
    steady_parts,   ///< of its inverse mass that each particle has in the frame
    taut,           ///< masses of taut edges, summed by particle
    multipliers,    ///< of constraints
    shifts,         ///< of the rest values of coupled constraints
    hot,            ///< triangles whose load may soon exceed a limit
    pairs,          ///< of features of cloth that are near each other
    bodies,         ///< rigid bodies that move by forces
    body_sums,      ///< of what touches them
};

struct Access {
    Data data;
    bool write = false;
    bool own = false;  ///< only the element that belongs to the item
};

struct PassInfo {
    std::string_view name;
    std::uint32_t stage;  ///< stage_of_constraint: the stage of the pass's constraint
    Over over;
    std::span<const Access> accesses;
};

const PassInfo& pass_info(PassKind kind);

/// Stages for timings: one per kind of constraint, then these.
enum Stage : std::uint32_t {
    stage_find = constraint_kind_count,
    stage_air,
    stage_predict,
    stage_hierarchy,
    stage_average,
    stage_grab,
    stage_contact,
    stage_bodies,
    stage_cloth_contact,
    stage_velocities,
    stage_tear,
    stage_damp,
    stage_surface,
    stage_fused,  ///< a whole frame that runs in one dispatch
    stage_end,
};
inline constexpr std::uint32_t stage_count = stage_end;
inline constexpr std::uint32_t stage_of_constraint = stage_end;

std::uint32_t stage_of(const Pass& pass);
std::string_view stage_name(std::uint32_t stage);

}  // namespace weft
