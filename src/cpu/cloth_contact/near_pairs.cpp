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

// Marks the pairs among those from number `begin` on.
void mark_pushed(NearPairs& near, std::uint32_t begin, std::vector<std::array<std::uint32_t, 4>>& pairs) {
    if (pairs.empty()) return;
    std::ranges::sort(pairs);
    for (std::uint32_t i = begin; i < near.count; ++i)
        near.pushed[i] = std::ranges::binary_search(pairs, near.particles(i));
}

}  // namespace

// From how far contact moved each tile in the substep before.
void ClothContact::begin_reach() {
    reach_.resize(search_.tile_count());
    most_moved_.resize(search_.tile_count());
    for (std::size_t tile = 0; tile < reach_.size(); ++tile)
        reach_[tile] = std::min(caps_[tile], std::max(reach_growth * most_moved_[tile], least_reach * own_caps_[tile]));
    std::ranges::fill(most_moved_, 0.0f);
}

void ClothContact::follow_and_search() {
    search_.follow(start_, reached_, velocity_, h_, reach_, team_);
    search_.search(team_);
}

void ClothContact::find_near() {
    before_.clear();
    in_parallel([&](Mine& mine) {
        for (NearPairs& near : mine.near) near.count = 0;
        add_near_pairs(mine);
    });
}

// Adds the pairs that are near within `reach_` and were not within `before_`. Pairs of tiles that were searched since
// are all new.
void ClothContact::add_near_pairs(Mine& mine) const {
    for (Candidates& candidates : mine.candidates) candidates.clear();
    search_.for_each_block(
        mine.worker, team_.size(),
        [&](std::uint32_t tile, const TilePairs& row, const TilePairs::Block& block, float approach) {
            ChosenBlock chosen{approach, reach_[tile] + reach_[block.other], never_near};
            if (!before_.empty() && !is_relisted(tile, block.other)) {
                chosen.before = before_[tile] + before_[block.other];
                if (!(chosen.reach > chosen.before)) return;
            }
            const SearchedCloth &one = search_.cloth(tile), &two = search_.cloth(block.other);
            const bool square = one.surface || two.surface || one.thin || two.thin;
            for (int kind = 0; kind < 2; ++kind) {
                const std::uint32_t count = block.count[kind];
                if (count == 0 || block.least_spare[kind] > approach + chosen.reach) continue;
                Candidates& candidates = mine.candidates[square ? 2 + kind : kind];
                candidates.reserve(candidates.count + count);
                candidates.tiles.push_back({tile, block.other});
                loops_->choose(row.lists[kind], block.begin[kind], count, chosen, candidates);
            }
        });
    for (int kind = 0; kind < 2; ++kind) {
        NearPairs& near = mine.near[kind];
        const std::uint32_t begin = near.count;
        for (const bool square : {false, true}) {
            Candidates& candidates = mine.candidates[square ? 2 + kind : kind];
            if (candidates.count == 0) continue;
            candidates.pad(cloths_.front()->base);
            loops_->find_near[kind](candidates, {&start_->x, &reached_->x, contact_gap_floor, square}, near);
        }
        drop_pairs_without_side(near, kind, begin);
        near.pad(cloths_.front()->base);
    }
}

// Whether the pairs of two tiles were listed anew by the last search.
bool ClothContact::is_relisted(std::uint32_t a, std::uint32_t b) const {
    return search_.outdated(a) || search_.outdated(b);
}

// Extends lists and near pairs if a particle has moved farther from where the constraints left it than they allow for.
void ClothContact::extend_reach() {
    search_.measure(reached_, x_, moved_, team_);
    extend_reach_to_moved();
}

// For all that the limit may do: it moves particles aside, and with surfaces.
void ClothContact::extend_reach_of_limit() {
    search_.measure(reached_, x_, moved_, team_);
    for (std::size_t tile = 0; tile < reach_.size(); ++tile) {
        if (!carriers_.empty() && caps_[tile] > 0)
            moved_[tile] = std::max(moved_[tile], caps_[tile] - limit_carry_margin * own_caps_[tile]);
        moved_[tile] += limit_aside * own_caps_[tile];
    }
    extend_reach_to_moved();
}

void ClothContact::extend_reach_to_moved() {
    before_ = reach_;
    bool any = false;
    for (std::size_t tile = 0; tile < reach_.size(); ++tile) {
        most_moved_[tile] = std::max(most_moved_[tile], moved_[tile]);
        if (moved_[tile] <= reach_[tile]) continue;
        reach_[tile] = std::max(std::min(reach_growth * moved_[tile], caps_[tile]), 1.01f * moved_[tile]);
        any = true;
    }
    if (!any) return;
    const bool relisted = search_.find_outdated(reached_, reach_, false, team_);
    if (relisted) follow_and_search();
    extend_near_pairs(relisted);
}

void ClothContact::extend_near_pairs(bool relisted) {
    in_parallel([&](Mine& mine) {
        std::array<std::vector<std::array<std::uint32_t, 4>>, 2> pushed;
        if (relisted)
            for (int kind = 0; kind < 2; ++kind) pushed[kind] = remove_relisted(mine.near[kind]);
        const std::array begin{mine.near[0].count, mine.near[1].count};
        add_near_pairs(mine);
        for (int kind = 0; kind < 2; ++kind) mark_pushed(mine.near[kind], begin[kind], pushed[kind]);
    });
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

}  // namespace weft::cpu
