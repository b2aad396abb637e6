// The loops over pairs of features, for the lanes of the including namespace. Include collide/pair_search.inl before.

template <PairKind kind>
WEFT_FN real gap_of(const real* along) {
    if constexpr (kind == PairKind::vertex_triangle) return gap_vertex_triangle(along[0], along[1], along[2], along[3]);
    else return gap_edge_edge(along[0], along[1], along[2], along[3]);
}

// Most listed pairs are too far apart to meet in this substep, which their distance at the time of listing says.
inline void choose_pairs(const PairList& list, std::uint32_t begin, std::uint32_t count, const ChosenBlock& block,
                         Candidates& chosen) {
    const real most(block.approach + block.reach), most_before(block.approach + block.before);
    const real never(never_near), before(block.before);
    const auto number = static_cast<std::uint32_t>(chosen.tiles.size() - 1);
    for (std::uint32_t i = begin; i < begin + count; i += lane_count) {
        const real spare = load(&list.spare[i]);
        const std::uint32_t bits = bits_of(!(spare > most)) & lanes_before(i, begin + count);
        const mask near = mask_of(bits);
        const std::uint32_t to = chosen.count;
        for (int k = 0; k < 4; ++k) compress(&list.particle[k][i], near, &chosen.particle[k][to]);
        compress(load(&list.thickness[i]), near, &chosen.thickness[to]);
        compress(select(spare > most_before, never, before), near, &chosen.before[to]);
        store(real(block.reach), &chosen.reach[to]);
        fill(number, &chosen.block[to]);
        chosen.count += static_cast<std::uint32_t>(std::popcount(bits));
    }
}

template <PairKind kind>
WEFT_FN vec3 normal_of_points(const ClosestPoints& points, const vec3* x) {
    if constexpr (kind == PairKind::vertex_triangle) return normal_vertex_triangle(points, x[1], x[2], x[3]);
    else return normal_edge_edge(points, x[0], x[1], x[2], x[3]);
}

template <PairKind kind>
inline void find_near_pairs(const Candidates& list, const NearInput& input, NearPairs& near) {
    near.reserve(near.count + list.count);
    for (std::uint32_t i = 0; i < list.count; i += lane_count) {
        vec3 x[4];
        real w, along_start[4], along[4], low[4], high[4];
        for (int k = 0; k < 4; ++k) x[k] = gather_blocks(input.start, &list.particle[k][i], w);
        ClosestPoints points = closest<kind>(x);
        if (input.square) points.normal = normal_of_points<kind>(points, x);
        const real weight[4] = {points.w0, points.w1, points.w2, points.w3};
        const real thickness = load(&list.thickness[i]);
        real reached(0.0f);
        for (int k = 0; k < 4; ++k) {
            // Relative to the first particle, so that rounding does not grow with the distance from the origin.
            along_start[k] = dot(x[k] - x[0], points.normal);
            along[k] = dot(gather_blocks(input.reached, &list.particle[k][i], w) - x[0], points.normal);
            reached = reached + weight[k] * along[k];
            low[k] = min(along_start[k], along[k]), high[k] = max(along_start[k], along[k]);
        }
        const real gap = gap_of<kind>(along_start);
        // The least gap that any positions between start and end can have.
        const real worst = kind == PairKind::vertex_triangle ? low[0] - max(high[1], max(high[2], high[3]))
                                                             : min(low[0], low[1]) - max(high[2], high[3]);
        // Particles are within `reach` of where the constraints left them, or on the way there.
        const auto is_near = [&](real reach) {
            return reached < thickness + reach || worst < thickness * real(input.floor) + reach;
        };
        const mask is_new = is_near(load(&list.reach[i])) && !is_near(load(&list.before[i]));
        const std::uint32_t bits = bits_of(is_new) & lanes_before(i, list.count);
        if (bits == 0) continue;
        alignas(64) float lanes[9][16];
        for (int k = 0; k < 4; ++k) store(weight[k], lanes[k]);
        store(points.normal.x, lanes[4]), store(points.normal.y, lanes[5]), store(points.normal.z, lanes[6]);
        store(gap, lanes[7]), store(points.distance, lanes[8]);
        for_each_bit(bits, [&](std::uint32_t lane) {
            const std::uint32_t at = near.count++;
            for (int k = 0; k < 4; ++k) near.particle[k][at] = list.particle[k][i + lane], near.weight[k][at] = lanes[k][lane];
            for (int k = 0; k < 3; ++k) near.normal[k][at] = lanes[4 + k][lane];
            near.thickness[at] = list.thickness[i + lane];
            near.gap[at] = lanes[7][lane], near.distance[at] = lanes[8][lane];
            const auto& tiles = list.tiles[list.block[i + lane]];
            near.tile[0][at] = tiles[0], near.tile[1][at] = tiles[1];
            near.pushed[at] = 0;
        });
    }
}

