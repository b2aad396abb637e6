// Where a cloth tears, and what an opening changes: one text for C++ and GLSL (law: tear.md).
//
// It is included where TearCloth and the functions that read and write its numbers are defined: solver/model/tear_cloth.h
// for C++, vulkan/shaders/tear/tear_cloth.glsl for GLSL. TearTable and TearLaw explain the numbers. Triangles and corners
// are numbered as in ClothModel::faces: corner = slot * stride + triangle.
//
// Functions that several invocations of a workgroup run have no returns within loops: lavapipe loses invocations there.

#define WEFT_TEAR_NONE 0xffffffffu
// In the place of an opening's second link: the triangle of the first link is removed.
#define WEFT_TEAR_DROP 0xfffffffeu

// A cut ends at a particle of the rim with more cloth around it at rest, rad: three quarters of a turn, and room for
// rounding.
#define WEFT_TEAR_END_ANGLE 4.71338898
// Openings of a cloth in a substep. More of them wait for the next substep.
#define WEFT_TEAR_MOST_OPENINGS 64u
// The end of a cut that does not open keeps cloth beside it closed up to this load.
#define WEFT_TEAR_MOST_HELD 4.0
// A rip goes on along an edge that leads forward by at least this part of its length.
#define WEFT_TEAR_FORWARD 0.35

WEFT_FN uint tear_slot(TearCloth c, uint corner) { return corner / tear_stride(c); }
WEFT_FN uint tear_triangle(TearCloth c, uint corner) { return corner % tear_stride(c); }
// The particle at a triangle's corner.
WEFT_FN uint tear_corner_of(TearCloth c, uint triangle, uint slot) { return tear_face(c, slot * tear_stride(c) + triangle); }

// Whether the triangle has not been removed. A removed one has the same particle at all its corners.
WEFT_FN bool tear_lives(TearCloth c, uint triangle)
{
    return !tear_erodes(c) || tear_corner_of(c, triangle, 0u) != tear_corner_of(c, triangle, 1u);
}
// Whether the triangle of a ring's entry belongs to the particle.
WEFT_FN bool tear_has(TearCloth c, uint i, uint particle)
{
    uint corner = tear_corner(c, i);
    return tear_face(c, corner) == particle && tear_lives(c, tear_triangle(c, corner));
}

// Whether the triangles on both sides of a link still share its edge.
WEFT_FN bool tear_is_closed(TearCloth c, uint link)
{
    uint next = tear_next(c, link);
    if (next == WEFT_TEAR_NONE) return false;
    if (!tear_lives(c, tear_triangle(c, tear_corner(c, link)))) return false;
    return tear_face(c, tear_corner(c, link)) == tear_face(c, tear_corner(c, next)) &&
           tear_face(c, tear_far(c, link)) == tear_face(c, tear_next_far(c, link));
}

// Whether a cut ends at the particle.
WEFT_FN bool tear_is_end(TearCloth c, uint particle)
{
    uint vertex = tear_vertex_of(c, particle);
    real angle = real(0);
    bool open = false;
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        if (!tear_has(c, i, particle)) continue;
        angle = angle + tear_angle(c, i);
        if (!tear_is_closed(c, i)) open = true;
    }
    return open && angle > real(WEFT_TEAR_END_ANGLE);
}

// 1 / limit of the tension in the direction (x, y) at the end of a cut, m/N. `area` is that of the particle's triangles.
WEFT_FN real tear_inverse_end_limit(TearCloth c, uint particle, real x, real y, real area, real energy)
{
    uint vertex = tear_vertex_of(c, particle);
    real stiffness = real(0), length = real(0), links = real(0);
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        if (!tear_has(c, i, particle)) continue;
        uint t = tear_triangle(c, tear_corner(c, i));
        real c2 = tear_turn(c, i, 0u), s2 = tear_turn(c, i, 1u);
        for (uint k = 0u; k < 3u; ++k)
            stiffness = stiffness + side_stiffness(tear_side(c, t, k), c2, s2, x, y) * tear_area(c, t);
        if (tear_has_couplings(c))
            stiffness = stiffness + coupling_stiffness(tear_side(c, t, 0u), tear_side(c, t, 1u), tear_side(c, t, 2u),
                                                       tear_coupling(c, t), c2, s2, x, y) *
                                        tear_area(c, t);
        if (tear_next(c, i) == WEFT_TEAR_NONE) continue;
        length = length + tear_length(c, i);
        links = links + real(1);
    }
    if (!(links > real(0))) return real(0);
    return inverse_cut_limit(stiffness / area, length / links, energy);
}

