// Gradient noise (Perlin 2002, "Improving Noise") from arithmetic alone, without tables or integers: a corner of the
// lattice gets its number from the permutation x -> (34 x + 1) x mod 289 (McEwan, Sheets, Gustavson, Richardson 2012,
// "Efficient computational noise in GLSL"). Every number here stays below 2^24, so each step is exact in single
// precision, and all lanes, compilers and GPUs agree on every corner.

// x mod 289 for integers x >= 0 below 2^22. Adds 0.5 so that an inexact product cannot change the floor.
WEFT_FN real mod_289(real x) { return x - floor((x + real(0.5)) * real(1.0 / 289.0)) * real(289); }

WEFT_FN real permute_289(real x) { return mod_289((x * real(34) + real(1)) * x); }

WEFT_FN real fade(real t) { return t * t * t * (t * (t * real(6) - real(15)) + real(10)); }

WEFT_FN real mix_linear(real a, real b, real t) { return a + (b - a) * t; }

// The corner's gradient times the offset `d` from the corner. The gradient is one of the twelve from the center of a
// cube to its edges; four of them occur twice.
WEFT_FN real corner_gradient(real hash, vec3 d)
{
    real g = hash - floor((hash + real(0.5)) * real(0.0625)) * real(16);   // 0 … 15
    real half_g = floor(g * real(0.5));
    mask odd = g - half_g * real(2) > real(0.5);
    mask second = half_g - floor(half_g * real(0.5)) * real(2) > real(0.5);
    mask even_of_last_four = g > real(11.5) && !odd;
    real u = select(g < real(7.5), d.x, d.y);
    real v = select(g < real(3.5), d.y, select(even_of_last_four, d.x, d.z));
    return select(odd, -u, u) + select(second, -v, v);
}

// Smooth, in -1 … 1, mean 0; period 289 along each axis. Inputs of magnitude above 2^22 give an arbitrary value in that
// range.
WEFT_FN real perlin(vec3 p)
{
    vec3 cell = vec3(floor(p.x), floor(p.y), floor(p.z));
    vec3 f = p - cell;
    real x0 = cell.x - floor((cell.x + real(0.5)) * real(1.0 / 289.0)) * real(289);
    real y0 = cell.y - floor((cell.y + real(0.5)) * real(1.0 / 289.0)) * real(289);
    real z0 = cell.z - floor((cell.z + real(0.5)) * real(1.0 / 289.0)) * real(289);
    // Far from the origin floats are coarser than the lattice, so clamp.
    x0 = min(max(x0, real(0)), real(288));
    y0 = min(max(y0, real(0)), real(288));
    z0 = min(max(z0, real(0)), real(288));
    real x1 = select(x0 > real(287.5), real(0), x0 + real(1));
    real y1 = select(y0 > real(287.5), real(0), y0 + real(1));
    real z1 = select(z0 > real(287.5), real(0), z0 + real(1));

    real px0 = permute_289(x0), px1 = permute_289(x1);
    real p00 = permute_289(mod_289(px0 + y0)), p01 = permute_289(mod_289(px0 + y1));
    real p10 = permute_289(mod_289(px1 + y0)), p11 = permute_289(mod_289(px1 + y1));

    real one = real(1);
    real n000 = corner_gradient(permute_289(mod_289(p00 + z0)), f);
    real n001 = corner_gradient(permute_289(mod_289(p00 + z1)), vec3(f.x, f.y, f.z - one));
    real n010 = corner_gradient(permute_289(mod_289(p01 + z0)), vec3(f.x, f.y - one, f.z));
    real n011 = corner_gradient(permute_289(mod_289(p01 + z1)), vec3(f.x, f.y - one, f.z - one));
    real n100 = corner_gradient(permute_289(mod_289(p10 + z0)), vec3(f.x - one, f.y, f.z));
    real n101 = corner_gradient(permute_289(mod_289(p10 + z1)), vec3(f.x - one, f.y, f.z - one));
    real n110 = corner_gradient(permute_289(mod_289(p11 + z0)), vec3(f.x - one, f.y - one, f.z));
    real n111 = corner_gradient(permute_289(mod_289(p11 + z1)), vec3(f.x - one, f.y - one, f.z - one));

    real u = fade(f.x), v = fade(f.y), w = fade(f.z);
    real n00 = mix_linear(n000, n001, w), n01 = mix_linear(n010, n011, w);
    real n10 = mix_linear(n100, n101, w), n11 = mix_linear(n110, n111, w);
    return mix_linear(mix_linear(n00, n01, v), mix_linear(n10, n11, v), u);
}
