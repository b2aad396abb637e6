// Rows of stretch that follow one another along a line, solved together. (line.md)
//
// Row k of a line holds its points k and k + 1. Neighboring rows share a point and nothing else, so the system of one
// Newton step is tridiagonal: elimination runs along the line, substitution comes back.

// What elimination leaves of a row.
struct LineRow {
    vec3 n;          // from the second point to the first, unit; 0 if there is no direction
    real g;          // delta lambda where the next row's is 0
    real factor;     // minus its change with the next row's
    real limit;      // of |delta lambda|
    // Only for the next row:
    real inverse;    // of the pivot
    real couples;    // 1; 0 for a row that does not depend on its neighbors
};

// A line that is taut between two pins has no exact solution, and nearly none when it is almost straight. This much of
// the weights on the diagonal keeps pivots away from 0; it takes as little from the longest waves only.
#define WEFT_LINE_REGULARIZATION 1e-4

// A row gives at least as the part of its length does that it is out by, up to this. A line pulled longer than its rows
// then settles to a bounded tension, the same in each, and rows near to one another still share out how they differ.
#define WEFT_LINE_GIVE 0.1

// A tension moves the points of a kinked line sideways, and more than to the straight line if it is large for the time
// step: the line would swing about. Up to this part of the rest length per weight it does not.
#define WEFT_LINE_PULL 0.5

WEFT_FN LineRow line_start()
{
    LineRow none;
    none.n = vec3(real(0), real(0), real(0));
    none.g = real(0);
    none.factor = real(0);
    none.limit = real(0);
    none.inverse = real(0);
    none.couples = real(0);
    return none;
}

// What a row brings to its line's system, for itself.
struct LineTerms {
    vec3 n;          // as LineRow has it
    real rhs;
    real diagonal;
    real couples;
    real limit;
};

WEFT_FN LineTerms line_terms(vec3 a, vec3 b, real wa, real wb, real lambda, StretchRow row, Step step)
{
    StretchState state = measure_stretch(a, b, row, step);
    real w = wa + wb;
    mask able = w > real(0) && state.len2 > real(1e-20);
    mask stiff = able && !state.slack;

    real rhs = select(state.slack, -lambda, -(state.c + state.alpha * lambda));
    real excess = min(real(WEFT_LINE_GIVE), abs(state.c) / max(row.rest, real(1e-30)));
    LineTerms t;
    t.rhs = select(able, rhs, real(0));
    t.diagonal = select(stiff, w + w * real(WEFT_LINE_REGULARIZATION) + max(state.alpha, w * excess), real(1));
    t.couples = select(stiff, real(1), real(0));
    t.n = state.d * select(able, real(1) / state.len, real(0));
    // Never less than the row alone would take.
    real alone = abs(rhs) / select(stiff, w + state.alpha, real(1));
    t.limit = max(alone, row.rest * real(WEFT_LINE_PULL) / max(max(wa, wb), real(1e-30)));
    return t;
}

// How a row and the one before it depend on one another, by the point that they share.
WEFT_FN real line_coupling(vec3 n_before, vec3 n, real wa) { return -wa * dot(n_before, n); }

// Completes the `factor` of the row before.
WEFT_FN LineRow eliminate_line(inout_(LineRow) before, real coupling, LineTerms t)
{
    before.factor = before.couples * coupling * before.inverse;
    real lower = t.couples * coupling;
    LineRow now;
    now.couples = t.couples;
    now.n = t.n;
    now.inverse = real(1) / (t.diagonal - lower * before.factor);
    now.g = (t.rhs - lower * before.g) * now.inverse;
    now.factor = real(0);
    now.limit = t.limit;
    return now;
}

// Both; a is the point that the row shares with the one before.
WEFT_FN LineRow eliminate_stretch(inout_(LineRow) before, vec3 a, vec3 b, real wa, real wb, real lambda,
                                  StretchRow row, Step step)
{
    LineTerms t = line_terms(a, b, wa, wb, lambda, row, step);
    return eliminate_line(before, line_coupling(before.n, t.n, wa), t);
}

// Delta lambda of a row from that of the next one.
WEFT_FN real substitute_stretch(LineRow now, real next)
{
    real change = now.g - now.factor * next;
    return max(-now.limit, min(now.limit, change));
}