// 1 / limit of the tension `at`, m/N.
WEFT_FN real tear_inverse_limit(TearCloth c, uint particle, TearLoad at, real area)
{
    if (!at.end || !(tear_energy(c) > real(0)))
        return inverse_strength(at.x, at.y, tear_inverse_strength(c, 0u), tear_inverse_strength(c, 1u));
    return tear_inverse_end_limit(c, particle, at.x, at.y, area, tear_energy(c));
}

// The load across the seam at the particle, where it exceeds that of the fabric.
WEFT_FN TearLoad tear_seam_load(TearCloth c, uint particle, TearLoad at, PlaneStress stress, real area)
{
    uint vertex = tear_vertex_of(c, particle);
    TearLoad most = at;
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        real inverse = tear_seam(c, i, 0u), energy = tear_seam(c, i, 1u);
        if (!(inverse > real(0)) || !tear_has(c, i, particle) || !tear_is_closed(c, i)) continue;
        real x = tear_seam(c, i, 2u), y = tear_seam(c, i, 3u);
        real across = stress.mean + stress.difference * (x * x - y * y) + stress.mixed * (real(2) * x * y);
        if (!(across > real(0))) continue;
        if (at.end && energy > real(0)) inverse = tear_inverse_end_limit(c, particle, x, y, area, energy);
        if (!(across * inverse > most.load)) continue;
        most.load = across * inverse;
        most.x = x;
        most.y = y;
        most.seam = true;
    }
    return most;
}

// Stress of a triangle with these positions of its corners.
WEFT_FN PlaneStress tear_stress(TearCloth c, uint t, vec3 x0, vec3 x1, vec3 x2, TearSide a, TearSide b, TearSide d)
{
    TearFlat laid = lay_flat(x0, x1, x2, a, b);
    PlaneStress stress = springs_stress(laid, a, b, d);
    if (tear_has_couplings(c)) stress = add_stress(stress, coupling_stress(laid, a, b, d, tear_coupling(c, t)), real(1));
    return stress;
}

WEFT_FN TearLoad tear_load(TearCloth c, uint particle)
{
    uint vertex = tear_vertex_of(c, particle);
    PlaneStress sum = no_stress();
    real area = real(0), strain = real(0);
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        uint corner = tear_corner(c, i);
        if (!tear_has(c, i, particle)) continue;
        uint t = tear_triangle(c, corner), mine = tear_slot(c, corner);
        vec3 x0 = tear_position(c, tear_corner_of(c, t, 0u)), x1 = tear_position(c, tear_corner_of(c, t, 1u)),
             x2 = tear_position(c, tear_corner_of(c, t, 2u));
        TearSide a = tear_side(c, t, 0u), b = tear_side(c, t, 1u), d = tear_side(c, t, 2u);
        PlaneStress stress = turn_stress(tear_stress(c, t, x0, x1, x2, a, b, d), tear_turn(c, i, 0u), tear_turn(c, i, 1u));
        sum = add_stress(sum, stress, tear_area(c, t));
        area = area + tear_area(c, t);
        if (mine != 2u) strain = max(strain, side_strain(x0, x1, a));   // the two sides at this corner
        if (mine != 0u) strain = max(strain, side_strain(x1, x2, b));
        if (mine != 1u) strain = max(strain, side_strain(x2, x0, d));
    }
    TearLoad at;
    at.load = strain * tear_inverse_stretch(c);
    at.x = real(1);
    at.y = real(0);
    at.end = !tear_erodes(c) && tear_is_end(c, particle);
    at.seam = false;
    if (!(area > real(0))) return at;
    PlaneStress stress = add_stress(no_stress(), sum, real(1) / area);
    Tension tension = principal_tension(stress);
    at.x = tension.x;
    at.y = tension.y;
    at.load = max(at.load, max(tension.most, real(0)) * tear_inverse_limit(c, particle, at, area));
    if (tear_has_seams(c)) at = tear_seam_load(c, particle, at, stress, area);
    at.load = at.load * tear_inverse_resistance(c, vertex);
    return at;
}

