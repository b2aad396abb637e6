// Contact of two features of cloth: closest points, gap and push (law: cloth_contact.md).
//
// A pair has four particles. In a vertex-triangle pair the first is the vertex; in an edge-edge pair the first two are
// one edge and the others the other one. The first feature is side one.

struct ClosestPoints {
    real w0, w1, w2, w3;  // the closest point of side one minus that of side two is the sum of w_i x_i
    vec3 normal;          // from side two to side one, unit
    real distance;        // m
};

WEFT_FN real clamp01(real x) { return min(max(x, real(0)), real(1)); }

WEFT_FN ClosestPoints with_normal(ClosestPoints points, vec3 difference)
{
    real length2 = dot(difference, difference);
    points.distance = sqrt(length2);
    // Features that touch have no direction; any unit vector will do.
    points.normal = select(points.distance > real(0), difference * (real(1) / max(points.distance, real(1e-30))),
                           vec3(real(0), real(1), real(0)));
    return points;
}

// A triangle without area is treated as its three edges.
WEFT_FN ClosestPoints closest_vertex_triangle(vec3 p, vec3 a, vec3 b, vec3 c)
{
    vec3 ab = b - a, ac = c - a, bc = c - b, ap = p - a, bp = p - b, cp = p - c;
    real d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);

    // The closest of the three edges.
    real t_ab = clamp01(d1 / max(dot(ab, ab), real(1e-30)));
    real t_ac = clamp01(d2 / max(dot(ac, ac), real(1e-30)));
    real t_bc = clamp01(dot(bc, bp) / max(dot(bc, bc), real(1e-30)));
    vec3 to_ab = ap - ab * t_ab, to_ac = ap - ac * t_ac, to_bc = bp - bc * t_bc;
    real l_ab = dot(to_ab, to_ab), l_ac = dot(to_ac, to_ac), l_bc = dot(to_bc, to_bc);
    mask ac_wins = l_ac < l_ab;
    real nearest = select(ac_wins, l_ac, l_ab);
    real wb = select(ac_wins, real(0), t_ab), wc = select(ac_wins, t_ac, real(0));
    mask bc_wins = l_bc < nearest;
    nearest = select(bc_wins, l_bc, nearest);
    wb = select(bc_wins, real(1) - t_bc, wb);
    wc = select(bc_wins, t_bc, wc);

    // The face, if the vertex lies above it (Ericson 2005, Real-Time Collision Detection, 5.1.5). Of a triangle almost
    // without area rounding leaves any point of it, which may be farther away than the edges.
    real vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    mask inside = va > real(0) && vb > real(0) && vc > real(0);
    real scale = real(1) / select(inside, va + vb + vc, real(1));
    vec3 to_face = ap - ab * (vb * scale) - ac * (vc * scale);
    mask face_wins = inside && dot(to_face, to_face) < nearest;
    wb = select(face_wins, vb * scale, wb);
    wc = select(face_wins, vc * scale, wc);

    ClosestPoints points;
    points.w0 = real(1);
    points.w1 = wb + wc - real(1);
    points.w2 = -wb;
    points.w3 = -wc;
    return with_normal(points, p + a * points.w1 + b * points.w2 + c * points.w3);
}

// After Ericson 2005, 5.1.9. Parallel edges have many closest points; this takes one at an end.
WEFT_FN ClosestPoints closest_edge_edge(vec3 p0, vec3 p1, vec3 q0, vec3 q1)
{
    vec3 u = p1 - p0, v = q1 - q0, r = p0 - q0;
    real a = max(dot(u, u), real(1e-30)), e = max(dot(v, v), real(1e-30));
    real b = dot(u, v), c = dot(u, r), f = dot(v, r);
    real determinant = a * e - b * b;
    mask crossed = determinant > real(1e-7) * a * e;
    real s = select(crossed, clamp01((b * f - c * e) / select(crossed, determinant, real(1))), real(0));
    real t = (b * s + f) / e;
    s = select(t < real(0), clamp01(-c / a), s);
    s = select(t > real(1), clamp01((b - c) / a), s);
    t = clamp01(t);
    ClosestPoints points;
    points.w0 = real(1) - s;
    points.w1 = s;
    points.w2 = t - real(1);
    points.w3 = -t;
    return with_normal(points, p0 * points.w0 + p1 * points.w1 + q0 * points.w2 + q1 * points.w3);
}

