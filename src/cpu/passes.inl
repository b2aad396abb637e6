// The loops, for whatever lanes the including namespace has. Included once per instruction set.

WEFT_FN Step make_step(float h) { return {real(h), real(1.0f / h), real(1.0f / h / h)}; }

WEFT_FN Motion load_motion(const ParticleView& p, std::size_t at, vec3& start) {
    Motion m;
    start = load_blocks(p.start + at, m.v_dropped.x);
    m.v = load_blocks(p.velocity + at, m.v_dropped.y);
    m.x_dropped = load_blocks(p.carry + at, m.v_dropped.z);
    return m;
}

WEFT_FN void store_motion(const Motion& m, const ParticleView& p, std::size_t at) {
    store_blocks(m.v, m.v_dropped.y, p.velocity + at);
    store_blocks(m.x_dropped, m.v_dropped.z, p.carry + at);
}

inline bool predict_pass(const ParticleView& p, Range range, Vec3 gravity, float max_speed, float h) {
    const Step step = make_step(h);
    const vec3 acceleration(real(gravity.x), real(gravity.y), real(gravity.z));
    mask capped = real(0.0f) > real(0.0f);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w;
        vec3 start, x = load_blocks(p.position + 4 * i, w);
        Motion m = load_motion(p, 4 * i, start);
        start = x;
        capped = capped || predict(x, m, w, acceleration, real(max_speed), step);
        store_blocks(x, w, p.position + 4 * i);
        store_blocks(start, m.v_dropped.x, p.start + 4 * i);
        store_motion(m, p, 4 * i);
    }
    return any(capped);
}

inline bool velocities_pass(const ParticleView& p, Range range, float max_speed, float h) {
    const Step step = make_step(h);
    mask capped = real(0.0f) > real(0.0f);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w;
        vec3 start;
        const vec3 x = load_blocks(p.position + 4 * i, w);
        Motion m = load_motion(p, 4 * i, start);
        capped = capped || update_velocity(m, x, start, w, real(max_speed), step);
        store_motion(m, p, 4 * i);
    }
    return any(capped);
}

#define WEFT_PARTICLES_2(v) v[0], v[1]
#define WEFT_PARTICLES_4(v) v[0], v[1], v[2], v[3]
#define WEFT_PARTICLES_6(v) v[0], v[1], v[2], v[3], v[4], v[5]
#define WEFT_LAMBDAS_1(v) v[0]
#define WEFT_LAMBDAS_3(v) v[0], v[1], v[2]
#define WEFT_LOAD_FIELD(field) row.field = load(next), next += stride;

// What the generic loops below need to know of a constraint.
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas)                                                                 \
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
        WEFT_FN static void damp(vec3* v, const vec3* x, const real* w, const Row& row, real viscous) {        \
            damp_##name(WEFT_PARTICLES_##particles(v), WEFT_PARTICLES_##particles(x), WEFT_PARTICLES_##particles(w), \
                        row, viscous);                                                                         \
        }                                                                                                      \
    };
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

template <class Traits, LambdaUse use>
inline void project_rows(const ParticleView& p, const RowView& rows, Range range, float h) {
    const Step step = make_step(h);
    for (std::size_t r = range.begin; r < range.end; r += lane_count) {
        vec3 x[Traits::arity];
        real w[Traits::arity];
        for (int k = 0; k < Traits::arity; ++k) {
            x[k] = gather_blocks(p.position, rows.particles + static_cast<std::size_t>(k) * rows.stride + r, w[k]);
        }
        real lambda[Traits::multipliers];
        for (int k = 0; k < Traits::multipliers; ++k) {
            lambda[k] = real(0.0f);
            if constexpr (use == LambdaUse::accumulate) {
                lambda[k] = load(rows.lambda + static_cast<std::size_t>(k) * rows.stride + r);
            }
        }
        Traits::project(x, w, lambda, Traits::load_row(rows.fields + r, rows.stride), step);
        for (int k = 0; use != LambdaUse::discard && k < Traits::multipliers; ++k) {
            store(lambda[k], rows.lambda + static_cast<std::size_t>(k) * rows.stride + r);
        }
        for (int k = 0; k < Traits::moves; ++k) {
            scatter_blocks(x[k], w[k], p.position, rows.particles + static_cast<std::size_t>(k) * rows.stride + r);
        }
    }
}