// Whether the triangle's load may soon exceed a limit at a corner where no cut ends.
WEFT_FN bool tear_is_hot(TearCloth c, uint t, real part)
{
    vec3 x0 = tear_position(c, tear_corner_of(c, t, 0u)), x1 = tear_position(c, tear_corner_of(c, t, 1u)),
         x2 = tear_position(c, tear_corner_of(c, t, 2u));
    TearSide a = tear_side(c, t, 0u), b = tear_side(c, t, 1u), d = tear_side(c, t, 2u);
    PlaneStress stress = tear_stress(c, t, x0, x1, x2, a, b, d);
    real radius = sqrt(stress.difference * stress.difference + stress.mixed * stress.mixed);
    real strain = max(max(max(real(0), side_strain(x0, x1, a)), side_strain(x1, x2, b)), side_strain(x2, x0, d));
    return (stress.mean + radius) * tear_watch_limit(c, t, 0u) > part || strain * tear_watch_limit(c, t, 1u) > part;
}

// Whether the load of another particle keeps this one closed. A rip does not start beside the end of another one. A pinned
// end has no load: it never opens, so cloth beside it must. An end that does not open holds cloth up to a load.
WEFT_FN bool tear_yields(TearCloth c, uint particle, TearLoad at, uint other)
{
    bool yields = false;
    if (other != particle && tear_is_watched(c, other)) {
        TearLoad there = tear_kept_load(c, other);
        if (there.end == at.end) {
            yields = there.load > at.load || (there.load == at.load && other < particle);
        } else {
            yields = there.end && (there.load >= real(1) || (there.load > real(0) && at.load < real(WEFT_TEAR_MOST_HELD)));
        }
    }
    return yields;
}

// Whether the particle yields to one that shares a triangle with `near`.
WEFT_FN bool tear_yields_around(TearCloth c, uint particle, TearLoad at, uint near)
{
    uint vertex = tear_vertex_of(c, near);
    bool yields = false;
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u) && !yields; ++i) {
        uint t = tear_triangle(c, tear_corner(c, i));
        if (tear_face(c, tear_corner(c, i)) == near)
            yields = tear_yields(c, particle, at, tear_corner_of(c, t, 0u)) ||
                     tear_yields(c, particle, at, tear_corner_of(c, t, 1u)) ||
                     tear_yields(c, particle, at, tear_corner_of(c, t, 2u));
    }
    return yields;
}

// Whether no particle within two edges has a larger load.
WEFT_FN bool tear_is_largest(TearCloth c, uint particle, TearLoad at)
{
    uint vertex = tear_vertex_of(c, particle);
    bool largest = true;
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u) && largest; ++i) {
        uint t = tear_triangle(c, tear_corner(c, i));
        if (tear_face(c, tear_corner(c, i)) == particle)
            largest = !tear_yields_around(c, particle, at, tear_corner_of(c, t, 0u)) &&
                      !tear_yields_around(c, particle, at, tear_corner_of(c, t, 1u)) &&
                      !tear_yields_around(c, particle, at, tear_corner_of(c, t, 2u));
    }
    return largest;
}

// An edge of the particle's fan, and how far from its line a rip is at the edge's other end.
struct TearChoice {
    uint link;
    real strayed;
};

