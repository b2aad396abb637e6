// Rows of stretch, a line to an invocation: elimination along the line, substitution back.
#ifndef WEFT_LINES_GLSL
#define WEFT_LINES_GLSL

StretchRow line_row(LineArgs a, uint r)
{
    return StretchRow(a.fields.at[r], a.fields.at[a.stride + r], a.fields.at[2u * a.stride + r]);
}

void run_lines(LineArgs a, uint i)
{
    uint block = i / WEFT_LINES_ABREAST, lane = i % WEFT_LINES_ABREAST;
    if (block >= a.count) return;
    uint begin = a.blocks.at[2u * block] + lane, length = a.blocks.at[2u * block + 1u];
    Step h = substep_of(a.frame);

    // What the way back needs of the way there: direction and g in the first part, factor and limit in the second.
    vec4 from = load_point(a.position, a.particles.at[begin]);
    LineRow before = line_start();
    for (uint k = 0u; k < length; ++k) {
        uint r = begin + k * WEFT_LINES_ABREAST;
        vec4 b = load_point(a.position, a.particles.at[a.stride + r]);
        float lambda = a.lambda_use == WEFT_LAMBDA_ACCUMULATE ? a.lambda.at[r] : 0.0;
        LineRow now = eliminate_stretch(before, from.xyz, b.xyz, from.w, b.w, lambda, line_row(a, r), h);
        if (k > 0u) a.scratch.at[a.stride + r - WEFT_LINES_ABREAST].x = before.factor;
        a.scratch.at[r] = vec4(now.n, now.g);
        a.scratch.at[a.stride + r] = vec4(0.0, now.limit, 0.0, 0.0);
        before = now;
        from = b;
    }

    vec3 pull = vec3(0.0);  // of the row behind
    float next = 0.0;
    for (uint k = length; k-- > 0u;) {
        uint r = begin + k * WEFT_LINES_ABREAST;
        vec4 kept = a.scratch.at[r];
        vec4 rest = a.scratch.at[a.stride + r];
        LineRow row = line_start();
        row.n = kept.xyz, row.g = kept.w, row.factor = rest.x, row.limit = rest.y;
        next = substitute_stretch(row, next);
        if (a.lambda_use == WEFT_LAMBDA_STORE) a.lambda.at[r] = next;
        if (a.lambda_use == WEFT_LAMBDA_ACCUMULATE) a.lambda.at[r] = a.lambda.at[r] + next;
        vec3 mine = row.n * next;
        uint second = a.particles.at[a.stride + r];
        vec4 x = load_point(a.position, second);
        store_point(a.position, second, vec4(x.xyz + (pull - mine) * x.w, x.w));
        pull = mine;
    }
    uint first = a.particles.at[begin];
    vec4 x = load_point(a.position, first);
    store_point(a.position, first, vec4(x.xyz + pull * x.w, x.w));
}

#endif
