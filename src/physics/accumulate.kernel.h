// Sums the corrections of a particle in fixed point. Integer sums do not depend on the order, so constraints may add to
// a particle in parallel. A quantum is 2^-16 m, 15 micrometers. A correction is clamped to 2^13 m, so that the sum of
// four such corrections still fits in 32 bits.

#define WEFT_QUANTA_PER_METER 65536
#define WEFT_LARGEST_CORRECTION 8192

// x in quanta, rounded to an integer. NaN counts as the largest correction, so that it is detected.
WEFT_FN real to_quanta(real x)
{
    real clamped = select(x < real(WEFT_LARGEST_CORRECTION), x, real(WEFT_LARGEST_CORRECTION));
    clamped = select(clamped > real(-WEFT_LARGEST_CORRECTION), clamped, real(-WEFT_LARGEST_CORRECTION));
    return floor(clamped * real(WEFT_QUANTA_PER_METER) + real(0.5));
}

WEFT_FN real from_quanta(real quanta) { return quanta * real(1.0 / WEFT_QUANTA_PER_METER); }
