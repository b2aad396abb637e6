// Term of a particle, an edge or a constraint. Its size is a float ≥ 0, stored as bits: they have the same order as
// such floats, and non-finite numbers are the largest.
#ifndef WEFT_TERMS_GLSL
#define WEFT_TERMS_GLSL

#include "vulkan/shaders/measures/two_floats.glsl"

struct Term {
    float value;
    uint size;
};

#define WEFT_NAN 0x7fc00000u

// Tests the bits, because a driver may assume that no number is a NaN.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

float square_of(vec3 v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

#ifdef WEFT_MEASURES_PARTICLES
// Kinetic energy, J; the square of the speed, m²/s².
Term term_of(uint p)
{
    vec4 x = args.position.at[p];
    vec3 v = args.velocity.at[p].xyz;
    if (!is_finite(x.xyz) || !is_finite(v)) return Term(0.0, WEFT_NAN);
    float speed2 = square_of(v);
    return Term(x.w > 0.0 ? 0.5 * args.masses.at[p] * speed2 : 0.0, floatBitsToUint(speed2));
}
#endif

Term deviation(float x)
{
    return Term(abs(x), floatBitsToUint(x) & 0x7fffffffu);
}

#ifdef WEFT_MEASURES_EDGES
// ℓ/ℓ₀ - 1 as (ℓ² - ℓ₀²) / (ℓ₀ (ℓ + ℓ₀)). Only the difference of the squares needs more than a float.
Term term_of(uint e)
{
    vec3 p = args.position.at[args.edges.at[4u * e]].xyz, q = args.position.at[args.edges.at[4u * e + 1u]].xyz;
    float rest2 = uintBitsToFloat(args.edges.at[4u * e + 2u]), rest2_low = uintBitsToFloat(args.edges.at[4u * e + 3u]);
    Two now2 = add(add(square(sum_of(p.x, -q.x)), square(sum_of(p.y, -q.y))), square(sum_of(p.z, -q.z)));
    float rest = sqrt(rest2), now = sqrt(max(now2.high, 0.0));
    return deviation(value(add(now2, Two(-rest2, -rest2_low))) / (rest * (now + rest)));
}
#endif

#ifdef WEFT_MEASURES_ROWS
// Residual of a stretch constraint (solver/measures/residual.cpp): |C + α̃λ| over the rest length. C uses the length
// rounded to a float, as in the solver.
Term term_of(uint row)
{
    uint p = args.particles.at[row], q = args.particles.at[args.stride + row];
    if (p >= args.first_dummy || p == q) return Term(0.0, 0u);  // padding
    float length2 = square_of(args.position.at[p].xyz - args.position.at[q].xyz);
    float now = sqrt(length2);
    // Devices round square roots differently. One Newton step gives the nearest float.
    Two squared = product_of(now, now);
    if (now > 0.0) now = now + ((length2 - squared.high) - squared.low) / (2.0 * now);
    float rest = args.fields.at[row];
    Two left = sum_of(now, -rest);
    float compliance = args.fields.at[(left.high > 0.0 ? 1u : 2u) * args.stride + row];
    if (compliance < 0.0) return Term(0.0, 0u);  // no stiffness on this side
    Two inv_h2 = Two(args.inv_h2, args.inv_h2_low);
    float play = args.fields.at[3u * args.stride + row];
    Two grown = add(left, Two(-0.5 * play, 0.0)), most = grown.high > play ? Two(play, 0.0) : grown;
    if (value(grown) > 0.0) {  // stretch_spring()
        float divisor = play + value(most) * (WEFT_STRAIGHT_STIFFNESS - 1.0);
        Two beyond = multiply(add(grown, multiply(most, -0.5)), value(most) * (WEFT_STRAIGHT_STIFFNESS - 1.0));
        Two force = add(multiply(left, play), beyond);
        left = Two(force.high / divisor, force.low / divisor);
        inv_h2 = multiply(inv_h2, play / divisor);
    }
    if (args.inv_h2 > 0.0) {
        float lambda = args.lambda.at[row];
        if (!is_finite(lambda)) return Term(0.0, WEFT_NAN);
        left = add(left, multiply(multiply(inv_h2, compliance), lambda));
    }
    return deviation(value(left) / rest);
}
#endif

#endif
