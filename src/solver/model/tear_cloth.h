// The rules of tearing (physics/tear/rules.kernel.h) on a cloth in host memory.
#pragma once

#include "physics/change_rows.h"
#include "physics/scalar.h"
#include "solver/model/cloth_model.h"
#include "solver/model/opened_cloth.h"
#include "solver/model/tear_law.h"
#include "solver/model/tear_table.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace weft::scalar {

using uint = std::uint32_t;

// The kinds of constraints that openings change, as the rules number them.
inline constexpr uint WEFT_TEAR_STRETCH = 0;
inline constexpr std::array<ConstraintKind, 6> tear_kinds{ConstraintKind::stretch, ConstraintKind::bend,
                                                          ConstraintKind::plate,   ConstraintKind::distance_bend,
                                                          ConstraintKind::moment,  ConstraintKind::membrane};
inline uint tear_kind(ConstraintKind kind) {
    return static_cast<uint>(std::ranges::find(tear_kinds, kind) - tear_kinds.begin());
}

#include "physics/tear/load.kernel.h"

/// What the rules read and write. Openings alone need the first three members.
struct TearAccess {
    const ClothModel& model;
    OpenedArrays& arrays;
    const StretchLaw& stretch;
    const Vec4* position = nullptr;
    const std::uint32_t* vertex = nullptr;  ///< per particle
    const std::uint8_t* watched = nullptr;  ///< per particle: whether it has a load
    const TearLoad* loads = nullptr;        ///< per particle
};
using TearCloth = const TearAccess&;

WEFT_FN const TearTable::Entry& tear_entry(TearCloth c, uint i) {
    return c.model.tears->entries[i];
}
WEFT_FN uint tear_stride(TearCloth c) {
    return c.model.face_stride;
}
WEFT_FN uint tear_face(TearCloth c, uint corner) {
    return c.arrays.faces[corner];
}
WEFT_FN void tear_set_face(TearCloth c, uint corner, uint particle) {
    c.arrays.faces[corner] = particle;
}
WEFT_FN uint tear_ring(TearCloth c, uint vertex) {
    return c.model.tears->ring_begin[vertex];
}
WEFT_FN uint tear_vertex(TearCloth c, uint i) {
    return tear_entry(c, i).vertex;
}
WEFT_FN uint tear_corner(TearCloth c, uint i) {
    return tear_entry(c, i).corner;
}
WEFT_FN uint tear_next(TearCloth c, uint i) {
    return tear_entry(c, i).next;
}
WEFT_FN uint tear_far(TearCloth c, uint i) {
    return tear_entry(c, i).far;
}
WEFT_FN uint tear_next_far(TearCloth c, uint i) {
    return tear_entry(c, i).next_far;
}
WEFT_FN uint tear_twin(TearCloth c, uint i) {
    return tear_entry(c, i).twin;
}
WEFT_FN uint tear_corner_vertex(TearCloth c, uint corner) {
    return c.model.tears->vertices[corner];
}
WEFT_FN bool tear_erodes(TearCloth c) {
    return c.model.reserved.erodes;
}
WEFT_FN uint tear_vertex_of(TearCloth c, uint particle) {
    return c.vertex[particle];
}

WEFT_FN TearSide tear_side(TearCloth c, uint triangle, uint k) {
    const std::size_t stride = c.model.tear_law->stride;
    const float* at = c.model.tear_law->sides.data() + std::size_t{WEFT_TEAR_SIDE_NUMBERS} * k * stride + triangle;
    return {at[0], at[stride], at[2 * stride], at[3 * stride], at[4 * stride], at[5 * stride]};
}
WEFT_FN bool tear_has_couplings(TearCloth c) {
    return !c.model.tear_law->couplings.empty();
}
WEFT_FN TearCoupling tear_coupling(TearCloth c, uint triangle) {
    const std::size_t stride = c.model.tear_law->stride;
    const float* at = c.model.tear_law->couplings.data() + triangle;
    return {at[0], at[stride], at[2 * stride], at[3 * stride], at[4 * stride], at[5 * stride]};
}
WEFT_FN real tear_area(TearCloth c, uint triangle) {
    return c.model.tear_law->area[triangle];
}
WEFT_FN real tear_turn(TearCloth c, uint i, uint k) {
    return c.model.tear_law->entries[i].turn[k];
}
WEFT_FN real tear_angle(TearCloth c, uint i) {
    return c.model.tear_law->entries[i].angle;
}
WEFT_FN real tear_length(TearCloth c, uint i) {
    return c.model.tear_law->entries[i].length;
}
WEFT_FN real tear_along(TearCloth c, uint i, uint k) {
    return c.model.tear_law->entries[i].along[k];
}
WEFT_FN real tear_inverse_strength(TearCloth c, uint k) {
    return c.model.tear_law->inverse_strength[k];
}
WEFT_FN real tear_energy(TearCloth c) {
    return c.model.tear_law->tear_energy;
}
WEFT_FN real tear_inverse_stretch(TearCloth c) {
    return c.model.tear_law->inverse_stretch;
}
WEFT_FN real tear_inverse_resistance(TearCloth c, uint vertex) {
    return c.model.tear_law->inverse_resistance[vertex];
}
WEFT_FN bool tear_has_seams(TearCloth c) {
    return !c.model.tear_law->seams.empty();
}
WEFT_FN real tear_seam(TearCloth c, uint i, uint k) {
    return c.model.tear_law->seams[i][k];
}
WEFT_FN real tear_watch_limit(TearCloth c, uint triangle, uint k) {
    return c.model.tear_law->watch[std::size_t{k} * c.model.tear_law->stride + triangle];
}