// Whether a rip can take the edge: along a seam its edges, elsewhere all but those of a seam that is stronger than the
// fabric.
WEFT_FN bool tear_can_open(TearCloth c, uint link, bool seam)
{
    if (!tear_has_seams(c)) return true;
    real inverse = tear_seam(c, link, 0u);
    if (seam) return inverse > real(0);
    return !(inverse > real(0) && inverse < max(tear_inverse_strength(c, 0u), tear_inverse_strength(c, 1u)));
}

// The edge that keeps a rip in the direction (x, y) nearest to its line. Edges that lead more aside than forward count as
// far off the line.
WEFT_FN TearChoice tear_choose(TearCloth c, uint particle, bool seam, real x, real y, real strayed, uint taken)
{
    TearChoice best;
    best.link = WEFT_TEAR_NONE;
    best.strayed = real(0);
    real least = real(0);
    uint vertex = tear_vertex_of(c, particle);
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        if (i == taken || !tear_has(c, i, particle) || !tear_is_closed(c, i) || !tear_can_open(c, i, seam)) continue;
        real along_x = tear_along(c, i, 0u), along_y = tear_along(c, i, 1u), length = tear_length(c, i);
        real ahead = along_x * x + along_y * y;
        if (!(ahead > real(0))) continue;
        real aside = strayed + length * (along_y * x - along_x * y);
        real off = abs(aside);
        if (ahead < real(WEFT_TEAR_FORWARD)) off = off + real(2) * length * (real(1) - ahead);
        if (best.link != WEFT_TEAR_NONE && !(off < least)) continue;
        best.link = i;
        best.strayed = aside;
        least = off;
    }
    return best;
}

struct TearOpening {
    uint first, second;   // links; `first` is none if nothing opens
    real first_strayed, second_strayed;
};

WEFT_FN TearOpening tear_no_opening()
{
    TearOpening none;
    none.first = WEFT_TEAR_NONE;
    none.second = WEFT_TEAR_NONE;
    none.first_strayed = real(0);
    none.second_strayed = real(0);
    return none;
}

// Of the particle's triangles, removes the one that has the longest side at the particle, relative to its length at rest.
WEFT_FN TearOpening tear_removal(TearCloth c, uint particle)
{
    TearOpening o = tear_no_opening();
    real most = real(0);
    uint vertex = tear_vertex_of(c, particle);
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        if (!tear_has(c, i, particle)) continue;
        uint t = tear_triangle(c, tear_corner(c, i)), a = tear_slot(c, tear_corner(c, i));
        uint b = (a + 1u) % 3u, d = (a + 2u) % 3u;
        vec3 x = tear_position(c, particle);
        real strain = max(side_strain(x, tear_position(c, tear_corner_of(c, t, b)), tear_side(c, t, a)),
                          side_strain(tear_position(c, tear_corner_of(c, t, d)), x, tear_side(c, t, d)));
        if (!(strain > most)) continue;
        most = strain;
        o.first = i;
        o.second = WEFT_TEAR_DROP;
    }
    return o;
}

