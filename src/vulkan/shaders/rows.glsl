// Passes over constraints, for all kinds.
#ifndef WEFT_ROWS_GLSL
#define WEFT_ROWS_GLSL

#define WEFT_PARTICLES_1(v) v[0]
#define WEFT_PARTICLES_2(v) v[0], v[1]
#define WEFT_PARTICLES_3(v) v[0], v[1], v[2]
#define WEFT_PARTICLES_4(v) v[0], v[1], v[2], v[3]
#define WEFT_PARTICLES_6(v) v[0], v[1], v[2], v[3], v[4], v[5]
#define WEFT_LAMBDAS_1(v) v[0]
#define WEFT_LAMBDAS_3(v) v[0], v[1], v[2]
#define WEFT_LOAD_FIELD(field) row.field = row_args.at.fields.at[field_at], field_at += row_args.at.stride;

// Without compliance, the sign of lambda is opposite to that of C.
float plain_part(float lambda) { return lambda < 0.0 ? row_args.at.plain_positive : row_args.at.plain_negative; }

uint use_of_lambda() { return row_args.at.modes & WEFT_LAMBDA_MODES; }

// Lambda from the previous iterations.
float lambda_before(uint multiplier, uint r)
{
    if (use_of_lambda() != WEFT_LAMBDA_ACCUMULATE) return 0.0;
    return row_args.at.lambda.at[multiplier * row_args.at.stride + r];
}

Step shifted(Step h, uint r)
{
    if (!is_none(uvec2(row_args.at.shifts))) {
        h.shift_c = row_args.at.shifts.at[r];
        h.shift_d = row_args.at.shifts.at[row_args.at.stride + r];
    }
    return h;
}

// Sums of integers do not depend on the order.
void add_quanta(Uints sums, uint p, vec3 change)
{
    for (uint axis = 0u; axis < 3u; ++axis) add_to_sum(sums, p, axis, uint(int(to_quanta(change[axis]))));
}

// Whether rows compute with places relative to their first particle, which round less.
bool keeps_remainders() { return !is_none(uvec2(row_args.at.moves)); }

#define WEFT_RELATIVE_TO_FIRST(arity)                                                                          \
    if (keeps_remainders()) {                                                                                  \
        for (uint k = 0u; k < arity; ++k) remainder[k] = row_args.at.moves.at[p[k]].xyz;                       \
        for (uint k = 0u; k < arity; ++k) x[k] = (place[k] - place[0]) + (remainder[k] - remainder[0]);        \
    }

#define WEFT_PROJECT_ROW(name, Name, arity, moved, lambdas)                                                    \
    Name##Row load_##name(uint r)                                                                              \
    {                                                                                                          \
        Name##Row row;                                                                                         \
        uint field_at = r;                                                                                     \
        WEFT_ROW_##name(WEFT_LOAD_FIELD)                                                                       \
        return row;                                                                                            \
    }                                                                                                          \
    void project_row_##name(uint r)                                                                            \
    {                                                                                                          \
        uint p[arity];                                                                                         \
        vec3 x[arity], place[arity], remainder[arity];                                                         \
        float w[arity], lambda[lambdas];                                                                       \
        for (uint k = 0u; k < arity; ++k) {                                                                    \
            p[k] = row_args.at.particles.at[k * row_args.at.stride + r];                                       \
            vec4 point = load_point(row_args.at.position, p[k]);                                               \
            x[k] = point.xyz, place[k] = point.xyz, w[k] = point.w;                                            \
        }                                                                                                      \
        WEFT_RELATIVE_TO_FIRST(arity)                                                                          \
        for (uint k = 0u; k < lambdas; ++k)                                                                    \
            lambda[k] = lambda_before(k, r);                                                                   \
        Step h = shifted(substep_with(row_args.at.frame, row_args.at.limits), r);                              \
        if (use_of_lambda() != WEFT_LAMBDA_ACCUMULATE) h.undone = WEFT_UNDONE_BY_FIRST_SWEEP;                  \
        h.apart = keeps_remainders();                                                                          \
        project_##name(WEFT_PARTICLES_##arity(x), WEFT_PARTICLES_##arity(w), WEFT_LAMBDAS_##lambdas(lambda),   \
                       load_##name(r), h);                                                                     \
        if (use_of_lambda() != WEFT_LAMBDA_DISCARD)                                                            \
            for (uint k = 0u; k < lambdas; ++k) row_args.at.lambda.at[k * row_args.at.stride + r] = lambda[k]; \
        for (uint k = 0u; k < moved; ++k) {                                                                    \
            if (h.apart) {                                                                                     \
                move_exactly(place[k], remainder[k], x[k]);                                                    \
                row_args.at.moves.at[p[k]] = vec4(remainder[k], 0.0);                                          \
                x[k] = place[k];                                                                               \
            }                                                                                                  \
            store_point(row_args.at.position, p[k], vec4(x[k], w[k]));                                         \
        }                                                                                                      \
    }

