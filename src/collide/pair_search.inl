// The loops of the pair search, for the lanes of the including namespace. Include physics/kernels.inl before.

#include "collide/lane_bits.inl"

inline float tile_deviation(const TileState& tile, const float* positions, float ticks) {
    const real dt(ticks);
    float farthest = 0;
    for (std::uint32_t i = 0; i < tile.tile->vertex_count; i += lane_count) {
        real w;
        const vec3 x = gather_blocks(positions, &tile.particle[i], w);
        const vec3 place(load(&tile.place[0][i]), load(&tile.place[1][i]), load(&tile.place[2][i]));
        const vec3 velocity(load(&tile.velocity[0][i]), load(&tile.velocity[1][i]), load(&tile.velocity[2][i]));
        const vec3 off = x - (place + velocity * dt);
        alignas(64) float lanes[16];
        store(sqrt(dot(off, off)) - load(&tile.around[i]), lanes);
        for (int k = 0; k < lane_count; ++k) farthest = lanes[k] <= farthest ? farthest : lanes[k];
        if (farthest != farthest) return farthest;
    }
    return farthest;
}

inline float most_moved_of_tile(const TileState& tile, const float* places, const float* other_places) {
    real most2(0.0f);
    for (std::uint32_t i = 0; i < tile.tile->own_vertices; i += lane_count) {  // the last packet has some more
        real w;
        const vec3 moved = gather_blocks(places, &tile.particle[i], w) - gather_blocks(other_places, &tile.particle[i], w);
        most2 = max(most2, dot(moved, moved));
    }
    alignas(64) float lanes[16];
    store(most2, lanes);
    return std::sqrt(*std::max_element(lanes, lanes + lane_count));
}

inline void bound_tile(TileState& tile, float ticks) {
    const vec3 mean(real(tile.mean_velocity.x), real(tile.mean_velocity.y), real(tile.mean_velocity.z));
    const real far(std::numeric_limits<float>::infinity());
    real low[3] = {far, far, far}, high[3] = {-far, -far, -far};
    for (std::uint32_t i = 0; i < tile_vertices; i += lane_count) {  // unused places repeat the first vertex
        const vec3 place(load(&tile.place[0][i]), load(&tile.place[1][i]), load(&tile.place[2][i]));
        const vec3 velocity(load(&tile.velocity[0][i]), load(&tile.velocity[1][i]), load(&tile.velocity[2][i]));
        const vec3 half_way = (velocity - mean) * real(tile.middle);
        const vec3 x = place + velocity * real(ticks) + half_way;
        const real away = sqrt(dot(half_way, half_way)) + load(&tile.around[i]);
        store_blocks(x, away, &tile.now[i].x);
        const real axes[3] = {x.x, x.y, x.z};
        for (int k = 0; k < 3; ++k) low[k] = min(low[k], axes[k] - away), high[k] = max(high[k], axes[k] + away);
    }
    for (int k = 0; k < 3; ++k) {
        alignas(64) float lows[16], highs[16];
        store(low[k], lows), store(high[k], highs);
        const float lowest = *std::min_element(lows, lows + lane_count);
        const float highest = *std::max_element(highs, highs + lane_count);
        tile.center[k] = 0.5f * (lowest + highest);
        tile.half[k] = 0.5f * (highest - lowest);
    }
}

// Features in a group: whole packets of lanes, and at most 16 groups of each kind.
constexpr std::uint32_t feature_group = lane_count < 8 ? 8 : lane_count;

