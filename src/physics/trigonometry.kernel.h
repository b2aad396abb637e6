// Angles and sines without the C library, whose last bits differ between machines.

// The angle of (x, y), in (-pi, pi]; 0 if both are 0. The error is below 3.1e-7 rad, mostly in the last bits near pi.
// On [0, 1] the polynomial is the minimax one of its degree, 5e-8 from the arc tangent. `from` does not depend on the
// division, so the processor computes it during the division.
WEFT_FN real angle_of(real y, real x)
{
    real ax = abs(x);
    mask steep = abs(y) > ax;   // beyond pi/4: measure from the other axis
    real t = select(steep, -x, y) / select(steep, y, x);
    t = select(steep || ax > real(0), t, real(0));
    real from = select(x < real(0), real(3.141592653589793), real(0));
    from = select(steep, real(1.570796326794897), from);
    from = select(y < real(0), -from, from);
    real z = t * t;
    real z2 = z * z;
    real low = real(0.19962704040510776) - real(0.13976582478806948) * z;
    real middle = real(0.09794235568555591) - real(0.057773604476333354) * z;
    real high = real(0.02304014660182595) - real(0.004355408839491385) * z;
    real p = (low + z2 * (middle + z2 * high)) * z - real(0.33331659036782163);
    return from + (t + t * (z * p));
}

// sin(2 pi x). The error is below 2e-7 for |x| < 1; for larger |x| the rounding error of x dominates. The Taylor
// polynomial up to the eleventh power, on a quarter of a turn.
WEFT_FN real sin_turns(real x)
{
    real t = x - floor(x + real(0.5));
    t = select(t > real(0.25), real(0.5) - t, t);
    t = select(t < real(-0.25), real(-0.5) - t, t);
    real z = t * t;
    real p = real(42.05869394489765) - z * real(15.09464257682298);
    p = real(76.70585975306136) - z * p;
    p = real(81.60524927607504) - z * p;
    p = real(41.34170224039975) - z * p;
    return t * (real(6.283185307179586) - z * p);
}
