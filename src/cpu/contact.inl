// Contact with colliders on lanes. Included by passes.inl.

WEFT_FN Solid solid_of(const ContactView& c) {
    return {c.kind,
            {real(c.numbers[0]), real(c.numbers[1]), real(c.numbers[2]), real(c.numbers[3]), c.data},
            real(c.steepness),
            real(c.roundness),
            real(c.width)};
}

WEFT_FN ContactBody make_body(const ContactView& c) {
    return {spread(c.now.rotation.x),    spread(c.now.rotation.y),    spread(c.now.rotation.z),
            spread(c.now.position),      spread(c.before.rotation.x), spread(c.before.rotation.y),
            spread(c.before.rotation.z), spread(c.before.position),   real(c.static_friction),
            real(c.kinetic_friction),    real(c.thickness.half), real(c.depenetration)};
}

// Numbers of particles, in the order of lanes that hold blocks unordered.
WEFT_FN real load_unordered(const float* numbers, std::size_t i) {
    alignas(64) float lanes[16];
    for (std::size_t lane = 0; lane < lane_count; ++lane) lanes[lane] = numbers[i + unordered_particle(lane)];
    return load(lanes);
}

// Half of the thickness at particles.
WEFT_FN real half_thickness_at(const ThicknessView& thickness, std::size_t i) {
    const real half = real(thickness.half);
    return thickness.factors ? half * load_unordered(thickness.factors, i) : half;
}

// Likewise where the particles of each lane's triangle are thinnest.
WEFT_FN real half_thickness_of_faces(const ThicknessView& thickness, const std::uint32_t* a, const std::uint32_t* b,
                                     const std::uint32_t* c) {
    const real half = real(thickness.half);
    if (!thickness.factors) return half;
    alignas(64) float least[16];
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const float* const factors = thickness.factors;
        least[lane] = std::min(factors[a[lane]], std::min(factors[b[lane]], factors[c[lane]]));
    }
    return half * load(least);
}

inline std::uint32_t first_outside_pass(const float* position, std::span<const Bounds> boxes, Range range,
                                        std::uint32_t first) {
    for (std::uint32_t tile = first; tile < boxes.size(); ++tile) {
        const vec3 min = spread(boxes[tile].min), max = spread(boxes[tile].max);
        const std::size_t begin = range.begin + std::size_t{tile} * lane_padding;
        mask outside = real(0.0f) > real(0.0f);
        for (std::size_t i = begin; i < begin + lane_padding && i < range.end; i += lane_count) {
            real w;
            const vec3 x = load_blocks_unordered(position + 4 * i, w);
            const mask left = x.x < min.x || x.y < min.y || x.z < min.z || x.x > max.x || x.y > max.y || x.z > max.z;
            const mask now = left && w > real(0.0f);
            outside = outside || now;
        }
        if (any(outside)) return tile;
    }
    return static_cast<std::uint32_t>(boxes.size());
}

#define WEFT_SHAPE(name, Name)                                                      \
    struct Name##Shape {                                                            \
        WEFT_FN static real distance(vec3 p, const ShapeNumbers& shape, vec3& normal) { \
            return distance_##name(p, shape, normal);                               \
        }                                                                           \
    };
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE

// Adds the displacements by a contact to the particles' contact log.
//   particle   first one of the lanes, in the cloth;  i   in the log
WEFT_FN void trace_pass(const ContactView& c, std::size_t particle, std::size_t i, vec3 before, vec3 x, real w) {
    real unused, heavier = real(1.0f);
    if (c.free) heavier = mass_ratio(w, load_unordered(c.free, particle));
    ContactTrace trace;
    trace.moved = load_blocks_unordered(c.moved + 4 * i, unused);
    trace.turned = load_blocks_unordered(c.turned + 4 * i, unused);
    trace_contact(trace, before, x, spread(c.now.position), heavier);
    store_blocks_unordered(trace.moved, real(0.0f), c.moved + 4 * i);
    store_blocks_unordered(trace.turned, real(0.0f), c.turned + 4 * i);
}

