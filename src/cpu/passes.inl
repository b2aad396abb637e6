// The loops, for the lanes of the including namespace. Included once per instruction set.

WEFT_FN Step make_step(float h, const Limits& limits = {}) {
    Step step = step_without_limits(real(h), real(1.0f / h), real(1.0f / h / h));
    step.tension = real(limits.tension), step.allowed = real(limits.allowed);
    return step;
}

WEFT_FN Motion load_motion(const ParticleView& p, std::size_t at, vec3& start) {
    Motion m;
    start = load_blocks_unordered(p.start + at, m.v_dropped.x);
    m.v = load_blocks_unordered(p.velocity + at, m.v_dropped.y);
    m.x_dropped = load_blocks_unordered(p.compensation + at, m.v_dropped.z);
    return m;
}

WEFT_FN void store_motion(const Motion& m, const ParticleView& p, std::size_t at) {
    store_blocks_unordered(m.v, m.v_dropped.y, p.velocity + at);
    store_blocks_unordered(m.x_dropped, m.v_dropped.z, p.compensation + at);
}

// Which particle of a group stands in a lane after load_blocks_unordered().
constexpr std::size_t unordered_particle(std::size_t lane) {
    return lane_count < 4 ? lane : lane % 4 * (lane_count / 4) + lane / 4;
}

// Cloth near pins falls more slowly.
WEFT_FN vec3 felt_at(const ParticleView& p, std::size_t i, vec3 acceleration) {
    if (!p.steady_parts || !p.steadied[i / lane_padding]) return acceleration;
    alignas(64) float parts[16];
    for (std::size_t lane = 0; lane < lane_count; ++lane) parts[lane] = p.steady_parts[i + unordered_particle(lane)];
    return acceleration * load(parts);
}

inline bool predict_pass(const ParticleView& p, Range range, Vec3 gravity, float max_speed, float h) {
    const Step step = make_step(h);
    const vec3 acceleration(real(gravity.x), real(gravity.y), real(gravity.z));
    mask capped = real(0.0f) > real(0.0f);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w;
        vec3 start, x = load_blocks_unordered(p.position + 4 * i, w);
        Motion m = load_motion(p, 4 * i, start);
        start = x;
        const mask now = predict(x, m, w, felt_at(p, i, acceleration), real(max_speed), step);
        capped = capped || now;  // `now` is computed before, since || short-circuits on one lane
        store_blocks_unordered(x, w, p.position + 4 * i);
        store_blocks_unordered(start, m.v_dropped.x, p.start + 4 * i);
        store_motion(m, p, 4 * i);
    }
    return any(capped);
}

// The end of a substep. Leaves the remainders at zero.
WEFT_FN mask end_motion(const ParticleView& p, std::size_t i, Motion& m, vec3 x, vec3 start, real w, real max_speed,
                        const Step& step) {
    if (!p.remainder) return update_velocity(m, x, start, w, max_speed, step);
    real unused;
    const vec3 remainder = load_blocks_unordered(p.remainder + 4 * i, unused);
    store_blocks_unordered(vec3(real(0.0f)), real(0.0f), p.remainder + 4 * i);
    return update_velocity_exactly(m, x, remainder, start, w, max_speed, step);
}

inline bool velocities_pass(const ParticleView& p, Range range, float max_speed, float h) {
    const Step step = make_step(h);
    mask capped = real(0.0f) > real(0.0f);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w;
        vec3 start;
        const vec3 x = load_blocks_unordered(p.position + 4 * i, w);
        Motion m = load_motion(p, 4 * i, start);
        const mask now = end_motion(p, i, m, x, start, w, real(max_speed), step);
        capped = capped || now;
        if (p.remainder) store_blocks_unordered(start, m.v_dropped.x, p.start + 4 * i);
        store_motion(m, p, 4 * i);
    }
    return any(capped);
}

inline bool advance_pass(const ParticleView& p, Range range, Vec3 gravity, float max_speed, float h) {
    const Step step = make_step(h);
    const vec3 acceleration(real(gravity.x), real(gravity.y), real(gravity.z));
    mask capped = real(0.0f) > real(0.0f);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w;
        vec3 start, x = load_blocks_unordered(p.position + 4 * i, w);
        Motion m = load_motion(p, 4 * i, start);
        const mask ended = end_motion(p, i, m, x, start, w, real(max_speed), step);
        start = x;
        const mask begun = predict(x, m, w, felt_at(p, i, acceleration), real(max_speed), step);
        capped = capped || ended || begun;
        store_blocks_unordered(x, w, p.position + 4 * i);
        store_blocks_unordered(start, m.v_dropped.x, p.start + 4 * i);
        store_motion(m, p, 4 * i);
    }
    return any(capped);
}

