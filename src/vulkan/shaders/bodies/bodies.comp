#version 450
// The passes over rigid bodies (src/cpu/bodies.h has the same on the CPU). One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/bodies/pairs.glsl"

#define WEFT_REACH_PER_WAY 0.25
#define WEFT_REACH_PER_RADIUS 0.25

#define WEFT_REPORT_NON_FINITE 2u
#define WEFT_REPORT_LIST_FULL 0x80000000u

bool is_finite(vec4 v)
{
    uvec4 bits = floatBitsToUint(v) & 0x7f800000u;
    return bits.x != 0x7f800000u && bits.y != 0x7f800000u && bits.z != 0x7f800000u && bits.w != 0x7f800000u;
}

shared uint any_left;

// Whether the body is in its box, and will be after the next substep.
bool is_in_reach(uint body, vec3 place, vec3 v)
{
    vec3 low = WEFT_BODY(body).reach_low.xyz, high = WEFT_BODY(body).reach_high.xyz, next = place + v * WEFT_BODIES.h;
    float radius = radius_of(body);
    vec3 least = min(place, next) - radius, most = max(place, next) + radius;
    return all(greaterThanEqual(least, low)) && all(lessThanEqual(most, high));
}

// Where the body is expected in the rest of the frame.
void extend_reach(uint body, vec3 place, vec3 v, float seconds)
{
    float speed = sqrt(dot(v, v));
    vec3 end = place + v * seconds + gravity_of_bodies() * (0.5 * seconds * seconds);
    float radius = radius_of(body) * (1.0 + WEFT_REACH_PER_RADIUS) + WEFT_REACH_PER_WAY * speed * seconds +
                   speed * WEFT_BODIES.h;
    vec3 low = min(place, end) - radius, high = max(place, end) + radius;
    WEFT_BODY(body).reach_low = vec4(min(WEFT_BODY(body).reach_low.xyz, low), 0.0);
    WEFT_BODY(body).reach_high = vec4(max(WEFT_BODY(body).reach_high.xyz, high), 0.0);
}

// If a body is not where it was expected, all lists are made again.
void watch_reach(uint substep)
{
    if (me() == 0u) any_left = 0u;
    workgroup_barrier();
    float seconds = WEFT_BODIES.h * float(WEFT_BODIES.substeps - substep);
    for (uint body = me(); body < WEFT_BODIES.count; body += WEFT_BODY_GROUP) {
        vec3 place = WEFT_BODY(body).place.xyz, v = WEFT_BODY(body).velocity.xyz;
        if (is_in_reach(body, place, v)) continue;
        extend_reach(body, place, v, seconds);
        atomicOr(any_left, 1u);
    }
    workgroup_barrier();
    if (any_left == 0u) return;
    if (me() == 0u) WEFT_BODIES.reach_serial += 1u;
    find_pairs();
}

void begin_frame()
{
    for (uint body = me(); body < WEFT_BODIES.count; body += WEFT_BODY_GROUP) {
        place_body(body, motion_of(body));
        turn_inertia(body);
    }
    workgroup_barrier();
    watch_reach(0u);
}

void clear_sums(uint body)
{
    for (uint k = 0u; k < WEFT_BODY_SUM_WORDS; ++k) WEFT_BODIES.sums.at[WEFT_BODY_SUM_WORDS * body + k] = 0u;
}

void predict()
{
    for (uint body = me(); body < WEFT_BODIES.count; body += WEFT_BODY_GROUP) {
        store_pose(body, WEFT_BODY_BEFORE, pose_now(body));
        BodyMotion m = motion_of(body);
        BodyInertia inertia = inertia_of(body);
        WEFT_BODY(body).v = vec4(m.v, 0.0);
        WEFT_BODY(body).rate = vec4(rate_of(m.turn, m.spin, inertia), 0.0);
        vec4 inverse_moments = WEFT_BODY(body).inverse_moments, inverse_products = WEFT_BODY(body).inverse_products;
        predict_body(m, inertia, gravity_of_bodies(), inverse_moments.w, inverse_products.w, substep_of_bodies());
        store_motion(body, m);
        place_body(body, m);
        store_pose(body, WEFT_BODY_PLACED, pose_now(body));
        turn_inertia(body);
        clear_sums(body);
    }
    workgroup_barrier();
    find_contacts();
}

