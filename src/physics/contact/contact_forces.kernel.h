// Contact forces of a frame, on particles and colliders (docs/contact-forces.md).

// Sums over the substeps and iterations of a frame. Times the particle's mass over the substep, which are constant
// during a frame, they give momentum.
struct ContactTrace {
    vec3 moved;   // m    displacement of the particle by the collider's contacts
    vec3 turned;  // m2   cross products of the particle's offset from the collider's position and the displacement
};

// `heavier`: the mass with which the particle moved, in parts of its mass.
WEFT_FN void trace_contact(inout_(ContactTrace) trace, vec3 before, vec3 x, vec3 position, real heavier)
{
    // The two floats are close together, so their difference is exact and the same as in the velocity update.
    vec3 by = (x - before) * heavier;
    trace.moved = trace.moved + by;
    trace.turned = trace.turned + cross(x - position, by);
}

// N s per meter. Negative, because the collider loses the momentum that the particle gains.
WEFT_FN real contact_momentum(real w, real inv_h)
{
    mask moves = w > real(0);
    return select(moves, -inv_h / select(moves, w, real(1)), real(0));
}

// Momentum is counted in quanta of 2^-44 N s, angular momentum in quanta of 2^-44 N m s: integer sums do not depend on
// the order. A contact is clamped to 2^18 N s, the weight of 1600 t during a sixtieth of a second; sums have 64 bits,
// which is twice that. The smallest contact that counts is half a quantum, 3e-14 N s: a millionth of the impulse of 0.2
// mg in such a frame.
#define WEFT_IMPULSE_QUANTA_PER_UNIT 17592186044416.0
#define WEFT_LARGEST_IMPULSE 262144.0

// x in quanta, rounded to an integer. NaN counts as the largest value.
WEFT_FN real to_impulse_quanta(real x)
{
    real clamped = select(x < real(WEFT_LARGEST_IMPULSE), x, real(WEFT_LARGEST_IMPULSE));
    clamped = select(clamped > real(-WEFT_LARGEST_IMPULSE), clamped, real(-WEFT_LARGEST_IMPULSE));
    real quanta = clamped * real(WEFT_IMPULSE_QUANTA_PER_UNIT);
    // Floats from 2^23 on are integers.
    return select(abs(quanta) < real(8388608.0), floor(quanta + real(0.5)), quanta);
}

WEFT_FN real from_impulse_quanta(real quanta) { return quanta * real(1.0 / WEFT_IMPULSE_QUANTA_PER_UNIT); }
