// Membrane: strains a triangle back in its plane. C = transposed L (measures), one measure (length2 - rest2)/2 per edge.

struct MembraneRow { WEFT_ROW_membrane(WEFT_ROW_MEMBER) };

WEFT_FN LowerTriangle membrane_stiffness(MembraneRow row)
{
    LowerTriangle l;
    l.aa = row.l_aa;
    l.ba = row.l_ba;
    l.bb = row.l_bb;
    l.ca = row.l_ca;
    l.cb = row.l_cb;
    l.cc = row.l_cc;
    return l;
}

// The edges, opposite a, b and c. The gradient of half the square of an edge is the edge, negative at its start.
struct MembraneEdges { vec3 a, b, c; };

WEFT_FN MembraneEdges membrane_edges(vec3 a, vec3 b, vec3 c)
{
    MembraneEdges e;
    e.a = c - b;
    e.b = a - c;
    e.c = b - a;
    return e;
}

// Gradients of a component of C, sums of the edges by a column of L.
struct MembraneGradient { vec3 a, b, c; };

WEFT_FN MembraneGradient membrane_gradient(MembraneEdges e, real la, real lb, real lc)
{
    MembraneGradient g;
    g.a = e.b * lb - e.c * lc;
    g.b = e.c * lc - e.a * la;
    g.c = e.a * la - e.b * lb;
    return g;
}

struct MembraneGradients { MembraneGradient x, y, z; };

WEFT_FN MembraneGradients membrane_gradients(MembraneEdges e, LowerTriangle l)
{
    MembraneGradients g;
    g.x = membrane_gradient(e, l.aa, l.ba, l.ca);
    g.y = membrane_gradient(e, real(0), l.bb, l.cb);
    g.z = membrane_gradient(e, real(0), real(0), l.cc);
    return g;
}

WEFT_FN real membrane_weight(MembraneGradient g, MembraneGradient h, real wa, real wb, real wc)
{
    return wa * dot(g.a, h.a) + wb * dot(g.b, h.b) + wc * dot(g.c, h.c);
}

// Solves (1 + k S) x = r, S from the gradients of C themselves: in a needle, those of the measures nearly cancel.
WEFT_FN vec3 solve_membrane(MembraneGradients g, real wa, real wb, real wc, real k, vec3 r)
{
    real ka = k * wa;
    real kb = k * wb;
    real kc = k * wc;
    CoupledWeights s;
    s.aa = membrane_weight(g.x, g.x, ka, kb, kc);
    s.bb = membrane_weight(g.y, g.y, ka, kb, kc);
    s.cc = membrane_weight(g.z, g.z, ka, kb, kc);
    s.ab = membrane_weight(g.x, g.y, ka, kb, kc);
    s.ac = membrane_weight(g.x, g.z, ka, kb, kc);
    s.bc = membrane_weight(g.y, g.z, ka, kb, kc);
    return solve_shifted(s, r);
}

WEFT_FN void project_membrane(inout_(vec3) a, inout_(vec3) b, inout_(vec3) c, real wa, real wb, real wc,
                              inout_(real) lambda_a, inout_(real) lambda_b, inout_(real) lambda_c,
                              MembraneRow row, Step step)
{
    MembraneEdges e = membrane_edges(a, b, c);
    LowerTriangle l = membrane_stiffness(row);
    MembraneGradients g = membrane_gradients(e, l);
    real h2 = step.h * step.h;
    vec3 lambda = vec3(lambda_a, lambda_b, lambda_c);
    vec3 measures = vec3(dot(e.a, e.a) - row.rest_a, dot(e.b, e.b) - row.rest_b, dot(e.c, e.c) - row.rest_c);
    vec3 strain = coupled_strains(l, measures * real(0.5));
    // The scaled compliance is 1/h2; all terms are multiplied by h2.
    vec3 dl = solve_membrane(g, wa, wb, wc, h2, -(strain * h2 + lambda));
    dl = select(wa + wb + wc > real(0), dl, vec3(real(0)));   // all pinned: no multiplier grows
    lambda_a = lambda_a + dl.x;
    lambda_b = lambda_b + dl.y;
    lambda_c = lambda_c + dl.z;
    displace(a, (g.x.a * dl.x + g.y.a * dl.y + g.z.a * dl.z) * wa, step);
    displace(b, (g.x.b * dl.x + g.y.b * dl.y + g.z.b * dl.z) * wb, step);
    displace(c, (g.x.c * dl.x + g.y.c * dl.y + g.z.c * dl.z) * wc, step);
}

// Viscosity parallel to the spring: an implicit impulse against the rates of change of C. `viscous` is the retardation
// time times the time step, s2.
WEFT_FN void damp_membrane(inout_(vec3) va, inout_(vec3) vb, inout_(vec3) vc, vec3 a, vec3 b, vec3 c,
                           real wa, real wb, real wc, MembraneRow row, real viscous)
{
    MembraneGradients g = membrane_gradients(membrane_edges(a, b, c), membrane_stiffness(row));
    vec3 rate = vec3(dot(g.x.a, va) + dot(g.x.b, vb) + dot(g.x.c, vc), dot(g.y.a, va) + dot(g.y.b, vb) + dot(g.y.c, vc),
                     dot(g.z.a, va) + dot(g.z.b, vb) + dot(g.z.c, vc));
    vec3 s = solve_membrane(g, wa, wb, wc, viscous, -(rate * viscous));
    va = va + (g.x.a * s.x + g.y.a * s.y + g.z.a * s.z) * wa;
    vb = vb + (g.x.b * s.x + g.y.b * s.y + g.z.b * s.z) * wb;
    vc = vc + (g.x.c * s.x + g.y.c * s.y + g.z.c * s.z) * wc;
}
