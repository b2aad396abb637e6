// The loops of the search for pairs of particles, for the lanes of the including namespace. Include physics/kernels.inl
// before.

#include "collide/lane_bits.inl"

WEFT_FN vec3 load_place(const ListedTile::Axes& axes, std::uint32_t i) {
    return vec3(load(&axes[0][i]), load(&axes[1][i]), load(&axes[2][i]));
}
WEFT_FN vec3 one_place(const ListedTile::Axes& axes, std::uint32_t i) {
    return vec3(real(axes[0][i]), real(axes[1][i]), real(axes[2][i]));
}

// The particles of a tile within `reach` of a box moved by `shift`, as bits.
WEFT_FN std::uint64_t particles_near(const ListedTile& tile, const ParticleBox& box, Vec3 shift, float reach) {
    const vec3 low(real(box.low[0] + shift.x - reach), real(box.low[1] + shift.y - reach),
                   real(box.low[2] + shift.z - reach));
    const vec3 high(real(box.high[0] + shift.x + reach), real(box.high[1] + shift.y + reach),
                    real(box.high[2] + shift.z + reach));
    std::uint64_t near = 0;
    for (std::uint32_t i = 0; i < particle_tile; i += lane_count) {
        const vec3 x = load_place(tile.place, i);
        near |= std::uint64_t{bits_of(x.x > low.x && x.x < high.x && x.y > low.y && x.y < high.y && x.z > low.z && x.z < high.z)} << i;
    }
    return near;
}

// Appends the pairs that come within their diameter and the margin. `by_rest`: the diameter depends on the distance at
// rest. Returns the least distance beyond the diameter.
template <bool by_rest>
inline float list_near_pairs(const TilesToList& tiles, std::uint64_t near_one, std::uint64_t near_two,
                             ParticlePairs& pairs) {
    const ListedTile &one = *tiles.one, &two = *tiles.two;
    const real margin(tiles.margin), most(tiles.diameter + tiles.margin);
    const vec3 shift(real(tiles.shift.x), real(tiles.shift.y), real(tiles.shift.z));
    float least = std::numeric_limits<float>::infinity();
    for (std::uint64_t left = near_one; left != 0; left &= left - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
        const vec3 x = one_place(one.place, i) - shift;
        // Each pair within a tile once.
        const std::uint64_t others = &one == &two ? near_two & ~((std::uint64_t{2} << i) - 1) : near_two;
        for (std::uint32_t j = 0; j < particle_tile; j += lane_count) {
            std::uint32_t bits = static_cast<std::uint32_t>(others >> j) & ((1u << lane_count) - 1);
            if (bits == 0) continue;
            const vec3 between = x - load_place(two.place, j);
            const real distance2 = dot(between, between);
            bits &= bits_of(distance2 < most * most);
            if (bits == 0) continue;
            real diameter(tiles.diameter), limit = most;
            if (tiles.uneven) {
                diameter = (real(one.diameter[i]) + load(&two.diameter[j])) * real(0.5f);
                limit = diameter + margin;
            }
            if constexpr (by_rest) {
                const vec3 apart = one_place(one.rest, i) - load_place(two.rest, j);
                diameter = diameter_of_pair(diameter, sqrt(dot(apart, apart)), real(tiles.part_at_rest),
                                            real(tiles.less_at_rest));
                limit = select(diameter > real(0.0f), diameter + margin, real(0.0f));
            }
            bits &= bits_of(distance2 < limit * limit);
            if (bits == 0) continue;
            alignas(64) float diameters[16], spares[16];
            store(diameter, diameters), store(sqrt(distance2) - diameter, spares);
            for_each_bit(bits, [&](std::uint32_t lane) {
                const std::uint32_t at = pairs.count++;
                pairs.one[at] = one.particle[i];
                pairs.two[at] = two.particle[j + lane];
                pairs.diameter[at] = diameters[lane];
                least = spares[lane] < least ? spares[lane] : least;
            });
        }
    }
    return least;
}

inline float list_particle_pairs(const TilesToList& tiles, ParticlePairs& pairs) {
    const float reach = tiles.diameter + tiles.margin;
    const std::uint64_t near_one = particles_near(*tiles.one, tiles.two->box, tiles.shift, reach);
    if (near_one == 0) return std::numeric_limits<float>::infinity();
    const std::uint64_t near_two = particles_near(*tiles.two, tiles.one->box, -tiles.shift, reach);
    pairs.reserve(pairs.count + std::size_t{particle_tile} * particle_tile);
    return tiles.by_rest ? list_near_pairs<true>(tiles, near_one, near_two, pairs)
                         : list_near_pairs<false>(tiles, near_one, near_two, pairs);
}

inline std::uint32_t overlapping_boxes(const BoxGroup& group, const ParticleBox& box) {
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < boxes_together; i += lane_count) {
        const auto meets = [&](int k) {
            return load(&group.low[k][i]) < real(box.high[k]) && load(&group.high[k][i]) > real(box.low[k]);
        };
        bits |= bits_of(meets(0) && meets(1) && meets(2)) << i;
    }
    return bits;
}

constexpr ParticleSearchLoops particle_search_loops{list_particle_pairs, overlapping_boxes};