// The particles' coordinates along the normal of their pair, relative to the first of them.
WEFT_FN void load_along(const NearPairs& near, std::uint32_t i, const float* positions, real* along) {
    const vec3 normal(load(&near.normal[0][i]), load(&near.normal[1][i]), load(&near.normal[2][i]));
    real w;
    const vec3 first = gather_blocks(positions, &near.particle[0][i], w);
    along[0] = real(0.0f);
    for (int k = 1; k < 4; ++k)
        along[k] = dot(gather_blocks(positions, &near.particle[k][i], w) - first, normal);
}

template <PairKind kind>
WEFT_FN mask pairs_come_near(const SweepView& view, const Overlaps& overlaps, std::uint32_t i) {
    vec3 x[4], moved[4];
    real w;
    for (int k = 0; k < 4; ++k) {
        x[k] = gather_blocks(view.start, &overlaps.particle[k][i], w);
        moved[k] = gather_blocks(view.positions, &overlaps.particle[k][i], w) - x[k];
    }
    return comes_near(kind == PairKind::edge_edge, x[0], x[1], x[2], x[3], moved[0], moved[1], moved[2], moved[3],
                      load(&overlaps.distance[i]), load(&overlaps.thickness[i]));
}

// Of the overlaps from number `begin` on, keeps those that come near.
template <PairKind kind>
inline void keep_pairs_that_come_near(const SweepView& view, Overlaps& overlaps, std::uint32_t begin) {
    std::uint32_t to = begin;
    for (std::uint32_t i = begin; i < overlaps.count; i += lane_count) {
        const std::uint32_t bits = bits_of(pairs_come_near<kind>(view, overlaps, i)) & lanes_before(i, overlaps.count);
        const mask near = mask_of(bits);
        for (auto* array : {&overlaps.pair, &overlaps.particle[0], &overlaps.particle[1], &overlaps.particle[2], &overlaps.particle[3]})
            compress(&(*array)[i], near, &(*array)[to]);
        for (auto* arrays : {&overlaps.weight[0], &overlaps.weight[1], &overlaps.weight[2], &overlaps.weight[3],
                             &overlaps.normal[0], &overlaps.normal[1], &overlaps.normal[2], &overlaps.depth})
            compress(load(&(*arrays)[i]), near, &(*arrays)[to]);
        to += static_cast<std::uint32_t>(std::popcount(bits));
    }
    overlaps.count = to;
}