// Boxes around groups of features. Groups without features are far away.
template <std::size_t Count>
WEFT_FN void bound_groups(const BoxArrays<Count>& boxes, std::uint32_t count, BoxArrays<16>& groups) {
    const real infinity(std::numeric_limits<float>::infinity());
    for (std::uint32_t group = 0; group < 16; ++group) {
        const std::uint32_t begin = group * feature_group, end = std::min(begin + feature_group, count);
        for (int k = 0; k < 3; ++k) {
            real low = infinity, high = -infinity;
            for (std::uint32_t i = begin; i < end; i += lane_count) {
                const real center = load(&boxes.center[k][i]), half = load(&boxes.half[k][i]);
                const mask used = mask_of(lanes_before(i, count));
                low = min(low, select(used, center - half, infinity));
                high = max(high, select(used, center + half, -infinity));
            }
            const float lowest = least(low), highest = most(high);
            groups.center[k][group] = begin < end ? 0.5f * (lowest + highest) : 1e18f;
            groups.half[k][group] = begin < end ? 0.5f * (highest - lowest) : 0;
        }
    }
}

// `vertex`: by corner, the vertices of the features.
template <std::size_t Count, std::size_t Corners>
WEFT_FN void gather_features(const float* now, const std::array<const std::uint32_t*, Corners>& vertex,
                             std::uint32_t count, FeatureArrays<Count, Corners>& features) {
    for (std::uint32_t i = 0; i < count; i += lane_count) {
        real low[3], high[3], away(0.0f);
        for (std::size_t c = 0; c < Corners; ++c) {
            real away_here;
            const vec3 x = gather_blocks(now, vertex[c] + i, away_here);
            away = max(away, away_here);
            const real axes[3] = {x.x, x.y, x.z};
            for (int k = 0; k < 3; ++k) {
                low[k] = c == 0 ? axes[k] : min(low[k], axes[k]);
                high[k] = c == 0 ? axes[k] : max(high[k], axes[k]);
            }
        }
        for (int k = 0; k < 3; ++k) {
            store((low[k] + high[k]) * real(0.5f), &features.boxes.center[k][i]);
            store((high[k] - low[k]) * real(0.5f) + away, &features.boxes.half[k][i]);
        }
    }
    bound_groups(features.boxes, count, features.groups);
}

// The vertices of a tile, as the corners of its edges and triangles are given.
constexpr auto vertex_numbers = [] {
    std::array<std::uint32_t, tile_vertices> number{};
    for (std::uint32_t i = 0; i < tile_vertices; ++i) number[i] = i;
    return number;
}();

inline void gather_tile(TileState& tile) {
    const Tile& mesh = *tile.tile;
    const float* now = &tile.now[0].x;
    gather_features<tile_vertices, 1>(now, {vertex_numbers.data()}, mesh.own_vertices, tile.vertices);
    gather_features<tile_edges, 2>(now, {mesh.edge[0].data(), mesh.edge[1].data()}, mesh.edge_count, tile.edges);
    gather_features<tile_triangles, 3>(now, {mesh.triangle[0].data(), mesh.triangle[1].data(), mesh.triangle[2].data()},
                                       mesh.triangle_count, tile.triangles);
}

// A box, and whether others meet it.
struct BoxTest {
    real center[3], half[3];

    WEFT_FN BoxTest(const float* of_center, const float* of_half, std::size_t stride, const TileReach& reach, float sign) {
        for (int k = 0; k < 3; ++k) {
            center[k] = real(of_center[k * stride] + sign * reach.shift[k]);
            half[k] = real(of_half[k * stride] + reach.widen[k]);
        }
    }
    template <std::size_t Count>
    WEFT_FN std::uint32_t meets(const BoxArrays<Count>& boxes, std::uint32_t i) const {
        return bits_of(abs(center[0] - load(&boxes.center[0][i])) < half[0] + load(&boxes.half[0][i]) &&
                       abs(center[1] - load(&boxes.center[1][i])) < half[1] + load(&boxes.half[1][i]) &&
                       abs(center[2] - load(&boxes.center[2][i])) < half[2] + load(&boxes.half[2][i]));
    }
    // Of 16 groups.
    WEFT_FN std::uint32_t meets_groups(const BoxArrays<16>& groups) const {
        std::uint32_t bits = 0;
        for (std::uint32_t g = 0; g < 16; g += lane_count) bits |= meets(groups, g) << g;
        return bits;
    }
};

