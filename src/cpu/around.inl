// Sums over the triangles at each particle, one particle per lane. Included by passes.inl.

// Whether the packet of particle i has lists for SIMD and there is more than one lane.
WEFT_FN bool abreast(const AroundView& around, std::size_t i) {
    const std::size_t packet = i / lane_padding;
    return lane_count > 1 && around.begin[packet] < around.begin[packet + 1];
}

// Shorter lists are padded with zeros. Adding zeros changes no bit, because a sum that starts at +0 is never -0.
WEFT_FN vec3 sum_around(const AroundView& around, const float* blocks, std::size_t i) {
    const std::size_t packet = i / lane_padding;
    vec3 sum(real(0.0f));
    for (std::size_t k = around.begin[packet]; k < around.begin[packet + 1]; ++k) {
        real unused;
        sum = sum + gather_blocks(blocks, around.triangles + k * lane_padding + i % lane_padding, unused);
    }
    return sum;
}

inline void normals_around_pass(const SurfaceView& s, Range range) {
    for (std::uint32_t i = range.begin; i < range.end; i += lane_count) {
        if (abreast(s.around, i)) {
            const vec3 sum = sum_around(s.around, s.face_normals, i);
            store_blocks(unit_normal(sum), real(0.0f), s.normals + std::size_t{4} * i);
        } else {
            normals_pass(s, {i, std::min<std::uint32_t>(i + lane_count, range.end)});
        }
    }
}

inline void push_around_pass(const ParticleView& p, const AirView& air, Range range) {
    for (std::uint32_t i = range.begin; i < range.end; i += lane_count) {
        if (lane_count > 4 && abreast(air.around, i)) {  // with 4 lanes push_pass is faster
            const std::size_t at = std::size_t{4} * i;
            real w;
            load_blocks(p.position + at, w);
            Motion m;
            const vec3 start = load_blocks(p.start + at, m.v_dropped.x);
            m.v = load_blocks(p.velocity + at, m.v_dropped.y);
            m.x_dropped = load_blocks(p.compensation + at, m.v_dropped.z);
            push_by_air(m, sum_around(air.around, air.impulse, i), w);
            store_blocks(start, m.v_dropped.x, p.start + at);
            store_blocks(m.v, m.v_dropped.y, p.velocity + at);
            store_blocks(m.x_dropped, m.v_dropped.z, p.compensation + at);
        } else {
            push_pass(p, air, {i, std::min<std::uint32_t>(i + lane_count, range.end)});
        }
    }
}
