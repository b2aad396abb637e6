#include "cpu/bodies.h"

#include "base/flush_subnormals.h"
#include "cpu/moving_ball.h"
#include "solver/plan/body_numbers.h"

#include <algorithm>
#include <cmath>

namespace weft::cpu {
namespace {

using scalar::vec3;
using scalar::vector_of;

// A body is expected in a box around its free flight, larger by this part of its way and of its radius.
constexpr float reach_per_way = 0.25f, reach_per_radius = 0.25f;

Bounds ball(Vec3 center, float radius) {
    const Vec3 by{radius, radius, radius};
    return {center - by, center + by};
}

vec3 from_quanta(const std::array<std::uint64_t, 3>& sum) {
    const auto axis = [](std::uint64_t quanta) {
        return static_cast<float>(static_cast<double>(static_cast<std::int64_t>(quanta)) /
                                  WEFT_IMPULSE_QUANTA_PER_UNIT);
    };
    return {axis(sum[0]), axis(sum[1]), axis(sum[2])};
}

}  // namespace

void Bodies::prepare(const WorldStep& step, unsigned workers) {
    const StepInput& input = step.input;
    if (input.bodies.empty()) {
        bodies_.clear(), body_of_.clear();
        return;
    }
    steps_.assign(input.bodies.begin(), input.bodies.end());
    bodies_.resize(steps_.size());
    body_of_.assign(input.colliders.size(), none);
    if (sums_.size() < workers) sums_.resize(workers);
    for (auto& sums : sums_) sums.assign(steps_.size(), {});
    reach_.assign(steps_.size(), {});
    gravity_ = input.gravity;
    h_ = static_cast<float>(input.dt / step.plan->substeps);
    substep_ = 0;
    substeps_ = step.plan->substeps;
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
        BodyInStep& body = bodies_[i];
        body.collider = steps_[i].collider;
        body.of = &input.colliders[body.collider];
        body_of_[body.collider] = i;
        const BodyMass& mass = body.of->body->mass;
        body.motion = scalar::motion_of(*steps_[i].state);
        body.inertia = scalar::inertia_of(mass);
        body.inverse_mass = 1 / mass.mass;
        body.radius = radius_about(mass.center, body.of->bounds);
        body.ball_radius = cpu::ball_radius(*body.of);
        place(body);
        turn_inertia(body);
    }
    contacts_.begin_frame(input, bodies_, body_of_, h_);
    watch_reach();
}

void Bodies::run(const Pass& pass) {
    switch (pass.kind) {
        case PassKind::predict_bodies:
            return predict();
        case PassKind::move_bodies:
            if (pass.batch == move_before_faces) {
                for (BodyInStep& body : bodies_) body.found = body.now;
                return count_touches();
            }
            take_sums(sweeps_of_move(pass.batch, substep_));
            if (pass.batch == move_after_pulls)
                for (BodyInStep& body : bodies_) body.placed = body.now;
            return;
        default:  // finish_bodies
            for (std::uint32_t sweep = 0; sweep < sweeps_in(substep_, sweeps_of_velocities); ++sweep)
                contacts_.bounce();
            contacts_.lift();
            ++substep_;
            return watch_reach();
    }
}

void Bodies::run_alone(const WorldPlan& plan) {
    const FlushSubnormals flush;
    for (std::uint32_t substep = 0; substep < plan.substeps; ++substep) {
        predict();
        for (std::uint32_t sweep = 0; sweep < body_sweeps; ++sweep)
            take_sums(sweeps_of_move(move_after_particles, substep_));
        run({.kind = PassKind::finish_bodies});
    }
}

void Bodies::predict() {
    const scalar::Step step = scalar::step_without_limits(h_, 1 / h_, 1 / h_ / h_);
    for (BodyInStep& body : bodies_) {
        const BodyDesc& desc = body.of->body->desc;
        body.before = body.now;
        body.v = body.motion.v;
        body.rate = rate_of(body.motion.turn, body.motion.spin, body.inertia);
        predict_body(body.motion, body.inertia, vector_of(gravity_), 1 / (1 + h_ * desc.damping),
                     1 / (1 + h_ * desc.spin_damping), step);
        body.contacts = 0;
        place(body);
        body.placed = body.now;
        turn_inertia(body);
    }
    for (auto& sums : sums_) std::ranges::fill(sums, BodySums{});
    contacts_.find_contacts(substep_);
}

