// The rules of tearing (physics/tear/rules.kernel.h) on a cloth on the device. The passes are in
// vulkan/tear/tearing.cpp.
#ifndef WEFT_TEAR_CLOTH_GLSL
#define WEFT_TEAR_CLOTH_GLSL

#include "vulkan/shaders/common.glsl"
#include "vulkan/tear/args.data.h"

layout(push_constant) uniform Push { TearArgs args; };

#define tear_data args.data.at
#define tear_head args.data.at.head.at

#define WEFT_TEAR_STRETCH 0u

// There is one cloth in a dispatch, so the rules' argument has no content.
struct TearCloth {
    uint unused;
};
#include "physics/tear/load.kernel.h"

uint tear_stride(TearCloth c) { return tear_data.stride; }
uint tear_face(TearCloth c, uint corner) { return tear_data.faces.at[corner]; }
void tear_set_face(TearCloth c, uint corner, uint particle) { tear_data.faces.at[corner] = particle; }
uint tear_ring(TearCloth c, uint vertex) { return tear_data.ring.at[vertex]; }
uint tear_vertex(TearCloth c, uint i) { return tear_data.entries.at[6u * i]; }
uint tear_corner(TearCloth c, uint i) { return tear_data.entries.at[6u * i + 1u]; }
uint tear_next(TearCloth c, uint i) { return tear_data.entries.at[6u * i + 2u]; }
uint tear_far(TearCloth c, uint i) { return tear_data.entries.at[6u * i + 3u]; }
uint tear_next_far(TearCloth c, uint i) { return tear_data.entries.at[6u * i + 4u]; }
uint tear_twin(TearCloth c, uint i) { return tear_data.entries.at[6u * i + 5u]; }
uint tear_corner_vertex(TearCloth c, uint corner) { return tear_data.vertices.at[corner]; }
bool tear_erodes(TearCloth c) { return tear_data.erodes != 0u; }
uint tear_vertex_of(TearCloth c, uint particle) { return tear_data.vertex.at[particle]; }

float tear_side_number(uint triangle, uint i) { return tear_data.sides.at[i * tear_data.stride + triangle]; }
TearSide tear_side(TearCloth c, uint triangle, uint k)
{
    uint i = WEFT_TEAR_SIDE_NUMBERS * k;
    return TearSide(tear_side_number(triangle, i), tear_side_number(triangle, i + 1u), tear_side_number(triangle, i + 2u),
                    tear_side_number(triangle, i + 3u), tear_side_number(triangle, i + 4u), tear_side_number(triangle, i + 5u));
}
bool tear_has_couplings(TearCloth c) { return tear_data.has_couplings != 0u; }
float tear_coupling_number(uint triangle, uint i) { return tear_data.couplings.at[i * tear_data.stride + triangle]; }
TearCoupling tear_coupling(TearCloth c, uint triangle)
{
    return TearCoupling(tear_coupling_number(triangle, 0u), tear_coupling_number(triangle, 1u), tear_coupling_number(triangle, 2u),
                        tear_coupling_number(triangle, 3u), tear_coupling_number(triangle, 4u), tear_coupling_number(triangle, 5u));
}
float tear_area(TearCloth c, uint triangle) { return tear_data.area.at[triangle]; }
float tear_turn(TearCloth c, uint i, uint k) { return tear_data.numbers.at[6u * i + k]; }
float tear_angle(TearCloth c, uint i) { return tear_data.numbers.at[6u * i + 2u]; }
float tear_length(TearCloth c, uint i) { return tear_data.numbers.at[6u * i + 3u]; }
float tear_along(TearCloth c, uint i, uint k) { return tear_data.numbers.at[6u * i + 4u + k]; }
float tear_inverse_strength(TearCloth c, uint k) { return tear_data.inverse_strength[k]; }
float tear_energy(TearCloth c) { return tear_data.energy; }
float tear_inverse_stretch(TearCloth c) { return tear_data.inverse_stretch; }
float tear_inverse_resistance(TearCloth c, uint vertex) { return tear_data.inverse_resistance.at[vertex]; }
bool tear_has_seams(TearCloth c) { return tear_data.has_seams != 0u; }
float tear_seam(TearCloth c, uint i, uint k) { return tear_data.seams.at[4u * i + k]; }
float tear_watch_limit(TearCloth c, uint triangle, uint k) { return tear_data.watch.at[k * tear_data.stride + triangle]; }