template <PairKind kind>
inline void find_overlapping_pairs(NearPairs& near, const SweepView& view, Overlaps& overlaps) {
    overlaps.reserve(overlaps.count + near.count);
    const std::uint32_t begin = overlaps.count;
    alignas(64) std::uint32_t numbers[16];
    for (std::uint32_t i = 0; i < near.count; i += lane_count) {
        real along[4], gap(0.0f);
        load_along(near, i, view.positions, along);
        for (int k = 1; k < 4; ++k) gap = gap + load(&near.weight[k][i]) * along[k];
        const real distance = load(&near.distance[i]), thickness = load(&near.thickness[i]);
        const real overlap = cloth_overlap(gap, distance, thickness, real(view.recovery));
        mask pushes = overlap < real(0.0f);
        if constexpr (kind == PairKind::edge_edge)
            pushes = pushes && closest_inside_edges(load(&near.weight[0][i]), load(&near.weight[1][i]),
                                                    load(&near.weight[2][i]), load(&near.weight[3][i]));
        const std::uint32_t bits = bits_of(pushes) & lanes_before(i, near.count);
        if (bits == 0) continue;
        const mask found = mask_of(bits);
        const std::uint32_t to = overlaps.count;
        for (std::uint32_t lane = 0; lane < lane_count; ++lane) numbers[lane] = i + lane;
        compress(numbers, found, &overlaps.pair[to]);
        for (int k = 0; k < 4; ++k) {
            compress(&near.particle[k][i], found, &overlaps.particle[k][to]);
            compress(load(&near.weight[k][i]), found, &overlaps.weight[k][to]);
        }
        for (int k = 0; k < 3; ++k) compress(load(&near.normal[k][i]), found, &overlaps.normal[k][to]);
        compress(distance, found, &overlaps.distance[to]);
        compress(thickness, found, &overlaps.thickness[to]);
        compress(-overlap, found, &overlaps.depth[to]);
        overlaps.count += static_cast<std::uint32_t>(std::popcount(bits));
    }
    for (int k = 0; k < 4; ++k) std::fill_n(&overlaps.particle[k][overlaps.count], 16, near.particle[k][0]);
    keep_pairs_that_come_near<kind>(view, overlaps, begin);
    for (std::uint32_t i = begin; i < overlaps.count; ++i) near.pushed[overlaps.pair[i]] = 1;
    for (int k = 0; k < 4; ++k) {
        for (std::uint32_t i = begin; i < overlaps.count; i += lane_count) {
            alignas(64) float shares[16];
            store(to_weight_quanta(load(&overlaps.weight[k][i])), shares);
            const std::uint32_t end = std::min<std::uint32_t>(lane_count, overlaps.count - i);
            for (std::uint32_t lane = 0; lane < end; ++lane)
                view.to_shares[overlaps.particle[k][i + lane]].share += static_cast<std::uint32_t>(shares[lane]);
        }
    }
}

// Adds the pushes of a packet of overlaps to the sums of their particles.
WEFT_FN void add_pushes(const Overlaps& overlaps, std::uint32_t i, vec3 push, ContactSums* sums) {
    const real scale(static_cast<float>(WEFT_PUSH_QUANTA_PER_METER));
    const std::uint32_t used = lanes_before(i, overlaps.count);
    for (int k = 0; k < 4; ++k) {
        const vec3 change = push * load(&overlaps.give[k][i]);
        alignas(64) std::array<std::array<std::int32_t, 4>, lane_count> quanta;
        store_integer_blocks(vec3(to_contact_quanta(change.x, scale), to_contact_quanta(change.y, scale),
                                  to_contact_quanta(change.z, scale)),
                             real(0.0f), quanta[0].data());
        for (int lane = 0; lane < lane_count; ++lane) {
            if (!(used >> lane & 1)) break;
            ContactSums& of_particle = sums[overlaps.particle[k][i + static_cast<std::uint32_t>(lane)]];
            for (std::size_t axis = 0; axis < 3; ++axis)
                of_particle.push[axis] += static_cast<std::uint32_t>(quanta[lane][axis]);
        }
    }
}

