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

template <std::size_t Count>
WEFT_FN void store_box(BoxArrays<Count>& boxes, std::uint32_t i, int axis, real low, real high, real widen) {
    store((low + high) * real(0.5f), &boxes.center[axis][i]);
    store((high - low) * real(0.5f) + widen, &boxes.half[axis][i]);
}

inline void bound_tile(TileState& tile, float ticks, float lifetime) {
    const Tile& mesh = *tile.tile;
    const vec3 mean(real(tile.mean_velocity.x), real(tile.mean_velocity.y), real(tile.mean_velocity.z));
    for (std::uint32_t i = 0; i < tile_vertices; i += lane_count) {
        const vec3 place(load(&tile.place[0][i]), load(&tile.place[1][i]), load(&tile.place[2][i]));
        const vec3 velocity(load(&tile.velocity[0][i]), load(&tile.velocity[1][i]), load(&tile.velocity[2][i]));
        const vec3 x = place + velocity * real(ticks), relative = velocity - mean;
        const real away = sqrt(dot(relative, relative)) * real(lifetime) + load(&tile.around[i]);
        store_blocks(x, away, &tile.now[i].x);
        const real axes[3] = {x.x, x.y, x.z};
        for (int k = 0; k < 3; ++k) store(axes[k], &tile.vertex_boxes.center[k][i]), store(away, &tile.vertex_boxes.half[k][i]);
    }
    const float* now = &tile.now[0].x;
    for (std::uint32_t i = 0; i < mesh.edge_count; i += lane_count) {
        real away0, away1;
        const vec3 p = gather_blocks(now, &mesh.edge[0][i], away0), q = gather_blocks(now, &mesh.edge[1][i], away1);
        const real away = max(away0, away1);
        store_box(tile.edge_boxes, i, 0, min(p.x, q.x), max(p.x, q.x), away);
        store_box(tile.edge_boxes, i, 1, min(p.y, q.y), max(p.y, q.y), away);
        store_box(tile.edge_boxes, i, 2, min(p.z, q.z), max(p.z, q.z), away);
    }
    for (std::uint32_t i = 0; i < mesh.triangle_count; i += lane_count) {
        real away0, away1, away2;
        const vec3 p = gather_blocks(now, &mesh.triangle[0][i], away0), q = gather_blocks(now, &mesh.triangle[1][i], away1),
                   r = gather_blocks(now, &mesh.triangle[2][i], away2);
        const real away = max(away0, max(away1, away2));
        const auto box = [&](int axis, real a, real b, real c) {
            store_box(tile.triangle_boxes, i, axis, min(a, min(b, c)), max(a, max(b, c)), away);
        };
        box(0, p.x, q.x, r.x), box(1, p.y, q.y, r.y), box(2, p.z, q.z, r.z);
    }
    for (int k = 0; k < 3; ++k) {
        float low = std::numeric_limits<float>::infinity(), high = -low;
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
            const float center = tile.triangle_boxes.center[k][i], half = tile.triangle_boxes.half[k][i];
            low = std::min(low, center - half), high = std::max(high, center + half);
        }
        tile.center[k] = 0.5f * (low + high);
        tile.half[k] = 0.5f * (high - low);
    }
}

// Features of a tile whose boxes, displaced by `sign` times half of the tiles' relative motion, meet the other tile's.
template <std::size_t Count>
WEFT_FN void cull(SearchScratch::Culled<tile_edges>& out, std::uint32_t count, const BoxArrays<Count>& boxes,
                  const TileState& other, const TileReach& reach, float sign) {
    out.count = 0;
    for (std::uint32_t i = 0; i < count; i += lane_count) {
        mask meet = real(0.0f) < real(1.0f);
        for (int k = 0; k < 3; ++k) {
            const real distance = abs(load(&boxes.center[k][i]) - real(other.center[k] + sign * reach.shift[k]));
            meet = meet && distance < load(&boxes.half[k][i]) + real(other.half[k] + reach.widen[k]);
        }
        for_each_bit(bits_of(meet) & lanes_before(i, count), [&](std::uint32_t lane) {
            const std::uint32_t at = out.count++;
            out.feature[at] = i + lane;
            for (int k = 0; k < 3; ++k) {
                out.center[k][at] = boxes.center[k][i + lane];
                out.half[k][at] = boxes.half[k][i + lane];
            }
        });
    }
    for (int k = 0; k < 3; ++k) std::fill_n(&out.center[k][out.count], 16, 1e9f), std::fill_n(&out.half[k][out.count], 16, 0.0f);
}