// Inside the cloth a rip starts along two edges. From the rim, and from the end of a cut, it takes one.
WEFT_FN TearOpening tear_opening(TearCloth c, uint particle, TearLoad at)
{
    if (tear_erodes(c)) return tear_removal(c, particle);
    TearOpening o = tear_no_opening();
    real x = -at.y, y = at.x;   // across the tension
    real back_x = real(0), back_y = real(0);
    bool whole = true;
    uint vertex = tear_vertex_of(c, particle);
    for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u); ++i) {
        if (!tear_has(c, i, particle) || tear_is_closed(c, i)) continue;
        whole = false;
        if (tear_next(c, i) == WEFT_TEAR_NONE) continue;
        back_x = back_x + tear_along(c, i, 0u);
        back_y = back_y + tear_along(c, i, 1u);
    }
    if (whole) {
        TearChoice one = tear_choose(c, particle, at.seam, x, y, real(0), WEFT_TEAR_NONE);
        if (one.link == WEFT_TEAR_NONE) return o;
        TearChoice other = tear_choose(c, particle, at.seam, -x, -y, real(0), one.link);
        if (other.link == WEFT_TEAR_NONE) return o;
        o.first = one.link;
        o.first_strayed = one.strayed;
        o.second = other.link;
        o.second_strayed = other.strayed;
        return o;
    }
    TearChoice chosen;
    if (at.seam) {
        chosen = tear_choose(c, particle, true, x, y, real(0), WEFT_TEAR_NONE);
        if (chosen.link == WEFT_TEAR_NONE) chosen = tear_choose(c, particle, true, -x, -y, real(0), WEFT_TEAR_NONE);
    } else if (at.end && (back_x != real(0) || back_y != real(0))) {
        if (x * back_x + y * back_y > real(0)) {
            x = -x;
            y = -y;
        }
        chosen = tear_choose(c, particle, false, x, y, tear_strayed(c, vertex), WEFT_TEAR_NONE);
    } else {
        chosen = tear_choose(c, particle, false, x, y, real(0), WEFT_TEAR_NONE);
        TearChoice other = tear_choose(c, particle, false, -x, -y, real(0), WEFT_TEAR_NONE);
        if (chosen.link == WEFT_TEAR_NONE || (other.link != WEFT_TEAR_NONE && abs(other.strayed) < abs(chosen.strayed)))
            chosen = other;
    }
    o.first = chosen.link;
    o.first_strayed = chosen.strayed;
    return o;
}

// Gives both triangles of a link the lower number of their fans.
WEFT_FN void tear_join(TearCloth c, uint link, TearOpening opened)
{
    if (link == opened.first || link == opened.second || !tear_is_closed(c, link)) return;
    uint a = tear_fan(c, link), b = tear_fan(c, tear_next(c, link));
    uint low = a < b ? a : b;
    tear_set_fan(c, link, low);
    tear_set_fan(c, tear_next(c, link), low);
}

// Whether a fan that begins before `i` has the same particle.
WEFT_FN bool tear_is_taken(TearCloth c, uint begin, uint i)
{
    uint particle = tear_face(c, tear_corner(c, i));
    for (uint j = begin; j < i; ++j)
        if (tear_fan(c, j) == j && tear_has(c, j, particle)) return true;
    return false;
}

// Groups the ring's triangles to fans, with these links open. Returns how many fans need a particle of their own.
WEFT_FN uint tear_group(TearCloth c, uint vertex, TearOpening opened)
{
    uint begin = tear_ring(c, vertex), end = tear_ring(c, vertex + 1u);
    for (uint i = begin; i < end; ++i) tear_set_fan(c, i, i);
    // A ring consists of chains and circles, so a sweep in each direction brings the lowest number to all of a fan.
    for (uint i = begin; i < end; ++i) tear_join(c, i, opened);
    for (uint i = end; i > begin; --i) tear_join(c, i - 1u, opened);
    uint missing = 0u;
    for (uint i = begin; i < end; ++i)
        if (tear_fan(c, i) == i && tear_lives(c, tear_triangle(c, tear_corner(c, i))) && tear_is_taken(c, begin, i)) ++missing;
    return missing;
}

// Sets the masses of the particles at the vertex, in single precision and in the order of the ring. Triangles without area
// do not count.
WEFT_FN void tear_weigh(TearCloth c, uint vertex)
{
    uint begin = tear_ring(c, vertex), end = tear_ring(c, vertex + 1u);
    for (uint i = begin; i < end; ++i) {
        uint t = tear_triangle(c, tear_corner(c, i));
        if (tear_face_mass(c, t) > real(0) && tear_lives(c, t)) tear_set_mass(c, tear_face(c, tear_corner(c, i)), real(0));
    }
    for (uint i = begin; i < end; ++i) {
        uint particle = tear_face(c, tear_corner(c, i)), t = tear_triangle(c, tear_corner(c, i));
        real mass = tear_face_mass(c, t);
        if (mass > real(0) && tear_lives(c, t)) tear_set_mass(c, particle, tear_mass(c, particle) + mass / real(3));
    }
}

