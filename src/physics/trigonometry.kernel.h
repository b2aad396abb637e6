// Angles without the C library, whose last bits differ by machine.

// The angle of (x, y), in (-pi, pi]; 0 where both are 0. Error below 4e-7 rad.
// Polynomial of Cephes' atanf (S. Moshier, public domain), on [0, tan(pi/8)].
WEFT_FN real angle_of(real y, real x)
{
    real ax = abs(x);
    real ay = abs(y);
    real low = min(ax, ay);
    real high = max(ax, ay);
    mask upper = low > high * real(0.41421356);   // beyond pi/8: measure from pi/4 instead
    real num = select(upper, low - high, low);
    real den = select(upper, low + high, high);
    real t = select(high > real(0), num / den, real(0));
    real z = t * t;
    real p = real(8.05374449538e-2) * z - real(1.38776856032e-1);
    p = p * z + real(1.99777106478e-1);
    p = p * z - real(3.33329491539e-1);
    real angle = p * z * t + t;
    angle = select(upper, angle + real(0.785398163397448), angle);
    angle = select(ay > ax, real(1.570796326794897) - angle, angle);
    angle = select(x < real(0), real(3.141592653589793) - angle, angle);
    return select(y < real(0), -angle, angle);
}

// sin(2 pi x). Error below 2e-7 for |x| < 1; beyond, that of x itself counts.
// The Taylor polynomial up to the eleventh power, on a quarter of a turn.
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
