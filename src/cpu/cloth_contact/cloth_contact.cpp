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

// Contact does not move the particles of surfaces, whatever it may do to those of cloths.
float cap_of(const ClothModel& model, float surface_motion) {
    return model.collision.surface ? cap_of_surface : carried_cap(contact_cap(model), surface_motion);
}

// Moves the pushes of a worker to those of all.
void move_pushes(ContactSums& to, ContactSums& from) {
    for (std::size_t axis = 0; axis < 3; ++axis) to.push[axis] += from.push[axis];
    from.push = {};
}

}  // namespace

void ClothContact::prepare(const Passes& passes, const WorldStep& step, std::span<ClothState* const> cloths,
                           std::span<const ClothStep* const> steps, const std::shared_ptr<const Seams>& seams,
                           ContactArrays& arrays, std::span<Bounds* const> swept) {
    cloths_ = cloths;
    swept_ = swept;
    tangle_ = step.input.tangle;
    counts_ = {};
    WorldArrays& world = cloths_.front()->world;
    x_ = world.position.data(), velocity_ = world.velocity.data(), start_ = world.start.data();
    loops_ = &contact_loops_of(passes.isa);
    h_ = frame_numbers(*cloths_.front()->model, *step.plan, step.input.dt).h;
    use(arrays);
    records_marks_ = step.input.contact_marks;

    std::vector<SearchedCloth> searched;
    std::vector<std::uint8_t> rests;
    carriers_.clear();
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        const ClothModel& model = *cloths_[i]->model;
        prepare_particles(*cloths_[i], *steps[i], step.input.surface_motion);
        if (model.tiles) rests.push_back(cloths_[i]->rests);
        if (model.tiles)
            searched.push_back({model.tiles, cloths_[i]->base, model.rest_of_features(), pair_thickness(model),
                                slack_per_cap * cap_of(model, 0), model.collision.surface, is_thin(model),
                                model.collision.filter, seams, uneven_pair_thickness(model)});
    }
    float least_slack = slack_per_cap * cap_of_surface;
    for (const SearchedCloth& cloth : searched) least_slack = std::min(least_slack, cloth.slack);
    for (SearchedCloth& cloth : searched)
        if (cloth.surface) cloth.slack = least_slack;
    least_cap_ = carried_cap(least_slack / slack_per_cap, step.input.surface_motion);
    search_.set_cloths(loops_->search, std::move(searched));
    search_.set_resting(rests);
    search_.check_start(x_);
    caps_.resize(search_.tile_count()), own_caps_.resize(search_.tile_count());
    for (std::uint32_t tile = 0; tile < caps_.size(); ++tile) {
        const SearchedCloth& cloth = search_.cloth(tile);
        own_caps_[tile] = cloth.surface ? 0 : cloth.slack / slack_per_cap;
        caps_[tile] = cloth.surface ? 0 : carried_cap(own_caps_[tile], step.input.surface_motion);
    }
    sweep_boxes();
}

void ClothContact::prepare_particles(const ClothState& cloth, const ClothStep& step, float surface_motion) {
    const ClothModel& model = *cloth.model;
    const std::uint32_t base = cloth.base, count = model.particle_count;
    const auto& friction = model.fabric.contact.friction;
    std::fill_n(numbers_ + base, count,
                Vec4{friction[0], friction[1], cap_of(model, surface_motion), cap_of(model, 0)});
    std::fill_n(sums_ + base, count, ContactSums{}), std::fill_n(unscaled_ + base, count, ContactSums{});
    if (records_marks_) std::fill_n(marks_ + base, count, 0u);
    const bool carries = model.collision.surface && !cloth.rests;
    if (carries) carriers_.push_back(step.motion_poses);
    std::fill_n(carrier_ + base, count, carries ? static_cast<std::uint32_t>(carriers_.size()) : 0);
    std::fill_n(next_carrier_ + base, count, 0u);
    if (cloth.rests) place_resting(cloth);
}

// No pass moves these particles, and none goes over them.
void ClothContact::place_resting(const ClothState& cloth) {
    for (std::uint32_t p = cloth.base; p < cloth.base + cloth.model->particle_count; ++p) {
        reached_[p] = asked_[p] = farthest_[p] = x_[p];
        part_[p] = 1, retreats_[p] = 0, sent_back_[p] = 0;
    }
}