#define WEFT_PARTICLES_1(v) v[0]
#define WEFT_PARTICLES_2(v) v[0], v[1]
#define WEFT_PARTICLES_3(v) v[0], v[1], v[2]
#define WEFT_PARTICLES_4(v) v[0], v[1], v[2], v[3]
#define WEFT_PARTICLES_6(v) v[0], v[1], v[2], v[3], v[4], v[5]
#define WEFT_LAMBDAS_1(v) v[0]
#define WEFT_LAMBDAS_3(v) v[0], v[1], v[2]
#define WEFT_UNROLL _Pragma("GCC unroll 8")  // keeps small arrays in registers
#define WEFT_LOAD_FIELD(field) row.field = load(next), next += stride;

// Describes a constraint to the generic loops below.
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping)                                                                 \
    struct Name##Traits {                                                                                      \
        static constexpr int arity = particles, moves = moved, multipliers = lambdas;                                                                \
        using Row = Name##Row;                                                                                 \
        WEFT_FN static Row load_row(const float* next, std::size_t stride) {                                   \
            Row row;                                                                                           \
            WEFT_ROW_##name(WEFT_LOAD_FIELD) return row;                                                       \
        }                                                                                                      \
        WEFT_FN static void project(vec3* x, const real* w, real* lambda, const Row& row, const Step& step) {  \
            project_##name(WEFT_PARTICLES_##particles(x), WEFT_PARTICLES_##particles(w),                        \
                           WEFT_LAMBDAS_##lambdas(lambda), row, step);                                         \
        }                                                                                                      \
        WEFT_IF_DAMPED_##damping(                                                                              \
        WEFT_FN static void damp(vec3* v, const vec3* x, const real* w, const Row& row, real viscous) {        \
            damp_##name(WEFT_PARTICLES_##particles(v), WEFT_PARTICLES_##particles(x), WEFT_PARTICLES_##particles(w), \
                        row, viscous);                                                                         \
        })                                                                                                     \
    };
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

// Particles of lane_count constraints.
template <class Traits>
struct Points {
    vec3 x[Traits::arity];
    real w[Traits::arity];
};

template <class Traits>
WEFT_FN void load_points(const ParticleView& p, const RowView& rows, std::size_t r, vec3* x, real* w) {
    WEFT_UNROLL
    for (int k = 0; k < Traits::arity; ++k) {
        x[k] = gather_blocks(p.position, rows.particles + static_cast<std::size_t>(k) * rows.stride + r, w[k]);
    }
}

template <class Traits>
WEFT_FN void store_points(const ParticleView& p, const RowView& rows, std::size_t r, const Points<Traits>& points) {
    WEFT_UNROLL
    for (int k = 0; k < Traits::moves; ++k) {
        scatter_blocks(points.x[k], points.w[k], p.position,
                       rows.particles + static_cast<std::size_t>(k) * rows.stride + r);
    }
}

// Particles of lane_count constraints, relative to the first one: numbers as small as the constraint, which round less.
template <class Traits>
struct NearPoints {
    vec3 place[Traits::arity], remainder[Traits::arity];
    Points<Traits> points;
};

WEFT_FN const std::uint32_t* particles_of(const RowView& rows, int k, std::size_t r) {
    return rows.particles + static_cast<std::size_t>(k) * rows.stride + r;
}

template <class Traits>
WEFT_FN void load_near_points(const ParticleView& p, const RowView& rows, std::size_t r, NearPoints<Traits>& near) {
    load_points<Traits>(p, rows, r, near.place, near.points.w);
    WEFT_UNROLL
    for (int k = 0; k < Traits::arity; ++k) {
        real unused;
        near.remainder[k] = gather_blocks(p.remainder, particles_of(rows, k, r), unused);
        near.points.x[k] = (near.place[k] - near.place[0]) + (near.remainder[k] - near.remainder[0]);
    }
}

