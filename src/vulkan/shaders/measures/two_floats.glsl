// Numbers as sums of two floats, the second of which is the rounding error of the first: about 48 bits (Dekker 1971,
// Knuth 1969). Strain and residual are small differences of large numbers, for which one float is not precise enough.
#ifndef WEFT_TWO_FLOATS_GLSL
#define WEFT_TWO_FLOATS_GLSL

struct Two {
    float high;
    float low;
};

float value(Two a) { return a.high + a.low; }

// Exact sum and exact product.
Two sum_of(float a, float b)
{
    float sum = a + b;
    float from_b = sum - a;
    return Two(sum, (a - (sum - from_b)) + (b - from_b));
}

Two halves_of(float a)
{
    float scaled = a * 4097.0;
    float high = scaled - (scaled - a);
    return Two(high, a - high);
}

Two product_of(float a, float b)
{
    float product = a * b;
    Two x = halves_of(a), y = halves_of(b);
    return Two(product, x.low * y.low - (((product - x.high * y.high) - x.low * y.high) - x.high * y.low));
}

Two add(Two a, Two b)
{
    Two sum = sum_of(a.high, b.high);
    return sum_of(sum.high, sum.low + (a.low + b.low));
}

Two multiply(Two a, float b)
{
    Two product = product_of(a.high, b);
    return sum_of(product.high, product.low + a.low * b);
}

Two square(Two a)
{
    Two squared = product_of(a.high, a.high);
    return sum_of(squared.high, squared.low + 2.0 * (a.high * a.low));
}

#endif