template <class Traits>
inline void project_pass(const ParticleView& p, const RowView& rows, Range range, float h, LambdaUse use) {
    switch (use) {
        case LambdaUse::discard: return project_rows<Traits, LambdaUse::discard>(p, rows, range, h);
        case LambdaUse::store: return project_rows<Traits, LambdaUse::store>(p, rows, range, h);
        case LambdaUse::accumulate: return project_rows<Traits, LambdaUse::accumulate>(p, rows, range, h);
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

WEFT_FN vec3 spread(Vec3 v) { return vec3(real(v.x), real(v.y), real(v.z)); }

WEFT_FN ContactBody make_body(const ContactView& c) {
    return {spread(c.now.rotation.x),    spread(c.now.rotation.y),    spread(c.now.rotation.z),
            spread(c.now.position),      spread(c.before.rotation.x), spread(c.before.rotation.y),
            spread(c.before.rotation.z), spread(c.before.position),   real(c.static_friction),
            real(c.kinetic_friction),    real(c.half_thickness),      real(c.depenetration)};
}

template <class Shape>
inline void contact_pass(const ParticleView& p, const ContactView& c, Range range) {
    const ContactBody body = make_body(c);
    const ShapeNumbers shape = {real(c.numbers[0]), real(c.numbers[1]), real(c.numbers[2]), real(c.numbers[3])};
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w, unused;
        vec3 x = load_blocks(p.position + 4 * i, w);
        ContactSum sum = {vec3(real(0.0f)), real(0.0f)};
        if (c.sums && !c.first_iteration) sum.friction = load_blocks(c.sums + 4 * i, sum.push);

        const vec3 local = to_body(body, x);
        vec3 normal;
        const real gap = Shape::distance(local, shape, normal) - body.half_thickness;
        // Most of a cloth touches nothing.
        if (any(gap < real(0.0f) || sum.push > real(0.0f))) {
            const vec3 start = load_blocks(p.start + 4 * i, unused);
            vec3 normal_at_start;
            const real gap_at_start =
                Shape::distance(to_body_at_start(body, start), shape, normal_at_start) - body.half_thickness;
            project_contact(x, start, w, sum, gap, gap_at_start, rotate(body.rx, body.ry, body.rz, normal),
                            carried_by(body, local), body);
            store_blocks(x, w, p.position + 4 * i);
        }
        if (c.sums) store_blocks(sum.friction, sum.push, c.sums + 4 * i);
    }
}

#define WEFT_SHAPE(name, Name)                                                      \
    struct Name##Shape {                                                            \
        WEFT_FN static real distance(vec3 p, const ShapeNumbers& shape, vec3& normal) { \
            return distance_##name(p, shape, normal);                               \
        }                                                                           \
    };
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE

inline void faces_pass(const SurfaceView& s, Range range) {
    for (std::size_t t = range.begin; t < range.end; t += lane_count) {
        real unused;
        const vec3 a = gather_blocks(s.position, s.faces + t, unused);
        const vec3 b = gather_blocks(s.position, s.faces + std::size_t{s.stride} + t, unused);
        const vec3 c = gather_blocks(s.position, s.faces + std::size_t{2} * s.stride + t, unused);
        store_blocks(face_normal(a, b, c), real(0.0f), s.face_normals + 4 * t);
    }
}

inline bool all_finite_pass(const float* data, std::size_t begin, std::size_t end) {
    const real limit = real(3.4028234e38f);
    mask bad = real(0.0f) > real(0.0f);
    for (std::size_t i = begin; i < end; i += lane_count) bad = bad || !(abs(load(data + i)) < limit);
    return !any(bad);
}

inline constexpr Passes make_passes(std::string_view isa) {
    return {
        .isa = isa,
        .lanes = lane_count,
        .predict = predict_pass,
        .velocities = velocities_pass,
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas) project_pass<Name##Traits>,
        .project = {
#include "physics/constraints.def"
        },
#undef WEFT_CONSTRAINT
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas) damp_pass<Name##Traits>,
        .damp = {
#include "physics/constraints.def"
        },
#undef WEFT_CONSTRAINT
#define WEFT_SHAPE(name, Name) contact_pass<Name##Shape>,
        .contact = {
#include "physics/contact/shapes.def"
        },
#undef WEFT_SHAPE
        .faces = faces_pass,
        .normals = normals_pass,
        .all_finite = all_finite_pass,
    };
}

#undef WEFT_PARTICLES_2
#undef WEFT_PARTICLES_4
#undef WEFT_PARTICLES_6
#undef WEFT_LAMBDAS_1
#undef WEFT_LAMBDAS_3
#undef WEFT_LOAD_FIELD