WEFT_FN void mark_near_faces(const ContactView& c, const Solid& solid, std::size_t at, real distance, real way,
                             mask moved) {
    const mask near = faces_may_touch(solid, distance, way, real(c.nearest), real(c.widest));
    for (std::uint32_t bits = bits_of(near || moved); bits != 0; bits &= bits - 1)
        c.near_faces[at + unordered_particle(static_cast<std::size_t>(__builtin_ctz(bits)))] = 1;
}

WEFT_FN Support load_support(const SupportView& view, std::size_t i) {
    if (!view.plane) return no_support();
    Support support;
    support.normal = load_blocks_unordered(view.plane + 4 * i, support.offset);
    support.rubbed = load_blocks_unordered(view.taken + 4 * i, support.pushed);
    support.carried = load_blocks_unordered(view.carried + 4 * i, support.collider);
    real unused;
    const vec3 friction = load_blocks_unordered(view.friction + 4 * i, unused);
    support.friction = friction.x, support.presser = friction.y;
    support.seen = load_blocks_unordered(view.seen + 4 * i, support.height);
    return support;
}

// What bodies change.
WEFT_FN void store_pressed(const Support& support, const SupportView& view, std::size_t i) {
    if (!view.plane) return;
    store_blocks_unordered(support.rubbed, support.pushed, view.taken + 4 * i);
    store_blocks_unordered(vec3(support.friction, support.presser, real(0.0f)), real(0.0f), view.friction + 4 * i);
    store_blocks_unordered(support.seen, support.height, view.seen + 4 * i);
}

// Adds to the push of a collider what it has taken from bodies. Returns it, as a displacement.
WEFT_FN vec3 add_taken(const SupportView& view, real number, ContactSum& sum, ContactBody& body, std::size_t i) {
    if (!view.plane) return vec3(real(0.0f));
    Support support = load_support(view, i);
    return take_support(sum, body, support, number);
}

template <class Shape>
inline void find_support_pass(const ParticleView& p, const ContactView& c, Range range) {
    ContactBody body = make_body(c);
    const Solid solid = solid_of(c);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        body.half_thickness = half_thickness_at(c.thickness, i);
        real unused;
        const vec3 x = load_blocks_unordered(p.position + 4 * i, unused);
        vec3 normal;
        const vec3 local = to_body(body, x);
        const real gap = Shape::distance(local, solid.numbers, normal) - body.half_thickness;
        if (!any(gap < body.half_thickness)) continue;
        Support support = load_support(c.support, i);
        const vec3 world_normal = rotate(body.rx, body.ry, body.rz, normal), carried = carried_by(body, local);
        const vec3 velocity = load_blocks_unordered(p.velocity + 4 * i, unused) - spread(c.fall) - carried * real(1.0f / c.h);
        support_by(support, x, gap, world_normal, body.half_thickness,
                   friction_on_support(velocity, world_normal, body.static_friction, body.kinetic_friction),
                   real(c.number), carried);
        store_blocks_unordered(support.normal, support.offset, c.support.plane + 4 * i);
        store_blocks_unordered(support.carried, support.collider, c.support.carried + 4 * i);
        store_blocks_unordered(vec3(support.friction, real(0.0f), real(0.0f)), real(0.0f), c.support.friction + 4 * i);
    }
}