template <class Traits>
WEFT_FN void store_near_points(const ParticleView& p, const RowView& rows, std::size_t r, NearPoints<Traits>& near) {
    WEFT_UNROLL
    for (int k = 0; k < Traits::moves; ++k) {
        move_exactly(near.place[k], near.remainder[k], near.points.x[k]);
        scatter_blocks(near.place[k], near.points.w[k], p.position, particles_of(rows, k, r));
        scatter_blocks(near.remainder[k], real(0.0f), p.remainder, particles_of(rows, k, r));
    }
}

WEFT_FN Step shifted(Step step, const RowView& rows, std::size_t r) {
    if (rows.shifts) {
        step.shift_c = load(rows.shifts + r);
        step.shift_d = load(rows.shifts + rows.stride + r);
    }
    return step;
}

template <class Traits, LambdaUse use>
WEFT_FN void project_points(const RowView& rows, std::size_t r, const Step& step, Points<Traits>& points) {
    real lambda[Traits::multipliers];
    for (int k = 0; k < Traits::multipliers; ++k) {
        lambda[k] = real(0.0f);
        if constexpr (use == LambdaUse::accumulate) {
            lambda[k] = load(rows.lambda + static_cast<std::size_t>(k) * rows.stride + r);
        }
    }
    Step now = shifted(step, rows, r);
    if (use != LambdaUse::accumulate) now.undone = real(WEFT_UNDONE_BY_FIRST_SWEEP);
    Traits::project(points.x, points.w, lambda, Traits::load_row(rows.fields + r, rows.stride), now);
    for (int k = 0; use != LambdaUse::discard && k < Traits::multipliers; ++k) {
        store(lambda[k], rows.lambda + static_cast<std::size_t>(k) * rows.stride + r);
    }
}

template <class Traits, LambdaUse use>
inline void project_rows(const ParticleView& p, const RowView& rows, Range range, float h) {
    if (range.begin == range.end) return;
    const Step step = make_step(h, rows.limits);
    Points<Traits> points, ahead;
    load_points<Traits>(p, rows, range.begin, points.x, points.w);
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        // One lane also runs the overflow, whose constraints share particles.
        if (lane_count == 1) load_points<Traits>(p, rows, r, points.x, points.w);
        project_points<Traits, use>(rows, r, step, points);
        // Loads the next particles before storing these: pending stores fill the processor's queues and delay loads
        // issued after them.
        const std::size_t next = std::min<std::size_t>(r + lane_count, range.end - lane_count);
        if (lane_count > 1) load_points<Traits>(p, rows, next, ahead.x, ahead.w);
        store_points<Traits>(p, rows, r, points);
        if (lane_count > 1) points = ahead;
    }
}

template <class Traits, LambdaUse use>
inline void project_rows_exactly(const ParticleView& p, const RowView& rows, Range range, float h) {
    Step step = make_step(h, rows.limits);
    step.apart = true;
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        NearPoints<Traits> near;
        load_near_points<Traits>(p, rows, r, near);
        project_points<Traits, use>(rows, r, step, near.points);
        store_near_points<Traits>(p, rows, r, near);
    }
}

template <class Traits>
inline void project_pass(const ParticleView& p, const RowView& rows, Range range, float h, LambdaUse use) {
    if (p.remainder) {
        switch (use) {
            case LambdaUse::discard: return project_rows_exactly<Traits, LambdaUse::discard>(p, rows, range, h);
            case LambdaUse::store: return project_rows_exactly<Traits, LambdaUse::store>(p, rows, range, h);
            case LambdaUse::accumulate: return project_rows_exactly<Traits, LambdaUse::accumulate>(p, rows, range, h);
        }
    }
    switch (use) {
        case LambdaUse::discard: return project_rows<Traits, LambdaUse::discard>(p, rows, range, h);
        case LambdaUse::store: return project_rows<Traits, LambdaUse::store>(p, rows, range, h);
        case LambdaUse::accumulate: return project_rows<Traits, LambdaUse::accumulate>(p, rows, range, h);
    }
}

#include "cpu/lines.inl"

// A step that makes every constraint rigid: 1/h² is 0, which removes all compliance.
WEFT_FN Step rigid_step(const Limits& limits) {
    Step step = step_without_limits(real(1e3f), real(1e-3f), real(0.0f));
    step.tension = real(limits.tension), step.allowed = real(limits.allowed);
    return step;
}