vec3 tear_position(TearCloth c, uint particle) { return tear_data.position.at[particle].xyz; }
bool tear_is_watched(TearCloth c, uint particle) { return tear_data.watched.at[particle] != 0u; }
TearLoad tear_kept_load(TearCloth c, uint particle)
{
    vec4 kept = tear_data.loads.at[particle];
    return TearLoad(kept.x, kept.y, kept.z, kept.w == 1.0 || kept.w == 3.0, kept.w >= 2.0);
}
float tear_strayed(TearCloth c, uint vertex) { return tear_data.strayed.at[vertex]; }
void tear_set_strayed(TearCloth c, uint vertex, float strayed) { tear_data.strayed.at[vertex] = strayed; }

uint tear_fan(TearCloth c, uint i) { return tear_data.fan.at[i]; }
void tear_set_fan(TearCloth c, uint i, uint fan) { tear_data.fan.at[i] = fan; }
uint tear_room(TearCloth c) { return tear_data.all_particles - tear_head.particles; }
uint tear_add_copy(TearCloth c, uint from)
{
    uint copy = tear_head.particles;
    if (copy >= tear_data.all_particles) return 0xffffffffu;
    tear_head.particles = copy + 1u;
    tear_data.vertex.at[copy] = tear_data.vertex.at[from];
    tear_data.position.at[copy] = tear_data.position.at[from];
    tear_data.start.at[copy] = tear_data.start.at[from];
    tear_data.velocity.at[copy] = tear_data.velocity.at[from];
    tear_data.compensation.at[copy] = tear_data.compensation.at[from];
    tear_data.weights.at[copy] = tear_data.weights.at[from];
    if (!is_none(uvec2(tear_data.thickness))) tear_data.thickness.at[copy] = tear_data.thickness.at[from];
    return copy;
}
float tear_face_mass(TearCloth c, uint triangle) { return tear_data.face_mass.at[triangle]; }
float tear_mass(TearCloth c, uint particle) { return tear_data.mass.at[particle]; }
void tear_set_mass(TearCloth c, uint particle, float mass) { tear_data.mass.at[particle] = mass; }

#define tear_kind_at(kind) tear_data.kinds.at[kind]
uint tear_arity(TearCloth c, uint kind) { return tear_kind_at(kind).arity; }
uint tear_row_corner(TearCloth c, uint kind, uint row, uint slot)
{
    return tear_kind_at(kind).corners.at[slot * tear_kind_at(kind).stride + row];
}
uint tear_row_particle(TearCloth c, uint kind, uint row, uint slot)
{
    return tear_kind_at(kind).particles.at[slot * tear_kind_at(kind).stride + row];
}
void tear_set_row_particle(TearCloth c, uint kind, uint row, uint slot, uint particle)
{
    tear_kind_at(kind).particles.at[slot * tear_kind_at(kind).stride + row] = particle;
}
// The host gives constraints that were removed no corners.
bool tear_has_row(TearCloth c, uint kind, uint row)
{
    return tear_row_corner(c, kind, row, 0u) != 0xffffffffu &&
           (kind == WEFT_TEAR_STRETCH || tear_row_particle(c, kind, row, 0u) < tear_kind_at(kind).first_dummy);
}
uint tear_tie_begin(TearCloth c, uint kind, uint row) { return tear_kind_at(kind).tie_begin.at[row]; }
uint tear_tie(TearCloth c, uint kind, uint i, uint k) { return tear_kind_at(kind).ties.at[2u * i + k]; }
void tear_end_row(TearCloth c, uint kind, uint row)
{
    uint stride = tear_kind_at(kind).stride;
    for (uint slot = 0u; slot < tear_kind_at(kind).arity; ++slot)
        tear_set_row_particle(c, kind, row, slot,
                              tear_kind_at(kind).first_dummy + slot * WEFT_LANE_PADDING + row % WEFT_LANE_PADDING);
    for (uint field = 0u; field < tear_kind_at(kind).field_count; ++field)
        tear_kind_at(kind).fields.at[field * stride + row] = 0.0;
}