// The masses of the particles are split among the pairs that push them, alike on both sides of a pair, so that momentum
// is kept. In full this is safe and slow. A part of it is enough for pairs that push in different directions; it moves
// pairs that push alike too far, so their pushes are scaled in a second step.
inline void find_pushes(Overlaps& overlaps, const SweepView& view) {
    const auto* shares = reinterpret_cast<const std::int32_t*>(view.shares);
    for (std::uint32_t i = 0; i < overlaps.count; i += lane_count) {
        const vec3 normal(load(&overlaps.normal[0][i]), load(&overlaps.normal[1][i]), load(&overlaps.normal[2][i]));
        const real depth = load(&overlaps.depth[i]);
        vec3 moved(real(0.0f));
        real resistance(0.0f);
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t* particle = &overlaps.particle[k][i];
            const real weight = load(&overlaps.weight[k][i]);
            real inverse_mass, unused, share;
            const vec3 x = gather_blocks(view.positions, particle, inverse_mass);
            moved = moved + (x - gather_blocks(view.start, particle, unused)) * weight;
            (void)gather_integer_blocks(shares, particle, share);
            share = share * real(static_cast<float>(1 / WEFT_WEIGHT_QUANTA));
            resistance = resistance + contact_resistance(inverse_mass, weight, share * real(contact_split));
            store(weight * inverse_mass, &overlaps.give[k][i]);
        }
        real unused;
        const vec3 one = gather_blocks(view.friction, &overlaps.particle[0][i], unused);
        const vec3 two = gather_blocks(view.friction, &overlaps.particle[3][i], unused);
        const vec3 rub = cloth_friction(moved, normal, depth, sqrt(one.x * two.x), sqrt(one.y * two.y));
        const mask moves = resistance > real(1e-12f);
        const real scale = real(1.0f) / select(moves, resistance, real(1.0f));
        const vec3 push = select(moves, (normal * depth - rub) * scale, vec3(real(0.0f)));
        store(push.x, &overlaps.push[0][i]), store(push.y, &overlaps.push[1][i]), store(push.z, &overlaps.push[2][i]);
        add_pushes(overlaps, i, push, view.to_unscaled);
    }
}

inline void scale_pushes(Overlaps& overlaps, const SweepView& view) {
    const auto* unscaled = reinterpret_cast<const std::int32_t*>(view.unscaled);
    const real meters(static_cast<float>(1 / WEFT_PUSH_QUANTA_PER_METER));
    for (std::uint32_t i = 0; i < overlaps.count; i += lane_count) {
        const vec3 normal(load(&overlaps.normal[0][i]), load(&overlaps.normal[1][i]), load(&overlaps.normal[2][i]));
        const real depth = load(&overlaps.depth[i]);
        real opened(0.0f);
        for (int k = 0; k < 4; ++k) {
            real unused;
            const vec3 push = gather_integer_blocks(unscaled, &overlaps.particle[k][i], unused) * meters;
            opened = opened + load(&overlaps.weight[k][i]) * dot(normal, push);
        }
        const real part = select(opened > depth, depth / select(opened > depth, opened, real(1.0f)), real(1.0f));
        const vec3 push(load(&overlaps.push[0][i]), load(&overlaps.push[1][i]), load(&overlaps.push[2][i]));
        add_pushes(overlaps, i, push * part, view.to_scaled);
    }
}

template <PairKind kind>
inline void find_lost_pairs(const NearPairs& near, const float* positions, float floor, float depth,
                            std::vector<std::uint32_t>& lost) {
    for (std::uint32_t i = 0; i < near.count; i += lane_count) {
        real along[4];
        load_along(near, i, positions, along);
        const mask loses =
            loses_gap(gap_of<kind>(along) + real(depth), load(&near.gap[i]), load(&near.thickness[i]) * real(floor));
        for_each_bit(bits_of(loses) & lanes_before(i, near.count), [&](std::uint32_t lane) { lost.push_back(i + lane); });
    }
}

constexpr ContactLoops contact_loops{
    search_loops,
    choose_pairs,
    {find_near_pairs<PairKind::vertex_triangle>, find_near_pairs<PairKind::edge_edge>},
    {find_overlapping_pairs<PairKind::vertex_triangle>, find_overlapping_pairs<PairKind::edge_edge>},
    find_pushes,
    scale_pushes,
    {find_lost_pairs<PairKind::vertex_triangle>, find_lost_pairs<PairKind::edge_edge>},
};