// Calls visit(feature of a, feature of b) where their boxes meet.
template <class Visit>
WEFT_FN void for_each_meeting(const SearchScratch::Culled<tile_edges>& a, const SearchScratch::Culled<tile_edges>& b,
                              bool same, const TileReach& reach, float sign, Visit&& visit) {
    for (std::uint32_t i = 0; i < a.count; ++i) {
        real center[3], half[3];
        for (int k = 0; k < 3; ++k) {
            center[k] = real(a.center[k][i] - sign * reach.shift[k]);
            half[k] = real(a.half[k][i] + reach.widen[k]);
        }
        for (std::uint32_t j = same ? (i + 1) / lane_count * lane_count : 0; j < b.count; j += lane_count) {
            const mask meet = abs(center[0] - load(&b.center[0][j])) < half[0] + load(&b.half[0][j]) &&
                              abs(center[1] - load(&b.center[1][j])) < half[1] + load(&b.half[1][j]) &&
                              abs(center[2] - load(&b.center[2][j])) < half[2] + load(&b.half[2][j]);
            for_each_bit(bits_of(meet), [&](std::uint32_t lane) {
                if (!same || j + lane > i) visit(a.feature[i], b.feature[j + lane]);
            });
        }
    }
}

// Makes room for one more candidate and a padded packet after it.
inline void reserve_candidates(SearchScratch& scratch, std::size_t count) {
    if (scratch.least.size() >= count + 32) return;
    const std::size_t room = 2 * count + 256;
    for (auto* arrays : {&scratch.vertex, &scratch.particle})
        for (auto& array : *arrays) array.resize(room);
    scratch.least.resize(room), scratch.distance.resize(room);
}

template <PairKind kind>
WEFT_FN ClosestPoints closest(const vec3* x) {
    if constexpr (kind == PairKind::vertex_triangle) return closest_vertex_triangle(x[0], x[1], x[2], x[3]);
    else return closest_edge_edge(x[0], x[1], x[2], x[3]);
}

// Appends the candidates that come within their thickness.
template <PairKind kind>
inline void list_candidates(const TileState& a, const TileState& b, const TileReach& reach, SearchScratch& scratch,
                            PairList& list) {
    constexpr int side_one = kind == PairKind::vertex_triangle ? 1 : 2;
    const std::uint32_t count = scratch.candidates;
    if (count == 0) return;
    for (int k = 0; k < 4; ++k)
        for (std::uint32_t i = count; i < count + 16; ++i) scratch.vertex[k][i] = scratch.particle[k][i] = 0;
    // Distances at the start of the list, less all that the features can approach. Those that pass move to the front.
    std::uint32_t passed = 0;
    for (std::uint32_t i = 0; i < count; i += lane_count) {
        vec3 x[4];
        real away[4];
        for (int k = 0; k < 4; ++k)
            x[k] = gather_blocks(&(k < side_one ? a : b).now[0].x, &scratch.vertex[k][i], away[k]);
        const real side_a = side_one == 1 ? away[0] : max(away[0], away[1]);
        const real side_b = side_one == 1 ? max(away[1], max(away[2], away[3])) : max(away[2], away[3]);
        const real distance = closest<kind>(x).distance;
        const real least = distance - side_a - side_b - real(reach.add);
        alignas(64) float lanes[16], distances[16];
        store(least, lanes), store(distance, distances);
        for_each_bit(bits_of(least < real(reach.thickness)) & lanes_before(i, count), [&](std::uint32_t lane) {
            for (int k = 0; k < 4; ++k) scratch.particle[k][passed] = scratch.particle[k][i + lane];
            scratch.distance[passed] = distances[lane];
            scratch.least[passed++] = lanes[lane];
        });
    }
    list.reserve(list.count + passed);
    const auto add = [&](std::uint32_t i, float thickness) {
        const auto in_world = [&](int k) {
            return (k < side_one ? a : b).base() + scratch.particle[k][i];
        };
        list.add({in_world(0), in_world(1), in_world(2), in_world(3)}, thickness, scratch.distance[i] - thickness);
    };
    if (!reach.rest) {
        for (std::uint32_t i = 0; i < passed; ++i) add(i, reach.thickness);
        return;
    }
    // Neighbors on one cloth keep at most half of their distance at rest, or a thickness above the edge length would
    // push them apart. Features that coincide at rest have no side, so they are left out.
    for (int k = 0; k < 4; ++k)
        for (std::uint32_t i = passed; i < passed + 16; ++i) scratch.particle[k][i] = 0;
    for (std::uint32_t i = 0; i < passed; i += lane_count) {
        vec3 x[4];
        real w;
        for (int k = 0; k < 4; ++k) x[k] = gather_blocks(&reach.rest->x, &scratch.particle[k][i], w);
        const real at_rest = closest<kind>(x).distance;
        const real thickness = min(real(reach.thickness), at_rest * real(0.5f));
        const mask listed = load(&scratch.least[i]) < thickness && at_rest > real(0.0f);
        alignas(64) float lanes[16];
        store(thickness, lanes);
        for_each_bit(bits_of(listed) & lanes_before(i, passed), [&](std::uint32_t lane) { add(i + lane, lanes[lane]); });
    }
}

