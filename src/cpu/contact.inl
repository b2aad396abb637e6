// Contact with colliders on lanes. Included by passes.inl.

WEFT_FN Solid solid_of(const ContactView& c) {
    return {c.kind,
            {real(c.numbers[0]), real(c.numbers[1]), real(c.numbers[2]), real(c.numbers[3]), c.data},
            real(c.steepness),
            real(c.roundness)};
}

WEFT_FN ContactBody make_body(const ContactView& c) {
    return {spread(c.now.rotation.x),    spread(c.now.rotation.y),    spread(c.now.rotation.z),
            spread(c.now.position),      spread(c.before.rotation.x), spread(c.before.rotation.y),
            spread(c.before.rotation.z), spread(c.before.position),   real(c.static_friction),
            real(c.kinetic_friction),    real(c.half_thickness), real(c.depenetration)};
}

// Adds the displacements by a contact to the particles' contact log.
WEFT_FN void trace_pass(const ContactView& c, std::size_t i, vec3 before, vec3 x) {
    real unused;
    ContactTrace trace;
    trace.moved = load_blocks_unordered(c.moved + 4 * i, unused);
    trace.turned = load_blocks_unordered(c.turned + 4 * i, unused);
    trace_contact(trace, before, x, spread(c.now.position));
    store_blocks_unordered(trace.moved, real(0.0f), c.moved + 4 * i);
    store_blocks_unordered(trace.turned, real(0.0f), c.turned + 4 * i);
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

template <class Shape, bool traced>
inline void contact_pass(const ParticleView& p, const ContactView& c, Range range) {
    const ContactBody body = make_body(c);
    const Solid solid = solid_of(c);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        real w, unused;
        vec3 x = load_blocks_unordered(p.position + 4 * i, w);
        const vec3 before = x;
        ContactSum sum = {vec3(real(0.0f)), real(0.0f)};
        const std::size_t at = i - range.begin;
        if (c.sums && !c.first_iteration) sum.friction = load_blocks_unordered(c.sums + 4 * at, sum.push);

        const vec3 local = to_body(body, x);
        vec3 normal;
        const real gap = Shape::distance(local, solid.numbers, normal) - body.half_thickness;
        const vec3 start = load_blocks_unordered(p.start + 4 * i, unused);
        const vec3 local_at_start = to_body_at_start(body, start), way = local - local_at_start;
        // Most of a cloth touches nothing.
        const bool touches = any(may_touch(gap, sum, sqrt(dot(way, way)), solid, body));
        if (touches) {
            contact_particle(solid, body, x, start, w, sum, local, local_at_start, gap, normal);
            store_blocks_unordered(x, w, p.position + 4 * i);
        }
        if (c.sums) store_blocks_unordered(sum.friction, sum.push, c.sums + 4 * at);
        if constexpr (traced) {
            if (touches) trace_pass(c, at, before, x);
        }
    }
}

WEFT_FN Corners load_corners(const float* blocks, const std::uint32_t* corners, std::uint32_t stride, std::size_t i) {
    real unused;
    Corners x;
    x.a = gather_blocks(blocks, corners + i, unused);
    x.b = gather_blocks(blocks, corners + std::size_t{stride} + i, unused);
    x.c = gather_blocks(blocks, corners + std::size_t{2} * stride + i, unused);
    return x;
}

// Appends the contacts of the lanes in `listed`.
WEFT_FN void append_rows(const FaceView& faces, std::size_t i, mask listed, const FaceRow& row, FaceRows& to) {
    alignas(64) float weights[4 * 16], plane[4 * 16], start[4 * 16];
    store_blocks(row.weights, real(0.0f), weights);
    store_blocks(row.normal, row.offset, plane);
    store_blocks(row.start, row.gap_at_start, start);
    for (std::uint32_t bits = bits_of(listed); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        const std::size_t at = to.count++;
        __builtin_memcpy(to.weights + 4 * at, weights + 4 * lane, 3 * sizeof(float));
        to.weights[4 * at + 3] = faces.static_friction;
        __builtin_memcpy(to.plane + 4 * at, plane + 4 * lane, 4 * sizeof(float));
        __builtin_memcpy(to.start + 4 * at, start + 4 * lane, 4 * sizeof(float));
        for (int axis = 0; axis < 4; ++axis) to.sum[4 * at + axis] = 0;
        to.displacement[4 * at + 3] = faces.kinetic_friction;
        for (std::size_t k = 0; k < 3; ++k)
            to.corners[k][at] = faces.corners[k * faces.stride + i + lane];
    }
}

