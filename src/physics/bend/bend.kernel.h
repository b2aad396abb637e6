// Bend: turns two triangles toward their rest angle. C = theta - rest, theta = 0 flat.
//
//        c
//       / \        triangles (a, b, c) and (b, a, d)
//      a---b       theta > 0 when c and d rise toward the side that the normals point to
//       \ /
//        d

struct BendRow { WEFT_ROW_bend(WEFT_ROW_MEMBER) };

struct Hinge {
    real theta;
    vec3 n1, n2;         // m2   normals of the triangles, twice their area long
    real inv_len;        // 1/m  of the edge
    real tc, td;         //      positions of the wing tips along the edge: 0 at a, 1 at b
    real h11, h22, h12;  // m2   heights of the triangles over the edge, squared, and their scalar product
    mask able;           // neither triangle nor the edge has collapsed
};

WEFT_FN Hinge measure_hinge(vec3 a, vec3 b, vec3 c, vec3 d)
{
    vec3 e = b - a;
    vec3 ac = c - a;
    vec3 ad = d - a;
    real e2 = dot(e, e);
    real inv_e2 = real(1) / max(e2, real(1e-20));
    real len = sqrt(e2);

    Hinge h;
    h.n1 = cross(e, ac);
    h.n2 = cross(ad, e);
    real n11 = dot(h.n1, h.n1);
    real n22 = dot(h.n2, h.n2);
    real n12 = dot(h.n1, h.n2);
    h.able = e2 > real(1e-20) && n11 > real(1e-30) && n22 > real(1e-30);
    // atan2 of sine and cosine, both times |n1||n2|: needs no normalization and is accurate at 0 and at +-pi. The sine
    // is that of n1 x n2 = -(n1.ad) e.
    h.theta = angle_of(dot(h.n1, ad) * len, n12);
    h.inv_len = len * inv_e2;
    h.tc = dot(ac, e) * inv_e2;
    h.td = dot(ad, e) * inv_e2;
    h.h11 = n11 * inv_e2;
    h.h22 = n22 * inv_e2;
    h.h12 = n12 * inv_e2;
    return h;
}

struct HingeAngle {
    real theta;
    vec3 ga, gb, gc, gd;  // gradient of theta, 1/m
    mask able;
};

// A wing tip rotates about the edge with its height as lever arm. The gradients at the ends of the edge balance force
// and torque.
WEFT_FN HingeAngle hinge_angle(vec3 a, vec3 b, vec3 c, vec3 d)
{
    Hinge h = measure_hinge(a, b, c, d);
    HingeAngle g;
    g.theta = h.theta;
    g.able = h.able;
    g.gc = h.n1 * (h.inv_len / max(h.h11, real(1e-30)));
    g.gd = h.n2 * (h.inv_len / max(h.h22, real(1e-30)));
    g.ga = g.gc * (h.tc - real(1)) + g.gd * (h.td - real(1));
    g.gb = -(g.gc * h.tc + g.gd * h.td);
    return g;
}

WEFT_FN real hinge_weight(HingeAngle h, real wa, real wb, real wc, real wd)
{
    return wa * dot(h.ga, h.ga) + wb * dot(h.gb, h.gb) + wc * dot(h.gc, h.gc) + wd * dot(h.gd, h.gd);
}

// Wraps an angle to (-pi, pi]. A rest angle near a full fold is close to a full fold to the other side.
WEFT_FN real wrap_angle(real angle)
{
    real two_pi = real(6.283185307179586);
    real pi = real(3.141592653589793);
    return select(angle > pi, angle - two_pi, select(angle < -pi, angle + two_pi, angle));
}

// Uses the gradients of hinge_angle, all times h11 h22. That leaves one division, which does not depend on the angle.
// The longest chain of dependent operations limits the speed, not their number.
WEFT_FN void project_bend(inout_(vec3) a, inout_(vec3) b, inout_(vec3) c, inout_(vec3) d,
                          real wa, real wb, real wc, real wd,
                          inout_(real) lambda, BendRow row, Step step)
{
    Hinge h = measure_hinge(a, b, c, d);
    real uc = h.tc - real(1);
    real ud = h.td - real(1);
    // hinge_weight times h11 h22. It overflows only far beyond the size of any cloth.
    real cross_term = h.h12 + h.h12;
    real w = wc * h.h22 + wd * h.h11
           + wa * (uc * (uc * h.h22 + ud * cross_term) + ud * ud * h.h11)
           + wb * (h.tc * (h.tc * h.h22 + h.td * cross_term) + h.td * h.td * h.h11);
    mask able = h.able && w > real(0) && w < real(1e30);
    real alpha = row.compliance * step.inv_h2;
    real h1122 = h.h11 * h.h22;
    real inv = real(1) / weight_in_sweep(w, alpha * h1122, step);
    real lever = h.inv_len * inv;
    vec3 g1 = h.n1 * select(able, h.h22 * lever, real(0));
    vec3 g2 = h.n2 * select(able, h.h11 * lever, real(0));

    real push = select(able, -(wrap_angle(h.theta - row.rest) + alpha * lambda), real(0));
    lambda = lambda + push * select(able, h1122 * inv, real(0));
    g1 = g1 * push;
    g2 = g2 * push;
    displace(a, (g1 * uc + g2 * ud) * wa, step);
    displace(b, (g1 * h.tc + g2 * h.td) * -wb, step);
    displace(c, g1 * wc, step);
    displace(d, g2 * wd, step);
}

// Viscosity parallel to the spring: an implicit impulse against the rate of change of the angle. `viscous` is the
// retardation time times the time step, s2.
WEFT_FN void damp_bend(inout_(vec3) va, inout_(vec3) vb, inout_(vec3) vc, inout_(vec3) vd,
                       vec3 a, vec3 b, vec3 c, vec3 d, real wa, real wb, real wc, real wd,
                       BendRow row, real viscous)
{
    HingeAngle h = hinge_angle(a, b, c, d);
    real w = hinge_weight(h, wa, wb, wc, wd);
    real rate = dot(h.ga, va) + dot(h.gb, vb) + dot(h.gc, vc) + dot(h.gd, vd);
    real s = select(h.able && w > real(0), -rate / (w + row.compliance / viscous), real(0));
    va = va + h.ga * (wa * s);
    vb = vb + h.gb * (wb * s);
    vc = vc + h.gc * (wc * s);
    vd = vd + h.gd * (wd * s);
}
