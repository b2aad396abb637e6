// Line solve of stretch constraints: forward elimination along the line, then back substitution. All invocations of a
// workgroup compute the terms of the constraints and later move the particles. In between, one invocation per line
// eliminates and substitutes, on numbers in shared memory.
#ifndef WEFT_LINES_GLSL
#define WEFT_LINES_GLSL

// Number of constraints that shared memory has room for; 1: none, their numbers are in the scratch memory.
layout(constant_id = WEFT_LINE_ROWS_ID) const uint shared_line_rows = 1u;
// limit, couples, diagonal, right side; after elimination limit, couples, factor, g; after substitution delta lambda.
shared vec4 line_numbers[shared_line_rows];
shared float line_couplings[shared_line_rows];

// Blocks that are solved together.
struct LineRound {
    uint first;
    uint end;
    uint base;  // first row in shared memory
};

uint first_row_of(uint block) { return line_args.at.blocks.at[2u * block]; }
// Constraints of each of its lines.
uint length_of(uint block) { return line_args.at.blocks.at[2u * block + 1u] & ~WEFT_CUT_BLOCK; }
// Whether a line may end within the block, so that a constraint need not begin where the one before it ends.
bool is_cut(uint block) { return (line_args.at.blocks.at[2u * block + 1u] & WEFT_CUT_BLOCK) != 0u; }
uint row_after_block(uint block) { return first_row_of(block) + length_of(block) * WEFT_LANE_PADDING; }
// Whether row r continues the line of the row before it.
bool continues_line(uint r)
{
    return line_args.at.particles.at[r] == line_args.at.particles.at[line_args.at.stride + r - WEFT_LANE_PADDING];
}

vec4 line_number(LineRound round, uint r)
{
    if (shared_line_rows > 1u) return line_numbers[r - round.base];
    return line_args.at.scratch.at[line_args.at.stride + r];
}
void keep_number(LineRound round, uint r, vec4 number)
{
    if (shared_line_rows > 1u) line_numbers[r - round.base] = number;
    else line_args.at.scratch.at[line_args.at.stride + r] = number;
}
float line_coupling_of(LineRound round, uint r)
{
    if (shared_line_rows > 1u) return line_couplings[r - round.base];
    return line_args.at.scratch.at[r].w;
}

StretchRow line_row(uint r)
{
    uint stride = line_args.at.stride;
    return StretchRow(line_args.at.fields.at[r], line_args.at.fields.at[stride + r],
                      line_args.at.fields.at[2u * stride + r], line_args.at.fields.at[3u * stride + r]);
}

// Writes direction and weight to the scratch memory, where couple_row() of the next row reads them.
void begin_row(LineRound round, uint r, Step h)
{
    vec4 from = load_point(line_args.at.position, line_args.at.particles.at[r]);
    vec4 to = load_point(line_args.at.position, line_args.at.particles.at[line_args.at.stride + r]);
    float lambda = line_args.at.lambda_use == WEFT_LAMBDA_ACCUMULATE ? line_args.at.lambda.at[r] : 0.0;
    vec3 a = from.xyz, b = to.xyz;
    if (!is_none(uvec2(line_args.at.remainder))) {
        a = vec3(0.0);
        b = (to.xyz - from.xyz) + (line_args.at.remainder.at[line_args.at.particles.at[line_args.at.stride + r]].xyz -
                                   line_args.at.remainder.at[line_args.at.particles.at[r]].xyz);
    }
    LineTerms t = line_terms(a, b, from.w, to.w, lambda, line_row(r), h);
    line_args.at.scratch.at[r] = vec4(t.n, from.w);
    keep_number(round, r, vec4(t.limit, t.couples, t.diagonal, t.rhs));
}

void couple_row(LineRound round, uint r, bool first)
{
    vec4 mine = line_args.at.scratch.at[r];
    vec3 before = vec3(0.0);
    if (!first) before = line_args.at.scratch.at[r - WEFT_LANE_PADDING].xyz;
    float coupling = line_coupling(before, mine.xyz, mine.w);
    if (shared_line_rows > 1u) line_couplings[r - round.base] = coupling;
    else line_args.at.scratch.at[r].w = coupling;
}

