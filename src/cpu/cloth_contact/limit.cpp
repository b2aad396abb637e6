// What keeps pairs from losing their gap: the brake before contact, and the limit after it.
#include "cpu/cloth_contact/cloth_contact.h"
#include "cpu/cloth_contact/pair_math.h"
#include "solver/plan/cloth_contact_numbers.h"
#include "solver/state/contact_marks.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace weft::cpu {
namespace {

// Lowers a number that other workers may lower too.
void lower(float& number, float to) {
    const std::atomic_ref atomic(number);
    float now = atomic.load(std::memory_order_relaxed);
    while (to < now && !atomic.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
    }
}

}  // namespace

/// A near pair where its particles are now.
struct ClothContact::MovedPair {
    std::array<std::uint32_t, 4> particles;
    std::array<Vec3, 4> away;    // by particle: unit, away from the other side
    std::array<float, 4> least;  // by particle: how far it has to move along `away`, m
};

ClothContact::MovedPair ClothContact::moved_pair(const NearPairs& near, int kind, std::uint32_t pair) const {
    const bool edges = kind == 1;
    const Vec3 normal = normal_of(near, pair);
    MovedPair result;
    result.particles = near.particles(pair);
    float moved[4], mass[4];
    for (int k = 0; k < 4; ++k) {
        const std::uint32_t p = result.particles[k];
        moved[k] = dot(x_[p].xyz() - start_[p].xyz(), normal);
        mass[k] = x_[p].w;
    }
    const float gap = near.gap[pair], spare = gap - std::min(gap, near.thickness[pair] * contact_gap_floor);
    const auto least_motions = edges ? scalar::least_motions_edge_edge : scalar::least_motions_vertex_triangle;
    const scalar::LeastMotions least =
        least_motions(moved[0], moved[1], moved[2], moved[3], mass[0], mass[1], mass[2], mass[3], spare);
    for (int k = 0; k < 4; ++k) {
        const bool is_one = edges ? k < 2 : k < 1;
        result.away[k] = is_one ? normal : normal * -1;
        result.least[k] = is_one ? least.one : least.two;
    }
    return result;
}

// Part of its motion that the brake leaves to a pair.
float ClothContact::part_before_brake_depth(const NearPairs& near, int kind, std::uint32_t pair) const {
    const auto particles = near.particles(pair);
    const Vec3 normal = normal_of(near, pair);
    float along[4];
    // Relative to the first particle, as when the gap at the start was computed.
    for (int k = 0; k < 4; ++k) along[k] = dot(x_[particles[k]].xyz() - x_[particles[0]].xyz(), normal);
    const float gap = kind == 1 ? scalar::gap_edge_edge(along[0], along[1], along[2], along[3])
                                : scalar::gap_vertex_triangle(along[0], along[1], along[2], along[3]);
    return scalar::part_to_depth(gap, near.gap[pair], near.thickness[pair] * contact_gap_floor, brake_depth(particles));
}

// Of both sides the smaller one: neither can take back more.
float ClothContact::brake_depth(const std::array<std::uint32_t, 4>& pair) const {
    return contact_brake_depth * std::min(cap(pair[0]), cap(pair[3]));
}

// Calls visit(near pairs, kind, pair) for all pairs of the worker that lose their gap and `depth` more. `visit` returns
// whether to go on.
template <class Visit>
void ClothContact::for_each_lost(Mine& mine, float depth, Visit&& visit) const {
    for (int kind = 0; kind < 2; ++kind) {
        const NearPairs& near = mine.near[kind];
        mine.lost.clear();
        loops_->find_lost[kind](near, &x_->x, contact_gap_floor, depth, mine.lost);
        for (const std::uint32_t pair : mine.lost)
            if (comes_near(near, static_cast<PairKind>(kind), pair, &start_->x, &x_->x) && !visit(near, kind, pair))
                return;
    }
}

bool ClothContact::any_found() const {
    return std::ranges::any_of(workers_, &Mine::found);
}

bool ClothContact::any_lost() {
    in_parallel([&](Mine& mine) {
        mine.found = false;
        for_each_lost(mine, 0, [&](const NearPairs&, int, std::uint32_t) {
            mine.found = true;
            return false;
        });
    });
    return any_found();
}