// Without compliance λ has the opposite sign of C: λ < 0 selects the stiffness for C > 0.
WEFT_FN real plain_part(real lambda, std::array<float, 2> stiffness) {
    return select(lambda < real(0.0f), real(stiffness[0]), real(stiffness[1]));
}

template <class Traits>
inline void project_plain_pass(const ParticleView& p, const RowView& rows, Range range, std::array<float, 2> stiffness) {
    const Step step = rigid_step(rows.limits);
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        vec3 x[Traits::arity], before[Traits::arity];
        real w[Traits::arity], lambda[Traits::multipliers];
        load_points<Traits>(p, rows, r, x, w);
        for (int k = 0; k < Traits::moves; ++k) before[k] = x[k];
        for (int k = 0; k < Traits::multipliers; ++k) lambda[k] = real(0.0f);
        Traits::project(x, w, lambda, Traits::load_row(rows.fields + r, rows.stride), step);
        const real part = plain_part(lambda[0], stiffness);
        for (int k = 0; k < Traits::moves; ++k) {
            scatter_blocks(before[k] + (x[k] - before[k]) * part, w[k], p.position,
                           rows.particles + static_cast<std::size_t>(k) * rows.stride + r);
        }
    }
}

template <class Traits, bool exact>
inline void correct_rows(const ParticleView& p, const RowView& rows, const CorrectionView& out, Range range, float h,
                         LambdaUse use) {
    Step step = out.share ? make_step(h, rows.limits) : rigid_step(rows.limits);
    step.apart = exact;
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        vec3 x[Traits::arity], before[Traits::arity];
        real w[Traits::arity];
        if (exact) {
            NearPoints<Traits> near;
            load_near_points<Traits>(p, rows, r, near);
            for (int k = 0; k < Traits::arity; ++k) x[k] = near.points.x[k], w[k] = near.points.w[k];
        } else {
            load_points<Traits>(p, rows, r, x, w);
        }
        for (int k = 0; k < Traits::moves; ++k) before[k] = x[k];
        real lambda[Traits::multipliers], lambda_before[Traits::multipliers];
        for (int k = 0; k < Traits::multipliers; ++k) {
            lambda[k] = real(0.0f);
            if (use == LambdaUse::accumulate) {
                lambda[k] = load(rows.lambda + static_cast<std::size_t>(k) * rows.stride + r);
            }
            lambda_before[k] = lambda[k];
        }
        Traits::project(x, w, lambda, Traits::load_row(rows.fields + r, rows.stride), shifted(step, rows, r));
        const real part = out.share ? load(out.share + r) : plain_part(lambda[0], out.stiffness);
        for (int k = 0; out.share && use != LambdaUse::discard && k < Traits::multipliers; ++k) {
            store(lambda_before[k] + (lambda[k] - lambda_before[k]) * part,
                  rows.lambda + static_cast<std::size_t>(k) * rows.stride + r);
        }
        for (int k = 0; k < Traits::moves; ++k) {
            store_blocks((exact ? x[k] : x[k] - before[k]) * part, real(0.0f),
                         out.blocks + 4 * (static_cast<std::size_t>(k) * rows.stride + r));
        }
    }
}

template <class Traits>
inline void correct_pass(const ParticleView& p, const RowView& rows, const CorrectionView& out, Range range, float h,
                         LambdaUse use) {
    if (p.remainder) return correct_rows<Traits, true>(p, rows, out, range, h, use);
    correct_rows<Traits, false>(p, rows, out, range, h, use);
}

template <class Node>
WEFT_FN vec3 interpolated(const ProlongationView& prolongation, const Node* nodes, std::size_t i) {
    vec3 sum(real(0.0f));
    for (std::size_t k = 0; k < Prolongation::parents; ++k) {
        real unused;
        const std::size_t at = k * prolongation.stride + i;
        sum = sum + gather_blocks(prolongation.displacement, nodes + at, unused) * load(prolongation.weight + at);
    }
    return sum;
}
WEFT_FN vec3 interpolated(const ProlongationView& prolongation, std::size_t i) {
    return prolongation.narrow ? interpolated(prolongation, prolongation.narrow, i) : interpolated(prolongation, prolongation.wide, i);
}