// Finds the pairs of features whose boxes meet. `b` is displaced by twice `sign` times the shift: both go half of the
// way. `same`: finds each pair of features of one kind once. Without branches that depend on the outcome of a test.
template <class A, class B>
WEFT_FN void find_meeting_boxes(const TileState& b, const A& of_a, std::uint32_t count_a, const B& of_b, std::uint32_t count_b,
                                bool same, const TileReach& reach, float sign, SearchScratch& scratch) {
    // The boxes of `a` where they meet those of `b`.
    for (std::uint32_t i = 0; i < count_a; i += lane_count) {
        for (int k = 0; k < 3; ++k) {
            store(load(&of_a.boxes.center[k][i]) - real(sign * reach.shift[k]), &scratch.center[k][i]);
            store(load(&of_a.boxes.half[k][i]) + real(reach.widen[k]), &scratch.half[k][i]);
        }
    }
    std::uint32_t packets = 0;
    const BoxTest all(b.center.data(), b.half.data(), 1, reach, sign);
    for_each_bit(all.meets_groups(of_a.groups), [&](std::uint32_t group_a) {
        const BoxTest group(&of_a.groups.center[0][group_a], &of_a.groups.half[0][group_a], 16, reach, -sign);
        std::uint32_t groups_b = group.meets_groups(of_b.groups);
        if (same) groups_b &= ~0u << group_a;
        const std::uint32_t begin = group_a * feature_group, end = std::min(begin + feature_group, count_a);
        for_each_bit(groups_b, [&](std::uint32_t group_b) {
            const std::uint32_t first = group_b * feature_group, last = std::min(first + feature_group, count_b);
            for (std::uint32_t j = first; j < last; j += lane_count) {
                const std::uint32_t used = lanes_before(j, count_b);
                real center[3], half[3];
                for (int k = 0; k < 3; ++k) center[k] = load(&of_b.boxes.center[k][j]), half[k] = load(&of_b.boxes.half[k][j]);
                for (std::uint32_t i = begin; i < end; ++i) {
                    const auto meets = [&](int k) {
                        return abs(real(scratch.center[k][i]) - center[k]) < real(scratch.half[k][i]) + half[k];
                    };
                    std::uint32_t bits = bits_of(meets(0) && meets(1) && meets(2)) & used;
                    if (same) bits = i < j ? bits : i - j < lane_count - 1 ? bits & (~1u << (i - j)) : 0;
                    scratch.packet[packets] = bits | i << 16 | j << 24;
                    packets += bits != 0;
                }
            }
        });
    });
    scratch.packets = packets;
}

// Numbers of vertices of the two sides of a pair.
template <PairKind kind>
constexpr std::array<int, 2> sides = kind == PairKind::vertex_triangle ? std::array{1, 3} : std::array{2, 2};

template <PairKind kind>
WEFT_FN ClosestPoints closest(const vec3* x) {
    if constexpr (kind == PairKind::vertex_triangle) return closest_vertex_triangle(x[0], x[1], x[2], x[3]);
    else return closest_edge_edge(x[0], x[1], x[2], x[3]);
}

// Packs the pairs of the packets that have no common particle, with their vertices in the tiles.
template <PairKind kind, class A, class B>
WEFT_FN void pack_pairs(const A& of_a, const std::array<const std::uint32_t*, sides<kind>[0]>& of_one, const B& of_b,
                        const std::array<const std::uint32_t*, sides<kind>[1]>& of_two, SearchScratch& scratch) {
    std::uint32_t count = 0;
    for (std::uint32_t packet = 0; packet < scratch.packets; ++packet) {
        const std::uint32_t i = scratch.packet[packet] >> 16 & 255, j = scratch.packet[packet] >> 24;
        mask apart = real(0.0f) < real(1.0f);
        for (std::size_t c = 0; c < of_one.size(); ++c) {
            for (std::size_t d = 0; d < of_two.size(); ++d) {
                const real p(of_a.number[c][i]), q = load(&of_b.number[d][j]);
                apart = apart && (p < q || p > q);
            }
        }
        const std::uint32_t bits = scratch.packet[packet] & bits_of(apart);
        const mask found = mask_of(bits);
        for (std::size_t c = 0; c < of_one.size(); ++c) fill(of_one[c][i], &scratch.vertex[c][count]);
        for (std::size_t d = 0; d < of_two.size(); ++d)
            compress(&of_two[d][j], found, &scratch.vertex[of_one.size() + d][count]);
        count += static_cast<std::uint32_t>(std::popcount(bits));
    }
    for (auto& array : scratch.vertex) std::fill_n(&array[count], 16, 0u);
    scratch.count = count;
}

