#include "collide/pair_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace weft {
namespace {

// Ticks that a list is made for at most. A longer one holds more pairs and is made less often.
constexpr std::int32_t longest_lifetime = 12;
// Part of the slack that particles of a tile may leave its mean motion by while a list lasts.
constexpr float most_spread = 1.0f;
// The same for the relative motion of two tiles, per margin of both. Tiles that meet at speed get a list for few ticks:
// it would hold all that they fly past.
constexpr float most_approach = 0.5f;
// Motion per tick, in slacks, below which a tile counts as resting: its list has no end.
constexpr float resting = 0.1f;
// How far, in slacks, the motion within a tick may differ from the velocity for the list to follow the velocity.
constexpr float follows_velocity = 0.48f;
// A list for one tick covers what its particles are known to need, and besides so many times their reach and so much of
// the slack.
constexpr float spare_reach = 1, spare_slack = 0.1f;
// Part of the slack by which a list for all places of a tick covers more than these.
constexpr float slack_of_cover = 0.1f;
// Part of the slack by which rounding may change a distance.
constexpr float rounding_of_slack = 0.01f;

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

float squared(Vec3 v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}
float length_of(Vec3 v) {
    return std::sqrt(squared(v));
}

// A float for each particle. Not its number itself, which a float holds up to 2^24 only.
float distinct_float(std::uint32_t particle) {
    return std::bit_cast<float>(0x3f800000u + particle);
}

template <std::size_t Count, std::size_t Corners>
void number_features(const std::array<std::array<std::uint32_t, Count>, Corners>& vertex, std::uint32_t count,
                     const TileState& tile, FeatureArrays<Count, Corners>& features) {
    for (std::size_t c = 0; c < Corners; ++c)
        for (std::uint32_t i = 0; i < count; ++i) features.number[c][i] = distinct_float(tile.particle[vertex[c][i]]);
}

void number_features(TileState& tile) {
    for (std::uint32_t i = 0; i < tile.tile->own_vertices; ++i)
        tile.vertices.number[0][i] = distinct_float(tile.particle[i]);
    number_features(tile.tile->edge, tile.tile->edge_count, tile, tile.edges);
    number_features(tile.tile->triangle, tile.tile->triangle_count, tile, tile.triangles);
}

}  // namespace

void PairList::reserve(std::uint32_t pairs) {
    const std::size_t needed = std::size_t{pairs} + 16;
    if (thickness.size() >= needed) return;
    const std::size_t room = needed + needed / 2;
    for (auto& array : particle) array.resize(room);
    thickness.resize(room), spare.resize(room);
}

void PairList::append(const PairList& other, std::uint32_t begin, std::uint32_t pairs) {
    reserve(count + pairs);
    for (int k = 0; k < 4; ++k) std::copy_n(&other.particle[k][begin], pairs, &particle[k][count]);
    std::copy_n(&other.thickness[begin], pairs, &thickness[count]);
    std::copy_n(&other.spare[begin], pairs, &spare[count]);
    count += pairs;
}

void PairList::pad(std::uint32_t with_particle) {
    reserve(count);
    for (std::uint32_t i = count; i < count + 16; ++i) {
        for (auto& array : particle) array[i] = with_particle;
        thickness[i] = -1;
    }
}

void PairSearch::set_cloths(const SearchLoops& loops, std::vector<SearchedCloth> cloths) {
    loops_ = &loops;
    if (cloths == cloths_) return;
    cloths_ = std::move(cloths);
    tiles_.clear(), pairs_.clear();
    thickest_ = most_slack_ = 0;
    std::size_t count = 0;
    for (const SearchedCloth& cloth : cloths_) count += cloth.tiles->size();
    tiles_.resize(count);
    pairs_.resize(count);
    near_.assign(count, {});
    thickness_.resize(count);
    outdated_.assign(count, 0);
    for (auto& array : bounds_) array.assign(count + 16, 1e9f);
    std::size_t at = 0;
    for (std::uint32_t c = 0; c < cloths_.size(); ++c) {
        thickest_ = std::max(thickest_, cloths_[c].thickness);
        most_slack_ = std::max(most_slack_, cloths_[c].slack);
        for (const Tile& tile : *cloths_[c].tiles) {
            const std::span vertices(tile.particle.data(), tile.vertex_count);
            thickness_[at] = cloths_[c].uneven ? cloths_[c].uneven.most_of(vertices) : cloths_[c].thickness;
            TileState& state = tiles_[at++];
            state.tile = &tile;
            state.cloth = c;
            state.slack = cloths_[c].slack;
            for (std::uint32_t i = 0; i < tile_vertices; ++i) state.particle[i] = cloths_[c].base + tile.particle[i];
            number_features(state);
        }
    }
    find_owners();
    for (TilePairs& row : pairs_) {
        row.until = never;
        for (PairList& list : row.lists) list.pad(cloths_.front().base);
    }
}

