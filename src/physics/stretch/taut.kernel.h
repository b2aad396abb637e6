// Mass of taut cloth (taut.md).

// Edges add at most this many times its mass to a particle.
#define WEFT_TAUT_MOST 256.0

// With 1, waves of two edges' length would change sign in every substep and not decay.
#define WEFT_TAUT_MASS 1.5

// What the edges of a particle add to it.
struct TautSum {
    vec3 moved;  // kg m, masses times how far the middles of the edges move
    real mass;   // kg
};

// kg: the mass that an edge adds to each of its ends, in proportion to T h²/rest. Lambda of the substep before is -T h².
WEFT_FN real taut_mass(StretchRow row, real lambda)
{
    mask taut = lambda < real(0) && row.rest > real(0);
    return select(taut, lambda * real(-WEFT_TAUT_MASS) / max(row.rest, real(1e-30)), real(0));
}

// Adds an edge to the sum of one of its ends. The mass moves with the middle of the edge, by the velocities of its ends
// before the substep: neither gravity nor air moves it.
WEFT_FN TautSum add_taut_edge(TautSum sum, real mass, vec3 a_moves, vec3 b_moves)
{
    sum.moved = sum.moved + (a_moves + b_moves) * (mass * real(0.5));
    sum.mass = sum.mass + mass;
    return sum;
}

// Adds its edges' mass to a particle.
WEFT_FN void take_taut_mass(inout_(vec3) x, inout_(real) w, vec3 start, TautSum sum)
{
    real ratio = min(w * sum.mass, real(WEFT_TAUT_MOST));
    mask taut = ratio > real(0);
    real part = real(1) / (real(1) + ratio);
    vec3 beside = sum.moved * (real(1) / select(taut, sum.mass, real(1)));
    x = select(taut, start + (x - start + beside * ratio) * part, x);
    w = select(taut, w * part, w);
}

// How many times its mass a particle weighs that has the inverse mass w in place of `free`.
WEFT_FN real mass_ratio(real w, real free)
{
    mask moves = w > real(0);
    return select(moves, free / select(moves, w, real(1)), real(1));
}
