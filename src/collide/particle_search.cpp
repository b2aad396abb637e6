#include "collide/particle_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace weft {
namespace {

// Part of a tile's margin that a particle may stray from the motion of its tile before the tile is listed anew. The
// rest of the margins is for the motion of tiles relative to each other.
constexpr float most_strayed = 0.3f;
// How far a tile may leave the common motion before tiles near each other are searched again, in margins.
constexpr float tile_reach = 3;
constexpr std::uint32_t no_tile = ~0u;
// Listed pairs may be this much farther apart, because rounding makes distances inexact: a part of the margin, and of
// the largest coordinate.
constexpr float rounding_of_margin = 1e-3f, rounding_of_place = 1e-6f;

Vec3 middle(const ParticleBox& box) {
    return {0.5f * (box.low[0] + box.high[0]), 0.5f * (box.low[1] + box.high[1]), 0.5f * (box.low[2] + box.high[2])};
}
ParticleBox empty_box() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {{infinity, infinity, infinity, infinity}, {-infinity, -infinity, -infinity, -infinity}};
}
// Written so that compilers make one vector operation of each line.
void extend(ParticleBox& box, const std::array<float, 4>& place) {
    for (int k = 0; k < 4; ++k) box.low[k] = place[k] < box.low[k] ? place[k] : box.low[k];
    for (int k = 0; k < 4; ++k) box.high[k] = place[k] > box.high[k] ? place[k] : box.high[k];
}
float largest_coordinate(const ParticleBox& box) {
    float largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, std::fabs(box.low[k]), std::fabs(box.high[k])});
    return largest;
}
// Distance between two boxes, the second one moved by `shift`.
float gap_between(const ParticleBox& a, const ParticleBox& b, Vec3 shift) {
    const std::array<float, 3> moved{shift.x, shift.y, shift.z};
    float sum = 0;
    for (int k = 0; k < 3; ++k) {
        const float gap = std::max({0.0f, b.low[k] + moved[k] - a.high[k], a.low[k] - b.high[k] - moved[k]});
        sum += gap * gap;
    }
    return std::sqrt(sum);
}

// Particles near a seam keep at most a part of their distance at rest through it, as neighbors on one cloth do.
void apply_seams(const Seams& seams, float part_at_rest, ParticlePairs& pairs, std::uint32_t begin) {
    std::uint32_t kept = begin;
    for (std::uint32_t i = begin; i < pairs.count; ++i) {
        const float through = seams.distance(pairs.one[i], pairs.two[i]);
        if (!(through > 0)) continue;
        pairs.one[kept] = pairs.one[i], pairs.two[kept] = pairs.two[i];
        pairs.diameter[kept] = std::min(pairs.diameter[i], through * part_at_rest);
        ++kept;
    }
    pairs.count = kept;
}

}  // namespace

void ParticlePairs::reserve(std::size_t pairs) {
    const std::size_t needed = pairs + 16;
    if (one.size() >= needed) return;
    const std::size_t room = needed + needed / 2;
    one.resize(room), two.resize(room), diameter.resize(room);
}

void ParticlePairs::append(const ParticlePairs& other, std::uint32_t begin, std::uint32_t pairs) {
    reserve(count + pairs);
    std::copy_n(&other.one[begin], pairs, &one[count]);
    std::copy_n(&other.two[begin], pairs, &two[count]);
    std::copy_n(&other.diameter[begin], pairs, &diameter[count]);
    count += pairs;
}

void ParticlePairs::pad(std::uint32_t with_particle) {
    reserve(count);
    std::fill_n(&one[count], 16, with_particle), std::fill_n(&two[count], 16, with_particle);
    std::fill_n(&diameter[count], 16, 0.0f);
}