void PairSearch::find_owners() {
    std::unordered_map<std::uint32_t, std::uint32_t> owner;  // by particle
    for (std::uint32_t i = 0; i < tiles_.size(); ++i)
        for (std::uint32_t k = 0; k < tiles_[i].tile->own_vertices; ++k) owner[tiles_[i].particle[k]] = i;
    owners_.assign(tiles_.size(), {});
    for (std::uint32_t i = 0; i < tiles_.size(); ++i) {
        std::vector<std::uint32_t>& owners = owners_[i];
        for (std::uint32_t k = tiles_[i].tile->own_vertices; k < tiles_[i].tile->vertex_count; ++k) {
            const std::uint32_t of_vertex = owner.at(tiles_[i].particle[k]);
            if (std::ranges::find(owners, of_vertex) == owners.end()) owners.push_back(of_vertex);
        }
    }
}

std::int64_t PairSearch::remaining(const TileState& tile) const {
    return tile.moving ? tile.lifetime - (tick_ - tile.listed) : never;
}

// Where neither the tile nor its trajectory moves, one computation lasts for the frame.
float PairSearch::deviation(TileState& tile, const Vec4* positions, float ticks) const {
    const bool is_constant = rests(tile) && !tile.moving;
    if (is_constant && tile.deviation >= 0) return tile.deviation;
    const float deviation = loops_->deviation(tile, &positions->x, ticks);
    tile.deviation = is_constant ? deviation : -1;
    return deviation;
}

void PairSearch::check_start(const Vec4* positions) {
    for (TileState& tile : tiles_) {
        if (tile.listed < 0) continue;
        tile.deviation = -1;
        const float away = deviation(tile, positions, static_cast<float>(tick_ - tile.listed));
        tile.strays[0] = away + tile.most_around;
        if (!(away <= tile.slack)) tile.listed = -1;
    }
}

void PairSearch::measure(const Vec4* places, const Vec4* other_places, std::vector<float>& distance,
                         const LedTeam& team) {
    distance.resize(tiles_.size());
    of_owned_.resize(tiles_.size());
    for_each_tile(team, [&](std::uint32_t i) {
        of_owned_[i] = rests(tiles_[i]) ? 0 : loops_->measure(tiles_[i], &places->x, &other_places->x);
    });
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
        distance[i] = of_owned_[i];
        for (const std::uint32_t owner : owners_[i]) distance[i] = std::max(distance[i], of_owned_[owner]);
    }
}

bool PairSearch::find_outdated(const Vec4* positions, std::span<const float> reach, bool all, const LedTeam& team) {
    for_each_tile(team, [&](std::uint32_t i) {
        TileState& tile = tiles_[i];
        bool outdated = all || tile.listed < 0 || remaining(tile) < 1;
        if (!outdated) {
            const auto ticks = static_cast<float>(tick_ + 1 - tile.listed);
            const float away = deviation(tile, positions, ticks);
            tile.strays[1] = std::max(tile.strays[1], away + tile.most_around);
            outdated = !(away + (reach.empty() ? 0 : reach[i]) <= tile.slack);
        }
        outdated_[i] = outdated;
    });
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        if (outdated_[i] || pairs_[i].until <= tick_) return true;
    return false;
}

void PairSearch::follow(const Vec4* from, const Vec4* to, const Vec4* velocity, float h, std::span<const float> reach,
                        const LedTeam& team) {
    for_each_tile(team, [&](std::uint32_t i) {
        if (outdated_[i]) follow(tiles_[i], from, to, velocity, h, reach.empty() ? 0 : reach[i]);
    });
}

