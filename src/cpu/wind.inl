// Wind on lanes. Included by passes.inl.

#define WEFT_WIND(name, Name)                                    \
    struct Name##Wind {                                          \
        WEFT_FN static Flow flow(vec3 p, const WindNumbers& n) { \
            return flow_##name(p, n);                            \
        }                                                        \
    };
#include "physics/air/winds.def"
#undef WEFT_WIND

// 0, 1, 2, … in the lanes.
WEFT_FN real lane_numbers() {
    float numbers[16];
    for (int lane = 0; lane < 16; ++lane) numbers[lane] = static_cast<float>(lane);
    return load(numbers);
}

template <class Wind>
inline void wind_pass(const AirView& air, const WindNow& wind, bool first, Range range) {
    const WindNumbers numbers = {spread(wind.vectors[0]), spread(wind.vectors[1]), spread(wind.vectors[2]),
                                 real(wind.numbers[0]),   real(wind.numbers[1]),   real(wind.numbers[2])};
    const WindBounds bounds = {spread(wind.axes.x), spread(wind.axes.y),   spread(wind.axes.z),
                               spread(wind.edge),   real(wind.per_border), real(wind.strength)};
    const vec3 source = spread(wind.position);
    const WindLife life = {real(wind.gust),           real(wind.gust_turns),     real(wind.gust_per_meter),
                           real(wind.scattered ? 1.0f : 0.0f), real(wind.turbulence), real(wind.noise_per_meter),
                           real(wind.noise_time),     spread(wind.noise_offset)};
    const real lanes = lane_numbers();
    for (std::size_t t = range.begin; t < range.end; t += lane_count) {
        real unused;
        const vec3 a = gather_blocks(air.position, air.faces + t, unused);
        const vec3 b = gather_blocks(air.position, air.faces + std::size_t{air.stride} + t, unused);
        const vec3 c = gather_blocks(air.position, air.faces + std::size_t{2} * air.stride + t, unused);
        const vec3 p = (a + b + c) * real(1.0f / 3.0f) - source;
        vec3 u = live_wind(Wind::flow(p, numbers), real(static_cast<float>(t)) + lanes, life) * wind_share(p, bounds);
        if (air.sheltered) {
            store_blocks(u, real(1.0f), air.sheltered + 4 * t);
            continue;
        }
        if (!first) u = u + load_blocks(air.wind + 4 * t, unused);
        store_blocks(u, real(0.0f), air.wind + 4 * t);
    }
}

// Clears the last float of triangles in the shelter of the collider.
inline void shelter_pass(const AirView& air, const ContactView& collider, float reach, Range range) {
    const Solid solid = solid_of(collider);
    const ContactBody body = make_body(collider);
    for (std::size_t t = range.begin; t < range.end; t += lane_count) {
        real open, unused;
        const vec3 u = load_blocks(air.sheltered + 4 * t, open);
        const real speed2 = dot(u, u);
        const mask blown = open > real(0.0f) && speed2 > real(1e-20f);
        if (!any(blown)) continue;
        const vec3 a = gather_blocks(air.position, air.faces + t, unused);
        const vec3 b = gather_blocks(air.position, air.faces + std::size_t{air.stride} + t, unused);
        const vec3 c = gather_blocks(air.position, air.faces + std::size_t{2} * air.stride + t, unused);
        const vec3 ray = u * (real(-1.0f) / sqrt(max(speed2, real(1e-20f))));
        const mask hit = is_sheltered(solid, to_body(body, (a + b + c) * real(1.0f / 3.0f)),
                                      unrotate(body.rx, body.ry, body.rz, ray), select(blown, real(reach), real(0.0f)));
        store_blocks(u, select(hit, real(0.0f), open), air.sheltered + 4 * t);
    }
}

inline void add_sheltered_pass(const AirView& air, bool first, Range range) {
    for (std::size_t t = range.begin; t < range.end; t += lane_count) {
        real open, unused;
        vec3 u = load_blocks(air.sheltered + 4 * t, open);
        u = select(open > real(0.0f), u, vec3(real(0.0f)));
        if (!first) u = u + load_blocks(air.wind + 4 * t, unused);
        store_blocks(u, real(0.0f), air.wind + 4 * t);
    }
}