template <class Shape>
inline void find_faces_pass(const ParticleView& p, const ContactView& c, const FaceView& faces, Range range,
                            FaceRows& to) {
    const ContactBody body = make_body(c);
    const Solid solid = solid_of(c);
    const real nearest = real(faces.nearest);
    for (std::size_t i = range.begin; i < range.end; i += lane_count) {
        const Corners x = load_corners(p.position, faces.corners, faces.stride, i);
        const Corners local = to_body(body, x);
        FacePoint center;
        center.weights = center_weights();
        center.distance = Shape::distance(point_of(local, center.weights), solid.numbers, center.normal);
        const Corners start = load_corners(p.start, faces.corners, faces.stride, i);
        const Corners local_at_start = to_body_at_start(body, start);
        const std::size_t left = range.end - i;
        const mask mine = mask_of(left < 16 ? (1u << left) - 1u : 0xffffu);
        if (!any(mine && face_may_touch(local_at_start, local, center, solid, nearest))) continue;
        const FaceContact contact = face_contact(solid, local_at_start, local, center, nearest,
                                                 body.half_thickness);
        const mask listed = mine && contact.touches;
        if (!any(listed)) continue;
        append_rows(faces, i, listed, face_row(body, contact, x, start, local), to);
    }
}

WEFT_FN FaceRow load_row(const FaceRows& rows, std::size_t i, float depenetration) {
    FaceRow row;
    row.weights = load_blocks(rows.weights + 4 * i, row.static_friction);
    row.normal = load_blocks(rows.plane + 4 * i, row.offset);
    row.start = load_blocks(rows.start + 4 * i, row.gap_at_start);
    load_blocks(rows.displacement + 4 * i, row.kinetic_friction);
    row.depenetration = real(depenetration);
    return row;
}

// Adds the pushes of the lanes' rows to the sums of their particles: of the corner that stands in `corners`.
WEFT_FN void add_face_pushes(const std::uint32_t* corners, vec3 push, real size, mask acts, bool last,
                             const FaceSums& to) {
    const real scale = real(static_cast<float>(WEFT_PUSH_QUANTA_PER_METER));
    alignas(64) std::int32_t quanta[16][4];
    store_integer_blocks(vec3(to_contact_quanta(push.x, scale), to_contact_quanta(push.y, scale),
                              to_contact_quanta(push.z, scale)),
                         to_contact_quanta(size, scale), quanta[0]);
    for (std::uint32_t bits = bits_of(acts); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(bits));
        to.add(to, corners[lane], quanta[lane], last);
    }
}

inline void push_faces_pass(const ParticleView& p, const FaceRows& rows, bool last, float depenetration, float nearest,
                            const FaceSums& to) {
    for (std::size_t i = 0; i < rows.count; i += lane_count) {
        FaceRow row = load_row(rows, i, depenetration);
        real w[3];
        Corners x;
        x.a = gather_blocks(p.position, rows.corners[0] + i, w[0]);
        x.b = gather_blocks(p.position, rows.corners[1] + i, w[1]);
        x.c = gather_blocks(p.position, rows.corners[2] + i, w[2]);
        const vec3 point = point_of(x, row.weights);
        const real weights[3] = {row.weights.x, row.weights.y, row.weights.z};
        vec3 displacement;
        if (last) {
            real free = real(0.0f);
            for (int k = 0; k < 3; ++k) free = free + select(w[k] > real(0.0f), weights[k], real(0.0f));
            displacement = face_retreat(row, point, free, real(nearest));
        } else {
            real inverse_mass = real(0.0f);
            for (int k = 0; k < 3; ++k) inverse_mass = inverse_mass + w[k] * weights[k] * weights[k];
            ContactSum sum;
            sum.friction = load_blocks(rows.sum + 4 * i, sum.push);
            displacement = face_displacement(row, point, inverse_mass, sum);
            store_blocks(sum.friction, sum.push, rows.sum + 4 * i);
        }
        store_blocks(displacement, row.kinetic_friction, rows.displacement + 4 * i);
        const real size2 = dot(displacement, displacement);
        const std::size_t left = rows.count - i;
        const mask acts = mask_of(left < 16 ? (1u << left) - 1u : 0xffffu) && size2 > real(0.0f);
        if (!any(acts)) continue;
        for (int k = 0; k < 3; ++k) {
            const real part = last ? select(w[k] > real(0.0f), real(1.0f), real(0.0f)) : w[k] * weights[k];
            add_face_pushes(rows.corners[k] + i, displacement * part, sqrt(size2), acts && part > real(0.0f), last, to);
        }
    }
}