void PairSearch::cover(const Vec4* from, const Vec4* to) {
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        if (outdated_[i]) cover(tiles_[i], from, to);
}

// The trajectory follows the velocity rather than the motion of this tick, and runs midway between the two ends: at
// rest the constraints pull a pile together by the same amount in every tick and contact pushes it back, which is no
// motion.
void PairSearch::follow(TileState& tile, const Vec4* from, const Vec4* to, const Vec4* velocity, float h, float reach) {
    const std::uint32_t count = tile.tile->vertex_count;
    float fastest = 0, farthest = 0, most_off = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t p = tile.particle[i];
        const Vec3 v = velocity[p].xyz() * h, moved = to[p].xyz() - from[p].xyz();
        farthest = std::max(farthest, squared(moved - v));
        fastest = std::max(fastest, squared(v));
    }
    const float full = full_slack(tile);
    const bool along_velocity = std::sqrt(farthest) < follows_velocity * full;
    const bool moving = !along_velocity || fastest > resting * resting * full * full;
    for (std::uint32_t i = 0; i < tile_vertices; ++i) {
        const std::uint32_t p = tile.particle[i];
        const Vec3 start = from[p].xyz(), moved = to[p].xyz() - start;
        const Vec3 v = !along_velocity ? moved : moving ? velocity[p].xyz() * h : Vec3{};
        const Vec3 place = start + (moved - v) * 0.5f;
        tile.place[0][i] = place.x, tile.place[1][i] = place.y, tile.place[2][i] = place.z;
        tile.velocity[0][i] = v.x, tile.velocity[1][i] = v.y, tile.velocity[2][i] = v.z;
        most_off = std::max(most_off, squared(moved - v));
    }
    const float off = 0.5f * std::sqrt(most_off);
    begin_list(tile, moving);
    tile.slack = tile.lifetime > 1 ? full : std::min(full, off + (1 + spare_reach) * reach + spare_slack * full);
    tile.most_around = std::max(0.0f, off + reach - (1 - rounding_of_slack) * tile.slack);
    tile.around.fill(tile.most_around);
    tile.strays.fill(off + rounding_of_slack * full + tile.most_around);
}

void PairSearch::cover(TileState& tile, const Vec4* from, const Vec4* to) {
    tile.most_around = 0;
    for (std::uint32_t i = 0; i < tile_vertices; ++i) {
        const std::uint32_t p = tile.particle[i];
        const Vec3 place = from[p].xyz();
        tile.around[i] = length_of(to[p].xyz() - place);
        tile.most_around = std::max(tile.most_around, tile.around[i]);
        tile.place[0][i] = place.x, tile.place[1][i] = place.y, tile.place[2][i] = place.z;
        for (auto& axis : tile.velocity) axis[i] = 0;
    }
    begin_list(tile, true);
    tile.lifetime = 1;
    tile.slack = slack_of_cover * full_slack(tile);
    tile.strays.fill(tile.most_around + tile.slack);
}

// Chooses how long the list of a tile lasts at most: a list that outlived its purpose is followed by a longer one, one
// that failed early by a shorter one.
void PairSearch::begin_list(TileState& tile, bool moving) {
    const std::int64_t age = tick_ - tile.listed;
    const std::int64_t adapted = std::max<std::int64_t>(1, age >= tile.lifetime ? age + 2 : age);
    tile.lifetime = static_cast<std::int32_t>(tile.listed < 0 ? 4
                                              : moving        ? std::min<std::int64_t>(longest_lifetime, adapted)
                                                              : longest_lifetime);
    tile.moving = moving;
    tile.listed = tick_;
    tile.deviation = -1;
    tile.bounded = tile.gathered = -1;
    const std::uint32_t count = tile.tile->vertex_count;
    const auto velocity = [&](std::uint32_t i) {
        return Vec3{tile.velocity[0][i], tile.velocity[1][i], tile.velocity[2][i]};
    };
    Vec3 mean{};
    for (std::uint32_t i = 0; i < count; ++i) mean = mean + velocity(i);
    tile.mean_velocity = mean * (1.0f / static_cast<float>(count));
    float spread = 0;
    for (std::uint32_t i = 0; i < count; ++i) spread = std::max(spread, squared(velocity(i) - tile.mean_velocity));
    tile.spread = std::sqrt(spread);
    const float ticks = most_spread * full_slack(tile) / (tile.spread + 1e-9f);
    if (moving && ticks < static_cast<float>(tile.lifetime))
        tile.lifetime = std::max(1, static_cast<std::int32_t>(ticks));
}

