// The pair search against all pairs, on every instruction set.
#include "collide/pair_search.h"

#include "cpu/cloth_contact/contact_loops.h"
#include "cpu/passes.h"
#include "mesh/procedural.h"
#include "physics/scalar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace weft::cpu {
namespace {

using Pair = std::array<std::uint32_t, 4>;

constexpr float thickness = 0.03f, slack = 0.02f;

// Two sheets that wave, meet and drift apart, with some noise.
class MovingSheets {
  public:
    explicit MovingSheets(float noise) : noise_(noise) {
        const TriangleMesh grid = make_grid({1, 0.8f}, {13, 11}, GridDiagonal::alternating);
        count_ = static_cast<std::uint32_t>(grid.positions.size());
        for (const Vec3& p : grid.positions) rest_.push_back({p.x, p.y, p.z, 1});
        triangles_ = grid.triangles;
        for (int k = 0; k < 3; ++k)
            for (const Triangle& t : triangles_) corners_.push_back(t[k]);
        const auto size = static_cast<std::uint32_t>(triangles_.size());
        tiles_ = std::make_shared<const std::vector<Tile>>(make_tiles({corners_.data(), size, size}, rest_));
        now_.resize(2 * count_), velocity_.resize(2 * count_);
        move_to(0);
        start_ = now_;
    }

    std::vector<SearchedCloth> cloths() const {
        return {{tiles_, 0, rest_.data(), thickness, slack}, {tiles_, count_, rest_.data(), thickness, slack}};
    }
    void step(int tick) {
        for (std::uint32_t p = 0; p < now_.size(); ++p) {
            const Vec3 v = now_[p].xyz() - start_[p].xyz();
            velocity_[p] = {v.x, v.y, v.z, 0};
        }
        start_ = now_;
        move_to(tick);
    }
    const Vec4* start() const { return start_.data(); }
    const Vec4* now() const { return now_.data(); }
    const Vec4* velocity() const { return velocity_.data(); }

    /// Calls visit(pair, edges) for all pairs that come within their thickness at one of some places of the motion, or
    /// could if their particles went on from its end by `reach`.
    template <class Visit>
    void for_each_near(float reach, Visit&& visit) const {
        std::vector<std::array<std::uint32_t, 2>> edges;
        std::set<std::array<std::uint32_t, 2>> seen;
        std::vector<Triangle> all;
        for (const std::uint32_t first : {0u, count_}) {
            for (const Triangle& t : triangles_) {
                all.push_back({first + t[0], first + t[1], first + t[2]});
                for (int k = 0; k < 3; ++k) {
                    const auto [a, b] = std::minmax({first + t[k], first + t[(k + 1) % 3]});
                    if (seen.insert({a, b}).second) edges.push_back({a, b});
                }
            }
        }
        for (std::uint32_t v = 0; v < 2 * count_; ++v)
            for (const Triangle& t : all)
                if (t[0] != v && t[1] != v && t[2] != v && is_near({v, t[0], t[1], t[2]}, false, reach))
                    visit(Pair{v, t[0], t[1], t[2]}, false);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            for (std::size_t j = i + 1; j < edges.size(); ++j) {
                const Pair pair{edges[i][0], edges[i][1], edges[j][0], edges[j][1]};
                if (pair[0] == pair[2] || pair[0] == pair[3] || pair[1] == pair[2] || pair[1] == pair[3]) continue;
                if (is_near(pair, true, reach)) visit(pair, true);
            }
        }
    }

  private:
    void move_to(int tick) {
        const float t = 0.02f * static_cast<float>(tick);
        for (std::uint32_t p = 0; p < 2 * count_; ++p) {
            const Vec4 r = rest_[p % count_];
            const float side = p < count_ ? 1.0f : -1.0f;
            const auto swing = [&] { return noise_ * (static_cast<float>(random_() % 2001) / 1000.0f - 1); };
            now_[p] = {r.x * std::cos(t) + swing(),
                       side * 0.3f * std::cos(3 * t + 2 * r.x) + 0.1f * std::sin(9 * r.z) + swing(),
                       r.z + 0.2f * side * t + swing(), 1};
        }
    }
    static float distance(const std::array<Vec3, 4>& x, bool edges) {
        scalar::vec3 y[4];
        for (int k = 0; k < 4; ++k) y[k] = {x[k].x, x[k].y, x[k].z};
        return edges ? scalar::closest_edge_edge(y[0], y[1], y[2], y[3]).distance
                     : scalar::closest_vertex_triangle(y[0], y[1], y[2], y[3]).distance;
    }
    bool is_near(const Pair& pair, bool edges, float reach) const {
        float most = thickness;
        if ((pair[0] < count_) == (pair[3] < count_)) {
            std::array<Vec3, 4> rest;
            for (int k = 0; k < 4; ++k) rest[k] = rest_[pair[k] % count_].xyz();
            most = std::min(most, 0.5f * distance(rest, edges));
        }
        for (const float part : {0.0f, 0.5f, 1.0f}) {
            std::array<Vec3, 4> x;
            for (int k = 0; k < 4; ++k) {
                const Vec3 from = start_[pair[k]].xyz();
                x[k] = from + (now_[pair[k]].xyz() - from) * part;
            }
            if (distance(x, edges) < most + (part == 1 ? 2 * reach : 0)) return true;
        }
        return false;
    }

