// What contacts do to a particle and to a collider in a frame (docs/feedback.md has the meaning).

// Sums over the substeps and iterations of a frame. They become momentum by the particle's mass over the substep, which
// stay what they are meanwhile.
struct ContactTrace {
    vec3 moved;   // m    by how much the collider's contacts moved the particle
    vec3 turned;  // m2   the same, each time crossed with the way from the collider's position to the particle
};

WEFT_FN void trace_contact(inout_(ContactTrace) trace, vec3 before, vec3 x, vec3 position)
{
    // Neighboring floats: their difference is exact, and it is the whole of what the velocity will see.
    vec3 by = x - before;
    trace.moved = trace.moved + by;
    trace.turned = trace.turned + cross(x - position, by);
}

// N s per meter. What the particle gets, the collider loses.
WEFT_FN real contact_momentum(real w, real inv_h)
{
    mask moves = w > real(0);
    return select(moves, -inv_h / select(moves, w, real(1)), real(0));
}

// Momentum is counted in quanta of 2^-44 N s, angular momentum in as many N m s: whole numbers give the same sum in
// whatever order they come. A contact counts up to 2^18 N s, the pull of 1600 t for a sixtieth of a second; sums have
// 64 bits, which is twice that. The finest contact that is noticed is half a quantum, 3e-14 N s: a millionth of what
// 0.2 mg press with in such a frame.
#define WEFT_IMPULSE_QUANTA_PER_UNIT 17592186044416.0
#define WEFT_LARGEST_IMPULSE 262144.0

// The whole number next to x in quanta. What is no number counts as the largest.
WEFT_FN real to_impulse_quanta(real x)
{
    real held = select(x < real(WEFT_LARGEST_IMPULSE), x, real(WEFT_LARGEST_IMPULSE));
    held = select(held > real(-WEFT_LARGEST_IMPULSE), held, real(-WEFT_LARGEST_IMPULSE));
    real quanta = held * real(WEFT_IMPULSE_QUANTA_PER_UNIT);
    // From 2^23 on a float is a whole number.
    return select(abs(quanta) < real(8388608.0), floor(quanta + real(0.5)), quanta);
}

WEFT_FN real from_impulse_quanta(real quanta) { return quanta * real(1.0 / WEFT_IMPULSE_QUANTA_PER_UNIT); }