template <class Shape, bool traced>
inline void contact_pass(const ParticleView& p, const ContactView& c, Range range) {
    const ContactBody all = make_body(c);
    const Solid solid = solid_of(c);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w, unused;
        vec3 x = load_blocks_unordered(p.position + 4 * i, w);
        const vec3 before = x;
        ContactSum sum = {vec3(real(0.0f)), real(0.0f)};
        const std::size_t at = i - range.begin;
        if (c.sums && !c.first_iteration) sum.friction = load_blocks_unordered(c.sums + 4 * at, sum.push);
        ContactBody body = all;
        body.half_thickness = half_thickness_at(c.thickness, i);
        const vec3 taken = add_taken(c.support, real(c.number), sum, body, i);

        const vec3 local = to_body(body, x);
        vec3 normal;
        const real gap = Shape::distance(local, solid.numbers, normal) - body.half_thickness;
        const vec3 start = load_blocks_unordered(p.start + 4 * i, unused);
        const vec3 local_at_start = to_body_at_start(body, start), step = local - local_at_start;
        const real way = sqrt(dot(step, step));
        // Most of a cloth touches nothing.
        const bool touches = any(may_touch(gap, sum, way, solid, body));
        if (touches) {
            contact_particle(solid, body, x, start, w, sum, local, local_at_start, gap, normal);
            store_blocks_unordered(x, w, p.position + 4 * i);
        }
        if (c.near_faces) {
            const vec3 moved = x - before;
            mark_near_faces(c, solid, at, gap + body.half_thickness, way, dot(moved, moved) > real(0.0f));
        }
        if (c.sums) store_blocks_unordered(sum.friction, sum.push, c.sums + 4 * at);
        if constexpr (traced) {
            if (touches) trace_pass(c, i, at, before - taken, x, w);
        }
    }
}

WEFT_FN MovedBody moved_body(const BodyView& b) {
    return {real(b.contacts),
            real(b.inverse_mass),
            spread(b.center),
            spread(b.inverse_inertia.x),
            spread(b.inverse_inertia.y),
            spread(b.inverse_inertia.z)};
}

// A particle on a lane, and its distance to a body.
struct LaneContact {
    real w, gap, way;
    vec3 x, start, local, local_at_start, normal;
};

template <class Shape>
WEFT_FN LaneContact lane_contact(const ParticleView& p, const ContactBody& body, const Solid& solid, std::size_t i) {
    LaneContact lane;
    real unused;
    lane.x = load_blocks_unordered(p.position + 4 * i, lane.w);
    lane.start = load_blocks_unordered(p.start + 4 * i, unused);
    lane.local = to_body(body, lane.x);
    lane.local_at_start = to_body_at_start(body, lane.start);
    lane.gap = Shape::distance(lane.local, solid.numbers, lane.normal) - body.half_thickness;
    const vec3 step = lane.local - lane.local_at_start;
    lane.way = sqrt(dot(step, step));
    return lane;
}

// m, at most 0: how far the support will push the particle toward the body.
WEFT_FN real inside_support(const Support& support, const ContactBody& body, const LaneContact& lane) {
    const vec3 normal = rotate(body.rx, body.ry, body.rz, lane.normal);
    return min(room_before(support, lane.x, lane.start, normal, body.depenetration), real(0.0f));
}

template <class Shape>
inline void count_touches_pass(const ParticleView& p, const ContactView& c, const BodyView& b, Range range) {
    ContactBody body = make_body(c);
    const Solid solid = solid_of(c);
    const ContactSum none = {vec3(real(0.0f)), real(0.0f)};
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        body.half_thickness = half_thickness_at(c.thickness, i);
        const LaneContact lane = lane_contact<Shape>(p, body, solid, i);
        const real inside = inside_support(load_support(c.support, i), body, lane);
        if (!any(may_touch(lane.gap + inside, none, lane.way, solid, body))) continue;
        const ContactPlane plane =
            contact_plane(solid, body, none, lane.local, lane.local_at_start, lane.gap, lane.normal);
        const mask touches = plane.gap + inside < real(0.0f) && lane.w > real(0.0f);
        b.sums->touches += static_cast<std::uint32_t>(__builtin_popcount(bits_of(touches)));
    }
}