// Pairs of the vertices of `a` and the triangles of `b`, which moves by twice `sign` times the shift.
inline void list_vertex_triangle(const TileState& a, const TileState& b, const TileReach& reach, float sign,
                                 SearchScratch& scratch, PairList& list) {
    cull(scratch.a, a.tile->own_vertices, a.vertex_boxes, b, reach, sign);
    if (scratch.a.count == 0) return;
    cull(scratch.b, b.tile->triangle_count, b.triangle_boxes, a, reach, -sign);
    scratch.candidates = 0;
    for_each_meeting(scratch.a, scratch.b, false, reach, sign, [&](std::uint32_t vertex, std::uint32_t triangle) {
        const std::uint32_t p = a.particle[vertex];
        const std::uint32_t corner[3] = {b.tile->triangle[0][triangle], b.tile->triangle[1][triangle],
                                         b.tile->triangle[2][triangle]};
        if (p == b.particle[corner[0]] || p == b.particle[corner[1]] || p == b.particle[corner[2]]) return;
        const std::uint32_t at = scratch.candidates++;
        reserve_candidates(scratch, at);
        scratch.vertex[0][at] = vertex;
        scratch.particle[0][at] = a.tile->particle[vertex];
        for (int k = 0; k < 3; ++k) {
            scratch.vertex[1 + k][at] = corner[k];
            scratch.particle[1 + k][at] = b.tile->particle[corner[k]];
        }
    });
    list_candidates<PairKind::vertex_triangle>(a, b, reach, scratch, list);
}

inline void list_edge_edge(const TileState& a, const TileState& b, const TileReach& reach, SearchScratch& scratch,
                           PairList& list) {
    cull(scratch.a, a.tile->edge_count, a.edge_boxes, b, reach, 1);
    if (scratch.a.count == 0) return;
    cull(scratch.b, b.tile->edge_count, b.edge_boxes, a, reach, -1);
    scratch.candidates = 0;
    for_each_meeting(scratch.a, scratch.b, &a == &b, reach, 1, [&](std::uint32_t of_a, std::uint32_t of_b) {
        const std::uint32_t end[4] = {a.tile->edge[0][of_a], a.tile->edge[1][of_a], b.tile->edge[0][of_b],
                                      b.tile->edge[1][of_b]};
        const std::uint32_t p = a.particle[end[0]], q = a.particle[end[1]];
        const std::uint32_t r = b.particle[end[2]], s = b.particle[end[3]];
        if (p == r || p == s || q == r || q == s) return;
        const std::uint32_t at = scratch.candidates++;
        reserve_candidates(scratch, at);
        for (int k = 0; k < 4; ++k) {
            scratch.vertex[k][at] = end[k];
            scratch.particle[k][at] = (k < 2 ? a : b).tile->particle[end[k]];
        }
    });
    list_candidates<PairKind::edge_edge>(a, b, reach, scratch, list);
}

inline void list_pairs_of_tiles(const TileState& a, const TileState& b, const TileReach& reach,
                                SearchScratch& scratch, std::array<PairList, 2>& lists) {
    reserve_candidates(scratch, 0);
    list_vertex_triangle(a, b, reach, 1, scratch, lists[0]);
    if (&a != &b) list_vertex_triangle(b, a, reach, -1, scratch, lists[0]);
    list_edge_edge(a, b, reach, scratch, lists[1]);
}

constexpr SearchLoops search_loops{tile_deviation, bound_tile, list_pairs_of_tiles};