// The normal of a pair, made perpendicular to what the closest points lie on. It is so already but for the rounding of
// the points, which tilts it: by 0.5 µm over a distance of 1 mm, so that the far corners of a triangle of 1 m rise by
// 0.5 mm, half of the gap. Of features that are not large beside their distance the normal is returned as it is.
//   a, b    directions on the features, m; 0 if there is only one, or none
WEFT_FN vec3 square_normal(vec3 normal, real distance, vec3 a, vec3 b)
{
    real a2 = dot(a, a), b2 = dot(b, b);
    vec3 across = cross(a, b);
    real across2 = dot(across, across);
    vec3 longer = select(a2 > b2, a, b);
    real longer2 = max(a2, b2);
    mask spans = across2 > real(1e-4) * a2 * b2 && across2 > real(0);
    vec3 result = select(spans, across * (dot(normal, across) / max(across2, real(1e-30))),
                         normal - longer * (dot(normal, longer) / max(longer2, real(1e-30))));
    real length2 = dot(result, result);
    mask squares = longer2 > real(4096) * distance * distance && length2 > real(0.25);
    return select(squares, result * (real(1) / sqrt(max(length2, real(0.25)))), normal);
}

// Weights below this are those of points at the rim of a feature, up to rounding.
WEFT_FN mask has_weight(real weight) { return abs(weight) > real(1e-6); }

WEFT_FN vec3 normal_vertex_triangle(ClosestPoints points, vec3 a, vec3 b, vec3 c)
{
    vec3 none = vec3(real(0), real(0), real(0));
    mask on_a = has_weight(points.w1), on_b = has_weight(points.w2), on_c = has_weight(points.w3);
    // From a corner with a weight to the others with one.
    vec3 one = select(on_a && on_b, b - a, none);
    vec3 two = select(on_c, select(on_a, c - a, select(on_b, c - b, none)), none);
    return square_normal(points.normal, points.distance, one, two);
}

WEFT_FN vec3 normal_edge_edge(ClosestPoints points, vec3 p0, vec3 p1, vec3 q0, vec3 q1)
{
    vec3 none = vec3(real(0), real(0), real(0));
    vec3 one = select(has_weight(points.w0) && has_weight(points.w1), p1 - p0, none);
    vec3 two = select(has_weight(points.w2) && has_weight(points.w3), q1 - q0, none);
    return square_normal(points.normal, points.distance, one, two);
}

WEFT_FN real pair_distance(bool edges, vec3 x0, vec3 x1, vec3 x2, vec3 x3)
{
    if (edges) return closest_edge_edge(x0, x1, x2, x3).distance;
    return closest_vertex_triangle(x0, x1, x2, x3).distance;
}

// Whether the sides of a pair come within their thickness while each particle moves straight from x to x + m. The gap
// along the normal alone does not say so, since features may pass each other far to the side; and a pair that does not
// come near must do nothing, or the result would depend on which pairs are listed. Conservative advancement: every step
// is as long as the distance allows.
//   distance  at the start, m
WEFT_FN mask comes_near(bool edges, vec3 x0, vec3 x1, vec3 x2, vec3 x3, vec3 m0, vec3 m1, vec3 m2, vec3 m3,
                        real distance, real thickness)
{
    // The largest relative motion of a particle of one side and one of the other.
    vec3 a = m0 - m2, b = m0 - m3, c = edges ? m1 - m2 : m0 - m1, d = edges ? m1 - m3 : a;
    real fastest = sqrt(max(max(dot(a, a), dot(b, b)), max(dot(c, c), dot(d, d))));
    real time = real(0);
    // Without a return in the loop, which some drivers compile wrongly.
    for (int step = 0; step < 64 && any(distance > thickness && time < real(1)); ++step) {
        mask goes_on = distance > thickness && time < real(1);
        time = select(goes_on, min(time + (distance - real(0.5) * thickness) / fastest, real(1)), time);
        real there = pair_distance(edges, x0 + m0 * time, x1 + m1 * time, x2 + m2 * time, x3 + m3 * time);
        distance = select(goes_on, there, distance);
    }
    return !(distance > thickness) || time < real(1);
}