// Adds the opposite of what a contact does to the particles to the sums of the body.
WEFT_FN void add_to_body(const BodyView& b, vec3 by, vec3 x, real w) {
    const real momentum = contact_momentum(w, real(b.inv_h));
    const vec3 impulse = by * momentum, twist = cross(x - spread(b.center), impulse);
    alignas(64) float quanta[6][16];
    const real parts[6] = {impulse.x, impulse.y, impulse.z, twist.x, twist.y, twist.z};
    for (int k = 0; k < 6; ++k) store(to_impulse_quanta(parts[k]), quanta[k]);
    for (std::uint32_t bits = bits_of(dot(by, by) > real(0.0f)); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        const auto add = [&](std::uint64_t& sum, float more) {
            sum += static_cast<std::uint64_t>(static_cast<std::int64_t>(more));
        };
        for (std::size_t axis = 0; axis < 3; ++axis)
            add(b.sums->impulse[axis], quanta[axis][lane]), add(b.sums->twist[axis], quanta[3 + axis][lane]);
    }
}

template <class Shape>
inline void touch_body_pass(const ParticleView& p, const ContactView& c, const BodyView& b, Range range) {
    ContactBody body = make_body(c);
    const Solid solid = solid_of(c);
    const MovedBody moved = moved_body(b);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        body.half_thickness = half_thickness_at(c.thickness, i);
        LaneContact lane = lane_contact<Shape>(p, body, solid, i);
        ContactSum sum = {vec3(real(0.0f)), real(0.0f)};
        const std::size_t at = i - range.begin;
        if (!c.first_iteration) sum.friction = load_blocks_unordered(c.sums + 4 * at, sum.push);
        const vec3 before = lane.x;
        Support support = load_support(c.support, i);
        const real inside = inside_support(support, body, lane);
        if (any(may_touch(lane.gap + inside, sum, lane.way, solid, body))) {
            vec3 undone;
            contact_moved_body(solid, body, moved, real(c.number), lane.x, lane.start, lane.w, sum, lane.local,
                               lane.local_at_start, lane.gap, lane.normal, support, undone);
            store_pressed(support, c.support, i);
            store_blocks_unordered(lane.x, lane.w, p.position + 4 * i);
            if (c.moved) trace_pass(c, i, at, before - undone, lane.x, lane.w);
            if (b.moved) add_to_body(b, (lane.x - before) + undone, before, lane.w);
            const mask touches = sum.push > real(0.0f);
            b.sums->touches += static_cast<std::uint32_t>(__builtin_popcount(bits_of(touches)));
        }
        if (c.near_faces) {
            const vec3 by = lane.x - before;
            mark_near_faces(c, solid, at, lane.gap + body.half_thickness, lane.way, dot(by, by) > real(0.0f));
        }
        store_blocks_unordered(sum.friction, sum.push, c.sums + 4 * at);
    }
}

// Appends the contacts of the lanes in `listed`.
WEFT_FN void append_rows(const std::uint32_t (&corners)[3][16], mask listed, const FaceRow& row, FaceRows& to) {
    alignas(64) float weights[4 * 16], plane[4 * 16], start[4 * 16], gaps[4 * 16], lever[4 * 16],
        swept[16];
    // The third weight is what the others leave.
    store_blocks(vec3(row.weights.x, row.weights.y, row.static_friction), row.kinetic_friction, weights);
    store_blocks(row.normal, row.offset, plane);
    store_blocks(row.start, row.gap_at_start, start);
    store_blocks(row.corner_gaps, real(0.0f), gaps);
    store_blocks(row.lever, real(0.0f), lever);
    store(row.swept, swept);
    for (std::uint32_t bits = bits_of(listed); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        const std::size_t at = to.count++;
        __builtin_memcpy(to.weights + 4 * at, weights + 4 * lane, 4 * sizeof(float));
        __builtin_memcpy(to.plane + 4 * at, plane + 4 * lane, 4 * sizeof(float));
        __builtin_memcpy(to.start + 4 * at, start + 4 * lane, 4 * sizeof(float));
        __builtin_memcpy(to.gaps + 4 * at, gaps + 4 * lane, 4 * sizeof(float));
        __builtin_memcpy(to.lever + 4 * at, lever + 4 * lane, 4 * sizeof(float));
        for (int axis = 0; axis < 4; ++axis) to.sum[4 * at + axis] = 0;
        to.displacement[4 * at + 3] = swept[lane];
        for (std::size_t k = 0; k < 3; ++k) to.corners[k][at] = corners[k][lane];
    }
}