WEFT_FN vec3 tear_position(TearCloth c, uint particle) {
    const Vec4& x = c.position[particle];
    return vec3(x.x, x.y, x.z);
}
WEFT_FN bool tear_is_watched(TearCloth c, uint particle) {
    return c.watched[particle] != 0;
}
WEFT_FN TearLoad tear_kept_load(TearCloth c, uint particle) {
    return c.loads[particle];
}
WEFT_FN real tear_strayed(TearCloth c, uint vertex) {
    return c.arrays.strayed[vertex];
}
WEFT_FN void tear_set_strayed(TearCloth c, uint vertex, real strayed) {
    c.arrays.strayed[vertex] = strayed;
}

WEFT_FN uint tear_fan(TearCloth c, uint i) {
    return c.arrays.fan[i];
}
WEFT_FN void tear_set_fan(TearCloth c, uint i, uint fan) {
    c.arrays.fan[i] = fan;
}
WEFT_FN uint tear_room(TearCloth c) {
    return c.arrays.room;
}
WEFT_FN uint tear_add_copy(TearCloth c, uint from) {
    if (c.arrays.room == 0) return none;
    --c.arrays.room;
    c.arrays.copied_from.push_back(from);
    return c.arrays.particle_count++;
}
WEFT_FN real tear_face_mass(TearCloth c, uint triangle) {
    return face_mass(c.model, triangle);
}
WEFT_FN real tear_mass(TearCloth c, uint particle) {
    return c.arrays.mass[particle];
}
WEFT_FN void tear_set_mass(TearCloth c, uint particle, real mass) {
    c.arrays.mass[particle] = mass;
}

WEFT_FN const ConstraintTable& tear_table(TearCloth c, uint kind) {
    return c.model.table(tear_kinds[kind]);
}
WEFT_FN OpenedArrays::Rows& tear_rows(TearCloth c, uint kind) {
    return c.arrays.rows[static_cast<std::size_t>(tear_kinds[kind])];
}
WEFT_FN const TearTable::Rows& tear_sources(TearCloth c, uint kind) {
    return c.model.tears->rows[static_cast<std::size_t>(tear_kinds[kind])];
}
WEFT_FN uint tear_arity(TearCloth c, uint kind) {
    return tear_table(c, kind).arity;
}
WEFT_FN uint tear_row_corner(TearCloth c, uint kind, uint row, uint slot) {
    return tear_sources(c, kind).corners[std::size_t{slot} * tear_table(c, kind).stride + row];
}
WEFT_FN uint tear_row_particle(TearCloth c, uint kind, uint row, uint slot) {
    return tear_rows(c, kind).particles[std::size_t{slot} * tear_table(c, kind).stride + row];
}
WEFT_FN void tear_set_row_particle(TearCloth c, uint kind, uint row, uint slot, uint particle) {
    tear_rows(c, kind).particles[std::size_t{slot} * tear_table(c, kind).stride + row] = particle;
}
// Whether the constraint has not been removed.
WEFT_FN bool tear_has_row(TearCloth c, uint kind, uint row) {
    const std::size_t stride = tear_table(c, kind).stride;
    if (kind == WEFT_TEAR_STRETCH) return !(tear_rows(c, kind).geometry[stride + row] < 0);
    return !tear_table(c, kind).is_dummy(tear_row_particle(c, kind, row, 0));
}
WEFT_FN uint tear_tie_begin(TearCloth c, uint kind, uint row) {
    return tear_sources(c, kind).tie_begin[row];
}
WEFT_FN uint tear_tie(TearCloth c, uint kind, uint i, uint k) {
    return tear_sources(c, kind).ties[i][k];
}
WEFT_FN void tear_end_row(TearCloth c, uint kind, uint row) {
    const ConstraintTable& table = tear_table(c, kind);
    OpenedArrays::Rows& rows = tear_rows(c, kind);
    for (uint slot = 0; slot < table.arity; ++slot)
        tear_set_row_particle(c, kind, row, slot, dummy(table.first_dummy, slot, row));
    --rows.rows;
    for (std::size_t at = row; at < rows.fields.size(); at += table.stride) rows.fields[at] = 0;
    for (std::size_t at = row; at < rows.geometry.size(); at += table.stride) rows.geometry[at] = no_area;
}

