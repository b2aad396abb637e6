// Cheap tests for what may touch a moving collider, by the ball that holds it. What they leave out contact would leave as
// it is, to the bit. Included by passes.inl.

// Bounds for a point, rounded outward.
struct BallBounds {
    real distance;  // m, at most that to the shape at the end of the substep
    real way;       // m, at least that of the point relative to the shape
};

//   x, way    of the point: its place at the end of the substep, and how far it has moved, m
//   spread    m: around x and `way`, of all points that the bounds hold for
WEFT_FN BallBounds bounds_near(const MovingBall& ball, vec3 x, vec3 way, real spread_of_places, real spread_of_ways) {
    const vec3 from = x - spread(ball.center), before = from - (way - spread(ball.way)), by = way - spread(ball.way);
    const real distance = sqrt(dot(from, from)), distance_before = sqrt(dot(before, before));
    const real rounding = real(4e-6f) * (distance + distance_before + spread_of_places + spread_of_ways);
    BallBounds bounds;
    bounds.distance = distance - real(ball.radius) - rounding;
    bounds.way = sqrt(dot(by, by)) + spread_of_ways +
                 real(ball.turn) * (distance_before + spread_of_places + spread_of_ways) + rounding;
    bounds.way = bounds.way * real(1.00001f);
    return bounds;
}

// See may_touch() and faces_may_touch().
WEFT_FN mask particles_may_touch(const MovingBall& ball, const NearBalls& near, const Solid& steep, vec3 x, vec3 way) {
    const BallBounds bounds = bounds_near(ball, x, way, real(0.0f), real(0.0f));
    const real distance = bounds.distance - real(near.inside);
    const mask particles =
        distance < max(real(near.half_thickness), real(2.0f) * steep.steepness * bounds.way);
    if (!near.faces) return particles;
    return particles || faces_may_touch(steep, bounds.distance, bounds.way, real(near.nearest), real(ball.widest));
}

inline std::uint32_t first_near_pass(const ParticleView& p, const NearBalls& near, Range range, std::uint32_t first) {
    std::uint32_t found = near.count;
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real unused;
        const vec3 x = load_blocks_unordered(p.position + 4 * i, unused);
        const vec3 way = x - load_blocks_unordered(p.start + 4 * i, unused);
        for (std::uint32_t k = first; k < found; ++k) {
            if (near.numbers[k] == none) continue;
            const MovingBall& ball = near.balls[near.numbers[k]];
            Solid steep{};
            steep.steepness = real(ball.steepness);
            if ((near.always && near.always[k]) || any(particles_may_touch(ball, near, steep, x, way))) found = k;
        }
    }
    return found;
}

// Lanes may go beyond the end, where the triangles are others of the cloth, or have no edges.
inline float longest_edge_pass(const ParticleView& p, const FaceView& faces, std::uint32_t begin, std::uint32_t end) {
    real longest = real(0.0f);
    for (std::uint32_t f = begin; f < end; f += lane_count) {
        alignas(64) std::uint32_t corners[3][16];
        for (std::size_t k = 0; k < 3; ++k)
            std::copy_n(faces.corners + k * faces.stride + f, lane_count, corners[k]);
        longest = max(longest, longest_edge(load_corners(p.position, corners)));
        longest = max(longest, longest_edge(load_corners(p.start, corners)));
    }
    alignas(64) float lanes[16];
    store(longest, lanes);
    return *std::max_element(lanes, lanes + lane_count);
}

inline void measure_faces_pass(const ParticleView& p, const FaceView& faces, const FaceMeasures& to) {
    for (std::size_t i = 0; i < faces.count; i += lane_count) {
        alignas(64) std::uint32_t corners[3][16];
        load_corner_numbers(faces, faces.items + i, corners);
        const Corners x = load_corners(p.position, corners), start = load_corners(p.start, corners);
        const vec3 middle = point_of(x, center_weights()), way = middle - point_of(start, center_weights());
        const real numbers[numbers_per_face] = {middle.x,
                                                middle.y,
                                                middle.z,
                                                radius_around(x, middle),
                                                way.x,
                                                way.y,
                                                way.z,
                                                longest_of(x.a - start.a - way, x.b - start.b - way, x.c - start.c - way)};
        for (std::size_t k = 0; k < numbers_per_face; ++k) store(numbers[k], to.numbers + k * to.stride + i);
    }
}

// See face_may_touch().
inline std::uint32_t near_faces_pass(const FaceView& faces, const FaceMeasures& measures, const MovingBall& ball,
                                     float nearest_of_all, std::uint32_t* to) {
    const real nearest = real(nearest_of_all), steepness = real(ball.steepness);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < faces.count; i += lane_count) {
        const auto number = [&](std::size_t k) { return load(measures.numbers + k * measures.stride + i); };
        const real radius = number(3);
        const BallBounds bounds = bounds_near(ball, vec3(number(0), number(1), number(2)),
                                              vec3(number(4), number(5), number(6)), radius, number(7));
        const std::size_t left = faces.count - i;
        const mask mine = mask_of(left < 16 ? (1u << left) - 1u : 0xffffu);
        const mask may = mine && bounds.distance < nearest + (radius + bounds.way) * steepness &&
                         bounds.distance - radius < max(nearest, real(2.0f) * bounds.way * steepness);
        if (!any(may)) continue;
        compress(faces.items + i, may, to + count);
        count += static_cast<std::uint32_t>(__builtin_popcount(bits_of(may)));
    }
    return count;
}