// Marks the corners of the lanes in `passed`.
WEFT_FN void hold_faces(const FaceView& faces, const std::uint32_t (&corners)[3][16], mask passed, real time) {
    if (!any(passed)) return;
    alignas(64) float part[16];
    store(floor(time * real(static_cast<float>(WEFT_HOLD_PARTS))), part);
    for (std::uint32_t bits = bits_of(passed); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        for (std::size_t k = 0; k < 3; ++k) faces.hold(faces, corners[k][lane], static_cast<std::uint32_t>(part[lane]));
    }
}

// Notes that faces around the touching ones may pass after the pushes.
WEFT_FN void mark_touching(const FaceView& faces, const std::uint32_t (&corners)[3][16], mask touching) {
    for (std::uint32_t bits = bits_of(touching); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        for (const auto& corner : corners) __atomic_store_n(faces.retry + corner[lane], 1, __ATOMIC_RELAXED);
    }
}

WEFT_FN Corners load_corners(const float* blocks, const std::uint32_t (&corners)[3][16]) {
    real unused;
    Corners x;
    x.a = gather_blocks(blocks, corners[0], unused);
    x.b = gather_blocks(blocks, corners[1], unused);
    x.c = gather_blocks(blocks, corners[2], unused);
    return x;
}

// Triangles on lanes, in the body's frame.
struct LaneFaces {
    alignas(64) std::uint32_t corners[3][16];
    Corners x, start, local, local_at_start;
    FacePoint center;
};

WEFT_FN void load_corner_numbers(const FaceView& faces, const std::uint32_t* items, std::uint32_t (&to)[3][16]) {
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t lane = 0; lane < lane_count; ++lane) to[k][lane] = faces.corners[k * faces.stride + items[lane]];
    }
}

template <class Shape>
WEFT_FN void load_faces(const ParticleView& p, const FaceView& faces, const std::uint32_t* items,
                        const ContactBody& body, const Solid& solid, LaneFaces& to) {
    load_corner_numbers(faces, items, to.corners);
    to.x = load_corners(p.position, to.corners), to.start = load_corners(p.start, to.corners);
    to.local = to_body(body, to.x), to.local_at_start = to_body_at_start(body, to.start);
    to.center.weights = center_weights();
    to.center.distance =
        Shape::distance(point_of(to.local, to.center.weights), solid.numbers, to.center.normal);
}

// Contact of the triangles numbered `items`, of which `mine` count.
template <class Shape>
inline void touch_faces(const ParticleView& p, const ContactView& c, const FaceView& faces, const std::uint32_t* items,
                        mask mine, FaceRows& to) {
    ContactBody body = make_body(c);
    const Solid solid = solid_of(c);
    LaneFaces lanes;
    load_faces<Shape>(p, faces, items, body, solid, lanes);
    body.half_thickness = half_thickness_of_faces(c.thickness, lanes.corners[0], lanes.corners[1], lanes.corners[2]);
    const real nearest = nearest_of_faces(body.half_thickness);
    const FaceContact contact =
        face_contact(solid, lanes.local_at_start, lanes.local, lanes.center, nearest, body.half_thickness,
                     faces.hold ? least_after_pushes(nearest) : -body.half_thickness);
    if (faces.hold) return hold_faces(faces, lanes.corners, mine && has_passed(contact, nearest), contact.time);
    const mask listed = mine && touches_beside_corners(contact);
    const mask fast = mine && is_fast(contact, faces.of_moved_body);
    to.any_fast = to.any_fast || any(fast);
    mark_touching(faces, lanes.corners, fast && contact.touches);
    if (any(listed))
        append_rows(lanes.corners, listed, face_row(body, contact, lanes.x, lanes.start, lanes.local), to);
}