void ParticleSearch::set_cloths(const ParticleSearchLoops& loops, std::vector<SearchedParticles> cloths,
                                unsigned workers) {
    loops_ = &loops;
    if (scratch_.size() < workers) scratch_.resize(workers);
    if (cloths == cloths_) return;
    cloths_ = std::move(cloths);
    tiles_.clear(), listed_.clear();
    for (std::uint32_t c = 0; c < cloths_.size(); ++c) {
        const SearchedParticles& cloth = cloths_[c];
        const auto size = static_cast<std::uint32_t>(cloth.order->size());
        for (std::uint32_t begin = 0; begin < size; begin += particle_tile) {
            ListedTile& listed = listed_.emplace_back();
            const std::uint32_t count = std::min(particle_tile, size - begin);
            listed.rest_box = empty_box();
            for (std::uint32_t i = 0; i < particle_tile; ++i) {
                const std::uint32_t p = (*cloth.order)[begin + std::min(i, count - 1)];
                const Vec4 x = cloth.rest[p];
                listed.particle[i] = cloth.base + p;
                listed.diameter[i] = cloth.uneven ? cloth.uneven.at(p) : cloth.diameter;
                listed.largest = std::max(listed.largest, listed.diameter[i]);
                listed.rest[0][i] = x.x, listed.rest[1][i] = x.y, listed.rest[2][i] = x.z;
                extend(listed.rest_box, {x.x, x.y, x.z, 0});
            }
            tiles_.push_back({.cloth = c, .count = count, .now = {}, .reach = {}});
        }
    }
    motions_.assign(tiles_.size(), {});
    listed_places_.assign(tiles_.size() * particle_tile, {});
    rows_.assign(tiles_.size(), {});
    near_.assign(tiles_.size(), {}), fresh_near_.assign(tiles_.size(), {});
    reached_ = false;
    group_tiles();
}

// The box around the motions of all particles bounds how far any of them strays from its center. Comparisons leave out
// what is not a number; the sum does not.
void ParticleSearch::track(std::uint32_t tile, const Vec4* positions) {
    const ListedTile& listed = listed_[tile];
    const Vec4* places = &listed_places_[std::size_t{tile} * particle_tile];
    ParticleBox now = empty_box(), motions = empty_box();
    std::array<float, 4> sum{};
    for (std::uint32_t i = 0; i < particle_tile; ++i) {
        const Vec4 x = positions[listed.particle[i]], y = places[i];
        const std::array<float, 4> moved{x.x - y.x, x.y - y.y, x.z - y.z, 0};
        extend(now, {x.x, x.y, x.z, 0});
        extend(motions, moved);
        for (int k = 0; k < 4; ++k) sum[k] += moved[k];
    }
    tiles_[tile].now = now;
    const Vec3 extent{motions.high[0] - motions.low[0], motions.high[1] - motions.low[1],
                      motions.high[2] - motions.low[2]};
    const bool finite = std::isfinite(sum[0] + sum[1] + sum[2]);
    motions_[tile] = {middle(motions), finite ? 0.5f * length(extent) : std::numeric_limits<float>::infinity()};
}

void ParticleSearch::list_tile_anew(std::uint32_t tile, const Vec4* positions) {
    ListedTile& listed = listed_[tile];
    for (std::uint32_t i = 0; i < particle_tile; ++i) {
        const Vec4 x = positions[listed.particle[i]];
        const bool used = i < tiles_[tile].count;
        listed.place[0][i] = used ? x.x : 1e18f, listed.place[1][i] = x.y, listed.place[2][i] = x.z;
        listed_places_[std::size_t{tile} * particle_tile + i] = x;
    }
    listed.box = tiles_[tile].now;
    motions_[tile] = {};
}

void ParticleSearch::find_outdated(const Vec4* positions, bool always) {
    const bool finite = std::ranges::all_of(motions_, [](const Motion& one) { return std::isfinite(one.strayed); });
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
        Tile& tile = tiles_[t];
        tile.outdated = always || !reached_ || !(motions_[t].strayed <= most_strayed * margin(tile));
        if (tile.outdated) list_tile_anew(t, positions);
    }
    if (always || any_out_of_reach()) find_near_tiles();
    reached_ = finite;  // lists made for positions that are not finite say nothing about the next ones
}

// Whether the particles of two tiles may have approached each other by more than a distance since their block was
// listed.
bool ParticleSearch::approached(std::uint32_t tile, const Block& block, float distance) const {
    const Motion &a = motions_[tile], &b = motions_[block.other];
    const Vec3 relative = b.moved - a.moved - block.shift;
    const float left = distance - a.strayed - b.strayed;
    return !(left >= 0 && dot(relative, relative) <= left * left);
}

bool ParticleSearch::any_out_of_reach() const {
    if (!reached_) return true;
    ParticleBox drifts = empty_box();
    for (const Tile& tile : tiles_) {
        const Vec3 drift = middle(tile.now) - middle(tile.reach);
        extend(drifts, {drift.x, drift.y, drift.z, 0});
    }
    const Vec3 common = middle(drifts);
    const std::array<float, 3> drift{common.x, common.y, common.z};
    return std::ranges::any_of(tiles_, [&](const Tile& tile) {
        bool inside = true;
        for (int k = 0; k < 3; ++k)
            inside = inside && tile.now.low[k] - drift[k] >= tile.reach.low[k] &&
                     tile.now.high[k] - drift[k] <= tile.reach.high[k];
        return !inside;
    });
}