// How many particles touch each body.
void Bodies::count_touches() {
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        std::uint32_t touches = 0;
        for (auto& sums : sums_) touches += sums[i].touches, sums[i].touches = 0;
        bodies_[i].contacts = std::max(bodies_[i].contacts, static_cast<float>(touches));
    }
}

// What the cloth's sweep has added up moves the bodies, then their contacts with one another and with colliders do.
void Bodies::take_sums(std::uint32_t sweeps) {
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        BodySums all;
        for (auto& sums : sums_) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                all.impulse[axis] += sums[i].impulse[axis], all.twist[axis] += sums[i].twist[axis];
            sums[i].impulse = {}, sums[i].twist = {};
        }
        if (all.impulse != BodySums{}.impulse || all.twist != BodySums{}.twist)
            push(bodies_[i], {from_quanta(all.impulse), from_quanta(all.twist)}, h_);
    }
    count_touches();
    for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep) contacts_.project();
}

bool Bodies::all_finite() const {
    return std::ranges::all_of(bodies_, [](const BodyInStep& body) { return is_finite(state_of(body.motion)); });
}

void Bodies::finish() const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) *steps_[i].state = state_of(bodies_[i].motion);
}

void Bodies::add_push(unsigned worker, std::uint32_t number, Vec3 by, Vec3 x, float w) {
    add_impulse(worker, number, by * scalar::contact_momentum(w, 1 / h_), x);
}

void Bodies::add_impulse(unsigned worker, std::uint32_t number, Vec3 impulse, Vec3 x) {
    BodySums& sums = sums_[worker][number];
    const Vec3 twist = cross(x - vector_of(bodies_[number].motion.place), impulse);
    const auto add = [](std::array<std::uint64_t, 3>& sum, Vec3 more) {
        const float axes[3] = {more.x, more.y, more.z};
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum[axis] += static_cast<std::uint64_t>(static_cast<std::int64_t>(scalar::to_impulse_quanta(axes[axis])));
    };
    add(sums.impulse, impulse);
    add(sums.twist, twist);
}

scalar::MovedBody Bodies::moved_by_attached(std::uint32_t number) const {
    const BodyInStep& body = bodies_[number];
    const Mat3& inverse = body.inverse_inertia;
    const float shares = feels_cloth(number) ? static_cast<float>(steps_[number].attached) : 0;
    return {
        shares, body.inverse_mass, body.motion.place, vector_of(inverse.x), vector_of(inverse.y), vector_of(inverse.z)};
}

BodyView Bodies::view(std::uint32_t number, unsigned worker) {
    const BodyInStep& body = bodies_[number];
    const bool moved = body.of->body->desc.reaction;
    return {.contacts = moved ? body.contacts : 0,
            .inverse_mass = body.inverse_mass,
            .center = vector_of(body.motion.place),
            .inverse_inertia = body.inverse_inertia,
            .inv_h = 1 / h_,
            .sums = &sums_[worker][number],
            .moved = moved};
}

// Where each body is expected in the rest of the frame. If one is elsewhere, all lists are made again.
void Bodies::watch_reach() {
    bool changed = false;
    const float seconds = h_ * static_cast<float>(substeps_ - substep_);
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
        const BodyInStep& body = bodies_[i];
        const Vec3 place = vector_of(body.motion.place), v = vector_of(body.motion.v);
        // It must be in its box after the next substep too.
        const Vec3 next = place + v * h_;
        const Bounds now = ball(place, body.radius), then = ball(next, body.radius);
        if (!reach_[i].empty() && reach_[i].contains(now.min) && reach_[i].contains(now.max) &&
            reach_[i].contains(then.min) && reach_[i].contains(then.max))
            continue;
        const Vec3 end = place + v * seconds + gravity_ * (0.5f * seconds * seconds);
        const float radius =
            body.radius * (1 + reach_per_radius) + reach_per_way * length(v) * seconds + length(v) * h_;
        for (const Vec3 at : {place, end}) {
            const Bounds box = ball(at, radius);
            reach_[i].include(box.min), reach_[i].include(box.max);
        }
        changed = true;
    }
    if (!changed) return;
    ++reach_serial_;
    contacts_.find_pairs(reach_);
}

void Bodies::find(const Bounds& box, std::vector<std::uint32_t>& to) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (reach_[i].overlaps(box)) to.push_back(bodies_[i].collider);
}

}  // namespace weft::cpu