// Most triangles near a collider touch nothing. The others are collected, so that all lanes have work.
template <class Shape>
inline void find_faces_pass(const ParticleView& p, const ContactView& c, const FaceView& faces, FaceRows& to) {
    const ContactBody body = make_body(c);
    const Solid solid = solid_of(c);
    alignas(64) std::uint32_t items[48];
    std::size_t count = 0;
    for (std::size_t i = 0; i < faces.count; i += lane_count) {
        LaneFaces lanes;
        load_faces<Shape>(p, faces, faces.items + i, body, solid, lanes);
        const std::size_t left = faces.count - i;
        const mask mine = mask_of(left < 16 ? (1u << left) - 1u : 0xffffu);
        // A face that has passed has touched on its way.
        const real nearest = faces.hold ? real(0.0f)
                                        : nearest_of_faces(half_thickness_of_faces(
                                              c.thickness, lanes.corners[0], lanes.corners[1], lanes.corners[2]));
        const mask may = mine && face_may_touch(lanes.local_at_start, lanes.local, lanes.center, solid, nearest);
        if (!any(may)) continue;
        compress(faces.items + i, may, items + count);
        count += static_cast<std::size_t>(__builtin_popcount(bits_of(may)));
        if (count < lane_count) continue;
        touch_faces<Shape>(p, c, faces, items, mask_of(0xffff), to);
        count -= lane_count;
        for (std::size_t k = 0; k < count; ++k) items[k] = items[lane_count + k];
    }
    if (count == 0) return;
    for (std::size_t k = count; k < lane_count; ++k) items[k] = items[0];
    touch_faces<Shape>(p, c, faces, items, mask_of((1u << count) - 1u), to);
}

WEFT_FN FaceRow load_row(const FaceRows& rows, std::size_t i, float depenetration) {
    FaceRow row;
    const vec3 packed = load_blocks(rows.weights + 4 * i, row.kinetic_friction);
    row.weights = vec3(packed.x, packed.y, real(1.0f) - packed.x - packed.y);
    row.static_friction = packed.z;
    row.normal = load_blocks(rows.plane + 4 * i, row.offset);
    row.start = load_blocks(rows.start + 4 * i, row.gap_at_start);
    load_blocks(rows.displacement + 4 * i, row.swept);
    row.depenetration = real(depenetration);
    return row;
}

// Adds the pushes of the lanes' contacts to the sums of one of their corners.
WEFT_FN void add_face_pushes(const std::uint32_t* corners, vec3 push, mask acts, const FaceSums& to) {
    const real scale = real(static_cast<float>(WEFT_PUSH_QUANTA_PER_METER));
    const real size2 = dot(push, push);
    acts = acts && is_push(size2);
    if (!any(acts)) return;
    alignas(64) std::int32_t quanta[16][4];
    store_integer_blocks(vec3(to_contact_quanta(push.x, scale), to_contact_quanta(push.y, scale),
                              to_contact_quanta(push.z, scale)),
                         to_contact_quanta(sqrt(size2), scale), quanta[0]);
    for (std::uint32_t bits = bits_of(acts); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        to.add(to, corners[lane], quanta[lane]);
    }
}

