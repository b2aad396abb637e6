// A pass: one kind of work over one kind of item, with what it reads and writes.
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

struct Pass {
    PassKind kind;
    ConstraintKind constraint{};  ///< of project, correct and damp, and of all passes of a dynamic list
    std::uint32_t batch = 0;      ///< of project, reach and damp
    bool first_iteration = true;  ///< of project, reach, correct and contact: no lambda, no friction from before
    std::uint32_t level = 0;      ///< of collect, lift, reach and settle
    RowSource source = RowSource::model;
    friend bool operator==(const Pass&, const Pass&) = default;
};

/// What a pass goes over, one item at a time.
enum class Over : std::uint8_t { particles, faces, nodes, rows };

/// What passes read and write. Arrays of coarse levels and corrections exist once per level and per constraint.
enum class Data : std::uint8_t {
    position,
    start,
    velocity,
    carry,
    normals,
    by_face,
    wind,
    node_position,
    node_origin,
    node_displacement,
    finer_place,           ///< positions, or node_origin of the next finer level
    coarser_displacement,  ///< node_displacement of the next coarser level
    finest_displacement,   ///< node_displacement of the finest level
    correction,
    all_corrections,
    found,      ///< of a dynamic list: how many rows each particle has in it
    places,     ///< likewise: where they begin
    list_rows,  ///< likewise: the rows themselves
};

struct Access {
    Data data;
    bool write = false;
    bool own = false;  ///< only the element that belongs to the item itself
};

struct PassInfo {
    std::string_view name;
    std::uint32_t stage;  ///< stage_of_constraint: that of the constraint
    Over over;
    std::span<const Access> accesses;
};

const PassInfo& pass_info(PassKind kind);

/// Timings are kept by stages: one per constraint, then these.
enum Stage : std::uint32_t {
    stage_find = constraint_kind_count,
    stage_air,
    stage_predict,
    stage_hierarchy,
    stage_average,
    stage_contact,
    stage_velocities,
    stage_damp,
    stage_surface,
    stage_fused,  ///< a frame that a device runs as a whole
    stage_end,
};
inline constexpr std::uint32_t stage_count = stage_end;
inline constexpr std::uint32_t stage_of_constraint = stage_end;

std::uint32_t stage_of(const Pass& pass);
std::string_view stage_name(std::uint32_t stage);

}  // namespace weft