void ClothContact::use(ContactArrays& arrays) {
    arrays_ = &arrays;
    reached_ = arrays.reached.data(), asked_ = arrays.asked.data(), farthest_ = arrays.farthest.data();
    numbers_ = arrays.numbers.data();
    sums_ = arrays.sums.data(), unscaled_ = arrays.unscaled.data();
    part_ = arrays.part.data(), slide_ = arrays.slide.data();
    carrier_ = arrays.carrier.data(), next_carrier_ = arrays.next_carrier.data();
    retreats_ = arrays.retreats.data(), sent_back_ = arrays.sent_back.data(), marks_ = arrays.marks.data();
}

void ClothContact::run(const ClothContactContext& context, const Pass& pass, Worker worker) {
    if (worker.number != 0) return team_.help(worker.number, context.barrier);
    cloths_ = context.cloths;
    substep_ = context.substep;
    workers_.resize(worker.count);
    for (unsigned i = 0; i < worker.count; ++i) {
        workers_[i].worker = i;
        workers_[i].sums = worker.count > 1 ? arrays_->worker_sums[i].data() : nullptr;
    }
    team_.lead(worker.count, context.barrier, [&] { lead(pass); });
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

void ClothContact::detect() {
    sweep_boxes();
    untangle();
    begin_reach();
    find_near_of_motion(search_always_);
    if (brake()) find_near_of_motion(false);
    for (Mine& mine : workers_) mine.pushes.clear();
}

// All that contact looks at in a substep is near where the particles are when it begins or when the limit begins. How
// near: reach_of() in near_parts.cpp.
void ClothContact::sweep_boxes() {
    for (std::size_t i = 0; i < swept_.size(); ++i)
        if (cloths_[i]->model->tiles && !cloths_[i]->model->collision.surface) swept_[i]->include(cloths_[i]->bounds());
}

// For the motion to where the particles are now.
void ClothContact::find_near_of_motion(bool search_always) {
    in_parallel([&](Mine& mine) { for_each_particle(mine, [&](std::uint32_t p) { reached_[p] = x_[p]; }); });
    if (search_.find_outdated(x_, reach_, search_always, team_)) {
        follow_and_search();
        ++counts_.searches;
    }
    find_near();
}

void ClothContact::push(const Pass& pass) {
    if (pass.batch > 0)
        in_parallel([&](Mine& mine) { for_each_particle(mine, [&](std::uint32_t p) { keep_in_reach(p); }); });
    extend_reach();
    sweep();
    if (pass.batch + 1 < contact_rounds) return;
    counts_.contacts = 0;
    for (const Mine& mine : workers_) counts_.contacts += mine.overlaps.count;
    // Where the limit would have to act, more sweeps are the better answer.
    for (int extra = 0; extra < contact_extra_sweeps; ++extra) {
        extend_reach();
        if (!any_lost()) break;
        sweep();
    }
    in_parallel([&](Mine& mine) {
        for (const NearPairs& near : mine.near) {
            for (std::uint32_t i = 0; i < near.count; ++i)
                if (near.pushed[i]) mine.pushes.push_back({near.particles(i), weights_of(near, i), normal_of(near, i)});
        }
    });
}

// Pushes overlapping pairs apart once. Several workers add to sums of their own: most particles of a pile have pairs of
// many workers, and adding to the same sums side by side is slower than one worker alone.
void ClothContact::sweep() {
    const bool alone = team_.size() == 1;
    in_parallel([&](Mine& mine) {
        ContactSums *const totals = sums_, *const unscaled = unscaled_;
        ContactSums* const own = alone ? totals : mine.sums;
        const SweepView view{&start_->x,
                             &x_->x,
                             &numbers_->x,
                             totals,
                             unscaled,
                             own,
                             alone ? unscaled : own,
                             own,
                             contact_recovery_speed * h_};
        mine.overlaps.count = 0;
        for (int kind = 0; kind < 2; ++kind) loops_->find_overlaps[kind](mine.near[kind], view, mine.overlaps);
        mine.overlaps.pad(cloths_.front()->base);
        add_up(mine, [&](std::uint32_t p, ContactSums& of_worker) { totals[p].share += of_worker.share; });
        loops_->find_pushes(mine.overlaps, view);
        add_up(mine, [&](std::uint32_t p, ContactSums& of_worker) { move_pushes(unscaled[p], of_worker); });
        loops_->scale_pushes(mine.overlaps, view);
        add_up(mine, [&](std::uint32_t p, ContactSums& of_worker) {
            move_pushes(totals[p], of_worker);
            of_worker.share = 0;
        });
        for_each_particle(mine, [&](std::uint32_t p) {
            if (sums_[p].share == 0) return;
            set_place(x_[p], x_[p].xyz() + sum(p, WEFT_PUSH_QUANTA_PER_METER));
            sums_[p] = {}, unscaled_[p] = {};
            keep_in_reach(p);
        });
    });
}

// When all workers have added to their sums, calls add(particle, sums of a worker) for each worker that has pairs of
// the particle.
template <class Add>
void ClothContact::add_up(const Mine& mine, Add&& add) {
    team_.wait();
    if (team_.size() == 1) return;
    for_each_particle(mine, [&](std::uint32_t p) {
        for (Mine& of_worker : workers_)
            if (of_worker.sums[p].share > 0) add(p, of_worker.sums[p]);
    });
    team_.wait();
}

// What contact moves stays within what the lists cover.
void ClothContact::keep_in_reach(std::uint32_t p) {
    const Vec3 away = x_[p].xyz() - reached_[p].xyz();
    const float length2 = squared(away);
    if (length2 > cap(p) * cap(p)) set_place(x_[p], reached_[p].xyz() + away * (cap(p) / std::sqrt(length2)));
}

void ClothContact::add_share(std::uint32_t p, float weight) {
    const auto quanta = static_cast<std::uint32_t>(scalar::to_weight_quanta(weight));
    add_quanta(sums_[p].share, quanta, team_.size() > 1);
}

// Sum of the weights of all pushes of a particle.
float ClothContact::share(std::uint32_t p) const {
    return static_cast<float>(sums_[p].share) * static_cast<float>(1 / WEFT_WEIGHT_QUANTA);
}

void ClothContact::add_to_sum(std::uint32_t p, Vec3 change, double quanta) {
    const auto scale = static_cast<float>(quanta);
    const std::array axes{change.x, change.y, change.z};
    for (std::size_t k = 0; k < 3; ++k)
        add_quanta(sums_[p].push[k], to_integer(scalar::to_contact_quanta(axes[k], scale)), team_.size() > 1);
}

Vec3 ClothContact::sum(std::uint32_t p, double quanta) const {
    const auto axis = [&](std::size_t k) {
        return static_cast<float>(static_cast<std::int32_t>(sums_[p].push[k])) * static_cast<float>(1 / quanta);
    };
    return {axis(0), axis(1), axis(2)};
}

// Takes the velocity with which pushed pairs separate, so that contact does not make cloth bounce. Masses are split in
// full, so that one pass never takes too much.
void ClothContact::separate() {
    in_parallel([&](Mine& mine) {
        for (const Pushed& pair : mine.pushes)
            for (int k = 0; k < 4; ++k) add_share(pair.particles[k], pair.weights[k]);
        team_.wait();
        // Reads velocities and shares, and adds to sums: no worker reads what another one writes.
        for (const Pushed& pair : mine.pushes) {
            float speed = 0, resistance = 0;
            for (int k = 0; k < 4; ++k) {
                const std::uint32_t p = pair.particles[k];
                const Vec3 v = velocity_[p].xyz();
                speed += pair.weights[k] * (pair.normal.x * v.x + pair.normal.y * v.y + pair.normal.z * v.z);
                resistance += scalar::contact_resistance(x_[p].w, pair.weights[k], share(p));
            }
            if (!(speed > 0) || !(resistance > 1e-12f)) continue;
            const Vec3 change = pair.normal * -(speed / resistance);
            for (int k = 0; k < 4; ++k) {
                const std::uint32_t p = pair.particles[k];
                add_to_sum(p, change * (pair.weights[k] * x_[p].w), WEFT_SPEED_QUANTA_PER_METER);
            }
        }
        team_.wait();
        for_each_particle(mine, [&](std::uint32_t p) {
            if (sums_[p].share == 0) return;
            set_place(velocity_[p], velocity_[p].xyz() + sum(p, WEFT_SPEED_QUANTA_PER_METER));
            sums_[p] = {};
        });
    });
}

}  // namespace weft::cpu