// On lanes `begin` is a multiple of their number.
inline void push_faces_pass(const ParticleView& p, const FaceRows& rows, std::size_t begin, std::size_t end, bool last,
                            float depenetration, const ThicknessView& thickness, const FaceSums& to) {
    for (std::size_t i = begin; i < end; i += lane_count) {
        const FaceRow row = load_row(rows, i, depenetration);
        const std::size_t left = end - i;
        const mask mine = mask_of(left < 16 ? (1u << left) - 1u : 0xffffu);
        real w[3];
        vec3 x[3];
        for (int k = 0; k < 3; ++k) x[k] = gather_blocks(p.position, rows.corners[static_cast<std::size_t>(k)] + i, w[k]);
        const real weights[3] = {row.weights.x, row.weights.y, row.weights.z};
        const vec3 point = x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        vec3 push[3];
        if (last) {
            real missing[3], unused;
            const vec3 packed = load_blocks(rows.gaps + 4 * i, unused);
            const real gaps[3] = {packed.x, packed.y, packed.z};
            const real nearest = nearest_of_faces(half_thickness_of_faces(thickness, rows.corners[0] + i,
                                                                          rows.corners[1] + i, rows.corners[2] + i));
            for (int k = 0; k < 3; ++k) {
                missing[k] = face_retreat(row, point, x[k], gaps[k], nearest);
                push[k] = row.normal * missing[k];
            }
            store_blocks(vec3(missing[0], missing[1], missing[2]), row.swept, rows.displacement + 4 * i);
        } else {
            real inverse_mass = real(0.0f);
            for (int k = 0; k < 3; ++k) inverse_mass = inverse_mass + w[k] * weights[k] * weights[k];
            ContactSum sum;
            sum.friction = load_blocks(rows.sum + 4 * i, sum.push);
            const vec3 displacement = face_displacement(row, point, inverse_mass, sum);
            store_blocks(sum.friction, sum.push, rows.sum + 4 * i);
            store_blocks(displacement, row.swept, rows.displacement + 4 * i);
            for (int k = 0; k < 3; ++k) push[k] = displacement * (w[k] * weights[k]);
        }
        for (int k = 0; k < 3; ++k)
            add_face_pushes(rows.corners[static_cast<std::size_t>(k)] + i, push[k], mine && w[k] > real(0.0f), to);
    }
}

inline void push_faces_of_body_pass(const ParticleView& p, const FaceRows& rows, std::size_t begin, std::size_t end,
                                    float depenetration, const BodyView& b, const Pose& found, const Pose& now,
                                    const FaceSums& to) {
    const MovedBody moved = moved_body(b);
    const vec3 fx = spread(found.rotation.x), fy = spread(found.rotation.y), fz = spread(found.rotation.z),
               f = spread(found.position), nx = spread(now.rotation.x), ny = spread(now.rotation.y),
               nz = spread(now.rotation.z), n = spread(now.position);
    for (std::size_t i = begin; i < end; i += lane_count) {
        const FaceRow row = load_row(rows, i, depenetration);
        const std::size_t left = end - i;
        const mask mine = mask_of(left < 16 ? (1u << left) - 1u : 0xffffu);
        real w[3];
        vec3 x[3];
        for (int k = 0; k < 3; ++k) x[k] = gather_blocks(p.position, rows.corners[static_cast<std::size_t>(k)] + i, w[k]);
        const real weights[3] = {row.weights.x, row.weights.y, row.weights.z};
        const vec3 point = x[0] * weights[0] + x[1] * weights[1] + x[2] * weights[2];
        const vec3 carried = (rotate(nx, ny, nz, unrotate(fx, fy, fz, point - f)) + n) - point;
        real inverse_mass = real(0.0f);
        for (int k = 0; k < 3; ++k) inverse_mass = inverse_mass + w[k] * weights[k] * weights[k];
        ContactSum sum;
        sum.friction = load_blocks(rows.sum + 4 * i, sum.push);
        const vec3 displacement = face_displacement_of_body(row, point, inverse_mass, sum, carried, moved);
        store_blocks(sum.friction, sum.push, rows.sum + 4 * i);
        store_blocks(displacement, row.swept, rows.displacement + 4 * i);
        for (int k = 0; k < 3; ++k)
            add_face_pushes(rows.corners[static_cast<std::size_t>(k)] + i, displacement * (w[k] * weights[k]),
                            mine && w[k] > real(0.0f), to);
    }
}
