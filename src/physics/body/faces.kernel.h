// Flat faces of convex bodies, and what lies on them: one text for C++ and GLSL, on one lane (law: body.md). It comes after
// the other kernels.

// m: what is beside a face by less is on it.
#define WEFT_FACE_MARGIN 1e-4
// Largest slope of an edge that lies on a face.
#define WEFT_FACE_SLOPE 0.1

// The faces of a convex shape, in the body's frame: of each the normal, unit, out of the shape, and the offset. The
// surface is farther out by the roundness.
struct FlatFaces {
    ShapeBlocks blocks;
    int first, count;
    real roundness;  // m
};

// The balls among the features of a body: of each the center and the radius, in the body's frame.
struct FeatureBalls {
    ShapeBlocks blocks;
    int first, count;
};

// An edge between two balls, in the frame of its body.
struct BodyEdge { vec3 from, to; real radius_from, radius_to; };

WEFT_FN vec3 placed_by(ContactBody poses, vec3 local)
{
    return rotate(poses.rx, poses.ry, poses.rz, local) + poses.position;
}
WEFT_FN vec3 placed_by_start(ContactBody poses, vec3 local)
{
    return rotate(poses.rx0, poses.ry0, poses.rz0, local) + poses.position0;
}

// The face of `b` on which `a` is: of those that had all balls of `a` before them at the start of the substep, the one
// behind which they are least at its end. If there was none, the one behind which they were least at the start. Its
// number, or -1 without faces.
WEFT_FN int face_toward(FlatFaces faces, FeatureBalls balls, ContactBody a, ContactBody b)
{
    int best = -1;
    bool best_was_before = false;
    real best_distance = real(0);
    for (int i = 0; i < faces.count; ++i) {
        real offset, radius;
        vec3 normal = block_of(faces.blocks, faces.first + i, offset);
        vec3 out_now = rotate(b.rx, b.ry, b.rz, normal), out_start = rotate(b.rx0, b.ry0, b.rz0, normal);
        vec3 along = unrotate(a.rx, a.ry, a.rz, out_now), along_start = unrotate(a.rx0, a.ry0, a.rz0, out_start);
        real least = real(3e38), least_at_start = real(3e38);
        for (int k = 0; k < balls.count; ++k) {
            vec3 center = block_of(balls.blocks, balls.first + k, radius);
            least = min(least, dot(along, center) - radius);
            least_at_start = min(least_at_start, dot(along_start, center) - radius);
        }
        real surface = offset + faces.roundness;
        real distance = dot(out_now, a.position - b.position) + least - surface;
        real distance_at_start = dot(out_start, a.position0 - b.position0) + least_at_start - surface;
        bool was_before = distance_at_start > real(-WEFT_FACE_MARGIN);
        real score = was_before ? distance : distance_at_start;
        bool better = best < 0 || (was_before && !best_was_before) ||
                      (was_before == best_was_before && score > best_distance);
        best = better ? i : best;
        best_was_before = better ? was_before : best_was_before;
        best_distance = better ? score : best_distance;
    }
    return best;
}

// Whether the face lies behind the point, which is in the body's frame, or the point is behind the face in the shape.
WEFT_FN bool is_on_face(FlatFaces faces, int face, vec3 point)
{
    real offset;
    vec3 normal = block_of(faces.blocks, faces.first + face, offset);
    vec3 foot = point - normal * max(dot(normal, point) - offset, real(0));
    real beside = real(-3e38);
    for (int i = 0; i < faces.count; ++i) {
        vec3 other = block_of(faces.blocks, faces.first + i, offset);
        real beyond = dot(other, foot) - offset;
        beside = i == face ? beside : max(beside, beyond);
    }
    return beside < real(WEFT_FACE_MARGIN);
}

// How a ball meets a face.
struct FaceGap {
    bool meets;
    real gap, gap_at_start;  // m
    vec3 normal;             // in the body's frame
};

//   at, at_start   the center of the ball at the end and at the start of the substep, in the body's frame
WEFT_FN FaceGap gap_to_face(FlatFaces faces, int face, vec3 at, vec3 at_start, real radius)
{
    real offset;
    FaceGap to;
    to.normal = block_of(faces.blocks, faces.first + face, offset);
    real surface = offset + faces.roundness + radius;
    to.gap = dot(to.normal, at) - surface;
    to.gap_at_start = dot(to.normal, at_start) - surface;
    to.meets = is_on_face(faces, face, at);
    // A fast ball may have left the face behind after it passed it.
    if (!to.meets && to.gap < real(0) && to.gap_at_start > real(0)) {
        real time = to.gap_at_start / (to.gap_at_start - to.gap);
        to.meets = is_on_face(faces, face, at_start + (at - at_start) * time);
    }
    return to;
}

// Whether an edge of `a` lies along the face, and where: an interval of the edge.
struct EdgeOnFace { bool lies; real low, high; };

WEFT_FN EdgeOnFace edge_on_face(FlatFaces faces, int face, ContactBody a, ContactBody b, BodyEdge edge)
{
    vec3 from = to_body(b, placed_by(a, edge.from)), to = to_body(b, placed_by(a, edge.to));
    real offset, low = real(0), high = real(1);
    for (int i = 0; i < faces.count; ++i) {
        vec3 normal = block_of(faces.blocks, faces.first + i, offset);
        // Half of the margin leaves room for rounding: is_on_face() holds for both ends.
        real beyond_from = dot(normal, from) - offset - real(0.5 * WEFT_FACE_MARGIN);
        real beyond_to = dot(normal, to) - offset - real(0.5 * WEFT_FACE_MARGIN);
        bool cuts_from = i != face && beyond_from > real(0), cuts_to = i != face && beyond_to > real(0);
        real crossing = beyond_from / (cuts_from == cuts_to ? real(1) : beyond_from - beyond_to);
        low = cuts_from ? (cuts_to ? real(2) : max(low, crossing)) : low;
        high = cuts_to && !cuts_from ? min(high, crossing) : high;
    }
    vec3 normal = block_of(faces.blocks, faces.first + face, offset), along = to - from;
    real rise = dot(normal, along) - (edge.radius_to - edge.radius_from);
    EdgeOnFace on;
    on.lies = low < high && rise * rise < real(WEFT_FACE_SLOPE * WEFT_FACE_SLOPE) * dot(along, along);
    on.low = low;
    on.high = high;
    return on;
}
