// Corrections of a particle added up in fixed point: whole numbers give the same sum in whatever order they come, so rows may
// add to a particle side by side. A quantum is 2^-16 m, 15 micrometers; a correction counts up to 2^13 m, so that the sum
// of four rows that want so much is still a 32-bit number.

#define WEFT_QUANTA_PER_METER 65536
#define WEFT_LARGEST_CORRECTION 8192

// The whole number next to x in quanta. What is no number counts as the largest correction: it must not go unnoticed.
WEFT_FN real to_quanta(real x)
{
    real held = select(x < real(WEFT_LARGEST_CORRECTION), x, real(WEFT_LARGEST_CORRECTION));
    held = select(held > real(-WEFT_LARGEST_CORRECTION), held, real(-WEFT_LARGEST_CORRECTION));
    return floor(held * real(WEFT_QUANTA_PER_METER) + real(0.5));
}

WEFT_FN real from_quanta(real quanta) { return quanta * real(1.0 / WEFT_QUANTA_PER_METER); }