// Computes the constraint's correction of its particles without moving them.
#define WEFT_CORRECT_ROW(name, arity, lambdas)                                                                        \
    void correct_row_##name(uint r, out uint p[arity], out vec3 change[arity], out float w[arity])                    \
    {                                                                                                                 \
        vec3 x[arity], place[arity], remainder[arity];                                                                \
        float lambda[lambdas], before_it[lambdas];                                                                    \
        for (uint k = 0u; k < arity; ++k) {                                                                           \
            p[k] = row_args.at.particles.at[k * row_args.at.stride + r];                                              \
            vec4 point = load_point(row_args.at.position, p[k]);                                                      \
            x[k] = point.xyz, place[k] = point.xyz, w[k] = point.w;                                                   \
        }                                                                                                             \
        WEFT_RELATIVE_TO_FIRST(arity)                                                                                 \
        bool plain = is_none(uvec2(row_args.at.share));                                                               \
        for (uint k = 0u; k < lambdas; ++k) {                                                                         \
            lambda[k] = plain ? 0.0 : lambda_before(k, r);                                                            \
            before_it[k] = lambda[k];                                                                                 \
        }                                                                                                             \
        Step h = rigid_step(row_args.at.limits);                                                                      \
        if (!plain) h = shifted(substep_with(row_args.at.frame, row_args.at.limits), r);                              \
        h.apart = keeps_remainders();                                                                                 \
        project_##name(WEFT_PARTICLES_##arity(x), WEFT_PARTICLES_##arity(w), WEFT_LAMBDAS_##lambdas(lambda),          \
                       load_##name(r), h);                                                                            \
        float part = plain_part(lambda[0]);                                                                           \
        if (!plain) part = row_args.at.share.at[r];                                                                   \
        if (!plain && use_of_lambda() != WEFT_LAMBDA_DISCARD)                                                         \
            for (uint k = 0u; k < lambdas; ++k)                                                                       \
                row_args.at.lambda.at[k * row_args.at.stride + r] = before_it[k] + (lambda[k] - before_it[k]) * part; \
        for (uint k = 0u; k < arity; ++k) change[k] = (h.apart ? x[k] : x[k] - place[k]) * part;                      \
    }

#define WEFT_PLAIN_ROW(name, arity, moved)                                                        \
    void plain_row_##name(uint r)                                                                 \
    {                                                                                             \
        uint p[arity];                                                                            \
        vec3 change[arity];                                                                       \
        float w[arity];                                                                           \
        correct_row_##name(r, p, change, w);                                                      \
        vec3 before[moved];                                                                       \
        for (uint k = 0u; k < moved; ++k) before[k] = load_point(row_args.at.position, p[k]).xyz; \
        for (uint k = 0u; k < moved; ++k)                                                         \
            store_point(row_args.at.position, p[k], vec4(before[k] + change[k], w[k]));           \
    }

#define WEFT_SIDE_BY_SIDE_ROW(name, arity, moved)                                                          \
    void side_by_side_row_##name(uint r)                                                                   \
    {                                                                                                      \
        uint p[arity];                                                                                     \
        vec3 change[arity];                                                                                \
        float w[arity];                                                                                    \
        correct_row_##name(r, p, change, w);                                                               \
        if (is_none(uvec2(row_args.at.sums))) {                                                            \
            for (uint k = 0u; k < moved; ++k)                                                              \
                row_args.at.corrections.at[k * row_args.at.stride + r] = vec4(change[k], 0.0);             \
        } else {                                                                                           \
            for (uint k = 0u; k < moved; ++k) {                                                            \
                /* If a row has a particle twice, the last entry counts (solver/model/jacobi.cpp). */      \
                bool counts = arity == 1 || p[0] != p[min(1, arity - 1)];                                  \
                for (uint later = k + 1u; later < moved; ++later) counts = counts && p[later] != p[k];     \
                if (counts) add_quanta(row_args.at.sums, p[k], change[k]);                                 \
            }                                                                                              \
        }                                                                                                  \
    }

