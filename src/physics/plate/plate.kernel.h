// Plate: rotates a triangle's three neighbors toward their rest angles together. C = transposed L (theta - rest).
//
//     dc---a---db       triangle (a, b, c); d* lies across the edge opposite *
//       \ / \ /         theta > 0 where d* rises toward the side that the normal of (a, b, c) points to
//        b---c
//         \ /
//          da

struct PlateRow { WEFT_ROW_plate(WEFT_ROW_MEMBER) };

// The angle across the edge from p to q, between the triangle (p, q, o) and its neighbor (q, p, d). All members are
// zero if a triangle or the edge has collapsed, or if no particle can move.
struct PlateAngle {
    real theta;           // rad, minus the rest angle
    vec3 go, gp, gq, gd;  // gradient of theta, 1/m
    real weight;          // sum of weight times gradient squared, 1/(kg m2)
};

// n is the normal of (p, q, o); its length is twice the area.
WEFT_FN PlateAngle plate_angle(vec3 n, vec3 o, vec3 p, vec3 q, vec3 d, real rest,
                               real wo, real wp, real wq, real wd)
{
    vec3 e = q - p;
    vec3 po = o - p;
    vec3 pd = d - p;
    vec3 m = cross(pd, e);
    real len = sqrt(dot(e, e));
    real n_2 = dot(n, n);
    real m_2 = dot(m, m);

    // A tip rotates about the edge with lever arm |n|/|e|; the gradients at the ends of the edge balance force and
    // torque.
    vec3 turn_o = n * (real(1) / max(n_2, real(1e-30)));
    vec3 turn_d = m * (real(1) / max(m_2, real(1e-30)));
    real inv_len = real(1) / max(len, real(1e-10));
    real to = dot(po, e) * inv_len;
    real td = dot(pd, e) * inv_len;
    vec3 go = turn_o * len;
    vec3 gd = turn_d * len;
    vec3 gp = turn_o * (to - len) + turn_d * (td - len);
    vec3 gq = -(turn_o * to + turn_d * td);
    real w = wo * dot(go, go) + wp * dot(gp, gp) + wq * dot(gq, gq) + wd * dot(gd, gd);
    mask able = len > real(1e-10) && n_2 > real(1e-30) && m_2 > real(1e-30) && w > real(0);

    PlateAngle h;
    // Sine and cosine, both times |n| |m|; equally accurate for all angles.
    h.theta = select(able, wrap_angle(angle_of(dot(n, pd) * len, dot(n, m)) - rest), real(0));
    h.go = select(able, go, vec3(real(0)));
    h.gp = select(able, gp, vec3(real(0)));
    h.gq = select(able, gq, vec3(real(0)));
    h.gd = select(able, gd, vec3(real(0)));
    h.weight = select(able, w, real(0));
    return h;
}

// The three angles, opposite a, b and c.
struct PlateAngles { PlateAngle a, b, c; };

WEFT_FN PlateAngles plate_angles(vec3 da, vec3 db, vec3 dc, vec3 a, vec3 b, vec3 c,
                                 real wda, real wdb, real wdc, real wa, real wb, real wc, PlateRow row)
{
    vec3 n = cross(b - a, c - a);
    PlateAngles t;
    t.a = plate_angle(n, a, b, c, da, row.rest_a, wa, wb, wc, wda);
    t.b = plate_angle(n, b, c, a, db, row.rest_b, wb, wc, wa, wdb);
    t.c = plate_angle(n, c, a, b, dc, row.rest_c, wc, wa, wb, wdc);
    return t;
}

WEFT_FN LowerTriangle plate_stiffness(PlateRow row)
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

WEFT_FN CoupledWeights plate_weights(PlateAngles t, real wa, real wb, real wc)
{
    CoupledWeights w;
    w.aa = t.a.weight;
    w.bb = t.b.weight;
    w.cc = t.c.weight;
    w.ab = wa * dot(t.a.go, t.b.gq) + wb * dot(t.a.gp, t.b.go) + wc * dot(t.a.gq, t.b.gp);
    w.ac = wa * dot(t.a.go, t.c.gp) + wb * dot(t.a.gp, t.c.gq) + wc * dot(t.a.gq, t.c.go);
    w.bc = wa * dot(t.b.gq, t.c.gp) + wb * dot(t.b.go, t.c.gq) + wc * dot(t.b.gp, t.c.go);
    return w;
}

