#include "cpu/body_contacts.h"

#include "solver/plan/frame_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft::cpu {
namespace {

using scalar::vec3;
using scalar::vector_of;

scalar::Solid solid_of(const Collider& collider) {
    return {static_cast<int>(collider.shape),
            {collider.numbers[0], collider.numbers[1], collider.numbers[2], collider.numbers[3], blocks_of(collider)},
            steepness_of(collider),
            roundness_of(collider),
            layer_distance_of(collider)};
}

scalar::ContactBody between_poses(const Pose& before, const Pose& now) {
    scalar::ContactBody body{};
    body.rx = vector_of(now.rotation.x), body.ry = vector_of(now.rotation.y), body.rz = vector_of(now.rotation.z);
    body.position = vector_of(now.position);
    body.rx0 = vector_of(before.rotation.x), body.ry0 = vector_of(before.rotation.y);
    body.rz0 = vector_of(before.rotation.z), body.position0 = vector_of(before.position);
    return body;
}

// m: a contact that is open by less is listed, because pushes in the substep may close it.
constexpr float open_margin = 1e-4f;

}  // namespace

void place(BodyInStep& body) {
    const Mat3 rotation = columns_of(body.motion.turn);
    body.now = {rotation, vector_of(body.motion.place) - rotation * body.of->body->mass.center};
}

void turn_inertia(BodyInStep& body) {
    const Mat3& rotation = body.now.rotation;
    // R I⁻¹ Rᵀ, column by column.
    const auto column = [&](Vec3 row) {
        const vec3 along = times_symmetric(body.inertia.inverse_moments, body.inertia.inverse_products, vector_of(row));
        return rotation * vector_of(along);
    };
    const Mat3 back = transposed(rotation);
    body.inverse_inertia = {column(back.x), column(back.y), column(back.z)};
}

void push(BodyInStep& body, const scalar::BodyPush& by, float h) {
    push_body(body.motion, body.inverse_mass, body.inertia, by, {h, 1 / h, 1 / h / h, 0, 1});
    place(body);
}

void BodyContacts::begin_frame(const StepInput& input, std::span<BodyInStep> bodies,
                               std::span<const std::uint32_t> body_of, float h) {
    input_ = &input;
    bodies_ = bodies;
    body_of_ = body_of;
    h_ = h;
    pairs_.clear();
    rows_.clear();
}

const Pose& BodyContacts::now(std::uint32_t collider) const {
    const std::uint32_t body = body_of_[collider];
    return body == none ? input_->places->pose(collider, substep_ + 1) : bodies_[body].now;
}
const Pose& BodyContacts::before(std::uint32_t collider) const {
    const std::uint32_t body = body_of_[collider];
    return body == none ? input_->places->pose(collider, substep_) : bodies_[body].before;
}

void BodyContacts::find_pairs(std::span<const Bounds> reach) {
    pairs_.clear();
    const auto add = [&](std::uint32_t features, std::uint32_t shape) {
        const BodyFeatures& of = input_->colliders[features].features;
        if (!of.points.empty() || !of.edges.empty()) pairs_.push_back({features, shape});
    };
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const std::uint32_t mine = bodies_[i].collider;
        for (std::size_t k = 0; k < i; ++k) {
            if (!reach[i].overlaps(reach[k])) continue;
            add(mine, bodies_[k].collider), add(bodies_[k].collider, mine);
        }
        found_.clear();
        input_->places->find(reach[i], found_);
        for (const std::uint32_t other : found_)
            if (body_of_[other] == none) add(mine, other), add(other, mine);
    }
    std::ranges::sort(pairs_);
}

void BodyContacts::find_contacts(std::uint32_t substep) {
    substep_ = substep;
    rows_.clear();
    for (const Pair& pair : pairs_) find_contacts(pair);
}