void PairSearch::bound(TileState& tile) {
    if (tile.bounded == tick_ || (tile.bounded >= 0 && !tile.moving)) return;
    tile.bounded = tick_;
    tile.middle = tile.moving ? 0.5f * static_cast<float>(remaining(tile)) : 0.0f;
    loops_->bound(tile, static_cast<float>(tick_ - tile.listed));
}

void PairSearch::gather(TileState& tile) {
    if (tile.gathered == tile.bounded) return;
    tile.gathered = tile.bounded;
    loops_->gather(tile);
}

void PairSearch::bound_tiles(const LedTeam& team) {
    for_each_tile(team, [&](std::uint32_t i) {
        TileState& tile = tiles_[i];
        bound(tile);
        const std::array<float, 3> mean{tile.mean_velocity.x, tile.mean_velocity.y, tile.mean_velocity.z};
        for (int k = 0; k < 3; ++k) {
            bounds_[k][i] = tile.center[k];
            bounds_[3 + k][i] = tile.half[k];
            bounds_[6 + k][i] = mean[k];
        }
    });
}

// For each outdated tile, the tiles whose boxes come near while the list can last.
void PairSearch::find_near_tiles() {
    const auto count = static_cast<std::uint32_t>(tiles_.size());
    for (auto& list : near_) list.clear();
    const float half_time = 0.5f * longest_lifetime;
    const auto is_near = [&](std::uint32_t a, std::uint32_t b) {
        const float apart = 0.5f * (thickness_[a] + thickness_[b]) + 2 * most_slack_;
        bool near = true;
        for (int k = 0; k < 3; ++k) {
            const float shift = (bounds_[6 + k][b] - bounds_[6 + k][a]) * half_time;
            const float distance = std::fabs(bounds_[k][a] - bounds_[k][b] - shift);
            near &= distance <= bounds_[3 + k][a] + bounds_[3 + k][b] + apart + std::fabs(shift);
        }
        return near;
    };
    const auto can_meet = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t of_a = tiles_[a].cloth, of_b = tiles_[b].cloth;
        if (cloths_[of_a].surface && cloths_[of_b].surface) return false;
        return of_a == of_b || collide(cloths_[of_a].filter, cloths_[of_b].filter);
    };
    // Along the axis on which the tiles spread most, only those in a window come into question.
    const int axis = sort_tiles();
    const auto center = [&](std::uint32_t i) { return bounds_[axis][i]; };
    float largest = 0, fastest = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        largest = std::max(largest, bounds_[3 + axis][i]);
        fastest = std::max(fastest, std::fabs(bounds_[6 + axis][i]));
    }
    for (std::uint32_t a = 0; a < count; ++a) {
        if (!outdated_[a]) continue;
        ++searched_;
        const float apart = 0.5f * (thickness_[a] + thickest_) + 2 * most_slack_;
        const float window =
            bounds_[3 + axis][a] + largest + apart + 2 * half_time * (fastest + std::fabs(bounds_[6 + axis][a]));
        for (auto b = std::ranges::lower_bound(sorted_, center(a) - window, {}, center);
             b != sorted_.end() && center(*b) <= center(a) + window; ++b) {
            if (is_near(a, *b) && can_meet(a, *b) && !(outdated_[*b] && *b < a))
                near_[std::min(a, *b)].push_back(std::max(a, *b));
        }
    }
}