WEFT_FN void project_plate(inout_(vec3) da, inout_(vec3) db, inout_(vec3) dc,
                           inout_(vec3) a, inout_(vec3) b, inout_(vec3) c,
                           real wda, real wdb, real wdc, real wa, real wb, real wc,
                           inout_(real) lambda_a, inout_(real) lambda_b, inout_(real) lambda_c,
                           PlateRow row, Step step)
{
    PlateAngles t = plate_angles(da, db, dc, a, b, c, wda, wdb, wdc, wa, wb, wc, row);
    real h2 = step.h * step.h;
    vec3 lambda = vec3(lambda_a, lambda_b, lambda_c);
    LowerTriangle l = plate_stiffness(row);
    vec3 strain = coupled_strains(l, vec3(t.a.theta, t.b.theta, t.c.theta));
    // The scaled compliance is 1/h2; all terms are multiplied by h2.
    CoupledWeights weights = coupled_in_sweep(couple_weights(plate_weights(t, wa, wb, wc), l, h2), step);
    vec3 dl = solve_shifted(weights, -(strain * h2 + lambda));
    lambda_a = lambda_a + dl.x;
    lambda_b = lambda_b + dl.y;
    lambda_c = lambda_c + dl.z;
    vec3 m = coupled_forces(l, dl);
    displace(da, t.a.gd * (wda * m.x), step);
    displace(db, t.b.gd * (wdb * m.y), step);
    displace(dc, t.c.gd * (wdc * m.z), step);
    displace(a, (t.a.go * m.x + t.b.gq * m.y + t.c.gp * m.z) * wa, step);
    displace(b, (t.a.gp * m.x + t.b.go * m.y + t.c.gq * m.z) * wb, step);
    displace(c, (t.a.gq * m.x + t.b.gp * m.y + t.c.go * m.z) * wc, step);
}

// Viscosity parallel to the spring: an implicit impulse against the rates of change of the angles. `viscous` is the
// retardation time times the time step, s2.
WEFT_FN void damp_plate(inout_(vec3) vda, inout_(vec3) vdb, inout_(vec3) vdc,
                        inout_(vec3) va, inout_(vec3) vb, inout_(vec3) vc,
                        vec3 da, vec3 db, vec3 dc, vec3 a, vec3 b, vec3 c,
                        real wda, real wdb, real wdc, real wa, real wb, real wc,
                        PlateRow row, real viscous)
{
    PlateAngles t = plate_angles(da, db, dc, a, b, c, wda, wdb, wdc, wa, wb, wc, row);
    vec3 rate = vec3(dot(t.a.gd, vda) + dot(t.a.go, va) + dot(t.a.gp, vb) + dot(t.a.gq, vc),
                     dot(t.b.gd, vdb) + dot(t.b.gq, va) + dot(t.b.go, vb) + dot(t.b.gp, vc),
                     dot(t.c.gd, vdc) + dot(t.c.gp, va) + dot(t.c.gq, vb) + dot(t.c.go, vc));
    LowerTriangle l = plate_stiffness(row);
    CoupledWeights weights = couple_weights(plate_weights(t, wa, wb, wc), l, viscous);
    vec3 s = solve_shifted(weights, -(coupled_strains(l, rate) * viscous));
    vec3 m = coupled_forces(l, s);
    vda = vda + t.a.gd * (wda * m.x);
    vdb = vdb + t.b.gd * (wdb * m.y);
    vdc = vdc + t.c.gd * (wdc * m.z);
    va = va + (t.a.go * m.x + t.b.gq * m.y + t.c.gp * m.z) * wa;
    vb = vb + (t.a.gp * m.x + t.b.go * m.y + t.c.gq * m.z) * wb;
    vc = vc + (t.a.gq * m.x + t.b.gp * m.y + t.c.go * m.z) * wc;
}
