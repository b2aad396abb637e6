// The weight of a constraint in a sweep over constraints that share particles. After the sweep a constraint at rest is softer by
// the part Step::undone of its weight w, because later constraints undo it (src/physics/sweep.md). Leaving that part out makes
// the compliance that remains the constraint's own.

// Step::undone in the first sweep of a substep. In later ones only the last change is undone, which is small.
#define WEFT_UNDONE_BY_FIRST_SWEEP 0.5

// Less than this part of w would let the motion of a single constraint grow, which begins at 3/4.
#define WEFT_LEAST_WEIGHT real(0.8)

WEFT_FN real least_weight(Step step) { return select(step.undone > real(0), WEFT_LEAST_WEIGHT, real(1)); }

// w plus the scaled compliance. `alpha` has a factor of its own, as w has.
WEFT_FN real weight_in_sweep(real w, real alpha, Step step)
{
    return max(w * (real(1) - step.undone) + alpha, w * least_weight(step));
}
