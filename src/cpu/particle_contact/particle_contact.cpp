#include "cpu/particle_contact/particle_contact.h"

#include "physics/scalar.h"
#include "solver/state/address_space.h"
#include "solver/state/contact_marks.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::cpu {
namespace {

static_assert(AddressSpace::reserved % particle_block == 0 && lane_padding % particle_block == 0);

float to_meters(std::uint32_t quanta) {
    return static_cast<float>(static_cast<std::int32_t>(quanta)) * static_cast<float>(1 / WEFT_PUSH_QUANTA_PER_METER);
}

}  // namespace

void ParticleContact::prepare(const Passes& passes, const ParticleContactContext& context, unsigned workers) {
    WorldArrays& world = context.cloths.front()->world;
    x_ = world.position.data(), start_ = world.start.data();
    loops_ = &particle_loops_of(passes.isa);
    h_ = frame_numbers(*context.cloths.front()->model, *context.step.plan, context.step.input.dt).h;
    searches_ = 0;

    std::vector<SearchedParticles> searched;
    particles_.clear(), searched_cloths_.clear();
    swept_ = context.swept;
    friction_ = context.arrays.friction.data();
    for (std::uint32_t i = 0; i < context.cloths.size(); ++i) {
        const ClothState* cloth = context.cloths[i];
        const ClothModel& model = *cloth->model;
        if (!model.along_curve) continue;
        searched_cloths_.push_back(i);
        searched.push_back({.order = model.along_curve,
                            .base = cloth->base,
                            .rest = model.start.data(),
                            .diameter = particle_diameter(model),
                            .margin = particle_margin(model),
                            .part_at_rest = particle_part_at_rest,
                            .less_at_rest = particle_less_at_rest(model),
                            .with_alike = model.collision.with_cloth == SelfCollision::fast,
                            .filter = model.collision.filter,
                            .seams = context.seams,
                            .uneven = uneven_diameters(model)});
        const std::uint32_t end = cloth->base + model.particle_count;
        particles_.push_back({cloth->base, end});
        const auto& [of_rest, of_motion] = model.fabric.contact.friction;
        for (std::uint32_t block = cloth->base / particle_block; block * particle_block < end; ++block)
            context.arrays.friction[block] = {std::sqrt(of_rest), std::sqrt(of_motion), 0, 0};
    }
    search_.set_cloths(loops_->search, std::move(searched), workers);
    parts_.resize(workers);
    pushes_.clear();
    for (unsigned i = 0; i < workers; ++i) {
        parts_[i].arrays = &context.arrays.workers[i];
        pushes_.push_back(parts_[i].arrays->pushes.data());
    }
}

ClothContactCounts ParticleContact::counts() const {
    ClothContactCounts counts{.searches = searches_};
    for (const Part& part : parts_) counts.contacts += part.overlaps.count;
    return counts;
}

void ParticleContact::add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const {
    for (const Part& part : parts_) {
        for (std::size_t i = 0; i < marks.size(); ++i)
            if (part.arrays->pushes[base + i] > 0) marks[i] |= mark_touches;
    }
}

// Each worker owns the same tiles in every pass, interleaved: neighboring tiles have similar work.
template <class Visit>
void ParticleContact::for_each_tile(Worker worker, Visit&& visit) const {
    for (std::uint32_t tile = worker.number; tile < search_.tile_count(); tile += worker.count) visit(tile);
}

// Calls visit(first particle) for the worker's share of the blocks of each cloth.
template <class Visit>
void ParticleContact::for_each_block(Worker worker, Visit&& visit) const {
    for (const Range& particles : particles_) {
        const Share share = worker.of(particles.end - particles.begin);
        for (std::uint32_t p = particles.begin + share.begin; p < particles.begin + share.end; p += particle_block)
            visit(p);
    }
}