// `Heavy`: taut edges have made the particles heavier. The w of a finer node is then its ratio, as in LevelView.
template <bool Heavy>
inline void restrict_nodes(const float* finer, const LevelView& level, Range range) {
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        vec3 sum(real(0.0f));
        real ratio(0.0f);
        const std::size_t packet = i / lane_padding;
        for (std::size_t k = level.begin[packet]; k < level.begin[packet + 1]; ++k) {
            real w;
            const std::size_t at = k * lane_padding + i % lane_padding;
            const real part = load(level.weight + at);
            sum = sum + gather_blocks(finer, level.finer + at, w) * part;
            if (!Heavy) continue;
            if (level.particle_weight) w = mass_ratio(w, gather(level.particle_weight, level.finer + at));
            ratio = ratio + w * part;
        }
        store_blocks(sum, ratio, level.origin + 4 * i);
    }
}

inline void restriction_pass(const float* finer, const LevelView& level, Range range) {
    if (level.heavy) return restrict_nodes<true>(finer, level, range);
    restrict_nodes<false>(finer, level, range);
}

inline void interpolation_pass(const LevelView& level, const ProlongationView& prolongation, Range range) {
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real ratio;
        const vec3 x = load_blocks(level.origin + 4 * i, ratio);
        const real free = load(level.node_weight + i);
        const real w = level.heavy ? free / max(ratio, real(1.0f)) : free;
        const vec3 by = prolongation.displacement ? interpolated(prolongation, i) : vec3(real(0.0f));
        if (level.remainder) {
            vec3 moved = x, remainder(real(0.0f));
            move_exactly(moved, remainder, by);
            store_blocks(remainder, real(0.0f), level.remainder + 4 * i);
        }
        store_blocks(prolongation.displacement ? x + by : x, w, level.position + 4 * i);
    }
}

inline void node_correction_pass(const LevelView& level, Range range) {
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real unused;
        const vec3 now = load_blocks_unordered(level.position + 4 * i, unused);
        const vec3 before = load_blocks_unordered(level.origin + 4 * i, unused);
        vec3 moved = now - before;
        if (level.remainder) moved = moved + load_blocks_unordered(level.remainder + 4 * i, unused);
        store_blocks_unordered(moved, real(0.0f), level.displacement + 4 * i);
    }
}

inline void prolongation_pass(const ParticleView& p, const ProlongationView& prolongation, Range range) {
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w;
        vec3 x = load_blocks(p.position + 4 * i, w);
        // The hierarchy may be older than a pin, so pinned particles can still have weights.
        const real moves = select(w > real(0.0f), real(1.0f), real(0.0f));
        const vec3 by = interpolated(prolongation, i) * moves;
        if (p.remainder) {
            real unused;
            vec3 remainder = load_blocks(p.remainder + 4 * i, unused);
            move_exactly(x, remainder, by);
            store_blocks(remainder, real(0.0f), p.remainder + 4 * i);
        } else {
            x = x + by;
        }
        store_blocks(x, w, p.position + 4 * i);
    }
}

template <class Traits>
inline void damp_pass(const ParticleView& p, const RowView& rows, Range range, float viscous) {
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        vec3 x[Traits::arity], v[Traits::arity];
        real w[Traits::arity], dropped[Traits::arity];
        for (int k = 0; k < Traits::arity; ++k) {
            const std::uint32_t* index = rows.particles + static_cast<std::size_t>(k) * rows.stride + r;
            x[k] = gather_blocks(p.position, index, w[k]);
            v[k] = gather_blocks(p.velocity, index, dropped[k]);
        }
        Traits::damp(v, x, w, Traits::load_row(rows.fields + r, rows.stride), real(viscous));
        for (int k = 0; k < Traits::moves; ++k) {
            scatter_blocks(v[k], dropped[k], p.velocity,
                           rows.particles + static_cast<std::size_t>(k) * rows.stride + r);
        }
    }
}