// Loads the numbers of the next row one step ahead to hide latency. The writes of a step do not change these numbers.
void solve_line(LineRound round, uint begin, uint length)
{
    LineRow before = line_start();
    vec4 numbers = line_number(round, begin);
    float coupling = line_coupling_of(round, begin);
    for (uint k = 0u; k < length; ++k) {
        uint r = begin + k * WEFT_LANE_PADDING;
        uint ahead = min(k + 1u, length - 1u) * WEFT_LANE_PADDING + begin;
        vec4 next_numbers = line_number(round, ahead);
        float next_coupling = line_coupling_of(round, ahead);
        LineTerms t = LineTerms(vec3(0.0), numbers.w, numbers.z, numbers.y, numbers.x);
        LineRow now = eliminate_line(before, coupling, t);
        if (k > 0u)
            keep_number(round, r - WEFT_LANE_PADDING, vec4(before.limit, before.couples, before.factor, before.g));
        before = now;
        numbers = next_numbers, coupling = next_coupling;
    }
    float next = 0.0;
    numbers = vec4(before.limit, before.couples, 0.0, before.g);
    for (uint k = length; k-- > 0u;) {
        uint r = begin + k * WEFT_LANE_PADDING;
        vec4 next_numbers = line_number(round, k > 0u ? r - WEFT_LANE_PADDING : r);
        LineRow row = line_start();
        row.limit = numbers.x, row.factor = numbers.z, row.g = numbers.w;
        next = substitute_stretch(row, next);
        keep_number(round, r, vec4(next, 0.0, 0.0, 0.0));
        numbers = next_numbers;
    }
}

void pull_line_point(uint p, vec3 by)
{
    vec4 x = load_point(line_args.at.position, p);
    move_point(line_args.at.position, line_args.at.remainder, p, x, by * x.w);
}

// Each row moves its second particle. The first row of a line also moves its first particle.
void end_row(LineRound round, uint r, bool first, bool last)
{
    float change = line_number(round, r).x;
    if (line_args.at.lambda_use == WEFT_LAMBDA_STORE) line_args.at.lambda.at[r] = change;
    if (line_args.at.lambda_use == WEFT_LAMBDA_ACCUMULATE)
        line_args.at.lambda.at[r] = line_args.at.lambda.at[r] + change;
    uint from = line_args.at.particles.at[r], to = line_args.at.particles.at[line_args.at.stride + r];
    vec3 mine = line_args.at.scratch.at[r].xyz * change;
    vec3 pull = vec3(0.0);  // of the next row
    if (!last) pull = line_args.at.scratch.at[r + WEFT_LANE_PADDING].xyz * line_number(round, r + WEFT_LANE_PADDING).x;
    // Padding connects the end of a line to itself. The last real row moves that particle.
    if (from != to) {
        pull_line_point(to, pull - mine);
        if (first) pull_line_point(from, mine);
    }
}

// Called by all invocations of a workgroup.
void run_lines(LineRound round)
{
    uint me = gl_LocalInvocationID.x, all = gl_WorkGroupSize.x;
    Step h = substep_of(line_args.at.frame);
    for (uint b = round.first; b < round.end; ++b) {
        uint begin = first_row_of(b), rows = length_of(b) * WEFT_LANE_PADDING;
        for (uint i = me; i < rows; i += all) begin_row(round, begin + i, h);
    }
    workgroup_barrier();
    for (uint b = round.first; b < round.end; ++b) {
        uint begin = first_row_of(b), rows = length_of(b) * WEFT_LANE_PADDING;
        bool cut = is_cut(b);
        for (uint i = me; i < rows; i += all)
            couple_row(round, begin + i, i < WEFT_LANE_PADDING || (cut && !continues_line(begin + i)));
    }
    workgroup_barrier();
    for (uint i = me; i < (round.end - round.first) * WEFT_LANE_PADDING; i += all) {
        uint b = round.first + i / WEFT_LANE_PADDING;
        solve_line(round, first_row_of(b) + i % WEFT_LANE_PADDING, length_of(b));
    }
    workgroup_barrier();
    for (uint b = round.first; b < round.end; ++b) {
        uint begin = first_row_of(b), rows = length_of(b) * WEFT_LANE_PADDING;
        bool cut = is_cut(b);
        for (uint i = me; i < rows; i += all) {
            uint r = begin + i;
            bool first = i < WEFT_LANE_PADDING, last = i + WEFT_LANE_PADDING >= rows;
            if (cut) {
                first = first || !continues_line(r);
                last = last || !continues_line(r + WEFT_LANE_PADDING);
            }
            end_row(round, r, first, last);
        }
    }
}

#endif
