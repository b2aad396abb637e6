// The exponential function without the C library, whose last bits differ between machines.

// exp(-x) for x >= 0, with a relative error below 3e-7; 0 from x = 80 on. Powers of two are multiplied together by the
// bits of the exponent, which is exact. The rest, at most half a power of two, is a Taylor polynomial.
WEFT_FN real exp_of_minus(real x)
{
    real below = min(x, real(80));
    real k = floor(below * real(1.4426950408889634) + real(0.5));
    // ln 2 in two parts: k times the first is exact.
    real z = (below - k * real(0.693359375)) + k * real(2.1219444005469057e-4);
    real p = real(1) - z * real(1.0 / 7.0);
    p = real(1) - z * real(1.0 / 6.0) * p;
    p = real(1) - z * real(1.0 / 5.0) * p;
    p = real(1) - z * real(1.0 / 4.0) * p;
    p = real(1) - z * real(1.0 / 3.0) * p;
    p = real(1) - z * real(1.0 / 2.0) * p;
    p = real(1) - z * p;
    mask has = k > real(63.5);
    p = select(has, p * real(5.421010862427522e-20), p);
    k = select(has, k - real(64), k);
    has = k > real(31.5);
    p = select(has, p * real(2.3283064365386963e-10), p);
    k = select(has, k - real(32), k);
    has = k > real(15.5);
    p = select(has, p * real(1.52587890625e-5), p);
    k = select(has, k - real(16), k);
    has = k > real(7.5);
    p = select(has, p * real(0.00390625), p);
    k = select(has, k - real(8), k);
    has = k > real(3.5);
    p = select(has, p * real(0.0625), p);
    k = select(has, k - real(4), k);
    has = k > real(1.5);
    p = select(has, p * real(0.25), p);
    k = select(has, k - real(2), k);
    p = select(k > real(0.5), p * real(0.5), p);
    return select(x < real(80), p, real(0));
}