WEFT_FN uint tear_halves(TearCloth c) {
    return c.model.tears->half_stride;
}
WEFT_FN uint tear_second_corner(TearCloth c, uint row, uint slot) {
    return c.model.tears->second[std::size_t{slot} * c.model.tears->half_stride + row];
}
// Marks the block of lines that has the row: a line may end in it.
WEFT_FN void tear_cut_line(TearCloth c, uint row) {
    if (const auto block = tear_table(c, WEFT_TEAR_STRETCH).line_block(row)) c.arrays.blocks[*block].cut = true;
}
// Turns a row of stretch constraints into padding. On a line it keeps its particles, and a negative compliance
// separates the constraints before and after it.
WEFT_OUTLINED_FN void tear_end_stretch(TearCloth c, uint row) {
    const ConstraintTable& table = tear_table(c, WEFT_TEAR_STRETCH);
    if (!table.line_block(row)) return tear_end_row(c, WEFT_TEAR_STRETCH, row);
    OpenedArrays::Rows& rows = tear_rows(c, WEFT_TEAR_STRETCH);
    --rows.rows;
    for (std::size_t at = table.stride + row; at < rows.fields.size(); at += table.stride) rows.fields[at] = -1;
    for (std::size_t at = row; at < rows.geometry.size(); at += table.stride) rows.geometry[at] = no_area;
}
/// Compliances of one half of an edge that has two triangles.
inline StretchLaw::Compliances half_of_edge(const TearTable& table, const StretchLaw& law, std::size_t row, bool first,
                                            float cos2, float strip_of_half) {
    if (table.springs.empty()) return law.at(cos2, strip_of_half);
    const std::array<float, 4>& springs = table.springs[row];
    return first ? StretchLaw::Compliances{springs[0], springs[1]} : StretchLaw::Compliances{springs[2], springs[3]};
}
// Gives each half of an opened edge the stiffness of its own triangle, if the second half is not in use yet.
WEFT_OUTLINED_FN void tear_part_stiffness(TearCloth c, uint row) {
    OpenedArrays::Rows& rows = tear_rows(c, WEFT_TEAR_STRETCH);
    const ConstraintTable& table = tear_table(c, WEFT_TEAR_STRETCH);
    const std::size_t stride = table.stride, second = std::size_t{table.second_halves} + row;
    if (!table.is_dummy(rows.particles[second])) return;
    ++rows.rows;
    c.arrays.halves_used[row / lane_padding] = 1;
    const float cos2 = rows.geometry[row], strip = rows.geometry[stride + row],
                first_part = c.model.tears->first_part[row];
    rows.fields[second] = rows.fields[row], rows.fields[3 * stride + second] = rows.fields[3 * stride + row];
    const auto set = [&](std::size_t at, float part) {
        const StretchLaw::Compliances compliances =
            half_of_edge(*c.model.tears, c.stretch, row, at == row, cos2, strip * part);
        rows.geometry[at] = cos2, rows.geometry[stride + at] = strip * part;
        rows.fields[stride + at] = compliances.stretched, rows.fields[2 * stride + at] = compliances.compressed;
    };
    set(row, first_part), set(second, 1 - first_part);
}

// Whether the constraint has the stiffness of the one triangle at its edge that is left.
WEFT_FN bool tear_is_settled(TearCloth c, uint row) {
    return c.arrays.settled[row] != 0;
}
// Gives a constraint the stiffness of one of its two triangles. Its second half ends.
WEFT_OUTLINED_FN void tear_settle(TearCloth c, uint row, bool first) {
    OpenedArrays::Rows& rows = tear_rows(c, WEFT_TEAR_STRETCH);
    const ConstraintTable& table = tear_table(c, WEFT_TEAR_STRETCH);
    const std::size_t stride = table.stride, second = std::size_t{table.second_halves} + row;
    const float first_part = c.model.tears->first_part[row], cos2 = rows.geometry[row];
    float& strip = rows.geometry[stride + row];
    if (table.is_dummy(rows.particles[second])) {
        strip *= first ? first_part : 1 - first_part;
    } else {
        if (!first) strip = rows.geometry[stride + second];
        tear_end_row(c, WEFT_TEAR_STRETCH, static_cast<uint>(second));
    }
    const StretchLaw::Compliances compliances = half_of_edge(*c.model.tears, c.stretch, row, first, cos2, strip);
    rows.fields[stride + row] = compliances.stretched, rows.fields[2 * stride + row] = compliances.compressed;
    c.arrays.settled[row] = 1;
}

#include "physics/tear/rules.kernel.h"

}  // namespace weft::scalar
