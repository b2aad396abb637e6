// Gusts and turbulence of a wind (law: air.md). The mean flow is defined by each kind of wind (winds.def).

// Up to three vectors and three numbers; the kernel file of each kind documents their meaning.
struct WindNumbers {
    vec3 n0, n1, n2;
    real s0, s1, s2;
};

// Where a source has wind, and how much.
struct WindBounds {
    vec3 x, y, z;      // axes of the source
    vec3 edge;         // m     half extents of its box, with the border
    real per_border;   // 1/m   inverse width of the border
    real strength;     // of the velocity
};

// The wind at a point relative to the source's position, without gusts and turbulence.
struct Flow {
    vec3 velocity;   // m/s
    real q1, q2;     // m    two coordinates perpendicular to it
};

struct WindLife {
    real gust;             // amplitude, of the velocity
    real gust_turns;       // frequency times time, modulo 16
    real gust_per_meter;   // 1/m   inverse distance over which the phase of gusts varies
    real scattered;        // 1: every triangle has its own phase and frequency; 0: phases vary smoothly
    real turbulence;       // strength, of the velocity
    real noise_per_meter;  // 1/m   inverse size of an eddy
    real noise_time;       // time over period, modulo 289
    vec3 noise_offset;     // from the seed, whole numbers
};

// 1 in the box and 0 outside of its border, smooth between, along one axis.
WEFT_FN real share_along(real q, real edge, real per_border)
{
    real t = min(max((edge - abs(q)) * per_border, real(0)), real(1));
    return t * t * (real(3) - t * real(2));
}

// The factor of the wind at a point relative to the source's position.
WEFT_FN real wind_share(vec3 p, WindBounds b)
{
    real share = share_along(dot(p, b.x), b.edge.x, b.per_border);
    share = share * share_along(dot(p, b.y), b.edge.y, b.per_border);
    return b.strength * (share * share_along(dot(p, b.z), b.edge.z, b.per_border));
}

// The sine of a gust's phase.
WEFT_FN real gust_at(Flow flow, real number, WindLife life)
{
    vec3 at = vec3(flow.q1 * life.gust_per_meter, flow.q2 * life.gust_per_meter, real(0.5));
    real smooth_phase = perlin(at + vec3(life.noise_offset.z, life.noise_offset.x, life.noise_offset.y));

    // Frequencies are 8 … 23 sixteenths of the given one, so that 16 turns of it are a whole number of turns of each.
    real first = permute_289(mod_289(number - floor(number * real(1.0 / 65536.0)) * real(65536) + life.noise_offset.x));
    real second = permute_289(mod_289(first + life.noise_offset.y));
    real rate = real(0.5) + real(0.0625) * (first - floor((first + real(0.5)) * real(0.0625)) * real(16));
    mask own = life.scattered > real(0.5);
    return sin_turns(
        select(own, life.gust_turns * rate + second * real(1.0 / 289.0), life.gust_turns + smooth_phase));
}

// `number` identifies the triangle: an integer from 0, below 2^24.
WEFT_FN vec3 live_wind(Flow flow, real number, WindLife life)
{
    // Noise is most of the work. Many winds have none.
    real gust = real(0), noise = real(0);
    if (any(life.gust > real(0))) gust = gust_at(flow, number, life);
    if (any(life.turbulence > real(0))) {
        vec3 eddy = vec3(flow.q1 * life.noise_per_meter, flow.q2 * life.noise_per_meter, life.noise_time);
        noise = perlin(eddy + life.noise_offset);
    }
    return flow.velocity * (real(1) + life.gust * gust + life.turbulence * noise);
}
