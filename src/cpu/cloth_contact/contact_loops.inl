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
inline void find_near_pairs(const Candidates& list, const NearInput& input, NearPairs& near) {
    near.reserve(near.count + list.count);
    for (std::uint32_t i = 0; i < list.count; i += lane_count) {
        vec3 x[4];
        real w, along_start[4], along[4], low[4], high[4];
        for (int k = 0; k < 4; ++k) x[k] = gather_blocks(input.start, &list.particle[k][i], w);
        const ClosestPoints points = closest<kind>(x);
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

inline void find_overlapping_pairs(const NearPairs& near, const float* positions, float recovery,
                                   std::vector<Overlap>& overlaps) {
    for (std::uint32_t i = 0; i < near.count; i += lane_count) {
        real along[4], gap(0.0f);
        load_along(near, i, positions, along);
        for (int k = 1; k < 4; ++k) gap = gap + load(&near.weight[k][i]) * along[k];
        const real overlap = cloth_overlap(gap, load(&near.distance[i]), load(&near.thickness[i]), real(recovery));
        const std::uint32_t bits = bits_of(overlap < real(0.0f)) & lanes_before(i, near.count);
        if (bits == 0) continue;
        alignas(64) float lanes[16];
        store(-overlap, lanes);
        for_each_bit(bits, [&](std::uint32_t lane) { overlaps.push_back({i + lane, lanes[lane], {}}); });
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
    {find_overlapping_pairs, find_overlapping_pairs},
    {find_lost_pairs<PairKind::vertex_triangle>, find_lost_pairs<PairKind::edge_edge>},
};