// Keeps, of the packed pairs, those that come within the thickness.
template <PairKind kind>
WEFT_FN void keep_near_pairs(const TileState& a, const TileState& b, const TileReach& reach, float sign, SearchScratch& scratch) {
    const vec3 shift(real(sign * reach.shift[0]), real(sign * reach.shift[1]), real(sign * reach.shift[2]));
    const std::size_t most = scratch.count + 16;
    if (scratch.far.size() < most) {
        for (auto& array : scratch.particle) array.resize(most);
        scratch.far.resize(most), scratch.distance.resize(most);
    }
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < scratch.count; i += lane_count) {
        vec3 x[4];
        real away[4];
        for (int c = 0; c < 4; ++c)
            x[c] = gather_blocks(&(c < sides<kind>[0] ? a : b).now[0].x, &scratch.vertex[c][i], away[c]);
        for (int c = 0; c < sides<kind>[0]; ++c) x[c] = x[c] - shift;
        const real distance = closest<kind>(x).distance;
        const real of_one = kind == PairKind::edge_edge ? max(away[0], away[1]) : away[0];
        const real of_two = kind == PairKind::edge_edge ? max(away[2], away[3]) : max(away[1], max(away[2], away[3]));
        const real far = of_one + of_two + real(reach.add);
        const std::uint32_t bits = bits_of(distance < far + real(reach.thickness)) & lanes_before(i, scratch.count);
        if (bits == 0) continue;
        alignas(64) float distances[16], fars[16];
        store(distance, distances), store(far, fars);
        for_each_bit(bits, [&](std::uint32_t lane) {
            for (int c = 0; c < 4; ++c)
                scratch.particle[c][kept] = (c < sides<kind>[0] ? a : b).tile->particle[scratch.vertex[c][i + lane]];
            scratch.far[kept] = fars[lane];
            scratch.distance[kept++] = distances[lane];
        });
    }
    scratch.count = kept;
}

// The thickness of the pairs that were kept, the mean of both features. `first`: which tile of the reach side one is.
template <PairKind kind>
WEFT_FN void find_thickness(const TileReach& reach, std::size_t first, SearchScratch& scratch) {
    scratch.thickness.resize(std::max(scratch.thickness.size(), scratch.far.size()));
    if (!reach.is_uneven()) return void(std::fill_n(&scratch.thickness[0], scratch.count, reach.thickness));
    const auto of_side = [&](std::size_t tile, int begin, int end, std::uint32_t i) {
        float thickness = reach.of_cloths[tile];
        if (!reach.uneven[tile]) return thickness;
        for (int c = begin; c < end; ++c)
            thickness = std::min(thickness, reach.uneven[tile].at(scratch.particle[static_cast<std::size_t>(c)][i]));
        return thickness;
    };
    for (std::uint32_t i = 0; i < scratch.count; ++i)
        scratch.thickness[i] =
            0.5f * (of_side(first, 0, sides<kind>[0], i) + of_side(1 - first, sides<kind>[0], 4, i));
}

