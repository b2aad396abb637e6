#include "cpu/collider_lists.h"

#include "cpu/bodies.h"
#include "solver/plan/frame_numbers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace weft::cpu {
namespace {

constexpr std::uint32_t tile_size = lane_padding;

// What a tile of a cloth usually touches at most.
constexpr std::uint32_t colliders_per_tile = 4;

Vec3 place_of(const float* blocks, std::size_t particle) {
    const float* at = blocks + 4 * particle;
    return {at[0], at[1], at[2]};
}

Bounds grown(const Bounds& box, float by) {
    const Vec3 all{by, by, by};
    return {box.min - all, box.max + all};
}

}  // namespace

void ColliderPart::reserve(std::uint32_t tiles, std::uint32_t colliders, bool keeps_sums, bool traces) {
    keeps_sums_ = keeps_sums;
    traces_ = traces;
    const std::size_t usual = std::size_t{tiles} * std::min(colliders, colliders_per_tile);
    const std::size_t most = std::size_t{tiles} * colliders;
    const std::size_t listed = std::min(std::max(usual, 2 * lists_.colliders.size()), most);
    const std::size_t sums = std::min(std::max(usual * tile_size, 2 * sum_count_), most * tile_size);
    boxes_.reserve(tiles);
    for (Lists* lists : {&lists_, &next_lists_})
        lists->colliders.reserve(listed), lists->begin.reserve(tiles + std::size_t{1});
    found_.reserve(colliders);
    for (auto* runs : {&runs_, &last_runs_}) runs->reserve(tiles);
    pressed.reserve(tiles);
    for (auto* near : {&near_, &last_near_}) near->reserve(listed);
    for (auto* touched : {&touched_, &last_touched_}) touched->reserve(listed);
    near_bodies_.reserve(listed);
    if (keeps_sums || traces) scratch_.reserve(sums);
    if (keeps_sums) sums_.reserve(sums);
    if (traces) moved_.reserve(sums), turned_.reserve(sums);
}

void ColliderPart::begin_frame(Share mine, bool surfaces) {
    mine_ = mine;
    surfaces_ = surfaces;
    boxes_.assign((mine.end - mine.begin + tile_size - 1) / tile_size, {});
    stretch_ = 0;
    lists_.colliders.clear();
    lists_.begin.assign(boxes_.size() + 1, 0);
    runs_.clear(), near_.clear(), near_bodies_.clear(), touched_.clear();
    sums_.clear(), moved_.clear(), turned_.clear();
}

void ColliderPart::cover(const Passes& passes, const ParticleView& particles, const ColliderPlaces& places,
                         const Bodies& bodies, const TileReach& reach) {
    const Range mine{mine_.begin, mine_.end};
    const std::uint32_t outside = passes.first_outside(particles.position, boxes_, mine, 0);
    const bool bodies_left = bodies_serial_ != bodies.reach_serial();
    const bool stretched = reach.longest - reach.widest > stretch_;
    if (outside == tiles() && !bodies_left && !stretched) return;
    if (stretched) grow_boxes(room_to_stretch * reach.longest - reach.widest);
    search(passes, particles, places, bodies, reach, outside, bodies_left || stretched);
    bodies_serial_ = bodies.reach_serial();
    std::swap(runs_, last_runs_), std::swap(near_, last_near_), std::swap(touched_, last_touched_);
    join_tiles();
    number_bodies(bodies);
    if (keeps_sums_) carry_over(last_runs_, last_near_, last_touched_, sums_, scratch_);
    // Sums that were not valid are zero now.
    touched_.assign(near_.size(), 1);
    if (!traces_) return;
    last_touched_.assign(last_near_.size(), 1);
    carry_over(last_runs_, last_near_, last_touched_, moved_, scratch_);
    carry_over(last_runs_, last_near_, last_touched_, turned_, scratch_);
}

void ColliderPart::grow_boxes(float stretch) {
    for (Bounds& box : boxes_)
        if (!box.empty()) box = grown(box, stretch - stretch_);
    stretch_ = stretch;
}

void ColliderPart::number_bodies(const Bodies& bodies) {
    near_bodies_.clear();
    for (const NearCollider& near : near_) near_bodies_.push_back(bodies.body_of(near.collider));
}

// Where the particles are expected to be in the rest of the frame.
Bounds ColliderPart::box_of(const ParticleView& particles, std::uint32_t tile, const TileReach& reach) const {
    Bounds box;
    float way = 0;
    const std::uint32_t begin = mine_.begin + tile * tile_size, end = std::min(begin + tile_size, mine_.end);
    for (std::uint32_t p = begin; p < end; ++p) {
        if (!(particles.position[4 * std::size_t{p} + 3] > 0)) continue;  // contact moves only what has a mass
        const Vec3 x = place_of(particles.position, p), by = x - place_of(particles.start, p);
        box.include(x);
        box.include(x + by * reach.substeps + reach.fall);
        way = std::max(way, length(by));
    }
    return box.empty() ? box : grown(box, reach.margin + stretch_ + tile_slack_per_way * way * reach.substeps);
}

