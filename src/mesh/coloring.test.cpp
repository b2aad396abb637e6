#include "mesh/coloring.h"

#include "mesh/procedural.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace weft {
namespace {

using Rows = std::vector<std::uint32_t>;

/// Every constraint once, ascending within colors and overflow, no particle in two constraints of a color.
void expect_valid(const Coloring& coloring, const Rows& particles, std::uint32_t arity, std::uint32_t particle_count,
                  const ColoringOptions& options = {}) {
    const std::size_t row_count = particles.size() / arity;
    ASSERT_EQ(coloring.order.size(), row_count);
    ASSERT_FALSE(coloring.color_begin.empty());
    EXPECT_EQ(coloring.color_begin.front(), 0u);
    EXPECT_EQ(coloring.color_begin.back() + coloring.overflow, row_count);
    EXPECT_LE(coloring.color_count(), options.max_colors);

    Rows sorted = coloring.order;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < row_count; ++i) ASSERT_EQ(sorted[i], i);

    Rows color_of_last_use(particle_count, 0xffffffffu), row_of_last_use(particle_count);
    for (std::uint32_t c = 0; c < coloring.color_count(); ++c) {
        const auto begin = coloring.order.begin() + coloring.color_begin[c];
        const auto end = coloring.order.begin() + coloring.color_begin[c + 1];
        EXPECT_GE(end - begin, static_cast<std::ptrdiff_t>(std::max(options.min_rows, 1u)));
        EXPECT_TRUE(std::is_sorted(begin, end));
        for (auto row = begin; row != end; ++row)
            for (std::uint32_t k = 0; k < arity; ++k) {
                const std::uint32_t particle = particles[*row * arity + k];
                ASSERT_TRUE(color_of_last_use[particle] != c || row_of_last_use[particle] == *row)
                    << "row " << *row << " shares a particle within color " << c;
                color_of_last_use[particle] = c;
                row_of_last_use[particle] = *row;
            }
    }
    EXPECT_TRUE(std::is_sorted(coloring.order.begin() + coloring.color_begin.back(), coloring.order.end()));
}

Rows random_rows(std::uint32_t seed, std::size_t count, std::uint32_t arity, std::uint32_t particle_count,
                 bool distinct) {
    std::mt19937 random(seed);
    Rows rows;
    while (rows.size() < count * arity) {
        const auto row_begin = static_cast<std::ptrdiff_t>(rows.size() - rows.size() % arity);
        const std::uint32_t p = random() % particle_count;
        if (!distinct || std::find(rows.begin() + row_begin, rows.end(), p) == rows.end()) rows.push_back(p);
    }
    return rows;
}

TEST(Coloring, nothing) {
    const Coloring coloring = color_rows({}, 2, 0);
    expect_valid(coloring, {}, 2, 0);
    EXPECT_EQ(coloring.color_count(), 0u);
}

TEST(Coloring, random_rows_of_every_arity) {
    for (std::uint32_t arity = 1; arity <= 8; ++arity)
        for (const std::uint32_t particle_count : {16u, 200u, 5000u})
            for (const ColoringOptions options :
                 {ColoringOptions{}, {.max_colors = 64, .min_rows = 0}, {.max_colors = 5, .min_rows = 20}}) {
                const Rows rows = random_rows(arity * 100 + particle_count, 2000, arity, particle_count, true);
                expect_valid(color_rows(rows, arity, particle_count, options), rows, arity, particle_count, options);
            }
}

TEST(Coloring, two_runs_are_equal) {
    const Rows rows = random_rows(1, 3000, 4, 700, true);
    const Coloring a = color_rows(rows, 4, 700), b = color_rows(rows, 4, 700);
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.color_begin, b.color_begin);
    EXPECT_EQ(a.overflow, b.overflow);
}