// Sorts the tiles along the axis on which their centers spread most.
int PairSearch::sort_tiles() {
    const auto count = static_cast<std::uint32_t>(tiles_.size());
    int axis = 0;
    float most = -1;
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax_element(bounds_[k].begin(), bounds_[k].begin() + count);
        if (*high - *low > most) axis = k, most = *high - *low;
    }
    sorted_.resize(count);
    std::iota(sorted_.begin(), sorted_.end(), 0u);
    // A center that is not a number is near nothing. It counts as 0 here, because it has no place in the order.
    for (std::uint32_t i = 0; i < count; ++i)
        if (!(std::fabs(bounds_[axis][i]) < 1e30f)) bounds_[axis][i] = 0, bounds_[3 + axis][i] = -1e30f;
    std::ranges::sort(sorted_, {}, [&](std::uint32_t i) { return bounds_[axis][i]; });
    return axis;
}

TileReach PairSearch::reach(std::uint32_t tile_a, std::uint32_t tile_b, TilePairs::Block& block) const {
    const TileState &a = tiles_[tile_a], &b = tiles_[tile_b];
    const SearchedCloth &of_a = cloths_[a.cloth], &of_b = cloths_[b.cloth];
    const float slack_both = a.slack + b.slack;
    const std::int64_t full = std::min<std::int64_t>({longest_lifetime, remaining(a), remaining(b)});
    const Vec3 relative = b.mean_velocity - a.mean_velocity;
    const float speed = length_of(relative);
    std::int64_t ticks = full;
    if (speed * static_cast<float>(full) > most_approach * slack_both)
        ticks = std::max<std::int64_t>(1, static_cast<std::int64_t>(most_approach * slack_both / speed));
    block.until = ticks < full ? tick_ + ticks : never;
    block.middle = {0.5f * static_cast<float>(ticks), a.middle, b.middle};
    const Vec3 moved = relative * static_cast<float>(ticks);
    TileReach reach;
    reach.thickness = 0.5f * (thickness_[tile_a] + thickness_[tile_b]);
    reach.add = slack_both + 0.5f * length_of(moved);
    const std::array<float, 3> parts{moved.x, moved.y, moved.z};
    for (int k = 0; k < 3; ++k) {
        reach.shift[k] = 0.5f * parts[k];
        reach.widen[k] = reach.thickness + slack_both + std::fabs(reach.shift[k]);
    }
    if (a.cloth == b.cloth) reach.rest = of_a.rest;
    reach.of_cloths = {of_a.thickness, of_b.thickness};
    reach.uneven = {of_a.uneven, of_b.uneven};
    return reach;
}

float PairSearch::approach(const TileState& a, const TileState& b, const TilePairs::Block& block) const {
    const auto begin = static_cast<float>(tick_ - block.listed);
    const auto away_from = [&](float middle) {
        return std::max(std::fabs(begin - middle), std::fabs(begin + 1 - middle));
    };
    return away_from(block.middle[0]) * length_of(b.mean_velocity - a.mean_velocity) +
           away_from(block.middle[1]) * a.spread + away_from(block.middle[2]) * b.spread +
           std::max(a.strays[0], a.strays[1]) + std::max(b.strays[0], b.strays[1]);
}

void PairSearch::next_tick() {
    ++tick_;
    for (TileState& tile : tiles_) tile.strays = {tile.strays[1], 0};
}

// Pairs near a seam keep at most half of their distance at rest through it, as neighbors on one cloth do. Features with
// particles that a stitch holds together form no pair.
void PairSearch::apply_seams(int kind, PairList& list, std::uint32_t begin) const {
    const Seams& seams = *cloths_.front().seams;
    const int side_one = kind == 0 ? 1 : 2;
    std::uint32_t kept = begin;
    for (std::uint32_t i = begin; i < list.count; ++i) {
        float through = Seams::far;
        for (int k = 0; k < side_one; ++k)
            for (int l = side_one; l < 4; ++l)
                through = std::min(through, seams.distance(list.particle[k][i], list.particle[l][i]));
        if (!(through > 0)) continue;
        const float thickness = std::min(list.thickness[i], 0.5f * through);
        for (auto& array : list.particle) array[kept] = array[i];
        list.spare[kept] = list.spare[i] + (list.thickness[i] - thickness);
        list.thickness[kept] = thickness;
        ++kept;
    }
    list.count = kept;
}