// Tiles of a cloth that follow one another are neighbors. No group has tiles of two cloths, which may be far apart.
void ParticleSearch::group_tiles() {
    grouped_.tile.clear(), grouped_.place.clear();
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
        if (t > 0 && tiles_[t].cloth != tiles_[t - 1].cloth)
            while (grouped_.tile.size() % boxes_together != 0) grouped_.tile.push_back(no_tile);
        grouped_.place.push_back(static_cast<std::uint32_t>(grouped_.tile.size()));
        grouped_.tile.push_back(t);
    }
    while (grouped_.tile.size() % boxes_together != 0) grouped_.tile.push_back(no_tile);
    const std::size_t groups = grouped_.tile.size() / boxes_together;
    grouped_.boxes.assign(grouped_.tile.size(), empty_box());
    grouped_.groups.resize(groups);
    grouped_.around.resize(groups);
    grouped_.outer_groups.resize((groups + boxes_together - 1) / boxes_together);
}

// From what the tiles' particles can reach, widened by half of what pairs may be apart, and a little for rounding.
void ParticleSearch::group_boxes() {
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
        const SearchedParticles& cloth = cloths_[tiles_[t].cloth];
        const float half = 0.505f * (listed_[t].largest + cloth.margin);
        ParticleBox& box = grouped_.boxes[grouped_.place[t]];
        box = tiles_[t].reach;
        for (int k = 0; k < 3; ++k) box.low[k] -= half, box.high[k] += half;
    }
    const auto put = [](std::span<const ParticleBox> boxes, std::size_t group, BoxGroup& to) {
        for (std::size_t i = 0; i < boxes_together; ++i) {
            const std::size_t at = group * boxes_together + i;
            const ParticleBox box = at < boxes.size() ? boxes[at] : empty_box();
            for (int k = 0; k < 3; ++k) to.low[k][i] = box.low[k], to.high[k][i] = box.high[k];
        }
    };
    for (std::size_t g = 0; g < grouped_.groups.size(); ++g) {
        put(grouped_.boxes, g, grouped_.groups[g]);
        grouped_.around[g] = empty_box();
        for (std::size_t i = 0; i < boxes_together; ++i) {
            extend(grouped_.around[g], grouped_.boxes[g * boxes_together + i].low);
            extend(grouped_.around[g], grouped_.boxes[g * boxes_together + i].high);
        }
    }
    for (std::size_t g = 0; g < grouped_.outer_groups.size(); ++g) put(grouped_.around, g, grouped_.outer_groups[g]);
}

bool ParticleSearch::can_meet(std::uint32_t tile, std::uint32_t other) const {
    const std::uint32_t a = tiles_[tile].cloth, b = tiles_[other].cloth;
    if (!cloths_[a].with_alike && !cloths_[b].with_alike) return false;
    return a == b || collide(cloths_[a].filter, cloths_[b].filter);
}

// For each tile, those that can come near while all tiles stay within their reach, apart from a common motion. A box
// that is not a number overlaps none.
void ParticleSearch::find_near_tiles() {
    for (Tile& tile : tiles_) {
        const float reach = tile_reach * margin(tile);
        tile.reach = tile.now;
        for (int k = 0; k < 3; ++k) tile.reach.low[k] -= reach, tile.reach.high[k] += reach;
    }
    reached_ = true;
    group_boxes();
    for (auto& list : fresh_near_) list.clear();
    const auto groups = static_cast<std::uint32_t>(grouped_.groups.size());
    // Visits groups in ascending order, so that lists are ascending.
    for (std::uint32_t g = 0; g < groups; ++g) {
        for (std::uint32_t outer = g / boxes_together; outer < grouped_.outer_groups.size(); ++outer) {
            std::uint32_t near = loops_->overlapping(grouped_.outer_groups[outer], grouped_.around[g]);
            for (; near != 0; near &= near - 1) {
                const std::uint32_t other = outer * boxes_together + static_cast<std::uint32_t>(std::countr_zero(near));
                if (other >= g) add_near_tiles(g, other);
            }
        }
    }
    for (std::uint32_t t = 0; t < tiles_.size(); ++t) {
        if (near_[t] == fresh_near_[t]) continue;
        std::swap(near_[t], fresh_near_[t]);
        tiles_[t].renewed = true;
    }
}

