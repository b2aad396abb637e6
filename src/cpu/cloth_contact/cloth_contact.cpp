#include "cpu/cloth_contact/cloth_contact.h"

#include "cpu/cloth_contact/pair_math.h"
#include "solver/plan/cloth_contact_numbers.h"

#include <algorithm>
#include <cmath>

namespace weft::cpu {
namespace {

// How far a particle may leave its listed trajectory, per distance that contact may move it. A larger slack makes lists
// longer, a smaller one makes them fail earlier. The result does not depend on it.
constexpr float slack_per_cap = 1.5f;

}  // namespace

void ClothContact::prepare(const Passes& passes, const WorldStep& step, std::span<ClothState* const> cloths,
                           const std::shared_ptr<const Seams>& seams) {
    cloths_ = cloths;
    tangle_ = step.input.tangle;
    counts_ = {};
    WorldArrays& world = cloths_.front()->world;
    x_ = world.position.data(), velocity_ = world.velocity.data(), start_ = world.start.data();
    loops_ = &contact_loops_of(passes.isa);
    cap_ = 0;
    for (const ClothState* cloth : cloths_) {
        const float cap = contact_cap(*cloth->model);
        if (cloth->model->tiles && (cap_ == 0 || cap < cap_)) cap_ = cap;
    }
    slack_ = slack_per_cap * cap_;
    h_ = frame_numbers(*cloths_.front()->model, *step.plan, step.input.dt).h;

    std::vector<SearchedCloth> searched;
    for (const ClothState* cloth : cloths_) {
        const ClothModel& model = *cloth->model;
        if (model.tiles)
            searched.push_back({model.tiles, cloth->base, model.start.data(),
                                std::max(model.fabric.contact.thickness, least_contact_thickness), slack_,
                                model.collision.filter, seams});
    }
    search_.set_cloths(loops_->search, std::move(searched));
    search_.check_start(x_);

    const std::size_t size = world.size();
    if (part_.size() < size) {
        for (auto* array : {&reached_, &asked_, &farthest_}) array->resize(size);
        sums_.resize(size), share_.resize(size), part_.resize(size);
        sent_back_.resize(size), marked_.resize(size), retreats_.resize(size), slide_.resize(size),
            friction_.resize(size);
    }
    begin_marks(step.input.contact_marks);
    for (const ClothState* cloth : cloths_)
        std::fill_n(friction_.begin() + cloth->base, cloth->model->particle_count,
                    std::array{cloth->model->fabric.contact.friction[0], cloth->model->fabric.contact.friction[1]});
}

void ClothContact::run(const ClothContactContext& context, const Pass& pass, Worker worker) {
    if (worker.number != 0) return help(context, worker);
    cloths_ = context.cloths;
    workers_ = worker.count, barrier_ = &context.barrier;
    lead(pass);
    if (workers_ == 1) return;
    task_ = nullptr;
    context.barrier();
    context.barrier();  // all have seen that the pass is done, before the next one sets a task
}

void ClothContact::lead(const Pass& pass) {
    switch (pass.kind) {
        case PassKind::detect:
            return detect();
        case PassKind::cloth_contact:
            return push(pass);
        case PassKind::limit:
            return limit();
        default:
            return separate();
    }
}

// Waits for tasks of the first worker until its pass is done.
void ClothContact::help(const ClothContactContext& context, Worker worker) {
    while (true) {
        context.barrier();
        const auto* const task = task_;
        if (task) (*task)(worker.number, worker.count);
        context.barrier();
        if (!task) return;
    }
}

void ClothContact::detect() {
    untangle();
    begin_reach();
    find_near_of_motion(search_always_);
    if (brake()) find_near_of_motion(false);
    pushes_of_substep_.clear();
}

// For the motion to where the particles are now.
void ClothContact::find_near_of_motion(bool search_always) {
    for_each_particle([&](std::uint32_t p) { reached_[p] = x_[p]; });
    if (search_.find_outdated(x_, reach_, search_always)) {
        follow_and_search();
        ++counts_.searches;
    }
    find_near();
}

bool ClothContact::comes_near(int kind, std::uint32_t pair) const {
    const NearPairs& near = near_[kind];
    scalar::vec3 from[4], moved[4];
    for (int k = 0; k < 4; ++k) {
        const std::uint32_t p = near.particle[k][pair];
        from[k] = on_lane(start_[p].xyz());
        moved[k] = on_lane(x_[p].xyz() - start_[p].xyz());
    }
    return scalar::comes_near(kind == 1, from[0], from[1], from[2], from[3], moved[0], moved[1], moved[2], moved[3],
                              near.distance[pair], near.thickness[pair]);
}

void ClothContact::find_overlaps() {
    for_each_particle([&](std::uint32_t p) { share_[p] = 0; });
    for (int kind = 0; kind < 2; ++kind) {
        NearPairs& near = near_[kind];
        std::vector<Overlap>& overlaps = overlaps_[kind];
        overlaps.clear();
        loops_->find_overlaps[kind](near, &x_->x, contact_recovery_speed * h_, overlaps);
        std::erase_if(overlaps, [&](const Overlap& overlap) { return !comes_near(kind, overlap.pair); });
        for (const Overlap& overlap : overlaps) {
            near.pushed[overlap.pair] = 1;
            const auto particles = near.particles(overlap.pair);
            const auto weights = weights_of(near, overlap.pair);
            add_shares(particles, weights);
        }
    }
}

void ClothContact::add_shares(std::span<const std::uint32_t> particles, std::span<const float> weights) {
    for (std::size_t k = 0; k < particles.size(); ++k)
        share_[particles[k]] += static_cast<std::uint32_t>(scalar::to_weight_quanta(weights[k]));
}

// Sum of the weights of all pushes of a particle.
float ClothContact::share(std::uint32_t p) const {
    return static_cast<float>(share_[p]) * static_cast<float>(1 / WEFT_WEIGHT_QUANTA);
}

// Adds `change` times the weight and the inverse mass of each particle to the sums.
void ClothContact::add_to_sums(std::span<const std::uint32_t> particles, std::span<const float> weights, Vec3 change,
                               double quanta) {
    for (std::size_t k = 0; k < particles.size(); ++k)
        add_to_sum(particles[k], change * (weights[k] * x_[particles[k]].w), quanta);
}

void ClothContact::add_to_sum(std::uint32_t p, Vec3 change, double quanta) {
    const auto scale = static_cast<float>(quanta);
    sums_[p][0] += to_integer(scalar::to_contact_quanta(change.x, scale));
    sums_[p][1] += to_integer(scalar::to_contact_quanta(change.y, scale));
    sums_[p][2] += to_integer(scalar::to_contact_quanta(change.z, scale));
}

Vec3 ClothContact::sum(std::uint32_t p, double quanta) const {
    const auto axis = [&](int k) {
        return static_cast<float>(static_cast<std::int32_t>(sums_[p][k])) * static_cast<float>(1 / quanta);
    };
    return {axis(0), axis(1), axis(2)};
}

// The masses of the particles are split among the pairs that push them, alike on both sides of a pair, so that momentum
// is kept. In full this is safe and slow. A part of it is enough for pairs that push in different directions; it moves
// pairs that push alike too far, so their pushes are scaled in a second step.
void ClothContact::find_pushes() {
    for (int kind = 0; kind < 2; ++kind) {
        const NearPairs& near = near_[kind];
        for (Overlap& overlap : overlaps_[kind]) {
            const auto particles = near.particles(overlap.pair);
            const auto weights = weights_of(near, overlap.pair);
            const Vec3 normal = normal_of(near, overlap.pair);
            Vec3 moved{};
            float resistance = 0;
            for (int k = 0; k < 4; ++k) {
                const std::uint32_t p = particles[k];
                moved = moved + (x_[p].xyz() - start_[p].xyz()) * weights[k];
                resistance += scalar::contact_resistance(x_[p].w, weights[k], share(p) * contact_split);
            }
            overlap.push = {};
            if (!(resistance > 1e-12f)) continue;
            const auto &one = friction_[particles[0]], &two = friction_[particles[3]];
            const Vec3 rub = to_vec3(scalar::cloth_friction(on_lane(moved), on_lane(normal), overlap.depth,
                                                            std::sqrt(one[0] * two[0]), std::sqrt(one[1] * two[1])));
            overlap.push = (normal * overlap.depth - rub) * (1 / resistance);
        }
    }
}

void ClothContact::add_pushes() {
    for (int kind = 0; kind < 2; ++kind) {
        for (const Overlap& overlap : overlaps_[kind]) {
            const auto particles = near_[kind].particles(overlap.pair);
            const auto weights = weights_of(near_[kind], overlap.pair);
            add_to_sums(particles, weights, overlap.push, WEFT_PUSH_QUANTA_PER_METER);
        }
    }
}

void ClothContact::scale_pushes() {
    for (int kind = 0; kind < 2; ++kind) {
        for (Overlap& overlap : overlaps_[kind]) {
            const auto particles = near_[kind].particles(overlap.pair);
            const auto weights = weights_of(near_[kind], overlap.pair);
            const Vec3 normal = normal_of(near_[kind], overlap.pair);
            float opened = 0;
            for (int k = 0; k < 4; ++k) {
                const Vec3 push = sum(particles[k], WEFT_PUSH_QUANTA_PER_METER);
                opened += weights[k] * (normal.x * push.x + normal.y * push.y + normal.z * push.z);
            }
            if (opened > overlap.depth) overlap.push = overlap.push * (overlap.depth / opened);
        }
    }
    for_each_particle([&](std::uint32_t p) { sums_[p] = {}; });
}

void ClothContact::move_by_pushes() {
    for_each_particle([&](std::uint32_t p) {
        if (share_[p] == 0) return;
        set_place(x_[p], x_[p].xyz() + sum(p, WEFT_PUSH_QUANTA_PER_METER));
        sums_[p] = {};
    });
    keep_in_reach();
}

// What contact moves stays within what the lists cover.
void ClothContact::keep_in_reach() {
    for_each_particle([&](std::uint32_t p) {
        const Vec3 away = x_[p].xyz() - reached_[p].xyz();
        const float length2 = squared(away);
        if (length2 > cap_ * cap_) set_place(x_[p], reached_[p].xyz() + away * (cap_ / std::sqrt(length2)));
    });
}

void ClothContact::push(const Pass& pass) {
    const auto sweep = [&] {
        find_overlaps();
        find_pushes();
        add_pushes();
        scale_pushes();
        add_pushes();
        move_by_pushes();
    };
    if (pass.batch > 0) keep_in_reach();
    extend_reach();
    sweep();
    if (pass.batch + 1 < contact_rounds) return;
    counts_.contacts = overlaps_[0].size() + overlaps_[1].size();
    // Where the limit would have to act, more sweeps are the better answer.
    for (int extra = 0; extra < contact_extra_sweeps; ++extra) {
        extend_reach();
        if (!any_lost()) break;
        sweep();
    }
    for (const NearPairs& near : near_) {
        for (std::uint32_t i = 0; i < near.count; ++i) {
            if (near.pushed[i])
                pushes_of_substep_.push_back({near.particles(i), weights_of(near, i), normal_of(near, i)});
        }
    }
}

// Takes the velocity with which pushed pairs separate, so that contact does not make cloth bounce. Masses are split in
// full, so that one pass never takes too much.
void ClothContact::separate() {
    for_each_particle([&](std::uint32_t p) { share_[p] = 0; });
    const auto for_each_pushed = [&](auto&& visit) {
        for (const Pushed& pair : pushes_of_substep_) visit(pair.particles, pair.weights, pair.normal);
    };
    for_each_pushed([&](const auto& particles, const auto& weights, Vec3) { add_shares(particles, weights); });
    for_each_pushed([&](const auto& particles, const auto& weights, Vec3 normal) {
        float speed = 0, resistance = 0;
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t p = particles[k];
            const Vec3 v = velocity_[p].xyz();
            speed += weights[k] * (normal.x * v.x + normal.y * v.y + normal.z * v.z);
            resistance += scalar::contact_resistance(x_[p].w, weights[k], share(p));
        }
        if (!(speed > 0) || !(resistance > 1e-12f)) return;
        add_to_sums(particles, weights, normal * -(speed / resistance), WEFT_SPEED_QUANTA_PER_METER);
    });
    for_each_particle([&](std::uint32_t p) {
        if (share_[p] == 0) return;
        set_place(velocity_[p], velocity_[p].xyz() + sum(p, WEFT_SPEED_QUANTA_PER_METER));
        sums_[p] = {};
    });
}

}  // namespace weft::cpu