inline void couple_pass(const RowView& rows, const CouplingView& coupling, Range range, float h) {
    const real inv_h2 = make_step(h).inv_h2;
    const std::size_t stride = rows.stride;
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        const auto number = [&](std::size_t k) { return load(coupling.numbers + k * stride + r); };
        const auto of_neighbor = [&](std::size_t k) {
            return -(gather(rows.lambda, coupling.rows + k * stride + r) * inv_h2);
        };
        const real moment = -(load(rows.lambda + r) * inv_h2), rate = number(6);
        for (std::size_t side = 0; side < 2; ++side) {
            float* const shift = rows.shifts + side * stride + r;
            store(shift_moment(load(shift), moment, of_neighbor(2 * side), of_neighbor(2 * side + 1), number(3 * side),
                               number(3 * side + 1), number(3 * side + 2), rate),
                  shift);
        }
    }
}

inline void weigh_taut_pass(const ParticleView& p, const RowView& rows, Range range, float h, float* taut) {
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        const std::uint32_t* index[2] = {rows.particles + r, rows.particles + rows.stride + r};
        vec3 moved[2];
        real unused;
        for (int k = 0; k < 2; ++k) moved[k] = gather_blocks(p.velocity, index[k], unused) * real(h);
        const real mass = taut_mass(StretchTraits::load_row(rows.fields + r, rows.stride), load(rows.lambda + r));
        for (int k = 0; k < 2; ++k) {
            TautSum sum;
            sum.moved = gather_blocks(taut, index[k], sum.mass);
            sum = add_taut_edge(sum, mass, moved[0], moved[1]);
            scatter_blocks(sum.moved, sum.mass, taut, index[k]);
        }
    }
}

// Leaves the sums at zero.
inline void take_taut_pass(const ParticleView& p, float* taut, Range range) {
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w, unused;
        TautSum sum;
        sum.moved = load_blocks_unordered(taut + 4 * i, sum.mass);
        vec3 x = load_blocks_unordered(p.position + 4 * i, w);
        take_taut_mass(x, w, load_blocks_unordered(p.start + 4 * i, unused), sum);
        store_blocks_unordered(x, w, p.position + 4 * i);
        store_blocks_unordered(vec3(real(0.0f)), real(0.0f), taut + 4 * i);
    }
}

WEFT_FN vec3 spread(Vec3 v) { return vec3(real(v.x), real(v.y), real(v.z)); }

#include "cpu/contact.inl"
#include "cpu/near.inl"

#include "cpu/wind.inl"

#include "cpu/tear.inl"

inline void air_pass(const AirView& air, Range range, float h) {
    const AirFabric fabric = {real(air.drag), real(air.lift), real(air.sine_lift ? 1.0f : 0.0f)};
    const real third = real(1.0f / 3.0f);
    for (std::size_t t = range.begin; t < range.end; t += lane_count) {
        const std::uint32_t* corner[3] = {air.faces + t, air.faces + std::size_t{air.stride} + t,
                                          air.faces + std::size_t{2} * air.stride + t};
        real unused;
        const vec3 a = gather_blocks(air.position, corner[0], unused);
        const vec3 b = gather_blocks(air.position, corner[1], unused);
        const vec3 c = gather_blocks(air.position, corner[2], unused);
        vec3 v = (gather_blocks(air.velocity, corner[0], unused) + gather_blocks(air.velocity, corner[1], unused) +
                  gather_blocks(air.velocity, corner[2], unused)) *
                 third;
        if (air.wind) v = v - load_blocks(air.wind + 4 * t, unused);
        const real mass = load(air.mass + t);
        const vec3 dv = air_velocity_change(v, face_normal(a, b, c), mass, fabric, real(h));
        store_blocks(dv * (mass * third), real(0.0f), air.impulse + 4 * t);
    }
}

inline void faces_pass(const SurfaceView& s, Range range) {
    for (std::size_t t = range.begin; t < range.end; t += lane_count) {
        real unused;
        const vec3 a = gather_blocks(s.position, s.faces + t, unused);
        const vec3 b = gather_blocks(s.position, s.faces + std::size_t{s.stride} + t, unused);
        const vec3 c = gather_blocks(s.position, s.faces + std::size_t{2} * s.stride + t, unused);
        store_blocks(face_normal(a, b, c), real(0.0f), s.face_normals + 4 * t);
    }
}

inline void smooth_faces_pass(const SurfaceView& s, Range range) {
    for (std::size_t t = range.begin; t < range.end; t += lane_count) {
        real unused;
        const vec3 face = load_blocks(s.face_normals + 4 * t, unused);
        const vec3 a = gather_blocks(s.normals, s.faces + t, unused);
        const vec3 b = gather_blocks(s.normals, s.faces + std::size_t{s.stride} + t, unused);
        const vec3 c = gather_blocks(s.normals, s.faces + std::size_t{2} * s.stride + t, unused);
        store_blocks(smooth_face(face, a, b, c), real(0.0f), s.face_normals + 4 * t);
    }
}

