// Passes over rows, for every constraint alike.
#ifndef WEFT_ROWS_GLSL
#define WEFT_ROWS_GLSL

#define WEFT_PARTICLES_2(v) v[0], v[1]
#define WEFT_PARTICLES_4(v) v[0], v[1], v[2], v[3]
#define WEFT_PARTICLES_6(v) v[0], v[1], v[2], v[3], v[4], v[5]
#define WEFT_LAMBDAS_1(v) v[0]
#define WEFT_LAMBDAS_3(v) v[0], v[1], v[2]
#define WEFT_LOAD_FIELD(field) row.field = a.at.fields.at[field_at], field_at += a.at.stride;

// Without compliance, lambda is what moved the particles, and its sign tells which way C was.
float plain_part(RowArgsRef a, float lambda) { return lambda < 0.0 ? a.at.plain_positive : a.at.plain_negative; }

// Whole numbers give the same sum in whatever order they come.
void add_quanta(Uints sums, uint p, vec3 change)
{
    for (uint axis = 0u; axis < 3u; ++axis) add_to_sum(sums, p, axis, uint(int(to_quanta(change[axis]))));
}

#define WEFT_CONSTRAINT(name, Name, arity, moved, lambdas)                                                             \
    Name##Row load_##name(RowArgsRef a, uint r)                                                                           \
    {                                                                                                                  \
        Name##Row row;                                                                                                 \
        uint field_at = r;                                                                                             \
        WEFT_ROW_##name(WEFT_LOAD_FIELD)                                                                               \
        return row;                                                                                                    \
    }                                                                                                                  \
    void project_row_##name(RowArgsRef a, uint r)                                                                         \
    {                                                                                                                  \
        uint p[arity];                                                                                                 \
        vec3 x[arity];                                                                                                 \
        float w[arity], lambda[lambdas];                                                                               \
        for (uint k = 0u; k < arity; ++k) {                                                                            \
            p[k] = a.at.particles.at[k * a.at.stride + r];                                                                   \
            vec4 point = load_point(a.at.position, p[k]);                                                                 \
            x[k] = point.xyz, w[k] = point.w;                                                                          \
        }                                                                                                              \
        for (uint k = 0u; k < lambdas; ++k)                                                                            \
            lambda[k] = a.at.lambda_use == WEFT_LAMBDA_ACCUMULATE ? a.at.lambda.at[k * a.at.stride + r] : 0.0;                  \
        project_##name(WEFT_PARTICLES_##arity(x), WEFT_PARTICLES_##arity(w), WEFT_LAMBDAS_##lambdas(lambda),           \
                       load_##name(a, r), substep_with(a.at.frame, a.at.limits));                                            \
        if (a.at.lambda_use != WEFT_LAMBDA_DISCARD)                                                                       \
            for (uint k = 0u; k < lambdas; ++k) a.at.lambda.at[k * a.at.stride + r] = lambda[k];                             \
        for (uint k = 0u; k < moved; ++k) store_point(a.at.position, p[k], vec4(x[k], w[k]));                             \
    }                                                                                                                  \
    /* What the row wants of its particles. */                                                                         \
    void correct_row_##name(RowArgsRef a, uint r, out uint p[arity], out vec3 change[arity], out float w[arity])          \
    {                                                                                                                  \
        vec3 x[arity], before[arity];                                                                                  \
        float lambda[lambdas], lambda_before[lambdas];                                                                 \
        for (uint k = 0u; k < arity; ++k) {                                                                            \
            p[k] = a.at.particles.at[k * a.at.stride + r];                                                                   \
            vec4 point = load_point(a.at.position, p[k]);                                                                 \
            x[k] = point.xyz, before[k] = point.xyz, w[k] = point.w;                                                   \
        }                                                                                                              \
        bool plain = is_none(uvec2(a.at.share));                                                                          \
        for (uint k = 0u; k < lambdas; ++k) {                                                                          \
            lambda[k] = !plain && a.at.lambda_use == WEFT_LAMBDA_ACCUMULATE ? a.at.lambda.at[k * a.at.stride + r] : 0.0;        \
            lambda_before[k] = lambda[k];                                                                              \
        }                                                                                                              \
        Step h = rigid_step(a.at.limits);                                                                                 \
        if (!plain) h = substep_with(a.at.frame, a.at.limits);                                                               \
        project_##name(WEFT_PARTICLES_##arity(x), WEFT_PARTICLES_##arity(w), WEFT_LAMBDAS_##lambdas(lambda),           \
                       load_##name(a, r), h);                                                                          \
        float part = plain_part(a, lambda[0]);                                                                         \
        if (!plain) part = a.at.share.at[r];                                                                              \
        if (!plain && a.at.lambda_use != WEFT_LAMBDA_DISCARD)                                                             \
            for (uint k = 0u; k < lambdas; ++k)                                                                        \
                a.at.lambda.at[k * a.at.stride + r] = lambda_before[k] + (lambda[k] - lambda_before[k]) * part;              \
        for (uint k = 0u; k < arity; ++k) change[k] = (x[k] - before[k]) * part;                                       \
    }                                                                                                                  \
    void plain_row_##name(RowArgsRef a, uint r)                                                                           \
    {                                                                                                                  \
        uint p[arity];                                                                                                 \
        vec3 change[arity];                                                                                            \
        float w[arity];                                                                                                \
        correct_row_##name(a, r, p, change, w);                                                                        \
        vec3 before[moved];                                                                                            \
        for (uint k = 0u; k < moved; ++k) before[k] = load_point(a.at.position, p[k]).xyz;                                \
        for (uint k = 0u; k < moved; ++k) store_point(a.at.position, p[k], vec4(before[k] + change[k], w[k]));            \
    }                                                                                                                  \
    void side_by_side_row_##name(RowArgsRef a, uint r)                                                                    \
    {                                                                                                                  \
        uint p[arity];                                                                                                 \
        vec3 change[arity];                                                                                            \
        float w[arity];                                                                                                \
        correct_row_##name(a, r, p, change, w);                                                                        \
        if (is_none(uvec2(a.at.sums))) {                                                                                  \
            for (uint k = 0u; k < moved; ++k) a.at.corrections.at[k * a.at.stride + r] = vec4(change[k], 0.0);               \
        } else {                                                                                                       \
            for (uint k = 0u; k < moved; ++k) {                                                                        \
                /* Of a particle that a row names twice, the last one counts (solver/model/jacobi.cpp). */                   \
                bool counts = p[0] != p[1];                                                                            \
                for (uint later = k + 1u; later < moved; ++later) counts = counts && p[later] != p[k];                 \
                if (counts) add_quanta(a.at.sums, p[k], change[k]);                                                       \
            }                                                                                                          \
        }                                                                                                              \
    }                                                                                                                  \
    void damp_row_##name(RowArgsRef a, uint r)                                                                            \
    {                                                                                                                  \
        uint p[arity];                                                                                                 \
        vec3 x[arity], v[arity];                                                                                       \
        float w[arity], dropped[arity];                                                                                \
        for (uint k = 0u; k < arity; ++k) {                                                                            \
            p[k] = a.at.particles.at[k * a.at.stride + r];                                                                   \
            vec4 point = load_point(a.at.position, p[k]), speed = a.at.velocity.at[p[k]];                                    \
            x[k] = point.xyz, w[k] = point.w, v[k] = speed.xyz, dropped[k] = speed.w;                                  \
        }                                                                                                              \
        damp_##name(WEFT_PARTICLES_##arity(v), WEFT_PARTICLES_##arity(x), WEFT_PARTICLES_##arity(w),                   \
                    load_##name(a, r), a.at.frame.at.viscous);                                                            \
        for (uint k = 0u; k < moved; ++k) a.at.velocity.at[p[k]] = vec4(v[k], dropped[k]);                                \
    }
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT

// The rows of an invocation: `count` of them, from `row` on, `stride` apart.
struct RowRange {
    uint row;
    uint count;
    uint stride;
};

RowRange rows_of(RowArgsRef a, uint i)
{
    if (a.at.hand_out == WEFT_ROWS_SERIAL) return RowRange(a.at.begin, i == 0u ? a.at.count : 0u, 1u);
    if (a.at.hand_out == WEFT_ROWS_LINES) {
        uint block = i / WEFT_LANE_PADDING;
        if (block >= a.at.count) return RowRange(0u, 0u, 1u);
        return RowRange(a.at.blocks.at[2u * block] + i % WEFT_LANE_PADDING, a.at.blocks.at[2u * block + 1u],
                        WEFT_LANE_PADDING);
    }
    return RowRange(a.at.begin + i, i < a.at.count ? 1u : 0u, 1u);
}

#endif
