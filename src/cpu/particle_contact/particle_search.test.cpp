// The search for pairs of particles against all pairs, on every instruction set.
#include "collide/particle_search.h"

#include "collide/tiles.h"
#include "cpu/particle_contact/particle_loops.h"
#include "cpu/passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>

namespace weft::cpu {
namespace {

constexpr float near_enough = 0.14f, part_at_rest = 0.5f, less_at_rest = 0.046f;
constexpr std::uint32_t columns = 14, rows = 11, sheet = columns * rows;

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

bool holds_all(const PairSet& listed, const PairSet& near) {
    return std::includes(listed.begin(), listed.end(), near.begin(), near.end());
}

// Two sheets with edges of 0.1 that wave, meet and drift apart, with some noise.
class WavingSheets {
  public:
    explicit WavingSheets(float noise) : noise_(noise) {
        for (std::uint32_t p = 0; p < sheet; ++p)
            rest_.push_back({0.1f * static_cast<float>(p % columns), 0, 0.1f * static_cast<float>(p / columns), 1});
        order_ = std::make_shared<const std::vector<std::uint32_t>>(order_along_curve(rest_));
        now_.resize(2 * sheet);
        move_to(0);
    }
    std::vector<SearchedParticles> cloths() const {
        SearchedParticles one{order_, 0, rest_.data(), near_enough, 0.045f, part_at_rest, less_at_rest, true},
            two = one;
        two.base = sheet;
        return {one, two};
    }
    void move_to(int tick) {
        const float t = 0.02f * static_cast<float>(tick);
        for (std::uint32_t p = 0; p < 2 * sheet; ++p) {
            const Vec4 r = rest_[p % sheet];
            const float side = p < sheet ? 1.0f : -1.0f;
            const auto swing = [&] { return noise_ * (static_cast<float>(random_() % 2001) / 1000.0f - 1); };
            now_[p] = {5 * t + r.x * std::cos(t) + swing(),
                       side * 0.3f * std::cos(3 * t + 2 * r.x) + 0.1f * std::sin(9 * r.z) + swing(),
                       r.z + 0.2f * side * t + swing(), 1};
        }
    }
    const Vec4* now() const { return now_.data(); }
    std::vector<Vec4>& places() { return now_; }

    PairSet near() const {
        PairSet pairs;
        for (std::uint32_t a = 0; a < 2 * sheet; ++a) {
            for (std::uint32_t b = a + 1; b < 2 * sheet; ++b) {
                float most = near_enough;
                if ((a < sheet) == (b < sheet)) {
                    const float at_rest = length(rest_[a % sheet].xyz() - rest_[b % sheet].xyz());
                    most = std::min(most, std::max(part_at_rest * at_rest, at_rest - less_at_rest));
                }
                if (length(now_[a].xyz() - now_[b].xyz()) < most) pairs.insert({a, b});
            }
        }
        return pairs;
    }

  private:
    float noise_;
    std::mt19937 random_{4};
    std::vector<Vec4> rest_, now_;
    std::shared_ptr<const std::vector<std::uint32_t>> order_;
};

// Returns whether any list was made.
bool search_once(ParticleSearch& search, const Vec4* positions, bool always = false) {
    for (std::uint32_t t = 0; t < search.tile_count(); ++t) search.track(t, positions);
    search.find_outdated(positions, always);
    bool any = false;
    for (std::uint32_t t = 0; t < search.tile_count(); ++t) any |= search.list(t, 0);
    return any;
}

PairSet listed_by(const ParticleSearch& search) {
    PairSet pairs;
    for (std::uint32_t t = 0; t < search.tile_count(); ++t) {
        search.for_each_run(t, [&](const ParticlePairs& list, std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t i = begin; i < end; ++i)
                EXPECT_TRUE(pairs.insert(std::minmax(list.one[i], list.two[i])).second) << "listed twice";
        });
    }
    return pairs;
}

TEST(ParticleSearch, lists_all_pairs_that_are_near) {
    for (const Passes* passes : available_passes()) {
        for (const float noise : {0.0f, 0.002f, 0.03f}) {
            WavingSheets sheets(noise);
            ParticleSearch search;
            search.set_cloths(particle_loops_of(passes->isa).search, sheets.cloths(), 1);
            std::size_t found = 0;
            for (int tick = 1; tick <= 160; ++tick) {
                sheets.move_to(tick);
                (void)search_once(search, sheets.now());
                const auto listed = listed_by(search), near = sheets.near();
                found += near.size();
                EXPECT_TRUE(holds_all(listed, near)) << passes->isa << ", noise " << noise << ", " << tick;
            }
            EXPECT_GT(found, 1000u) << "the sheets meet";
        }
    }
}

TEST(ParticleSearch, keeps_the_lists_of_cloths_that_move_together) {
    WavingSheets sheets(0);
    ParticleSearch search;
    search.set_cloths(scalar_particle_loops().search, sheets.cloths(), 1);
    for (int tick = 0; tick < 50; ++tick) {
        EXPECT_EQ(search_once(search, sheets.now()), tick == 0);
        for (Vec4& x : sheets.places()) x.x += 0.37f, x.y -= 0.21f;
    }
    EXPECT_TRUE(search_once(search, sheets.now(), true));
}

TEST(ParticleSearch, lists_again_where_a_single_particle_moves) {
    WavingSheets sheets(0);
    ParticleSearch search;
    search.set_cloths(scalar_particle_loops().search, sheets.cloths(), 1);
    (void)search_once(search, sheets.now());
    sheets.places()[20].y += 0.004f;
    EXPECT_FALSE(search_once(search, sheets.now()));
    sheets.places()[20].y += 0.1f;
    EXPECT_TRUE(search_once(search, sheets.now()));
    EXPECT_TRUE(holds_all(listed_by(search), sheets.near()));
}

TEST(ParticleSearch, survives_positions_that_are_not_finite) {
    WavingSheets sheets(0);
    ParticleSearch search;
    search.set_cloths(scalar_particle_loops().search, sheets.cloths(), 1);
    const std::vector<Vec4> before = sheets.places();
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
        sheets.places()[5].y = value;
        (void)search_once(search, sheets.now());
        for (Vec4& x : sheets.places()) x = {value, value, value, 1};
        (void)search_once(search, sheets.now());
        sheets.places() = before;
        (void)search_once(search, sheets.now());
        EXPECT_TRUE(holds_all(listed_by(search), sheets.near()));
    }
}

}  // namespace
}  // namespace weft::cpu
