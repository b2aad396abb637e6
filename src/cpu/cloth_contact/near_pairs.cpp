// Which pairs contact and limit may have to act on in a substep. How far contact moves the particles is known only
// while it does: each tile has a reach that grows, and near pairs are added as it grows.
#include "cpu/cloth_contact/cloth_contact.h"
#include "solver/plan/cloth_contact_numbers.h"

#include <algorithm>

namespace weft::cpu {
namespace {

// Part of the largest reach with which every tile begins a substep.
constexpr float least_reach = 0.3f;
// A tile whose reach does not suffice gets so many times the distance that its particles have moved.
constexpr float reach_growth = 2;

}  // namespace

// From how far contact moved each tile in the substep before.
void ClothContact::begin_reach() {
    reach_.resize(search_.tile_count());
    most_moved_.resize(search_.tile_count());
    for (std::size_t tile = 0; tile < reach_.size(); ++tile)
        reach_[tile] = std::min(cap_, std::max(reach_growth * most_moved_[tile], least_reach * cap_));
    std::ranges::fill(most_moved_, 0.0f);
}

void ClothContact::follow_and_search() {
    search_.follow(start_, reached_.data(), velocity_, h_, reach_);
    search();
}

void ClothContact::search() {
    search_.search(workers_, [&](FunctionRef<void(unsigned, unsigned)> task) {
        if (workers_ == 1) return task(0, 1);
        task_ = &task;
        (*barrier_)();
        task(0, workers_);
        (*barrier_)();
    });
}

void ClothContact::find_near() {
    for (NearPairs& near : near_) near.count = 0;
    before_.clear();
    add_near_pairs();
}

// Adds the pairs that are near within `reach_` and were not within `before_`. Pairs of tiles that were searched since
// are all new.
void ClothContact::add_near_pairs() {
    for (Candidates& candidates : candidates_) candidates.clear();
    search_.for_each_block(
        [&](std::uint32_t tile, const TilePairs& row, const TilePairs::Block& block, float approach) {
            ChosenBlock chosen{approach, reach_[tile] + reach_[block.other], never_near};
            if (!before_.empty() && !is_relisted(tile, block.other)) {
                chosen.before = before_[tile] + before_[block.other];
                if (!(chosen.reach > chosen.before)) return;
            }
            for (int kind = 0; kind < 2; ++kind) {
                const std::uint32_t count = block.count[kind];
                if (count == 0 || block.least_spare[kind] > approach + chosen.reach) continue;
                candidates_[kind].reserve(candidates_[kind].count + count);
                candidates_[kind].tiles.push_back({tile, block.other});
                loops_->choose(row.lists[kind], block.begin[kind], count, chosen, candidates_[kind]);
            }
        });
    const NearInput input{&start_->x, &reached_.data()->x, contact_gap_floor};
    for (int kind = 0; kind < 2; ++kind) {
        const std::uint32_t begin = near_[kind].count;
        candidates_[kind].pad(cloths_.front()->base);
        loops_->find_near[kind](candidates_[kind], input, near_[kind]);
        drop_pairs_without_side(kind, begin);
        near_[kind].pad(cloths_.front()->base);
    }
}

// Whether the pairs of two tiles were listed anew by the last search.
bool ClothContact::is_relisted(std::uint32_t a, std::uint32_t b) const {
    return search_.outdated(a) || search_.outdated(b);
}

// Extends lists and near pairs if a particle has moved farther from where the constraints left it than they allow for.
// `more`: m, how much farther it may still move.
void ClothContact::extend_reach(float more) {
    search_.measure(reached_.data(), x_, moved_);
    before_ = reach_;
    bool any = false;
    for (std::size_t tile = 0; tile < reach_.size(); ++tile) {
        most_moved_[tile] = std::max(most_moved_[tile], moved_[tile]);
        moved_[tile] += more;
        if (moved_[tile] <= reach_[tile]) continue;
        reach_[tile] = std::max(std::min(reach_growth * moved_[tile], cap_), 1.01f * moved_[tile]);
        any = true;
    }
    if (!any) return;
    std::array<std::vector<std::array<std::uint32_t, 4>>, 2> pushed;
    if (search_.find_outdated(reached_.data(), reach_)) {
        follow_and_search();
        for (int kind = 0; kind < 2; ++kind) pushed[kind] = remove_relisted(near_[kind]);
    }
    const std::array begin{near_[0].count, near_[1].count};
    add_near_pairs();
    for (int kind = 0; kind < 2; ++kind) mark_pushed(near_[kind], begin[kind], pushed[kind]);
}

// Removes the pairs of tiles that were searched since. Returns those that contact pushed.
std::vector<std::array<std::uint32_t, 4>> ClothContact::remove_relisted(NearPairs& near) const {
    std::vector<std::array<std::uint32_t, 4>> pushed;
    for (std::uint32_t i = 0; i < near.count;) {
        if (!is_relisted(near.tile[0][i], near.tile[1][i])) {
            ++i;
            continue;
        }
        if (near.pushed[i]) pushed.push_back(near.particles(i));
        near.move(--near.count, i);
    }
    return pushed;
}

// Marks the pairs among those from number `begin` on.
void ClothContact::mark_pushed(NearPairs& near, std::uint32_t begin, std::vector<std::array<std::uint32_t, 4>>& pairs) {
    if (pairs.empty()) return;
    std::ranges::sort(pairs);
    for (const auto& pair : pairs) marked_[pair[0]] = 1;
    for (std::uint32_t i = begin; i < near.count; ++i)
        near.pushed[i] = marked_[near.particle[0][i]] && std::ranges::binary_search(pairs, near.particles(i));
    for (const auto& pair : pairs) marked_[pair[0]] = 0;
}

}  // namespace weft::cpu