TEST(Coloring, is_first_fit_in_row_order) {
    const Rows path{0, 1, 1, 2, 2, 3, 3, 0, 0, 2};
    const Coloring coloring = color_rows(path, 2, 4, {.min_rows = 1});
    EXPECT_EQ(coloring.order, (Rows{0, 2, 1, 3, 4}));
    EXPECT_EQ(coloring.color_begin, (Rows{0, 2, 4, 5}));
}

TEST(Coloring, row_with_a_particle_twice_is_one_like_others) {
    const Rows rows{0, 1, 2, 2, 3, 4, 5, 5};
    const Coloring coloring = color_rows(rows, 2, 6, {.min_rows = 1});
    expect_valid(coloring, rows, 2, 6, {.min_rows = 1});
    EXPECT_EQ(coloring.order, (Rows{0, 1, 2, 3}));
    EXPECT_EQ(coloring.color_begin, (Rows{0, 4}));
    EXPECT_EQ(coloring.overflow, 0u);
    const Rows wild = random_rows(2, 1000, 4, 40, false);
    expect_valid(color_rows(wild, 4, 40), wild, 4, 40);
}

TEST(Coloring, stars_overflow) {
    const std::uint32_t stars = 10, valence = 100;
    Rows rows;
    for (std::uint32_t s = 0; s < stars; ++s)
        for (std::uint32_t i = 1; i <= valence; ++i) rows.insert(rows.end(), {s * 101, s * 101 + i});
    const Coloring coloring = color_rows(rows, 2, stars * 101);
    expect_valid(coloring, rows, 2, stars * 101);
    EXPECT_EQ(coloring.color_count(), 64u);
    EXPECT_EQ(coloring.overflow, stars * (valence - 64));

    // A single star has one constraint per color: too few for any color.
    const Rows star(rows.begin(), rows.begin() + 2 * valence);
    EXPECT_EQ(color_rows(star, 2, 101).overflow, valence);
    EXPECT_EQ(color_rows(star, 2, 101, {.min_rows = 1}).overflow, valence - 64);
    EXPECT_EQ(color_rows(star, 2, 101, {.max_colors = 0, .min_rows = 1}).overflow, valence);
}

TEST(Coloring, small_color_leaves_no_hole) {
    // Colors of 3, 1 and 2 constraints: the middle one goes to the overflow.
    const Rows rows{0, 1, 0, 2, 1, 2, 3, 4, 5, 6};
    const Coloring all = color_rows(rows, 2, 7, {.min_rows = 1});
    EXPECT_EQ(all.color_begin, (Rows{0, 3, 4, 5}));
    const Rows more{0, 1, 2, 3, 0, 4, 0, 5, 4, 1, 7, 8};
    const ColoringOptions options{.min_rows = 2};
    const Coloring coloring = color_rows(more, 2, 9, options);
    expect_valid(coloring, more, 2, 9, options);
    EXPECT_EQ(coloring.order, (Rows{0, 1, 5, 3, 4, 2}));
    EXPECT_EQ(coloring.color_begin, (Rows{0, 3, 5}));
    EXPECT_EQ(coloring.overflow, 1u);
}

TEST(Coloring, grid_edges_and_hinges) {
    const auto topology = build_topology(make_grid({1, 1}, {40, 30}, GridDiagonal::alternating));
    ASSERT_TRUE(topology.ok());
    Rows edges, hinges;
    for (const Edge& e : topology->edges) edges.insert(edges.end(), {e.a, e.b});
    for (const Hinge& h : topology->hinges) hinges.insert(hinges.end(), {h.a, h.b, h.c, h.d});
    const Coloring edge_colors = color_rows(edges, 2, topology->particle_count);
    expect_valid(edge_colors, edges, 2, topology->particle_count);
    // Greedy needs at most twice the largest valence, less one.
    EXPECT_GE(edge_colors.color_count(), 8u);
    EXPECT_LE(edge_colors.color_count(), 15u);
    EXPECT_LT(edge_colors.overflow, 32u);
    expect_valid(color_rows(hinges, 4, topology->particle_count), hinges, 4, topology->particle_count);
}

}  // namespace
}  // namespace weft