// Gives each further fan at the vertex a copy of the particle. Then sets the masses of the particles there.
WEFT_FN void tear_part(TearCloth c, uint vertex, TearOpening opened)
{
    if (tear_group(c, vertex, opened) == 0u) return;
    uint begin = tear_ring(c, vertex), end = tear_ring(c, vertex + 1u);
    for (uint i = begin + 1u; i < end; ++i) {
        // Fans keep their numbers, so a fan that has a copy by now is found by its particle.
        if (tear_fan(c, i) != i || !tear_lives(c, tear_triangle(c, tear_corner(c, i))) || !tear_is_taken(c, begin, i)) continue;
        uint copy = tear_add_copy(c, tear_face(c, tear_corner(c, i)));
        if (copy == WEFT_TEAR_NONE) continue;   // no room: the fans stay joined by the particle
        for (uint j = i; j < end; ++j)
            if (tear_fan(c, j) == i) tear_set_face(c, tear_corner(c, j), copy);
    }
    tear_weigh(c, vertex);
}

WEFT_FN uint tear_far_vertex(TearCloth c, uint link) { return tear_vertex(c, tear_twin(c, link)); }

// The vertices at which an opening can part triangles, k = 0, 1, 2; none if there are fewer.
WEFT_FN uint tear_opened_vertex(TearCloth c, TearOpening opening, uint k)
{
    if (opening.second == WEFT_TEAR_DROP)
        return tear_corner_vertex(c, k * tear_stride(c) + tear_triangle(c, tear_corner(c, opening.first)));
    if (k == 0u) return tear_vertex(c, opening.first);
    if (k == 1u) return tear_far_vertex(c, opening.first);
    return opening.second == WEFT_TEAR_NONE ? WEFT_TEAR_NONE : tear_far_vertex(c, opening.second);
}

// Removes the triangle of the entry. What then hangs by a point is parted.
WEFT_FN bool tear_drop(TearCloth c, TearOpening removal)
{
    uint t = tear_triangle(c, tear_corner(c, removal.first));
    if (!tear_lives(c, t)) return true;
    if (tear_room(c) < 3u) return false;
    for (uint k = 1u; k < 3u; ++k) tear_set_face(c, k * tear_stride(c) + t, tear_corner_of(c, t, 0u));
    for (uint k = 0u; k < 3u; ++k) {
        uint vertex = tear_corner_vertex(c, k * tear_stride(c) + t);
        tear_part(c, vertex, tear_no_opening());
        tear_weigh(c, vertex);
    }
    return true;
}

// Parts the triangles at the vertex of the links along their edges, and those at the far ends where an edge that was open
// before now parts them. Or removes a triangle. Constraints follow by tear_update_row(). Returns false and changes nothing
// if there is no room.
WEFT_FN bool tear_open(TearCloth c, TearOpening opening)
{
    if (opening.second == WEFT_TEAR_DROP) return tear_drop(c, opening);
    uint vertex = tear_vertex(c, opening.first);
    uint links = opening.second == WEFT_TEAR_NONE ? 1u : 2u;
    // At the far ends there are at most as many more fans as links.
    if (tear_group(c, vertex, opening) + links > tear_room(c)) return false;
    tear_part(c, vertex, opening);
    tear_set_strayed(c, tear_far_vertex(c, opening.first), opening.first_strayed);
    tear_part(c, tear_far_vertex(c, opening.first), tear_no_opening());
    if (opening.second == WEFT_TEAR_NONE) return true;
    tear_set_strayed(c, tear_far_vertex(c, opening.second), opening.second_strayed);
    tear_part(c, tear_far_vertex(c, opening.second), tear_no_opening());
    return true;
}