// Appends the pairs that were found and come within their own thickness. `first`: which tile of the reach `a` is.
template <PairKind kind>
inline void append_pairs(const TileState& a, const TileState& b, const TileReach& reach, std::size_t first,
                         SearchScratch& scratch, PairList& list) {
    const std::uint32_t count = scratch.count;
    if (count == 0) return;
    list.reserve(list.count + count);
    find_thickness<kind>(reach, first, scratch);
    const auto add = [&](std::uint32_t i, float thickness) {
        const std::uint32_t at = list.count++;
        for (int c = 0; c < 4; ++c)
            list.particle[c][at] = (c < sides<kind>[0] ? a : b).base() + scratch.particle[c][i];
        list.thickness[at] = thickness, list.spare[at] = scratch.distance[i] - thickness;
    };
    if (!reach.rest) {
        for (std::uint32_t i = 0; i < count; ++i)
            if (scratch.distance[i] < scratch.far[i] + scratch.thickness[i]) add(i, scratch.thickness[i]);
        return;
    }
    // Neighbors on one cloth keep at most half of their distance at rest, or a thickness above the edge length would
    // push them apart. Features that coincide at rest have no side, so they are left out.
    for (int c = 0; c < 4; ++c) std::fill_n(&scratch.particle[c][count], 16, 0u);
    for (std::uint32_t i = 0; i < count; i += lane_count) {
        vec3 x[4];
        real w;
        for (int c = 0; c < 4; ++c) x[c] = gather_blocks(&reach.rest->x, &scratch.particle[c][i], w);
        const real at_rest = closest<kind>(x).distance;
        const real thickness = min(load(&scratch.thickness[i]), at_rest * real(0.5f));
        const mask listed = load(&scratch.distance[i]) < thickness + load(&scratch.far[i]) && at_rest > real(0.0f);
        alignas(64) float lanes[16];
        store(thickness, lanes);
        for_each_bit(bits_of(listed) & lanes_before(i, count), [&](std::uint32_t lane) { add(i + lane, lanes[lane]); });
    }
}

// Pairs of the vertices of `a` and the triangles of `b`, which moves by twice `sign` times the shift.
inline void list_vertex_triangle(const TileState& a, const TileState& b, const TileReach& reach, float sign,
                                 SearchScratch& scratch, PairList& list) {
    constexpr PairKind kind = PairKind::vertex_triangle;
    const auto& corner = b.tile->triangle;
    find_meeting_boxes(b, a.vertices, a.tile->own_vertices, b.triangles, b.tile->triangle_count, false, reach, sign, scratch);
    pack_pairs<kind>(a.vertices, {vertex_numbers.data()}, b.triangles, {corner[0].data(), corner[1].data(), corner[2].data()}, scratch);
    keep_near_pairs<kind>(a, b, reach, sign, scratch);
    append_pairs<kind>(a, b, reach, sign > 0 ? 0 : 1, scratch, list);
}

inline void list_edge_edge(const TileState& a, const TileState& b, const TileReach& reach, SearchScratch& scratch,
                           PairList& list) {
    constexpr PairKind kind = PairKind::edge_edge;
    const auto &one = a.tile->edge, &two = b.tile->edge;
    find_meeting_boxes(b, a.edges, a.tile->edge_count, b.edges, b.tile->edge_count, &a == &b, reach, 1, scratch);
    pack_pairs<kind>(a.edges, {one[0].data(), one[1].data()}, b.edges, {two[0].data(), two[1].data()}, scratch);
    keep_near_pairs<kind>(a, b, reach, 1, scratch);
    append_pairs<kind>(a, b, reach, 0, scratch, list);
}

inline void list_pairs_of_tiles(const TileState& a, const TileState& b, const TileReach& reach,
                                SearchScratch& scratch, std::array<PairList, 2>& lists) {
    list_vertex_triangle(a, b, reach, 1, scratch, lists[0]);
    if (&a != &b) list_vertex_triangle(b, a, reach, -1, scratch, lists[0]);
    list_edge_edge(a, b, reach, scratch, lists[1]);
}

constexpr SearchLoops search_loops{tile_deviation, bound_tile, most_moved_of_tile, gather_tile, list_pairs_of_tiles};
