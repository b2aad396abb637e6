// Three measures of one shape that are solved together. The energy is half the square of C = transposed L times the
// measures, with L a lower triangular matrix: a compliance of 1 for each component of C.

struct LowerTriangle { real aa, ba, bb, ca, cb, cc; };

// Sums over the particles of weight times gradient i times gradient j. Symmetric, without negative eigenvalues.
struct CoupledWeights { real aa, bb, cc, ab, ac, bc; };

// Solves (1 + S) x = r by elimination. Only rounding can make a pivot smaller than 1.
WEFT_FN vec3 solve_shifted(CoupledWeights s, vec3 r)
{
    real one = real(1);
    real inv_a = one / max(one + s.aa, one);
    real f_ab = s.ab * inv_a;
    real f_ac = s.ac * inv_a;
    real inv_b = one / max(one + (s.bb - f_ab * s.ab), one);
    real left_bc = s.bc - f_ab * s.ac;
    real f_bc = left_bc * inv_b;
    real inv_c = one / max(one + (s.cc - f_ac * s.ac - f_bc * left_bc), one);
    real y_b = r.y - f_ab * r.x;
    real y_c = r.z - f_ac * r.x - f_bc * y_b;
    vec3 x;
    x.z = y_c * inv_c;
    x.y = y_b * inv_b - f_bc * x.z;
    x.x = r.x * inv_a - f_ab * x.y - f_ac * x.z;
    // For larger values squares exceed the range of a float: skip the constraint.
    return select(s.aa + s.bb + s.cc < real(1e30), x, vec3(real(0)));
}

// k S, where S is transposed L times W times L. W has the weights of the measures.
WEFT_FN CoupledWeights couple_weights(CoupledWeights w, LowerTriangle l, real k)
{
    // V = k W L, S = transposed L V.
    real v_aa = k * (w.aa * l.aa + w.ab * l.ba + w.ac * l.ca);
    real v_ba = k * (w.ab * l.aa + w.bb * l.ba + w.bc * l.ca);
    real v_ca = k * (w.ac * l.aa + w.bc * l.ba + w.cc * l.ca);
    real v_bb = k * (w.bb * l.bb + w.bc * l.cb);
    real v_cb = k * (w.bc * l.bb + w.cc * l.cb);
    real v_cc = k * (w.cc * l.cc);
    CoupledWeights s;
    s.aa = l.aa * v_aa + l.ba * v_ba + l.ca * v_ca;
    s.ab = l.bb * v_ba + l.cb * v_ca;
    s.ac = l.cc * v_ca;
    s.bb = l.bb * v_bb + l.cb * v_cb;
    s.bc = l.cc * v_cb;
    s.cc = l.cc * v_cc;
    return s;
}

// The weights in a sweep, to which a compliance of 1 is added (sweep.kernel.h). No eigenvalue is larger than the sum of the
// diagonal, so each keeps its least weight.
WEFT_FN CoupledWeights coupled_in_sweep(CoupledWeights s, Step step)
{
    real least = least_weight(step);
    real sum = max(s.aa + s.bb + s.cc, real(1e-30));
    real part = min(least, max(real(1) - step.undone, least - real(1) / sum));
    s.aa = s.aa * part;
    s.bb = s.bb * part;
    s.cc = s.cc * part;
    s.ab = s.ab * part;
    s.ac = s.ac * part;
    s.bc = s.bc * part;
    return s;
}

// L x: from the three components of C to a force for each measure.
WEFT_FN vec3 coupled_forces(LowerTriangle l, vec3 x)
{
    return vec3(l.aa * x.x, l.ba * x.x + l.bb * x.y, l.ca * x.x + l.cb * x.y + l.cc * x.z);
}

// C: transposed L times the measures.
WEFT_FN vec3 coupled_strains(LowerTriangle l, vec3 x)
{
    return vec3(l.aa * x.x + l.ba * x.y + l.ca * x.z, l.bb * x.y + l.cb * x.z, l.cc * x.z);
}
