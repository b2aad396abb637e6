#include "cpu/body_contacts.h"

#include "solver/plan/body_numbers.h"
#include "solver/plan/frame_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace weft::cpu {
namespace {

using scalar::vec3;
using scalar::vector_of;

scalar::Solid solid_of(const Collider& collider) {
    return {static_cast<int>(collider.shape),
            {collider.numbers[0], collider.numbers[1], collider.numbers[2], collider.numbers[3], blocks_of(collider)},
            steepness_of(collider),
            roundness_of(collider),
            width_of(collider)};
}

scalar::FlatFaces faces_of(const BodyFeatures& features) {
    static_assert(sizeof(FlatFace) == 4 * sizeof(float));
    return {{reinterpret_cast<const float*>(features.faces.data())},
            0,
            static_cast<int>(features.faces.size()),
            features.roundness};
}

scalar::FeatureBalls balls_of(const BodyFeatures& features) {
    static_assert(sizeof(RoundPoint) == 4 * sizeof(float));
    return {{reinterpret_cast<const float*>(features.points.data())}, 0, static_cast<int>(features.points.size())};
}

scalar::ContactBody between_poses(const Pose& before, const Pose& now) {
    scalar::ContactBody body{};
    body.rx = vector_of(now.rotation.x), body.ry = vector_of(now.rotation.y), body.rz = vector_of(now.rotation.z);
    body.position = vector_of(now.position);
    body.rx0 = vector_of(before.rotation.x), body.ry0 = vector_of(before.rotation.y);
    body.rz0 = vector_of(before.rotation.z), body.position0 = vector_of(before.position);
    return body;
}

float restitution_of(const Collider& collider) {
    return collider.body ? collider.body->desc.restitution : 0;
}

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
    push_body(body.motion, body.inverse_mass, body.inertia, by, scalar::step_without_limits(h, 1 / h, 1 / h / h));
    place(body);
}

void shift(BodyInStep& body, const scalar::BodyPush& by, float h) {
    shift_body(body.motion, body.inverse_mass, body.inertia, by, scalar::step_without_limits(h, 1 / h, 1 / h / h));
    place(body);
}

void BodyContacts::begin_frame(const StepInput& input, std::span<BodyInStep> bodies,
                               std::span<const std::uint32_t> body_of, float h) {
    input_ = &input;
    bodies_ = bodies;
    body_of_ = body_of;
    step_ = scalar::step_without_limits(h, 1 / h, 1 / h / h);
    pairs_.clear();
    rows_.clear();
}

BodyInStep* BodyContacts::body_of(std::uint32_t collider) const {
    const std::uint32_t number = body_of_[collider];
    return number == none ? nullptr : &bodies_[number];
}

scalar::BodySide BodyContacts::side_of(std::uint32_t collider) const {
    const BodyInStep* body = body_of(collider);
    if (!body) {
        const ColliderPlaces& places = *input_->places;
        return {between_poses(places.pose(collider, substep_), places.pose(collider, substep_ + 1)),
                scalar::immovable(), vec3(0.0f), vec3(0.0f), false};
    }
    const Mat3& inverse = body->inverse_inertia;
    return {
        between_poses(body->before, body->now),
        {1, body->inverse_mass, body->motion.place, vector_of(inverse.x), vector_of(inverse.y), vector_of(inverse.z)},
        body->v,
        body->rate,
        true};
}

scalar::BodySide BodyContacts::side_now(std::uint32_t collider) const {
    scalar::BodySide side = side_of(collider);
    if (const BodyInStep* body = body_of(collider)) {
        side.v = body->motion.v;
        side.rate = rate_of(body->motion.turn, body->motion.spin, body->inertia);
    }
    return side;
}