// Where the constraints ask for more than contact can take back, the particles go a part of their way: the same part
// for both sides of a pair, so that contact has to take back only the rest. Without it, cloth that is pulled over cloth
// stays where it is in every substep, while the pull grows. Returns whether any particle was slowed.
bool ClothContact::brake() {
    const float least_depth = contact_brake_depth * least_cap_;
    in_parallel([&](Mine& mine) {
        for_each_particle(mine, [&](std::uint32_t p) { part_[p] = 1; });
        team_.wait();
        mine.found = false;
        for_each_lost(mine, least_depth, [&](const NearPairs& near, int kind, std::uint32_t pair) {
            const float part = part_before_brake_depth(near, kind, pair);
            mine.found = mine.found || part < 1;
            for (const std::uint32_t p : near.particles(pair)) lower(part_[p], part);
            return true;
        });
        team_.wait();
        if (!any_found()) return;
        for_each_particle(mine, [&](std::uint32_t p) {
            if (!(part_[p] < 1) || !(x_[p].w > 0)) return;
            const Vec3 from = start_[p].xyz();
            set_place(x_[p], from + (x_[p].xyz() - from) * part_[p]);
        });
    });
    return any_found();
}

// Asks particles of a pair that has lost its gap to go back: those that come closer to the other side than they may, or
// all. Returns whether any of them can.
bool ClothContact::retreat(Mine& mine, const MovedPair& pair, bool all) {
    bool helps = false;
    for (int k = 0; k < 4; ++k) {
        const std::uint32_t p = pair.particles[k];
        if (retreats_[p] == most_retreats || !(x_[p].w > 0)) continue;
        if (retreats_[p] < limit_slides) {
            const Vec3 base = base_of(p);
            const Vec3 slide = retreats_[p] == 0 ? asked_[p].xyz() - base : slide_[p];
            const float missing = pair.least[k] - dot(slide + (base - start_[p].xyz()), pair.away[k]);
            if (!(missing > 0) && !all) continue;
            add_to_sum(p, pair.away[k] * std::max(missing, 0.0f), WEFT_PUSH_QUANTA_PER_METER);
            add_quanta(sums_[p].share, 1, team_.size() > 1);
        }
        helps = true;
        if (std::atomic_ref(sent_back_[p]).exchange(1, std::memory_order_relaxed) == 0) mine.to_send_back.push_back(p);
    }
    return helps;
}

// The particle first slides along its pairs: it gives up what brings it closer to the other sides, the mean of what
// they ask. If that does not help, what is left of its motion is halved, and at last it stays at its start, or moves
// with the surface that carries it.
void ClothContact::set_back(std::uint32_t p) {
    if (begin_carried(p)) return;
    const Vec3 from = base_of(p), asked = asked_[p].xyz() - from;
    if (retreats_[p] == 0) slide_[p] = asked;
    const std::uint32_t askers = sums_[p].share;
    if (askers > 0) slide_[p] = slide_[p] + sum(p, WEFT_PUSH_QUANTA_PER_METER) * (1 / static_cast<float>(askers));
    sums_[p] = {}, sent_back_[p] = 0;
    const std::uint32_t retreats = ++retreats_[p];
    if (retreats == most_retreats) return set_place(x_[p], from);
    const Vec3 slide = to_vec3(scalar::slide_near(on_lane(asked), on_lane(slide_[p]), limit_aside * own_cap(p)));
    const std::uint32_t halvings = retreats > limit_slides ? retreats - limit_slides : 0;
    set_place(x_[p], from + slide * (1 / static_cast<float>(1u << halvings)));
}