// How many contacts touch the body.
void count_touches(uint body)
{
    uint at = WEFT_BODY_SUM_WORDS * body + WEFT_BODY_SUM_TOUCHES;
    vec4 v = WEFT_BODY(body).v;
    WEFT_BODY(body).v = vec4(v.xyz, max(v.w, float(WEFT_BODIES.sums.at[at])));
    WEFT_BODIES.sums.at[at] = 0u;
}

float take_sum(uint body, uint sum)
{
    uint at = WEFT_BODY_SUM_WORDS * body + 2u * sum;
    uvec2 words = uvec2(WEFT_BODIES.sums.at[at], WEFT_BODIES.sums.at[at + 1u]);
    WEFT_BODIES.sums.at[at] = WEFT_BODIES.sums.at[at + 1u] = 0u;
    return float_of_quanta(words);
}

bool has_sums(uint body)
{
    uint any = 0u;
    for (uint k = 0u; k < WEFT_BODY_SUM_TOUCHES; ++k) any |= WEFT_BODIES.sums.at[WEFT_BODY_SUM_WORDS * body + k];
    return any != 0u;
}

// What the cloth's sweep has added up moves the bodies, then their contacts with one another and with colliders do.
void move_bodies()
{
    for (uint body = me(); body < WEFT_BODIES.count; body += WEFT_BODY_GROUP) {
        if (has_sums(body)) {
            vec3 impulse = vec3(take_sum(body, 0u), take_sum(body, 1u), take_sum(body, 2u));
            vec3 twist = vec3(take_sum(body, 3u), take_sum(body, 4u), take_sum(body, 5u));
            change_one(body, WEFT_PUSH, BodyPush(impulse, twist));
        }
        if (args.places == 1u) store_pose(body, WEFT_BODY_PLACED, pose_now(body));
        count_touches(body);
    }
    workgroup_barrier();
    for (uint sweep = 0u; sweep < args.sweeps; ++sweep) sweep_rows(WEFT_SWEEP_PROJECT);
}

void report(uint bits)
{
    for (uint i = me(); i < WEFT_BODIES.report_count; i += WEFT_BODY_GROUP)
        atomicOr(Uints(WEFT_BODIES.reports.at[i]).at[0], bits);
}

// A list that is too short makes the frame run again.
void check_frame()
{
    workgroup_barrier();
    if (WEFT_BODIES.wanted_pairs > WEFT_BODIES.pair_room || WEFT_BODIES.wanted_rows > WEFT_BODIES.row_room)
        report(WEFT_REPORT_LIST_FULL);
    for (uint body = me(); body < WEFT_BODIES.count; body += WEFT_BODY_GROUP) {
        if (is_finite(WEFT_BODY(body).place) && is_finite(WEFT_BODY(body).turn) &&
            is_finite(WEFT_BODY(body).velocity) && is_finite(WEFT_BODY(body).spin))
            continue;
        WEFT_BODIES.not_finite = 1u;
    }
    workgroup_barrier();
    if (WEFT_BODIES.not_finite != 0u) report(WEFT_REPORT_NON_FINITE);
}

void main()
{
    switch (args.pass) {
    case WEFT_BODIES_BEGIN:
        begin_frame();
        break;
    case WEFT_BODIES_PREDICT:
        predict();
        break;
    case WEFT_BODIES_COUNT:
        for (uint body = me(); body < WEFT_BODIES.count; body += WEFT_BODY_GROUP) {
            store_pose(body, WEFT_BODY_FOUND, pose_now(body));
            count_touches(body);
        }
        break;
    case WEFT_BODIES_MOVE:
        move_bodies();
        break;
    case WEFT_BODIES_FINISH:
        for (uint sweep = 0u; sweep < args.sweeps; ++sweep) sweep_rows(WEFT_SWEEP_BOUNCE);
        sweep_rows(WEFT_SWEEP_LIFT);
        watch_reach(args.substep + 1u);
        if (args.substep + 1u == WEFT_BODIES.substeps) check_frame();
        break;
    }
}