void BodyContacts::find_pairs(std::span<const Bounds> reach) {
    pairs_.clear();
    const auto add = [&](std::uint32_t features, std::uint32_t shape) {
        const BodyFeatures& of = input_->colliders[features].features;
        if (of.points.empty() && of.edges.empty()) return;
        if (scalar::features_meet(kind_of_features(input_->colliders[features]),
                                  kind_of_features(input_->colliders[shape]), features < shape))
            pairs_.push_back({features, shape});
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
    std::swap(rows_, before_);
    rows_.clear();
    for (const Pair& pair : pairs_) find_contacts(pair);
    go_on();
}

// Rows are in the order of their keys.
void BodyContacts::go_on() {
    const auto key = [](const Row& row) { return std::tie(row.a, row.b, row.place); };
    auto old = before_.cbegin();
    for (Row& row : rows_) {
        while (old != before_.cend() && key(*old) < key(row)) ++old;
        if (old == before_.cend() || key(*old) != key(row)) continue;
        go_on_from(old->touch, slow(), row.touch);
        vec3 touched;
        const vec3 by = given_by(row.touch, side_of(row.a), touched);
        if (dot(by, by) > 0)
            apply(row, touched, by * step_.inv_h,
                  [&](BodyInStep& body, const scalar::BodyPush& one) { push(body, one, step_.h); });
    }
}

// Of a pair of a body and a collider the body gives how far both are apart; of two bodies the one with the features.
void BodyContacts::find_contacts(const Pair& pair) {
    const bool first = body_of_[pair.features] != none;
    const BodyInStep& body = *body_of(first ? pair.features : pair.shape);
    const std::uint32_t other = first ? pair.shape : pair.features;
    const scalar::BodySide a = side_of(pair.features), b = side_of(pair.shape);
    const scalar::BodySide& of_body = first ? a : b;
    const scalar::BodySide& of_other = first ? b : a;
    const vec3 center = body.motion.place;
    float way = way_of_body(of_body, body.radius, step_);
    if (const BodyInStep* other_body = body_of(other)) {
        way += way_of_body(of_other, other_body->radius, step_);
    } else {
        way += scalar::way_of_collider(of_other.poses, center);
    }
    const Collider &mine = input_->colliders[pair.features], &theirs = input_->colliders[pair.shape];
    const float margin = body_margin(solid_of(input_->colliders[other]), of_other.poses, center, body.radius, way);
    if (margin < 0) return;
    const scalar::Solid solid = solid_of(theirs);
    const scalar::FlatFaces faces = faces_of(theirs.features);
    const int face = mine.features.edges.empty() ? -1 : face_toward(faces, balls_of(mine.features), a.poses, b.poses);
    std::uint32_t place = 0;
    const auto add = [&](Vec3 local, float radius) {
        Row row{pair.features, pair.shape, place, {}};
        if (!touch_body(solid, faces, face, a, b, vector_of(local), radius, margin, step_, row.touch)) return;
        row.touch.static_friction = std::sqrt(mine.friction[0] * theirs.friction[0]);
        row.touch.kinetic_friction = std::sqrt(mine.friction[1] * theirs.friction[1]);
        row.touch.restitution = std::max(restitution_of(mine), restitution_of(theirs));
        rows_.push_back(row);
    };
    for (const RoundPoint& point : mine.features.points) {
        add(point.place, point.radius);
        ++place;
    }
    for (const RoundEdge& edge : mine.features.edges) {
        const scalar::BodyEdge at{vector_of(edge.from), vector_of(edge.to), edge.radius_from, edge.radius_to};
        for (const bool last : {false, true}) {
            const float part = touching_part(solid, faces, face, a.poses, b.poses, at, margin, last);
            if (part >= 0)
                add(edge.from + (edge.to - edge.from) * part,
                    edge.radius_from + (edge.radius_to - edge.radius_from) * part);
            ++place;
        }
    }
}

// Whether a sweep may change anything. Most contacts are open, so this comes before the sides are put together.
bool BodyContacts::acts(const Row& row) const {
    return row.touch.push > 0 || gap_of(row) < std::min(0.0f, row.touch.gap_at_start);
}

float BodyContacts::gap_of(const Row& row) const {
    const scalar::BodyTouch& touch = row.touch;
    const auto place = [&](std::uint32_t collider, vec3 local) {
        const BodyInStep* body = body_of(collider);
        return vector_of(to_world(body ? body->now : input_->places->pose(collider, substep_ + 1), vector_of(local)));
    };
    return dot(touch.normal, place(row.a, touch.local_a) - place(row.b, touch.local_b)) - touch.radius;
}

void BodyContacts::project() {
    for (Row& row : rows_) {
        if (!acts(row)) continue;
        vec3 touched;
        const vec3 by = project_bodies(row.touch, side_of(row.a), side_of(row.b), touched);
        if (dot(by, by) > 0)
            apply(row, touched, by * step_.inv_h,
                  [&](BodyInStep& body, const scalar::BodyPush& one) { push(body, one, step_.h); });
    }
}

template <class Apply>
void BodyContacts::apply(const Row& row, vec3 touched, vec3 impulse, Apply&& to) {
    const auto one = [&](std::uint32_t collider, vec3 by) {
        BodyInStep* body = body_of(collider);
        if (body) to(*body, scalar::BodyPush{by, cross(touched - body->motion.place, by)});
    };
    one(row.a, impulse);
    one(row.b, -impulse);
}

// m/s: what gravity adds in two substeps. What is slower does not bounce.
float BodyContacts::slow() const {
    return 2 * step_.h * length(input_->gravity);
}

void BodyContacts::bounce() {
    for (Row& row : rows_) {
        if (!(row.touch.push > 0)) continue;
        vec3 touched;
        const vec3 impulse = bounce_bodies(row.touch, side_now(row.a), side_now(row.b), slow(), step_, touched);
        apply(row, touched, impulse,
              [](BodyInStep& body, const scalar::BodyPush& one) { hit_body(body.motion, body.inverse_mass, one); });
    }
}

void BodyContacts::lift() {
    const float depenetration = depenetration_speed * step_.h;
    for (const Row& row : rows_) {
        if (!(gap_of(row) < lifted_gap(row.touch, depenetration))) continue;
        vec3 touched;
        const vec3 by = lift_bodies(row.touch, side_of(row.a), side_of(row.b), depenetration, touched);
        apply(row, touched, by * step_.inv_h,
              [&](BodyInStep& body, const scalar::BodyPush& one) { shift(body, one, step_.h); });
    }
}

}  // namespace weft::cpu
