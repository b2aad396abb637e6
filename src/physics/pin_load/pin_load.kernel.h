// Inertia of cloth near pins (pin_load.md).

// Pins add at most this many times its mass to a particle.
#define WEFT_STEADY_MOST 256.0

// The part of its inverse mass, and of the acceleration by gravity, that a particle near a pin has in this frame.
// `steadiness` in 1/s2. `pin`: inverse mass of its pin, 0 unless it has been let go.
WEFT_FN real steady_part(real steadiness, real pin, Step step)
{
    real ratio = min(steadiness * step.h * step.h, real(WEFT_STEADY_MOST));
    return real(1) / (real(1) + select(pin > real(0), real(0), ratio));
}