void ParticleContact::run(const Pass& pass, Worker worker) {
    Part& part = parts_[worker.number];
    switch (pass.kind) {
        case PassKind::track_particles:
            return for_each_tile(worker, [&](std::uint32_t tile) { search_.track(tile, x_); });
        case PassKind::search_particles:
            if (worker.number != 0) return;
            search_.find_outdated(x_, search_always_);
            if (!swept_.empty())
                search_.for_each_box(
                    [&](std::uint32_t cloth, const Bounds& box) { swept_[searched_cloths_[cloth]]->include(box); });
            return;
        case PassKind::list_particles:
            part.searched = false;
            return for_each_tile(worker,
                                 [&](std::uint32_t tile) { part.searched |= search_.list(tile, worker.number); });
        case PassKind::overlap_particles:
            return find_overlaps(worker);
        case PassKind::push_particles:
            return loops_->push(input(particle_sweeps[pass.batch]), part.overlaps, part.arrays->sums.data(),
                                part.arrays->pushed.data());
        case PassKind::move_particles:
            return move(worker);
        case PassKind::hold_particles:
            return loops_->hold(input(particle_sweeps.front()), part.overlaps, part.arrays->sums.data());
        default:
            return settle(worker);
    }
}

ParticleInput ParticleContact::input(const ParticleSweep& sweep) const {
    return {.position = &x_->x,
            .start = &start_->x,
            .friction = &friction_->x,
            .pushes = pushes_.data(),
            .workers = static_cast<unsigned>(parts_.size()),
            .deep = sweep.deep,
            .recovery = sweep.recovery_speed * h_,
            .split = sweep.split};
}

void ParticleContact::find_overlaps(Worker worker) {
    Part& part = parts_[worker.number];
    std::vector<std::uint8_t>& touched = part.arrays->touched;
    std::vector<std::uint32_t>& pushes = part.arrays->pushes;
    if (worker.number == 0) searches_ += std::ranges::any_of(parts_, &Part::searched);
    for (const Range& particles : particles_) {
        for (std::uint32_t p = particles.begin; p < particles.end; p += particle_block) {
            if (!touched[p / particle_block]) continue;
            touched[p / particle_block] = 0;
            std::fill_n(&pushes[p], particle_block, 0u);
        }
    }
    part.overlaps.count = 0;
    for_each_tile(worker, [&](std::uint32_t tile) {
        search_.for_each_run(tile, [&](const ParticlePairs& pairs, std::uint32_t begin, std::uint32_t end) {
            part.overlaps.reserve(std::size_t{part.overlaps.count} + (end - begin));
            loops_->find_overlaps(pairs, begin, end, &x_->x, part.overlaps, pushes.data());
        });
    });
    part.overlaps.pad(particles_.front().begin);
    if (part.overlaps.depth.size() < part.overlaps.one.size()) part.overlaps.depth.resize(part.overlaps.one.size());
    std::fill_n(part.overlaps.depth.begin(), part.overlaps.count + 16, 0.0f);
    for (std::uint32_t i = 0; i < part.overlaps.count; ++i) {
        touched[part.overlaps.one[i] / particle_block] = 1;
        touched[part.overlaps.two[i] / particle_block] = 1;
    }
}

// Both passes move the worker's particles by the sums of all workers, and clear the sums.

void ParticleContact::move(Worker worker) {
    for_each_block(worker, [&](std::uint32_t first) {
        bool pushed = false;
        for (Part& part : parts_) pushed |= std::exchange(part.arrays->pushed[first / particle_block], 0) != 0;
        if (pushed) move_block(first, x_);
    });
}

// The velocity follows from the motion since the start of the substep. With the start moved, pushes do not make cloth
// bounce.
void ParticleContact::settle(Worker worker) {
    for_each_block(worker, [&](std::uint32_t first) {
        const auto touched = [&](const Part& part) { return part.arrays->touched[first / particle_block] != 0; };
        if (std::ranges::any_of(parts_, touched)) move_block(first, start_);
    });
}

void ParticleContact::move_block(std::uint32_t first, Vec4* places) {
    for (std::uint32_t p = first; p < first + particle_block; ++p) {
        ParticleSum sum{};
        for (Part& part : parts_) {
            ParticleSum& mine = part.arrays->sums[p];
            for (int k = 0; k < 3; ++k) sum[k] += mine[k];
            mine = {};
        }
        if (sum[0] == 0 && sum[1] == 0 && sum[2] == 0) continue;
        Vec4& x = places[p];
        x = {x.x + to_meters(sum[0]), x.y + to_meters(sum[1]), x.z + to_meters(sum[2]), x.w};
    }
}

}  // namespace weft::cpu