#include "cpu/around.inl"

inline bool all_finite_pass(const float* data, std::size_t begin, std::size_t end) {
    const real limit = real(3.4028234e38f);
    mask bad = real(0.0f) > real(0.0f);
    for (std::size_t i = begin; i < end; i += lane_count) bad = bad || !(abs(load(data + i)) < limit);
    return !any(bad);
}

inline constexpr Passes make_passes(std::string_view isa) {
    Passes passes{
        .isa = isa,
        .lanes = lane_count,
        .predict = predict_pass,
        .velocities = velocities_pass,
        .advance = advance_pass,
        .project = {},
        .project_plain = {},
        .lines = lines_pass,
        .correct = {},
        .average = average_pass,
        .restriction = restriction_pass,
        .interpolation = interpolation_pass,
        .node_correction = node_correction_pass,
        .prolongation = prolongation_pass,
        .damp = {},
        .couple = couple_pass,
        .weigh_taut = weigh_taut_pass,
        .take_taut = take_taut_pass,
        .first_outside = first_outside_pass,
#define WEFT_SHAPE(name, Name) contact_pass<Name##Shape, false>,
        .contact = {
#include "physics/contact/shapes.def"
        },
#undef WEFT_SHAPE
#define WEFT_SHAPE(name, Name) contact_pass<Name##Shape, true>,
        .contact_traced = {
#include "physics/contact/shapes.def"
        },
#undef WEFT_SHAPE
#define WEFT_SHAPE(name, Name) count_touches_pass<Name##Shape>,
        .count_touches = {
#include "physics/contact/shapes.def"
        },
#undef WEFT_SHAPE
        .first_near = first_near_pass,
#define WEFT_SHAPE(name, Name) find_support_pass<Name##Shape>,
        .find_support = {
#include "physics/contact/shapes.def"
        },
#undef WEFT_SHAPE
#define WEFT_SHAPE(name, Name) touch_body_pass<Name##Shape>,
        .touch_body = {
#include "physics/contact/shapes.def"
        },
#undef WEFT_SHAPE
        .longest_edge = longest_edge_pass,
        .measure_faces = measure_faces_pass,
        .near_faces = near_faces_pass,
#define WEFT_SHAPE(name, Name) find_faces_pass<Name##Shape>,
        .find_faces = {
#include "physics/contact/shapes.def"
        },
#undef WEFT_SHAPE
        .push_faces = push_faces_pass,
        .push_faces_of_body = push_faces_of_body_pass,
#define WEFT_WIND(name, Name) wind_pass<Name##Wind>,
        .wind = {
#include "physics/air/winds.def"
        },
#undef WEFT_WIND
        .shelter = shelter_pass,
        .add_sheltered = add_sheltered_pass,
        .air = air_pass,
        .push = push_around_pass,
        .watch_tears = watch_tears_pass,
        .faces = faces_pass,
        .smooth_faces = smooth_faces_pass,
        .normals = normals_around_pass,
        .all_finite = all_finite_pass,
    };
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping)                       \
    {                                                                                                 \
        constexpr auto kind = static_cast<std::uint32_t>(ConstraintKind::name);                       \
        passes.project[kind] = project_pass<Name##Traits>;                                            \
        WEFT_IF_PLAIN_##source(passes.project_plain[kind] = project_plain_pass<Name##Traits>;)        \
        WEFT_IF_SIDE_BY_SIDE_##source(passes.correct[kind] = correct_pass<Name##Traits>;)                 \
        WEFT_IF_DAMPED_##damping(passes.damp[kind] = damp_pass<Name##Traits>;)                        \
    }
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
    return passes;
}

#undef WEFT_PARTICLES_1
#undef WEFT_PARTICLES_2
#undef WEFT_PARTICLES_3
#undef WEFT_PARTICLES_4
#undef WEFT_PARTICLES_6
#undef WEFT_LAMBDAS_1
#undef WEFT_LAMBDAS_3
#undef WEFT_LOAD_FIELD
#undef WEFT_UNROLL