// Gives the row the particles, and ends the line there if they are others.
WEFT_FN void tear_move_stretch(TearCloth c, uint row, uint a, uint b)
{
    if (tear_row_particle(c, WEFT_TEAR_STRETCH, row, 0u) != a || tear_row_particle(c, WEFT_TEAR_STRETCH, row, 1u) != b) {
        tear_set_row_particle(c, WEFT_TEAR_STRETCH, row, 0u, a);
        tear_set_row_particle(c, WEFT_TEAR_STRETCH, row, 1u, b);
        tear_cut_line(c, row);
    }
}

// The stretch constraint of an edge one of whose triangles was removed: it follows the other one and has its stiffness.
// Without triangles it ends.
WEFT_FN void tear_update_eroded(TearCloth c, uint row, bool first, bool second)
{
    if (!first && !second) {
        tear_end_stretch(c, row);
    } else {
        if (tear_second_corner(c, row, 0u) != WEFT_TEAR_NONE && !tear_is_settled(c, row)) tear_settle(c, row, first);
        uint corner_a = first ? tear_row_corner(c, WEFT_TEAR_STRETCH, row, 0u) : tear_second_corner(c, row, 0u),
             corner_b = first ? tear_row_corner(c, WEFT_TEAR_STRETCH, row, 1u) : tear_second_corner(c, row, 1u);
        tear_move_stretch(c, row, tear_face(c, corner_a), tear_face(c, corner_b));
    }
}

// A stretch constraint follows its first triangle. While its edge is open, its second half follows the other one.
WEFT_FN void tear_update_stretch(TearCloth c, uint row)
{
    uint corner_a = tear_row_corner(c, WEFT_TEAR_STRETCH, row, 0u), other = tear_second_corner(c, row, 0u);
    bool first = tear_lives(c, tear_triangle(c, corner_a)),
         second = other != WEFT_TEAR_NONE && tear_lives(c, tear_triangle(c, other));
    if (!first || (other != WEFT_TEAR_NONE && !second)) {
        tear_update_eroded(c, row, first, second);
    } else {
        uint a = tear_face(c, corner_a), b = tear_face(c, tear_row_corner(c, WEFT_TEAR_STRETCH, row, 1u));
        tear_move_stretch(c, row, a, b);
        if (second) {
            uint other_a = tear_face(c, other), other_b = tear_face(c, tear_second_corner(c, row, 1u));
            if (other_a != a || other_b != b) {
                tear_part_stiffness(c, row);
                uint half_row = tear_halves(c) + row;
                tear_set_row_particle(c, WEFT_TEAR_STRETCH, half_row, 0u, other_a);
                tear_set_row_particle(c, WEFT_TEAR_STRETCH, half_row, 1u, other_b);
                tear_cut_line(c, half_row);
            }
        }
    }
}

// Other constraints end if they cross an open edge, or with their first triangle.
WEFT_FN void tear_update_other(TearCloth c, uint kind, uint row)
{
    bool open = !tear_lives(c, tear_triangle(c, tear_row_corner(c, kind, row, 0u)));
    for (uint i = tear_tie_begin(c, kind, row); i < tear_tie_begin(c, kind, row + 1u); ++i)
        if (tear_face(c, tear_tie(c, kind, i, 0u)) != tear_face(c, tear_tie(c, kind, i, 1u))) open = true;
    if (open) {
        tear_end_row(c, kind, row);
    } else {
        for (uint slot = 0u; slot < tear_arity(c, kind); ++slot)
            tear_set_row_particle(c, kind, row, slot, tear_face(c, tear_row_corner(c, kind, row, slot)));
    }
}

WEFT_FN void tear_update_row(TearCloth c, uint kind, uint row)
{
    if (tear_has_row(c, kind, row)) {
        if (kind == WEFT_TEAR_STRETCH) {
            tear_update_stretch(c, row);
        } else {
            tear_update_other(c, kind, row);
        }
    }
}