void PairSearch::list_block(std::uint32_t a, std::uint32_t b, Workspace& workspace) const {
    TilePairs& row = workspace.fresh;
    TilePairs::Block block{.other = b, .listed = tick_};
    const TileReach how = reach(a, b, block);
    for (int kind = 0; kind < 2; ++kind) block.begin[kind] = row.lists[kind].count;
    loops_->list_pairs(tiles_[a], tiles_[b], how, workspace.scratch, row.lists);
    if (cloths_[tiles_[a].cloth].seams)
        for (int kind = 0; kind < 2; ++kind) apply_seams(kind, row.lists[kind], block.begin[kind]);
    for (int kind = 0; kind < 2; ++kind) block.count[kind] = row.lists[kind].count - block.begin[kind];
    for (int kind = 0; kind < 2; ++kind) {
        const auto spare = std::span(row.lists[kind].spare).subspan(block.begin[kind], block.count[kind]);
        if (!spare.empty()) block.least_spare[kind] = *std::ranges::min_element(spare);
    }
    if (block.count[0] + block.count[1] == 0 && block.until == never) return;
    row.until = std::min(row.until, block.until);
    row.blocks.push_back(block);
}

bool PairSearch::is_old(std::uint32_t a, const TilePairs::Block& block) const {
    return outdated_[a] || outdated_[block.other] || block.until <= tick_;
}

// Merges the blocks that stay with those that are listed anew, in the order of the other tile.
void PairSearch::list_row(std::uint32_t a, Workspace& workspace) {
    TilePairs &row = pairs_[a], &fresh = workspace.fresh;
    for (PairList& list : fresh.lists) list.count = 0;
    fresh.blocks.clear();
    fresh.until = never;
    auto kept = row.blocks.begin();
    auto next = near_[a].begin();
    while (true) {
        while (kept != row.blocks.end() && is_old(a, *kept)) ++kept;
        if (kept == row.blocks.end() && next == near_[a].end()) break;
        if (next == near_[a].end() || (kept != row.blocks.end() && kept->other < *next)) {
            TilePairs::Block block = *kept;
            for (int kind = 0; kind < 2; ++kind) {
                block.begin[kind] = fresh.lists[kind].count;
                fresh.lists[kind].append(row.lists[kind], kept->begin[kind], kept->count[kind]);
            }
            fresh.until = std::min(fresh.until, block.until);
            fresh.blocks.push_back(block);
            ++kept;
        } else {
            list_block(a, *next++, workspace);
        }
    }
    std::swap(fresh, row);
    for (PairList& list : row.lists) list.pad(cloths_.front().base);
}

// The tiles of which pairs are to be listed, each with the other tiles in ascending order, and the tiles whose features
// that needs.
void PairSearch::find_rows() {
    std::vector<std::uint8_t> needed(tiles_.size(), 0);
    rows_.clear(), to_gather_.clear();
    for (std::uint32_t a = 0; a < tiles_.size(); ++a) {
        const TilePairs& row = pairs_[a];
        std::vector<std::uint32_t>& others = near_[a];
        if (!outdated_[a] && row.until <= tick_) {
            for (const TilePairs::Block& block : row.blocks)
                if (block.until <= tick_ && !outdated_[block.other]) others.push_back(block.other);
        }
        const auto old = [&](const TilePairs::Block& block) { return is_old(a, block); };
        if (!outdated_[a] && others.empty() && std::ranges::none_of(row.blocks, old)) continue;
        std::ranges::sort(others);
        rows_.push_back(a);
        if (!others.empty()) needed[a] = 1;
        for (const std::uint32_t other : others) needed[other] = 1;
    }
    for (std::uint32_t i = 0; i < tiles_.size(); ++i)
        if (needed[i]) to_gather_.push_back(i);
}

void PairSearch::search(const LedTeam& team) {
    bound_tiles(team);
    find_near_tiles();
    find_rows();
    while (workspaces_.size() < team.size()) workspaces_.push_back(std::make_unique<Workspace>());
    team.run([&](unsigned worker) {
        for (std::size_t i = worker; i < to_gather_.size(); i += team.size()) gather(tiles_[to_gather_[i]]);
    });
    // Interleaved: neighboring rows have similar work.
    team.run([&](unsigned worker) {
        for (std::size_t i = worker; i < rows_.size(); i += team.size()) list_row(rows_[i], *workspaces_[worker]);
    });
}

}  // namespace weft