void BodyContacts::find_contacts(const Pair& pair) {
    // Of a pair of a body and a collider the body tells how far both are apart; of two bodies that with the features.
    const bool first = body_of_[pair.features] != none;
    const std::uint32_t ball = first ? pair.features : pair.shape, solid = first ? pair.shape : pair.features;
    const BodyInStep& body = bodies_[body_of_[ball]];
    const Vec3 center = vector_of(body.motion.place);
    const Collider& other = input_->colliders[solid];
    float way = length(vector_of(body.v)) * h_ + length(vector_of(body.rate)) * h_ * body.radius;
    const std::uint32_t other_body = body_of_[solid];
    if (other_body != none) {
        const BodyInStep& b = bodies_[other_body];
        way += length(vector_of(b.v)) * h_ + length(vector_of(b.rate)) * h_ * b.radius;
    } else {
        way += length(to_world(now(solid), to_local(before(solid), center)) - center);
    }
    vec3 unused;
    const float distance = scalar::solid_distance(solid_of(other), vector_of(to_local(now(solid), center)), unused);
    const float margin = open_margin + 0.5f * way;
    if (distance > steepness_of(other) * (body.radius + margin + 2 * way)) return;
    const BodyFeatures& features = input_->colliders[pair.features].features;
    for (const RoundPoint& point : features.points) touch(pair, point.place, point.radius, margin);
    for (const RoundEdge& edge : features.edges) search_edge(pair, edge, margin);
}

// Contact of a ball of the features with the shape.
void BodyContacts::touch(const Pair& pair, Vec3 local, float radius, float margin) {
    const Collider &mine = input_->colliders[pair.features], &other = input_->colliders[pair.shape];
    const scalar::Solid solid = solid_of(other);
    const Pose& pose = now(pair.shape);
    scalar::ContactBody body = between_poses(before(pair.shape), pose);
    body.half_thickness = radius;
    const vec3 x = vector_of(to_world(now(pair.features), local));
    const vec3 start = vector_of(to_world(before(pair.features), local));
    const vec3 at = to_body(body, x), at_start = to_body_at_start(body, start);
    vec3 normal;
    const float gap = scalar::solid_distance(solid, at, normal) - radius;
    const vec3 way = at - at_start;
    if (gap > margin + 2 * solid.steepness * std::sqrt(dot(way, way))) return;
    const scalar::ContactPlane plane = contact_plane(solid, body, {vec3(0.0f), 0}, at, at_start, gap, normal);
    if (!(plane.gap < margin)) return;
    const vec3 world_normal = rotate(body.rx, body.ry, body.rz, plane.normal), touched = x - world_normal * radius;
    const vec3 foot = at - plane.normal * (plane.gap + radius);
    const auto restitution = [](const Collider& one) { return one.body ? one.body->desc.restitution : 0; };
    rows_.push_back(
        {.a = body_of_[pair.features],
         .b = body_of_[pair.shape],
         .collider_a = pair.features,
         .collider_b = pair.shape,
         .local_a = local,
         .local_b = vector_of(foot),
         .normal = world_normal,
         .radius = radius,
         .gap_at_start = plane.gap_at_start,
         .approach = dot(world_normal, velocity_before(pair.features, touched) - velocity_before(pair.shape, touched)),
         .static_friction = std::sqrt(mine.friction[0] * other.friction[0]),
         .kinetic_friction = std::sqrt(mine.friction[1] * other.friction[1]),
         .restitution = std::max(restitution(mine), restitution(other))});
}

// Where an edge is nearest to the shape between its ends, which are features of their own. Each step goes to where the
// tangents at the ends of the interval meet: a distance whose slope only grows lies above both.
void BodyContacts::search_edge(const Pair& pair, const RoundEdge& edge, float margin) {
    struct End {
        float part, distance, slope;
    };
    const scalar::Solid solid = solid_of(input_->colliders[pair.shape]);
    const Pose &mine = now(pair.features), &other = now(pair.shape);
    const Vec3 from = to_local(other, to_world(mine, edge.from)), to = to_local(other, to_world(mine, edge.to));
    const float taper = edge.radius_to - edge.radius_from;
    const auto evaluate = [&](float part) {
        vec3 normal;
        const float distance = scalar::solid_distance(solid, vector_of(from + (to - from) * part), normal);
        return End{part, distance - edge.radius_from - taper * part, dot(normal, vector_of(to - from)) - taper};
    };
    End low = evaluate(0), high = evaluate(1);
    const float ends = std::min(low.distance, high.distance);
    constexpr int steps = 6;
    End best = low.distance < high.distance ? low : high;
    for (int i = 0; i < steps && low.slope < 0 && high.slope > 0; ++i) {
        const float width = high.part - low.part;
        const float part =
            std::clamp((high.distance - high.slope * width - low.distance) / (low.slope - high.slope), 0.0f, width);
        if (low.distance + low.slope * part > margin) return;
        const End next = evaluate(low.part + part);
        if (next.distance < best.distance) best = next;
        (next.slope < 0 ? low : high) = next;
    }
    // What lies flat touches with its ends.
    if (!(best.distance < std::min(margin, ends - open_margin))) return;
    touch(pair, edge.from + (edge.to - edge.from) * best.part, edge.radius_from + taper * best.part, margin);
}

