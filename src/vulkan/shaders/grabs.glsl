// The passes of grabs. There are few, so one invocation runs all of a cloth, one after another.
#ifndef WEFT_GRABS_GLSL
#define WEFT_GRABS_GLSL

uint grab_corner(uint i, uint k)
{
    return grab_args.at.faces.at[k * grab_args.at.stride + grab_args.at.grabs.at[i].triangle];
}
// Whether the triangle has not been removed.
bool holds_triangle(uint i) { return grab_corner(i, 0u) != grab_corner(i, 1u); }

Step grab_step() { return substep_of(grab_args.at.frame); }

GrabRow grab_row(uint i)
{
    vec4 from = grab_args.at.grabs.at[i].from, to = grab_args.at.grabs.at[i].to;
    vec4 weights = grab_args.at.grabs.at[i].weights;
    uint substep = grab_args.at.substep + substeps_before;
    float left = float(grab_args.at.frame.at.substeps - 1u - substep), per_substep = grab_args.at.per_substep;
    return GrabRow(grab_target(from.xyz, to.xyz, left, per_substep), (to.xyz - from.xyz) * per_substep, weights.x,
                   weights.y, weights.z, from.w, to.w, weights.w, grab_args.at.reach);
}

void weigh_grabbed(bool hides)
{
    for (uint i = 0u; i < grab_args.at.count; ++i) {
        if (!holds_triangle(i)) continue;
        for (uint k = 0u; k < 3u; ++k) {
            uint p = grab_corner(i, k);
            float w = hides ? 0.0 : grab_args.at.weights.at[p];
            store_point(grab_args.at.position, p, vec4(load_point(grab_args.at.position, p).xyz, w));
        }
    }
}

void run_hide_grabs(uint unused) { weigh_grabbed(true); }
void run_free_grabs(uint unused) { weigh_grabbed(false); }

void run_hold_grabs(uint unused)
{
    weigh_grabbed(false);
    vec3 gravity = vec3(grab_args.at.frame.at.gravity_x, grab_args.at.frame.at.gravity_y, grab_args.at.frame.at.gravity_z);
    if (grab_args.at.first_iteration == 0u) gravity = vec3(0.0);
    for (uint i = 0u; i < grab_args.at.count; ++i) {
        if (!holds_triangle(i)) continue;
        GrabRow row = grab_row(i);
        for (uint k = 0u; k < 3u; ++k) {
            uint p = grab_corner(i, k);
            vec4 x = load_point(grab_args.at.position, p);
            float share = k == 0u ? row.c0 : k == 1u ? row.c1 : row.c2;
            take_hold(x.xyz, x.w, grab_args.at.weights.at[p], share, gravity, row, grab_step());
            store_point(grab_args.at.position, p, x);
        }
    }
}

void run_grab(uint unused)
{
    for (uint i = 0u; i < grab_args.at.count; ++i) {
        uint place = (grab_args.at.substep + substeps_before) * grab_args.at.count + i;
        vec3 lambda = vec3(0.0);
        if (grab_args.at.first_iteration == 0u) lambda = grab_args.at.pulls.at[place].xyz;
        if (holds_triangle(i)) {
            uint pa = grab_corner(i, 0u), pb = grab_corner(i, 1u), pc = grab_corner(i, 2u);
            vec4 a = load_point(grab_args.at.position, pa), b = load_point(grab_args.at.position, pb),
                 c = load_point(grab_args.at.position, pc);
            project_grab(a.xyz, b.xyz, c.xyz, grab_args.at.start.at[pa].xyz, grab_args.at.start.at[pb].xyz,
                         grab_args.at.start.at[pc].xyz, a.w, b.w, c.w, lambda, grab_row(i), grab_step());
            store_point(grab_args.at.position, pa, a);
            store_point(grab_args.at.position, pb, b);
            store_point(grab_args.at.position, pc, c);
        }
        grab_args.at.pulls.at[place] = vec4(lambda, 0.0);
    }
}

#endif