    float noise_;
    mutable std::mt19937 random_{4};
    std::uint32_t count_;
    std::vector<Vec4> rest_, start_, now_, velocity_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> corners_;
    std::shared_ptr<const std::vector<Tile>> tiles_;
};

// Either edge may come first.
Pair in_order(Pair pair, bool edges) {
    if (!edges) {
        std::sort(pair.begin() + 1, pair.end());
        return pair;
    }
    std::sort(pair.begin(), pair.begin() + 2), std::sort(pair.begin() + 2, pair.end());
    if (pair[2] < pair[0]) std::swap(pair[0], pair[2]), std::swap(pair[1], pair[3]);
    return pair;
}

// Labels: slow no-asan long
TEST(PairSearch, lists_all_pairs_that_come_near) {
    for (const Passes* passes : available_passes()) {
        for (const float noise : {0.0f, 0.002f, 0.03f}) {
            MovingSheets sheets(noise);
            PairSearch search;
            search.set_cloths(contact_loops_of(passes->isa).search, sheets.cloths());
            std::size_t near = 0;
            for (int tick = 1; tick <= 25; ++tick) {
                sheets.step(tick);
                // All places between the start and the end, or the places around the end.
                const bool between = tick % 7 == 0;
                const float reach = between ? 0 : std::array{0.0f, 0.4f, 1.5f}[tick % 3] * slack;
                const std::vector<float> of_tiles(search.tile_count(), reach);
                if (search.find_outdated(sheets.now(), of_tiles)) {
                    if (between)
                        search.cover(sheets.start(), sheets.now());
                    else
                        search.follow(sheets.start(), sheets.now(), sheets.velocity(), 1, of_tiles);
                    search.search();
                }
                std::array<std::map<Pair, float>, 2> spare;  // less what the features may have approached
                search.for_each_block(
                    0, 1, [&](std::size_t, const TilePairs& row, const TilePairs::Block& block, float approach) {
                        for (int kind = 0; kind < 2; ++kind) {
                            const PairList& list = row.lists[kind];
                            for (std::uint32_t i = block.begin[kind]; i < block.begin[kind] + block.count[kind]; ++i) {
                                const Pair pair{list.particle[0][i], list.particle[1][i], list.particle[2][i],
                                                list.particle[3][i]};
                                const bool fresh =
                                    spare[kind].emplace(in_order(pair, kind == 1), list.spare[i] - approach).second;
                                EXPECT_TRUE(fresh) << "listed twice";
                            }
                        }
                    });
                sheets.for_each_near(reach, [&](const Pair& pair, bool edges) {
                    ++near;
                    const auto found = spare[edges].find(in_order(pair, edges));
                    ASSERT_NE(found, spare[edges].end()) << passes->isa << ", noise " << noise << ", tick " << tick;
                    EXPECT_LE(found->second, 2 * reach + 1e-6f);
                });
                search.next_tick();
            }
            EXPECT_GT(near, 1000u) << "the sheets meet";
        }
    }
}

TEST(PairSearch, keeps_lists_of_resting_cloth) {
    MovingSheets sheets(0);
    PairSearch search;
    search.set_cloths(scalar_contact_loops().search, sheets.cloths());
    for (int tick = 1; tick <= 50; ++tick) {
        sheets.step(0);  // stays where it is
        if (search.find_outdated(sheets.now(), {})) {
            EXPECT_EQ(tick, 1);
            search.follow(sheets.start(), sheets.now(), sheets.velocity(), 1, {});
            search.search();
        }
        search.next_tick();
    }
    EXPECT_EQ(search.searched_tiles(), search.tile_count());
}

TEST(PairSearch, finds_positions_that_are_not_finite_outdated) {
    MovingSheets sheets(0);
    PairSearch search;
    search.set_cloths(scalar_contact_loops().search, sheets.cloths());
    (void)search.find_outdated(sheets.now(), {});
    search.follow(sheets.start(), sheets.now(), sheets.velocity(), 1, {});
    search.search();
    search.next_tick();
    std::vector<Vec4> broken(sheets.now(), sheets.now() + 2 * 13 * 11);
    EXPECT_FALSE(search.find_outdated(broken.data(), {}));
    broken[5].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(search.find_outdated(broken.data(), {}));
}

}  // namespace
}  // namespace weft::cpu