scalar::MovedBody BodyContacts::side_of(std::uint32_t number) const {
    if (number == none) return scalar::immovable();
    const BodyInStep& body = bodies_[number];
    const Mat3& inverse = body.inverse_inertia;
    return {1, body.inverse_mass, body.motion.place, vector_of(inverse.x), vector_of(inverse.y), vector_of(inverse.z)};
}

// How far the point of the collider that is now at `x` has moved since the start of the substep.
vec3 BodyContacts::way_of(std::uint32_t collider, vec3 x) const {
    const Vec3 there = vector_of(x);
    return vector_of(there - to_world(before(collider), to_local(now(collider), there)));
}

void BodyContacts::project() {
    const float depenetration = depenetration_speed * h_;
    for (Row& row : rows_) {
        const scalar::MovedBody a = side_of(row.a), b = side_of(row.b);
        const vec3 xa = vector_of(to_world(now(row.collider_a), row.local_a));
        const vec3 xb = vector_of(to_world(now(row.collider_b), row.local_b));
        const vec3 touched = xa - row.normal * row.radius;
        scalar::ContactSum sum{row.friction, row.push};
        const vec3 way = way_of(row.collider_a, touched) - way_of(row.collider_b, touched);
        const vec3 by = project_body_row(
            {row.normal, row.gap_at_start, row.static_friction, row.kinetic_friction, depenetration}, sum,
            dot(row.normal, xa - xb) - row.radius, way, a, b, touched - a.center, touched - b.center);
        row.friction = sum.friction, row.push = sum.push;
        if (dot(by, by) > 0)
            apply(row, touched, by * (1 / h_),
                  [&](BodyInStep& body, const scalar::BodyPush& one) { push(body, one, h_); });
    }
}

template <class Apply>
void BodyContacts::apply(const Row& row, vec3 touched, vec3 impulse, Apply&& to) {
    const auto one = [&](std::uint32_t number, vec3 by) {
        if (number == none) return;
        BodyInStep& body = bodies_[number];
        to(body, scalar::BodyPush{by, cross(touched - body.motion.place, by)});
    };
    one(row.a, impulse);
    one(row.b, -impulse);
}

// After Müller et al. 2020, "Detailed Rigid Body Simulation with Extended Position Based Dynamics", section 3.6: the
// velocities at a contact become what restitution makes of those before it, or zero. Projections alone leave some, and
// what stands would tremble. What gravity adds in two substeps does not bounce. No contact takes back more than it
// gave.
void BodyContacts::bounce() {
    const float slow = 2 * h_ * length(input_->gravity);
    for (Row& row : rows_) {
        if (!(row.push > 0)) continue;
        const scalar::MovedBody a = side_of(row.a), b = side_of(row.b);
        const vec3 touched = vector_of(to_world(now(row.collider_a), row.local_a)) - row.normal * row.radius;
        const vec3 speed = velocity_at(row.collider_a, touched) - velocity_at(row.collider_b, touched);
        const float wanted = row.approach < -slow ? -row.restitution * row.approach : 0;
        const float w = weight_of(a, touched - a.center, row.normal) + weight_of(b, touched - b.center, row.normal);
        const float impulse =
            std::max((wanted - dot(row.normal, speed)) / std::max(w, 1e-30f), -row.push / h_ - row.taken);
        row.taken += impulse;
        apply(row, touched, row.normal * impulse,
              [](BodyInStep& body, const scalar::BodyPush& one) { hit_body(body.motion, body.inverse_mass, one); });
    }
}

// m/s, of the collider's point at `x` now.
vec3 BodyContacts::velocity_at(std::uint32_t collider, vec3 x) const {
    const std::uint32_t number = body_of_[collider];
    if (number == none) return way_of(collider, x) * (1 / h_);
    const BodyInStep& body = bodies_[number];
    return body.motion.v + cross(rate_of(body.motion.turn, body.motion.spin, body.inertia), x - body.motion.place);
}

// m/s, likewise at the start of the substep, before contact.
vec3 BodyContacts::velocity_before(std::uint32_t collider, vec3 x) const {
    const std::uint32_t number = body_of_[collider];
    if (number == none) return way_of(collider, x) * (1 / h_);
    const BodyInStep& body = bodies_[number];
    return body.v + cross(body.rate, x - body.motion.place);
}

}  // namespace weft::cpu
