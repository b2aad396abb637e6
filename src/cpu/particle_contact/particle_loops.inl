// The loops over pairs of particles, for the lanes of the including namespace. Include collide/particle_search.inl before.

inline void find_particle_overlaps(const ParticlePairs& pairs, std::uint32_t begin, std::uint32_t end, const float* positions,
                                   ParticlePairs& overlaps, std::uint32_t* pushes) {
    for (std::uint32_t i = begin; i < end; i += lane_count) {
        real w0, w1;
        const vec3 x0 = gather_blocks(positions, &pairs.one[i], w0), x1 = gather_blocks(positions, &pairs.two[i], w1);
        const std::uint32_t bits =
            bits_of(spheres_overlap(x0, x1, w0, w1, load(&pairs.diameter[i]))) & lanes_before(i, end);
        for_each_bit(bits, [&](std::uint32_t lane) {
            const std::uint32_t at = overlaps.count++;
            const std::uint32_t one = pairs.one[i + lane], two = pairs.two[i + lane];
            overlaps.one[at] = one, overlaps.two[at] = two;
            overlaps.diameter[at] = pairs.diameter[i + lane];
            ++pushes[one], ++pushes[two];
        });
    }
}

// The particles on one side of a packet of overlaps.
struct OverlapSide {
    vec3 x, start, friction;
    real w, pushes;

    WEFT_FN OverlapSide(const ParticleInput& in, const std::uint32_t* particles) {
        alignas(64) std::uint32_t block[16];
        alignas(64) float sums[16];
        for (int k = 0; k < lane_count; ++k) {
            block[k] = particles[k] / particle_block;
            std::uint32_t sum = 0;
            for (unsigned worker = 0; worker < in.workers; ++worker) sum += in.pushes[worker][particles[k]];
            sums[k] = static_cast<float>(sum);
        }
        real unused;
        x = gather_blocks(in.position, particles, w);
        start = gather_blocks(in.start, particles, unused);
        friction = gather_blocks(in.friction, block, unused);
        pushes = load(sums);
    }
};

// Adds a push to the sum of each lane's particle.
WEFT_FN void add_push(ParticleSum* sums, const std::uint32_t* particles, int count, vec3 push) {
    const real scale(static_cast<float>(WEFT_PUSH_QUANTA_PER_METER));
    alignas(64) float quanta[4 * 16];
    store_blocks(vec3(to_contact_quanta(push.x, scale), to_contact_quanta(push.y, scale), to_contact_quanta(push.z, scale)),
                 real(0.0f), quanta);
    for (int lane = 0; lane < count; ++lane) {
        ParticleSum& sum = sums[particles[lane]];
        for (int k = 0; k < 4; ++k) sum[k] += static_cast<std::uint32_t>(static_cast<std::int32_t>(quanta[4 * lane + k]));
    }
}

// The pairs of a packet that are nearer than the part `deep` of their diameter, as bits.
WEFT_FN std::uint32_t deep_pairs(const float* positions, const ParticlePairs& pairs, std::uint32_t i, float deep) {
    real unused;
    const vec3 between = gather_blocks(positions, &pairs.one[i], unused) - gather_blocks(positions, &pairs.two[i], unused);
    return bits_of(sqrt(dot(between, between)) < load(&pairs.diameter[i]) * real(deep)) & lanes_before(i, pairs.count);
}

inline void push_overlapping_particles(const ParticleInput& in, ParticleOverlaps& overlaps, ParticleSum* sums,
                                       std::uint8_t* pushed) {
    for (std::uint32_t i = 0; i < overlaps.count; i += lane_count) {
        const std::uint32_t deep = deep_pairs(in.position, overlaps, i, in.deep);
        if (deep == 0) continue;
        const OverlapSide a(in, &overlaps.one[i]), b(in, &overlaps.two[i]);
        const real resistance = sphere_resistance(a.w, a.pushes, real(in.split)) + sphere_resistance(b.w, b.pushes, real(in.split));
        const real diameter = load(&overlaps.diameter[i]);
        const SpherePush result =
            push_spheres(a.x, b.x, a.start, b.start, diameter, diameter * real(in.deep), real(in.recovery), resistance,
                         a.friction.x * b.friction.x, a.friction.y * b.friction.y);
        store(load(&overlaps.depth[i]) + result.depth, &overlaps.depth[i]);
        const int count = static_cast<int>(std::min<std::uint32_t>(lane_count, overlaps.count - i));
        add_push(sums, &overlaps.one[i], count, result.push * a.w);
        add_push(sums, &overlaps.two[i], count, result.push * -b.w);
        for_each_bit(deep, [&](std::uint32_t lane) {
            pushed[overlaps.one[i + lane] / particle_block] = 1, pushed[overlaps.two[i + lane] / particle_block] = 1;
        });
    }
}

inline void hold_overlapping_particles(const ParticleInput& in, const ParticleOverlaps& overlaps, ParticleSum* sums) {
    for (std::uint32_t i = 0; i < overlaps.count; i += lane_count) {
        const OverlapSide a(in, &overlaps.one[i]), b(in, &overlaps.two[i]);
        // Masses are split in full, so that this never takes more than the motion.
        const real resistance = sphere_resistance(a.w, a.pushes, real(1.0f)) + sphere_resistance(b.w, b.pushes, real(1.0f));
        const vec3 hold = hold_spheres(a.x, b.x, a.start, b.start, load(&overlaps.depth[i]), resistance);
        const int count = static_cast<int>(std::min<std::uint32_t>(lane_count, overlaps.count - i));
        add_push(sums, &overlaps.one[i], count, hold * a.w);
        add_push(sums, &overlaps.two[i], count, hold * -b.w);
    }
}

constexpr ParticleLoops particle_loops{particle_search_loops, find_particle_overlaps, push_overlapping_particles,
                                       hold_overlapping_particles};
