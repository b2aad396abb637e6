// Solves the consecutive stretch constraints of a line together (line.md).
//
// Constraint k of a line connects its points k and k + 1. Neighboring constraints share only one point, so the system
// of one Newton step is tridiagonal: elimination runs forward along the line, substitution runs backward.

// Result of the elimination for one constraint.
struct LineRow {
    vec3 n;          // from the second point to the first, unit; 0 if there is no direction
    real g;          // delta lambda if that of the next constraint is 0
    real factor;     // minus its derivative by the next one's
    real limit;      // of |delta lambda|
    // Only for the next constraint:
    real inverse;    // of the pivot
    real couples;    // 1; 0 for a constraint that does not depend on its neighbors
};

// A line that is taut between two pins has no exact solution, and an almost straight one is ill-conditioned. Adding
// this fraction of the weights to the diagonal keeps pivots away from 0. It affects only the longest waves, and those
// little.
#define WEFT_LINE_REGULARIZATION 1e-4

// A constraint's compliance is at least its relative length error, clamped to this, times its weight. A line pulled
// longer than its rest length then converges to a bounded tension, equal in all its constraints, and neighboring
// constraints still balance their differences.
#define WEFT_LINE_GIVE 0.1

// Tension moves the points of a kinked line sideways. If it is large for the time step, it moves them beyond the
// straight line and the line oscillates. A change of lambda of up to this part of the rest length per weight does not.
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

// The terms of a constraint in its line's system, without the coupling.
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
    // Never less than the change of an independent projection.
    real own = abs(rhs) / select(stiff, w + state.alpha, real(1));
    t.limit = max(own, row.rest * real(WEFT_LINE_PULL) / max(max(wa, wb), real(1e-30)));
    return t;
}

// Coupling of a constraint and the previous one through their shared point.
WEFT_FN real line_coupling(vec3 n_before, vec3 n, real wa) { return -wa * dot(n_before, n); }

// Also completes the `factor` of the previous constraint.
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

// Both; a is the point shared with the previous constraint.
WEFT_FN LineRow eliminate_stretch(inout_(LineRow) before, vec3 a, vec3 b, real wa, real wb, real lambda,
                                  StretchRow row, Step step)
{
    LineTerms t = line_terms(a, b, wa, wb, lambda, row, step);
    return eliminate_line(before, line_coupling(before.n, t.n, wa), t);
}

// Delta lambda of a constraint from that of the next one.
WEFT_FN real substitute_stretch(LineRow now, real next)
{
    real change = now.g - now.factor * next;
    return max(-now.limit, min(now.limit, change));
}