// Gap between the two sides along a direction: the least of side one minus the most of side two. `a0` … `a3`: the
// particles' coordinates along it.
WEFT_FN real gap_vertex_triangle(real a0, real a1, real a2, real a3) { return a0 - max(a1, max(a2, a3)); }
WEFT_FN real gap_edge_edge(real a0, real a1, real a2, real a3) { return min(a0, a1) - max(a2, a3); }

// Whether the closest points of two edges are inside both. If one is an end, its vertex forms a pair with a triangle of
// the other edge at the same distance, and that pair is pushed. `w0` … `w3`: weights of the closest points.
WEFT_FN mask closest_inside_edges(real w0, real w1, real w2, real w3)
{
    return min(min(abs(w0), abs(w1)), min(abs(w2), abs(w3))) > real(1e-6);
}

// Negative where a pair has to be pushed apart.
//   gap        distance of the closest points along the normal, m
//   distance   their distance at the start of the substep, m
//   recovery   m, the most of an overlap from before the substep that one substep removes
WEFT_FN real cloth_overlap(real gap, real distance, real thickness, real recovery)
{
    return gap - thickness - min(real(0), distance - thickness + recovery);
}

// Whether a pair no longer has the gap that keeps its sides apart. `gap`, `gap_start`: of the sides along the normal.
// Rounding may take 0.3 µm, but not from small gaps: a pair that is pressed together in every substep would cross.
WEFT_FN mask loses_gap(real gap, real gap_start, real least_gap)
{
    real rounding = select(gap_start > real(0.5) * least_gap, real(3e-7), real(0));
    return gap < min(gap_start, least_gap) - rounding;
}

// Friction: the tangential displacement that a push of the length `push` takes back.
WEFT_FN vec3 cloth_friction(vec3 moved, vec3 normal, real push, real static_friction, real kinetic_friction)
{
    vec3 slip = moved - normal * dot(moved, normal);
    real length = sqrt(dot(slip, slip));
    real share = select(length > static_friction * push, kinetic_friction * push / max(length, real(1e-30)), real(1));
    return slip * min(share, real(1));
}

// Part of a pair's resistance to a push that one of its particles has, 1/kg. `share`: sum of the weights of all pushes of
// the particle, as far as its mass is split among them.
WEFT_FN real contact_resistance(real inverse_mass, real weight, real share)
{
    return inverse_mass * abs(weight) * max(abs(weight), share);
}

// Pushes, velocities and weights are summed in fixed point: integer sums do not depend on the order, so pairs may add to
// a particle in parallel. Quanta: 2^-28 m of pushes, 2^-20 m/s of velocities, 2^-10 of weights.

#define WEFT_PUSH_QUANTA_PER_METER 268435456.0
#define WEFT_SPEED_QUANTA_PER_METER 1048576.0
#define WEFT_WEIGHT_QUANTA 1024.0

// x · scale, rounded to an integer that fits into 32 bits.
WEFT_FN real to_contact_quanta(real x, real scale)
{
    real quanta = min(max(x * scale, real(-1073741824.0)), real(1073741824.0));
    // From 2^23 on, every float is an integer, and adding 0.5 would round it again.
    return select(abs(quanta) < real(8388608.0), floor(quanta + real(0.5)), quanta);
}

// Rounded up, so that a weight above 0 counts.
WEFT_FN real to_weight_quanta(real weight) { return floor(abs(weight) * real(WEFT_WEIGHT_QUANTA)) + real(1); }