void ParticleSearch::add_near_tiles(std::uint32_t group, std::uint32_t other_group) {
    for (std::uint32_t i = group * boxes_together; i < (group + 1) * boxes_together; ++i) {
        const std::uint32_t tile = grouped_.tile[i];
        if (tile == no_tile) return;
        std::uint32_t near = loops_->overlapping(grouped_.groups[other_group], grouped_.boxes[i]);
        for (; near != 0; near &= near - 1) {
            const std::uint32_t place =
                other_group * boxes_together + static_cast<std::uint32_t>(std::countr_zero(near));
            const std::uint32_t other = grouped_.tile[place];
            if (other != no_tile && other >= tile && can_meet(tile, other)) fresh_near_[tile].push_back(other);
        }
    }
}

ParticleSearch::Block ParticleSearch::list_block(std::uint32_t tile, std::uint32_t other, ParticlePairs& pairs) const {
    const ListedTile &a = listed_[tile], &b = listed_[other];
    const SearchedParticles &of_a = cloths_[tiles_[tile].cloth], &of_b = cloths_[tiles_[other].cloth];
    Block block{.other = other, .begin = pairs.count, .shift = motions_[other].moved - motions_[tile].moved};
    const float margin = 0.5f * (of_a.margin + of_b.margin), diameter = 0.5f * (a.largest + b.largest);
    const float rounding = rounding_of_margin * margin + rounding_of_place * (largest_coordinate(tiles_[tile].now) +
                                                                              largest_coordinate(tiles_[other].now));
    const float gap = gap_between(a.box, b.box, block.shift);
    block.allowed = std::max(margin, gap - diameter - rounding);
    if (gap > diameter + margin + rounding) return block;
    const float at_rest = gap_between(a.rest_box, b.rest_box, {});
    const bool by_rest =
        &of_a == &of_b && std::max(at_rest * of_a.part_at_rest, at_rest - of_a.less_at_rest) < 1.001f * diameter;
    const TilesToList tiles{.one = &a,
                            .two = &b,
                            .shift = block.shift,
                            .diameter = diameter,
                            .margin = margin + rounding,
                            .part_at_rest = of_a.part_at_rest,
                            .less_at_rest = of_a.less_at_rest,
                            .by_rest = by_rest,
                            .uneven = of_a.uneven || of_b.uneven};
    block.spare = loops_->list(tiles, pairs) - rounding;
    if (of_a.seams) apply_seams(*of_a.seams, of_a.part_at_rest, pairs, block.begin);
    block.count = pairs.count - block.begin;
    return block;
}

// Keeps the valid blocks and lists the others anew.
void ParticleSearch::relist(std::uint32_t tile, Scratch& scratch) {
    Row& row = rows_[tile];
    scratch.pairs.count = 0;
    scratch.blocks.clear();
    auto kept = row.blocks.begin();
    for (const std::uint32_t other : near_[tile]) {
        while (kept != row.blocks.end() && kept->other < other) ++kept;
        const bool known = kept != row.blocks.end() && kept->other == other;
        if (!known || tiles_[tile].outdated || tiles_[other].outdated || approached(tile, *kept, kept->allowed)) {
            scratch.blocks.push_back(list_block(tile, other, scratch.pairs));
            continue;
        }
        Block block = *kept;
        block.begin = scratch.pairs.count;
        if (block.count > 0) scratch.pairs.append(row.pairs, kept->begin, kept->count);
        scratch.blocks.push_back(block);
    }
    scratch.pairs.pad(listed_[tile].particle[0]);
    std::swap(scratch.pairs, row.pairs);
    std::swap(scratch.blocks, row.blocks);
}

bool ParticleSearch::list(std::uint32_t tile, unsigned worker) {
    Row& row = rows_[tile];
    const bool outdated =
        tiles_[tile].outdated || tiles_[tile].renewed || std::ranges::any_of(row.blocks, [&](const Block& block) {
            return tiles_[block.other].outdated || approached(tile, block, block.allowed);
        });
    if (outdated) relist(tile, scratch_[worker]);
    tiles_[tile].renewed = false;
    row.runs.clear();
    for (const Block& block : row.blocks) {
        if (block.count == 0 || !approached(tile, block, block.spare)) continue;
        if (!row.runs.empty() && row.runs.back()[1] == block.begin) {
            row.runs.back()[1] += block.count;
        } else {
            row.runs.push_back({block.begin, block.begin + block.count});
        }
    }
    return outdated;
}

}  // namespace weft