// Searches the tiles that have left their boxes, the first of which is `outside`, or `all`. The other lists stay as
// they are.
void ColliderPart::search(const Passes& passes, const ParticleView& particles, const ColliderPlaces& places,
                          const Bodies& bodies, const TileReach& reach, std::uint32_t outside, bool all) {
    const Range mine{mine_.begin, mine_.end};
    next_lists_.colliders.clear();
    next_lists_.begin.clear();
    for (std::uint32_t tile = 0; tile < tiles(); ++tile) {
        next_lists_.begin.push_back(static_cast<std::uint32_t>(next_lists_.colliders.size()));
        const std::span<const std::uint32_t> before = lists_.of(tile);
        if (tile != outside && !all) {
            next_lists_.colliders.insert(next_lists_.colliders.end(), before.begin(), before.end());
            continue;
        }
        if (tile == outside) {
            const Bounds box = box_of(particles, tile, reach);
            if (!box.empty()) boxes_[tile].include(box);
        }
        found_.clear();
        places.find(boxes_[tile], found_, surfaces_);
        if (!bodies.empty() && !boxes_[tile].empty()) {
            bodies.find(boxes_[tile], found_);
            std::ranges::sort(found_);
        }
        std::ranges::set_union(before, found_, std::back_inserter(next_lists_.colliders));
        if (tile == outside) outside = passes.first_outside(particles.position, boxes_, mine, tile + 1);
    }
    next_lists_.begin.push_back(static_cast<std::uint32_t>(next_lists_.colliders.size()));
    std::swap(lists_, next_lists_);
}

// Neighboring tiles with the same colliders become one run.
void ColliderPart::join_tiles() {
    runs_.clear(), near_.clear();
    sum_count_ = 0;
    for (std::uint32_t tile = 0; tile < tiles();) {
        const std::span<const std::uint32_t> colliders = lists_.of(tile);
        const std::uint32_t first = tile;
        while (tile < tiles() && std::ranges::equal(lists_.of(tile), colliders)) ++tile;
        if (colliders.empty()) continue;
        const std::uint32_t begin = mine_.begin + first * tile_size,
                            end = std::min(mine_.begin + tile * tile_size, mine_.end);
        runs_.push_back(
            {begin, end, static_cast<std::uint32_t>(near_.size()), static_cast<std::uint32_t>(colliders.size())});
        for (const std::uint32_t collider : colliders) {
            near_.push_back({collider, sum_count_});
            sum_count_ += end - begin;
        }
    }
}

// Brings the sums of the runs before to their new places. Tiles never lose a collider during a frame.
void ColliderPart::carry_over(std::span<const ColliderRun> runs, std::span<const NearCollider> near,
                              std::span<const std::uint8_t> valid, AlignedVector<Vec4>& sums,
                              AlignedVector<Vec4>& scratch) const {
    std::swap(sums, scratch);
    sums.assign(sum_count_, Vec4{});
    auto to = runs_.begin();
    for (const ColliderRun& from : runs) {
        for (std::uint32_t p = from.begin; p < from.end;) {
            while (to->end <= p) ++to;
            const std::uint32_t end = std::min(from.end, to->end);
            for (std::uint32_t k = 0; k < from.count; ++k) {
                if (!valid[from.first + k]) continue;
                const NearCollider& old = near[from.first + k];
                const std::span<const NearCollider> now = this->near(*to);
                const auto place = std::ranges::lower_bound(now, old.collider, {}, &NearCollider::collider);
                assert(place != now.end() && place->collider == old.collider);
                std::copy_n(scratch.begin() + static_cast<std::ptrdiff_t>(old.sums + (p - from.begin)), end - p,
                            sums.begin() + static_cast<std::ptrdiff_t>(place->sums + (p - to->begin)));
            }
            p = end;
        }
    }
}

// A particle whose tile does not list the collider is left out: its face has an edge that is stretched far.
void ColliderPart::trace(std::uint32_t particle, std::uint32_t collider, Vec3 by, Vec3 lever) {
    const auto run = std::ranges::upper_bound(runs_, particle, {}, &ColliderRun::end);
    if (run == runs_.end() || run->begin > particle) return;
    const auto at = std::ranges::lower_bound(near(*run), collider, {}, &NearCollider::collider);
    if (at == near(*run).end() || at->collider != collider) return;
    const std::size_t sum = at->sums + (particle - run->begin);
    const auto add = [&](Vec4& to, Vec3 more) { to.x += more.x, to.y += more.y, to.z += more.z; };
    add(moved_[sum], by);
    add(turned_[sum], cross(lever, by));
}

void ColliderLists::trace(std::uint32_t particle, std::uint32_t collider, Vec3 by, Vec3 lever) {
    const auto slot = std::ranges::find_if(parts_, [&](const Slot& one) { return one.part.has(particle); });
    if (slot != parts_.end()) slot->part.trace(particle, collider, by, lever);
}

void ColliderLists::prepare(std::uint32_t particles, std::uint32_t colliders, unsigned workers, bool keeps_sums,
                            bool traces) {
    if (parts_.size() < workers) parts_.resize(workers);
    if (colliders == 0) return;
    const std::uint32_t tiles = (particles + tile_size - 1) / tile_size;
    for (unsigned worker = 0; worker < workers; ++worker)
        parts_[worker].part.reserve((tiles + workers - 1) / workers, colliders, keeps_sums, traces);
}

}  // namespace weft::cpu
