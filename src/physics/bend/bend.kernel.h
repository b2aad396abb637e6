// Bend: turns two triangles toward their rest angle. C = theta - rest, theta = 0 flat.
//
//        c
//       / \        triangles (a, b, c) and (b, a, d)
//      a---b       theta > 0 when c and d rise toward the side that the normals point to
//       \ /
//        d

struct BendRow { WEFT_ROW_bend(WEFT_ROW_MEMBER) };

struct HingeAngle {
    real theta;
    vec3 ga, gb, gc, gd;  // gradient of theta, 1/m
    mask able;            // neither triangle nor the edge has collapsed
};

WEFT_FN HingeAngle hinge_angle(vec3 a, vec3 b, vec3 c, vec3 d)
{
    vec3 e = b - a;
    vec3 ac = c - a;
    vec3 ad = d - a;
    vec3 n1 = cross(e, ac);
    vec3 n2 = cross(ad, e);
    real e2 = dot(e, e);
    real n1_2 = dot(n1, n1);
    real n2_2 = dot(n2, n2);
    real len = sqrt(e2);

    HingeAngle h;
    h.able = e2 > real(1e-20) && n1_2 > real(1e-30) && n2_2 > real(1e-30);
    // atan2 of sine and cosine, both times |n1||n2||e|: no normalization, and sharp at 0 and at +-pi alike.
    h.theta = angle_of(-dot(cross(n1, n2), e), dot(n1, n2) * len);

    // A wing tip turns about the edge at a lever |n|/|e|; the ends of the edge take what balances force and torque.
    h.gc = n1 * (len / max(n1_2, real(1e-30)));
    h.gd = n2 * (len / max(n2_2, real(1e-30)));
    real inv_e2 = real(1) / max(e2, real(1e-20));
    real tc = dot(ac, e) * inv_e2;
    real td = dot(ad, e) * inv_e2;
    h.ga = h.gc * (tc - real(1)) + h.gd * (td - real(1));
    h.gb = -(h.gc * tc + h.gd * td);
    return h;
}

WEFT_FN real hinge_weight(HingeAngle h, real wa, real wb, real wc, real wd)
{
    return wa * dot(h.ga, h.ga) + wb * dot(h.gb, h.gb) + wc * dot(h.gc, h.gc) + wd * dot(h.gd, h.gd);
}

// An angle brought back to (-pi, pi]: a rest angle near a full fold is close to the fold from the other side.
WEFT_FN real wrap_angle(real angle)
{
    real two_pi = real(6.283185307179586);
    real pi = real(3.141592653589793);
    angle = select(angle > pi, angle - two_pi, angle);
    return select(angle < -pi, angle + two_pi, angle);
}

WEFT_FN void project_bend(inout_(vec3) a, inout_(vec3) b, inout_(vec3) c, inout_(vec3) d,
                          real wa, real wb, real wc, real wd,
                          inout_(real) lambda, BendRow row, Step step)
{
    HingeAngle h = hinge_angle(a, b, c, d);
    real angle = wrap_angle(h.theta - row.rest);
    real alpha = row.compliance * step.inv_h2;
    real w = hinge_weight(h, wa, wb, wc, wd);
    real dl = select(h.able && w > real(0), -(angle + alpha * lambda) / (w + alpha), real(0));
    lambda = lambda + dl;
    a = a + h.ga * (wa * dl);
    b = b + h.gb * (wb * dl);
    c = c + h.gc * (wc * dl);
    d = d + h.gd * (wd * dl);
}

// Viscosity beside the spring: against the rate at which the angle changes, implicit. `viscous` is the retardation
// time times the time step, s2.
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
