// All constraints of a coarse level, solved by one workgroup in place of a dispatch per batch. The nodes stay in shared
// memory, and the numbers of the next batch are loaded before the barrier: a batch has few constraints, so its time is
// that of the loads and barriers which wait for one another.
#ifndef WEFT_LEVEL_LIMITS_GLSL
#define WEFT_LEVEL_LIMITS_GLSL

// Nodes that shared memory has room for. A larger level stays in device memory.
#ifdef WEFT_SHARED_NODES_ID
layout(constant_id = WEFT_SHARED_NODES_ID) const uint shared_nodes = 1u;
shared vec4 level_nodes[shared_nodes];
#else  // the memory of lines.glsl, which is in use only while lines are solved
#define shared_nodes shared_line_rows
#define level_nodes line_numbers
#endif

bool nodes_are_shared() { return level_limit_args.at.nodes <= shared_nodes; }

// A constraint of the level without its multiplier.
struct LevelRow {
    uint r;  // WEFT_NO_ROW: none
    uint a;
    uint b;
    CoarseLimitRow numbers;
};
#define WEFT_NO_ROW 0xffffffffu

LevelRow level_row(uint r)
{
    uint stride = level_limit_args.at.stride;
    return LevelRow(r, level_limit_args.at.particles.at[r], level_limit_args.at.particles.at[stride + r],
                    CoarseLimitRow(level_limit_args.at.fields.at[r], level_limit_args.at.fields.at[stride + r],
                                   level_limit_args.at.fields.at[2u * stride + r],
                                   level_limit_args.at.fields.at[3u * stride + r]));
}

// The row of invocation `me` in a batch, its first one if there are more rows than invocations.
LevelRow level_row_of(uint batch, uint me)
{
    uint begin = level_limit_args.at.batches.at[2u * batch], rows = level_limit_args.at.batches.at[2u * batch + 1u];
    bool mine = rows < WEFT_SERIAL_BATCH ? me < rows : me == 0u;
    if (!mine) return LevelRow(WEFT_NO_ROW, 0u, 0u, CoarseLimitRow(0.0, 0.0, 0.0, 0.0));
    return level_row(begin + me);
}

void project_level_row(LevelRow row, bool accumulates, Step h)
{
    bool in_shared = nodes_are_shared();
    vec4 a, b;
    if (in_shared) a = level_nodes[row.a], b = level_nodes[row.b];
    else a = level_limit_args.at.position.at[row.a], b = level_limit_args.at.position.at[row.b];
    vec3 x = a.xyz, y = b.xyz, left_x = vec3(0.0), left_y = vec3(0.0);
    h.apart = !is_none(uvec2(level_limit_args.at.remainder));
    if (h.apart) {
        left_x = level_limit_args.at.remainder.at[row.a].xyz, left_y = level_limit_args.at.remainder.at[row.b].xyz;
        x = vec3(0.0), y = (b.xyz - a.xyz) + (left_y - left_x);
    }
    float lambda = accumulates ? level_limit_args.at.lambda.at[row.r] : 0.0;
    project_coarse_limit(x, y, a.w, b.w, lambda, row.numbers, h);
    level_limit_args.at.lambda.at[row.r] = lambda;
    if (h.apart) {
        move_exactly(a.xyz, left_x, x), move_exactly(b.xyz, left_y, y);
        level_limit_args.at.remainder.at[row.a] = vec4(left_x, 0.0);
        level_limit_args.at.remainder.at[row.b] = vec4(left_y, 0.0);
        x = a.xyz, y = b.xyz;
    }
    if (in_shared) level_nodes[row.a] = vec4(x, a.w), level_nodes[row.b] = vec4(y, b.w);
    else level_limit_args.at.position.at[row.a] = vec4(x, a.w), level_limit_args.at.position.at[row.b] = vec4(y, b.w);
}

// Called by all invocations of a workgroup.
void run_level_limits()
{
    uint me = gl_LocalInvocationID.x, all = gl_WorkGroupSize.x;
    uint nodes = level_limit_args.at.nodes, batches = level_limit_args.at.batch_count;
    bool in_shared = nodes_are_shared();
    if (in_shared)
        for (uint i = me; i < nodes; i += all) level_nodes[i] = level_limit_args.at.position.at[i];
    Step h = substep_with(level_limit_args.at.frame, level_limit_args.at.limits);
    uint rounds = level_limit_args.at.sweeps * batches, batch = 0u;
    LevelRow next = level_row_of(0u, me);
    for (uint round = 0u; round < rounds; ++round) {
        LevelRow row = next;
        bool accumulates = round >= batches || level_limit_args.at.lambda_use == WEFT_LAMBDA_ACCUMULATE;
        uint begin = level_limit_args.at.batches.at[2u * batch], rows = level_limit_args.at.batches.at[2u * batch + 1u];
        batch = batch + 1u < batches ? batch + 1u : 0u;
        next = level_row_of(batch, me);
        if (in_shared && is_none(uvec2(level_limit_args.at.remainder))) shared_barrier();
        else workgroup_barrier();
        if (row.r == WEFT_NO_ROW) continue;
        bool serial = rows >= WEFT_SERIAL_BATCH;
        uint end = begin + (rows & ~WEFT_SERIAL_BATCH), step = serial ? 1u : all;
        for (uint r = row.r; r < end; r += step) {
            LevelRow ahead = row;
            if (r + step < end) ahead = level_row(r + step);
            project_level_row(row, accumulates, h);
            row = ahead;
        }
    }
    if (!in_shared) return;
    shared_barrier();
    for (uint i = me; i < nodes; i += all) level_limit_args.at.position.at[i] = level_nodes[i];
}

#endif
