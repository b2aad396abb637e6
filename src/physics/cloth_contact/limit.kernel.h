// What brake and limit decide about pairs and particles (law: cloth_contact.md).

// Part of its motion in a substep after which a pair has lost no more than `depth` beyond what it may lose; 1 if the
// whole motion does not.
//   gap, gap_start  between the sides along the normal, after the motion and before, m
//   depth           m, > 0
WEFT_FN real part_to_depth(real gap, real gap_start, real least_gap, real depth)
{
    real lowest = min(gap_start, least_gap) - depth;
    return select(gap < lowest, (gap_start - lowest) / max(gap_start - gap, real(1e-30)), real(1));
}

// How far each side of a pair has to move away from the other one, m. It may be negative.
struct LeastMotions {
    real one, two;
};

// A side may follow the other one, but gives way only to what nothing can move.
//   advance     the most that a particle of the other side has come closer, m
//   prescribed  the same of those that nothing can move, or 0
//   spare       how much of the gap the pair may lose, m
WEFT_FN real least_motion(real advance, real prescribed, real spare)
{
    return select(prescribed > real(0), max(prescribed - spare, real(0)), min(advance, real(0)) - real(0.5) * spare);
}

// `m0` … `m3`: motion of the particles along the normal, m; `w0` … `w3`: their inverse masses.
WEFT_FN LeastMotions least_motions_vertex_triangle(real m0, real m1, real m2, real m3, real w0, real w1, real w2,
                                                   real w3, real spare)
{
    real p0 = select(w0 > real(0), real(0), -m0), p1 = select(w1 > real(0), real(0), m1);
    real p2 = select(w2 > real(0), real(0), m2), p3 = select(w3 > real(0), real(0), m3);
    LeastMotions least;
    least.one = least_motion(max(m1, max(m2, m3)), max(p1, max(p2, p3)), spare);
    least.two = least_motion(-m0, p0, spare);
    return least;
}
WEFT_FN LeastMotions least_motions_edge_edge(real m0, real m1, real m2, real m3, real w0, real w1, real w2, real w3,
                                             real spare)
{
    real p0 = select(w0 > real(0), real(0), -m0), p1 = select(w1 > real(0), real(0), -m1);
    real p2 = select(w2 > real(0), real(0), m2), p3 = select(w3 > real(0), real(0), m3);
    LeastMotions least;
    least.one = least_motion(max(m2, m3), max(p2, p3), spare);
    least.two = least_motion(max(-m0, -m1), max(p0, p1), spare);
    return least;
}

// The motion that is left to a particle that slides along its pairs: shorter than `slide` if that leads farther than
// `most_aside` from the straight way `asked`, m.
WEFT_FN vec3 slide_near(vec3 asked, vec3 slide, real most_aside)
{
    real along = clamp01(dot(slide, asked) / max(dot(asked, asked), real(1e-30)));
    vec3 aside = slide - asked * along;
    real length = sqrt(dot(aside, aside));
    return slide * select(length > most_aside, most_aside / max(length, real(1e-30)), real(1));
}