#define WEFT_DAMP_ROW_damped(name, arity, moved)                                                        \
    void damp_row_##name(uint r)                                                                        \
    {                                                                                                   \
        uint p[arity];                                                                                  \
        vec3 x[arity], v[arity];                                                                        \
        float w[arity], dropped[arity];                                                                 \
        for (uint k = 0u; k < arity; ++k) {                                                             \
            p[k] = row_args.at.particles.at[k * row_args.at.stride + r];                                \
            vec4 point = load_point(row_args.at.position, p[k]), speed = row_args.at.moves.at[p[k]];    \
            x[k] = point.xyz, w[k] = point.w, v[k] = speed.xyz, dropped[k] = speed.w;                   \
        }                                                                                               \
        damp_##name(WEFT_PARTICLES_##arity(v), WEFT_PARTICLES_##arity(x), WEFT_PARTICLES_##arity(w),    \
                    load_##name(r), row_args.at.frame.at.viscous);                                      \
        for (uint k = 0u; k < moved; ++k) row_args.at.moves.at[p[k]] = vec4(v[k], dropped[k]);          \
    }
#define WEFT_DAMP_ROW_undamped(name, arity, moved)

// Macros by the source of the constraints (constraints.def).
#define WEFT_ROWS_OF_MODEL(name, arity, moved, lambdas) \
    WEFT_CORRECT_ROW(name, arity, lambdas)              \
    WEFT_PLAIN_ROW(name, arity, moved)                  \
    WEFT_SIDE_BY_SIDE_ROW(name, arity, moved)
#define WEFT_ROWS_fabric(name, arity, moved, lambdas) WEFT_ROWS_OF_MODEL(name, arity, moved, lambdas)
#define WEFT_ROWS_pins(name, arity, moved, lambdas) WEFT_ROWS_OF_MODEL(name, arity, moved, lambdas)
#define WEFT_ROWS_level(name, arity, moved, lambdas)
#define WEFT_ROWS_links(name, arity, moved, lambdas) \
    WEFT_CORRECT_ROW(name, arity, lambdas)           \
    WEFT_PLAIN_ROW(name, arity, moved)
#define WEFT_ROWS_dynamic(name, arity, moved, lambdas) \
    WEFT_CORRECT_ROW(name, arity, lambdas)             \
    WEFT_SIDE_BY_SIDE_ROW(name, arity, moved)

#define WEFT_CONSTRAINT(name, Name, arity, moved, lambdas, source, damping) \
    WEFT_PROJECT_ROW(name, Name, arity, moved, lambdas)                     \
    WEFT_ROWS_##source(name, arity, moved, lambdas)                         \
    WEFT_DAMP_ROW_##damping(name, arity, moved)
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

// Adds the masses of a taut edge to the sums of its ends. The sums stand in the place of the corrections.
void weigh_taut_row(uint r)
{
    uint p[2];
    vec3 moved[2];
    Step step = substep_of(row_args.at.frame);
    for (uint k = 0u; k < 2u; ++k) {
        p[k] = row_args.at.particles.at[k * row_args.at.stride + r];
        moved[k] = row_args.at.moves.at[p[k]].xyz * step.h;
    }
    float mass = taut_mass(load_stretch(r), row_args.at.lambda.at[r]);
    for (uint k = 0u; k < 2u; ++k) {
        vec4 before = row_args.at.corrections.at[p[k]];
        TautSum sum = add_taut_edge(TautSum(before.xyz, before.w), mass, moved[0], moved[1]);
        row_args.at.corrections.at[p[k]] = vec4(sum.moved, sum.mass);
    }
}

// The rows of an invocation: `count` rows from `row` on, `stride` apart.
struct RowRange {
    uint row;
    uint count;
    uint stride;
};

RowRange rows_of(uint i)
{
    uint hand_out = row_args.at.modes & WEFT_ROWS_MODES;
    if (hand_out == WEFT_ROWS_SERIAL)
        return RowRange(row_args.at.begin, i == 0u ? row_args.at.count : 0u, 1u);
    if (hand_out == WEFT_ROWS_LINES) {
        uint block = i / WEFT_LANE_PADDING;
        if (block >= row_args.at.count) return RowRange(0u, 0u, 1u);
        return RowRange(row_args.at.blocks.at[2u * block] + i % WEFT_LANE_PADDING,
                        row_args.at.blocks.at[2u * block + 1u] & ~WEFT_CUT_BLOCK, WEFT_LANE_PADDING);
    }
    return RowRange(row_args.at.begin + i, i < row_args.at.count ? 1u : 0u, 1u);
}

#endif