// Sends the particles of all pairs that lose their gap back towards the start of the substep, where every pair has its
// gap, or to where a surface carries them (carry.cpp). A pair that keeps its gap along one normal at both ends of a
// linear motion does not meet in between.
void ClothContact::send_back() {
    in_parallel([&](Mine& mine) {
        mine.least_stuck = no_particle;
        for_each_particle(mine, [&](std::uint32_t p) {
            retreats_[p] = 0;
            if (!of_surface(p)) carrier_[p] = 0;
        });
    });
    do {
        in_parallel([&](Mine& mine) {
            mine.to_send_back.clear();
            mine.stuck = 0;
            for_each_lost(mine, 0, [&](const NearPairs& near, int kind, std::uint32_t pair) {
                const auto particles = near.particles(pair);
                if (is_carried(particles) || (touches_moving_surface(particles) && carry(mine, particles))) return true;
                const MovedPair moved = moved_pair(near, kind, pair);
                if (retreat(mine, moved, false) || retreat(mine, moved, true) || carry(mine, particles)) return true;
                ++mine.stuck;
                for (const std::uint32_t p : moved.particles)
                    if (!of_surface(p)) mine.least_stuck = std::min(mine.least_stuck, p);
                mark_stuck(moved.particles);
                return true;
            });
            team_.wait();
            mine.found = !mine.to_send_back.empty();
            for (const std::uint32_t p : mine.to_send_back) set_back(p);
        });
    } while (any_found());
    std::uint64_t stuck = 0;
    for (const Mine& mine : workers_) {
        stuck += mine.stuck;
        counts_.tangled_particle = std::min(counts_.tangled_particle, mine.least_stuck);
    }
    counts_.tangled = std::max(counts_.tangled, stuck);
}

// Whether a particle that was sent back may have been beyond what its list covers, on any part of its way.
bool ClothContact::any_uncovered() {
    in_parallel([&](Mine& mine) {
        for_each_particle(mine, [&](std::uint32_t p) {
            farthest_[p] = x_[p];
            if (retreats_[p] > 0 || is_carried(p)) set_place(farthest_[p], base_of(p));
        });
    });
    for (std::size_t tile = 0; tile < caps_.size(); ++tile) moved_[tile] = limit_aside * own_caps_[tile];
    return search_.find_outdated(farthest_, moved_, false, team_);
}

// Of where the limit may put the particles, the place that is farther from the start.
void ClothContact::find_farthest() {
    in_parallel([&](Mine& mine) {
        for_each_particle(mine, [&](std::uint32_t p) {
            const Vec3 start = start_[p].xyz(), base = base_of(p);
            farthest_[p] = asked_[p];
            if (squared(base - start) > squared(asked_[p].xyz() - start)) set_place(farthest_[p], base);
        });
    });
}

// Takes the particles back to where they were before the limit.
void ClothContact::restart_limit() {
    in_parallel(
        [&](Mine& mine) { for_each_particle(mine, [&](std::uint32_t p) { set_place(x_[p], asked_[p].xyz()); }); });
}

void ClothContact::stay_at_start() {
    in_parallel([&](Mine& mine) {
        for_each_particle(mine, [&](std::uint32_t p) {
            if (!(x_[p].w > 0)) return;
            retreats_[p] = most_retreats;
            set_place(x_[p], start_[p].xyz());
        });
    });
}

void ClothContact::limit() {
    sweep_boxes();
    in_parallel(
        [&](Mine& mine) { for_each_particle(mine, [&](std::uint32_t p) { asked_[p] = x_[p], retreats_[p] = 0; }); });
    extend_reach();
    if (any_lost()) {
        extend_reach_of_limit();
        send_back();
        // A particle that was sent back may have left its listed trajectory. Its tile is then listed for all places
        // between the start and where the particle was to go, and the limit starts again. Near pairs cover these places
        // anyway.
        for (int attempt = 0; any_uncovered(); ++attempt) {
            if (attempt == contact_most_attempts) {
                stay_at_start();
                break;
            }
            restart_limit();
            find_farthest();
            search_.cover(start_, farthest_);
            search_.search(team_);
            find_near();
            send_back();
        }
    }
    count_limited_particles();
    search_.next_tick();
}

void ClothContact::count_limited_particles() {
    in_parallel([&](Mine& mine) {
        mine.limited = 0;
        for_each_particle(mine, [&](std::uint32_t p) {
            if (retreats_[p] == 0) return;
            ++mine.limited;
            if (records_marks_) marks_[p] |= mark_limited;
        });
    });
    for (const Mine& mine : workers_) counts_.limited += mine.limited;
}

}  // namespace weft::cpu