uint tear_halves(TearCloth c) { return tear_data.halves; }
uint tear_second_corner(TearCloth c, uint row, uint slot) { return tear_data.second.at[slot * tear_data.halves + row]; }
// The block of lines that has the row; none if the row is not on a line.
uint tear_line_block(TearCloth c, uint row)
{
    uint low = 0u, high = tear_data.block_count;   // blocks below `low` begin at or before the row
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (tear_data.blocks.at[2u * middle] <= row) low = middle + 1u;
        else high = middle;
    }
    if (low == 0u) return 0xffffffffu;
    uint block = low - 1u, length = tear_data.blocks.at[2u * block + 1u] & ~WEFT_CUT_BLOCK;
    return row < tear_data.blocks.at[2u * block] + length * WEFT_LANE_PADDING ? block : 0xffffffffu;
}
// Marks the block of lines that has the row: a line may end in it.
void tear_cut_line(TearCloth c, uint row)
{
    uint block = tear_line_block(c, row);
    if (block != 0xffffffffu) atomicOr(tear_data.blocks.at[2u * block + 1u], WEFT_CUT_BLOCK);
}
// Turns a row of stretch constraints into padding. On a line it keeps its particles, and a negative compliance separates
// the constraints before and after it. Without corners it is not updated any more.
void tear_end_stretch(TearCloth c, uint row)
{
    uint stride = tear_kind_at(WEFT_TEAR_STRETCH).stride;
    if (tear_line_block(c, row) == 0xffffffffu) {
        tear_end_row(c, WEFT_TEAR_STRETCH, row);
    } else {
        tear_kind_at(WEFT_TEAR_STRETCH).fields.at[stride + row] = -1.0;
        tear_kind_at(WEFT_TEAR_STRETCH).fields.at[2u * stride + row] = -1.0;
    }
    tear_kind_at(WEFT_TEAR_STRETCH).corners.at[row] = 0xffffffffu;
}
// Constraints whose edge was open at the start of the frame have these numbers already.
void tear_part_stiffness(TearCloth c, uint row)
{
    uint stride = tear_kind_at(WEFT_TEAR_STRETCH).stride, second = tear_data.halves + row;
    tear_kind_at(WEFT_TEAR_STRETCH).fields.at[second] = tear_kind_at(WEFT_TEAR_STRETCH).fields.at[row];
    tear_kind_at(WEFT_TEAR_STRETCH).fields.at[3u * stride + second] = tear_kind_at(WEFT_TEAR_STRETCH).fields.at[3u * stride + row];
    for (uint k = 0u; k < 2u; ++k) {
        tear_kind_at(WEFT_TEAR_STRETCH).fields.at[(k + 1u) * stride + row] = tear_data.half_fields.at[4u * row + k];
        tear_kind_at(WEFT_TEAR_STRETCH).fields.at[(k + 1u) * stride + second] = tear_data.half_fields.at[4u * row + 2u + k];
    }
}

// Whether the constraint has the stiffness of the one triangle at its edge that is left.
bool tear_is_settled(TearCloth c, uint row) { return tear_data.settled.at[row] != 0u; }
// Gives a constraint the stiffness of one of its two triangles. Its second half ends.
void tear_settle(TearCloth c, uint row, bool first)
{
    uint stride = tear_kind_at(WEFT_TEAR_STRETCH).stride, second = tear_data.halves + row;
    if (tear_row_particle(c, WEFT_TEAR_STRETCH, second, 0u) < tear_kind_at(WEFT_TEAR_STRETCH).first_dummy)
        tear_end_row(c, WEFT_TEAR_STRETCH, second);
    for (uint k = 0u; k < 2u; ++k)
        tear_kind_at(WEFT_TEAR_STRETCH).fields.at[(k + 1u) * stride + row] =
            tear_data.half_fields.at[4u * row + (first ? 0u : 2u) + k];
    tear_data.settled.at[row] = 1u;
}

#include "physics/tear/rules.kernel.h"

#endif
